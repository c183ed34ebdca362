"""Engine and converter of a vehicle, against trains by hand, roots by SciPy and own sums."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import Mock

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.chance import count, examples, generator
from tests.commands import vstatics
from tests.installed import needs
from tests.vehicle.operation.cycles import around, cycled, spent, timed
from vstatics import CaseError, Gear, Load, Machine, Mechanism, Transmission, loads, solve
from vstatics.core.model.checks import doubts
from vstatics.core.model.laws import MapLaw
from vstatics.core.numerics.constants import GRAVITY
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.trace import Trace
from vstatics.vehicle.operation.traction import Traction, performance

COLUMNS, ROWS = [0.0, 150.0, 600.0], [[0.0, 0.9, 0.95, 0.96], [300.0, 0.85, 0.97, 0.98]]
SPLIT = -2.5
MAPPED = 4
"""Every fourth train, from the second on, has an efficiency by map."""
SEEDS = [
    pytest.param(seed, marks=pytest.mark.slow) if seed % MAPPED == 1 else seed
    for seed in (3, 2, 1, *range(4, count(4, 40)))
]
INERTIAS = {1: 0.2, 2: 0.05, 3: 0.3}


def by_map(speed: float, torque: Any) -> Any:
    """Return the efficiency of the map, constant outside."""
    part, (low, high) = min(abs(speed), 300.0) / 300, np.array(ROWS)[:, 1:]
    torques = np.abs(torque), COLUMNS
    return (1 - part) * np.interp(*torques, low) + part * np.interp(*torques, high)


class Train(NamedTuple):
    """Pair, converter and pair with a map; or a set whose sun drives the pump."""

    points: list[tuple[float, float, float]]
    car: Vehicle
    before: tuple[float, float]
    behind: float
    is_split: bool
    has_map: bool

    def case(self) -> Transmission:
        """Return the train as a case."""
        converter: dict[str, Any] = {"kind": "converter", "points": tuple(self.points)}
        if self.is_split:
            parts = [Mechanism(2, 3, 1, SPLIT, name="set")]
            parts += [Mechanism(2, 3, 0, math.nan, name="TC", **converter)]
            return Transmission(3, [], parts, [Gear()], inertias=INERTIAS, vehicle=self.car)
        law: Any = MapLaw(COLUMNS, ROWS) if self.has_map else 0.96
        parts = [
            Mechanism(1, 2, 0, *self.before, name="before"),
            Mechanism(2, 3, 0, math.nan, name="TC", **converter),
            Mechanism(3, 4, 0, self.behind, law, name="behind"),
        ]
        return Transmission(4, [], parts, [Gear()], inertias=INERTIAS, vehicle=self.car)

    def ratio(self, engine: Any, output: float) -> Any:
        """Return the speed ratio of the converter."""
        return self.turbine(output) / self.pump(engine, output)

    def pump(self, engine: Any, output: float) -> Any:
        """Return the speed of the pump."""
        return SPLIT * output + (1 - SPLIT) * engine if self.is_split else engine / self.before[0]

    def turbine(self, output: float) -> float:
        """Return the speed of the turbine."""
        return output if self.is_split else output * self.behind

    def of(self, column: int, ratio: Any) -> Any:
        """Return a number of the points at a speed ratio."""
        return np.interp(ratio, *np.array(self.points)[:, [0, column]].T)

    def taken(self, engine: Any, output: float) -> Any:
        """Return the torque that the pump takes."""
        pump = self.pump(engine, output)
        return self.of(2, self.ratio(engine, output)) * pump * np.abs(pump)

    def brought(self, torque: Any, change: float = 0.0) -> Any:
        """Return the torque on the pump by that of the engine, while the output speeds up."""
        if self.is_split:
            return torque / (1 - SPLIT) - INERTIAS[2] * SPLIT * change
        ratio, eta = self.before
        return torque * ratio * np.where(np.asarray(torque) > 0, eta, 1 / eta)

    def asked(self, pump: Any, change: float = 0.0) -> Any:
        """Return the torque of the engine by that on the pump."""
        if self.is_split:
            return (pump + INERTIAS[2] * SPLIT * change) * (1 - SPLIT)
        ratio, eta = self.before
        return pump / ratio / np.where(pump > 0, eta, 1 / eta)

    def given(self, engine: Any, output: float, change: float = 0.0) -> Any:
        """Return the torque of the output that the pump gives, while the output speeds up."""
        pump = self.taken(engine, output)
        turbine = pump * self.of(1, self.ratio(engine, output))
        if self.is_split:
            return turbine - SPLIT * self.asked(pump, change) / (1 - SPLIT) - INERTIAS[3] * change
        turbine -= INERTIAS[3] * self.behind * change
        eta = by_map(self.turbine(output), turbine) if self.has_map else 0.96
        return turbine * self.behind * np.where(turbine > 0, eta, 1 / eta)

    def slowest(self, output: float) -> float:
        """Return the engine speed at the last point of the converter."""
        last = self.points[-1][0]
        pump = self.turbine(output) / last
        return (pump - SPLIT * output) / (1 - SPLIT) if self.is_split else pump * self.before[0]


def first_root(function: Callable[[Any], Any], low: float, high: float) -> float:
    """Return the smallest root, or NaN."""
    places = np.geomspace(max(low, 1e-6), high, 4001)
    values = function(places)
    turns = np.flatnonzero(values[:-1] * values[1:] <= 0)
    if not turns.size:
        return math.nan
    ends = places[turns[0]], places[turns[0] + 1]
    return float(brentq(lambda x: float(function(x)), *ends, xtol=1e-13, rtol=1e-15))


def train(seed: int, *, is_split: bool = False) -> Train:
    random = generator(seed, 51)
    speeds = np.sort(random.uniform(60, 600, random.integers(2, 6)))
    speeds = speeds + 15 * np.arange(len(speeds))
    torques = random.uniform(120, 400, len(speeds))
    car = Vehicle(1500, 0.31, 0.012, 0.6, 3.2, engine=list(zip(speeds, torques, strict=True)))
    overrun = [(float(speeds[0]), -15.0), (float(speeds[-1]), -60.0)]
    car = car._replace(overrun=overrun) if seed % 2 else car
    if seed % 3 == 0:
        machine = Machine(car.engine, generating=overrun, efficiency=0.9)
        car = car._replace(engine=(), overrun=(), machine=machine, recuperation=0.7)
    before = (float(random.uniform(0.8, 1.4)), 0.97)
    ratios = [0.0, 0.25, 0.5, 0.7, 0.85, 1.0]
    size = 230.0 / float(random.uniform(110, 260)) ** 2 * (0.3 if is_split else before[0] ** 3)
    factors = size * random.uniform(0.5, 1.3, 6)
    factors[-1] = 0.0
    torque_ratios = [1 + 1.1 * max(0.0, 1 - i / 0.85) for i in ratios]
    points = list(zip(ratios, torque_ratios, factors.tolist(), strict=True))
    if seed % 2:
        points.append((1.5, 1.0, -float(factors[-2])))
    return Train(points, car, before, float(random.uniform(1.0, 4.0)), is_split, seed % MAPPED == 1)


def full_load(by_hand: Train, output: float) -> tuple[float, float]:
    """Return speed of the engine and force at the wheels."""
    car = by_hand.car
    speeds, torques = np.array(car.full_load).T
    last = float(speeds[-1])

    def surplus(engine: Any) -> Any:
        torque = by_hand.brought(np.interp(engine, speeds, torques))
        return torque - by_hand.taken(engine, output)

    free = by_hand._replace(points=[p for p in by_hand.points if p[2] >= 0])
    engine = first_root(surplus, free.slowest(output), last)
    engine = last if math.isnan(engine) else engine
    return engine, float(by_hand.given(engine, output)) * car.final_drive / car.radius


@pytest.mark.parametrize("is_split", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_engine_and_converter_find_each_other_at_full_load(seed: int, is_split: bool) -> None:
    by_hand = train(seed, is_split=is_split)
    pull = Traction(by_hand.case(), by_hand.car)
    speeds = generator(seed).uniform(0, 0.98, 12) * pull.last
    output = speeds * pull.per_engine[0] * by_hand.car.final_drive / by_hand.car.radius
    expected = np.array([full_load(by_hand, x) for x in output])
    assert pull.engine_speeds(0, speeds) == pytest.approx(expected[:, 0], rel=1e-9)
    assert pull.forces(0, speeds) == pytest.approx(expected[:, 1], rel=1e-8, abs=1e-5)


class Step(NamedTuple):
    """Speed and torque of the engine, and force at the wheels."""

    engine: float
    torque: float
    force: float

    @classmethod
    def of(cls, by_hand: Train, speed: float, change: float, force: float) -> Step:
        """Return a step in which the wheels ask for a force."""
        car = by_hand.car
        factor = car.final_drive / car.radius
        output, dx = speed * factor, change * factor
        high = 2e3 + 4 * by_hand.slowest(output)
        lowest = max(car.full_load[0][0], by_hand.slowest(output))

        def delivered(engine: Any) -> Any:
            return by_hand.given(engine, output, dx) * factor

        def asked(engine: float) -> float:
            return float(by_hand.asked(by_hand.taken(engine, output), dx))

        engine = first_root(lambda x: delivered(x) - force, lowest, high)
        engine = lowest if math.isnan(engine) else engine
        torque = asked(engine)
        if torque < float(car.overrun_torque(engine)) - 1e-9:  # also at the last speed ratio
            engine = first_root(
                lambda x: by_hand.brought(car.overrun_torque(x), dx) - by_hand.taken(x, output),
                lowest,
                high,
            )
            is_lowest = math.isnan(engine)
            engine = lowest if is_lowest else engine
            torque = asked(lowest) if is_lowest else float(car.overrun_torque(engine))
        return cls(engine, torque, float(delivered(engine)))


def random_trace(seed: int) -> Trace:
    random = generator(seed, 7)
    speeds = np.concatenate([[0, 0.3], random.uniform(0, 18, 8), [0.2, 0, 0]])
    times = np.cumsum(random.uniform(3, 9, len(speeds)))
    return timed("\n".join(f"{time},{speed}" for time, speed in zip(times, speeds, strict=True)))


@pytest.mark.parametrize("is_split", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_cycle_is_as_step_by_step(seed: int, is_split: bool) -> None:
    by_hand, trace = train(seed, is_split=is_split), random_trace(seed)
    driven, car = cycled(by_hand.case(), trace), by_hand.car
    moving = np.flatnonzero(trace.speed > 0)
    force = car.resistance(trace.speed) + car.mass * trace.acceleration
    steps = [
        Step.of(
            by_hand,
            float(trace.speed[n]),
            float(trace.acceleration[n]),
            float(force[n] * (car.recuperation if force[n] < 0 else 1)),
        )
        for n in moving
    ]
    kind = "machine" if car.machine else "engine"
    engine = driven.steps[f"{kind} speed [rpm]"][moving] * math.pi / 30
    torque = driven.steps[f"{kind} torque [N*m]"][moving]
    assert engine == pytest.approx([step.engine for step in steps], rel=1e-8)
    assert torque == pytest.approx([step.torque for step in steps], rel=1e-7, abs=1e-6)
    brakes = sum(
        (step.force - force[n]) * trace.speed[n] * trace.duration[n]
        for n, step in zip(moving, steps, strict=True)
    )
    energy = driven.energy
    given = (energy.machine if car.machine else energy.engine) or 0.0
    assert energy.brakes == pytest.approx(brakes, rel=1e-7, abs=1e-3)
    assert given == pytest.approx(spent(energy), rel=1e-9)
    factor = car.final_drive / car.radius
    lost = 0.0
    for n, step in zip(moving, steps, strict=True):
        x = trace.speed[n] * factor
        pump, taken = by_hand.pump(step.engine, x), by_hand.taken(step.engine, x)
        torque_ratio = by_hand.of(1, by_hand.ratio(step.engine, x))
        lost += taken * (pump - torque_ratio * by_hand.turbine(x)) * trace.duration[n]
    assert energy.lost.get("TC", 0.0) == pytest.approx(lost, rel=1e-7, abs=1e-3)


STALL = ((0.0, 2.0, 0.002), (0.8, 1.0, 0.0015), (1.0, 1.0, 0.0))


def automatic(**more: Any) -> Transmission:
    """Return a converter before a pair of 4, with an engine of 200 N*m up to 500 rad/s."""
    car = Vehicle(2000, 0.5, 0.0, 0.0, 1.5, engine=[(0.0, 200.0), (500.0, 200.0)])
    points = more.pop("points", STALL)
    parts = [
        Mechanism(1, 2, 0, math.nan, name="TC", kind="converter", points=points),
        Mechanism(2, 3, 0, 4.0, 0.9),
    ]
    return Transmission(3, [], parts, [Gear()], vehicle=car, **more)


SIMPSON = """
links: [engine, turbine, ring, sun, carrier, out]
output: out
load: {{speed: 2000 rpm, torque: 150 N*m}}
{sets}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine,
       points: [[0, 2, 4e-3], [0.8, 1.1, 3.8e-3], [1, 1, 0]]}}
  {pairs}
