"""Friction packs, whose capacity is ``pressure area radius surfaces mu``, and laws of slip.

Coefficients depend on slip and temperature: a clutch fades as it warms up. Motions by laws of slip
are those of a solver of scipy with equations of its own.
"""

import math
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded, with_slow
from tests.simulation.control.written import simulated, written
from tests.simulation.test_closed_forms import links, run
from tests.simulation.test_golden import closes
from vstatics import CaseError, Gear, ReadError, ShiftElement, Spring, loads
from vstatics.core.model.parts import Friction, OfLoad
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.core.writers.saving import case_data
from vstatics.simulation import (
    Capacity,
    Points,
    Resistance,
    Scenario,
    Shift,
    Start,
    constant,
    simulate,
)
from vstatics.simulation.published.tarasik import tarasik

PACK = Friction(radius=0.1, area=0.006, surfaces=8, coefficient=((0.0, 0.1),))
FALLING = PACK._replace(coefficient=((0.0, 0.1), (10.0, 0.05)))
PRESSURE = {1: Capacity(constant(1e4))}
"""4.8 N*m by a coefficient of .1: 1e4 * .006 * .1 * 8 * .1."""


def test_an_elastic_clutch_slips_at_the_torque_of_its_pack_which_is_one() -> None:
    clutch = ShiftElement(1, 2, name="C", stiffness=1000.0, friction=PACK)
    speeds = {1: 10.0, 2: 0.0}
    motion = run(links(1.0, 1.0, elements=(clutch,)), 0.1, speeds, controls=PRESSURE)
    assert motion.peaks["C"].torque == pytest.approx(4.8)
    assert motion.energy.heat_per_area["C"] == motion.energy.heat["C"] / (0.006 * 8)
    falling = clutch._replace(friction=FALLING)
    with pytest.raises(CaseError, match="C is elastic, so it slips at one torque"):
        run(links(1.0, 1.0, elements=(falling,)), 0.1, speeds, controls=PRESSURE)


def test_a_shift_engages_the_capacity_of_the_case_whatever_the_pack() -> None:
    """50 N*m at the begin of slip, half of it where the coefficient is half."""
    clutch = ShiftElement(1, 2, name="C", friction=FALLING, capacity=OfLoad(50.0, 100.0))
    case = links(1.0, 1.0, elements=(clutch,))
    case = case.replace(gears=[Gear(name="open"), Gear([1], name="joined")])
    start, shift = Start(speeds={1: 20.0, 2: 0.0}), Shift(0.0, "joined")
    motion = simulate(Scenario(case, 0.01, start, shifts=(shift,)))
    assert motion.torques[-1, 0] == pytest.approx(25.0)


def test_a_pressure_above_the_capacity_of_the_case_is_cut_there() -> None:
    """4 N*m in place of 4.8 on each of two inertias of 1 kg*m^2, for .1 s."""
    clutch = ShiftElement(1, 2, name="C", friction=PACK, capacity=OfLoad(4.0, 100.0))
    motion = run(links(1.0, 1.0, elements=(clutch,)), 0.1, {1: 10.0, 2: 0.0}, controls=PRESSURE)
    assert motion.speeds[-1] == pytest.approx([9.6, 0.4])
    [note] = [one.text for one in motion.messages if one.id == "N605"]
    assert "at 0 s the control of C is above the capacity in the case, 8333.33" in note


def test_what_has_one_name_is_one_sum_of_heat() -> None:
    """The resistance of a link and a spring that slips, both called 2."""
    tyre = Spring(between(1, 2), stiffness=1e3, limit=20.0, name="2")
    case = links(1.0, 5.0, springs=(tyre,))
    motion = run(case, 0.2, {1: 50.0, 2: 0.0}, ((2, Resistance(5.0)),))
    slipped = motion.energy.heat["2"]
    assert slipped == pytest.approx(-motion.energy.kinetic - motion.energy.elastic)


@pytest.mark.parametrize("factor", [1.0, 1.01])
def test_either_of_two_clutches_could_break_away(factor: float) -> None:
    """Both carry the same; the one that could carry more, if one can, does not break away.

    J_1 + J_3 take 200 t, so what is between carries 3/4 of it, up to 1.2*50 N*m.
    """
    pair = ShiftElement(1, 2, "C1", static=1.2 * factor), ShiftElement(2, 3, "C2", static=1.2)
    case, ramp = links(1.0, 0.0, 3.0, elements=pair), Points((0.0, 1.0), (0.0, 200.0), "time")
    controls = dict.fromkeys((1, 2), Capacity(constant(50.0)))
    motion = run(case, 0.6, dict.fromkeys((1, 2, 3), 10.0), ((1, ramp),), controls)
    [event] = motion.events
    assert event.time == pytest.approx(60 / 150, rel=1e-9)
    either = [str(one) for one in motion.messages if "more than one set of slipping" in str(one)]
    assert len(either) == (factor == 1)
    assert factor > 1 or {"C1", "C2"} <= set(either[0].replace(",", "").split())


