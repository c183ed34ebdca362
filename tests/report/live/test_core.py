"""The page calculates what the program calculates, wherever its sliders stand; else it says so.

What is expected at other numbers is the program's own result for a case with these numbers.
"""

from __future__ import annotations

import json
import statistics
from pathlib import Path
from random import Random
from typing import Any

import pytest

from tests.commands import CASES
from tests.report.live.places import is_equal, place, powers, program
from tests.report.pages import report
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission, load, loads, solve
from vstatics.elements import Drawing, Element, transmission
from vstatics.report import gather
from vstatics.report.live.lowered import RESULTS, lowered
from vstatics.report.live.page import live_fields, live_page
from vstatics.sweep.variants.path_numbers import known_paths

SHIPPED = sorted(one.name for one in CASES.iterdir() if one.suffix in (".yaml", ".dat"))
MOVE = """([at, path]) => {
  const slider = document.querySelector(`.slider[data-path="${CSS.escape(path)}"]`);
  slider.value = at;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  return Number(slider.value);
}"""
CALCULATED = """(places) => {
  const sliders = [...document.querySelectorAll(".slider")];
  const c = JSON.parse(document.getElementById("lowered").textContent);
  return places.map((numbers) => {
    const there = {};
    for (const one of sliders) { one.value = numbers[one.dataset.path]; there[one.dataset.path] = Number(one.value); }
    return [there, transmission.calculate(c, there)];
  });
}"""
SHOWN = """() => Object.fromEntries([...document.querySelectorAll("[data-result][data-gear]")].map(
  ({ dataset: one }) => [JSON.stringify([one.result, one.row ?? null, one.gear]), one.number]))"""


@pytest.fixture
def page(browser: Any) -> Any:
    """A window that tells errors of its scripts."""
    window = browser.new_page(viewport={"width": 1280, "height": 900})
    errors: list[str] = []
    window.on("pageerror", lambda error: errors.append(str(error)))
    yield window
    window.close()
    assert not errors


def opened(page: Any, case: Transmission) -> None:
    page.set_content(live_page(gather(solve(case), has_marks=True)))


def compared(page: Any, case: Transmission, count: int, chance: Random) -> None:
    """Compare the page with the program where the case stands, and at other places."""
    known = lowered(case)
    fields = [*live_fields(case, known["numbers"])]
    places = [known["numbers"], *(place(fields, chance) for _ in range(count))]
    left_out = 0
    for at, (numbers, gears) in enumerate(page.evaluate(CALCULATED, places)):
        expected = program(case, numbers, with_flow=at < WITH_FLOW)
        for number, own in enumerate(gears):
            if expected is None or expected[number]["fails"]:
                assert own["outside"], (number, numbers)
            elif own.get("outside") in NOT_TRIED:
                left_out += 1
            else:
                differ(known, number, own, expected[number], numbers)
    assert left_out <= count * len(case.gears) / 20


WITH_FLOW = 12
"""At so many places powers are compared, too."""
NOT_TRIED = (
    "losses that depend on load",
    "freewheels in more than one state",
    "too many signs",
    "nearly singular",
    "rounding",
    "a power turns",
)


def differ(known: Any, number: int, own: Any, told: Any, numbers: Any) -> None:
    """Say the first result of a gear that is not the program's."""
    for one in RESULTS:
        if one.key in told and one.key != "power_balance":  # that is nothing but rounding
            unit = known["results"][one.key]["unit"]
            scale = known["gears"][number]["scales"].get(unit) if unit else 1
            mine = [
                None if x is None or scale is None else x * scale for x in own[one.of or one.name]
            ]
            pairs = [*zip(mine, told[one.key], strict=True)]
            assert all(is_equal(*pair) for pair in pairs), (one.key, number, pairs, numbers)
    flow = told["flow"]
    if flow is None:
        return
    for key, side in (("power", flow.ideal), ("lossy_power", flow.lossy)):
        for row, power in powers(side).items():
            assert is_equal(own[key].get(row, 0), power), (key, row, number, numbers)
    for node, loss in flow.lossy.losses.items() if flow.lossy else ():
        assert is_equal(own["power_loss"][f"{node.kind} {node}"], loss), (node, number, numbers)


