"""Electric vehicles in a cycle: each step by hand with scipy's maps, and balances of energy."""

import math
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from tests.chance import examples, seeded
from tests.commands import json_answer, vstatics
from tests.core.statics.points.test_maps import Grid, interpolated, random_map
from tests.rejects import rejects
from tests.vehicle.operation.cycles import cycled, spent, timed
from vstatics import (
    CaseError,
    Gear,
    Load,
    Mechanism,
    ReadError,
    ShiftElement,
    Transmission,
    loads,
)
from vstatics.core.model.laws import MapLaw
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.core.readers.named.law_formulas import DragFormula, EfficiencyFormula
from vstatics.core.writers.named import write_yaml
from vstatics.vehicle.case.vehicle import Machine, Vehicle
from vstatics.vehicle.operation.drive_cycle import DriveCycle, drive
from vstatics.vehicle.operation.gear_choice import GearChoice
from vstatics.vehicle.operation.trace import Trace
from vstatics.vehicle.operation.traction import performance

RATIO, ETA, INERTIA = 8.0, 0.95, 0.04


def steps(speeds: list[float]) -> Trace:
    """Steps of 2 s between speeds [m/s]."""
    return timed("\n".join(f"{2 * number},{speed}" for number, speed in enumerate(speeds)))


def driven(vehicle: Vehicle, speeds: list[float], loss: MapLaw | None = None) -> DriveCycle:
    """Steps of 2 s with a gear pair."""
    pair = Mechanism(1, 2, 0, RATIO, ETA, name="pair")
    gear = Gear(name="1", loss=loss)
    case = Transmission(2, [], [pair], [gear], inertias={1: INERTIA}, vehicle=vehicle)
    return cycled(case, steps(speeds))


def random_drive(chance: Random) -> tuple[Vehicle, Grid, float]:
    grid = random_map(chance, low=0.6, high=0.95, sides=True)
    battery = chance.uniform(0.9, 1)
    generating = [(0.0, -20.0), (700.0, -90.0)] * (chance.random() < 0.5)
    auxiliary = chance.choice([0.0, chance.uniform(0.3, 3)])
    machine = Machine([(0, 260), (900, 120)], generating, MapLaw(*grid), battery, auxiliary)
    part = chance.choice([0.0, 0.5, 0.8, 1.0])
    car = Vehicle(1500, 0.3, 0.012, 0.6, machine=machine, recuperation=part)
    return car, grid, battery


@examples(4, 12, 500)
def test_each_step_by_hand(examples: int) -> None:
    """Power of the wheels passes pair and inertia to the machine, and by the map to the battery.

    Other consumers as in https://github.com/NatLabRockies/altrios/pull/32.
    """
    chance = seeded(61)
    for _ in range(examples):
        car, grid, battery = random_drive(chance)
        assert car.machine is not None
        eta = interpolated(*grid)
        speeds = [chance.uniform(0.5, 25) for _ in range(chance.randint(4, 9))]
        found = driven(car, speeds)
        out = returned = brakes = mechanical = 0.0
        for before, after in pairwise(speeds):
            v, a = (before + after) / 2, (after - before) / 2
            force = 1500 * GRAVITY * 0.012 + AIR * 0.6 / 2 * v**2 + 1500 * a
            asked = force if force > 0 else car.recuperation * force
            w, at_pair = v / 0.3 * RATIO, asked * 0.3 / RATIO
            torque = at_pair * (1 / ETA if at_pair > 0 else ETA) + INERTIA * a / 0.3 * RATIO
            if torque < (limit := float(car.overrun_torque(w))):
                given = limit - INERTIA * a / 0.3 * RATIO
                asked, torque = given * RATIO / 0.3 * (ETA if given > 0 else 1 / ETA), limit
            brakes += 2 * (asked - force) * v
            power = torque * w
            e = eta(w, torque)
            electric = (power / e if power > 0 else power * e) + 1000 * car.machine.auxiliary
            from_battery = electric / battery if electric > 0 else electric * battery
            mechanical += 2 * power
            out += 2 * max(from_battery, 0)
            returned += 2 * max(-from_battery, 0)
        energy, use = found.energy, found.battery
        assert use is not None
        assert (use.out, use.returned) == pytest.approx((out, returned), rel=1e-9)
        assert energy.brakes == pytest.approx(brakes, rel=1e-9, abs=1e-6)
        assert energy.machine == pytest.approx(mechanical, rel=1e-9, abs=1e-6)
        assert found.consumption == pytest.approx(
            (out - returned) / 3.6e6 / (found.distance / 1e5), rel=1e-9
        )


