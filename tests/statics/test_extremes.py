"""Ratios at the ends of what numbers can hold: no fault, no hang, no wrong verdict."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import vstatics
from vstatics import Gear, Mechanism, ShiftElement, Transmission, distribution_matrix, solve

CASES = Path(__file__).parents[2] / "cases"
EXTREME = st.sampled_from(
    [1e308, -1e308, 1e200, 1e160, 1e10, -2.0, 0.5, 1.0 + 1e-15, 1e-10, 1e-160, -1e-200, 1e-308]
)


@settings(max_examples=60)
@given(st.data(), st.sampled_from(["zf-8hp70", "umdm", "two-stage"]), st.integers(1, 3))
def test_extreme_ratios_end_in_results(data: st.DataObject, name: str, variants: int) -> None:
    case = vstatics.load(CASES / f"{name}.yaml")
    ratios = data.draw(
        st.lists(EXTREME, min_size=len(case.mechanisms), max_size=len(case.mechanisms))
    )
    results = solve(case, ratios=[ratios] * variants)
    assert not np.isinf(results.torques).any()
    assert results.speeds.shape == (variants, len(case.gears), case.own_links)


def test_a_huge_ratio_does_not_hide_a_direct_gear() -> None:
    case = Transmission(3, [ShiftElement(1, 2)], [Mechanism(1, 2, 3, 1e308)], [Gear([1])])
    speeds = solve(case).speeds[0]
    assert not (speeds == 0).any()  # all links turn as one; what overflows is not told


@pytest.mark.parametrize("coast", [False, True])
def test_a_convention_does_not_lock_what_turns_as_one_piece(*, coast: bool) -> None:
    """By the published convention u * eta = 1 here, which passes no torque to the output."""
    mechanisms = [Mechanism(1, 2, 3, 2.0, 0.5)]
    case = Transmission(3, [ShiftElement(1, 2)], mechanisms, [Gear([1])], idle="published")
    results = solve(replace(case, coast=coast))
    assert not results.locked[0]
    assert results.efficiency[0] == pytest.approx(1)


def test_no_variants_give_empty_results() -> None:
    case = vstatics.load(CASES / "mzkt7922.yaml")
    results = solve(case, ratios=np.empty((0, 3)))
    assert results.torques.shape == (0, 6, 9)
    assert not results.failed


def test_arrays_of_another_shape_are_refused() -> None:
    case = vstatics.load(CASES / "mzkt7922.yaml")
    for wrong in ([1.0, 2.0], 1.0, np.ones((3, 2))):
        with pytest.raises(ValueError, match="expected a last axis of 3"):
            solve(case, ratios=wrong)
        with pytest.raises(ValueError, match="expected a last axis of 3"):
            distribution_matrix(case, wrong)


@pytest.mark.parametrize("wrong", ["F1", 1.0, None])
def test_a_part_is_told_by_its_number(wrong: object) -> None:
    with pytest.raises(vstatics.CaseError, match="expected the number of a shift element"):
        Transmission(2, [ShiftElement(1, 2)], [], [Gear([wrong])])  # type: ignore[list-item]
    with pytest.raises(vstatics.CaseError, match="expected a link number"):
        Transmission(2, [ShiftElement(wrong, 2)], [], [Gear([1])])  # type: ignore[arg-type]
