"""The page that is served, in a browser: edit, see, save, undo, and what others do meanwhile.

The box: a set of ratio u = -78/30 whose ring is held has the ratio 1 - u between sun and carrier.
"""

from __future__ import annotations

import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES
from tests.serve.served import BOX

pytestmark = pytest.mark.slow
SECONDS = 30
"""So long something may take."""


started: list[Program] = []


@pytest.fixture(autouse=True)
def _ended() -> Iterator[None]:
    """No program outlives its test."""
    yield
    while started:
        if (left := started.pop()).process.poll() is None:
            left.end()


class Program:
    """`vstatics serve`, as a process of its own."""

    def __init__(self, file: Path, *words: str) -> None:
        self.file = file
        command = [sys.executable, "-m", "vstatics", *(words or ["serve"]), str(file)]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        assert self.process.stdout is not None
        started.append(self)
        self.address = self.process.stdout.readline().strip()

    def end(self) -> tuple[int, str]:
        """End it by Ctrl-C: its status, and what it said."""
        self.process.send_signal(signal.SIGINT)
        _, said = self.process.communicate(timeout=20)
        return self.process.returncode, said


class Window:
    """A window with the page."""

    def __init__(self, browser: Any, program: Program) -> None:
        self.context = browser.new_context()
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

    def shows(self, *names: str) -> set[str]:
        """Which of the parts of the panel are in sight."""
        names = names or ("save", "revert", "undo", "errors", "conflict", "outside")
        return {one for one in names if self.page.is_visible(f"#{one}")}


@pytest.fixture
def program(tmp_path: Path) -> Program:
    file = tmp_path / "box.yaml"
    file.write_text(BOX, encoding="utf-8")
    return Program(file)


@pytest.fixture
def window(browser: Any, program: Program) -> Iterator[Callable[[], Window]]:
    opened: list[Window] = []

    def new() -> Window:
        opened.append(Window(browser, program))
        return opened[-1]

    yield new
    for one in opened:
        assert not one.errors
        one.context.close()


