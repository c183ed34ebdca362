"""Springs with points in a vibrating gear: the slope at what each carries at mean speeds."""

import math

import pytest

from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Spring, Transmission
from vstatics.torsion.system.slopes import spring_slopes
from vstatics.torsion.vibration.gear_modes import modes

POINTS = [(0, 0), (0.1, 0), (0.2, 30), (0.3, 90)]
"""Play, 300 N*m/rad up to 30 N*m, 600 N*m/rad beyond."""


def driven(torque: float | None = None, efficiency: float = 1.0) -> Transmission:
    """A mass of 1 kg*m^2, a pair that turns it half as fast, the spring, a mass of 2 kg*m^2."""
    return Transmission(
        3, [], [Mechanism(1, 2, 0, -2.0, efficiency)], [], inertias={1: 1.0, 3: 2.0},
        springs=[Spring({2: 1, 3: -1}, points=POINTS, name="S")],
        load=None if torque is None else Load(torque=torque),
    )  # fmt: skip


def carried(case: Transmission) -> tuple[float, float]:
    [one] = spring_slopes(case, case.gears[0])
    return one.torque, one.slope


def test_a_gear_vibrates_with_the_slope_at_twice_the_load() -> None:
    """On the second link there are 4 kg*m^2 on one side, 2 on the other."""
    for torque, slope in ((10.0, 300.0), (-10.0, 300.0), (20.0, 600.0), (400.0, 600.0)):
        case = driven(torque)
        assert carried(case) == pytest.approx((-2 * torque, slope))
        [gear] = modes(case)
        assert gear.modes[0].omega == pytest.approx(math.sqrt(slope * (1 / 4 + 1 / 2)))
        assert gear.slopes == {"S": pytest.approx(slope)}


@pytest.mark.parametrize("torque", [None, 0.0])
def test_without_a_load_the_spring_is_in_play_and_joins_nothing(torque: float | None) -> None:
    [gear] = modes(driven(torque))
    assert (gear.rigid_modes, gear.modes, gear.slopes) == (2, [], {"S": 0.0})


def test_losses_count() -> None:
    """15.5 N*m times 2 would be past the corner, 0.9 of it is not."""
    assert carried(driven(15.5)) == pytest.approx((-31, 600))
    assert carried(driven(15.5, 0.9)) == pytest.approx((-27.9, 300))


def test_each_gear_has_its_own_load_and_in_neutral_a_spring_carries_nothing() -> None:
    case = Transmission(
        3, [ShiftElement(1, 2, name="C")], [],
        [Gear([1]), Gear([1], load=Load(torque=40.0)), Gear()], inertias={1: 1, 2: 1, 3: 2},
        springs=[Spring({2: 1, 3: -1}, points=POINTS, name="S")], load=Load(torque=20),
    )  # fmt: skip
    assert [gear.slopes["S"] for gear in modes(case)] == pytest.approx([300, 600, 0])
    slopes = [gear.slopes["S"] for gear in modes(case.with_torque(3.0))]
    assert slopes == pytest.approx([300, 300, 0])


def test_beside_another_spring_statics_does_not_know_what_it_carries() -> None:
    case = driven(10.0)
    case = case.replace(springs=[*case.springs, Spring({2: 1, 3: -1}, 100.0, name="Z")])
    with pytest.raises(CaseError, match=r"springs\[1\]\.points: the torque of S in gear 1 is ind"):
        modes(case)
    [gear] = modes(case.with_torque(0.0))
    assert gear.modes[0].omega == pytest.approx(math.sqrt(100 * (1 / 4 + 1 / 2)))
