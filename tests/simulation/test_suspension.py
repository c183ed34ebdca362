"""Suspensions in motion: what moves straight, struts, grip by load and by slip, a rough road."""

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from tests.chance import each_seed, generator, with_slow
from tests.simulation.control.written import simulated
from tests.simulation.test_closed_forms import links
from vstatics import CaseError, Spring, Transmission
from vstatics.core.model.springs import SpringLimit, between
from vstatics.core.model.struts import Strut, StrutCurve
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Formula, Scenario, Start, constant, simulate

GAS = Strut(38 * 98066.5, 208.9e-4, 0.11, 1.02, 17 * 98066.5, 77e-4, 0.16)
"""Tsitovich, Algin, table 4.2: BelAZ-540A, front, laden; in Pa, m^2, m."""


def gas_force(strut: Strut, z: float) -> float:
    """``P(0) - P(z)`` by (4.16) as it is printed."""

    def force(z: float) -> float:
        ratio = strut.length / (strut.length + z)
        above = strut.pressure * strut.area * ratio**strut.exponent
        if strut.counter_length is None:
            return float(above)
        ratio = strut.counter_length / (strut.counter_length - z)
        return float(above - strut.counter_pressure * strut.counter_area * ratio**strut.exponent)

    return force(0.0) - force(z)


@pytest.mark.parametrize("z", [-0.1, -0.03, 0.0, 1e-6, 0.12])
def test_a_strut_gives_back_what_is_put_in(z: float) -> None:
    curve = StrutCurve(GAS)
    assert float(curve.at(z)) == pytest.approx(gas_force(GAS, z), abs=1e-9 * 8e4)
    assert curve.energy(z) == pytest.approx(quad(lambda x: gas_force(GAS, x), 0, z)[0], abs=1e-7)
    near = 1e-6
    slope = (gas_force(GAS, z + near) - gas_force(GAS, z - near)) / (2 * near)
    assert GAS.slope(z) == pytest.approx(slope, rel=1e-6)
    assert curve.twist_at(gas_force(GAS, z)) == pytest.approx(z, abs=1e-12)


@pytest.mark.parametrize("exponent", [0.9, 1.0, 1.4])
def test_energy_is_the_integral_of_the_force_for_any_exponent(exponent: float) -> None:
    strut = GAS._replace(exponent=exponent)
    put_in = quad(lambda x: gas_force(strut, x), 0, -0.08)[0]
    assert StrutCurve(strut).energy(-0.08) == pytest.approx(put_in, rel=1e-9)


def on_strut(mass: float, strut: Strut, damping: float = 0.0) -> Transmission:
    spring = Spring(between(1), damping=damping, strut=strut, name="strut")
    return Transmission(1, [], [], [], springs=[spring], masses={1: mass})


def strut_reference(mass: float, strut: Strut, damping: float, speed: float) -> Floats:
    """``m z'' + k z' + F(z) = 0`` after a second, by an independent integrator."""

    def change(_: float, state: Floats) -> list[float]:
        return [-(gas_force(strut, state[1]) + damping * state[0]) / mass, state[0]]

    made = solve_ivp(change, (0, 1), [speed, 0.0], "DOP853", rtol=1e-12, atol=1e-13)
    end: Floats = made.y[:, -1]
    return end


def test_a_strut_that_nearly_bottoms_is_exact() -> None:
    """At both ends it has the whole energy of the start; the last millimetres take a third."""
    motion = simulate(Scenario(on_strut(6620, GAS), 0.5, Start(speeds={1: -1.8})))
    given, curve = 6620 * 1.8**2 / 2, StrutCurve(GAS)
    ends = [brentq(lambda z: curve.energy(z) - given, 0, most) for most in (-0.1099, 0.15999)]
    pushed, pulled = (gas_force(GAS, z) for z in ends)
    force = motion.torques[:, 0]
    assert force.min() == pytest.approx(pushed, rel=1e-6)
    assert force.max() == pytest.approx(pulled, rel=1e-5)
    assert abs(motion.energy.balance) < 1e-7 * given


