"""Planets beside one another do not touch."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.core.elements.toothed import RANDOM, double_planet, element, told, touching
from vstatics.core.elements import Element


@pytest.mark.parametrize(("planets", "limit"), [(3, 13.93), (4, 5.83), (5, 3.85), (6, 3.0)])
def test_neighbours_touch_beyond_the_known_ratio_of_large_sets(planets: int, limit: float) -> None:
    """(1 + sin(pi/n))/(1 - sin(pi/n)): the tips hardly count where there are so many teeth."""
    sun = 60000
    for ratio, expected in ((limit - 0.02, 0), (limit + 0.02, 1)):
        planet = round((ratio - 1) / 2 * sun)
        one = element("planetary", planets, sun=sun, planet=planet, ring=sun + 2 * planet)
        assert len(told(one, "touch")) == expected


def test_tips_of_neighbours_are_told_with_their_distance() -> None:
    assert not told(element("planetary", 4, sun=20, ring=100, planet=40), "touch")  # 42.43 > 42
    (problem,) = told(element("planetary", 5, sun=20, ring=100, planet=40), "touch")
    assert (
        "(sun + planet) sin(180°/5) = 35.27, expected more than planet + 2 = 42" in problem.message
    )
    assert "; 3 or 4 planets fit" in problem.message
    assert not told(element("planetary", sun=20, ring=100, planet=40), "touch")


def test_the_larger_rim_of_stepped_planets_touches_first() -> None:
    teeth = {"sun": 30, "planet": 20, "planet2": 40, "ring2": 90}
    assert not told(element("stepped", 3, **teeth), "touch")  # 50 * 0.866 = 43.3 > 42
    (problem,) = told(
        element("stepped", 4, **teeth), "touch"
    )  # 35.4, and 22 would do for the other
    assert "expected more than planet2 + 2 = 42" in problem.message


@RANDOM
@given(double_planet(), st.integers(2, 6))
def test_meshed_planets_touch_where_their_tip_circles_meet(one: Element, planets: int) -> None:
    teeth = one.teeth
    inner, outer = teeth["sun"] + teeth["inner"], teeth["ring"] - teeth["outer"]
    assume(abs(inner - outer) < teeth["inner"] + teeth["outer"] < inner + outer)
    assert bool(told(replace(one, planets=planets), "neighbouring planets")) == touching(
        one, planets
    )
