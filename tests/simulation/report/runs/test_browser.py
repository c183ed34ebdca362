"""A run in its page, in a browser: what moves with the time is what `vstatics simulate` answers.

The run has two shifts of an eight-speed; its sets are simple, of numbers of teeth.
"""

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES, json_answer, vstatics
from tests.page.serve.windows import Program, looked_through, served
from vstatics import load, load_scenario

pytestmark = pytest.mark.slow
SCENARIO = CASES / "scenarios" / "8l90-shifts.yaml"
STEP = 0.01
"""A run for a page has 400 instants at least: 4 s of it."""
RPM = 30 / np.pi
AT = """(time) => {
  const slider = document.getElementById("time");
  slider.value = time;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const all = (chosen) => Object.fromEntries([...document.querySelectorAll(chosen)].map(
    ({ dataset: one }) => [one.link ?? one.heading, Number(one.number)]));
  return [Number(document.querySelector(".run-moves").dataset.time),
    all(".speeds-now td[data-link]"), all(".levers-now g[data-link]"),
    all(".run-legend b[data-number]")];
}"""


@pytest.fixture
def program() -> Iterator[Program]:
    running = Program(SCENARIO)
    yield running
    running.end()


@pytest.fixture(scope="module")
def answer() -> dict[str, Any]:
    told = vstatics("simulate", str(SCENARIO), "--time-step", str(STEP), "-f", "json", "-q")
    made: dict[str, Any] = told.json
    return made


@pytest.fixture(scope="module")
def table() -> dict[str, list[float]]:
    told = vstatics("simulate", str(SCENARIO), "--time-step", str(STEP), "-f", "csv", "-q")
    head, *rows = csv.reader(io.StringIO(told.out))
    return dict(zip(head, (list(map(float, one)) for one in zip(*rows, strict=True)), strict=True))


@pytest.fixture
def page(browser: Any) -> Iterator[Any]:
    size = {"width": 1200, "height": 900}
    with served(browser, SCENARIO, viewport=size, accept_downloads=True) as here:
        here.page.wait_for_selector(".run-moves", state="visible")
        looked_through(here)
        yield here.page


DRAWN = """() => {
  globalThis.drawn = [];
  const { fillText } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
    globalThis.drawn.push(text);
    return fillText.call(this, text, ...place);
  };
}"""


@pytest.mark.parametrize("locale", ["en", "de", "ru"])
def test_axes_have_a_decimal_point_and_no_marks_for_thousands(
    browser: Any, program: Program, table: dict[str, list[float]], locale: str
) -> None:
    """In a browser of any language, as the tables: 2,000 or 2.000 would be read as two."""
    context = browser.new_context(locale=locale)
    window = context.new_page()
    window.add_init_script(f"({DRAWN})()")
    window.goto(program.address)
    window.wait_for_selector(".run-moves", state="visible")
    assert len(window.evaluate("drawn")) > 20
    texts = {one.replace("\u2212", "-") for one in window.evaluate("drawn")}
    numbers = {float(one) for one in texts if re.fullmatch(r"-?[\d.,\s]+", one)}
    assert texts >= {f"{one:g}" for one in numbers}
    fastest = max(np.ptp(each) for head, each in table.items() if head.startswith("speeds")) * RPM
    assert 1000 < max(numbers) < 2 * fastest
    assert any(one % 1 for one in numbers)
    context.close()


def test_speeds_at_any_time_are_those_of_the_run(page: Any, answer: dict[str, Any]) -> None:
    """Straight lines between the instants of the page are as near as it says, half of 1e-3."""
    chance, time = Random(31), answer["time"]  # noqa: S311 - places
    assert "within 0.0005 of the range" in page.text_content(".run-moves")
    for wanted in sorted(chance.uniform(0, 4) for _ in range(60)):
        at, table, levers, lines = page.evaluate(AT, wanted)
        assert at == pytest.approx(wanted, abs=1e-12)
        assert len(levers) == len(table) == len(answer["speeds"])
        for link, speeds in answer["speeds"].items():
            expected = np.interp(at, time, speeds)
            near = 5e-4 * np.ptp(speeds) + 1e-9
            assert table[link] == pytest.approx(expected, abs=near), (link, at)
            assert levers[link] == table[link]
        for link in ("input", "output", "ring 2"):
            assert (
                lines[f"speeds[{link}]" if " " not in link else f'speeds["{link}"]'] == table[link]
            )