PER_PRESSURE = 0.1 * 0.006 * 8
"""``radius area surfaces`` of the pack [m^3]."""


def case(coefficient: object, of_element: str = "", of_heat: str = "heat_capacity: 900") -> str:
    """Two wheels of 2 and 3 kg*m^2 and a clutch, which begins at 30 degrees."""
    return f"""inertias: {{e: 2, o: 3}}
shift_elements:
  C: {{links: [e, o], {of_element}friction: {{radius: 0.1, area: 0.006, surfaces: 8, ambient: 30,
    {of_heat}, coefficient: {coefficient}}}}}
"""


FADING = "{columns: [30, 230], rows: [[0, 0.12, 0.04]]}"


IN_SERIES = """inertias: {a: 1, b: 2}
shift_elements:
  C: {links: [a, m], friction: {radius: 0.1, area: 0.006, surfaces: 8, COEFFICIENT}}
  D: {links: [m, b], friction: {radius: 0.1, area: 0.006, surfaces: 8,
    coefficient: [[0, 0.07], [30, 0.095]]}}
"""
FAR = "coefficient: {columns: [0], rows: [[0, 0.1], [10, 0.12], [80, 0.05]]}, heat_capacity: 900"


@pytest.mark.parametrize(
    ("law", "sticking", "slip"), [("coefficient: 0.12", "", 0), (FAR, "C", 2.5 / 0.9)]
)
def test_a_link_between_two_packs_has_one_torque_and_does_not_jump(
    law: str, sticking: str, slip: float
) -> None:
    """D slips above its last point, by 4.56 N*m. C holds, or slips where (0.1 + 0.002 x) 43.2 = 4.56.

    C could then also slip by far more, as its law falls, and D stick.
    """
    text = f"duration: 1\nstart: {{speeds: {{a: 200, b: 0}}, engaged: [{sticking}]}}\n"
    text += "controls: {C: [[0, 1e4], [1, 9e3]], D: 1e4}\n"
    motion = simulated(text, IN_SERIES.replace("COEFFICIENT", law))
    assert motion.speeds[-1] == pytest.approx([195.44, 195.44 - slip, 2.28])


def test_a_law_over_the_slip_acts_while_the_pressure_rises() -> None:
    """A pressure that rises by 1 Pa gives the motion of a constant pressure; its energy closes."""
    box = """{links: [a, m, b], inertias: {a: 1, b: 2}, springs: {S: {links: [m, b], stiffness: 200}},
 shift_elements: {C: {links: [a, m], friction: {radius: 0.1, area: 0.01, surfaces: 2,
    coefficient: [[0, 0.1], [100, 0.2]]}}}}"""
    start = "duration: 0.1\nstart: {speeds: {a: 100, b: 0}}\ntorques: {a: 5}\n"
    constant, rising = (
        simulated(f"{start}controls: {{C: [[0, 2e6], [2, {end}]]}}\n", box)
        for end in ("2e6", "2000001")
    )
    assert rising.speeds[-1] == pytest.approx(constant.speeds[-1], rel=1e-6)
    assert closes(rising)


@pytest.mark.parametrize("states", ["", 'states: {p: {rate: "(1e6 - p)/0.01"}}\n'])
def test_a_clutch_that_fades_with_its_own_heat_locks_when_it_should(states: str) -> None:
    """Heat is ``E = J (s0^2 - s^2)/2``, so ``J ds/dt = -N (a + b s^2)``: a tangent.

    N = p r A z, mu = m - n (T - T0), T - T0 = E/C, hence a = m - n J s0^2/(2 C), b = n J/(2 C).
    A state in Pa, which the clutch does not read, changes nothing.
    """
    text = "duration: 2\nstart: {speeds: {e: 300, o: 0}}\ncontrols: {C: 5 bar}\n" + states
    made = simulated(text, case(FADING))
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
    start = "duration: 1\nstart: {speeds: {e: 50, o: 50}}\ncontrols: {C: 1 bar}\n"
    hot = case(FADING).replace("ambient: 30", "ambient: 80")
    made = simulated(f'{start}torques: {{e: "200*t"}}\n', hot)
    [slips] = made.events
    assert slips.time == pytest.approx(1e5 * PER_PRESSURE * 0.10 / (200 * 3 / 5), abs=1e-9)


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


