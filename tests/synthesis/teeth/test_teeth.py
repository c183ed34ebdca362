"""Teeth that are found, against the searches in plain loops of `tests/oracle/teeth.py`."""

import itertools
import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import pytest

from tests.commands import CASES
from tests.core.elements.test_ratios import of_ratios
from tests.oracle import teeth as oracle
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, loads, solve
from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.elements.element import Element
from vstatics.core.elements.teeth import doubts
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.readers import from_dict
from vstatics.core.writers.named import mapping
from vstatics.synthesis.teeth.finding import find_teeth
from vstatics.synthesis.teeth.layout import teeth_layouts
from vstatics.synthesis.teeth.limits import TeethLimits
from vstatics.synthesis.teeth.problem import own_ratios
from vstatics.synthesis.teeth.rows import TeethRows
from vstatics.synthesis.teeth.solutions import case_with_teeth

RULES = oracle.Rules(0.5, 14)

WIDE = TeethLimits({"sun": (15, 60), "planet": (14, 60), "ring": (1, 121)}, (3, 4, 5, 6))
NARROW = TeethLimits({"sun": (17, 30), "planet": (17, 24), "ring": (40, 80)}, (3, 4))


def rows_of(element: Element, limits: TeethLimits) -> set[tuple[int, ...]]:
    """All teeth with the numbers of planets, in the order of the layout's wheels."""
    links = max(element.members.values())
    case = Transmission(links, [], [], [Gear()], drawing=Drawing(links, [element]))
    (layout,) = teeth_layouts(on_own_links(case))
    wheels = len(layout.wheels)
    found = [rows[:, : wheels + 1] for rows in TeethRows(layout, limits).pieces({})]
    return {tuple(row.tolist()) for piece in found for row in piece}


def drawn(kind: str, members: Sequence[str], teeth: Mapping[str, int]) -> Element:
    links = {member: place for place, member in enumerate(members, 1)}
    return Element("E", kind, links, teeth)


def test_the_table_of_simple_sets() -> None:
    """1433 sets, 635 ratios; by planets 437, 593, 183, 220: the facts of the literature."""
    members, teeth = ("sun", "ring", "carrier"), {"sun": 20, "ring": 60}
    found = rows_of(drawn("planetary", members, teeth), WIDE)
    assert (len(found), len({ring / sun for sun, ring, *_ in found})) == (1433, 635)
    assert Counter(row[-1] for row in found) == {3: 437, 4: 593, 5: 183, 6: 220}


def test_wheels_of_an_internal_pair_differ_by_eight_teeth_or_more() -> None:
    pair, teeth = (
        drawn("internal_pair", ("first", "second"), {"first": 20, "second": 60}),
        range(17, 41),
    )
    found = {row[:2] for row in rows_of(pair, TeethLimits({"all": (17, 40)}))}
    assert found == {(a, b) for a in teeth for b in teeth if abs(a - b) >= RULES.less}


def test_meshed_planets_stepped_planets_and_ravigneaux_sets() -> None:
    """All rows of small ranges: the very ones that plain loops find."""
    small, rings, counts = range(16, 24), range(50, 75), (2, 3, 4)
    limits = TeethLimits({"all": (16, 23), "ring": (50, 74), "ring2": (50, 74)}, counts)

    def compare(kind: str, teeth: dict[str, int], found: Iterable[object], wheels: str) -> None:
        expected = {tuple(getattr(one, name) for name in wheels.split()) for one in found}
        members = [name for name in teeth if not name.startswith("planet")]
        assert expected
        assert rows_of(drawn(kind, [*members, "carrier"], teeth), limits) == expected

    meshed = oracle.meshed((small, small, small, rings), counts, RULES)
    compare("double_planet", {"sun": 20, "ring": 60}, meshed, "sun ring inner outer planets")
    stepped = oracle.stepped((small, small, small, rings), counts, RULES)
    teeth = {"sun": 20, "ring2": 60, "planet": 20, "planet2": 20}
    compare("stepped", teeth, stepped, "sun ring first second planets")
    ravigneaux = oracle.ravigneaux((small, small, rings, small, small), counts, RULES)
    teeth = {"small_sun": 20, "large_sun": 20, "ring": 60}
    compare("ravigneaux", teeth, ravigneaux, "small_sun large_sun ring short long planets")


