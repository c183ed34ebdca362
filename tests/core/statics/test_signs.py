"""Signs of the flow without losses, and the conventions for idle mechanisms."""

import re
from dataclasses import replace

import numpy as np
import pytest

from tests.core.statics.batches import chain
from tests.core.statics.differential import texts, train
from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from tests.shipped import shipped_results
from vstatics import Gear, solve
from vstatics.core.numerics.traced import is_nan
from vstatics.core.statics.signs import ideal_signs


def test_a_gear_without_motion_has_no_signs() -> None:
    signs = ideal_signs(solve(train([(2, 0)], Gear())).gear(1).ideal, moving=False)
    assert all(is_nan(x) for x in signs.signs)
    assert signs.idle == [False]


@pytest.mark.parametrize(
    "name",
    ["turned", pytest.param("turned, idle convention crosses u = 1", marks=pytest.mark.slow)],
)
def test_a_sign_is_turned_also_in_a_train_too_large_to_try_all_signs(name: str) -> None:
    """Eleven pairs before a train of three: its efficiency times .97**11."""
    case = replace(NASTY[name], gears=[Gear()], input=NASTY[name].gear_input(NASTY[name].gears[0]))
    case = replace(case, output=NASTY[name].gear_output(NASTY[name].gears[0]))
    (exact,) = oracle.solve(case)
    assert exact.efficiency is not None
    results = solve(chain(11, case))
    assert results.efficiency == pytest.approx(0.97**11 * float(exact.efficiency))
    assert results.turned.any()
    assert results.consistent.all()


def test_a_gear_locked_by_friction_keeps_its_ideal_numbers() -> None:
    """A train of u = 1.004 driven from its slow end; without losses u/(u - 1) = 251."""
    results = shipped_results("self-locking.yaml")
    assert results.ratio == pytest.approx([251, 1 / 251])
    assert results.efficiency[0] == pytest.approx(1 / 6)
    assert list(results.locked) == [False, True]
    assert list(results.consistent) == [True, False]
    assert np.isnan([results.efficiency[1], *results.lossy_torques[1]]).all()
    assert results.power_sign[1] == [1]
    assert texts(results) == [
        "warning: self-locking: no direction of power flow is consistent with the losses"
    ]
    coasting = shipped_results("self-locking.yaml", coast=True)
    assert coasting.locked[0]
    assert "self-locking when coasting" in texts(coasting)[0]


@pytest.mark.parametrize("name", [name for name in NASTY if name.startswith("turned")])
def test_a_flow_that_losses_turn_is_told(name: str) -> None:
    results = solve(NASTY[name])
    (exact,) = oracle.solve(NASTY[name])
    assert exact.efficiency is not None
    assert results.efficiency[0] == pytest.approx(float(exact.efficiency))
    names = " and ".join(f"D{number + 1}" for number in np.nonzero(results.turned[0])[0])
    assert f"note: losses reverse the power flow through {names}" in texts(results)


@pytest.mark.parametrize("name", [name for name in NASTY if name.startswith("several")])
def test_several_admissible_sets_of_signs_are_told(name: str) -> None:
    results = solve(NASTY[name])
    (exact,) = oracle.solve(NASTY[name])
    assert exact.several
    told = [text for text in texts(results) if "the largest efficiency is shown" in text]
    assert re.match(r"note: [2-9]\d* sets of power directions are", told[0])
