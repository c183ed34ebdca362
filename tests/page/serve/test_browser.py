"""The page that is served, in a browser: edit, see, save, undo, and what others do meanwhile.

The box: a set of ratio u = -78/30 whose ring is held has the ratio 1 - u between sun and carrier.
"""

import shutil
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES
from tests.page.serve.served import BOX
from tests.page.serve.windows import Program, Window, served

pytestmark = pytest.mark.slow
NewWindow = Callable[[], Window]
RATIO = 1 + 78 / 30
"""Ratio of the gear `low` in the file."""


def test_what_is_edited_is_seen_saved_and_undone(program: Program, window: NewWindow) -> None:
    here = window()
    assert here.shows() == set()
    assert here.ratio() == pytest.approx(RATIO)
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
    here.has_ratio(RATIO)
    assert here.shows() == {"save", "revert"}
    here.page.click("#revert")
    here.has_ratio(4)
    assert program.file.read_text("utf-8") == saved


def test_a_slider_and_its_field_are_one_number(window: Callable[[], Window]) -> None:
    here = window()
    drag = "(one) => { for (const value of [-3, -3.5, -4]) { one.value = value; "
    drag += "one.dispatchEvent(new Event('input', {bubbles: true})); } }"
    here.page.eval_on_selector('input.slider[data-path="P1.ratio"]', drag)
    here.has_ratio(5)
    assert float(here.field("P1.ratio")) == -4
    here.page.click("#undo")  # one step, however long somebody drags
    here.has_ratio(RATIO)
    assert here.shows() == set()


