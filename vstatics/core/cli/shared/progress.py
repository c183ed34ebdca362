"""How far something is, on stderr: a bar for a person, else a line from time to time."""

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
"""Tells the bar that so many more are done."""

PERIOD = 0.1
"""So often the bar is drawn anew [s]."""
BAR_COLUMNS = 24
"""Columns of the bar itself: with eight digits of each number the line fits 80."""
FIRST_WORD, LONGEST_SILENCE = 5.0, 600.0
"""After so long the first line comes, then each after twice as long as before, to this. [s]"""


@contextmanager
def telling(said: Callable[[], str]) -> Iterator[None]:
    """Say how far something is where it takes long, and nothing where it is done soon.

    Parameters
    ----------
    said : callable
        Gives a line, or nothing.
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
    """How far something is that takes time evenly.

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
    """Show how many of `total` are done, if stderr is a terminal; else say it where it takes long.

    Messages (`files.say`) appear above the bar. It is drawn when it advances, by no
    thread of its own: processes may be started while it stands.

    Parameters
    ----------
    total : int, optional
        Number of units in all, where it is known.
    unit : str
        What is counted, in the plural: "variants".
    beside_stdout : bool
        Whether results go to stdout meanwhile: no bar between them on a terminal.
    quiet : bool
        Whether there is none anyway.

    Examples
    --------
    >>> with progress(1000, "variants") as advance:  # nothing is drawn: no terminal
    ...     advance(500)
    """
    if quiet or (beside_stdout and _is_terminal(sys.stdout)):
        yield lambda count: None  # noqa: ARG005
        return
    if not _is_watched():
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
    """Lines where nobody looks at a bar; none where it is not known how much there is."""
    began, done = time.monotonic(), 0

    def advance(count: int) -> None:
        nonlocal done
        done += count

    def said() -> str:
        return f"{unit}: {done_text(done / total, time.monotonic() - began)}" if total else ""

    with telling(said):
        yield advance


def _is_watched() -> bool:
    """Whether stderr is a terminal that a bar can be drawn on."""
    return _is_terminal(sys.stderr) and os.environ.get("TERM") != "dumb"


def _is_terminal(stream: TextIO | None) -> bool:
    return stream is not None and stream.isatty()


def _bar(unit: str) -> Progress:
    """The bar; it vanishes when it is closed, and what is said then stands in its place."""
    from rich import progress as parts
    from rich.text import Text

    from vstatics.core.cli.shared.console import SafeConsole

    class Rate(parts.ProgressColumn):
        """How many a second; of what, stands before it."""

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