@examples(4, 12, 500)
def test_energies_add_up_with_a_loss_of_the_gear(examples: int) -> None:
    """The gear loses what its map has at the torque that enters, less the inertia of the input."""
    chance = seeded(62)
    for _ in range(examples):
        car, _, _ = random_drive(chance)
        columns, rows = random_map(chance, low=0, high=15)
        found = driven(car, [chance.uniform(1, 25) for _ in range(6)], MapLaw(columns, rows, "N*m"))
        energy, use = found.energy, found.battery
        parts: list[Any] = [energy.machine, energy.machine_lost, energy.battery_lost]
        parts.append(energy.auxiliary or 0.0)
        assert energy.engine is None
        assert use is not None
        assert energy.battery == pytest.approx(use.out - use.returned, rel=1e-12)
        assert energy.battery == pytest.approx(math.fsum(parts), rel=1e-12)
        assert energy.machine == pytest.approx(spent(energy), rel=1e-9)
        entering = zip(found.steps["speed [rpm]"], found.steps["torque [N*m]"], strict=True)
        value = interpolated(columns, rows)
        braked = [
            value(n * math.pi / 30, abs(torque)) * n * math.pi / 30 * 2 for n, torque in entering
        ]
        assert energy.lost["gear.1"] == pytest.approx(sum(braked), rel=1e-9)


def test_a_machine_pulls_as_an_engine_with_its_full_load() -> None:
    points = [(0.0, 260.0), (900.0, 120.0)]
    pair = Mechanism(1, 2, 0, RATIO, ETA)
    engine, electric = (
        performance(Transmission(2, [], [pair], [Gear()], vehicle=Vehicle(1500, 0.3, **own)))
        for own in ({"engine": points}, {"machine": Machine(points)})
    )
    assert engine == electric
    car = Vehicle(1500, 0.3, machine=Machine(points))
    assert car.overrun_torque(np.array([0.0, 450.0, 901.0])).tolist() == [-260, -190, 0]


def test_a_formula_that_gives_no_efficiency_fails_at_its_step() -> None:
    machine = Machine([(0, 300)], efficiency=EfficiencyFormula("0.9 - 0.001*w"))
    with pytest.raises(CaseError, match="efficiency of the machine, at 1200 rad/s and") as caught:
        driven(Vehicle(1000, 0.3, machine=machine), [44, 46, 48])
    assert [problem.path for problem in caught.value.problems] == [(0,), (1,)]


CAR = """\
links: [m, w]
mechanisms: {p: {first: m, second: w, ratio: 8}}
gears: {"1": []}
vehicle: {mass: 1500, radius: 0.3, %s}
"""
MACHINE = "machine: {torque: [[0, 200], [9000 rpm, 60]]%s}"


def test_a_machine_is_written_as_it_was_read() -> None:
    own = (
        ", generating: [[0, -90]], efficiency: 0.92, battery: {efficiency: 0.97, auxiliary: 800 W}"
    )
    case = loads(CAR % (MACHINE % own + ", recuperation: 0.6, rolling: 0.011"))
    assert loads(write_yaml(case)) == case
    assert Vehicle.needed(case).rolling == 0.011
    machine = Vehicle.needed(case).machine
    assert machine is not None
    assert machine.battery_efficiency == 0.97


def test_a_machine_that_cannot_be_is_refused_at_its_place() -> None:
    for text, said in (
        (MACHINE % "" + ", engine: [[0, 9]]", "read `machine` together with `engine`"),
        (MACHINE % ", generating: [[0, 5]]", "generating[1]: read 5 N*m"),
        (MACHINE % "" + ", recuperation: 1.2", "recuperation: read 1.2"),
        (MACHINE % ", battery: {auxiliary: -1 W}", "battery.auxiliary: read -0.001 kW"),
        ("recuperation: 0.5", "read `recuperation` without `machine`"),
        (MACHINE % ", efficiency: 92", "and up to 1, such as 0.92 for 92 %"),
        (MACHINE % ", battery: {efficiency: 0}", "battery.efficiency: read 0"),
        (MACHINE % ", battery: {efficiency: 95}", "and up to 1, such as 0.95 for 95 %"),
        ("machine: {torque: []}", "torque: read no points, expected at least one"),
        ("machine: {efficiency: 0.9}", "`torque` is missing"),
    ):
        with rejects(ReadError, said, ":4:"):
            loads(CAR % text)


@examples(2, 6, 200)
def test_the_gear_of_least_loss_is_that_of_the_least_energy_alone(examples: int) -> None:
    """Each step is driven alone in each gear; gears with too slow an engine do not count."""
    chance, clutches = seeded(69), [ShiftElement(1, 2), ShiftElement(1, 3)]
    compared = 0
    for _ in range(examples):
        car, _, _ = random_drive(chance)
        if chance.random() < 0.5:
            points = [(150.0, 200.0), (500.0, 260.0), (700.0, 150.0)]
            car = Vehicle(1500, 0.3, 0.012, 0.6, engine=points, overrun=[(0, -30), (700, -80)])
        pairs = [Mechanism(n, 4, 0, chance.uniform(4, 16), chance.uniform(0.9, 1)) for n in (2, 3)]
        gears = [Gear([1], name="1"), Gear([2], name="2")]
        case = Transmission(4, clutches, pairs, gears, inertias={1: INERTIA}, vehicle=car)
        speeds = [chance.uniform(0.5, 14) for _ in range(6)]
        choice = GearChoice(chance.choice([None, 250.0]), least_loss=True)
        least = car.full_load[0][0] if choice.least_speed is None else 250.0

        def energy(gear: str, before: float, after: float, of: Any = (case, least)) -> float:
            case, least = of
            alone = cycled(case, f"0,{before},{gear}\n2,{after},{gear}")
            is_slow = alone.steps["speed [rpm]"][0] * math.pi / 30 < least
            if alone.beyond or is_slow or any(note.id == "W428" for note in alone.messages):
                return math.inf
            given = alone.energy.engine if alone.energy.machine is None else alone.energy.battery
            return math.nan if given is None else given

        found = drive(case, steps(speeds), choice)
        for gear, (before, after) in zip(found.gears, pairwise(speeds), strict=True):
            energies = {name: energy(name, before, after) for name in ("1", "2")}
            if math.isfinite(min(energies.values())):
                compared += 1
                assert energies[gear] == pytest.approx(min(energies.values()), rel=1e-9)
    assert compared > examples


