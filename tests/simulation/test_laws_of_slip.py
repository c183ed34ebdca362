"""Clutches whose capacity is a law of their slip, from rest.

Expected numbers come from a solver of scipy with equations of their own.
"""

from __future__ import annotations

from typing import Any

import pytest
from scipy.integrate import solve_ivp

from tests.simulation.control.written import simulated

POWERS_OF_SLIP = [
    (0.3, 1.0, 2.0),
    (0.5, 1.0, 1.0),
    (0.8, 1.0, 3.0),
    (1.0, 2.0, 1.0),
    (1.5, 1.0, 1.0),
    (2.0, 0.5, 1.0),
]


def by_slip(power: float, factor: float, inertias: tuple[float, float]) -> list[float]:
    """Speeds after 2 s of two inertias that a law connects, by Radau.

    The torque on the first is 10 t up to 1 s and falls to -10 at 2 s.
    """

    def changes(t: float, speeds: Any) -> list[float]:
        slip = speeds[0] - speeds[1]
        taken = factor * slip * (slip**2 + 1e-18) ** ((power - 1) / 2)  # no infinite slope
        given = 10 * t if t < 1 else 30 - 20 * t
        return [(given - taken) / inertias[0], taken / inertias[1]]

    speeds = [0.0, 0.0]
    for span in ((0, 1), (1, 2)):
        speeds = solve_ivp(changes, span, speeds, "Radau", rtol=1e-9, atol=1e-11).y[:, -1].tolist()
    return speeds


@pytest.mark.parametrize("start", [0, 100])
@pytest.mark.parametrize(("power", "first", "second"), POWERS_OF_SLIP)
def test_a_slip_leaves_rest_by_a_law_of_any_steepness(
    power: float, first: float, second: float, start: float
) -> None:
    """The torque is 0 at the start, so the slip grows with the square of the time or slower."""
    case = f"links: [a, b]\ninertias: {{a: {first}, b: {second}}}\nshift_elements: {{L: [a, b]}}\n"
    motion = simulated(
        f"""duration: 2
start: {{speeds: {{a: {start}, b: {start}}}}}
torques: {{a: [[0, 0], [1, 10], [2, -10]]}}
controls: {{L: "5*abs(slip('L'))^{power}"}}
""",
        case,
    )
    speeds = by_slip(power, 5, (first, second))
    assert motion.speeds[-1] - start == pytest.approx(speeds, abs=1e-6)
    assert [one.event for one in motion.events if one.time > 1e-3] == ["reverses"]


@pytest.mark.parametrize("power", [pytest.param(0.5, marks=pytest.mark.slow), 0.8, 1.0, 1.5])
def test_a_link_without_inertia_slips_between_two_laws(power: float) -> None:
    """Both carry T = 4 x^p = 8 y^p, so y = x/2^(1/p), and T = 4 (s/(1 + 2^(-1/p)))^p of s = x + y."""
    motion = simulated(
        f"""duration: 2
start: {{speeds: {{a: 0, b: 0}}}}
torques: {{a: [[0, 0], [1, 10], [2, -10]]}}
controls: {{L: "4*abs(slip('L'))^{power}", K: "8*abs(slip('K'))^{power}"}}
""",
        "links: [a, m, b]\ninertias: {a: 1, b: 2}\nshift_elements: {L: [a, m], K: [m, b]}\n",
    )
    factor = 4 / (1 + 0.5 ** (1 / power)) ** power
    assert motion.speeds[-1][[0, 2]] == pytest.approx(by_slip(power, factor, (1, 2)), abs=1e-6)
    assert {one.event for one in motion.events if one.time < 1.5} <= {"reverses"}