@each_seed(6, 60)
def test_random_tables_agree_with_an_independent_integrator(seed: int) -> None:
    rng = seeded(seed)
    columns, rows = random_table(rng)
    cooling = rng.choice((0.0, rng.uniform(10, 300)))
    of_heat = f"heat_capacity: 900, cooling: {cooling}"
    made = simulated(
        "duration: 1\nstart: {speeds: {e: 300, o: 0}}\ntorques: {e: 50}\n"
        "controls: {C: [[0, 1 bar], [1, 4 bar]]}\n",
        case(f"{{columns: {columns}, rows: {rows}}}", of_heat=of_heat),
    )
    assert not made.events
    assert made.speeds[-1] == pytest.approx(integrated(columns, rows, cooling), rel=1e-7)
    assert closes(made)


def test_what_is_written_is_read_again() -> None:
    read = loads(case(FADING))
    assert all(loads(case_data(read, form)[0]) == read for form in ("yaml", "json"))


FAULTS = [
    ("{columns: [], rows: [[0]]}", "read no temperatures"),
    ("{columns: [30], rows: []}", "read no points, expected at least one"),
    ("{columns: [9, 9], rows: [[0, 1, 1]]}", "read 9 after 9, expected"),
    ("{columns: [9], rows: [[0, 1, 1]]}", "read 3 numbers, expected 2"),
    ("{columns: [9], rows: [[0, -1]]}", "expected a coefficient above 0"),
    ("{columns: [9]}", "`rows` is missing"),
    ("{columns: [.nan], rows: [[0, 1]]}", "read '.nan', expected a number"),
]


def test_mistakes_are_reported_where_they_stand() -> None:
    cooled = case(FADING, of_heat="cooling: 0"), "expected a `heat_capacity` as well"
    for text, expected in [cooled, *((case(one), expected) for one, expected in FAULTS)]:
        with pytest.raises(ReadError, match=expected) as caught:
            loads(text)
        assert {one.place.line for one in caught.value.problems if one.place} == {4}


def test_the_published_method_refuses_it() -> None:
    text = "duration: 1\nstart: {speeds: {e: 300, o: 0}}\ncontrols: {C: 1 bar}\n"
    with pytest.raises(CaseError, match="C depends on more than its slip and the time"):
        tarasik(written(text, case(FADING)))


PULLED = (
    "duration: 2\nstart: {{speeds: {{a: {0}, b: {0}}}}}\n"
    "torques: {{a: [[0, 0], [1, 10], [2, -10]]}}\n"
)


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
@pytest.mark.parametrize(
    ("power", "first", "second"),
    [(0.8, 1, 3), (0.3, 1, 2), (0.5, 1, 1), (1, 2, 1), (1.5, 1, 1), (2, 0.5, 1)],
)
def test_a_slip_leaves_rest_by_a_law_of_any_steepness(
    power: float, first: float, second: float, start: float
) -> None:
    """The torque is 0 at the start, so the slip grows with the square of the time or slower."""
    case = f"links: [a, b]\ninertias: {{a: {first}, b: {second}}}\nshift_elements: {{L: [a, b]}}\n"
    control = f"controls: {{L: \"5*abs(slip('L'))^{power}\"}}\n"
    motion = simulated(f"{PULLED.format(start)}{control}", case)
    speeds = by_slip(power, 5, (first, second))
    assert motion.speeds[-1] - start == pytest.approx(speeds, abs=1e-6)
    assert [one.event for one in motion.events if one.time > 1e-3] == ["reverses"]


@pytest.mark.parametrize("power", with_slow([1.0, 0.8, 1.5], [0.5]))
def test_a_link_without_inertia_slips_between_two_laws(power: float) -> None:
    """T = 4 x^p = 8 y^p, so y = x/2^(1/p), and T = 4 (s/(1 + 2^(-1/p)))^p of s = x + y."""
    case = "links: [a, m, b]\ninertias: {a: 1, b: 2}\nshift_elements: {L: [a, m], K: [m, b]}\n"
    control = f"{{L: \"4*abs(slip('L'))^{power}\", K: \"8*abs(slip('K'))^{power}\"}}"
    motion = simulated(f"{PULLED.format(0)}controls: {control}\n", case)
    factor = 4 / (1 + 0.5 ** (1 / power)) ** power
    assert motion.speeds[-1][[0, 2]] == pytest.approx(by_slip(power, factor, (1, 2)), abs=1e-6)
    assert {one.event for one in motion.events if one.time < 1.5} <= {"reverses"}