@examples(3, 6, 100)
def test_open_clutches_leave_the_gear_of_the_smallest_ratio(examples: int) -> None:
    """While the vehicle brakes, slipping clutches are open, and the engine drives in no gear."""
    chance, clutches = seeded(64), [ShiftElement(1, 2), ShiftElement(1, 3)]
    for _ in range(examples):
        ratios = {2: chance.uniform(8, 12), 3: chance.uniform(4, 7)}
        pairs = [Mechanism(n, 4, 0, ratio, chance.uniform(0.8, 1)) for n, ratio in ratios.items()]
        gears = [Gear(slip={1: 0.1}, name="1"), Gear(slip={2: 0.1}, name="2")]
        car = Vehicle(1500, 0.3, engine=[(0.0, 200.0), (700.0, 150.0)], overrun=[(0, -30)])
        parts = Transmission(4, clutches, pairs, gears, drag={4: 3.0}, vehicle=car)
        case = parts.replace(load=Load(2000, 60))  # drag in N*m
        trace = steps([chance.uniform(18, 20), chance.uniform(14, 16)])
        assert [*drive(case, trace, GearChoice(least_loss=True)).gears] == ["2"]


def test_a_drag_below_0_is_an_error_of_the_case() -> None:
    """Its place is that of the drag, not a row of the trace."""
    pair = Mechanism(1, 2, 0, RATIO, ETA)
    drag: dict[int, float] = {2: DragFormula("0.5 - 0.01*w")}
    case = Transmission(2, [], [pair], [Gear(name="1")], drag=drag, vehicle=Vehicle(1000, 0.3))
    trace = steps([30.0, 30.0])
    for choice in (GearChoice(), GearChoice(least_loss=True)):
        with pytest.raises(CaseError, match="expected a torque of 0 or more") as caught:
            drive(case, trace, choice)
        assert [problem.path for problem in caught.value.problems] == [("drag", 2)]


def test_a_cycle_that_stands_has_no_consumption() -> None:
    found = driven(Vehicle(1000, 0.3, machine=Machine([(0, 300)])), [0.0, 0.0])
    assert found.consumption is not None
    assert math.isnan(found.consumption)


@pytest.mark.parametrize("kinds", ["sawtooth structure", "spectrum traction"])
def test_cycles_and_their_pictures_need_no_load_of_the_case(kinds: str, tmp_path: Path) -> None:
    """From rest to rest without resistance: nothing remains at the wheels."""
    case = tmp_path / "car.yaml"
    text = (
        "mechanisms: {pair: {first: in, second: out, ratio: 8, "
        "efficiency: {over: [speed, torque], columns: [0, 99], rows: [[0, .9, .95], [99, .8, .9]]}}}\n"
        "gears: {'1': []}\nvehicle: {mass: 1500, radius: 0.3, machine: {torque: [[0, 300], [900, 100]]}}\n"
    )
    (tmp_path / "t.csv").write_text("time [s],speed [m/s]\n0,0\n5,9\n9,9\n14,0\n")
    (tmp_path / "d.csv").write_text("time [s],gear,speed [rpm],torque [N*m]\n9,1,0,0\n9,1,900,50\n")
    answers = []
    for load in ("", "load: {speed: 2000 rpm, torque: 90 N*m}\n"):
        case.write_text(f"links: [in, out]\n{load}{text}")
        energy = json_answer("cycle", case, tmp_path / "t.csv")["cycle"]["energy"]
        duty = vstatics("summary", case, "--duty", tmp_path / "d.csv", "-f", "json")
        n423 = "gears are calculated at 900 rpm and 50 N*m, the first of these points"
        assert (n423 in duty.err) == (not load)
        pictures = []
        for kind in kinds.split():
            points = ("--duty", tmp_path / "d.csv") if kind == "spectrum" else ()
            drawn = vstatics("plot", case, "-k", kind, *points, "-o", tmp_path / "p.svg")
            assert drawn.status == 0
            pictures.append((tmp_path / "p.svg").read_bytes())
        answers.append((energy, duty.json["duty"]["energy"], pictures))
    assert answers[0] == answers[1]
    assert answers[0][0]["wheels"] == 0
