"""Efficiencies with points of drawn elements: closed forms by hand, the case written and read."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from vstatics import CaseError, Transmission, solve
from vstatics.core.readers import loads
from vstatics.core.writers.named import write_json, write_yaml


def drive(pair: str, planetary: str, load: str = "{speed: 2000 rpm, torque: 100 N*m}") -> str:
    """A pair of wheels, 20 and 40 teeth, then a set with its ring held, 30 and 78 teeth."""
    return f"""\
links: [a, b, c]
output: c
load: {load}
elements:
  G: {{kind: gear_pair, first: a, second: b, teeth: {{first: 20, second: 40}}, efficiency: {pair}}}
  P: {{kind: planetary, sun: b, ring: housing, carrier: c, teeth: {{sun: 30, ring: 78}},
      efficiency: {planetary}}}
gears: {{drive: []}}
"""


OVER_TORQUE = drive(
    "{over: torque, points: [[0, .9], [150, .975]]}",
    "{over: torque, points: [[0, .9], [300, .98]]}",
)


def over_torque(torque: Fraction) -> Fraction:
    """The pair has .9 + torque/2000 up to 150 N*m; the sun gets twice as much less its loss.

    With the sun driving, the ring has 2.6 eta of its torque, the carrier 1 + 2.6 eta, of 3.6.
    """
    first = min(Fraction(9, 10) + torque / 2000, Fraction(975, 1000))
    sun = 2 * torque * first
    second = min(Fraction(9, 10) + Fraction(8, 100) * sun / 300, Fraction(98, 100))
    return first * (1 + Fraction(26, 10) * second) / Fraction(36, 10)


def test_over_torque_it_is_that_on_the_first_member() -> None:
    torques = np.array([1.0, 40.0, 100.0, 149.0, 200.0, 900.0])
    found = solve(loads(OVER_TORQUE), vary={"load.torque": torques})
    expected = [float(over_torque(Fraction(int(torque)))) for torque in torques]
    np.testing.assert_allclose(found.efficiency[:, 0], expected, rtol=1e-12)
    assert (np.abs(found.power_balance) <= 1e-12).all()


def test_over_speed_it_is_that_of_the_first_member_against_the_third() -> None:
    points = "{over: speed, points: [[0, .9], [100, 1]]}"
    results = solve(loads(drive("1", points, "{speed: 1200 rpm, torque: 10 N*m}")))
    # the sun turns with 20 pi rad/s, the carrier with 1/3.6 of that
    second = 0.9 + 0.001 * 20 * np.pi * (1 - 1 / 3.6)
    assert results.efficiency[0] == pytest.approx((1 + 2.6 * second) / 3.6, rel=1e-13)


@pytest.mark.parametrize("write", [write_yaml, write_json])
def test_points_are_written_and_read(write: object) -> None:
    case: Transmission = loads(OVER_TORQUE)
    assert callable(write)
    assert loads(write(case)) == case


def test_without_a_load_the_element_is_told() -> None:
    with pytest.raises(CaseError, match="gear drive has no speed") as caught:
        solve(loads(OVER_TORQUE.replace("{speed: 2000 rpm, torque: 100 N*m}", "{torque: 100 N*m}")))
    path, _ = [problem.path for problem in caught.value.problems if problem.id == "E267"]
    assert path == ("mechanisms", 1, "efficiency")
