"""Long chains of springs, and friction whose slope over the slip changes.

Expected are an integrator of the plain equations ``J dw/dt = T - A' (k e + d de/dt) - friction``,
and closed forms.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.simulation.control.written import simulated
from tests.simulation.test_closed_forms import links, run
from vstatics import ShiftElement, Spring
from vstatics.core.model.parts import Friction
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Capacity, Formula, Scenario, Start, constant, simulate
from vstatics.simulation.events.stretches import Closed, Parts, TimeStretch

STIFFNESS, DAMPING, INERTIA = 1e4, 1.0, 0.1


def chain(count: int) -> Scenario:
    """Links on springs, those before a clutch in the middle faster than those behind."""
    middle = count // 2
    sprung = [between(link, link + 1) for link in range(1, count) if link != middle]
    springs = tuple(Spring(twist, STIFFNESS, damping=DAMPING) for twist in sprung)
    clutch = ShiftElement(middle, middle + 1, "C")
    case = links(*[INERTIA] * count, elements=(clutch,), springs=springs)
    speeds = {link: 50.0 if link <= middle else 0.0 for link in range(1, count + 1)}
    torques = ((1, constant(20.0)), (count, constant(-5.0)))
    return Scenario(case, 0.2, Start(speeds=speeds), {1: Capacity(constant(100.0))}, torques)


def test_a_chain_whose_clutch_slips_moves_as_by_a_plain_integrator() -> None:
    count = 40
    twist = np.eye(count - 1, count) - np.eye(count - 1, count, 1)
    slipping = twist[count // 2 - 1]
    twist = np.delete(twist, count // 2 - 1, axis=0)
    load = np.zeros(count)
    load[[0, -1]] = 20, -5

    def change(_time: float, state: Floats) -> Floats:
        rates = twist @ state[:count]
        carried = STIFFNESS * state[count:] + DAMPING * rates
        return np.concatenate([(load - carried @ twist - 100 * slipping) / INERTIA, rates])

    motion = simulate(chain(count))
    first = np.concatenate([motion.speeds[0], np.zeros(count - 2)])
    found = solve_ivp(change, (0, 0.2), first, "DOP853", rtol=1e-11, atol=1e-9)
    assert not motion.events
    assert motion.speeds[-1] == pytest.approx(found.y[:count, -1], abs=1e-6)


def test_a_firing_torque_on_stiff_shafts_moves_as_by_a_plain_integrator() -> None:
    stiffness, damping, inertias = np.array([1500.0, 3e4]), np.array([0.0, 0.5]), (0.15, 0.01, 2.0)
    twist = np.array([[1.0, -1.0, 0.0], [0.0, 1.0, -1.0]])

    def change(_time: float, state: Floats) -> Floats:
        speeds, twists, angle = state[:3], state[3:5], state[5]
        carried = stiffness * twists + damping * (twist @ speeds)
        outside = [150 + 300 * math.sin(2 * angle), 0, -0.004 * speeds[2] * abs(speeds[2])]
        return np.concatenate([(outside - carried @ twist) / inertias, twist @ speeds, speeds[:1]])

    springs = tuple(
        Spring(between(link, link + 1), float(stiff), damping=float(damper))
        for link, stiff, damper in zip((1, 2), stiffness, damping, strict=True)
    )
    torques = ((1, Formula("150 + 300*sin(2*angle)")), (3, Formula("-0.004*speed*abs(speed)")))
    start = Start(speeds={1: 150.0, 2: 150.0, 3: 150.0})
    motion = simulate(Scenario(links(*inertias, springs=springs), 0.3, start, torques=torques))
    found = solve_ivp(change, (0, 0.3), [150.0] * 3 + [0.0] * 3, "DOP853", rtol=1e-12, atol=1e-10)
    assert motion.speeds[-1] == pytest.approx(found.y[:3, -1], abs=1e-6)


def test_slopes_that_are_only_rounding_errors_do_not_hold_up_a_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Slopes of 0 differ at each calculation; the run ends, with the same motion."""
    spring = Spring(between(1, 2), 3e3, damping=0.5)
    torques = ((1, Formula("150 + 300*sin(2*angle)*(1 + speed/200)")),)
    start = Start(speeds={1: 150.0, 2: 150.0})
    scenario = Scenario(links(0.15, 2.0, springs=(spring,)), 0.1, start, torques=torques)
    expected = simulate(scenario).speeds[-1]
    slopes, noise = Closed._slopes, np.random.default_rng(1)

    def rounded(closed: Closed, time: float, state: Floats) -> tuple[Floats, Floats]:
        by_rate, by_state = slopes(closed, time, state)
        by_state[by_state == 0] = noise.normal(size=(by_state == 0).sum()) * 1e-13
        return by_rate, by_state

    monkeypatch.setattr(Closed, "_slopes", rounded)
    motion = simulate(scenario)
    assert motion.speeds[-1] == pytest.approx(expected, abs=1e-6)


