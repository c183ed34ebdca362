"""A case is warned of planets that cannot be put in, exactly when they cannot.

Whether they can is found by putting them in, one after the other (`phases`).
"""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.elements.element_cases import reading, set_case
from tests.core.elements.toothed import (
    RANDOM,
    UMDM,
    double_planet,
    element,
    goes_in,
    groups,
    is_assembled,
    planetary,
    ravigneaux,
    stepped,
    told,
    warnings,
)
from tests.published import umdm_cases
from vstatics.core.elements import Element


@st.composite
def two_wheels(draw: st.DrawFn) -> Element:
    """A Ravigneaux set without one of its wheels."""
    teeth = draw(ravigneaux()).teeth
    left_out = draw(st.sampled_from(("small_sun", "large_sun", "ring")))
    return element(
        "ravigneaux", None, **{name: own for name, own in teeth.items() if name != left_out}
    )


KINDS = {
    "two wheels": two_wheels(),
    "planetary": planetary(),
    "double_planet": double_planet(),
    "stepped": stepped(),
    "ravigneaux": ravigneaux(),
    "planet_group": groups(),
}


@pytest.mark.parametrize("kind", KINDS)
@RANDOM
@given(st.data(), st.integers(2, 6))
def test_planets_can_be_assembled_where_turning_them_tooth_by_tooth_finds_a_way(
    kind: str, data: st.DataObject, planets: int
) -> None:
    one = replace(data.draw(KINDS[kind]), planets=planets)
    expected = goes_in(one, planets)
    assert is_assembled(one) == expected
    if one.kind in ("planetary", "ravigneaux") and is_whole(one):
        wheels = {name: teeth for name, teeth in one.teeth.items() if name in one.members}
        assert is_assembled(replace(one, teeth=wheels)) == expected


def is_whole(one: Element) -> bool:
    """Whether planets that are not given fill the gap between their wheels as given ones do."""
    teeth = one.teeth
    if one.kind == "planetary":
        return teeth["ring"] == teeth["sun"] + 2 * teeth["planet"]
    return True


def test_a_message_names_the_formula_that_is_not_whole() -> None:
    stepped_teeth = {"sun": 30, "planet": 20, "planet2": 25, "ring2": 95}  # 2650/5 = 530
    own = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    long_only = {"large_sun": 35, "ring": 72, "short": 20, "long": 18}
    for kind, planets, teeth, formula in (
        ("planetary", 3, {"sun": 48, "ring": 96, "planet": 24}, ""),
        ("planetary", 3, {"sun": 48, "ring": 97, "planet": 24}, "(sun + ring)/planets = 145/3"),
        ("double_planet", 3, {"sun": 30, "ring": 91}, "(ring - sun)/planets = 61/3"),
        ("stepped", 2, stepped_teeth, ""),
        ("stepped", 5, stepped_teeth, ""),
        (
            *("stepped", 4, stepped_teeth),
            "(sun * planet2 + ring2 * planet)/(planets * gcd(planet, planet2)) = 2650/20",
        ),
        ("ravigneaux", 3, own, ""),
        ("ravigneaux", 3, own | {"small_sun": 31}, "(small_sun + large_sun)/planets = 67/3"),
        ("ravigneaux", 3, long_only, "(large_sun + ring)/planets = 107/3"),
        ("bevel", 4, {"left": 16, "right": 16, "planet": 10}, ""),
        ("bevel", 3, {"left": 16, "right": 16, "planet": 10}, "(left + right)/planets = 32/3"),
    ):
        problems = told(element(kind, planets, **teeth), "assembled")
        assert [formula + " is not whole" in one.message for one in problems] == [True] * bool(
            formula
        ), (kind, teeth)
        for one in problems:
            assert (one.severity, one.path) == ("warning", ("elements", 1, "planets"))
    assert "left 15, planet 10, right 15 (ratio -1)" in problems[0].message


def test_a_gearbox_that_is_built_can_be_assembled() -> None:
    """The multi-flow mechanism has three sets of planets; four do not go in."""
    assert not warnings(UMDM)
    assert goes_in(UMDM, 3)
    assert not is_assembled(replace(UMDM, planets=4))
    assert not goes_in(UMDM, 4)
    for planets, expected in ((3, 0), (4, 1)):
        case = set_case(umdm_cases.element(umdm_cases.GOLDEN, planets), umdm_cases.LINKS)
        assert sum("assembled" in one.message for one in reading(case).warnings) == expected


def test_nothing_is_said_where_the_number_of_planets_is_not_told() -> None:
    assert is_assembled(element("planetary", sun=17, ring=64, planet=23))
