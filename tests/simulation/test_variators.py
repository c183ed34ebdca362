"""Variators in motion: they stand at the ratio of the start gear, with the losses of statics."""

from __future__ import annotations

from typing import Any

import pytest

from vstatics import solve
from vstatics.core.readers.named.reader import read_yaml
from vstatics.simulation.run import simulate
from vstatics.simulation.scenario.file import read_scenario

CASE = """
links: [in, pump, motor, out]
input: in
output: out
load: {{speed: 955 rpm, torque: 100 N*m}}
mechanisms:
  set: {{first: in, second: out, third: motor, ratio: -2, efficiency: .98}}
  pair: {{first: in, second: pump, ratio: -1, efficiency: .99}}
  hydro: {{kind: variator, first: pump, second: motor, speed_ratio: 0.4, efficiency: 0.86}}
inertias: {{in: .1, out: .1}}
gears: {{a: [], b: {{speed_ratios: {{hydro: {x}}}}}}}
"""


def run(x: float, gear: str, out: float) -> Any:
    reading = read_yaml(CASE.format(x=x).encode(), "case.yaml")
    text = f"duration: 1\nstart: {{gear: {gear}, speed: 100}}\ntorques: {{in: 100, out: {out}}}\n"
    document = read_scenario(f"case: case.yaml\n{text}".encode(), "s.yaml")
    return simulate(document.with_case(reading).scenario)


@pytest.mark.parametrize("gear", ["a", "b"])
@pytest.mark.parametrize("x", [-0.2, 0.7])
def test_at_the_torques_of_statics_speeds_stay(gear: str, x: float) -> None:
    """The load that statics tells with losses holds the speed."""
    case = read_yaml(CASE.format(x=x).encode(), "case.yaml").case
    number = case.gear_number(gear) - 1
    results = solve(case)
    out = -float(results.lossy_output_torque_Nm[number])
    motion = run(x, gear, out)
    assert motion.stopped is None
    turned = 100 * results.speeds[number]
    assert motion.speeds[-1] == pytest.approx(turned, rel=1e-6)


def test_at_a_ratio_of_0_the_motor_stands_and_the_pump_carries_nothing() -> None:
    """100 N*m turn both ends of the set, of which ``J a/2 = 2 eta T`` passes to the output."""
    motion = run(0.0, "b", 0.0)
    faster = 100 / (0.1 + 0.1 / (4 * 0.98))
    assert motion.speeds[-1] == pytest.approx([100 + faster, -100 - faster, 0, -50 - faster / 2])