shift_elements: {{C1: [turbine, ring], C2: [turbine, sun], B2: [carrier, housing]}}
gears: {{"1": [C1, B2], "3": [C1, C2], R: [C2, B2]}}
vehicle: {{mass: 1500, radius: 0.3, rolling: 0, drag_area: 0, final_drive: 3, engine: [[0, 200], [600, 200]]}}
"""


def test_gear_sets_behind_the_converter_are_as_their_mechanisms() -> None:
    """At rest the engine gives 200 N*m, times 2 in the converter and 88/36 in first gear."""
    teeth = "kind: planetary, teeth: {sun: 32, ring: 72}"
    elements = f"""mesh_efficiency: {{external: 1, internal: 1}}
elements:
  P1: {{{teeth}, sun: sun, ring: ring, carrier: out}}
  P2: {{{teeth}, sun: sun, ring: out, carrier: carrier}}"""
    pairs = """P1: {first: sun, second: ring, third: out, ratio: -72/32}
  P2: {first: sun, second: out, third: carrier, ratio: -72/32}"""
    texts = [SIMPSON.format(sets=elements, pairs=""), SIMPSON.format(sets="", pairs=pairs)]
    trace = "0,0,1\n9,9,3\n20,25,3\n30,8,1"
    drawn, plain = ((performance(case), cycled(case, trace)) for case in map(loads, texts))
    force = 200 * 2 * 88 / 36 * 3 / 0.3
    assert drawn[0].gears["1"].slope == pytest.approx(force / 1500 / GRAVITY, rel=1e-9)
    assert drawn[0].gears == plain[0].gears
    found, expected = (
        [pull.time_to_100, cycle.energy.lost["TC"], cycle.energy.engine]
        for pull, cycle in (drawn, plain)
    )
    assert found == pytest.approx(expected, rel=1e-12)


def test_links_before_the_converter_are_no_mass_at_full_load() -> None:
    """Over i at a constant torque: w = sqrt(T/lambda), v = i w/12, F = K T 0.9 12.

    Only the turbine, 12 times as fast as the vehicle, adds to the mass.
    """
    ratios = np.linspace(0, 0.89, 400_001)
    _, torque_ratio, factor = (np.interp(ratios, *np.array(STALL)[:, [0, n]].T) for n in range(3))
    speeds = ratios * np.sqrt(200 / factor) / 12
    slowness = (2000 + 0.1 * 12**2) / (torque_ratio * 200 * 0.9 * 12)
    edges = np.linspace(0, 100 / 3.6, 400_001)
    time = np.trapezoid(np.interp(edges, speeds, slowness), edges)
    case = automatic(inertias={1: 5.0, 2: 0.1})
    assert performance(case).time_to_100 == pytest.approx(time, rel=1e-6)


def test_a_trace_that_no_speed_ratio_fits_is_an_error_at_its_row() -> None:
    """From i = 0.5 on, an engine of a slow vehicle would turn slower than at its first point."""
    car = Vehicle(2000, 0.5, engine=[(100.0, 200.0), (500.0, 200.0)])
    case = automatic(points=STALL[1:]).replace(vehicle=car)
    with pytest.raises(CaseError) as error:
        cycled(case, "0,20\n5,20\n6,1\n7,1")
    assert {(p.id, p.path) for p in error.value.problems} == {("E424", (2,))}


BEYOND = """links: [engine, turbine]
load: {speed: 2000 rpm, torque: 80 N*m}
drag: {turbine: 5 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine}
gears: {"1": []}
vehicle: {mass: 1000, radius: 0.3, final_drive: 10, engine: [[10, 200], [900, 200]]}
"""


@pytest.mark.parametrize("turbine", [2.0, -1.0, -7.0])
def test_converters_brake_beyond_the_ratio_at_which_they_lose_no_power(turbine: float) -> None:
    """At 100 rad/s the turbine gives 98 (1 - i)/i^2 N*m, but nothing from i = 1 to 1/0.98.

    A torque of -1 N*m is between these ratios, so the converter is free, and the brakes take it.
    """
    points = "[[0, 2, 0.02], [0.5, 0.98, 0.005], [1, 0.98, 0], [1.2, 0.98, -2e-3]]"
    text = BEYOND.replace("turbine}", f"turbine, points: {points}}}")
    text = text.replace("200]]}", "200]], overrun: [[10, -50], [900, -50]]}")
    cycle = cycled(loads(text), around(3, (turbine - 5) / 0.03 / 2000))
    i, brakes = (-98 + math.sqrt(98**2 + 4 * 98 * turbine)) / (2 * turbine), 0.0
    if turbine == -1:
        i, brakes = 1.0, 100.0
    speeds, torques = (cycle.steps[f"engine {of}"] for of in ("speed [rpm]", "torque [N*m]"))
    assert speeds * math.pi / 30 == pytest.approx([100 / i])
    assert torques == pytest.approx([0.0 if brakes else turbine / 0.98], abs=1e-9)
    assert cycle.energy.brakes == pytest.approx(brakes, abs=1e-6)


BY_TURBINE = """
links: [engine, turbine, out]
load: {speed: 1000 rpm, torque: 10 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine,
       points: [[0, 2, 4e-3], [1, 1, 0], [1.5, 0.95, -2e-3]]}
  P: {first: turbine, second: engine, third: out, ratio: -2}
