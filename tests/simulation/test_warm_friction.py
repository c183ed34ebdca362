"""Coefficients of friction by slip and temperature: a clutch that fades as it warms up."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import count, seeded
from tests.simulation.control.written import simulated, written
from tests.simulation.test_golden import closes
from vstatics import loads
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.writers.saving import case_data
from vstatics.simulation.published.tarasik import tarasik

PER_PRESSURE = 0.1 * 0.006 * 8
"""``radius area surfaces`` of the pack [m^3]."""


def case(coefficient: object, of_element: str = "", of_heat: str = "heat_capacity: 900") -> str:
    """Two wheels of 2 and 3 kg*m^2 and a clutch, which begins at 30 degrees."""
    return f"""links: [e, o]
inertias: {{e: 2, o: 3}}
shift_elements:
  C: {{links: [e, o], {of_element}friction: {{radius: 0.1, area: 0.006, surfaces: 8, ambient: 30,
    {of_heat}, coefficient: {coefficient}}}}}
gears: {{g: [C], n: []}}
"""


FADING = "{columns: [30, 230], rows: [[0, 0.12, 0.04]]}"


def test_a_clutch_that_fades_with_its_own_heat_locks_when_it_should() -> None:
    """Heat is ``E = J (s0^2 - s^2)/2``, so ``J ds/dt = -N (a + b s^2)``: a tangent.

    N = p r A z, mu = m - n (T - T0), T - T0 = E/C, hence a = m - n J s0^2/(2 C), b = n J/(2 C).
    """
    made = simulated(
        "duration: 2\nstart: {speeds: {e: 300, o: 0}}\ncontrols: {C: 5 bar}\n", case(FADING)
    )
    inertia, normal, slope = 1 / (1 / 2 + 1 / 3), 5e5 * PER_PRESSURE, 0.08 / 200
    b = slope * inertia / (2 * 900)
    a = 0.12 - b * 300**2
    time = inertia / (normal * math.sqrt(a * b)) * math.atan(300 * math.sqrt(b / a))
    [locks] = made.events
    assert locks.time == pytest.approx(time, abs=1e-9)
    assert made.energy.heat["C"] == pytest.approx(inertia * 300**2 / 2, rel=1e-10)
    assert closes(made)


def test_beyond_the_columns_the_coefficient_of_an_elastic_clutch_is_constant() -> None:
    """It is warmer than all columns from the start, so it is that of the last."""
    made = simulated(
        "duration: 0.1\nstart: {speeds: {e: 300, o: 0}}\ncontrols: {C: 5 bar}\n",
        case("{columns: [0, 20], rows: [[0, 0.2, 0.1]]}", "stiffness: 1e6, "),
    )
    assert made.speeds[-1, 1] == pytest.approx(5e5 * PER_PRESSURE * 0.1 / 3 * 0.1, rel=1e-3)
    assert closes(made)


def test_what_sticks_breaks_away_as_it_is_warm() -> None:
    """At 80 degrees mu is 0.10, and 3/5 of the torque on one wheel go on to the other."""
    hot = case(FADING).replace("ambient: 30", "ambient: 80")
    made = simulated(
        "duration: 1\nstart: {speeds: {e: 50, o: 50}}\ncontrols: {C: 1 bar}\n"
        'torques: {e: "200*t"}\n',
        hot,
    )
    [slips] = made.events
    held = 1e5 * PER_PRESSURE * 0.10
    assert slips.time == pytest.approx(held / (200 * 3 / 5), abs=1e-9)


def random_table(rng: Random) -> tuple[list[float], list[list[float]]]:
    columns = sorted(rng.uniform(20, 120) for _ in range(rng.randint(1, 3)))
    slips = [0.0, *sorted(rng.uniform(5, 250) for _ in range(rng.randint(0, 2)))]
    return columns, [[slip, *(rng.uniform(0.05, 0.15) for _ in columns)] for slip in slips]


def integrated(columns: list[float], rows: list[list[float]], cooling: float) -> Floats:
    """Speeds after a second, pressure from 1 to 4 bar, 50 N*m on the first; by SciPy."""
    slips = [row[0] for row in rows]

    def change(time: float, state: Floats) -> list[float]:
        slip, warm = state[0] - state[1], state[2]
        at = [float(np.interp(warm, columns, row[1:])) for row in rows]
        torque = (1e5 + 3e5 * time) * PER_PRESSURE * float(np.interp(slip, slips, at))
        warming = (torque * slip - cooling * (warm - 30)) / 900
        return [(50 - torque) / 2, torque / 3, warming]

    found = solve_ivp(change, (0, 1), [300, 0, 30], "DOP853", rtol=1e-11, atol=1e-11, max_step=2e-3)
    return np.asarray(found.y[:2, -1])


@pytest.mark.parametrize("seed", range(count(6, 60)))
def test_random_tables_agree_with_an_independent_integrator(seed: int) -> None:
    rng = seeded(seed)
    columns, rows = random_table(rng)
    cooling = rng.choice((0.0, rng.uniform(10, 300)))
    made = simulated(
        "duration: 1\nstart: {speeds: {e: 300, o: 0}}\ntorques: {e: 50}\n"
        "controls: {C: [[0, 1 bar], [1, 4 bar]]}\n",
        case(
            f"{{columns: {columns}, rows: {rows}}}",
            of_heat=f"heat_capacity: 900, cooling: {cooling}",
        ),
    )
    assert not made.events
    assert made.speeds[-1] == pytest.approx(integrated(columns, rows, cooling), rel=1e-7)
    assert closes(made)


def test_what_is_written_is_read_again() -> None:
    read = loads(case(FADING))
    for form in ("yaml", "json"):
        assert loads(case_data(read, form)[0]) == read


FAULTS = [
    ("{columns: [], rows: [[0]]}", "read no temperatures"),
    ("{columns: [30], rows: []}", "read no points, expected at least one"),
    ("{columns: [9, 9], rows: [[0, 1, 1]]}", "read 9 after 9, expected"),
    ("{columns: [9], rows: [[0, 1, 1]]}", "read 3 numbers, expected 2"),
    ("{columns: [9], rows: [[]]}", "read 0 numbers, expected 2"),
    ("{columns: [9], rows: [[0, -1]]}", "expected a coefficient above 0"),
    ("{columns: [9]}", "`rows` is missing"),
    ("{columns: [.nan], rows: [[0, 1]]}", "read '.nan', expected a number"),
]


def test_mistakes_are_told_where_they_stand() -> None:
    cooled = case(FADING, of_heat="cooling: 0"), "expected a `heat_capacity` as well"
    for text, expected in [cooled, *((case(one), expected) for one, expected in FAULTS)]:
        with pytest.raises(ReadError, match=expected) as caught:
            loads(text)
        assert {one.place.line for one in caught.value.problems if one.place} == {5}


def test_the_published_method_refuses_it() -> None:
    scenario = written(
        "duration: 1\nstart: {speeds: {e: 300, o: 0}}\ncontrols: {C: 1 bar}\n", case(FADING)
    )
    with pytest.raises(CaseError, match="C depends on more than its slip and the time"):
        tarasik(scenario)
