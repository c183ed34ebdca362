"""Which gears a plan has: those that one element tells apart of all that carry torque.

Torques and ratios are those that ``vstatics run -f json`` writes; links that elements join are
those of the case.
"""

import json
from collections.abc import Sequence
from itertools import combinations
from xml.etree import ElementTree as ET

import pytest

from tests.chance import with_slow
from tests.commands import CASES, SHIPPED, json_answer
from tests.pictures.drawn import WITHOUT_PLAN, WITHOUT_TWO_GEARS
from tests.shipped import shipped_results
from vstatics import Results, load, loads, solve
from vstatics.pictures import pages
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.pictures.plan.rays import plans

NAMES = [path.name for path in SHIPPED if path.name not in (*WITHOUT_PLAN, *WITHOUT_TWO_GEARS)]
QUICK = ("dual-clutch-wheels.yaml", "gm-6t70.yaml", "mzkt7922.dat", "zf-8hp70.yaml")
MOSTLY_SLOW = [pytest.param(name, marks=[pytest.mark.slow] * (name not in QUICK)) for name in NAMES]
SVG = "{http://www.w3.org/2000/svg}"

DCT = """
links: [engine, odd, even, l1, l2, l3, l4, upper, diff]
output: diff
mechanisms:
  p1: {first: odd, second: l1, ratio: -48/14}
  p3: {first: odd, second: l3, ratio: -41/26}
  p2: {first: even, second: l2, ratio: -42/19}
  p4: {first: even, second: l4, ratio: -38/35}
  f1: {first: upper, second: diff, ratio: -68/16}
shift_elements:
  K1: [engine, odd]
  K2: [engine, even]
  d1: {kind: dog_clutch, links: [l1, upper]}
  d2: {kind: dog_clutch, links: [l2, upper]}
  d3: {kind: dog_clutch, links: [l3, upper]}
  d4: {kind: dog_clutch, links: [l4, upper]}
gears: {"1": [K1, d1, d2], "2": [K2, d2, d3], "2 up": [K2, d2, d1], "3": [K1, d3, d4], "4": [K2, d4, d3]}
"""
"""A dual clutch transmission whose next dog clutch waits, engaged without torque."""


def panels(results: Results) -> tuple[list[tuple[list[str], list[str]]], list[str]]:
    """Gears and engaged elements of each panel of all pages, and the gears that are left out."""
    return told_panels(pages(results, "plan", "svg", Style(height=PAGE_HEIGHT)))


def told_panels(made: Sequence[bytes]) -> tuple[list[tuple[list[str], list[str]]], list[str]]:
    roots = [ET.fromstring(one) for one in made]  # noqa: S314 - our own
    found = [
        (json.loads(one.attrib["data-gears"]), json.loads(one.attrib["data-engaged"]))
        for root in roots
        for one in root.iter(f"{SVG}g")
        if one.get("class") == "panel"
    ]
    [left_out] = {root.attrib["data-left-out"] for root in roots}
    return found, json.loads(left_out)


def carrying(case: str) -> dict[str, dict[str, frozenset[str]]]:
    """By gear the elements that carry torque as the links they join, with their names."""
    said = json_answer("run", CASES / case)
    joined = {
        name: frozenset(map(str, one["links"] if isinstance(one, dict) else one))
        for name, one in said["case"]["shift_elements"].items()
    }
    return {
        gear: {
            name: joined[name]
            for name, row in zip(joined, said["torques"], strict=False)  # mechanisms follow
            if row[place] is None or abs(row[place]) > 1e-9
        }
        for place, gear in enumerate(said["gears"])
    }


@pytest.mark.parametrize("name", MOSTLY_SLOW)
def test_every_gear_is_on_a_panel_or_named(name: str) -> None:
    results = shipped_results(name)
    found, left_out = panels(results)
    shown = {gear for gears, _ in found for gear in gears}
    names = [gear.name for gear in results.case.gears]
    assert shown.isdisjoint(left_out)
    assert sorted([*shown, *left_out]) == sorted(names)
    for gears, _ in found:
        ratios = [results.ratio[names.index(gear)] for gear in gears]
        assert max(ratios) - min(ratios) > 1e-9


SPEEDS = [name for name in NAMES if "8hp70" in name or ("speed" in name and "allison" not in name)]


@pytest.mark.parametrize("name", with_slow(["allison-6speed.yaml"], SPEEDS))
def test_gears_that_one_element_tells_apart_are_on_a_panel(name: str) -> None:
    """Boxes whose elements all carry torque where they are engaged, by the JSON."""
    found, _ = panels(shipped_results(name))
    by_gear = {gear: {*own.values()} for gear, own in carrying(name).items()}
    for (gear, one), (other, two) in combinations(by_gear.items(), 2):
        is_near = len(one - two) == len(two - one) == 1
        assert is_near == any({gear, other} <= {*gears} for gears, _ in found), (gear, other)


@pytest.mark.parametrize("name", MOSTLY_SLOW)
def test_what_a_panel_has_engaged_and_what_makes_its_gears_carries_torque(name: str) -> None:
    """What is engaged all over a panel holds in each gear, and one or more elements make it."""
    case = load(CASES / name)
    results, by_gear = solve(case), carrying(name)
    for plan in plans(results):
        for mark in plan.marks:
            for gear in (case.gears[number - 1].name for number in mark.gears):
                made_by = {case.shift_elements[number - 1].name for number in mark.elements}
                assert made_by & by_gear[gear].keys() or not made_by
                common = {name for one in plan.engaged for name in one.split("/")}
                assert by_gear[gear].keys() <= made_by | common


def test_a_dog_clutch_that_waits_makes_no_gear() -> None:
    """K1 has the odd gears, K2 the even ones; two ways to be in gear 2 are one."""
    results = solve(loads(DCT))
    found, left_out = panels(results)
    assert found == [(["1", "3"], ["K1"]), (["2", "2 up", "4"], ["K2"])]
    assert left_out == []
    [_, even] = plans(results)
    assert [mark.gears for mark in even.marks] == [(2, 3), (5,)]


def test_a_gear_on_no_panel_is_named() -> None:
    """Without gear 3 nothing is like gear 1."""
    text = DCT.replace('"3": [K1, d3, d4], ', "")
    found, left_out = panels(solve(loads(text)))
    assert (found, left_out) == ([(["2", "2 up", "4"], ["K2"])], ["1"])
    [svg] = pages(solve(loads(text)), "plan", "svg", Style())
    assert "not on a plan: 1;" in svg.decode()


@pytest.mark.parametrize("name", WITHOUT_TWO_GEARS)
def test_panels_of_one_gear_are_left_out(name: str) -> None:
    results = shipped_results(name)
    assert plans(results) == []
    names = [gear.name for gear in results.case.gears]
    assert panels(results) == ([], names)
    [svg] = pages(results, "plan", "svg", Style())
    assert f"not on a plan: {', '.join(names)};" in svg.decode()
