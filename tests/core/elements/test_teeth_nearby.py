"""Nearby teeth that can be made are suggested."""

import math
from collections.abc import Mapping
from dataclasses import replace

from hypothesis import assume, given
from hypothesis import strategies as st

from tests.core.elements.toothed import (
    RANDOM,
    UMDM,
    double_planet,
    element,
    found,
    goes_in,
    planetary,
    ravigneaux,
    stepped,
    suggestions,
    told,
    warnings,
)
from vstatics.core.elements import CentralWheel


def test_nearby_teeth_are_told_with_their_ratio() -> None:
    (problem,) = told(element("planetary", 3, sun=48, ring=97), "nearest that fit")
    assert problem == found(element("planetary", 3, sun=48, ring=97))[0]  # of two that it cures
    assert problem.message.endswith(
        "; nearest that fit: sun 48, ring 96 (ratio -2) or sun 47, ring 97 (ratio -2.0638)"
    )


def test_a_pair_keeps_its_ratio_where_a_wheel_grows() -> None:
    (problem,) = told(element("gear_pair", first=12, second=41), "undercut")
    assert "; nearest that fit: first 14, second 48 (ratio -3.4286)" in problem.message


def test_of_many_wheels_those_that_change_are_told() -> None:
    other = replace(UMDM, wheels=[*UMDM.wheels[:4], CentralWheel("8", 5, 75, True, "B2")])
    (problem,) = told(other, "nearest that fit")
    # 74/28 = 2.6429 and so on: the published teeth
    assert (
        "; nearest that fit: ring `8` 74 (ratios 2.6429, -2.1765, -1.3214, 1.3214)"
        in problem.message
    )


@RANDOM
@given(st.data(), st.integers(2, 5))
def test_what_is_suggested_passes_every_check(data: st.DataObject, planets: int) -> None:
    one = data.draw(st.one_of(planetary(), double_planet(), stepped(), ravigneaux()))
    one = replace(one, planets=planets)
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
    one = element("planetary", planets, sun=sun, ring=ring)
    doubtful = told(one, "assembled")
    assume(doubtful)
    assume(suggestions(doubtful[0]))

    def distance(teeth: Mapping[str, float]) -> float:
        change = math.log(teeth["ring"] / ring) - math.log(teeth["sun"] / sun)
        return abs(teeth["sun"] - sun) + abs(teeth["ring"] - ring) + 100 * abs(change)

    best = min(distance(teeth) for teeth in suggestions(doubtful[0]))
    for s in range(max(sun - 3, 17), sun + 4):
        for r in range(ring - 3, ring + 4):
            if (s + r) % planets == 0 == (r - s) % 2 and distance(
                {"sun": s, "ring": r}
            ) < best - 1e-9:
                p = (r - s) // 2
                assert (s + p) * math.sin(math.pi / planets) <= p + 2 or p < 17