@each_seed(4, 60)
def test_any_strut_moves_as_its_gas(seed: int) -> None:
    random = generator(416, seed)
    p, q = random.uniform(1e6, 6e6), random.uniform(1e5, 2e6)
    sizes = random.uniform(0.01, 0.04), random.uniform(0.05, 0.3), random.uniform(1.0, 1.4)
    counter = random.uniform(0.002, 0.01), random.uniform(0.1, 0.4)
    strut = Strut(p, *sizes, *((q, *counter) if seed % 2 else ()))
    mass, damping = random.uniform(1e3, 2e4), random.choice([0.0, 5e3])
    speed = random.uniform(0.1, 0.3) * strut.length * math.sqrt(strut.slope(0) / mass)
    motion = simulate(Scenario(on_strut(mass, strut, damping), 1.0, Start(speeds={1: -speed})))
    end, z = strut_reference(mass, strut, damping, -speed)
    assert motion.speeds[-1, 0] == pytest.approx(end, abs=1e-7 * speed)
    largest = speed * math.sqrt(mass * strut.slope(0))
    expected = gas_force(strut, z) + damping * end
    assert motion.torques[-1, 0] == pytest.approx(expected, abs=1e-7 * largest)
    assert abs(motion.energy.balance) <= 1e-8 * mass * speed**2


def test_a_strut_without_counter_chamber_never_gives_more_than_its_rest() -> None:
    case, start = on_strut(1000.0, Strut(1e6, 0.01, 0.1, 1.1)), Start(speeds={1: 0.0}, settled=True)
    scenario = Scenario(case, 0.1, start, torques=((1, constant(1.1e4)),))
    with pytest.raises(CaseError, match=r"strut has a torque of 11000 N\*m at the start") as caught:
        simulate(scenario)
    assert caught.value.problems[0].id == "E694"


def grip(base: float, times: float, damping: float) -> Transmission:
    """A wheel on its tyre against the body that pitches on the rear suspension, (5.5)."""
    springs = [
        Spring(between(3), 3000.0, damping=damping, name="rear"),
        Spring({1: 1, 2: -1, 3: -1}, 900.0, damping=3.0, name="shaft"),
        Spring({2: 1, 3: -1.2}, 2500.0, limit=SpringLimit(base, "rear", times), name="tyre"),
    ]
    return links(2.0, 3.0, 4.0, springs=tuple(springs))


def grip_reference(base: float, times: float, damping: float) -> tuple[list[float], Floats]:
    """The same by an integrator that is stopped where the tyre slips or grips: times, speeds."""
    rows = np.array([[0, 0, 1], [1, -1, -1], [0, 1, -1.2]])

    def change(t: float, x: Floats, slips: int) -> Floats:
        rates = rows @ x[:3]
        rear = 3000 * x[3] + damping * rates[0]
        tyre = slips * max(base + times * rear, 0) if slips else 2500 * x[5]
        torques = np.array([rear, 900 * x[4] + 3 * rates[1], tyre])
        given = np.array([120 * (1 - math.exp(-8 * t)), 0, 0])
        faster = (given - rows.T @ torques) / [2, 3, 4]
        if slips:
            rates[2] = slips * times * (3000 * rates[0] + damping * faster[2]) / 2500
        return np.concatenate([faster, rates])

    def margin(t: float, x: Floats, slips: int) -> float:
        rates = rows @ x[:3]
        if slips:
            return float(slips * (rates[2] - change(t, x, slips)[5]))
        return float(base + times * (3000 * x[3] + damping * rates[0]) - abs(2500 * x[5]))

    met, t, x, slips = [], 0.0, np.zeros(6), 0
    while t < 1:
        leaves: Any = partial(margin, slips=slips)
        leaves.terminal, leaves.direction = True, -1
        moves = partial(change, slips=slips)
        exact: Any = {"rtol": 1e-10, "atol": 1e-11, "max_step": 0.01}
        made = solve_ivp(moves, (t, 1), x, "DOP853", events=leaves, **exact)
        t, x = float(made.t[-1]), made.y[:, -1]
        if t < 1:
            met.append(t)
            slips = 0 if slips else int(np.sign(x[5]))
    return met, x[:3]