def test_belaz() -> None:
    """The largest error is that of 67/33 for gear 5, 2.5e-5; the plain loops have the same."""
    case = load(CASES / "belaz7516.yaml")
    found = find_teeth(case, {"2": 4.0, "4": 2.01, "5": 1.4925, "R2": -5.12}, WIDE)
    assert found.is_proven
    assert found.solutions[0].error == pytest.approx(math.log(100 / 67 / 1.4925), rel=1e-9)
    assert found.solutions[0].teeth["P4"] == {"sun": 50, "ring": 102, "planet": 26}
    assert len({str(one.teeth) for one in found.solutions}) == 20
    made = case_with_teeth(case, found.problem, found.solutions[0])
    assert solve(made).ratio.tolist() == pytest.approx([*found.solutions[0].gears.values()])
    drawing = drawing_of(made)
    assert drawing is not None
    assert [one for one in doubts(drawing) if one.severity == "warning"] == []


def test_the_twenty_best_of_sets_that_gears_share() -> None:
    """All products of the tables of two sets, whose ratios are in one gear, in their order."""
    sets = [Mechanism(1, 2, 3, -2.5, name="P1"), Mechanism(3, 2, 4, -2.5, name="P2")]
    case = Transmission(4, [ShiftElement(2), ShiftElement(3)], sets, [Gear([1]), Gear([2])])
    wanted = {"1": 11.3, "2": -3.6}
    found = find_teeth(case, wanted, NARROW)
    wheels = (range(17, 31), range(17, 25), range(40, 81))
    sets_of = {one[:3]: one.ratio for one in oracle.simple(wheels, (3, 4), oracle.Rules(0.5, 17))}
    errors = [  # the ring held: (1 - K1)(1 - K2), the carrier of the first: K1 (K2 - 1)/K2
        oracle.off({"1": (1 - one) * (1 - other), "2": one * (other - 1) / other}, wanted)
        for one, other in itertools.product(sets_of.values(), repeat=2)
    ]
    told = [one.error for one in found.solutions]
    assert told == pytest.approx(sorted(errors)[:20])