gears: {"1": []}
vehicle: {mass: 1000, radius: 1, engine: [[10, 100], [600, 100]]}
"""


def test_a_split_at_full_load_is_between_the_ends_of_the_points() -> None:
    """At i = 0.5, M (1 + 2 K) = 100 with K = 1.5, so M = 25 and the output gets 3 K M.

    Below i = 0 there is no force: the points say nothing of a turbine that turns backward.
    """
    case = loads(BY_TURBINE)
    pull = Traction(case, Vehicle.needed(case))
    pump = math.sqrt(25 / 2e-3)
    forces = pull.forces(0, np.array([(0.5 + 2) / 3 * pump, 40.0]))
    assert forces == pytest.approx([3 * 1.5 * 25, math.nan], rel=1e-9, nan_ok=True)
    assert math.isnan(performance(case).time_to_100)


@pytest.mark.parametrize("force", [20, 23, 1000])
def test_a_force_that_a_split_cannot_give_is_an_error(force: float) -> None:
    """At 20 rad/s the pump turns at 30 at most (i = 0), so the output gets 3 K lambda 30^2 = 21.6.

    Beyond i = 1, where the converter would gain power, it gives nothing. With w_T - 2.4 w_P = -1.4w
    the turbine turns the output backward: the brakes would have to push at any torque.
    """
    trace = around(20, force / 2000)
    if force < 21.6:
        energy = cycled(loads(BY_TURBINE), trace).energy
        assert energy.wheels == pytest.approx(20 * force)
        assert energy.brakes == 0
    backward = BY_TURBINE.replace("-2}", "2.4}").replace(", [1.5, 0.95, -2e-3]", "")
    for text in [BY_TURBINE, backward] if force > 21.6 else []:
        with pytest.raises(CaseError, match="no speed ratio of TC") as error:
            cycled(loads(text), trace)
        assert [(p.id, p.path) for p in error.value.problems] == [("E424", (0,))]


def test_a_speed_ratio_is_found_next_to_ratios_at_which_a_split_is_self_locking() -> None:
    """The gear set turns the turbine with F/0.77 - F, so the converter gives the rest of 3 N*m.

    With the output at 21 rad/s, w_T = 11 * 21 - 10 w. Above some speed ratio the set is self-locking.
    """
    text = BY_TURBINE.replace("mechanisms:", "drag: {turbine: 3 N*m}\nmechanisms:").replace(
        "turbine, second: engine, third: out, ratio: -2",
        "engine, second: out, third: turbine, ratio: 1.1, efficiency: 0.7",
    )
    steps, force = cycled(loads(text), "0,20.999\n1,21.001").steps, 2.0
    [speed], [torque] = steps["engine speed [rpm]"] * math.pi / 30, steps["engine torque [N*m]"]
    i = 11 * 21 / speed - 10
    pump = 4e-3 * (1 - i) * speed**2
    assert (2 - i) * pump == pytest.approx(3 + force - force / 0.77, rel=1e-8)
    assert torque == pytest.approx(pump + force / 0.77, rel=1e-8)


CREEP_POINTS = [[0, 2, 4e-3], [0.8, 1.1, 3.8e-3], [1, 1, 0]]
CREEP = """links: [engine, turbine, shaft, out]
load: {{speed: 2000 rpm, torque: 150 N*m}}
shift_elements: {{C: [turbine, shaft]}}
drag: {{engine: {drag} N*m}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, points: {points}}}
  P: {{first: shaft, second: out, ratio: 3, efficiency: 0.97}}
