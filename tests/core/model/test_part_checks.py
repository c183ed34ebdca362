"""What can be no shift element, no mechanism: told with its path."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission


@pytest.mark.parametrize("wrong", ["F1", 1.0, None])
def test_a_part_is_told_by_its_number(wrong: object) -> None:
    with pytest.raises(CaseError, match="expected the number of a shift element"):
        Transmission(2, [ShiftElement(1, 2)], [], [Gear([wrong])])  # type: ignore[list-item]
    with pytest.raises(CaseError, match="expected a link number"):
        Transmission(2, [ShiftElement(wrong, 2)], [], [Gear([1])])  # type: ignore[arg-type]


@pytest.mark.parametrize("wrong", [-0.1, 1.1, float("nan")])
def test_an_efficiency_that_is_none(wrong: float) -> None:
    with pytest.raises(CaseError) as caught:
        Transmission(2, [], [Mechanism(1, 2, 0, 20, 0.8, back_efficiency=wrong)], [Gear()])
    (problem,) = caught.value.problems
    assert problem.path == ("mechanisms", 1, "back_efficiency")
    assert "expected an efficiency from 0 (self-locking) to 1" in problem.message


@pytest.mark.parametrize("kind", ["ratchet", "brake"])
def test_kinds_are_checked(kind: str) -> None:
    def made(elements: Sequence[ShiftElement]) -> Transmission:
        return Transmission(3, elements, [Mechanism(1, 2, 3, -2.0)], [Gear()])

    with pytest.raises(CaseError) as caught:
        made([ShiftElement(1, 2, "X", kind)])  # type: ignore[arg-type]
    (problem,) = caught.value.problems
    assert problem.path == ("shift_elements", 1, "kind")


def test_a_converter_without_points_is_told_so() -> None:
    """Not as an error of the program, also with a third link, and without a speed ratio."""
    converter = Mechanism(1, 2, 3, math.nan, kind="converter")
    with pytest.raises(CaseError) as caught:
        Transmission(3, [], [converter], [Gear()])
    paths = [problem.path for problem in caught.value.problems]
    assert ("mechanisms", 1, "points") in paths
    assert ("mechanisms", 1, "third") in paths