TWO_RIMS = """
links: [sun 4, sun 1, carrier, ring]
input: sun 4
output: ring
elements:
  set:
    kind: planet_group
    carrier: carrier
    rims: {A: {N2: 20, N3: 20}, B: {N5: 20}}
    suns: [{link: sun 1, teeth: 30, rim: N2}, {link: sun 4, teeth: 30, rim: N5}]
    rings: [{link: ring, teeth: 90, rim: N3}]
    meshes: [[N3, N5]]
shift_elements: {B1: [carrier, housing], B2: [sun 4, housing]}
gears: {1: [B1], 2: {engaged: [B2], input: sun 1}, R: {engaged: [B1], input: sun 1}}
"""
"""The benchmark of Simionescu, Beale and Dozier: i1 = N6/N4, iR = -N2 N6/(N1 N3), and
i2 = N6 (N1 N3 + N2 N4)/(N1 N3 (N6 - N4))."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("shift", "wheels", "count"),
    [(0, (44, 37, 39, 33, 120), 3), (1, (25, 15, 16, 19, 69), 5), (2, (25, 15, 16, 19, 69), 5)],
)
def test_the_benchmark_of_two_rims(shift: int, wheels: tuple[int, ...], count: int) -> None:
    """The optimum 0.52325, with shifted profiles; the wheels by plain loops over all teeth.

    The loops ask for identical planets (N1 N3 + N6 N2 by n gcd(N2, N3)), and axes as
    |m1 (N1 + N2) - m3 (N6 - N3)| <= shift (m1 + m3)/2.
    """
    wide = {"sun 4": (17, 104), "sun 1": (17, 96), "N2": (14, 58), "ring": (1, 200)}
    ranges = {**wide, "N3": (14, 46), "N5": (14, 46)}
    modules = tuple(1.75 + 0.25 * number for number in range(6))
    limits = TeethLimits(ranges, (3, 4, 5), 0.5, {}, modules, 220.0, shift)
    wanted = {"1": 3.11, "2": 1.84, "R": -3.11}
    found = find_teeth(loads(TWO_RIMS, format="yaml"), wanted, limits, error="absolute")
    best = found.solutions[0]
    sun1, rim2, rim3, sun4, ring = wheels
    gear2 = ring * (sun1 * rim3 + rim2 * sun4) / (sun1 * rim3 * (ring - sun4))
    gears = (ring / sun4, gear2, -rim2 * ring / (sun1 * rim3))
    errors = [abs(one - other) for one, other in zip(gears, wanted.values(), strict=True)]
    assert found.is_proven
    assert best.error == pytest.approx(max(errors))
    assert best.error == pytest.approx(0.52325 if shift else 0.5263636, abs=1e-7)
    assert best.planets == {"set": count}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["zf-6hp26", "ravigneaux-gf4a", "two-stage", "aisin-8speed"])
def test_what_is_found_leaves_nothing_to_check(name: str) -> None:
    """Teeth for the case's own ratios: the program's own checks of them have no warning."""
    case = load(CASES / f"{name}.yaml")
    found = find_teeth(case, own_ratios(case))
    for solution in (found.solutions[0], found.solutions[-1]):
        made = case_with_teeth(case, found.problem, solution)
        drawing = drawing_of(made)
        assert drawing is not None
        assert [one.message for one in doubts(drawing) if one.severity != "note"] == []
        assert solve(made).ratio.tolist() == pytest.approx([*solution.gears.values()])


def test_ranges_that_keep_all_wishes_from_being_met_together_are_reported() -> None:
    """Gear 2 is 1 + q, gear 1 (1 + p)(1 + q): met they need p = 1.5, sets have 93/59 at least.

    The largest |ln| is least where both gears share the factor; with more teeth in the
    sun of P there is nothing to tell.
    """
    sets = [Mechanism(1, 2, 3, -2.5, name="P"), Mechanism(3, 4, 5, -2.5, name="Q")]
    elements = [ShiftElement(2), ShiftElement(4), ShiftElement(1, 2)]
    gears = [Gear([1, 2], name="1"), Gear([2, 3], name="2")]
    case, wish = Transmission(5, elements, sets, gears), {"1": 2.5 * 3.6, "2": 3.6}
    [told] = find_teeth(case, wish).doubts
    shared = math.log((1 + 93 / 59) / 2.5) / 2
    assert f"error is at least {shared:.3g}; at the end of its range is P (-7.118 to -1.5" in told
    found = find_teeth(case, wish, TeethLimits({"P.sun": (60, 100), "P.ring": (90, 150)}))
    assert (found.doubts, found.solutions[0].error < shared / 50) == ([], True)


def test_a_set_that_is_given_by_its_ratios_gets_teeth() -> None:
    """Its efficiency, that of the former ratios, goes with them."""
    case = of_ratios(85 / 31, -85 / 38)
    assert from_dict(mapping(case)) == case
    found = find_teeth(case, {case.gears[0].name: 85 / 31})
    small, ring = (found.solutions[0].teeth["R"][wheel] for wheel in ("small_sun", "ring"))
    assert ring / small == pytest.approx(85 / 31, rel=1e-2)
    drawing = drawing_of(case_with_teeth(case, found.problem, found.solutions[0]))
    assert drawing is not None
    assert drawing.elements[0].efficiency is None


def test_a_variator_behind_a_set_that_gets_teeth_keeps_its_speed_ratio() -> None:
    """The carrier turns at 1/(1 + z_ring/z_sun) of the sun, the output half as fast."""
    parts = [Mechanism(1, 2, 3, -2.5, name="P"), Mechanism(3, 4, 0, math.nan, kind="variator")]
    case = Transmission(4, [ShiftElement(2)], parts, [Gear([1], speed_ratios={2: 0.5})])
    found = find_teeth(case, {"1": 7.2}, NARROW)
    teeth = found.solutions[0].teeth["P"]
    made = case_with_teeth(case, found.problem, found.solutions[0])
    assert solve(made).ratio == pytest.approx([(1 + teeth["ring"] / teeth["sun"]) / 0.5])
