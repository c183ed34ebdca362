"""Teeth of two wheels: undercut, interference, common divisors."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.elements.toothed import element, found, told


@pytest.mark.parametrize(
    ("teeth", "severity"), [(13, "note"), (14, "note"), (16, "note"), (17, None)]
)
def test_few_teeth_are_undercut(teeth: int, severity: str | None) -> None:
    for one in (
        element("gear_pair", first=41, second=teeth),
        element("idler", first=37, idler=teeth, second=41),
        element("internal_pair", first=teeth, second=61),
        element("planetary", sun=teeth, planet=20, ring=teeth + 40),
        element("planetary", sun=23, ring=23 + 2 * teeth),
        element("ravigneaux", small_sun=teeth, large_sun=29, ring=67),
        element("idler", first=teeth, second=41),
    ):
        doubtful = [p for p in found(one) if "undercut" in p.message]
        assert [problem.severity for problem in doubtful] == ([severity] if severity else [])


def test_tips_interfere_in_a_ring_that_is_hardly_larger() -> None:
    assert not told(element("internal_pair", first=40, second=48), "interfere")
    for pair in ({"first": 40, "second": 47}, {"first": 47, "second": 40}):
        (problem,) = told(element("internal_pair", **pair), "interfere")
        assert problem.severity == "warning"
        assert "their numbers of teeth differ by 7, expected 8 or more" in problem.message
    assert told(element("planetary", sun=5, planet=40, ring=45), "interfere")
    assert told(
        element("stepped", sun=20, planet=40, planet2=30, ring2=30),
        "planet2 30 does not fit into ring2 30",
    )


@given(st.integers(17, 60), st.integers(17, 60))
def test_teeth_meet_again_after_as_many_turns_as_is_told(first: int, second: int) -> None:
    """Counting tooth by tooth: tooth 0 of both meet again after so many teeth."""
    doubtful = told(element("gear_pair", first=first, second=second), "common divisor")
    passed = next(n for n in range(1, first * second + 1) if n % first == 0 == n % second)
    turns = passed // first
    if turns == second:
        assert not doubtful
        return
    (problem,) = doubtful
    often = "every turn of" if turns == 1 else f"every {turns} turns of"
    assert f"{often} first" in problem.message
    assert problem.severity == "note"


def test_common_divisors_of_an_element_are_told_together() -> None:
    (problem,) = told(element("planetary", 3, sun=48, ring=96, planet=24), "common divisor")
    assert "sun 48 and planet 24 have the common divisor 24" in problem.message
    assert "also ring 96 and planet 24 (24)" in problem.message
    assert (
        "nearest without a common divisor: sun 49, ring 95, planet 23 (ratio -1.9388)"
        in problem.message
    )
    assert not told(element("planetary", 3, sun=49, ring=95, planet=23), "common divisor")
    assert not told(element("planetary", sun=48, ring=96, planet=24), "common divisor")


def test_a_chain_wants_more_teeth() -> None:
    (problem,) = found(element("chain", first=16, second=40))
    assert problem.severity == "note"
    assert problem.path == ("elements", 1, "teeth", "first")
    assert not found(element("chain", first=17, second=40))
