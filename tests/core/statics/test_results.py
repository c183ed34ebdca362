"""Results: arrays that stay as they are, rows as they are named, the gears of one case."""

import pickle
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest

from tests.core.statics.batches import random_case
from tests.core.statics.differential import train
from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Transmission, solve


def test_results_are_for_the_case_given_and_speak_of_nothing() -> None:
    case, u, _ = random_case(3)
    results = solve(case, ratios=u, coast=not case.coast)
    assert results.case == replace(case, coast=not case.coast)
    assert results.messages == ()


def test_results_are_equal_where_case_numbers_and_loads_are() -> None:
    """A neutral has NaN, which is no difference; two loads differ by what is in N*m alone."""
    gears = [Gear([1]), Gear(name="N")]
    case = train([(2, 0)], gears[0]).replace(gears=gears, load=Load(2000, 300))
    assert solve(case) == solve(case) == pickle.loads(pickle.dumps(solve(case)))  # noqa: S301
    assert solve(case) != solve(case.replace(load=Load(2000, 200)))
    varied = [solve(case, vary={"load.torque": [100, second]}) for second in (200, 200, 300)]
    assert varied[0] == varied[1] != varied[2]
    assert solve(case) not in [*varied, solve(case, ratios=[[-2.5]]), None, case]


def test_states_and_parts_can_be_copied_and_sent_to_another_process() -> None:
    """Source: github.com/OpenSourceEconomics/pylcm/issues/449 (read-only mappings in results)."""
    case = train([(2, 0)], Gear([1]))
    state = solve(case).gear(1)
    for copied in (pickle.loads(pickle.dumps(state)), deepcopy(state)):  # noqa: S301
        assert copied == state
    assert deepcopy(Gear([1])) == Gear([1])
    for change in ("__setitem__", "setdefault", "update", "__ior__"):
        with pytest.raises(TypeError, match="cannot be changed"):
            getattr(Gear().drag, change)({2: 3.0})


def test_a_unit_in_a_path_is_refused_with_the_unit_that_counts() -> None:
    with pytest.raises(CaseError, match=r"\[rpm\]`; expected `load.speed`, in rad/s"):
        solve(train([(2, 0)], Gear([1])), vary={"load.speed [rpm]": [1000]})


def test_a_gear_is_one_of_a_single_case() -> None:
    case = train([(2, 0)], Gear([1]))
    with pytest.raises(ValueError, match="a gear belongs to a single case"):
        solve(case, ratios=[[-2.0], [-3.0]]).gear(1)
    for number in (0, 2, -1):
        with pytest.raises(ValueError, match="no gear"):
            solve(case).gear(number)


def test_marks_of_a_gear_without_solution_do_not_exist() -> None:
    """Nothing can be idle or locked in neutral; what was measured there is no false."""
    results = solve(train([(2, 0)], Gear([1])))
    neutral = solve(train([(2, 0)], Gear()))
    for name in ("idle", "consistent", "locked"):
        assert not np.isnan(results.existing(name)).any()
        assert np.isnan(neutral.existing(name)).all()


def test_freewheels_that_hold_become_plain_elements() -> None:
    """A freewheel holds the ring when driving and overruns when a clutch makes one piece."""
    held = ShiftElement(2, 0, "F", "freewheel"), ShiftElement(1, 2, "C")
    mechanisms = [Mechanism(1, 2, 3, -2.0, 0.97)]
    results = solve(Transmission(3, held, mechanisms, [Gear(), Gear([2])]))
    states = [results.gear(number) for number in (1, 2)]
    assert [(list(one.engaged), one.holding) for one in states] == [([1], [1]), ([2], [])]
    assert states[1].slip_speeds == pytest.approx([1, 0])
    plain = results.with_freewheels_engaged
    assert not plain.freewheels
    assert [list(gear.engaged) for gear in plain.gears] == [[1], [2]]
    assert solve(plain).ratio == pytest.approx([3, 1])
    assert results.ratio == pytest.approx([3, 1])
