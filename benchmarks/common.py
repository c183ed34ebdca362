"""What the benchmarks share: the peer, times side by side, tables in Markdown."""

import argparse
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from numeric import numeric

from vstatics import Transmission

ROOT = Path(__file__).parent.parent
BUILD = ROOT / "build"
MZKT = ROOT / "cases" / "mzkt7922.dat"
_script = Path(sys.executable).with_name("vstatics")
VSTATICS = [str(_script)] if _script.exists() else [sys.executable, "-m", "vstatics"]
"""The program; to be started in a folder that has no package of this name."""
FLAGS = ("-O3", "-march=native")


class Options(NamedTuple):
    """What a benchmark is told on the command line."""

    quick: bool
    peer: Path
    """The program; of no use where the benchmark has none."""


def options(description: str, *, peer: bool = True) -> Options:
    """Read the command line; the peer is compiled when it is needed and no other is given."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="less work: does it run at all?")
    if peer:
        parser.add_argument(
            "--peer", type=Path, metavar="PROGRAM", help="another peer with the same usage"
        )
    given = parser.parse_args()
    if not peer:
        return Options(given.quick, Path())
    return Options(given.quick, given.peer.resolve() if given.peer else compiled())


def compiled() -> Path:
    """The peer, compiled into the build folder unless it is newer than its source."""
    source, program = ROOT / "benchmarks" / "peer.c", BUILD / "peer"
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        compiler = shutil.which(os.environ.get("CC", "cc"))
        if compiler is None:
            sys.exit("a C compiler is needed for the peer: install one, or name it in CC")
        BUILD.mkdir(exist_ok=True)
        made = BUILD / f"peer.{os.getpid()}"
        subprocess.run([compiler, *FLAGS, "-o", str(made), str(source), "-lm"], check=True)
        made.replace(program)
    return program


Tables = dict[str, list[list[float]]]
"""Name of a table -> its rows over the gears."""


class Peer:
    """The peer with one case."""

    def __init__(self, program: Path, case: Transmission, folder: Path) -> None:
        self.program = str(program)
        self.path = str(folder / f"{case.links}-links.num")
        Path(self.path).write_text(numeric(case), encoding="ascii")

    def _run(self, *arguments: str) -> str:
        command = [self.program, self.path, *arguments]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    def tables(self) -> Tables:
        """All tables of the case itself, with all digits."""
        found: Tables = {}
        rows: list[list[float]] = []
        for line in self._run("0").splitlines():
            if line[0].isalpha():
                rows = found[line] = []
            else:
                rows.append([float(word) for word in line.split()])
        return found

    def check_sum(self, variants: int) -> float:
        """Mx with losses in the first gear and the efficiency of the last one, summed up."""
        return float(self._run(str(variants)).split()[-1])

    def seconds(self, variants: int) -> float:
        """Wall-clock time of so many variants, without starting and reading the case."""
        return timed(lambda: self._run(str(variants))) - timed(lambda: self._run("1"))


def timed(action: Callable[[], object]) -> float:
    """Wall-clock time [s]."""
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def medians(actions: Mapping[str, Callable[[], float]], rounds: int) -> dict[str, float]:
    """The median of what each action returns; they alternate, so all see the same machine."""
    found: dict[str, list[float]] = {name: [] for name in actions}
    for _ in range(rounds):
        for name, action in actions.items():
            found[name].append(action())
    return {name: statistics.median(numbers) for name, numbers in found.items()}


def print_table(caption: str, columns: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
    """A table in Markdown below its caption, ready to be pasted."""
    print(f"\n{caption}:\n")
    print("| " + " | ".join(columns) + " |")
    print("| " + " | ".join("---" if n == 0 else "---:" for n in range(len(columns))) + " |")
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")
    sys.stdout.flush()


def machine() -> str:
    """The machine in general words."""
    model = platform.processor() or platform.machine()
    if Path("/proc/cpuinfo").exists():
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
    return f"{os.cpu_count()} cores, {model}, Python {platform.python_version()}"