def test_a_decimal_comma_is_saved_as_a_point_and_what_is_no_number_not_at_all(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    here.type("P1.ratio", "-2,5")
    here.has_ratio(3.5)
    here.type("P1.efficiency", "0,9x")
    assert here.page.locator(".unread").count() == 1
    here.page.click("#save")
    here.until("document.getElementById('save').hidden")
    assert program.file.read_text("utf-8") == BOX.replace("-78/30", "-2.5")
    assert here.field("P1.efficiency") == "0,9x"  # it is still to be mended, and told
    assert here.page.locator(".unread").count() == 1
    here.type("P1.ratio", "2,5,1")
    here.page.click("#undo")
    here.has_ratio(RATIO)
    here.page.click("#revert")
    here.has_ratio(3.5)
    assert float(here.field("P1.ratio")) == -2.5
    assert float(here.field("P1.efficiency")) == 0.97
    assert here.page.locator(".unread").count() == 0


def test_a_wrong_number_is_reported_with_its_place_and_the_good_page_stays(
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
    assert here.ratio() == pytest.approx(RATIO)
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
    before = here.top("tables")
    program.file.write_text(BOX.replace("-78/30", "-2"), "utf-8")
    here.has_ratio(3)
    here.page.wait_for_timeout(300)
    assert abs(here.top("tables") - before) < 40
    assert here.page.evaluate("location.hash") == "#gear=direct"
    assert here.page.get_attribute(".chooser [aria-current]", "data-choose") == "direct"
    assert float(here.field("P1.ratio")) == -2
    program.file.write_text(BOX.replace("gears:", "gaers:"), "utf-8")
    here.state("error")
    assert "box.yaml:6:1: error: " in here.page.inner_text("#errors")
    assert here.ratio() == 3
    program.file.write_text(BOX.replace("direct:", "top:"), "utf-8")
    here.page.wait_for_selector(".chooser [data-choose=top]")  # another page
    here.state("good")


def test_two_windows_follow_each_other(window: Callable[[], Window]) -> None:
    one, other = window(), window()
    one.type("P1.ratio", "-3")
    one.has_ratio(4)
    other.page.wait_for_timeout(300)
    assert other.ratio() == pytest.approx(RATIO)  # not saved yet
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
    program.file.write_text(newer, "utf-8")
    here.state("conflict")
    shown = {"conflict", "keep-mine", "take-file"}
    assert here.shows(*shown) == shown
    here.page.click("#save")  # is no way around
    here.page.wait_for_timeout(300)
    assert program.file.read_text("utf-8") == newer
    here.page.click(f"#{choice}")
    here.state("good")
    here.has_ratio(4 if choice == "keep-mine" else RATIO)
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


def test_a_page_whose_program_has_ended_says_so(program: Program, window: NewWindow) -> None:
    here = window()
    assert not here.page.is_visible(".when-gone")
    here.type("P1.ratio", "-3")
    here.has_ratio(4)
    assert program.end() == (0, "")
    here.state("gone")
    assert here.field("P1.ratio") == "-3"
    assert here.page.is_visible(".when-gone")


@pytest.mark.parametrize("seconds", [0, 0.1, 0.3, 0.5])
def test_ctrl_c_ends_it_without_a_word_while_processes_start(
    program: Program, seconds: float
) -> None:
    time.sleep(seconds)
    assert program.end() == (0, "")


def test_sections_come_and_go_with_a_number_without_a_new_page(
    browser: Any, tmp_path: Path
) -> None:
    """A split of other speeds has no shifts whose work could be told: that section leaves."""
    file = Path(shutil.copy(CASES / "power-split.yaml", tmp_path))
    with served(browser, file) as here:
        before = here.sections()
        here.page.evaluate("window.same = true")
        here.page.evaluate("document.getElementById('conventions').scrollIntoView()")
        top = here.top("conventions")
        original = here.field("power split.ratio")
        field = "document.querySelector('input.field[data-path=\"power split.ratio\"]')"
        typed = f"{field}.dispatchEvent(new Event('input', {{ bubbles: true }}))"
        here.page.evaluate(f"{field}.value = 1.5; {typed}")
        here.until("!document.getElementById('shifts')")
        assert here.sections() == [one for one in before if one != "Shifts"]
        assert abs(here.top("conventions") - top) < 40
        assert here.page.locator(".save", has_text="JSON").count() == 0  # the tools have theirs
        assert here.page.locator("[data-save=json]").first.is_visible()
        here.type("power split.ratio", original)
        here.until("document.getElementById('shifts')")
        assert here.sections() == before
        assert here.page.evaluate("window.same")
        here.type("power split.ratio", "1.5")
        here.until("!document.getElementById('shifts')")
        revision = int(here.page.get_attribute("html", "data-revision"))
        here.page.reload()  # edits stay, and are shown at once
        here.page.wait_for_selector("html[data-ready]")
        here.until("!document.getElementById('shifts')")
        assert int(here.page.get_attribute("html", "data-revision")) > revision
        assert here.field("power split.ratio") == "1.5"


def test_a_run_is_on_the_page_of_its_scenario(browser: Any, tmp_path: Path) -> None:
    """The brake locks where its capacity and the outside torques stop the ring; later with less."""
    text = (CASES / "scenarios/tarasik-set-lock.yaml").read_text("utf-8").replace("../", "")
    (tmp_path / "lock.yaml").write_text(text, "utf-8")
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


def test_units_and_the_link_stay_when_the_file_is_saved_and_the_page_loaded_again(
    program: Program, window: Callable[[], Window]
) -> None:
    here = window()
    here.page.select_option("#units", "si")
    here.page.fill("#links", "carrier")
    speed = "document.querySelector('td[data-result=speeds][data-row={}][data-gear=low]')"
    cell, rest = speed.format("carrier"), speed.format("sun") + ".closest('tr').hidden"
    for ratio, load in ((-3, 3000), (-4, 1500)):
        text = BOX.replace("-78/30", str(ratio)).replace("3000 rpm", f"{load} rpm")
        program.file.write_text(text, "utf-8")
        here.until(f"Math.abs(Number({cell}.dataset.number) - 1 / (1 - {ratio})) < 1e-9")
        here.until(f"{cell}.textContent === '{load / (1 - ratio):.1f}' && {rest}")
    here.page.reload()
    here.page.wait_for_selector("html[data-ready]")
    here.until(f"{cell}.textContent === '300.0' && {rest}")
    assert here.page.input_value("#units") == "si"
    assert here.page.input_value("#links") == "carrier"