@pytest.mark.parametrize(
    "given", [(40, 0.2, 8.0), (20, 0.3, 0.0), (20, 0.3, 20.0), (90, -0.3, 0.0)]
)
def test_grip_follows_the_load_of_the_wheel(given: tuple[float, float, float]) -> None:
    """(5.8): the limit is ``(G_2 + F_2) grip r`` while the body squats."""
    start = Start(speeds=dict.fromkeys((1, 2, 3), 0.0))
    engine = (1, Formula("120*(1-exp(-8*t))"))
    motion = simulate(Scenario(grip(*given), 1.0, start, torques=(engine,)))
    met, speeds = grip_reference(*given)
    assert met
    assert [event.time for event in motion.events] == pytest.approx(met, abs=1e-8)
    assert motion.speeds[-1] == pytest.approx(speeds, abs=1e-6)
    assert abs(motion.energy.balance) < 1e-6


REAR: list[dict[str, Any]] = [
    {"points": [(0, 0), (0.01, 500), (0.02, 4000)]}, {"stiffness": 8e5}, {"strut": GAS},
    {"stiffness": 8e5, "damping": 2e3},
]  # fmt: skip


@pytest.mark.parametrize("given", with_slow(REAR[:2], REAR[2:]))
def test_grip_follows_what_bends_and_comes_back_from_nothing(given: dict[str, Any]) -> None:
    """No torque beyond the limit, which falls to 0 and rises again; energy closes."""
    rear = Spring(between(3), name="rear", **given)
    tyre = Spring({1: 1, 2: -1}, 900.0, name="tyre", limit=SpringLimit(20.0, "rear", 0.01))
    case = Transmission(3, [], [], [], springs=[rear, tyre], inertias={1: 1, 2: 3}, masses={3: 500})
    motion = simulate(Scenario(case, 0.3, Start(speeds={1: 9.0, 2: 0.0, 3: -0.3})))
    load, grip = (motion.torques[:, motion.devices.index(name)] for name in ("rear", "tyre"))
    assert motion.stopped is None
    assert (np.abs(grip) <= np.maximum(20 + 0.01 * load, 0) + 1e-7).all()
    assert motion.events[0].event == "slips"
    assert abs(motion.energy.balance) < 1e-8


def test_masses_take_forces_and_velocities() -> None:
    """A constant force: ``v = v0 + F t/m``."""
    text = "duration: 2\nstart: {speeds: {body: 18 km/h}}\ntorques: {body: 3 kN}\n"
    motion = simulated(text, "masses: {body: 1 t}")
    assert motion.speeds[-1, 0] == pytest.approx(5 + 3000 * 2 / 1000)


CASE = """
links: [z, x, pitch, z2, z3, x2, x3, road1, road2]
masses: {{z: 5000, x: 5000, z2: 400, z3: 800, x2: 400, x3: 800, road1: 0, road2: 0}}
inertias: {{pitch: 7000}}
springs:
  front: {{twist: {{z: 1, pitch: 1.5, z2: -1}}, stiffness: 2e5, damping: 6e3, friction: {front}}}
  rear: {{twist: {{z: 1, pitch: -2.1, z3: -1}}, stiffness: 3e5, damping: 8e3, friction: {rear}}}
  tyre1: {{links: [z2, road1], stiffness: 9e5}}
  tyre2: {{links: [z3, road2], stiffness: 1.6e6}}
  along1: {{twist: {{x2: 1, x: -1, pitch: -.8}}, stiffness: 4e6, damping: 9e3}}
  along2: {{twist: {{x3: 1, x: -1, pitch: -.7}}, stiffness: 5e6, damping: 9e3}}
  drive: {{twist: {{x: 1, pitch: .9}}, stiffness: 2.5e5, damping: 4e3}}
gears: {{"1": []}}
"""
SCENARIO = """duration: 0.8
start: {speeds: {z: 0, x: 0, pitch: 0, z2: 0, z3: 0, x2: 0, x3: 0}}
speeds: {road1: "0.24*sin(12*t)", road2: "0.24*sin(9*t)"}
torques:
  x2: "-(28e3 - 9e5*twist('tyre1'))*0.24*sin(12*t)/(20 + speed('x')) + 9e5*twist('tyre1')*.015"
"""
ROWS = np.array(
    [  # of z, x, pitch, z2, z3, x2, x3
        [1, 0, 1.5, -1, 0, 0, 0],
        [1, 0, -2.1, 0, -1, 0, 0],
        [0, 0, 0, 1, 0, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, -1, -0.8, 0, 0, 1, 0],
        [0, -1, -0.7, 0, 0, 0, 1],
        [0, 1, 0.9, 0, 0, 0, 0],
    ]
)
HEAVY = np.array([5000, 5000, 7000, 400, 800, 400, 800])
STIFFNESS = np.array([2e5, 3e5, 9e5, 1.6e6, 4e6, 5e6, 2.5e5])
DAMPING = np.array([6e3, 8e3, 0, 0, 9e3, 9e3, 4e3])