def test_keys_go_from_instant_to_instant_with_all_digits(page: Any, answer: dict[str, Any]) -> None:
    """Right from the start, then with Shift to the events; left and right choose no gear there."""
    known = {time: place for place, time in enumerate(answer["time"])}  # of a jump the second
    gear = page.get_attribute(".chooser [aria-current]", "data-choose")
    page.focus("#time")
    for key, presses in (("ArrowRight", 12), ("Shift+ArrowRight", 4), ("ArrowLeft", 3), ("End", 1)):
        for _ in range(presses):
            page.keyboard.press(key)
            at = float(page.get_attribute(".run-moves", "data-time"))
            if key.startswith("Shift"):
                assert at in {event["time"] for event in answer["events"]}
            for link, speeds in answer["speeds"].items():
                shown = page.get_attribute(f'.speeds-now [data-link="{link}"]', "data-number")
                assert float(shown) == speeds[known[at]]
    assert at == answer["time"][-1]
    assert page.get_attribute(".chooser [aria-current]", "data-choose") == gear


def test_the_points_of_a_lever_are_on_a_line(page: Any) -> None:
    """Willis: speeds over the carrier's are as the numbers of teeth.

    So points at true distances have their speeds on a straight line.
    """
    case = load_scenario(SCENARIO).case
    for time in (0.3, 0.85, 2.65, 3.9):
        _, speeds, *_ = page.evaluate(AT, time)
        for one in case.mechanisms:
            first, second, third = (
                speeds[case.link_name(link)] if link else 0 for link in one.links
            )
            assert first - third == pytest.approx(one.ratio * (second - third), abs=1)
        for points in page.eval_on_selector_all(
            ".levers-now .through", "(all) => all.map((one) => one.getAttribute('points'))"
        ):
            (x, y), (middle, z), (end, last) = (
                map(float, one.split(",")) for one in points.split()
            )
            assert middle == pytest.approx(x + (end - x) * (z - y) / (last - y), abs=0.1)


def test_elements_have_the_colour_of_what_they_do(page: Any) -> None:
    """As the events say: A slips from .797 s to where C locks at .902 s, and is open then."""
    events = json_answer("simulate", str(SCENARIO), "-q")["events"]
    slips = next(one["time"] for one in events if (one["element"], one["event"]) == ("A", "slips"))
    locks = next(one["time"] for one in events if (one["element"], one["event"]) == ("C", "locks"))
    colour = """([name, kind]) => {
      const part = document.querySelector(`.stick-now g.element[data-name="${name}"] path`);
      const probe = document.createElement("i");
      probe.style.color = `var(--${kind})`;
      document.body.append(probe);
      const is = [getComputedStyle(part).stroke, getComputedStyle(probe).color];
      probe.remove();
      return is[0] === is[1];
    }"""
    kinds = {"sticks": "engaged", "slips": "lost", "open": "soft"}
    for time, states in (
        (slips - 0.01, {"A": "sticks", "C": "slips", "B": "sticks"}),
        ((slips + locks) / 2, {"A": "slips", "C": "slips", "B": "sticks"}),
        (locks + 0.01, {"A": "open", "C": "sticks", "B": "sticks"}),
    ):
        page.evaluate(AT, time)
        for name, state in states.items():
            row = page.locator(f'.states-now [data-element="{name}"]')
            assert row.get_attribute("data-state") == state
            assert page.evaluate(colour, [name, kinds[state]]), (time, name, state)


