"""What can be no gear: told with its path."""

from __future__ import annotations

import re

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.model.parts import ElementKind, Load, load_of


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
    ("load", "said"),
    [
        (Load(1000.0, 100.0, 50.0), "read 50 kW, which at 1000 rpm are 477.465 N*m"),
        (Load(1000.0, power=50.0), "expected these as `torque`, or no `power`"),
        (Load(torque=100.0, power=50.0), "read 50 kW without a speed"),
        (Load(1000.0, 0.0, 0.0), "read 0 kW"),
    ],
)
@pytest.mark.parametrize("of_gear", [False, True])
def test_the_power_of_a_load_is_that_of_its_torque(load: Load, said: str, *, of_gear: bool) -> None:
    """Documents have the power in place of the torque, so that they would be another case."""
    gear = Gear(load=load if of_gear else None)
    with pytest.raises(CaseError, match=re.escape(said)):
        Transmission(2, [], [Mechanism(1, 2, 0, 4)], [gear], load=None if of_gear else load)


@pytest.mark.parametrize("coast", [False, True])
@pytest.mark.parametrize("speed", [1000.0, -1000.0])
def test_a_load_that_is_turned_has_its_power_turned(speed: float, *, coast: bool) -> None:
    told = load_of(speed, power=50.0)
    case = Transmission(2, [], [Mechanism(1, 2, 0, 4)], [Gear(load=told)], coast=coast)
    turned = case.gear_load(case.gears[0])
    assert turned.power == (-50.0 if coast else 50.0)
    assert case.replace(gears=[Gear(load=turned)]).gear_load(case.gears[0]) == turned