gears: {{creep: {{slip: {{C: {slip}}}}}}}
vehicle: {{mass: 1500, radius: 0.3, rolling: 0, drag_area: 0, final_drive: 3, engine: [[0, 200], [600, 200]]}}
"""


@pytest.mark.parametrize("seed", range(count(11, 160)))
def test_a_clutch_that_slips_behind_the_converter_makes_the_turbine_faster(seed: int) -> None:
    """At the engine speed w the turbine turns with 3 x + slip w, or 3 x + slip in rad/s.

    The clutch carries the torque of the turbine, and nothing where the wheels would drive it.
    """
    random = generator(seed, 52)
    relative, absolute = random.choice([[random.uniform(0.02, 0.4), 0], [0, random.uniform(2, 40)]])
    drag = float(random.choice([0, 3]))
    slip = relative or f"{absolute} rad/s"
    case = loads(CREEP.format(drag=drag, slip=slip, points=CREEP_POINTS))
    assert not list(doubts(case))
    pull, points = Traction(case, Vehicle.needed(case)), np.array(CREEP_POINTS)

    def pump(w: Any, x: float) -> Any:
        i = (3 * x + absolute) / w + relative
        return np.interp(i, points[:, 0], points[:, 2]) * w**2, np.interp(i, *points[:, :2].T), i

    for part in random.uniform(0, 0.6, 3):
        x = float(part * pull.last * pull.per_engine[0] / 0.3 * 3)
        free = (3 * x + absolute) / (1 - relative)
        w = first_root(lambda w: 200 - drag - pump(w, x)[0], free * (1 + 1e-12), 600)  # noqa: B023
        force = (200 - drag) * pump(w, x)[1] * 3 * 0.97 * 10
        assert pull.forces(0, np.array([part * pull.last])) == pytest.approx([force], rel=1e-8)
        asked, v = float(random.uniform(-3000, 3000)), x / 10
        if v < abs(asked) / 3e4:
            continue
        energy = cycled(case, around(v, asked / 3e4, 0.1)).energy
        turbine = max(asked / 10 / 3 / 0.97, 0.0)
        w = first_root(lambda w: turbine - pump(w, x)[0] * pump(w, x)[1], free, 5000)  # noqa: B023
        w = w if turbine else free
        lost = {"slip.C": turbine * (absolute + relative * w), "drag.engine": drag * w}
        engine = pump(w, x)[0] * w + drag * w
        assert energy.engine == pytest.approx(0.1 * engine, rel=1e-8, abs=1e-5)
        for name in lost if drag else ["slip.C"]:
            assert energy.lost[name] == pytest.approx(0.1 * lost[name], rel=1e-8, abs=1e-5)
        assert energy.brakes == pytest.approx(max(-asked, 0) * v * 0.1, rel=1e-8, abs=1e-5)


LOCK_UP = """links: [engine, turbine, output]
load: {speed: 2000 rpm, torque: 200 N*m}
shift_elements: {LU: [engine, turbine]}
inertias: {engine: 0.2, turbine: 0.05}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2, 3e-3], [1, 1, 0]]}
  P: {first: turbine, second: output, ratio: 3, efficiency: 0.97}