def on_rough_road(leaves: tuple[float, float]) -> Floats:
    """(5.1) after .8 s, by an integrator; the friction of the leaves is smoothed."""

    def change(t: float, state: Floats) -> Floats:
        speeds, twists = state[:7], state[7:]
        slope = 0.24 * math.sin(12 * t)
        rates = ROWS @ speeds
        rates[2] -= slope
        rates[3] -= 0.24 * math.sin(9 * t)
        forces = STIFFNESS * twists + DAMPING * rates
        forces[:2] += np.array(leaves) * np.tanh(rates[:2] / 1e-5)
        load = -9e5 * twists[2]
        pushed = np.zeros(7)
        pushed[5] = -(load + 28e3) * slope / (20 + speeds[1]) - load * 0.015
        return np.concatenate([(pushed - ROWS.T @ forces) / HEAVY, rates])

    method = "LSODA" if any(leaves) else "DOP853"
    exact: Any = {"method": method, "rtol": 1e-10, "atol": 1e-12}
    made = solve_ivp(change, (0, 0.8), np.zeros(14), **exact)
    end: Floats = made.y[:7, -1]
    return end


@pytest.mark.parametrize(("leaves", "near"), [((0, 0), 1e-9), ((900, 1500), 2e-5)])
def test_a_rough_road_pushes_along(leaves: tuple[float, float], near: float) -> None:
    """(5.1): compliance along, friction of leaves, the push ``(Y + P) q'/(v + x')``."""
    motion = simulated(SCENARIO, CASE.format(front=leaves[0], rear=leaves[1]))
    assert motion.speeds[-1, :7] == pytest.approx(on_rough_road(leaves), abs=near)
    assert abs(motion.energy.balance) < 1e-6
    assert (sum(motion.energy.heat.values()) > 0) == any(leaves)


TAKING_OFF = """duration: 0.4
start: {speeds: {wheel: 20, car: 2}}
tables: {grip: [[0, 0], [.1, .8], [1, .6]]}
torques: {wheel: "900 - 300*t"}
limits: {tyre: "3000*grip(max(0, (speed('wheel')*.4 - speed('car'))/(speed('wheel')*.4)))"}
"""


def test_grip_follows_the_slip_of_the_wheel() -> None:
    """Table 1.1: ``X <= G phi(delta)``, ``delta = (w r - v)/(w r)``; once it slips."""
    motion = simulated(
        TAKING_OFF,
        "{masses: {car: 300}, inertias: {wheel: 5},"
        " springs: {tyre: {twist: {wheel: .4, car: -1}, stiffness: 2e5}}}",
    )

    def force(speeds: Floats) -> float:
        slip = (speeds[0] * 0.4 - speeds[1]) / (speeds[0] * 0.4)
        return float(3000 * np.interp(slip, [0, 0.1, 1], [0, 0.8, 0.6]))

    def change(t: float, speeds: Floats) -> list[float]:
        pushed = force(speeds)
        return [(900 - 300 * t - 0.4 * pushed) / 5, pushed / 300]

    gripped = next(event.time for event in motion.events if event.event == "slips")
    at = int(np.searchsorted(motion.time, gripped, side="right")) - 1
    by_name = [motion.links.index(name) for name in ("wheel", "car")]
    exact: Any = {"rtol": 1e-11, "atol": 1e-12, "max_step": 0.01}
    made = solve_ivp(change, (gripped, 0.4), motion.speeds[at, by_name], "DOP853", **exact)
    assert motion.speeds[-1, by_name] == pytest.approx(made.y[:, -1], abs=1e-8)
    assert abs(motion.energy.balance) < 1e-6
