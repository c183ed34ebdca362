"""Rows of the table, and the measurement of a calculation and its peer by turns."""

from __future__ import annotations

import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

CASES = Path(__file__).parents[1] / "cases"
VSTATICS = str(Path(sys.executable).with_name("vstatics"))
ROUNDS, MOST_ROUNDS = 3, 15
ENOUGH = 4.0
"""Time after which no round beyond the first `ROUNDS` begins. [s]"""
HEADINGS = ("calculation", "time", "peer", "time of the peer", "ratio")

Timer = Callable[[], float]
"""Measurement of one run. [s]"""


class Setting(NamedTuple):
    """Surroundings of a benchmark."""

    folder: Path
    """Folder for files, with room for two gigabytes."""
    peer: Path
    """Compiled program that `peer.Peer` calls."""
    is_trial: bool = False
    """True for little work: a test that the benchmarks run."""

    def some(self, count: int) -> int:
        """Return a count, or a hundredth of it in a trial."""
        return max(2, count // 100) if self.is_trial else count


class Race(NamedTuple):
    """A calculation and its peer, ready to be measured."""

    calculation: Timer
    peer: Timer

    def medians(self, rounds: int, most: int) -> tuple[float, float]:
        """Return median times of alternating runs, so that both see the same machine [s]."""
        pairs: list[tuple[float, float]] = []
        end = time.perf_counter() + ENOUGH
        while len(pairs) < rounds or (len(pairs) < most and time.perf_counter() < end):
            pairs.append((self.calculation(), self.peer()))
        calculation, peer = zip(*pairs, strict=True)
        return statistics.median(calculation), statistics.median(peer)


class Row(NamedTuple):
    """Row of the table."""

    calculation: str
    peer: str
    race: Callable[[Setting], Race]
    is_long: bool = False
    """True for a row that is measured once, and only if it is asked for."""

    @property
    def unmeasured(self) -> str:
        """The row without times, in Markdown."""
        return _line(self.calculation, "", self.peer, "", "")

    def measured(self, setting: Setting) -> str:
        """Return the row with its times, in Markdown."""
        once = setting.is_trial or self.is_long
        times = self.race(setting).medians(*((1, 1) if once else (ROUNDS, MOST_ROUNDS)))
        calculation, peer = map(written_time, times)
        ratio = f"{float(f'{times[1] / times[0]:.2g}'):,g}"
        return _line(self.calculation, calculation, self.peer, peer, ratio)


def heading() -> str:
    """Return the two lines above the rows, in Markdown."""
    return f"{_line(*HEADINGS)}\n{_line('---', '---:', '---', '---:', '---:')}"


def _line(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def written_time(seconds: float) -> str:
    """Return a time with three digits.

    >>> [written_time(time) for time in (0.000_000_2401, 0.01234, 123456.0)]
    ['0.24 µs', '12.3 ms', '123,000 s']
    """
    size, unit = (1.0, "s") if seconds >= 1 else (1e-3, "ms") if seconds >= 1e-3 else (1e-6, "µs")
    return f"{float(f'{seconds / size:.3g}'):,.12g} {unit}"


def processor_time() -> float:
    """Return the processor time of this process and its children [s].

    Other work on the machine disturbs it less than the time on the clock.
    """
    usages = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def timer(
    action: Callable[[], object], parts: float = 1, *, clock: Callable[[], float] = processor_time
) -> Timer:
    """Return the measurement of an action, divided by the number of its equal parts."""

    def seconds() -> float:
        start = clock()
        action()
        return (clock() - start) / parts

    return seconds


def command(*words: str, folder: Path, **environment: str) -> Callable[[], Any]:
    """Return a function that runs a command in a folder, without its messages.

    The program may store its bytecode, as pip does when it installs the peers.
    """
    return partial(
        subprocess.run,
        words,
        check=True,
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "", **environment},
    )


def machine() -> str:
    """Return the machine in general words."""
    model = platform.processor() or platform.machine()
    if (cpus := Path("/proc/cpuinfo")).exists():
        names = [line for line in cpus.read_text("utf-8").splitlines() if "model name" in line]
        model = names[0].partition(":")[2].strip() if names else model
    return f"{os.cpu_count()} cores, {model}, Python {platform.python_version()}"
