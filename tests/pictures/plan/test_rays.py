"""Generalised kinematic plans: their rays and gears, also without a case, from desired ratios.

The rays of the UMDM follow from its plan (Voloshko, Galimyanov, Salakhov, Mavleev, Kinematic
and force analysis of the universal multi-flow differential mechanism, figure 5): all meet at
(1, 1), so a link that is stopped in the gear of ratio u has the ray (u*x - 1)/(u - 1). The
ratios are those of the teeth in `cases/umdm.yaml` by its equations (5) to (8).
"""

import re
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES, SHIPPED, vstatics
from tests.installed import needs
from tests.pictures.drawn import WITHOUT_PLAN, titled
from tests.shipped import shipped_results
from vstatics import CaseError, Gear, Mechanism, Results, ShiftElement, Transmission, loads, solve
from vstatics.pictures import picture
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.plan.rays import plans
from vstatics.pictures.plan.wanted import case_of_ratios

NAMES = [path.name for path in SHIPPED]


@pytest.fixture(scope="module")
def umdm() -> Results:
    return shipped_results("umdm.yaml")


def links(results: Results, numbers: tuple[int, ...]) -> str:
    return " = ".join(results.case.link_name(link) for link in numbers)


RATIOS = {"sun 4": 1147 / 756, "carrier": 37 / 14, "ring 6": 111 / 65, "ring 7": -37 / 9}
"""u of each gear of the UMDM, in which this link is held: sun 1 in, ring 8 out."""


def test_rays_of_the_umdm_follow_from_its_ratios(umdm: Results) -> None:
    """Zero 1/u, ordinate -1/(u - 1) at the origin and slope u/(u - 1)."""
    [plan] = plans(umdm)
    rays = {links(umdm, ray.links): ray for ray in plan.rays}
    for link, u in RATIOS.items():
        ray = rays[link]
        expected = 1 / u, -1 / (u - 1), u / (u - 1)
        assert (-ray.start / ray.slope, ray.start, ray.slope) == pytest.approx(expected)
    assert (rays["sun 1"].start, rays["sun 1"].slope) == pytest.approx((1, 0))
    assert (rays["ring 8"].start, rays["ring 8"].slope) == pytest.approx((0, 1))
    assert plan.has_unit_point
    assert [ray.at(1.0) for ray in plan.rays] == pytest.approx([1.0] * 6)
    ratios = [37 / 14, 111 / 65, 1147 / 756, 1, -37 / 9]
    assert [1 / mark.output for mark in plan.marks] == pytest.approx(ratios)


def test_the_picture_draws_these_rays(umdm: Results) -> None:
    """On its way from gear to gear the ray of a link is on the abscissa at 1/u."""
    said = titled(picture(umdm, "plan", Style()))
    places: dict[str, Any] = {title: line.get_xydata() for title, line in said}
    verticals = {title: at for title, at in places.items() if ": 1/i " in title}
    across = {float(text.split()[-1].replace("−", "-")): at[0][0] for text, at in verticals.items()}
    assert sorted(across) == pytest.approx([-9 / 37, 14 / 37, 65 / 111, 756 / 1147, 1], abs=5e-4)
    for link, u in RATIOS.items():
        [(x, rest)] = [at[0] for title, at in places.items() if title.endswith(f" holds {link}")]
        [ends] = [at for title, at in places.items() if title.startswith(f"{link}: ")]
        (x0, y0), (x1, y1) = ends
        assert x0 + (rest - y0) * (x1 - x0) / (y1 - y0) == pytest.approx(x, abs=0.01)
        near = min(across, key=lambda one: abs(one - 1 / u))
        assert across[near] == pytest.approx(x)


def test_a_link_has_its_colour_and_the_abscissa_reaches_as_far_as_the_gears() -> None:
    """Issue 16: one colour over all panels; T3 of the BelAZ, 1/i .168 and .250, was squeezed."""
    lines = titled(picture(shipped_results("belaz7516.yaml"), "plan", Style()))
    assert {one.get_color() for title, one in lines if title[:4] == "J5: "} == {Style().colour(4)}
    [ray] = [one.get_xydata() for title, one in lines if title == "J3: −2.030 + 12.12·(1/i)"]
    gears = [line for title, line in lines if title.startswith("gear") and "1/i" in title]
    inside = [x for x in (line.get_xydata()[0][0] for line in gears) if ray[0][0] < x < ray[1][0]]
    assert max(inside) - min(inside) > 0.8 * (ray[1][0] - ray[0][0])


@pytest.mark.parametrize("name", [name for name in NAMES if name not in WITHOUT_PLAN])
def test_speeds_on_a_vertical_are_those_of_its_gear(name: str) -> None:
    results = shipped_results(name)
    for plan in plans(results):
        for mark, ray in product(plan.marks, plan.rays):
            speeds = results.speeds[np.ix_(np.array(mark.gears) - 1, np.array(ray.links) - 1)]
            expected = np.where(np.isfinite(speeds), ray.at(mark.output), speeds)
            np.testing.assert_allclose(speeds, expected, atol=1e-9)


