"""A load of 0 N*m: what is relative to it does not exist, what is in N*m and kW stands."""

from dataclasses import replace

import numpy as np
import pytest

from tests.chance import seeded, seeds_with_slow
from tests.commands import json_answer, vstatics
from tests.core.statics.batches import with_numbers
from tests.trains import random_train
from vstatics import CaseError, Gear, Load, Mechanism, ShiftElement, Transmission, loads, solve
from vstatics.core.flow.power import flows
from vstatics.core.model.parts import OfLoad
from vstatics.core.statics.physical import RELATIVE_TO_INPUT
from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.summary import summarize

CASE = b"""\
links: [in, lay, out]
mechanisms:
  P1: {first: in, second: lay, ratio: -60/20, efficiency: 0.98}
  P2: {first: lay, second: out, ratio: -50/25, efficiency: 0.97}
load: {speed: 3000 rpm, torque: 0 N*m}
gears:
  one: {drag: {lay: 2 N*m, out: 5 N*m}}
"""
OUT = -2 * 2 / 0.97 - 5
"""The output turns the layshaft by the second pair, and itself. [N*m]"""


def test_the_output_gives_all_drag() -> None:
    said = json_answer("run", "-", "--from", "yaml", stdin=CASE)
    assert (said["dragged"], said["efficiency"], said["power_balance"]) == ([True], [None], [None])
    assert (said["lossy_torques"], said["losses"]) == ([[None]] * 3, [[None]] * 2)
    assert [row[0] for row in said["lossy_torques_Nm"]] == pytest.approx([0, 2, OUT])
    lost = sum(row[0] for row in said["losses_kW"]) + said["drag_losses_kW"][0]
    assert said["input_power_kW"][0] - said["output_power_kW"][0] == pytest.approx(lost)
    asked = ("--vary", "P1.efficiency=0.9:1:30", "--out", "MxP_Nm,MxP,ETA")
    rows = vstatics("sweep", "-", "--from", "yaml", *asked, stdin=CASE).out.splitlines()[1:]
    assert {row.split(",", 2)[2] for row in rows} == {f"dragged,{OUT:.12g},,"}


PAIR = Mechanism(1, 2, 0, -2.5, 0.96)
TWO_GEARS = Transmission(
    *(2, [], [PAIR], [Gear(drag={2: 3.0}), Gear(drag={2: 3.0}, load=Load(torque=0))]),
    load=Load(2000, 300),
)
"""A gear by the load of the case, and one that coasts freely."""


def test_what_is_relative_to_no_torque_does_not_exist() -> None:
    """A drag of 3 times the input torque is none then, and nobody is dragged."""
    results = solve(TWO_GEARS)
    assert results.lossy_output_torque_Nm.tolist() == [300 * (-2.5 * 0.96 + 3), 0]
    assert results.dragged.tolist() == [True, False]
    assert results.consistent.all()
    varied = solve(TWO_GEARS, ratios=[[-2.0], [-2.5]])
    assert {*ARRAYS} >= {*RELATIVE_TO_INPUT}
    for name in (*RELATIVE_TO_INPUT, "lossy_output_torque"):
        assert np.isnan(getattr(varied, name)[:, 1]).all(), name
    assert not np.isnan(varied.torques[:, 0]).any()
    assert varied.speeds_rpm[0, 1].tolist() == [2000, -1000]


def test_what_acts_from_outside_is_in_newton_metres() -> None:
    """3 N*m at the output, which turns backward; 4 N*m on a clutch of 10 N*m."""
    case = replace(TWO_GEARS, gears=[Gear(drag={2: OfLoad(3.0, 1.0)})], load=Load(2000, 0))
    output = flows(solve(case))[0].ports.ports[1]
    assert np.isnan([output.torque, output.power]).all()
    assert output.torque_Nm == pytest.approx(3)
    clutch = ShiftElement(1, 2, capacity=OfLoad(10.0, 1.0))
    gear = Gear([1], torques={1: OfLoad(4.0, 1.0)})
    case = Transmission(3, [clutch], [Mechanism(2, 3, 0, 2)], [gear], load=Load(1000, 0))
    assert [one.least for one in summarize(solve(case)).margins] == pytest.approx([2.5])


def test_a_standing_input_stays_an_error() -> None:
    with pytest.raises(CaseError, match="expected the speed of an input that turns"):
        Transmission(2, [], [Mechanism(1, 2, 0, 2)], [Gear()], load=Load(0, 10))


@seeds_with_slow(6, 12)
def test_next_to_nothing_is_nearly_nothing(seed: int) -> None:
    """And plans for arrays do as each variant alone."""
    rng = seeded(seed)
    case = random_train(rng, regular=True)
    drag = {n: OfLoad(rng.choice((1.0, 4.0)), 1.0) for n in range(1, case.links, 2)}
    gears = [gear._replace(drag=drag) for gear in case.gears]
    none, little = (case.replace(gears=gears, load=Load(1000, torque)) for torque in (0, 1e-7))
    there = ~solve(little).locked
    one, other = (solve(each).lossy_torques_Nm[there] for each in (none, little))
    assert one == pytest.approx(other, rel=1e-4, abs=1e-4, nan_ok=True)
    u = np.array([m.ratio for m in case.mechanisms]) * (1 + 1e-3 * np.arange(20)[:, None])
    together = solve(none, ratios=u).lossy_torques_Nm
    alone = [solve(with_numbers(none, own, None)).lossy_torques_Nm for own in u]
    assert together == pytest.approx(np.array(alone), rel=1e-11, abs=1e-11, nan_ok=True)


def test_points_with_and_without_load_have_plans_of_their_own() -> None:
    """A given torque drives at 0 N*m: what was calculated before says nothing of the next."""
    text = """
links: [a, b, x]
output: b
load: {speed: 1500 rpm, torque: 60 N*m}
mechanisms:
  p: {first: a, second: b, ratio: -2, efficiency: .9}
  q: {first: x, second: b, ratio: 3, efficiency: .9}
gears: {g: {torques: {x: 5 N*m}}}
"""
    for torque in (80.0, 0.0, 80.0):
        together = solve(loads(text), vary={"load.torque": [torque, -60.0]})
        for number, one in enumerate((torque, -60.0)):
            alone = solve(loads(text.replace("torque: 60 N*m", f"torque: {one} N*m")))
            powers = together.port_powers_kW[number, 0]
            assert powers == pytest.approx(alone.port_powers_kW[0], rel=1e-12)


def test_the_torque_that_holds_a_speed_is_shown() -> None:
    """The motor turns itself against its drag: nothing goes through the set."""
    text = """
links: [engine, motor, out]
mechanisms: {set: {first: engine, second: out, third: motor, ratio: -2, efficiency: 0.98}}
load: {speed: 3000 rpm, torque: 0 N*m}
gears: {free: {speeds: {motor: 500 rpm}, drag: {motor: 2 N*m}}}
"""
    results = solve(loads(text))
    held = results.lossy_holding_torques_Nm[0, 1], results.holding_torques_Nm[0, 1]
    assert held == (2, 0)
    assert np.isnan([results.lossy_holding_torques, results.holding_torques]).all()