def test_what_is_edited_is_seen_saved_and_undone(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    assert here.shows() == set()
    assert here.ratio() == pytest.approx(1 + 78 / 30)
    revision = int(here.page.get_attribute("html", "data-revision"))
    here.type("P1.ratio", "-3")
    here.has_ratio(4)
    assert int(here.page.get_attribute("html", "data-revision")) > revision
    for gear, count in (("low", 1), ("direct", 0)):
        changed = f'#gears [data-changed][data-result="ratio"][data-gear="{gear}"]'
        assert here.page.locator(changed).count() == count
    assert here.shows() == {"save", "revert", "undo"}
    assert program.file.read_text("utf-8") == BOX
    here.page.click("#save")
    here.until("document.getElementById('save').hidden")
    saved = BOX.replace("-78/30", "-3")
    assert program.file.read_text("utf-8") == saved
    assert here.shows() == {"undo"}
    here.page.click("#undo")  # the number that the file had before
    here.has_ratio(1 + 78 / 30)
    assert here.shows() == {"save", "revert"}
    here.page.click("#revert")
    here.has_ratio(4)
    assert program.file.read_text("utf-8") == saved


def test_a_slider_and_its_field_are_one_number(window: Callable[[], Window]) -> None:
    here = window()
    slider = 'input.slider[data-path="P1.ratio"]'
    drag = "(one) => { for (const value of [-3, -3.5, -4]) { one.value = value; "
    here.page.eval_on_selector(
        slider, drag + "one.dispatchEvent(new Event('input', {bubbles: true})); } }"
    )
    here.has_ratio(5)
    assert float(here.field("P1.ratio")) == -4
    here.page.click("#undo")  # one step, however long somebody drags
    here.has_ratio(1 + 78 / 30)
    assert here.shows() == set()


def test_a_wrong_number_is_told_with_its_place_and_the_good_page_stays(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    here.type("P1.efficiency", "0.95")
    here.until("document.documentElement.dataset.revision > 1")
    here.page.wait_for_timeout(600)  # a pause ends a step
    here.type("P1.efficiency", "7")
    here.state("error")
    told = here.page.inner_text("#errors").split("\n")
    column = BOX.split("\n")[4].index("efficiency: 0.97") + len("efficiency: ") + 1
    assert told[0].startswith(f"{program.file}:5:{column}: error: ")
    assert told[1][told[2].index("^")] == "7"
    assert here.ratio() == pytest.approx(1 + 78 / 30)
    here.page.click("#save")
    here.page.wait_for_timeout(500)
    assert program.file.read_text("utf-8") == BOX
    here.page.click("#undo")
    here.state("good")
    assert float(here.field("P1.efficiency")) == 0.95


def test_a_file_that_is_saved_is_shown_without_losing_the_place(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    here.page.set_viewport_size({"width": 900, "height": 500})
    here.page.click('.chooser a[data-choose="direct"]')
    here.page.evaluate("document.getElementById('tables').scrollIntoView()")
    here.page.wait_for_timeout(300)
    before = here.page.evaluate("document.getElementById('tables').getBoundingClientRect().top")
    program.file.write_text(BOX.replace("-78/30", "-2"), encoding="utf-8")
    here.has_ratio(3)
    here.page.wait_for_timeout(300)
    after = here.page.evaluate("document.getElementById('tables').getBoundingClientRect().top")
    assert abs(after - before) < 40
    assert here.page.evaluate("location.hash") == "#gear=direct"
    assert here.page.get_attribute(".chooser [aria-current]", "data-choose") == "direct"
    assert float(here.field("P1.ratio")) == -2
    program.file.write_text(BOX.replace("gears:", "gaers:"), encoding="utf-8")
    here.state("error")
    assert "box.yaml:6:1: error: " in here.page.inner_text("#errors")
    assert here.ratio() == 3
    program.file.write_text(BOX.replace("direct:", "top:"), encoding="utf-8")
    here.page.wait_for_selector(".chooser [data-choose=top]")  # another page
    here.state("good")


def test_two_windows_follow_each_other(window: Callable[[], Window]) -> None:
    one, other = window(), window()
    one.type("P1.ratio", "-3")
    one.has_ratio(4)
    other.page.wait_for_timeout(300)
    assert other.ratio() == pytest.approx(1 + 78 / 30)  # not saved yet
    one.page.click("#save")
    other.has_ratio(4)
    assert float(other.field("P1.ratio")) == -3
    assert other.shows() == set()


@pytest.mark.parametrize("choice", ["keep-mine", "take-file"])
def test_a_file_that_somebody_else_changed_meanwhile_loses_nothing(
    program: Program, window: Callable[[], Window], choice: str
) -> None:
    here = window()
    here.type("P1.ratio", "-3")
    here.has_ratio(4)
    newer = BOX.replace("0.97", "0.9") + "# new\n"
    program.file.write_text(newer, encoding="utf-8")
    here.state("conflict")
    assert {"conflict", "keep-mine", "take-file"} <= here.shows(
        "conflict", "keep-mine", "take-file"
    )
    here.page.click("#save")  # is no way around
    here.page.wait_for_timeout(300)
    assert program.file.read_text("utf-8") == newer
    here.page.click(f"#{choice}")
    here.state("good")
    here.has_ratio(4 if choice == "keep-mine" else 1 + 78 / 30)
    wanted = newer.replace("-78/30", "-3") if choice == "keep-mine" else newer
    assert program.file.read_text("utf-8") == wanted
    assert float(here.field("P1.efficiency")) == 0.9
    if choice == "take-file":
        here.page.click("#undo")
        here.has_ratio(4)


def test_pictures_come_when_they_are_looked_at(window: Callable[[], Window]) -> None:
    here = window()
    flow = '#power-flow div[data-gear="low"] .awaited'
    assert here.page.locator(f"{flow} svg").count() == 0
    here.page.evaluate("document.getElementById('power-flow').scrollIntoView()")
    here.until(f"""document.querySelector('{flow} svg')""")
    old = here.page.inner_html(flow)
    here.type("P1.ratio", "-3")
    here.until(f"document.querySelector('{flow}.pale svg')")
    here.page.evaluate("document.getElementById('power-flow').scrollIntoView()")
    here.until(f"document.querySelector('{flow}:not(.pale) svg')")
    assert here.page.inner_html(flow) != old


def test_a_page_whose_program_has_ended_says_so(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    assert not here.page.is_visible(".when-gone")
    here.type("P1.ratio", "-3")
    here.has_ratio(4)
    assert program.end() == (0, "")
    here.state("gone")
    assert here.field("P1.ratio") == "-3"
    assert here.page.is_visible(".when-gone")


def test_a_run_is_on_the_page_of_its_scenario(browser: Any, tmp_path: Path) -> None:
    """The brake locks where its capacity and the outside torques stop the ring; later with less."""
    text = (CASES / "scenarios/tarasik-set-lock.yaml").read_text("utf-8").replace("../", "")
    (tmp_path / "lock.yaml").write_text(text, encoding="utf-8")
    shutil.copy(CASES / "tarasik-set.yaml", tmp_path)
    running = Program(tmp_path / "lock.yaml")
    here = Window(browser, running)
    event = '[data-result="events"][data-row^="brake"]'
    here.until(f"""document.querySelector('{event}')""")
    first = float(here.page.get_attribute(event, "data-number"))
    assert first == pytest.approx(0.410054, abs=1e-5)  # as the scenario says itself
    here.page.focus("#time")
    here.page.keyboard.press("PageUp")  # by a tenth of a second
    here.page.keyboard.press("+")
    brake = 'document.querySelector("[data-element=brake]")'
    assert here.page.evaluate(f"{brake}.querySelectorAll('td')[2].dataset.number") == "-120"
    here.type("controls.brake.1.2", "150")
    here.until(f"""Number(document.querySelector('{event}').dataset.number) < {first} - 1e-3""")
    here.until(f"{brake}.querySelectorAll('td')[2].dataset.number === '-150'")
    assert here.page.text_content(".time-now") == "0.1000"
    assert here.page.is_enabled("[data-run=whole]")  # it is zoomed as before
    here.until("document.querySelector('.run-still svg')")  # for print
    assert not here.page.is_visible(".run-still")
    assert here.errors == []
    here.context.close()
    assert running.end() == (0, "")


def test_a_ten_speed_shows_its_numbers_soon_after_a_save(browser: Any, tmp_path: Path) -> None:
    file = tmp_path / "ford-10r80.yaml"
    shutil.copy(CASES / file.name, file)
    running = Program(file, "report", "--watch")
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/[\w-]{22,}/", running.address)
    here = Window(browser, running)
    text, took = file.read_text("utf-8"), []
    for sun in range(46, 52):
        before = here.page.get_attribute("html", "data-revision")
        assert before is not None
        begin = time.monotonic()
        file.write_text(text.replace("sun: 45", f"sun: {sun}"), encoding="utf-8")
        here.until(f"document.documentElement.dataset.revision !== '{before}'")
        took.append(time.monotonic() - begin)
        here.page.wait_for_timeout(100)
    here.context.close()
    assert running.end() == (0, "")
    print("seconds from a save to its numbers:", *(f"{one:.3f}" for one in took))  # noqa: T201
    assert min(took) < 2  # a machine that does nothing else takes less than 0.3 s
