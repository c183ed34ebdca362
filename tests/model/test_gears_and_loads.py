"""What can be no gear: told with its path."""

from __future__ import annotations

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.model.parts import ElementKind


@pytest.mark.parametrize(
    ("kind", "gear"),
    [
        ("", Gear(drag={3: 0.1})),
        ("", Gear(drag={2: float("nan")})),
        ("", Gear(open_drag={2: 0.1})),
        ("dog_clutch", Gear(open_drag={1: 0.1})),
    ],
)
def test_what_can_be_no_drag_is_refused(kind: ElementKind, gear: Gear) -> None:
    with pytest.raises(CaseError) as caught:
        Transmission(2, [ShiftElement(1, 2, kind=kind)], [Mechanism(1, 2, 0, 4)], [gear])
    (problem,) = caught.value.problems
    assert problem.path[:2] == ("gears", 1)
