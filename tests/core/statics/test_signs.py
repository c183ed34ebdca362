"""Signs of the flow without losses, and the conventions for idle mechanisms."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.core.statics.differential import SET, train
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.transmission import IdleConvention
from vstatics.core.numerics.traced import is_nan
from vstatics.core.statics.signs import ideal_signs


@pytest.mark.parametrize("coast", [False, True])
def test_a_convention_does_not_lock_what_turns_as_one_piece(*, coast: bool) -> None:
    """By the published convention u * eta = 1 here, which passes no torque to the output."""
    mechanisms = [Mechanism(1, 2, 3, 2.0, 0.5)]
    case = Transmission(3, [ShiftElement(1, 2)], mechanisms, [Gear([1])], idle="published")
    results = solve(replace(case, coast=coast))
    assert not results.locked[0]
    assert results.efficiency[0] == pytest.approx(1)


def test_power_enters_by_the_sun_or_leaves_by_it() -> None:
    """Equation (5), sign(M (w_f - w_h)): ring held, M = 1 on the sun: 1 - 1/3 of speed."""
    case = train([(2, 0)], Gear([1]))
    assert solve(case).power_sign[0] == [1]
    reverse = replace(case, gears=[Gear([1], input=3, output=1)])
    assert solve(reverse).power_sign[0] == [-1]


def test_coasting_turns_the_signs() -> None:
    case = train([(2, 0)], Gear([1]))
    assert solve(case, coast=True).power_sign[0] == [-1]


def test_conventions_differ_for_what_is_idle() -> None:
    """docs/method.md, idle mechanisms: 0; or +1 without torque, sign(u) as one piece."""
    unloaded = train([(1, 4)], Gear([1]), links=4, output=4)
    one_piece = train([(1, 2)], Gear([1]))
    for case, published in ((unloaded, 1), (one_piece, -1)):
        assert solve(case, idle="exact").power_sign[0] == [0]
        assert solve(case, idle="published").power_sign[0] == [published]
        assert solve(case).idle.all()


@pytest.mark.parametrize(("idle", "x"), [("exact", 0), ("published", -1)])
def test_the_convention_decides_how_a_clutch_and_a_set_share(idle: IdleConvention, x: int) -> None:
    """One piece: the set carries 1/(1 - u eta**x) of the output torque, the clutch the rest."""
    results = solve(train([(1, 2)], Gear([1])), idle=idle)
    shared = 1 / (1 - SET.ratio * SET.efficiency**x)
    assert results.lossy_torques[0] == pytest.approx([1 - shared, shared, 1])


def test_a_gear_without_motion_has_no_signs() -> None:
    signs = ideal_signs(solve(train([(2, 0)], Gear())).gear(1).ideal, moving=False)
    assert all(is_nan(x) for x in signs.signs)
    assert signs.idle == [False]
