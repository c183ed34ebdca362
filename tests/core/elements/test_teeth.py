"""Doubts about teeth: assembly, layout, meshing of two wheels, and what is suggested.

Whether planets can be put in is found by putting them in, one after the other (`phases`).
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.core.elements import toothed
from tests.core.elements.element_cases import reading, set_case
from tests.core.elements.toothed import (
    RANDOM,
    UMDM,
    element,
    found,
    goes_in,
    is_assembled,
    of,
    suggestions,
    told,
    touching,
    warnings,
)
from tests.published import umdm_cases
from vstatics.core.elements import CentralWheel, Drawing, Element
from vstatics.core.elements.checks import problems
from vstatics.core.elements.kinds import KINDS, Planetary


def test_usual_teeth_cause_no_message_and_doubtful_teeth_no_error() -> None:
    """Paths in messages count elements from 1."""
    for text in (
        *("belt first 10 second 10.5", "worm worm 1 wheel 40", "shaft", "held", "bevel"),
        *("planetary/3 sun 10.5 ring 30", "gear_pair first 20 second 41"),
        *("planetary sun 49 ring 95", "chain first 17 second 40"),
    ):
        assert not found(of(text)), text
    assert is_assembled(of("planetary sun 17 ring 64 planet 23"))  # of any number of planets
    bad = of("planetary/3 sun 10 ring 97 planet 12")
    doubtful = found(of("gear_pair first 20 second 41"), bad)
    assert {problem.path[:2] for problem in doubtful} == {("elements", 2)}
    assert {problem.severity for problem in doubtful} == {"warning", "note"}


@RANDOM
@given(st.data(), st.integers(1, 7))
def test_any_teeth_without_errors_can_be_doubted(data: st.DataObject, planets: int) -> None:
    kind = data.draw(st.sampled_from(["planetary", "double_planet", "stepped", "ravigneaux"]))
    shape = KINDS[kind]
    assert isinstance(shape, Planetary)
    names = data.draw(st.lists(st.sampled_from(shape.toothed), min_size=2, unique=True))
    one = element(kind, planets, **{name: data.draw(st.integers(1, 60)) for name in names})
    assume(not [*problems(Drawing(9, [one]))])
    assert all(problem.severity in ("warning", "note") for problem in found(one))


@st.composite
def two_wheels(draw: st.DrawFn) -> Element:
    teeth = dict(draw(toothed.ravigneaux()).teeth)
    del teeth[draw(st.sampled_from(("small_sun", "large_sun", "ring")))]
    return element("ravigneaux", None, **teeth)


ASSEMBLED = {
    "two wheels": two_wheels(),
    "planetary": toothed.planetary(),
    "stepped": toothed.stepped(),
    "double_planet": toothed.double_planet(),
    "ravigneaux": toothed.ravigneaux(),
    "planet_group": toothed.groups(),
}


@pytest.mark.parametrize("kind", ASSEMBLED)
@RANDOM
@given(st.data(), st.integers(2, 6))
def test_planets_can_be_assembled_where_turning_them_tooth_by_tooth_finds_a_way(
    kind: str, data: st.DataObject, planets: int
) -> None:
    """So do planets that are not given, where given ones fill the gap between their wheels."""
    one = replace(data.draw(ASSEMBLED[kind]), planets=planets)
    expected, t = goes_in(one, planets), one.teeth
    assert is_assembled(one) == expected
    is_whole = one.kind == "planetary" and t["ring"] == t["sun"] + 2 * t["planet"]
    if is_whole or one.kind == "ravigneaux":
        wheels = {name: teeth for name, teeth in t.items() if name in one.members}
        assert is_assembled(replace(one, teeth=wheels)) == expected


def test_a_message_names_the_formula_that_is_not_whole() -> None:
    stepped = "sun 30 planet 20 planet2 25 ring2 95"  # 2650/5 = 530
    own = "ravigneaux/3 ring 72 short 20 long 18"
    for text, formula in (
        ("planetary/3 sun 48 ring 96 planet 24", ""),
        ("planetary/3 sun 48 ring 97 planet 24", "(sun + ring)/planets = 145/3"),
        ("double_planet/3 sun 30 ring 91", "(ring - sun)/planets = 61/3"),
        (f"stepped/2 {stepped}", ""),
        (f"stepped/5 {stepped}", ""),
        (f"stepped/4 {stepped}", "/(planets * gcd(planet, planet2)) = 2650/20"),
        (f"{own} small_sun 30 large_sun 36", ""),
        (f"{own} small_sun 31 large_sun 36", "(small_sun + large_sun)/planets = 67/3"),
        (f"{own} large_sun 35", "(large_sun + ring)/planets = 107/3"),
        ("bevel/4 left 16 right 16 planet 10", ""),
        ("bevel/3 left 16 right 16 planet 10", "(left + right)/planets = 32/3"),
    ):
        said = told(of(text), "assembled")
        whole = [formula + " is not whole" in one.message for one in said]
        assert whole == [True] * bool(formula), text
        places = {(one.severity, one.path) for one in said}
        assert places <= {("warning", ("elements", 1, "planets"))}
    assert "left 15, planet 10, right 15 (ratio -1)" in said[0].message


def test_a_gearbox_that_is_built_can_be_assembled() -> None:
    """The multi-flow mechanism has three sets of planets; four do not go in."""
    assert not warnings(UMDM)
    assert goes_in(UMDM, 3)
    assert not is_assembled(replace(UMDM, planets=4))
    assert not goes_in(UMDM, 4)
    for planets, expected in ((3, 0), (4, 1)):
        case = set_case(umdm_cases.element(umdm_cases.GOLDEN, planets), umdm_cases.LINKS)
        assert sum("assembled" in one.message for one in reading(case).warnings) == expected


def umdm_with(ring: int) -> Element:
    return replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, ring, True, "B2")])


RAVIGNEAUX = "ravigneaux small_sun 30 large_sun 36 short 20 long 18 ring"
LAYOUTS = (
    ("planetary sun 48 ring 96 planet 24", "ring 96 is not"),
    ("planetary sun 48 ring 98 planet 24", "ring 98 is not sun + 2 planet = 96", "note", "ring"),
    ("planetary sun 48 ring 98 planet 24", "shifted profiles", "note", "ring"),
    ("planetary sun 48 ring 99 planet 24", "is not sun + 2 planet = 96", "warning", "ring"),
    ("planetary sun 48 ring 96", "would need"),
    ("planetary sun 48 ring 97", "would need 24.5 teeth ((ring - sun)/2); its", "note", ""),
    (f"{RAVIGNEAUX} 72", "large_sun + 2 long"),
    (f"{RAVIGNEAUX} 80", "ring 80 is not large_sun + 2 long = 72", "warning", ""),
    ("ravigneaux small_sun 28 large_sun 32 ring 75", "planet would need 21.5 teeth", "note", ""),
    ("ravigneaux small_sun 30 large_sun 36 ring 30", "no planet `long` fits", "warning", "ring"),
    ("stepped sun 30 planet 20 planet2 25 ring2 75", "module"),
    # 25 + 20 = 45 and 61 - 25 = 36; 45/36 = 1.25
    ("stepped sun 25 planet 20 planet2 25 ring2 61", "planet2 is 1.25 times", "note", "planet2"),
    # 100 - 40 = 60 and 97 - 38 = 59
    ("stepped sun 20 ring 100 ring2 97 planet 40 planet2 38", "coaxial with shifted", "note", ""),
    ("stepped sun 20 ring 100 ring2 97 planet 40 planet2 38", "is 1.0169 times", "note", ""),
    ("double_planet sun 30 inner 20 outer 20 ring 90", "cannot mesh"),
    # radii (30 + 20)/2 = 25 and (120 - 20)/2 = 50 leave 25 between, planets make 20
    ("double_planet sun 30 inner 20 outer 20 ring 120", "between 25 and 75", "warning", "inner"),
    # tips of the inner planet reach to 30 + 28 + 28 + 2 = 88, twice the radius in modules;
    # tips of a ring of 90 stand at 88 too, those of one of 91 leave a gap
    ("double_planet sun 30 inner 28 outer 20 ring 90", "inner 28 and ring 90", "warning", ""),
    ("double_planet sun 30 inner 28 outer 20 ring 91", "inner 28 and"),
    ("double_planet sun 30 inner 20 outer 29 ring 90", "outer 29 and sun 30", "warning", ""),
    ("planetary/4 sun 20 ring 100 planet 40", "touch"),  # 42.43 > 42
    ("planetary sun 20 ring 100 planet 40", "touch"),
    ("planetary/5 sun 20 ring 100 planet 40", "; 3 or 4 planets fit", "warning", ""),
    ("planetary/3 sun 20 ring 80 planet 30", "; 2 or 4 planets fit", "warning", ""),
    ("planetary/5 sun 20 ring 100 planet 40", "sin(180°/5) = 35.27, exp", "warning", ""),
    # 50 sin 60 = 43.3 of planet2, whose tips take 42; 50 sin 45 = 35.4
    ("stepped/3 sun 30 planet 20 planet2 40 ring2 90", "touch"),
    ("stepped/4 sun 30 planet 20 planet2 40 ring2 90", "than planet2 + 2 = 42", "warning", ""),
)
"""An element, words about it, severity and place of the doubt if there is any."""


def test_wheels_that_do_not_fit_are_reported() -> None:
    """Wheels of one element fit between their axes, planets beside one another do not touch."""
    for text, word, *expected in LAYOUTS:
        said = [(one.severity, one.path[-1]) for one in told(of(text), word)]
        severity, place = expected or ("", "")
        assert [one for one, _ in said] == [severity] * bool(severity), text
        assert not place or said[0][1] == place


def test_a_wheel_of_a_group_that_does_not_fit_is_reported_with_teeth_that_do() -> None:
    """74/28 = 2.6429 and so on: the published teeth."""
    [said] = told(umdm_with(79), "ring `8` 79 is not sun `4` + 2 rim `B2` = 74")
    assert (said.severity, said.path[-3:]) == ("warning", ("rings", 3, "teeth"))
    [said] = told(umdm_with(75), "nearest that fit")
    fits = "; nearest that fit: ring `8` 74 (ratios 2.6429, -2.1765, -1.3214, 1.3214)"
    assert fits in said.message


def test_neighbours_touch_beyond_the_known_ratio_of_large_sets() -> None:
    """(1 + sin(pi/n))/(1 - sin(pi/n)): the tips hardly count where there are so many teeth."""
    sun = 60000
    for planets, limit in ((3, 13.93), (4, 5.83), (5, 3.85), (6, 3.0)):
        for ratio, expected in ((limit - 0.02, 0), (limit + 0.02, 1)):
            planet = round((ratio - 1) / 2 * sun)
            one = element("planetary", planets, sun=sun, planet=planet, ring=sun + 2 * planet)
            assert len(told(one, "touch")) == expected


@RANDOM
@given(toothed.double_planet(), st.integers(2, 6))
def test_meshed_planets_touch_where_their_tip_circles_meet(one: Element, planets: int) -> None:
    teeth = one.teeth
    inner, outer = teeth["sun"] + teeth["inner"], teeth["ring"] - teeth["outer"]
    assume(abs(inner - outer) < teeth["inner"] + teeth["outer"] < inner + outer)
    said = told(replace(one, planets=planets), "neighbouring planets")
    assert bool(said) == touching(one, planets)


def test_few_teeth_are_undercut_and_a_chain_needs_more() -> None:
    for teeth, severity in ((13, ["note"]), (14, ["note"]), (16, ["note"]), (17, [])):
        for text in (
            f"gear_pair first 41 second {teeth}",
            f"idler first 37 idler {teeth} second 41",
            f"internal_pair first {teeth} second 61",
            f"planetary sun {teeth} planet 20 ring {teeth + 40}",
            f"planetary sun 23 ring {23 + 2 * teeth}",
            f"ravigneaux small_sun {teeth} large_sun 29 ring 67",
            f"idler first {teeth} second 41",
        ):
            assert [one.severity for one in told(of(text), "undercut")] == severity
    [chain] = found(of("chain first 16 second 40"))
    assert (chain.severity, chain.path) == ("note", ("elements", 1, "teeth", "first"))


def test_tips_interfere_in_a_ring_that_is_hardly_larger() -> None:
    assert not told(of("internal_pair first 40 second 48"), "interfere")
    for pair in ("first 40 second 47", "first 47 second 40"):
        [problem] = told(of(f"internal_pair {pair}"), "interfere")
        assert problem.severity == "warning"
        assert "their numbers of teeth differ by 7, expected 8 or more" in problem.message
    assert told(of("planetary sun 5 planet 40 ring 45"), "interfere")
    stepped = of("stepped sun 20 planet 40 planet2 30 ring2 30")
    assert told(stepped, "planet2 30 does not fit into ring2 30")


@given(st.integers(17, 60), st.integers(17, 60))
def test_teeth_meet_again_after_as_many_turns_as_stated(first: int, second: int) -> None:
    """Counting tooth by tooth: tooth 0 of both meet again after so many teeth."""
    doubtful = told(element("gear_pair", first=first, second=second), "common divisor")
    passed = next(n for n in range(1, first * second + 1) if n % first == 0 == n % second)
    turns = passed // first
    if turns == second:
        assert not doubtful
        return
    [problem] = doubtful
    often = "every turn of" if turns == 1 else f"every {turns} turns of"
    assert f"{often} first" in problem.message
    assert problem.severity == "note"


def test_common_divisors_of_an_element_are_named_together() -> None:
    [problem] = told(of("planetary/3 sun 48 ring 96 planet 24"), "common divisor")
    for said in (
        "sun 48 and planet 24 have the common divisor 24",
        "also ring 96 and planet 24 (24)",
        "nearest without a common divisor: sun 49, ring 95, planet 23 (ratio -1.9388)",
    ):
        assert said in problem.message
    for text in ("planetary/3 sun 49 ring 95 planet 23", "planetary sun 48 ring 96 planet 24"):
        assert not told(of(text), "common divisor")


def test_nearby_teeth_are_proposed_with_their_ratio() -> None:
    """A pair keeps its ratio where a wheel grows."""
    one = of("planetary/3 sun 48 ring 97")
    [problem] = told(one, "nearest that fit")
    assert problem == found(one)[0]  # of two that it cures
    assert problem.message.endswith(
        "; nearest that fit: sun 48, ring 96 (ratio -2) or sun 47, ring 97 (ratio -2.0638)"
    )
    [problem] = told(of("gear_pair first 12 second 41"), "undercut")
    assert "; nearest that fit: first 14, second 48 (ratio -3.4286)" in problem.message


@RANDOM
@given(st.data(), st.integers(2, 5))
def test_what_is_suggested_passes_every_check(data: st.DataObject, planets: int) -> None:
    kinds = (toothed.planetary, toothed.double_planet, toothed.stepped, toothed.ravigneaux)
    one = replace(data.draw(st.one_of([kind() for kind in kinds])), planets=planets)
    for problem in found(one):
        for teeth in suggestions(problem):
            other = replace(one, teeth={**one.teeth, **teeth})
            assert teeth.keys() <= one.teeth.keys()
            assert not warnings(other)
            assert not told(other, "needs shifted profiles")
            assert not told(other, "in one plane") or told(one, "in one plane")
            assert goes_in(other, planets)
            if "without a common divisor" in problem.message:
                assert not told(other, "common divisor")


@RANDOM
@given(st.integers(17, 60), st.integers(17, 60), st.integers(3, 5))
def test_nothing_nearer_fits_than_what_is_suggested(sun: int, planet: int, planets: int) -> None:
    """All sets around one that cannot be assembled, by brute force."""
    ring = sun + 2 * planet
    doubtful = told(element("planetary", planets, sun=sun, ring=ring), "assembled")
    assume(doubtful)
    assume(suggestions(doubtful[0]))

    def distance(teeth: Mapping[str, float]) -> float:
        change = math.log(teeth["ring"] / ring) - math.log(teeth["sun"] / sun)
        return abs(teeth["sun"] - sun) + abs(teeth["ring"] - ring) + 100 * abs(change)

    best = min(distance(teeth) for teeth in suggestions(doubtful[0]))
    for s in range(max(sun - 3, 17), sun + 4):
        for r in range(ring - 3, ring + 4):
            near = distance({"sun": s, "ring": r}) < best - 1e-9
            if (s + r) % planets == 0 == (r - s) % 2 and near:
                p = (r - s) // 2
                assert (s + p) * math.sin(math.pi / planets) <= p + 2 or p < 17