def test_friction_that_bends_with_the_slip_is_passed_piece_by_piece() -> None:
    """J ds/dt = -G mu(s): .16 down to 50 rad/s, then a straight line to .12."""
    pack = Friction(0.1, 60e-4, 8, ((0.0, 0.12), (50.0, 0.16), (200.0, 0.16)))
    case = links(0.5, elements=(ShiftElement(1, 0, "B", friction=pack),))
    for way in (1, -1):
        motion = run(case, 10.0, {1: way * 100.0}, controls={1: Capacity(constant(1e4))})
        gain, slope = 1e4 * 0.1 * 60e-4 * 8, 0.04 / 50
        time = 0.5 * 50 / (gain * 0.16) + 0.5 / (gain * slope) * math.log(1 + slope * 50 / 0.12)
        [event] = motion.events
        assert event.event == "locks"
        assert event.time == pytest.approx(time, abs=1e-9)
        assert motion.energy.heat["B"] == pytest.approx(0.5 * 100**2 / 2, rel=1e-9)


def test_a_drag_by_formula_needs_few_stretches_before_each_end_of_its_slip(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """``J w' + b w + k e = -+ a``: twists at rest fall from e to ``(e - a/k) d - a/k``.

    The factor d is the decay in half a cycle.
    """
    calculated, tried = Closed._calculated, []

    def counted(closed: Closed, parts: Parts, state: Floats) -> TimeStretch | None:
        tried.append(parts)
        return calculated(closed, parts, state)

    monkeypatch.setattr(Closed, "_calculated", counted)
    case = """inertias: {w: 2}
springs: {S: {links: [w], stiffness: 500}}
drag: {w: 3 + 0.4*w}
"""
    decay, turn = 0.1, math.sqrt(250 - 0.1**2)
    start = "start: {speeds: {w: 0}, twists: {S: 0.3}}"
    motion = simulated(f"duration: {5 * math.pi / turn!r}\n{start}", case)
    twist = 0.3
    for _ in range(5):
        twist = (twist - 3 / 500) * math.exp(-decay * math.pi / turn) - 3 / 500
    assert motion.energy.elastic == pytest.approx(500 * (twist**2 - 0.3**2) / 2, rel=1e-9)
    assert len(tried) <= 5 * 5


def test_a_stretch_right_before_a_control_jumps_keeps_momentum_and_energy() -> None:
    case = """links: [a, b, c]
inertias: {a: 1.29, b: 2.42, c: 0.72}
shift_elements: {C: {links: [a, b], capacity: 300}}
springs: {s: {links: [b, c], stiffness: 1361, damping: 4.03}}
"""
    run = """duration: 1.5
start: {speeds: {a: 0, b: 0, c: 0}}
states: {p: {rate: "(speed('b') > 1) - p", start: 1}}
controls: {C: "40*(p > 0.5)"}
torques: {c: "20*(t > 0.5)"}
"""
    motion = simulated(run, case)
    assert motion.speeds[-1] @ (1.29, 2.42, 0.72) == pytest.approx(20, rel=1e-9)
    assert abs(motion.energy.balance) < 1e-9 * motion.energy.work


def test_a_trial_step_can_reach_speeds_at_which_a_drag_is_infinite() -> None:
    """The small link d, let go, comes to rest by ``J dw/dt = -(a + b w + c w^2)``."""
    clutches = "C: {links: [a, b], capacity: 953 N*m, drag: 0.8311 N*m}, "
    clutches += "E: {links: [b, c], capacity: 447.5 N*m, drag: 4.271 N*m}, "
    case = f"""inertias: {{a: 0.2777, b: 6.499, c: 0.00386, d: 0.002158}}
shift_elements: {{{clutches}D: {{links: [c, d], kind: dog_clutch}}}}
drag: {{d: 1.477 + 0.0181*w}}
gears: {{'1': []}}
"""
    motion = simulated(
        """duration: 3.737
start: {speeds: {a: 170.2, b: 170.2, c: 170.2, d: -48.17}}
controls: {C: 868.3, E: 249.8, D: {dog: [[1.087, closed], [1.584, open]]}}
torques:
  a: [[1.225, 0], [1.788, -10.67], [2.342, 35.57], [2.354, -10.67], [2.354, 2.216]]
  d: -0.01762*speed*abs(speed)
""",
        case,
    )
    let_go = motion.speeds[motion.time <= 1.584][-1, 3]
    root = math.sqrt(4 * 1.477 * 0.01762 - 0.0181**2)
    begin, end = (math.atan((2 * 0.01762 * w + 0.0181) / root) for w in (let_go, 0.0))
    rests = 1.584 + 2 * 0.002158 / root * (begin - end)
    assert (motion.speeds[(motion.time > 1.584) & (motion.time < rests - 1e-7), 3] > 0).all()
    assert motion.speeds[motion.time > rests + 1e-7, 3] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("law", ["100*tanh(angle)/angle", "100*(speed*angle)/angle"])
def test_a_torque_of_0_divided_by_0_at_the_start_stops_a_run(law: str) -> None:
    """The torque is a number at all later instants; only its start is 0/0."""
    spring = Spring(between(2), 100.0, damping=1.0)
    case = links(1.0, 2.0, elements=(ShiftElement(1, 2, "C"),), springs=(spring,))
    start = Start(speeds={1: 10.0, 2: 10.0}, engaged=(1,))
    motion = simulate(Scenario(case, 1.0, start, torques=((1, Formula(law)),)))
    assert motion.stopped is not None
    assert motion.stopped.id == "E605"
    assert motion.time.tolist() == [0.0]
