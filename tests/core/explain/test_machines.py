"""Machines with a battery: the balance that is written out is that of the powers at their links."""

import math

import pytest

from vstatics import loads, solve
from vstatics.core.explain import explain_gear
from vstatics.core.explain.tables import explanation_grids
from vstatics.core.explain.text import write

SPLIT = """\
links: [MG1, output, engine, MG2]
input: engine
output: output
load: {speed: 2000 rpm, torque: 110 N*m}
mechanisms:
  set: {first: MG1, second: output, third: engine, ratio: -2.6, efficiency: 0.97}
  pair: {first: MG2, second: output, ratio: 2.63, efficiency: 0.98}
gears:
  even: {speeds: {MG1: 5000 rpm}, balance: {MG1: 0.92, MG2: 0.90}}
  drawn: {speeds: {MG1: -1500 rpm}, balance: {MG1: 0.92, MG2: 0.90, battery: -5 kW}}
  plain: {speeds: {MG1: 0}, torques: {MG2: 0}}
"""


@pytest.mark.parametrize(("gear", "battery"), [("even", 0.0), ("drawn", -5.0)])
def test_what_the_battery_gets_is_the_sum_over_the_machines(gear: str, battery: float) -> None:
    """Power is -torque x speed with losses; what flows to the battery loses, and from it, too."""
    results = solve(loads(SPLIT))
    number = ["even", "drawn"].index(gear)
    made = explain_gear(results, gear).balance
    assert made is not None
    assert [share.link for share in made.shares] == ["MG1", "MG2"]
    assert sum(share.battery_kW for share in made.shares) == pytest.approx(battery, abs=1e-6)
    for share, link in zip(made.shares, (0, 3), strict=True):
        turned = results.speeds[number, link] * 2000 * math.pi / 30
        power = -results.lossy_holding_torques[number, link] * 110 * turned / 1000
        assert share.power_kW == pytest.approx(power)
        lost = share.power_kW - share.battery_kW
        assert lost == pytest.approx((1 - share.efficiency) * max(power, -power / share.efficiency))
    assert (made.link, made.torque) == ("MG2", results.lossy_holding_torques[number, 3])
    assert made.torque == results.holding_torques[number, 3]  # it is the same without losses


def test_it_is_written_where_a_gear_has_one() -> None:
    results = solve(loads(SPLIT))
    even, plain = (write([explain_gear(results, name)]) for name in ("even", "plain"))
    assert "the torque on MG2: " in even
    assert "do not balance the\n    machines" in even
    assert "achines" not in plain
    titles = [grid.title for grid in explanation_grids([explain_gear(results, "even")])]
    assert "Gear even: machines and battery" in titles