def test_a_drag_zooms_all_panels_and_a_double_click_takes_it_back(page: Any) -> None:
    seen = """() => [...document.querySelectorAll(".run-plot")].map((one) =>
      [...one.querySelectorAll(".run-cursor")].filter((cursor) => !cursor.hidden).length)"""
    page.evaluate(AT, 3.9)
    panels = page.locator(".run-panel")
    assert set(page.evaluate(seen)) == {1}
    over = panels.nth(1).locator(".u-over")
    over.scroll_into_view_if_needed()
    box = over.bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.2, box["y"] + 40)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.3, box["y"] + 40, steps=4)
    page.mouse.up()
    page.mouse.move(5, 5)
    page.wait_for_timeout(200)
    assert float(page.get_attribute(".run-moves", "data-time")) == pytest.approx(3.9)
    assert set(page.evaluate(seen)) == {0}  # what is chosen is out of sight in all of them
    over.dblclick(position={"x": 100, "y": 40})
    page.wait_for_timeout(200)
    assert set(page.evaluate(seen)) == {1}
    assert page.is_disabled("[data-run=whole]")
    over.click(position={"x": box["width"] / 2, "y": 40})
    assert float(page.get_attribute(".run-moves", "data-time")) == pytest.approx(2, abs=0.02)
    assert page.evaluate("document.activeElement.id") == "time"


def test_csv_has_the_instants_that_are_seen_of_open_panels(
    page: Any, table: dict[str, list[float]]
) -> None:
    """Each line of it is one of the run, to the last digit."""
    page.evaluate(AT, 0.9)
    page.focus("#time")
    for key in ("+", "+"):
        page.keyboard.press(key)
    low, high = 0.9 - 0.9 / 4, 0.9 + (4 - 0.9) / 4
    page.locator('.run-panel[data-panel="heat"] > summary').first.click()
    page.wait_for_timeout(200)
    with page.expect_download() as loading:
        page.click("[data-run=csv]")
    head, *rows = csv.reader(io.StringIO(Path(loading.value.path()).read_text("utf-8")))
    assert {"time", "speeds[input]", "slips[A]", "torques[B]", "capacities[C]"} <= {*head}
    assert "heat[C]" not in head
    assert any(one.startswith("losses[") for one in head)  # of the panel of heat that is open
    common = [one for one in head if one in table]
    assert len(common) > 12
    whole = {*zip(*(table[one] for one in common), strict=True)}
    lines = [dict(zip(head, map(float, row), strict=True)) for row in rows]
    assert len(lines) > 30
    assert all(tuple(line[one] for one in common) in whole for line in lines)
    times = [line["time"] for line in lines]
    assert low <= times[0] < low + 0.1
    assert high - 0.3 < times[-1] <= high


def test_print_has_the_picture_that_the_screen_has_not(page: Any) -> None:
    assert not page.is_visible(".run-still svg")
    page.emulate_media(media="print")
    assert page.is_visible(".run-still svg")
    assert not page.is_visible(".run-moves")


def test_the_plotter_has_its_licence(page: Any) -> None:
    text = page.content()
    assert "Copyright (c) 2022 Leon Sorokin" in text
    assert "The above copyright notice and this permission notice shall be included" in text


def test_a_phone_has_nothing_beside_the_screen(browser: Any, program: Program) -> None:
    window = browser.new_page(viewport={"width": 390, "height": 844}, color_scheme="dark")
    window.goto(program.address)
    window.wait_for_selector(".run-moves", state="visible")
    wide = "(one) => one.getBoundingClientRect().right"
    assert max(window.eval_on_selector_all(".run-moves *", f"(all) => all.map({wide})")) <= 391
    window.close()


def test_a_run_and_its_plotter_stay_out_of_pages_that_do_not_move(tmp_path: Path) -> None:
    made = tmp_path / "still.html"
    name = str(CASES / "scenarios" / "tarasik-set-lock.yaml")
    assert vstatics("report", name, "-o", str(made), "-q").status == 0
    text = made.read_text("utf-8")
    assert "uPlot" not in text
    assert "run-moves" not in text
    assert load(CASES / "tarasik-set.yaml").name in text
