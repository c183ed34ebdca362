"""Gears without a single solution, and what is said of them.

Expected numbers are closed forms, given beside each case, or those of exact arithmetic
(`oracle`). Unless told otherwise the train is a differential of ratio u = -2 with the
links 1 (sun), 2 (ring) and 3 (carrier).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from tests.commands import CASES, MZKT, vstatics
from tests.oracle import gears as oracle
from tests.oracle.cases import NASTY
from vstatics import Gear, Mechanism, Results, ShiftElement, Transmission, load, solve
from vstatics.readers.named.reader import read_json
from vstatics.writers.named import write_json

SET = Mechanism(1, 2, 3, ratio=-2.0, efficiency=0.97)

HALF = 0.5e-4 + 1e-12


def train(
    elements: Sequence[tuple[int, int]], gear: Gear, *, links: int = 3, output: int = 3
) -> Transmission:
    """The differential with these clutches and brakes, in one gear."""
    names = "ABCD"[: len(elements)]
    made = [ShiftElement(*pair, name) for pair, name in zip(elements, names, strict=True)]
    return Transmission(links, made, [SET], [gear], output=output)


def texts(results: Results) -> list[str]:
    return [f"{message.severity}: {message.text}" for message in results.messages]


def status(case: Transmission) -> int:
    """Exit status of `vstatics run`."""
    written = write_json(case).encode()
    assert read_json(written, "").case == case
    return vstatics("run", "-", "--from", "json", stdin=written).status


def test_neutral_counts_what_is_missing_and_names_the_free_links() -> None:
    case = train([(2, 0)], Gear())
    results = solve(case)
    assert texts(results)[0] == (
        "warning: 1 condition missing for the speeds (neutral); free: links 2 and 3; "
        "engage another shift element or give a speed"
    )
    assert results.missing == [1]
    assert results.speeds[0, 0] == 1
    assert np.isnan([*results.speeds[0, 1:], *results.ratio, *results.efficiency]).all()
    assert status(case) == 0


def test_two_conditions_may_be_missing() -> None:
    case = train([(3, 4)], Gear(), links=4, output=4)
    assert texts(solve(case))[0].startswith("warning: 2 conditions missing")
    assert "free: links 2, 3 and 4" in texts(solve(case))[0]


def test_a_direct_clutch_with_a_free_set_is_direct_all_the_same() -> None:
    """The clutch joins input and output; the set hangs on the input and carries nothing."""
    results = solve(train([(1, 4)], Gear([1]), links=4, output=4))
    assert [*results.ratio, *results.output_torque, *results.efficiency] == [1, 1, 1]
    assert results.torques[0] == pytest.approx([1, 0, 1])
    assert "free: links 2 and 3" in texts(results)[0]
    assert len(results.messages) == 1


def test_two_clutches_that_lock_the_train_leave_only_the_split_open() -> None:
    """Equilibrium of all links together: Mx = 1, whatever the split between A, B and D."""
    case = train([(1, 2), (2, 3)], Gear([1, 2]))
    results = solve(case)
    assert results.speeds[0] == pytest.approx([1, 1, 1])
    assert results.slip_speeds[0] == pytest.approx([0, 0])
    assert [*results.ratio, *results.output_torque, *results.efficiency] == [1, 1, 1]
    assert np.isnan(results.torques[0, :3]).all()
    assert texts(results) == [
        "warning: A and B: 1 engaged element is in excess; the speeds agree, the torques that "
        "it shares are not determined",
        "warning: statics does not determine the torque of A, B and D1",
    ]
    assert status(case) == 0


def test_brakes_that_hold_the_input_tie_the_gear_up() -> None:
    case = train([(2, 0), (3, 0)], Gear([1, 2]))
    results = solve(case)
    assert results.failed
    assert texts(results) == [
        "error: tied up: A, B and the input speed contradict each other, so the input can't "
        "turn as given; release one of the engaged elements"
    ]
    assert status(case) == 1


def test_a_contradiction_is_said_once_however_many_equations_repeat_it() -> None:
    """Both sets and the clutch make links 1 to 3 one piece, twice over."""
    sets = [Mechanism(3, 1, 2, -2.0), Mechanism(1, 3, 2, -3.0), Mechanism(2, 4, 0, -3.0)]
    case = Transmission(4, [ShiftElement(3, 2, "S")], sets, [Gear([1], speeds={2: 0.8})])
    told = texts(solve(case))
    assert sum("tied up" in text for text in told) == 1
    assert len(set(told)) == len(told)


def test_given_speeds_may_contradict_each_other() -> None:
    """Ring held: the carrier turns at 1/(1 - u) = 1/3, not at 1/2."""
    contradiction = solve(train([(2, 0)], Gear([1], speeds={3: 0.5})))
    assert contradiction.failed
    assert "A, the input speed and the given speed of link 3 contradict" in texts(contradiction)[0]
    agreement = solve(train([(2, 0), (3, 4)], Gear([1, 2], speeds={3: 1 / 3}), links=4, output=4))
    assert not agreement.failed
    assert agreement.ratio == pytest.approx(3)


def test_a_singular_train_of_the_right_count_is_told_both() -> None:
    """Two brakes on one link; the fourth link hangs free."""
    case = train([(2, 0), (2, 0)], Gear([1, 2]), links=4)
    results = solve(case)
    assert [*results.missing, *results.excess] == [1, 1]
    first, second = texts(results)[:2]
    assert first.startswith("warning: A and B: 1 engaged element is in excess")
    assert second.startswith("warning: 1 condition missing")
    assert "free: link 4" in second
    assert results.ratio == pytest.approx(3)
    assert results.output_torque == pytest.approx(3)


def test_a_speed_given_on_the_output_determines_speeds_but_no_torques() -> None:
    """(1 - w3)/(w2 - w3) = u with w3 = 1/4 gives w2 = -1/8."""
    results = solve(train([(2, 0)], Gear(speeds={3: 0.25})))
    assert results.speeds[0] == pytest.approx([1, -0.125, 0.25])
    assert np.isnan(results.torques).all()
    assert "give the speed of the reacting link instead" in texts(results)[0]
    held = solve(train([(2, 0)], Gear(speeds={2: -0.125})))
    assert held.speeds[0] == pytest.approx([1, -0.125, 0.25])
    assert held.output_torque == pytest.approx(3)  # of the set: 1 - u
    assert held.holding_torques[0, 1] == pytest.approx(2)  # of the ring: -u


def test_an_output_that_stands_still_has_no_ratio() -> None:
    case = train([(3, 0)], Gear([1]))
    results = solve(case)
    assert results.speeds[0] == pytest.approx([1, -0.5, 0])
    assert np.isnan(results.ratio).all()
    assert "warning: the output, link 3, stands still: there is no ratio" in texts(results)
    assert status(case) == 0


def test_a_gear_locked_by_friction_keeps_its_ideal_numbers() -> None:
    """A train of u = 1.004 driven from its slow end; without losses u/(u - 1) = 251."""
    results = solve(load(CASES / "self-locking.yaml"))
    assert results.ratio == pytest.approx([251, 1 / 251])
    assert results.efficiency[0] == pytest.approx(1 / 6)
    assert list(results.locked) == [False, True]
    assert list(results.consistent) == [True, False]
    assert np.isnan([results.efficiency[1], *results.lossy_torques[1]]).all()
    assert results.power_sign[1] == [1]
    assert texts(results) == [
        "warning: locked by friction: no directions of power agree with the losses"
    ]
    coasting = solve(load(CASES / "self-locking.yaml"), coast=True)
    assert coasting.locked[0]
    assert "locked by friction when coasting" in texts(coasting)[0]


def test_coasting_efficiencies_of_the_published_reverse_gears() -> None:
    case = load(MZKT)
    assert solve(case).efficiency[4:] == pytest.approx([0.8992, 0.9188], abs=HALF)
    assert solve(case, coast=True).efficiency[4:] == pytest.approx([0.9014, 0.9212], abs=HALF)


@pytest.mark.parametrize("name", [name for name in NASTY if name.startswith("turned")])
def test_a_flow_that_losses_turn_is_told(name: str) -> None:
    results = solve(NASTY[name])
    (exact,) = oracle.solve(NASTY[name])
    assert exact.efficiency is not None
    assert results.efficiency[0] == pytest.approx(float(exact.efficiency))
    names = " and ".join(f"D{number + 1}" for number in np.nonzero(results.turned[0])[0])
    assert f"note: losses turn the flow of power through {names} round" in texts(results)


@pytest.mark.parametrize("name", [name for name in NASTY if name.startswith("several")])
def test_several_admissible_sets_of_signs_are_told(name: str) -> None:
    results = solve(NASTY[name])
    (exact,) = oracle.solve(NASTY[name])
    assert exact.several
    told = [text for text in texts(results) if "the largest efficiency is taken" in text]
    assert re.match(r"note: [2-9]\d* sets of directions of power agree", told[0])


def test_a_mechanism_idle_by_coincidence_is_told() -> None:
    """It moves as one piece for these speeds or torques only, so a port depends on its sign.

    First: a shaft of efficiency e beside a set; with u' = u eta**x equilibrium gives a torque
    1/(u' (1 - e) - 1) on the first link. Second: an axle whose wheels turn alike, of which
    the one left open takes eta**x/(1 + eta**x).
    """
    shaft = solve(NASTY["idle by coincidence, efficiency depends on it"])
    assert any(text.startswith("warning: D2: idle by coincidence") for text in texts(shaft))
    axle = Transmission(3, [], [Mechanism(2, 3, 1, -1.0, 0.98, 0.5)], [Gear(speeds={2: 1.0})])
    assert [text[:35] for text in texts(solve(axle))] == ["warning: D1: idle by coincidence; t"]
    curve = replace(axle, gears=[Gear(speeds={2: 1.1})])
    assert texts(solve(curve)) == []


def test_a_set_that_clutches_hold_as_one_piece_is_idle_without_a_word() -> None:
    results = solve(train([(1, 2)], Gear([1])))
    assert results.idle.all()
    assert ([*results.efficiency], texts(results)) == ([1], [])
