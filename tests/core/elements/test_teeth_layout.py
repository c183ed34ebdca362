"""Wheels of one element fit between their axes, and planets beside one another do not touch."""

from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.core.elements.toothed import RANDOM, UMDM, double_planet, element, told, touching
from vstatics.core.elements import CentralWheel, Element

LONG = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
DOUBLE = {"sun": 30, "inner": 20, "outer": 20, "ring": 90}
STEPPED = {"sun": 30, "planet": 20, "planet2": 40, "ring2": 90}
"""50 sin 60 = 43.3 of planet2, whose tips take 42; 50 sin 45 = 35.4, enough for the other rim."""
SHOULD_MESH = "distance 20 would have to be between 25 and 75"
"""Radii (30 + 20)/2 = 25 and (120 - 20)/2 = 50 leave 25 between, planets make 20."""
WOLFROM = {"sun": 20, "ring": 100, "ring2": 97, "planet": 40, "planet2": 38}


@pytest.mark.parametrize(
    ("one", "word", "severity", "place", "said"),
    [
        (element("planetary", sun=48, ring=96, planet=24), "ring 96 is not", "", "", ""),
        (
            element("planetary", sun=48, ring=98, planet=24),
            *("ring 98 is not sun + 2 planet = 96", "note", "teeth.ring", "shifted profiles"),
        ),
        (
            element("planetary", sun=48, ring=99, planet=24),
            *("ring 99 is not sun + 2 planet = 96", "warning", "teeth.ring", ""),
        ),
        (element("planetary", sun=48, ring=96), "would need", "", "", ""),
        (
            element("planetary", sun=48, ring=97),
            *("would need", "note", "", "the planet would need 24.5 teeth ((ring - sun)/2); its"),
        ),
        (element("ravigneaux", **LONG), "large_sun + 2 long", "", "", ""),
        (
            element("ravigneaux", **LONG | {"ring": 80}),
            *("ring 80 is not large_sun + 2 long = 72", "warning", "", ""),
        ),
        (
            element("ravigneaux", small_sun=28, large_sun=32, ring=75),
            *("would need", "note", "", "the long planet would need 21.5 teeth"),
        ),
        (
            element("ravigneaux", small_sun=30, large_sun=36, ring=30),
            *("no planet `long` fits", "warning", "teeth.ring", ""),
        ),
        (
            replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, 79, True, "B2")]),
            *("ring `8` 79 is not sun `4` + 2 rim `B2` = 74", "warning", "rings.3.teeth", ""),
        ),
        (element("stepped", sun=30, planet=20, planet2=25, ring2=75), "module", "", "", ""),
        (  # 25 + 20 = 45 and 61 - 25 = 36; 45/36 = 1.25
            element("stepped", sun=25, planet=20, planet2=25, ring2=61),
            *("module", "note", "teeth.planet2"),
            "the module of planet2 is 1.25 times the module of planet (5/4)",
        ),
        (  # 100 - 40 = 60 and 97 - 38 = 59
            element("stepped", **WOLFROM),
            *("module", "note", ""),
            "coaxial with shifted profiles, or with different modules: "
            "the module of planet2 is 1.0169 times the module of planet (60/59)",
        ),
        (element("double_planet", **DOUBLE), "cannot mesh", "", "", ""),
        (
            element("double_planet", **DOUBLE | {"ring": 120}),
            *("cannot mesh", "warning", "teeth.inner", SHOULD_MESH),
        ),
        # tips of the inner planet reach to 30 + 28 + 28 + 2 = 88, twice the radius in modules;
        # tips of a ring of 90 stand at 88 too, those of one of 91 leave a gap
        (
            element("double_planet", **DOUBLE | {"inner": 28}),
            *("inner 28 and ring 90", "warning", "", ""),
        ),
        (
            element("double_planet", **DOUBLE | {"inner": 28, "ring": 91}),
            "inner 28 and",
            "",
            "",
            "",
        ),
        (
            element("double_planet", **DOUBLE | {"outer": 29}),
            *("outer 29 and sun 30", "warning", "", ""),
        ),
        (element("planetary", 4, sun=20, ring=100, planet=40), "touch", "", "", ""),  # 42.43 > 42
        (element("planetary", sun=20, ring=100, planet=40), "touch", "", "", ""),
        (
            element("planetary", 5, sun=20, ring=100, planet=40),
            *("; 3 or 4 planets fit", "warning", ""),
            "(sun + planet) sin(180°/5) = 35.27, expected more than planet + 2 = 42",
        ),
        (element("stepped", 3, **STEPPED), "touch", "", "", ""),
        (
            element("stepped", 4, **STEPPED),
            *("touch", "warning", "", "expected more than planet2 + 2 = 42"),
        ),
    ],
)
def test_wheels_that_do_not_fit_are_told(
    one: Element, word: str, severity: str, place: str, said: str
) -> None:
    problems = told(one, word)
    assert [problem.severity for problem in problems] == [severity] * bool(severity)
    for problem in problems:
        assert said in problem.message
        assert ".".join(map(str, problem.path)).endswith(place)


@pytest.mark.parametrize(("planets", "limit"), [(3, 13.93), (4, 5.83), (5, 3.85), (6, 3.0)])
def test_neighbours_touch_beyond_the_known_ratio_of_large_sets(planets: int, limit: float) -> None:
    """(1 + sin(pi/n))/(1 - sin(pi/n)): the tips hardly count where there are so many teeth."""
    sun = 60000
    for ratio, expected in ((limit - 0.02, 0), (limit + 0.02, 1)):
        planet = round((ratio - 1) / 2 * sun)
        one = element("planetary", planets, sun=sun, planet=planet, ring=sun + 2 * planet)
        assert len(told(one, "touch")) == expected


@RANDOM
@given(double_planet(), st.integers(2, 6))
def test_meshed_planets_touch_where_their_tip_circles_meet(one: Element, planets: int) -> None:
    teeth = one.teeth
    inner, outer = teeth["sun"] + teeth["inner"], teeth["ring"] - teeth["outer"]
    assume(abs(inner - outer) < teeth["inner"] + teeth["outer"] < inner + outer)
    found = told(replace(one, planets=planets), "neighbouring planets")
    assert bool(found) == touching(one, planets)
