"""What a shift element carries by the load of its gear, against its capacity."""

import pytest

from tests.chance import seeded
from vstatics import Gear, Load, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.numerics.tolerances import VISIBLE_EXCESS as MORE


@pytest.mark.parametrize("load", [None, 400.0, -150.0])
def test_more_than_the_capacity_is_reported_of_its_gear_alone(load: float | None) -> None:
    """A held ring of a set of ratio u bears -u times the torque of the sun."""
    chance = seeded(5)
    for _ in range(20):
        u, part = chance.uniform(1.5, 4), chance.choice([0.5, 1 - MORE, 1 + MORE / 2, 1.01, 3])
        clutch, brake = ShiftElement(1, 2, "C", capacity=2.0), ShiftElement(2, 0, capacity=u / part)
        gears = [Gear([2], name="low"), Gear([1], name="high")]
        case = Transmission(3, [clutch, brake], [Mechanism(1, 2, 3, -u)], gears)
        case = case.replace(load=None if load is None else Load(1000.0, load))
        said = [(one.id, one.gear) for one in solve(case).messages]
        assert said == ([("W430", "low")] if part > 1 + MORE else [])


def test_a_gear_with_a_load_of_its_own_is_held_against_that() -> None:
    elements = [ShiftElement(2, 0, "B", capacity=3.0)]
    gears = [Gear([1], name="a"), Gear([1], name="b", load=Load(None, 260))]
    case = Transmission(3, elements, [Mechanism(1, 2, 3, -2.5)], gears, load=Load(1000.0, 200.0))
    (one,) = solve(case).messages
    said = "B carries 650 N*m, more than its torque capacity of 600 N*m"  # 2.5 * 260, 3 * 200
    assert (one.gear, one.text) == ("b", said)