gears: {creep: {slip: {LU: 5 rad/s}}}
vehicle: {mass: 1500, radius: 0.3, final_drive: 3, engine: [[0, 200], [900, 200]]}
"""


def test_beside_a_slipping_lock_up_the_engine_turns_faster_by_the_slip() -> None:
    """The force of 1500 kg at 1 m/s^2 has 150 N*m at the output, which gains 10 rad/s a second."""
    case = loads(LOCK_UP)
    assert not list(doubts(case))
    cycle = cycled(case, "0,9\n2,11")
    turbine, w = 150 / (3 * 0.97) + 0.05 * 30, 300 + 5
    i = 300 / w
    pump = 3e-3 * (1 - i) * w**2
    clutch = turbine - (2 - i) * pump
    engine = clutch + pump + 0.2 * 30
    assert cycle.energy.engine == pytest.approx(engine * w * 2)
    converter = pump * w * (1 - (2 - i) * i)
    lost = {"P": 150 * 100 * 0.03 / 0.97 * 2, "TC": converter * 2, "slip.LU": clutch * 5 * 2}
    assert cycle.energy.lost == pytest.approx(lost)
    assert performance(case).gears["creep"].top_speed == pytest.approx(3.6 * 895 / 30)
    # the turbine has 200 + (K - 1) 3e-3 (1 - i) w^2 N*m, with (K - 1) w = (1 - i) w = 5 rad/s
    force = (200 + 3e-3 * 5**2) * 3 * 0.97 * 3 / 0.3
    assert performance(case).gears["creep"].slope == pytest.approx(force / 1500 / 9.81)


@pytest.mark.parametrize(
    ("command", "further"),
    [
        ("summary", ["-o", "x.md"]),
        ("cycle", ["t.csv", "-o", "x.json"]),
        pytest.param("plot", ["-k", "traction", "-o", "x.svg"], marks=needs("pictures")),
        pytest.param("report", ["-o", "x.html"], marks=needs("page")),
    ],
)
@pytest.mark.usefixtures("folder")
def test_a_gear_in_which_engine_and_converter_cannot_meet_is_located(
    command: str, further: list[str]
) -> None:
    text = """\
