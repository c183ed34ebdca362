"""Dampers of springs with play, dampers alone, twists and angles at the start."""

import math
from functools import partial
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.simulation.control.written import simulated, written
from tests.simulation.test_closed_forms import links
from vstatics import CaseError, Spring
from vstatics.core.model.springs import between
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Points, Scenario, Start, simulate

BACKLASH = """inertias: {a: 5}
springs: {s: {links: [a], points: [[0, 0], [0.39269908169872414, 0], [1.3926990816987241, 20000]],
  damping: 50}}
"""
"""Modelica.Mechanics.Rotational.Examples.Backlash: 20 kN*m/rad, 50 N*m*s/rad, 45 deg of play."""


@pytest.mark.parametrize("start", ["angles: {a: 90 deg}", "twists: {s: 90 deg}"])
def test_the_backlash_of_the_modelica_library_with_a_damper_that_never_pulls(start: str) -> None:
    """By DOP853 with events at both ends of a contact, where spring and damper together are 0."""
    text = f"duration: 1\nstart: {{speeds: {{a: 0}}, {start}}}\n"
    motion = simulate(written(text, BACKLASH), step=0.05)
    assert motion.stopped is None
    assert not motion.events
    places = [int(np.abs(motion.time - at).argmin()) for at in (0.05, 0.1, 0.2, 0.5, 1.0)]
    expected = [-42.02, 52.25, 10.28, -16.01, -6.21]
    assert motion.speeds[places, 0] == pytest.approx(expected, abs=0.006)


Mode = tuple[int, bool]
"""The side of a play (0: within it), and whether the contact has parted."""


