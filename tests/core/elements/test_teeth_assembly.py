"""A case is warned of planets that cannot be put in, exactly when they cannot.

Whether they can is found by putting them in, one after the other (`phases`). The warning
is the one that says `assembled`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.core.elements.element_cases import (
    LETTERS,
    RAVIGNEAUX,
    STEPPED,
    double_teeth,
    ravigneaux_teeth,
    reading,
    set_case,
    simple_teeth,
    stepped_teeth,
)
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
from tests.oracle.phases import (
    Contact,
    Group,
    Wheel,
    assembles,
    assembles_double,
    assembles_ravigneaux,
    assembles_rims,
    assembles_simple,
    triangle,
)
from tests.published import umdm_cases

COUNTS = st.integers(2, 6)

EXAMPLES = settings(max_examples=count(6, 60))


def warned(element: Mapping[str, Any], members: Sequence[str]) -> bool:
    """Whether the program doubts that the planets of a set can be assembled."""
    told = [
        problem
        for problem in reading(set_case(element, members)).warnings
        if "assembled" in problem.message
    ]
    assert all(problem.severity == "warning" for problem in told)
    assert len(told) <= 1
    return bool(told)


@given(teeth=simple_teeth(), n=COUNTS)
@EXAMPLES
def test_planetary_set(teeth: Mapping[str, int], n: int) -> None:
    element = {
        "kind": "planetary",
        "sun": "S",
        "ring": "R",
        "carrier": "C",
        "teeth": dict(teeth),
        "planets": n,
    }
    can = assembles_simple(teeth["sun"], teeth["planet"], teeth["ring"], n)
    assert warned(element, "SRC") != can


@given(teeth=simple_teeth(), n=COUNTS)
@EXAMPLES
def test_planetary_set_without_teeth_of_the_planet(teeth: Mapping[str, int], n: int) -> None:
    element = {
        "kind": "planetary",
        "sun": "S",
        "ring": "R",
        "carrier": "C",
        "teeth": {"sun": teeth["sun"], "ring": teeth["ring"]},
        "planets": n,
    }
    can = assembles_simple(teeth["sun"], teeth["planet"], teeth["ring"], n)
    assert warned(element, "SRC") != can


@given(teeth=double_teeth(), n=COUNTS)
@EXAMPLES
def test_set_with_meshed_planets(teeth: Mapping[str, int], n: int) -> None:
    element = {
        "kind": "double_planet",
        "sun": "S",
        "ring": "R",
        "carrier": "C",
        "teeth": dict(teeth),
        "planets": n,
    }
    can = assembles_double(teeth["sun"], teeth["inner"], teeth["outer"], teeth["ring"], n)
    assert warned(element, "SRC") != can


@pytest.mark.slow
@pytest.mark.parametrize("wheels", STEPPED, ids=" ".join)
@given(data=st.data())
@EXAMPLES
def test_set_with_stepped_planets(wheels: Sequence[str], data: st.DataObject) -> None:
    teeth, n = data.draw(stepped_teeth(wheels)), data.draw(COUNTS)
    products = {
        teeth[wheel] * teeth["planet" if wheel.endswith("2") else "planet2"] for wheel in wheels
    }
    assume(len(products) == len(wheels))  # no two wheels are one on a standing carrier
    element = {
        "kind": "stepped",
        **{wheel: LETTERS[wheel] for wheel in wheels},
        "carrier": "C",
        "teeth": teeth,
        "planets": n,
    }
    told = [
        Wheel(teeth[wheel], "rim2" if wheel.endswith("2") else "rim1", wheel.startswith("ring"))
        for wheel in wheels
    ]
    can = assembles_rims(teeth["planet"], teeth["planet2"], told, n)
    assert warned(element, [*(LETTERS[wheel] for wheel in wheels), "C"]) != can


@pytest.mark.parametrize("wheels", RAVIGNEAUX, ids=" ".join)
@given(data=st.data(), told=st.booleans())
@EXAMPLES
def test_ravigneaux_set(wheels: Sequence[str], data: st.DataObject, *, told: bool) -> None:
    """The teeth of the planets need not be told."""
    teeth, n = data.draw(ravigneaux_teeth()), data.draw(COUNTS)
    known = [*wheels, *(("short", "long") if told else ())]
    element = {
        "kind": "ravigneaux",
        **{wheel: LETTERS[wheel] for wheel in wheels},
        "carrier": "C",
        "teeth": {wheel: teeth[wheel] for wheel in known},
        "planets": n,
    }
    small, large, ring = (
        teeth[wheel] if wheel in wheels else None for wheel in ("small_sun", "large_sun", "ring")
    )
    can = assembles_ravigneaux(small, large, teeth["short"], teeth["long"], ring, n)
    assert warned(element, [*(LETTERS[wheel] for wheel in wheels), "C"]) != can


@st.composite
def umdm_teeth(draw: st.DrawFn) -> dict[str, int]:
    """Of the multi-flow mechanism; often such that nothing but one wheel is wrong."""
    golden = {"1": 36, "2": 18, "6": 72, "2'": 21, "3": 30, "7": 84, "3'": 20, "4": 34, "8": 74}
    changed = draw(st.sets(st.sampled_from(list(golden)), max_size=3))
    return golden | {wheel: golden[wheel] + draw(st.integers(-3, 3)) for wheel in changed}


@given(z=umdm_teeth(), n=st.integers(2, 4))
@EXAMPLES
def test_group_of_planets(z: Mapping[str, int], n: int) -> None:
    """The multi-flow mechanism: two planets of two rims, five wheels."""
    place, line = triangle(27, 27, 25.5)
    simulated = Group(
        {"A": {"2": z["2"], "2'": z["2'"]}, "B": {"3": z["3"], "3'": z["3'"]}},
        {"A": place - place, "B": place},
        [
            Wheel(z["1"], "2", internal=False),
            Wheel(z["6"], "2", internal=True),
            Wheel(z["7"], "3", internal=True),
            Wheel(z["4"], "3'", internal=False),
            Wheel(z["8"], "3'", internal=True),
        ],
        [Contact("2'", "3", line)],
    )
    assert warned(umdm_cases.element(z, n), umdm_cases.LINKS) != assembles(simulated, n)


def test_nothing_is_said_where_the_number_of_planets_is_not_told() -> None:
    element = {
        "kind": "planetary",
        "sun": "S",
        "ring": "R",
        "carrier": "C",
        "teeth": {"sun": 17, "ring": 64, "planet": 23},
    }
    assert not warned(element, "SRC")


def test_planets_go_in_where_sun_and_ring_add_up_to_a_multiple_of_them() -> None:
    assert is_assembled(element("planetary", 3, sun=48, ring=96, planet=24))
    (problem,) = told(element("planetary", 3, sun=48, ring=97, planet=24), "assembled")
    assert "(sun + ring)/planets = 145/3 is not whole" in problem.message
    assert problem.path == ("elements", 1, "planets")
    assert problem.severity == "warning"


def test_meshed_planets_go_in_where_the_difference_is_a_multiple_of_them() -> None:
    assert is_assembled(element("double_planet", 3, sun=30, inner=20, outer=20, ring=90))
    (problem,) = told(element("double_planet", 3, sun=30, ring=91), "assembled")
    assert "(ring - sun)/planets = 61/3 is not whole" in problem.message


@pytest.mark.slow
@pytest.mark.parametrize(
    ("planets", "formula"),
    [
        # (30 * 25 + 95 * 20)/gcd(20, 25) = 530
        (2, ""),
        (5, ""),
        (3, "(sun * planet2 + ring2 * planet)/(planets * gcd(planet, planet2)) = 2650/15"),
        (4, "(sun * planet2 + ring2 * planet)/(planets * gcd(planet, planet2)) = 2650/20"),
    ],
)
def test_stepped_planets_go_in_by_the_rims_that_they_join(planets: int, formula: str) -> None:
    doubtful = told(
        element("stepped", planets, sun=30, planet=20, planet2=25, ring2=95), "assembled"
    )
    assert [formula in problem.message for problem in doubtful] == ([True] if formula else [])


def test_ravigneaux_planets_go_in_by_both_suns() -> None:
    teeth = {"small_sun": 30, "large_sun": 36, "ring": 72, "short": 20, "long": 18}
    assert is_assembled(element("ravigneaux", 3, **teeth))
    (problem,) = told(element("ravigneaux", 3, **teeth | {"small_sun": 31}), "assembled")
    assert "(small_sun + large_sun)/planets = 67/3 is not whole" in problem.message
    del teeth["small_sun"]
    (problem,) = told(element("ravigneaux", 3, **teeth | {"large_sun": 35}), "assembled")
    assert "(large_sun + ring)/planets = 107/3 is not whole" in problem.message


def test_a_gearbox_that_is_built_can_be_assembled() -> None:
    assert not warnings(UMDM)
    assert goes_in(UMDM, 3)
    assert not is_assembled(replace(UMDM, planets=4))
    assert not goes_in(UMDM, 4)


def test_bevel_planets_go_in_where_both_sides_add_up_to_a_multiple_of_them() -> None:
    assert is_assembled(element("bevel", 4, left=16, right=16, planet=10))
    (problem,) = told(element("bevel", 3, left=16, right=16, planet=10), "assembled")
    assert "(left + right)/planets = 32/3 is not whole" in problem.message
    assert "left 15, planet 10, right 15 (ratio -1)" in problem.message


@pytest.mark.slow
@RANDOM
@given(st.data(), st.integers(2, 5))
def test_planets_can_be_assembled_where_turning_them_tooth_by_tooth_finds_a_way(
    data: st.DataObject, planets: int
) -> None:
    one = data.draw(st.one_of(planetary(), double_planet(), stepped(), ravigneaux(), groups()))
    one = replace(one, planets=planets)
    assert is_assembled(one) == goes_in(one, planets)
