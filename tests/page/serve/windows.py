"""A page that is served by a process of its own, and windows of a browser with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

PIPE = subprocess.PIPE
SECONDS = 30
"""So long something may take."""


started: list[Program] = []
"""Those that may still run."""


class Program:
    """`vstatics serve`, as a process group of its own."""

    def __init__(self, file: Path, *words: str) -> None:
        self.file = file
        command = [sys.executable, "-m", "vstatics", *(words or ["serve"]), str(file)]
        self.process = subprocess.Popen(
            command, stdout=PIPE, stderr=PIPE, text=True, start_new_session=True
        )
        assert self.process.stdout is not None
        started.append(self)
        self.address = self.process.stdout.readline().strip()

    def end(self) -> tuple[int, str]:
        """End it by Ctrl-C, as a terminal sends it to all its processes: its status, its words."""
        os.killpg(self.process.pid, signal.SIGINT)
        _, said = self.process.communicate(timeout=20)
        return self.process.returncode, said


class Window:
    """A window with the page."""

    def __init__(self, browser: Any, program: Program, **look: Any) -> None:
        self.context = browser.new_context(**look)
        self.page = self.context.new_page()
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(program.address)
        self.page.wait_for_selector("html[data-ready]")

    def until(self, says: str) -> None:
        """Wait for something that is so in the page, whose policy lets nobody else wait there."""
        end = time.monotonic() + SECONDS
        while not self.page.evaluate(f"Boolean({says})"):
            assert time.monotonic() < end, says
            self.page.wait_for_timeout(5)

    def state(self, wanted: str) -> None:
        """Wait until the page is in a state."""
        self.until(f"document.body.dataset.state === '{wanted}'")

    def ratio(self, gear: str = "low") -> float:
        """That of a gear, with all digits."""
        cell = self.page.locator(f'[data-result="ratio"][data-gear="{gear}"]').first
        return float(cell.get_attribute("data-number"))

    def has_ratio(self, wanted: float, gear: str = "low") -> None:
        """Wait until a gear has a ratio."""
        cell = f'[data-result="ratio"][data-gear="{gear}"]'
        number = f"document.querySelector('{cell}').dataset.number"
        self.until(f"Math.abs(Number({number}) - {wanted}) < 1e-9")

    def type(self, path: str, value: str) -> None:
        """Type a number into a field."""
        self.page.fill(f'input.field[data-path="{path}"]', value)

    def field(self, path: str) -> str:
        """What stands in a field."""
        return str(self.page.input_value(f'input.field[data-path="{path}"]'))

    def sections(self) -> list[str]:
        """The headings of all sections, which are those of the contents, too."""
        found: list[str] = self.page.locator("main > section > h2").all_text_contents()
        assert self.page.locator(".contents a").all_text_contents() == found
        return found

    def top(self, section: str) -> float:
        """How far below the top of the window a section begins."""
        place = f"document.getElementById('{section}').getBoundingClientRect().top"
        return float(self.page.evaluate(place))

    def shows(self, *names: str) -> set[str]:
        """Which of the parts of the panel are in sight."""
        names = names or ("save", "revert", "undo", "errors", "conflict")
        return {one for one in names if self.page.is_visible(f"#{one}")}


@contextmanager
def served(browser: Any, file: Path, **look: Any) -> Iterator[Window]:
    """A window with the page of a file, whose program ends with it."""
    program = Program(file)
    here = Window(browser, program, **look)
    yield here
    assert not here.errors
    here.context.close()
    program.end()


_COME_BY = """(() => {
  const next = [...document.querySelectorAll("main [data-awaited].pale")].find(
    (one) => one.checkVisibility() || "soon" in one.dataset);
  next?.scrollIntoView();
  return !next;
})()"""


def looked_through(here: Window) -> None:
    """Scroll to each part that is drawn when it is looked at, until all of them are there."""
    here.until(_COME_BY)
