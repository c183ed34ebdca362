"""What the benchmarks share: the peer, times side by side, tables in Markdown."""

import argparse
import compileall
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from numeric import numeric

from vstatics import Transmission

ROOT = Path(__file__).parent.parent
BUILD = ROOT / "build"
MZKT = ROOT / "cases" / "mzkt7922.dat"
_script = Path(sys.executable).with_name("vstatics")
VSTATICS = [str(_script)] if _script.exists() else [sys.executable, "-m", "vstatics"]
"""The program; to be started in a folder that has no package of this name."""
FLAGS = ("-O3", "-march=native")
SILENT: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
Result = TypeVar("Result")


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


def bytecode() -> None:
    """Compile the program to bytecode, as it is where it was installed."""
    compileall.compile_dir(str(ROOT / "vstatics"), quiet=1)


class Spent(NamedTuple):
    """What processes took."""

    wall: float
    """By the clock [s]."""
    processor: float
    """User and system time [s]; other work on the machine disturbs it less."""


def spent(command: Sequence[str], folder: Path | None = None) -> Spent:
    """What a command and all processes that it starts take."""
    before = os.times()
    run = partial(subprocess.run, command, check=True, cwd=folder, **SILENT)
    wall, after = timed(run), os.times()
    own = after.children_user + after.children_system
    return Spent(wall, own - before.children_user - before.children_system)


def medians(actions: Mapping[str, Callable[[], float]], rounds: int) -> dict[str, float]:
    """The median of what each action returns; they alternate, so all see the same machine."""
    return {name: statistics.median(found) for name, found in _alternate(actions, rounds).items()}


def medians_spent(actions: Mapping[str, Callable[[], Spent]], rounds: int) -> dict[str, Spent]:
    """The same of what processes take."""
    return {
        name: Spent(*map(statistics.median, zip(*found, strict=True)))
        for name, found in _alternate(actions, rounds).items()
    }


def _alternate(actions: Mapping[str, Callable[[], Result]], rounds: int) -> dict[str, list[Result]]:
    found: dict[str, list[Result]] = {name: [] for name in actions}
    for _ in range(rounds):
        for name, action in actions.items():
            found[name].append(action())
    return found


def rows_of_spent(measured: Mapping[str, Spent], *, decimals: int) -> list[Sequence[str]]:
    """A row for each command, with its times by those of the first."""
    first = next(iter(measured.values()))
    return [
        (
            name,
            *(f"{wall:.{decimals}f} s", f"{wall / first.wall:.2f}"),
            *(f"{processor:.{decimals}f} s", f"{processor / first.processor:.2f}"),
        )
        for name, (wall, processor) in measured.items()
    ]


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