def test_three_degrees_of_freedom_have_a_plan_for_each_element() -> None:
    """MZKT 7922: elements 1 to 5 are in gears 1 3, 2 4, 5 6, 1 2 5 and 3 4 6 of the deck.

    Only a plan without brakes has a unit point: a train that turns as one piece moves their link.
    """
    drawn = plans(shipped_results("mzkt7922.dat"))
    assert {plan.engaged: ([*plan.gears], plan.has_unit_point) for plan in drawn} == {
        ("T1",): ([1, 3], False),
        ("F2",): ([2, 4], True),
        ("T3",): ([5, 6], False),
        ("T4",): ([1, 2, 5], False),
        ("F5",): ([3, 4, 6], True),
    }


def test_four_degrees_of_freedom_have_a_plan_for_two_elements_in_common() -> None:
    """ZF 8HP: of its ten pairs of elements each is in two gears or three of the shift table."""
    results = shipped_results("zf-8hp70.yaml")
    names = [gear.name for gear in results.case.gears]
    found = {plan.engaged: {names[gear - 1] for gear in plan.gears} for plan in plans(results)}
    assert len(found) == 10
    assert found["A", "B"] == {"1", "2", "R"}
    assert found["C", "E"] == {"3", "6"}


def test_without_a_free_speed_there_is_no_plan() -> None:
    for name in WITHOUT_PLAN:
        with pytest.raises(CaseError, match="no gear of this case leaves a speed free"):
            plans(shipped_results(name))


def test_a_freewheel_that_holds_makes_a_gear_like_a_brake() -> None:
    """The ring wants to turn backward; held, it leaves the carrier 1/(1 + 2.5) of the sun."""
    elements = [ShiftElement(2, 0, kind="freewheel"), ShiftElement(3, 1)]
    sets, gears = [Mechanism(1, 2, 3, -2.5)], [Gear(), Gear([2])]
    [plan] = plans(solve(Transmission(3, elements, sets, gears)))
    assert [mark.output for mark in plan.marks] == pytest.approx([1 / 3.5, 1])
    assert [mark.elements for mark in plan.marks] == [(1,), (2,)]


def test_sets_in_series_have_a_plan_for_each_brake() -> None:
    """Each brake is needed for the output, so each may be the one that is free; not 2**24 are tried.

    A clutch in place of the first brake makes the second gear, so one of 24 plans has two gears.
    """
    count = 24
    sets = [Mechanism(n, count + 1 + n, n + 1, -2.0) for n in range(1, count + 1)]
    brakes = [ShiftElement(count + 1 + n) for n in range(1, count + 1)]
    gears = [Gear(range(1, count + 1)), Gear(range(2, count + 2))]
    elements = [*brakes, ShiftElement(1, 2)]
    [plan] = plans(solve(Transmission(2 * count + 1, elements, sets, gears, output=count + 1)))
    assert plan.engaged == tuple(f"T{number}" for number in range(2, count + 1))


def test_links_that_stand_all_over_a_plan_are_named() -> None:
    """Issue 16; A and B hold both wheels of the first set of the Ford 10R80, so it stands whole."""
    results = shipped_results("ford-10r80.yaml")
    [first] = [plan for plan in plans(results) if plan.engaged == ("A", "B", "D")]
    names = [results.case.link_name(link) for link in first.standing]
    assert names == ["sun 1-2", "ring 1", "carrier 1"]
    figure = picture(results, "plan", Style())
    assert "at rest: sun 1-2, ring 1, carrier 1" in {text.get_text() for text in figure.texts}


def test_a_variator_that_gears_set_has_rays_of_its_links() -> None:
    """In the set 3.2 w_out = w_motor + 2.2, so the motor's ray is 3.2 x - 2.2; the pump is -1."""
    hydro = Mechanism(2, 3, 0, np.nan, kind="variator", name="hydro")
    parts = [Mechanism(1, 2, 0, -1), hydro, Mechanism(3, 1, 4, -2.2)]
    gears = [Gear(speed_ratios={2: ratio}) for ratio in (0.6, 0.0, -0.6)]
    [plan] = plans(solve(Transmission(4, [], parts, gears)))
    rays = {ray.links[0]: (ray.start, ray.slope) for ray in plan.rays}
    expected = {1: (1, 0), 2: (-1, 0), 3: (-2.2, 3.2), 4: (0, 1)}
    assert rays == {link: pytest.approx(ray) for link, ray in expected.items()}
    outputs = [(2.2 - ratio) / 3.2 for ratio in (0.6, 0, -0.6)]
    assert [mark.output for mark in plan.marks] == pytest.approx(outputs)


