"""What can be no gear: told with its path."""

from __future__ import annotations

from typing import Any

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.model.parts import ElementKind, Friction


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


@pytest.mark.parametrize(
    "more", [{"static": 1.2}, {"friction": Friction(0.1, 0.006, 8, ((0, 0.1),))}]
)
def test_a_dog_clutch_has_no_friction(more: dict[str, Any]) -> None:
    clutch, pairs = ShiftElement(1, 2, kind="clutch", **more), [Mechanism(1, 2, 0, 4)]
    assert Transmission(2, [clutch], pairs, [Gear()]).shift_elements[0].kind == "clutch"
    with pytest.raises(CaseError, match=f"dog clutch has no friction, .* `{next(iter(more))}`"):
        Transmission(2, [clutch._replace(kind="dog_clutch")], pairs, [Gear()])