links: [engine, turbine, w]
load: {speed: 2000 rpm, torque: 80 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: turbine, points: [[0, 2, 0.002], [1, 1, 0]]}
  p: {first: engine, second: w, ratio: 3}
gears:
  "1": []
vehicle: {mass: 1200, radius: 0.3, engine: [[80, 100], [600, 120]]}
"""
    Path("car.yaml").write_text(text, "utf-8")
    Path("t.csv").write_text("time [s],speed [km/h]\n0,0\n9,20\n", "utf-8")
    done = vstatics(command, "car.yaml", *further)
    assert done.status == 1
    assert "car.yaml:7:3: error: gears.1: the speed of the output does not depend on TC" in done.err
    assert not list(Path().glob("x.*"))


@pytest.mark.parametrize("is_split", [False, True])
def test_inertias_can_drive_the_turbine_while_the_wheels_need_a_small_force(is_split: bool) -> None:
    """The engine then drives as little as possible, and the brakes absorb the excess."""
    by_hand = train(1, is_split=is_split)
    car, speed = by_hand.car, 5.0
    change = -(car.resistance(speed) - 3.0) / car.mass
    driven = cycled(by_hand.case(), around(speed, change / 2))
    step = Step.of(by_hand, speed, change, 3.0)
    assert driven.steps["engine speed [rpm]"][0] * math.pi / 30 == pytest.approx(step.engine)
    assert driven.steps["engine torque [N*m]"][0] == pytest.approx(step.torque, abs=1e-9)
    assert driven.energy.brakes == pytest.approx((step.force - 3.0) * speed, abs=1e-6)


FREEWHEEL = """links: [engine, turbine, output]
load: {{speed: 2000 rpm, torque: 200 N*m}}
shift_elements: {{F: {{kind: freewheel, links: [engine, turbine]}}}}
drag: {{engine: {drag!r} N*m}}
mechanisms:
  TC: {{kind: converter, first: engine, second: turbine, points: {points}}}
  P: {{first: turbine, second: output, ratio: 3, efficiency: 0.97}}
