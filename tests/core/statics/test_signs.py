"""Signs of the flow without losses, and the conventions for idle mechanisms."""

import re
from dataclasses import replace

import numpy as np
import pytest

from tests.core.statics.batches import chain
from tests.core.statics.differential import texts
from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from tests.shipped import shipped_results
from vstatics import Gear, solve

TURNED = ", idle convention crosses u = 1"


@pytest.mark.parametrize("convention", ["", pytest.param(TURNED, marks=pytest.mark.slow)])
def test_a_sign_is_turned_also_in_a_train_too_large_to_try_all_signs(convention: str) -> None:
    """Eleven pairs before a train of three: its efficiency times .97**11."""
    case = NASTY[f"turned{convention}"]
    [gear] = case.gears
    ends = case.gear_input(gear), case.gear_output(gear)
    case = replace(case, gears=[Gear()], input=ends[0], output=ends[1])
    [exact] = oracle.solve(case)
    assert exact.efficiency is not None
    results = solve(chain(11, case))
    assert results.efficiency == pytest.approx(0.97**11 * float(exact.efficiency))
    assert results.turned.any()
    assert results.consistent.all()


def test_a_gear_locked_by_friction_keeps_its_ideal_numbers() -> None:
    """A train of u = 1.004 driven from its slow end; without losses u/(u - 1) = 251."""
    results = shipped_results("self-locking.yaml")
    assert results.ratio == pytest.approx([251, 1 / 251])
    assert results.efficiency == pytest.approx([1 / 6, np.nan], nan_ok=True)
    assert list(results.locked) == (~results.consistent).tolist() == [False, True]
    assert np.isnan(results.lossy_torques[1]).all()
    assert results.power_sign[1] == [1]
    assert [one.id for one in results.messages] == ["W421"]
    coasting = shipped_results("self-locking.yaml", coast=True)
    assert coasting.locked[0]
    assert "self-locking when coasting" in texts(coasting)[0]


def test_a_flow_that_losses_turn_is_reported() -> None:
    for name in (name for name in NASTY if name.startswith("turned")):
        results = solve(NASTY[name])
        names = " and ".join(f"D{number + 1}" for number in np.nonzero(results.turned[0])[0])
        assert f"note: losses reverse the power flow through {names}" in texts(results)


def test_several_admissible_sets_of_signs_are_reported() -> None:
    for name in (name for name in NASTY if name.startswith("several")):
        said = [text for text in texts(solve(NASTY[name])) if "the largest efficiency is" in text]
        assert re.match(r"note: [2-9]\d* sets of power directions are", said[0])