class Gap(NamedTuple):
    """A spring with play between two links of a chain, the second one turned by a ratio."""

    ratio: float
    corners: list[float]
    """Twists at the ends of the play."""
    stiffness: float
    damping: float
    twist: float
    """At the start."""

    def carried(self, twist: float, rate: float, side: int) -> float:
        """Return the torque of spring and damper [N*m]."""
        if not side:
            return 0.0
        return self.stiffness * (twist - self.corners[(side + 1) // 2]) + self.damping * rate

    def mode(self, twist: float, rate: float) -> Mode:
        """Return the mode that holds."""
        side = int(twist > self.corners[1]) - int(twist < self.corners[0])
        return side, side * self.carried(twist, rate, side) < 0

    def spring(self, number: int) -> Spring:
        """The same as a spring of a case, behind a link."""
        low, high = self.corners
        line = [(low - 1, -self.stiffness), (low, 0), (high, 0), (high + 1, self.stiffness)]
        twist = {number: 1.0, number + 1: -self.ratio}
        return Spring(twist, points=line, damping=self.damping, name=f"S{number}")


def random_gap(rng: Random) -> Gap:
    ratio, corners = (
        rng.choice((-1, 1)) * rng.uniform(0.5, 3),
        [rng.uniform(-0.1, 0.1) for _ in "12"],
    )
    stiffness, damping = 10 ** rng.uniform(2.5, 4.5), 10 ** rng.uniform(0, 1.8)
    return Gap(ratio, sorted(corners), stiffness, damping, rng.uniform(-0.12, 0.12))


class Chain(NamedTuple):
    """Inertias with gaps between them, a torque on the first that falls straight over time."""

    inertias: list[float]
    gaps: list[Gap]
    speeds: list[float]
    torques: tuple[float, float]
    duration: float

    def contacts(self, state: Floats) -> list[tuple[Gap, float, float]]:
        """Return each gap with its twist [rad] and the rate of that [rad/s]."""
        speeds, twists = (part.tolist() for part in np.split(state[:-1], [len(self.inertias)]))
        ends = zip(self.gaps, speeds, speeds[1:], strict=False)
        rates = [one - gap.ratio * other for gap, one, other in ends]
        return list(zip(self.gaps, twists, rates, strict=True))

    def change(self, time: float, state: Floats, modes: list[Mode]) -> Floats:
        """Of speeds, twists, and what dampers take."""
        rates, loads, lost = [], np.zeros(len(self.inertias)), 0.0
        loads[0] = self.torques[0] + (self.torques[1] - self.torques[0]) * time / self.duration
        pairs = zip(self.contacts(state), modes, strict=True)
        for n, ((gap, twist, rate), (side, parted)) in enumerate(pairs):
            torque = 0.0 if parted else gap.carried(twist, rate, side)
            loads[n] -= torque
            loads[n + 1] += gap.ratio * torque
            lost += (torque - gap.carried(twist, 0.0, side)) * rate
            rates.append(rate)
        return np.array([*(loads / self.inertias), *rates, lost])

    def modes(self, state: Floats) -> list[Mode]:
        """Return the mode of each gap."""
        return [gap.mode(twist, rate) for gap, twist, rate in self.contacts(state)]

    def switches(self, modes: list[Mode]) -> list[Any]:
        """What is 0 where a mode ends."""

        def corner(_: float, state: Floats, n: int, end: int) -> float:
            gap, twist, _ = self.contacts(state)[n]
            return twist - gap.corners[end]

        def carried(_: float, state: Floats, n: int) -> float:
            gap, twist, rate = self.contacts(state)[n]
            return gap.carried(twist, rate, modes[n][0])

        found: list[Any] = [
            partial(corner, n=n, end=end) for n in range(len(modes)) for end in (0, 1)
        ]
        found += [partial(carried, n=n) for n, (side, _) in enumerate(modes) if side]
        for one in found:
            one.terminal = True
        return found

    def solved(self) -> Floats:
        """The state at the end, by events of SciPy: each piece is smooth."""
        time = 0.0
        state = np.array([*self.speeds, *(gap.twist for gap in self.gaps), 0.0])
        # without a short step it passes over two switches at once
        exact: Any = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-12, "max_step": 1e-3}
        while time < self.duration:
            modes = self.modes(state + 1e-10 * self.change(time, state, self.modes(state)))
            change, ends = partial(self.change, modes=modes), self.switches(modes)
            piece = solve_ivp(change, (time, self.duration), state, events=ends, **exact)
            if piece.t[-1] == time:  # it starts on a switch
                break
            time, state = float(piece.t[-1]), piece.y[:, -1]
            state = state + 1e-12 * self.change(time, state, modes)
        return np.asarray(state)

    @property
    def scenario(self) -> Scenario:
        """The same for the program."""
        springs = tuple(gap.spring(n) for n, gap in enumerate(self.gaps, 1))
        twists = {f"S{n}": gap.twist for n, gap in enumerate(self.gaps, 1)}
        start = Start(speeds=dict(enumerate(self.speeds, 1)), twists=twists)
        ramp = Points((0.0, self.duration), self.torques, "time")
        case = links(*self.inertias, springs=springs)
        return Scenario(case, self.duration, start, torques=((1, ramp),))


def random_chain(rng: Random) -> Chain:
    gaps = [random_gap(rng) for _ in range(rng.randint(1, 3))]
    inertias = [rng.uniform(0.2, 3) for _ in range(len(gaps) + 1)]
    speeds = [rng.uniform(-5, 5) for _ in inertias]
    return Chain(inertias, gaps, speeds, (rng.uniform(-60, 60), rng.uniform(-60, 60)), 0.4)


@seeds_with_slow(4, 60, 600)
def test_random_gears_with_play_agree_with_events_of_scipy(seed: int) -> None:
    chain = random_chain(seeded(seed))
    motion = simulate(chain.scenario)
    assert motion.stopped is None, motion.stopped
    wanted = chain.solved()
    number = len(chain.inertias)
    assert motion.speeds[-1] == pytest.approx(wanted[:number], rel=1e-6, abs=1e-6)
    assert sum(motion.energy.losses.values()) == pytest.approx(wanted[-1], rel=1e-6, abs=1e-6)
    sizes = abs(motion.energy.work) + abs(motion.energy.kinetic) + abs(motion.energy.elastic)
    assert abs(motion.energy.balance) <= 1e-8 * max(1.0, sizes)


def test_a_link_without_inertia_between_a_shaft_and_a_play_leaps_where_contact_begins() -> None:
    """Kelvin-Voigt behind a shaft: the link turns with the rate at which both torques are equal."""
    shaft, stop, damping, inertia, speed, gap = 3e3, 2e4, 40.0, 2.0, 3.0, 0.05
    play = [(0, 0), (gap, 0), (1 + gap, stop)]
    springs = Spring(between(1, 2), shaft), Spring(between(2), points=play, damping=damping)
    case = links(inertia, 0.0, springs=springs)
    begin = gap / speed
    motion = simulate(Scenario(case, begin + 0.05, Start(speeds={1: speed})))

    def change(_: float, state: Floats) -> list[float]:
        rate, turned, pressed = state.tolist()
        carried = shaft * (turned - pressed)
        return [-carried / inertia, rate, (carried - stop * pressed) / damping]

    def parts(_: float, state: Floats) -> float:
        return float(state[1] - state[2]) + 1e-15

    parts.terminal, parts.direction = True, -1  # type: ignore[attr-defined]
    contact = solve_ivp(
        change, (0, 0.05), [speed, 1e-12, 0], "DOP853", events=parts, rtol=1e-11, atol=1e-13
    )
    assert motion.stopped is None
    assert motion.speeds[-1, 0] == pytest.approx(contact.y[0, -1], rel=1e-7)
    assert motion.speeds[motion.time < 0.99 * begin][-1, 1] == pytest.approx(speed)
    assert np.abs(motion.speeds[motion.time > begin][1, 1]) < 1  # it has leapt


def test_a_limit_follows_a_spring_that_never_pulls() -> None:
    """A block falls on a pad; its grip is 0.5 of the force of the pad with its damper, by DOP853."""
    case = """links: [block, belt]
masses: {block: 3}
inertias: {belt: 0.2}
springs:
  pad: {links: [block], points: [[-1, -4000], [0, 0], [1, 0]], damping: 30}
  grip: {links: [belt], stiffness: 5e4, limit: {base: 0, of: pad, times: -0.5}}
"""
    start = "start: {speeds: {block: -1, belt: 60}, twists: {pad: 0.02}}"
    motion = simulated(f"duration: 0.25\n{start}\ntorques: {{block: -29.43}}\n", case)

    def change(_: float, state: Floats) -> list[float]:
        rate, place, turning = state.tolist()
        force = max(0.0, -4000 * place - 30 * rate) if place < 0 else 0.0
        return [force / 3 - 9.81, rate, -0.5 * force / 0.2 * (turning > 0)]

    exact = solve_ivp(change, (0, 0.25), [-1, 0.02, 60], rtol=1e-10, atol=1e-10, max_step=5e-4)
    assert motion.speeds[-1] == pytest.approx(exact.y[[0, 2], -1], abs=2e-2)
    pad = motion.torques[:, motion.devices.index("pad")]
    assert pad.min() < -60
    assert pad.max() <= 1e-9


DAMPER = "links: [a, b]\ninertias: {a: %r, b: %r}\nsprings: {visc: {links: [a, b], %s}}\n"


@each_seed(20, 500)
@pytest.mark.parametrize("written_as", ["damping: %r", "stiffness: 0, damping: {viscous: %r}"])
def test_a_damper_alone_slows_what_turns_otherwise(seed: int, written_as: str) -> None:
    """The difference of speeds falls by exp(-d (1/J1 + 1/J2) t), towards T/(J1 d (1/J1 + 1/J2))."""
    rng = seeded(seed)
    first, second, damping, torque = (10 ** rng.uniform(-1, 1) for _ in range(4))
    speeds = [rng.uniform(-50, 50) for _ in range(2)]
    start = f"start: {{speeds: {{a: {speeds[0]!r}, b: {speeds[1]!r}}}}}"
    case = DAMPER % (first, second, written_as % damping)
    motion = simulated(f"duration: 0.7\n{start}\ntorques: {{a: {torque!r}}}\n", case)
    rate = damping * (1 / first + 1 / second)
    steady = torque / first / rate
    slip = steady + (speeds[0] - speeds[1] - steady) * math.exp(-0.7 * rate)
    momentum = first * speeds[0] + second * speeds[1] + 0.7 * torque
    second_speed = (momentum - first * slip) / (first + second)
    assert motion.speeds[-1] == pytest.approx([second_speed + slip, second_speed], abs=1e-7)
    lost = motion.energy.work - motion.energy.kinetic
    assert motion.energy.losses["visc"] == pytest.approx(lost, abs=1e-7)
    assert motion.energy.elastic == 0


@each_seed(10, 200)
@pytest.mark.parametrize("written_as", ["friction: %r", "stiffness: 0, friction: %r"])
def test_dry_friction_alone_slips_until_the_speeds_are_equal(seed: int, written_as: str) -> None:
    """The difference falls by M (1/J1 + 1/J2) in each second, then both turn as a single body."""
    rng = seeded(seed)
    first, second, friction = (10 ** rng.uniform(-1, 1) for _ in range(3))
    rate, momentum = friction * (1 / first + 1 / second), first * (slip := rng.uniform(1, 50))
    for time, left in ((0.6 * slip / rate, 0.4 * slip), (2 * slip / rate, 0.0)):
        start = f"duration: {time!r}\nstart: {{speeds: {{a: {slip!r}, b: 0}}}}\n"
        motion = simulated(start, DAMPER % (first, second, written_as % friction))
        slow = (momentum - first * left) / (first + second)
        assert motion.speeds[-1] == pytest.approx([slow + left, slow], abs=1e-7)
        lost = (momentum * slip - first * (slow + left) ** 2 - second * slow**2) / 2
        assert motion.energy.heat["visc"] == pytest.approx(lost, rel=1e-7)


def test_a_settled_start_lets_a_damper_alone_slip() -> None:
    """5 N*m through 20 N*m*s/rad slip by 0.25 rad/s: so the shaft carries 5 N*m from the start."""
    motion = simulated(
        "duration: 1\nstart: {speeds: {a: 0.25, b: 0, c: 0.25}, settled: true}\ntorques: {a: 5}\n",
        "inertias: {a: 1, b: 1e6, c: 1}\n"
        "springs: {shaft: {links: [a, c], stiffness: 100}, visc: {links: [c, b], damping: 20}}\n",
    )
    shaft = motion.torques[:, motion.devices.index("shaft")]
    assert shaft.tolist() == pytest.approx([5.0] * len(shaft), rel=1e-5)


def test_what_is_neither_spring_nor_damper_is_refused() -> None:
    for spring, fault in (
        ("", "`damping` and `friction`"),
        ("stiffness: 0", "expected a stiffness above 0"),
        ("damping: {ratio: 0.1}", "which needs a `stiffness`"),
        ("damping: -1", "expected a damping of 0 or more"),
        ("compliance: 0, damping: 1", "expected a compliance above 0"),
    ):
        with pytest.raises(CaseError, match=fault):
            written("duration: 1\nstart: {speeds: {a: 1, b: 1}}\n", DAMPER % (1, 1, spring))


LOOP = """inertias: {a: 1, b: 1, c: 1}
mechanisms: {pair: {first: b, second: c, ratio: 2}}
springs:
  left: {links: [a, b], stiffness: 300}
  right: {twist: {a: 1, c: -2}, stiffness: 200}
  tyre: {links: [c], stiffness: 100, limit: 1}
"""
"""The first pair of springs has one twist, as `b` turns twice as fast as `c`."""


@pytest.mark.parametrize("given", ["{left: 0.1}", "{right: 0.1}", "{left: 0.1, right: 0.1}"])
def test_springs_in_a_loop_have_the_twist_that_one_of_them_is_given(given: str) -> None:
    start = f"{{speeds: {{a: 0, b: 0}}, twists: {given}}}"
    motion = simulated(f"duration: 0.1\nstart: {start}\n", LOOP)
    carried = [motion.torques[0, motion.devices.index(name)] for name in ("left", "right", "tyre")]
    assert carried == pytest.approx([30.0, 20.0, 0.0])
    assert motion.energy.balance == pytest.approx(0.0, abs=1e-8)


def test_twists_and_angles_that_cannot_be_are_refused() -> None:
    for start, fault in (
        ("twists: {left: 0.1, right: 0.2}", "give 0.1 rad"),
        ("angles: {a: 0.3, c: 0.1}, twists: {left: 0.2}", "give 0.1 rad"),
        ("angles: {b: 0.3, c: 0.1}", "give 0.15 rad"),
        ("twists: {lift: 0.1}", "elastic component; did you mean `left`"),
        ("twists: {left: 0.1 m}", "expected a number in rad"),
        ("twists: {left: 0.1}, settled: true", "`twists` and `settled`"),
        ("angles: {d: 0.1}", "expected the name of a link"),
    ):
        with pytest.raises(CaseError, match=fault):
            simulate(written(f"duration: 1\nstart: {{speeds: {{a: 0, b: 0}}, {start}}}\n", LOOP))


def test_three_springs_in_a_ring_need_two_twists() -> None:
    case = """inertias: {a: 1, b: 1, c: 1}
springs: {x: {links: [a, b], stiffness: 1}, y: {links: [b, c], stiffness: 1},
  z: {links: [c, a], stiffness: 1}}
"""
    text = "duration: 1\nstart: {speeds: {a: 0, b: 0, c: 0}, twists: %s}\n"
    with pytest.raises(CaseError, match="how y and z share"):
        simulate(written(text % "{x: 0.1}", case))
    motion = simulated(text % "{x: 0.1, y: 0.2}", case)
    assert motion.torques[0].tolist() == pytest.approx([0.1, 0.2, -0.3])


def test_a_torque_over_the_angle_begins_at_the_angle_that_is_given() -> None:
    """2 sin(angle) at 90 degrees is 2 N*m; the shaft behind the crank is not twisted."""
    motion = simulated(
        "duration: 1e-4\nstart: {speeds: {crank: 0, mass: 0}, angles: {crank: 90 deg}}\n"
        'torques: {crank: "2*sin(angle)"}\n',
        "inertias: {crank: 1, mass: 1}\nsprings: {shaft: {links: [crank, mass], stiffness: 100}}\n",
    )
    assert motion.speeds[-1, 0] == pytest.approx(2e-4, rel=1e-6)
    assert motion.energy.elastic == pytest.approx(0.0, abs=1e-9)