gears: {{"1": []}}
vehicle: {{mass: 1500, radius: 0.3, final_drive: 3, engine: [[0, 200], [900, 200]], overrun: {overrun}}}
"""


@pytest.mark.parametrize(("last", "beyond"), [(0.98, ""), (0.98, ", [1.3, 0.97, -2e-3]"), (1, "")])
@examples(5, 12, 200)
def test_a_freewheel_over_the_converter_lets_the_engine_brake(
    last: float, beyond: str, examples: int
) -> None:
    """At v m/s the turbine turns at 30 v rad/s; the freewheel lets no engine turn slower."""
    random, points = generator(53), f"[[0, 2, 3e-3], [0.9, 1, 2e-3], [1, {last}, 0]{beyond}]"
    for number in range(examples):
        drag, most, asked = random.uniform(0, 5), random.uniform(5, 60), random.uniform(-3e3, 1e3)
        speed, drag = float(random.uniform(3, 20)), float(drag) if number % 3 else 0.0
        case = loads(FREEWHEEL.format(drag=drag, points=points, overrun=f"[[0, {-most!r}]]"))
        cycle = cycled(case, around(speed, asked / 3e4, 0.1))
        torque, w = asked / 10 / 3 * (0.97 if asked < 0 else 1 / 0.97), 30 * speed
        lost = {"P": abs(asked) * speed * 0.03 / (0.97 if asked > 0 else 1)}
        if asked > 0:
            low, high = w * (1 + 1e-12), 20 * w + 2e3

            def taken(engine: float, turbine: float = w) -> Any:
                by_ratio = np.interp(turbine / engine, [0, 0.9, 1], [3e-3, 2e-3, 0])
                return by_ratio * engine**2

            def factor(engine: float, turbine: float = w) -> Any:
                return np.interp(turbine / engine, [0, 0.9, 1], [2, 1, last])

            w = brentq(lambda w: taken(w) * factor(w) - torque, low, high)  # noqa: B023
            lost["TC"] = taken(w) * w - torque * 30 * speed
            engine, brakes = taken(w) + drag, 0.0
        else:
            engine = max(torque + drag, -most)
            given = (engine - drag) * 3 / (0.97 if engine < drag else 1 / 0.97) * 10
            brakes = (given - asked) * speed
            lost["P"] = abs(given) * speed * 0.03 / (1 if given < 0 else 0.97)
        lost["drag.engine"] = drag * w
        assert cycle.energy.engine == pytest.approx(0.1 * engine * w, rel=1e-8)
        assert cycle.energy.brakes == pytest.approx(0.1 * brakes, rel=1e-8, abs=1e-6)
        found = {name: cycle.energy.lost.get(name, 0.0) for name in ("TC", *lost)}
        expected = {"TC": 0.0} | {name: 0.1 * power for name, power in lost.items()}
        assert found == pytest.approx(expected, rel=1e-8, abs=1e-6)


@examples(6, 12, 200)
def test_a_freewheel_supplies_the_torque_that_the_pump_lacks(examples: int) -> None:
    """The pump could take torque beyond i = 1, but the turbine cannot overrun the engine."""
    random = generator(61)
    for number in range(examples):
        free = float(random.uniform(1.02, 1.3))
        points = [[0, 2, 3e-3], [0.9, 1, 2e-3], [free, 1, -1e-4 * (number % 2)]]
        case = loads(FREEWHEEL.format(drag=0.0, points=points, overrun="[[0, 0]]"))
        speed, asked = (random.uniform(3, 20, 2) * (1, 100)).tolist()
        cycle = cycled(case, around(speed, asked / 3e4, 0.1))
        torque, w = float(asked / 10 / 3 / 0.97), float(30 * speed)

        def taken(engine: Any, turbine: float = w) -> Any:
            return np.interp(turbine / engine, *np.transpose(points)[[0, 2]]) * engine**2  # noqa: B023

        def given(engine: float, turbine: float = w) -> float:
            factors = np.interp(turbine / engine, [0, 0.9], [2, 1])
            return float(taken(engine, turbine) * factors)

        locks = given(w) >= torque
        engine = w if locks else brentq(lambda x: given(x) - torque, w, 20 * w)  # noqa: B023
        expected = engine * (torque if locks else taken(engine))
        assert cycle.energy.engine == pytest.approx(0.1 * expected, rel=1e-8)
        assert cycle.energy.brakes == pytest.approx(0, abs=1e-6)
        pull = Traction(case, Vehicle.needed(case))
        last = pull.speeds_at(0, np.array([speed]))
        starts = 200 - taken(w) >= 0
        engine = brentq(lambda x: 200 - taken(x), w, 900) if starts else w
        assert pull.engine_speeds(0, last) == pytest.approx([engine], rel=1e-8)
        ratio = 1 if not starts else np.interp(w / engine, [0, 0.9], [2, 1])
        assert pull.forces(0, last) == pytest.approx([200 * ratio * 3 * 0.97 * 10], rel=1e-8)
        at = solve(case.replace(load=Load(w * 30 / math.pi, float(torque))))
        if locks:
            assert (at.speed_ratio[0, 0], at.ratio[0]) == (1, 3)
            assert not at.messages


def test_with_a_freewheel_behind_the_turbine_the_engine_supplies_the_drag_of_the_turbine(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The pump takes lambda w^2 (1.38) and gives 2 N*m to a turbine that turns with the wheels."""
    calls = Mock(wraps=solve)
    monkeypatch.setattr("vstatics.vehicle.operation.converter.solve", calls)
    case = loads("""
    links: [engine, turbine, mid, wheels]
    shift_elements: {F: {kind: freewheel, links: [mid, turbine]}}
    mechanisms:
      TC: {kind: converter, first: engine, second: turbine, points: [[0, 2, 4e-3], [1, 1, 0]]}
      final: {first: mid, second: wheels, ratio: 8}
    gears: {"1": []}
    load: {speed: 2000 rpm, torque: 100 N*m}
    drag: {turbine: 2 N*m}
    vehicle: {mass: 1450 kg, radius: 0.3, engine: [[80, 140], [600, 170]]}
    """)
    steps = cycled(
        case, "0,6\n1,6\n2,3" + "".join(f"\n{n},{n / 10 + 2.7}" for n in range(3, 23))
    ).steps
    for step, turbine in enumerate([8 * 6 / 0.3, 8 * 4.5 / 0.3]):
        i = brentq(
            lambda i, w: (2 - i) * 4e-3 * (1 - i) * (w / i) ** 2 - 2, 0.5, 1, args=(turbine,)
        )
        assert steps["engine speed [rpm]"][step] * math.pi / 30 == pytest.approx(turbine / i)
        assert steps["engine torque [N*m]"][step] == pytest.approx(2 / (2 - i))
    assert calls.call_count < 60  # halving a bracket to 1e-12 takes 40 for each of two torques
    # Each of the 20 driving steps needs some places down to its ratio, and the steps of a secant.
    points = (call.kwargs.get("vary", {}).get("load.speed", ()) for call in calls.call_args_list)
    assert sum(map(np.size, points)) < 300


@pytest.mark.usefixtures("folder")
def test_a_cycle_has_no_message_about_the_load_of_the_case() -> None:
    """The pump takes at most 3e-3*w^2, 132 N*m at 2000 rpm, not the 9 kN*m of the case."""
    text = LOCK_UP.replace("200 N*m", "9 kN*m").replace("{slip: {LU: 5 rad/s}}", "[]")
    Path("car.yaml").write_text(text, "utf-8")
    Path("t.csv").write_text("time [s],speed [km/h],gear\n0,36,creep\n9,36,creep\n", "utf-8")
    assert "at no speed ratio" in vstatics("run", "car.yaml").err
    assert vstatics("cycle", "car.yaml", "t.csv").is_without_messages()
