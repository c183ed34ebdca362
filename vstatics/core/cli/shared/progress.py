"""Progress on stderr: a bar at a terminal, otherwise a line from time to time."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.estimates import duration_text
from vstatics.core.jobs.processes import TELLING

if TYPE_CHECKING:
    from rich.progress import Progress

Advance = Callable[[int], None]
"""Function that advances progress by a number of units."""

PERIOD = 0.1
"""Shortest time between two updates of the bar. [s]"""
BAR_COLUMNS = 24
"""Width of the bar, for which a line with numbers of eight digits fits 80 characters."""
FIRST_WORD, LONGEST_SILENCE = 5.0, 600.0
"""Time until the first line, and longest time between lines. The time doubles for each line. [s]"""


@contextmanager
def telling(said: Callable[[], str]) -> Iterator[None]:
    """Print the progress of long work from time to time, and nothing for short work.

    Parameters
    ----------
    said : callable
        Function that returns a line about the progress, or an empty text.
    """
    ended = threading.Event()

    def tell() -> None:
        wait = FIRST_WORD
        while not ended.wait(wait):
            if line := said():
                files.say(line)
            wait = min(2 * wait, LONGEST_SILENCE)

    threading.Thread(target=tell, name=TELLING, daemon=True).start()
    try:
        yield
    finally:
        ended.set()


def done_text(part: float, seconds: float) -> str:
    """Return words for finished fraction (0 to 1), elapsed time [s] and extrapolated time left.

    >>> done_text(0.25, 30)
    '25 % after 30 s, about 1.5 minutes left'
    >>> done_text(0, 5)
    '0 % after 5 s'
    """
    left = f", about {duration_text(seconds / part - seconds)} left" if part else ""
    return f"{100 * part:.3g} % after {duration_text(seconds)}{left}"


@contextmanager
def progress(
    total: int | None, unit: str, *, beside_stdout: bool = False, quiet: bool = False
) -> Iterator[Advance]:
    """Show the number of finished units by a bar, or by lines if stderr is not a terminal.

    Messages (`files.say`) appear above the bar. The bar is drawn only when it advances, without a
    thread, so that processes can be started at the same time.

    Parameters
    ----------
    total : int, optional
        Number of all units; None if unknown.
    unit : str
        Name of the units in the plural, such as "variants".
    beside_stdout : bool
        True if results are written to stdout at the same time. If stdout is the same terminal,
        there is no bar.
    quiet : bool
        True to show nothing.

    Examples
    --------
    >>> with progress(1000, "variants") as advance:  # nothing is drawn: no terminal
    ...     advance(500)
    """
    if quiet or (beside_stdout and _is_terminal(sys.stdout)):
        yield lambda count: None  # noqa: ARG005
        return
    if not _is_terminal(sys.stderr) or os.environ.get("TERM") == "dumb":
        with _lines(total, unit) as advance:
            yield advance
        return
    from rich.text import Text

    with _bar(unit) as bar:
        task = bar.add_task("", total=total)
        drawn = time.monotonic()

        def advance(count: int) -> None:
            nonlocal drawn
            bar.advance(task, count)
            if time.monotonic() - drawn >= PERIOD:
                bar.refresh()
                drawn = time.monotonic()

        def above(line: str) -> None:
            bar.console.print(Text(line), soft_wrap=True)

        with files.speaking(above):
            yield advance


@contextmanager
def _lines(total: int | None, unit: str) -> Iterator[Advance]:
    """Print lines about the progress, if the total is known."""
    began, done = time.monotonic(), 0

    def advance(count: int) -> None:
        nonlocal done
        done += count

    def said() -> str:
        return f"{unit}: {done_text(done / total, time.monotonic() - began)}" if total else ""

    with telling(said):
        yield advance


def _is_terminal(stream: TextIO | None) -> bool:
    return stream is not None and stream.isatty()


def _bar(unit: str) -> Progress:
    from rich import progress as parts
    from rich.text import Text

    from vstatics.core.cli.shared.console import SafeConsole

    class Rate(parts.ProgressColumn):
        """Column of the progress bar with units per second. The column before it names the unit."""

        def render(self, task: parts.Task) -> Text:
            speed = task.finished_speed or task.speed
            return Text(f"{speed:.3g}/s" if speed else "")

    return parts.Progress(
        parts.BarColumn(BAR_COLUMNS),
        parts.MofNCompleteColumn(),
        parts.TextColumn(unit),
        Rate(),
        parts.TimeRemainingColumn(),
        console=SafeConsole(stderr=True),
        auto_refresh=False,
        redirect_stdout=False,
        redirect_stderr=False,
        transient=True,
    )