@pytest.mark.usefixtures("without_pictures")
def test_the_page_calculates_as_the_program_does(page: Any) -> None:
    """Freewheels and friction that locks, signs that turn, planets that are links."""
    for name in ("simpson-th400.yaml", "self-locking.yaml", "umdm.yaml"):
        case = load(CASES / name)
        opened(page, case)
        compared(page, case, 4, Random(name))  # noqa: S311


@pytest.mark.usefixtures("without_pictures")
def test_it_does_so_for_what_no_shipped_case_has(page: Any) -> None:
    """Friction of teeth, a worm, a variator, a converter, drag, an elastic shaft, coasting."""
    links = {"sun": 1, "ring": 2, "carrier": 3}
    elements = [
        Element("P", "planetary", links, {"sun": 30, "ring": 75}),
        Element("pair", "internal_pair", {"first": 3, "second": 4}, {"first": 20, "second": 61}),
        Element("W", "worm", {"worm": 5, "wheel": 4}, {"worm": 2, "wheel": 41}, None, 0.8, 0.7),
    ]
    drawing = Drawing(5, elements, mesh_efficiency={"friction": 0.07})
    brake = ShiftElement(2, 0, "B", drag=0.02)
    drawn = transmission(
        drawing, shift_elements=[brake], gears=[Gear([1]), Gear([1], drag={4: 0.1}, coast=True)]
    )
    points = ((0.0, 2.2), (0.5, 1.5), (0.9, 1.0))
    mechanisms = [
        Mechanism(1, 2, 0, 0.6, kind="converter", points=points, name="C"),
        Mechanism(2, 3, 0, -0.4, 0.9, kind="variator", name="V"),
        Mechanism(3, 4, 5, -2.0, 0.97, name="S"),
    ]
    given = Gear(speeds={5: 0.1}, drag={2: 0.01})
    shaft = Spring({5: 1, 6: -1}, stiffness=1e4)
    free = Transmission(6, [], mechanisms, [given], output=4, springs=[shaft])
    for case in (drawn, free):
        opened(page, case)
        compared(page, case, 40, Random(5))  # noqa: S311


@pytest.mark.slow
@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("name", SHIPPED)
def test_each_shipped_case_at_200_places_of_its_sliders(page: Any, name: str) -> None:
    case = load(CASES / name)
    opened(page, case)
    compared(page, case, 200, Random(name))  # noqa: S311


@pytest.mark.usefixtures("without_pictures")
def test_what_is_shown_follows_a_slider_and_goes_back(page: Any) -> None:
    case = load(CASES / "simpson.yaml")
    opened(page, case)
    first = page.evaluate(SHOWN)
    path = next(one for one in lowered(case)["numbers"] if one.endswith(".ratio"))
    there = page.evaluate(MOVE, [-2.3, path])
    expected = program(case, lowered(case)["numbers"] | {path: there})
    assert expected
    shown = page.evaluate(SHOWN)
    for number, gear in enumerate(case.gears):
        key = json.dumps(["ratio", None, gear.name], separators=(",", ":"))
        assert is_equal(float(shown[key]), expected[number]["ratio"][0])
    assert page.locator("[data-changed]").count() > 4
    assert page.locator("#outside").is_hidden()
    page.evaluate(MOVE, [0, path])
    assert page.locator("#outside").inner_text() == "outside: run the program"
    page.locator("#revert").click()
    assert page.evaluate(SHOWN).keys() == first.keys()
    assert page.locator("[data-changed]").count() == 0
    assert page.locator("#outside").is_hidden()