def test_a_plan_leaves_the_speed_ratio_of_a_variator_beside_drawn_sets_free() -> None:
    """The carrier turns at (1 + 2.5 v)/3.5 of the sun, with the speed ratio v."""
    case = loads("""\
links: [in, out, ring]
output: out
mechanisms: {V: {kind: variator, first: in, second: ring, speed_ratio: 0.8}}
elements: {P: {kind: planetary, sun: in, ring: ring, carrier: out, teeth: {sun: 30, ring: 75}}}
gears: {a: {}, b: {speed_ratios: {V: 0.4}}}
""")
    [plan] = plans(solve(case))
    assert [mark.output for mark in plan.marks] == pytest.approx([3 / 3.5, 2 / 3.5])


@pytest.mark.parametrize("given", ["", "speed_ratio: 0.7,"])
def test_a_converter_has_the_rays_of_its_speed_ratio(given: str) -> None:
    """The pump takes 200 N*m at lambda = 200/w^2, which is linear in i from 0.85 to 1.

    The ring is at (3.5 x - turbine)/2.5. It is at 0 in `low`, and turns with the turbine in `high`.
    """
    case = loads(f"""\
links: [engine, turbine, ring, output]
output: output
load: {{speed: 200 rad/s, torque: 200 N*m}}
shift_elements: {{B: [ring, housing], C: [turbine, ring], LU: [engine, turbine]}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, {given}
       points: [[0, 2, 0.008], [0.85, 1.1, 0.008], [1, 1, 0]]}}
  set: {{first: turbine, second: ring, third: output, ratio: -2.5}}
gears: {{low: [B], high: [C], locked: [C, LU]}}
""")
    turbine = 0.7 if given else 0.85 + 0.15 * (1 - 200 / 200**2 / 0.008)
    plan = plans(solve(case))[0]
    rays = {ray.links: (ray.start, ray.slope) for ray in plan.rays}
    assert rays[(2,)] == pytest.approx((turbine, 0))
    assert rays[(3,)] == pytest.approx((-turbine / 2.5, 1.4))
    assert [mark.output for mark in plan.marks] == pytest.approx([turbine / 3.5, turbine])


def test_a_link_at_rest_in_a_gear_has_its_ray() -> None:
    """Y = (u x - 1)/(u - 1): zero at x = 1/u, and 1 at x = 1; the input 1, the output x."""
    ratios = [37 / 14, 111 / 65, 1, 0.7, -37 / 9]
    case = case_of_ratios(ratios)
    [plan] = plans(solve(case))
    assert [mark.output for mark in plan.marks] == pytest.approx([1 / u for u in ratios])
    assert plan.has_unit_point
    rays = {case.link_names[ray.links[0] - 1]: ray for ray in plan.rays}
    assert len(rays) == 6
    assert [*rays["input"][1:]] == pytest.approx([1, 0], abs=1e-12)
    assert [*rays["output"][1:]] == pytest.approx([0, 1], abs=1e-12)
    for u in ratios:
        if u != 1:
            ray = rays[f"{u:.12g}"]
            assert ray.start == pytest.approx(-1 / (u - 1))
            assert ray.slope == pytest.approx(u / (u - 1))


def test_a_plan_needs_no_case(tmp_path: Path) -> None:
    file = tmp_path / "plan.svg"
    asked = ("plot", "--kind", "plan", "-o", file, "--ratios")
    said = vstatics(*asked, "2.6,1.7,-4")
    assert said.is_silent()
    assert "Ratios 2.6, 1.7, -4" in file.read_text("utf-8")
    assert vstatics(*asked, "2.6,-4", "--lang", "ru").status == 0
    russian = file.read_text("utf-8")
    assert "Передаточные отношения 2.6, -4" in russian
    assert not {"input", "output"} & {*re.findall(r">(\w+)<", russian)}


def test_wrong_plans_are_rejected() -> None:
    umdm, of_a_case = CASES / "umdm.yaml", "--from, --coast, --unloaded: only a case has them"
    for options, why in {
        "-k plan --ratios 2,0": "read 0, expected a ratio from 1e-6 to 1e6 in size",
        "-k plan --ratios 2,-inf": "read -inf, expected a ratio from 1e-6 to 1e6 in size",
        "-k plan --ratios 2,3,2": "read 2 again, expected each ratio once",
        "-k plan --ratios 2,x": "read 'x', expected ratios of gears such as 2.6,1.7,-4",
        f"{umdm} -k plan --ratios 2": "--ratios: expected no case",
        "-k lever --ratios 2": "--ratios: only a plan follows from ratios alone",
        "-k lever": "Missing argument 'CASE...'.",
        "-k plan --ratios 2 --coast": of_a_case,
        "s.csv -k curves --unloaded exact": of_a_case,
    }.items():
        assert vstatics("plot", *options.split(), "-o", "plan.svg").is_wrong_use(why), options


@needs("vehicle")
def test_a_vehicle_is_drawn_at_full_load() -> None:
    said = vstatics("plot", CASES / "umdm.yaml", "-k", "sawtooth", "--drive", "-o", "plan.svg")
    assert said.is_wrong_use("--coast: a vehicle is drawn at full")