@pytest.mark.usefixtures("without_pictures")
def test_numbers_that_no_case_can_have_are_told_by_their_name(page: Any) -> None:
    """Those that the program refuses, too; nothing is told of teeth where there are none."""
    links = {"sun": 1, "ring": 2, "carrier": 3}
    sets = [
        Element("P", "planetary", links, {"sun": 30, "ring": 75}),
        Element("W", "worm", {"worm": 4, "wheel": 3}, {"worm": 2, "wheel": 41}, None, 0.8, 0.7),
    ]
    drawn = transmission(Drawing(4, sets), gears=[Gear([1])], shift_elements=[ShiftElement(2, 0)])
    bare = Transmission(2, [], [Mechanism(1, 2, 0, -2.6, 0.97, name="D")], [Gear()])
    wrong: list[tuple[Transmission, dict[str, list[float]]]] = [
        (bare, {"D.ratio": [0], "D.efficiency": [0, 1.2, -0.5]}),
        (drawn, {"P.teeth.sun": [-30, 0], "W.efficiency": [1.5], "W.back_efficiency": [-0.1, 2]}),
    ]
    for case, by_path in wrong:
        opened(page, case)
        for path, value in ((path, value) for path, found in by_path.items() for value in found):
            assert program(case, lowered(case)["numbers"] | {path: value}) is None
            page.fill(f'input.field[data-path="{path}"]', str(value))
            assert page.locator("#outside").is_visible()
            why = page.locator("#why-outside").inner_text()
            assert why.startswith(f"{path} = {value}: expected a "), why
            page.locator("#revert").click()
            assert page.locator("#outside").is_hidden()


@pytest.mark.usefixtures("without_pictures")
def test_numbers_bear_the_paths_of_a_sweep_and_the_core_is_small(page: Any) -> None:
    for name in ("ford-10r80.yaml", "umdm.yaml", "power-split.yaml", "mzkt7922.dat"):
        case = load(CASES / name)
        assert lowered(case)["numbers"].keys() <= {*known_paths(case)}
    opened(page, case)
    assert len(page.evaluate("document.getElementById('core').textContent")) <= 25_000


@pytest.mark.slow
def test_a_ten_speed_follows_within_16_ms(page: Any, tmp_path: Path) -> None:
    file = tmp_path / "live.html"
    file.write_text(report(CASES / "ford-10r80.yaml", "--live"), encoding="utf-8")
    page.goto(file.as_uri())
    times = page.evaluate(
        """() => [...Array(60).keys()].map((n) => {
          const slider = document.querySelector('.slider[data-path="P1.teeth.sun"]'), start = performance.now();
          slider.value = 40 + (n % 8);
          slider.dispatchEvent(new Event("input", { bubbles: true }));
          document.body.getBoundingClientRect();
          return performance.now() - start;
        })"""
    )
    assert statistics.median(times[20:]) < 16


DRAGGING = """\
links: [in, ring, out]
load: {speed: 3000 rpm, torque: 100 N*m}
drag: {out: "0.5 + 0.01*w"}
shift_elements: {B: {links: [ring, housing], drag: [[0, 0], [400, 4]]}, C: [in, ring]}
mechanisms: {P: {first: in, second: ring, third: out, ratio: -2.5, efficiency: 0.97}}
gears: {low: [B], direct: [C]}
"""


@pytest.mark.slow
@pytest.mark.usefixtures("without_pictures")
def test_where_losses_depend_the_numbers_of_the_program_stand_until_a_slider_moves(
    page: Any,
) -> None:
    """Then ratios and speeds follow, which no loss changes, and efficiencies are not known."""
    case = loads(DRAGGING)
    results = solve(case)
    opened(page, case)
    first = page.evaluate(SHOWN)
    for gear, efficiency in zip(("low", "direct"), results.efficiency.tolist(), strict=True):
        key = json.dumps(["ETA", None, gear], separators=(",", ":"))
        assert float(first[key]) == pytest.approx(efficiency, abs=1e-12)
    assert page.locator("#why-outside").inner_text().startswith("losses that depend on load (low,")
    there = page.evaluate(MOVE, [-3, "P.ratio"])
    moved = page.evaluate(SHOWN)
    again = solve(loads(DRAGGING.replace("-2.5", str(there))))
    keys = [json.dumps([key, None, "low"], separators=(",", ":")) for key in ("ratio", "ETA")]
    assert float(moved[keys[0]]) == pytest.approx(again.ratio.tolist()[0])
    assert moved[keys[1]] == ""
    speeds = {row: json.dumps(["W", row, "low"], separators=(",", ":")) for row in case.link_names}
    for (row, key), speed in zip(speeds.items(), again.speeds[0].tolist(), strict=True):
        assert float(moved[key]) == pytest.approx(speed), row
    page.locator("#revert").click()
    assert page.evaluate(SHOWN) == first
