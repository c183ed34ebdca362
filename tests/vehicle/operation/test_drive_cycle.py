"""Driving cycles: energies in closed form, and what the engine gives against statics."""

import math
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.commands import vstatics
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
    solve,
)
from vstatics.core.model.checks import doubts
from vstatics.core.model.parts import BatteryBalance, OfLoad
from vstatics.core.model.transmission import SpeedOf
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.core.readers import sweep_tables
from vstatics.core.summary.design_table import design
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.drive_cycle import drive
from vstatics.vehicle.operation.fuel_map import FuelMap, read_fuel_map
from vstatics.vehicle.operation.gear_choice import GearChoice
from vstatics.vehicle.operation.shifting import EngineSpeeds, by_shift_speeds, read_shifts
from vstatics.vehicle.operation.trace import Trace
from vstatics.vehicle.operation.traction import performance

CAR = Vehicle(1200, 0.3, 0.012, 0.65, 4.1)
CASE = Transmission(
    4,
    [ShiftElement(1, 2), ShiftElement(1, 3)],
    [Mechanism(2, 4, 0, 3.5, 0.97, name="first"), Mechanism(3, 4, 0, -1.5, 0.9, name="second")],
    [Gear([1], name="1"), Gear([2], name="2")],
    vehicle=CAR,
    inertias={1: 0.15, 3: 0.02, 4: 0.3},
)


CAR_FILE = """
links: [engine, a, b, out]
shift_elements: {A: [engine, a], B: [engine, b]}
mechanisms:
  first: {first: a, second: out, ratio: 4, efficiency: .8}
  second: {first: b, second: out, ratio: 2, efficiency: .9}
gears: {low: [A], high: [B]}
vehicle: {mass: 1000 kg, radius: 0.5, fuel: {file: fuel.csv}}
"""
TRACE_FILE = "time [s],speed [m/s],gear\n2,0,low\n4,10,low\n5,12,high\n9,12,low\n10,0,low\n"


def parallel(ratios: Mapping[str, float]) -> Transmission:
    """A clutch and a pair for each gear."""
    links = range(2, len(ratios) + 2)
    output = len(ratios) + 2
    pairs = [Mechanism(n, output, 0, u) for n, u in zip(links, ratios.values(), strict=True)]
    gears = [Gear([n], name=name) for n, name in enumerate(ratios, 1)]
    return Transmission(output, [ShiftElement(1, n) for n in links], pairs, gears, vehicle=CAR)


def trace(*rows: tuple[float, float, str]) -> Trace:
    return timed("\n".join(f"{time},{speed},{gear}" for time, speed, gear in rows))


@pytest.mark.parametrize(
    ("gear", "ratio", "eta", "name"), [("1", 3.5, 0.97, "first"), ("2", 1.5, 0.9, "second")]
)
def test_a_step_in_closed_form(gear: str, ratio: float, eta: float, name: str) -> None:
    """From 10 to 12 m/s in 2 s; the engine's torque by hand, with what turns on each side."""
    made = cycled(CASE, f"0,10,{gear}\n2,12,{gear}")
    force = 1200 * 1 + 1200 * GRAVITY * 0.012 + AIR * 0.65 / 2 * 11**2
    k, own, open_pair = 4.1 / 0.3, 0.17, 0.0
    if gear == "1":  # the second pair turns, too, and speeds its first link up
        own, open_pair = 0.15, 0.02 * 1.5**2
    at_output = force / k + (0.3 + open_pair / 0.9) * k
    engine = at_output / ratio / eta + own * k * ratio
    energy = made.energy
    spinning = (0.3 + open_pair) * k**2 + own * (ratio * k) ** 2
    by_hand = [engine * ratio * k, force, at_output * k * (1 / eta - 1), spinning]
    energies = [energy.engine, energy.wheels, energy.lost[name], energy.inertias]
    assert energies == pytest.approx([22 * one for one in by_hand], rel=1e-12)
    turning, entering = ratio * k * 11 * 30 / math.pi, engine - 0.15 * k * ratio
    expected = [1.0, 3.6 * 11, float(gear), turning, engine, force, 2.0, turning, entering]
    assert [float(column[0]) for column in made.steps.values()] == pytest.approx(expected)


@each_seed(20)
def test_random_cycles_are_in_balance(seed: int) -> None:
    """The engine is the sum of all others. Link 5 turns freely in gear 2, so its drag is 0 there."""
    rng = seeded(2770 + seed)
    etas = [rng.uniform(0.7, 1.0) for _ in range(2)]
    sets = [m._replace(efficiency=eta) for m, eta in zip(CASE.mechanisms, etas, strict=True)]
    case = CASE.replace(
        links=5,
        link_names=[],
        output=4,
        shift_elements=[*CASE.shift_elements, ShiftElement(1, 5)],
        mechanisms=sets,
        gears=[
            Gear(engaged, drag={n: OfLoad(rng.uniform(0, 3), 1) for n in (4, 5)}, name=name)
            for name, engaged in (("1", [1, 3]), ("2", [2]))
        ],
        vehicle=CAR._replace(overrun=[(0.0, -rng.uniform(0, 20))]),
        load=Load(2000.0, 100.0),
    )
    rows = [(2.0 * n, rng.choice([0.0, rng.uniform(1, 30)]), rng.choice("12")) for n in range(9)]
    made = cycled(case, trace(*rows))
    parts = made.energy
    assert parts.engine == pytest.approx(spent(parts), rel=1e-9, abs=1e-6)
    assert parts.brakes >= 0


@each_seed(3, 60)
def test_drag_without_unit_is_relative_to_the_input_torque(seed: int) -> None:
    """By hand along the gear pairs, from the torque that the engine leaves for the input."""
    chance = seeded(2790 + seed)
    pairs = [Mechanism(n, n + 1, 0, chance.uniform(1, 4), chance.uniform(0.8, 1)) for n in (1, 2)]
    drag = {link: chance.choice([0, chance.uniform(0, 0.2)]) for link in (1, 2, 3)}
    drag = chance.choice([drag, {1: chance.uniform(0.9, 0.999), 2: 0, 3: 0}])
    car = CAR._replace(overrun=[(0.0, -1e5)])
    case = Transmission(3, [], pairs, [Gear(name="1")], drag=drag, inertias={1: 0.1}, vehicle=car)
    rows = [(2.0 * n, chance.uniform(1, 30), "1") for n in range(9)]
    made = cycled(case, trace(*rows)).steps
    ratio = car.final_drive / car.radius
    turning = math.prod(pair.ratio for pair in pairs) * np.diff([v for _, v, _ in rows]) / 2 * ratio
    entering = np.array(made["engine torque [N*m]"]) - 0.1 * turning
    torque = entering - drag[1] * np.abs(entering)
    for link, pair in enumerate(pairs, 2):
        passed = np.where(torque > 0, pair.efficiency, 1 / pair.efficiency)
        torque = torque * pair.ratio * passed - drag[link] * np.abs(entering)
    assert torque * ratio == pytest.approx(np.array(made["wheel force [N]"]), rel=1e-9)
    with pytest.raises(CaseError, match="drag without unit takes all of the input torque"):
        cycled(case.replace(drag={1: 1.01}), trace(*rows))


def test_standing_takes_fuel_at_the_edge_and_no_torque() -> None:
    rates = np.array([[0.1, 1.0], [2.0, 9.0]])
    grid = FuelMap(np.array([80.0, 600.0]), np.array([0.0, 200.0]), rates)
    made = drive(CASE, timed("0,0,1\n60,0,1"), GearChoice(), grid)
    assert made.fuel == pytest.approx(6.0)
    assert made.energy.engine == made.energy.wheels == made.distance == 0


def test_elements_that_carry_too_much_are_reported_with_their_steps() -> None:
    """Clutch 1 bears what the engine gives, here nothing turns but the car."""
    steps = timed("0,10,1\n2,12,1\n4,18,1\n6,18,2\n8,18,2")
    bare = CASE.replace(inertias={}, load=Load(None, 10.0))
    made = cycled(bare, steps)
    torques = made.steps["engine torque [N*m]"]
    for part, told in ((0.99, True), (1.01, False)):
        first = bare.shift_elements[0]._replace(capacity=torques[1] * part / 10)
        case = bare.replace(shift_elements=[first, bare.shift_elements[1]])
        said = [(one.id, one.text) for one in cycled(case, steps).messages]
        text = f"in 1 of 4 steps {first.name} carries up to {torques[1]:.5g} N*m, more "
        text += f"than its torque capacity of {torques[1] * part:.5g} N*m, most from 2 s on, gear 1"
        assert said == [("W430", text)] * told


def test_from_rest_to_rest_inertias_take_what_goes_at_shifts() -> None:
    """Of the input and what turns with the open gear, by its ratio: J (w^2 - w'^2)/2 at each."""
    made = cycled(CASE, "0,0,1\n3,8,2\n7,14,2\n9,5,1\n12,0,1")
    wheel = 4.1 / 0.3
    change = 0.15 * ((3.5 * wheel) ** 2 - (1.5 * wheel) ** 2) / 2  # link 3 turns as ever
    assert made.energy.inertias == pytest.approx(change * (8**2 - 5**2), rel=1e-12)


def test_a_gear_that_drives_nothing_is_reported_at_its_row() -> None:
    case = CASE.replace(gears=[Gear([1], name="1"), Gear([1, 2], name="tied"), Gear(name="none")])
    for name in ("tied", "none"):
        with pytest.raises(CaseError, match=f"gear {name} has no ratio") as caught:
            cycled(case, f"0,0,{name}\n1,3,{name}\n2,5,1\n3,5,{name}")
        assert caught.value.problems[0].path == (0,)


def test_a_link_that_turns_freely_has_no_inertia_torque() -> None:
    """Links 3 and 4 hang on a set whose third member drives nothing."""
    parts = [Mechanism(1, 2, 0, 2.0), Mechanism(2, 3, 4, -2.0)]
    car = Vehicle(1000, 0.3, engine=[(80, 200), (600, 200)])
    plain = Transmission(4, [], parts, [Gear(name="1")], output=2, vehicle=car)
    heavy = plain.replace(inertias={4: 0.1})
    heavier, lighter = (cycled(case, "0,11\n10,17").energy for case in (heavy, plain))
    assert heavier == lighter
    assert performance(heavy) == performance(plain)


SET = Transmission(
    3,
    [ShiftElement(2, 0, "B")],
    [Mechanism(1, 2, 3, -2.5, 0.96, name="set")],
    [Gear([1], name="low")],
    vehicle=CAR._replace(engine=[(0.0, 150.0), (600.0, 150.0)]),
    inertias={1: 0.15, 2: 0.1, 3: 0.3},
    load=Load(2000.0, 100.0),
)


def test_a_link_that_is_held_at_0_rpm_is_braked() -> None:
    rows = "0,0,low\n3,9,low\n8,14,low\n12,2,low"
    held = SET.replace(gears=[Gear(speeds={2: 0.0}, name="low")])
    braked, made = (cycled(one, rows).energy for one in (SET, held))
    for one, other in zip(braked[:4], made[:4], strict=True):
        assert one == pytest.approx(other, rel=1e-12)
    assert made.lost == pytest.approx(braked.lost)
    assert performance(held) == performance(SET)


@pytest.mark.parametrize(
    ("gear", "why"),
    [
        (Gear([1], torques={2: 0.2}), "a given torque on 2"),
        (Gear(speeds={2: 1.5}), "a given speed of 2"),
        (Gear(speeds={2: SpeedOf(3, 0.5)}), "a given speed of 2"),
        (Gear(speeds={}, balance=BatteryBalance([(1, 0.9), (2, 0.9)], -1.0)), "a balance"),
    ],
)
def test_where_machines_drive_too_nothing_of_the_vehicle_is_reported(gear: Gear, why: str) -> None:
    """Their power is none of the engine's: energies would not close."""
    alone = performance(SET)
    case = SET.replace(gears=[SET.gears[0], gear._replace(name="split")])
    assert [(doubt.id, why in doubt.message) for doubt in doubts(case)] == [("W890", True)]
    told = performance(case)
    assert told._replace(gears=alone.gears) == alone
    assert told.gears["low"] == alone.gears["low"]
    assert all(map(math.isnan, told.gears["split"]))
    rows = timed("0,3,low\n4,9,split\n8,30,")
    with pytest.raises(CaseError, match=f"gear split has {why}, expected a gear in w") as caught:
        cycled(case, rows)
    assert caught.value.problems[0].path == (1,)
    unnamed = rows._replace(gears=[])
    assert drive(case, unnamed, GearChoice(least_speed=1.0)).gears == ["low", "low"]


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize(
    ("names", "forward", "ids"),
    [(["R1", "F2", "2R", "F1"], "F2", []), (["a", "b", "c", "d"], "c", ["N417"])],
)
def test_as_many_gears_both_ways_are_distinguished_by_their_names(
    names: list[str], forward: str, ids: list[str], turned: int
) -> None:
    """Whichever way the wheels turn and whatever stands first, as in the design table."""
    ratios = [turned * ratio for ratio in (-4.0, 2.0, -2.0, 4.0)]
    case = parallel(dict(zip(names, ratios, strict=True)))
    steady = timed("0,5\n1,5")
    made = drive(case, steady, GearChoice(least_speed=1.0))
    assert made.gears[0] in design(solve(case)).forward
    assert (made.gears, [one.id for one in made.messages]) == ([forward], ids)


def test_gears_by_shift_speeds_and_by_the_least_speed() -> None:
    text = timed("0,0\n2,4\n4,8\n6,8\n8,4\n10,3\n12,0\n14,0")
    shifts = read_shifts("1-2: 6 m/s/3.6 m/s")
    first, ahead = CASE.mechanisms[0], CASE.mechanisms[1]._replace(ratio=1.5)
    case = CASE.replace(mechanisms=[first, ahead])
    least = 5 * 1.5 * 4.1 / 0.3  # of the engine in the second gear at 5 m/s
    for choice in (GearChoice(shifts=shifts), GearChoice(least)):
        assert drive(case, text, choice).gears == ["1", "2", "2", "2", "1", "1", "1"]
    assert drive(case, text, GearChoice(least_loss=True)).gears[-1] == "1"  # at rest
    with pytest.raises(CaseError, match="no column `gear`"):
        cycled(CASE, text)
    named = timed("0,4,1\n2,8,1")
    twice = [(GearChoice(least, shifts), text), (GearChoice(least, shifts, True), text)]
    twice += [(GearChoice(least), named), (GearChoice(shifts=shifts), named)]
    for choice, given in twice:
        with pytest.raises(CaseError, match=r"and --\S+ give the gears, expected one of them"):
            drive(case, given, choice)
    turned = read_shifts("2-1: 6 m/s/3.6 m/s")
    with pytest.raises(CaseError, match=r"larger ratio \(`2` 1.5 and `1` 3.5\), .* first: 1-2"):
        drive(case, text, GearChoice(shifts=turned))
    pairs = [first._replace(ratio=0.1 + 0.2), ahead._replace(ratio=0.3)]  # the same ratio
    assert drive(case.replace(mechanisms=pairs), text, GearChoice(shifts=turned)).gears[0] == "2"


@pytest.mark.parametrize("sign", [1, -1])
def test_a_gear_in_which_the_engine_would_overspeed_is_not_taken_downward(sign: int) -> None:
    """Ratios 4, 2, 1 and 20 rad/s at most: at 8.5 m/s the second gear has 17, the first 34.

    So it is with a final drive that turns them all.
    """
    speeds, ratios = np.array([13.0, 8.5, 5.5, 3.0]), np.array([4.0, 2.0, 1.0])
    engine = EngineSpeeds(speeds, ratios, np.zeros(3), lambda w: w <= 20)
    shifts = read_shifts("1-2: 7 m/s/6 m/s, 2-3: 12 m/s/9 m/s")
    case = parallel({"1": 4.0, "2": 2.0, "3": 1.0})
    places = by_shift_speeds(case, shifts, speeds, engine, sign * ratios)
    assert places.tolist() == [2, 1, 1, 0]


@pytest.mark.parametrize("shift", ["R-1", "1-R", "N-1", "1-N", "1-1", "1-split", "2-R"])
def test_a_cycle_shifts_between_gears_of_one_direction(shift: str) -> None:
    case = parallel({"2": 1.5, "R": -3.0, "1": 3.5, "split": 2.5, "3": 1.0})
    gears = [*case.gears, Gear(name="N")]
    gears[3] = gears[3]._replace(torques={2: 0.2})
    case = case.replace(gears=gears)
    text = timed("0,5\n2,6")
    with pytest.raises(CaseError, match=f"the shift {shift} .* neighbours: 1-2, 2-3"):
        drive(case, text, GearChoice(shifts=read_shifts(f"{shift}: 5 m/s/4 m/s")))
    skipping = GearChoice(shifts=read_shifts("1-3: 5 m/s/4 m/s"))
    assert drive(case, text, skipping).gears == ["3"]


def test_coasting_in_neutral_is_refused_as_such() -> None:
    """Neutral is allowed at standstill, as in published cycles."""
    with pytest.raises(CaseError, match=r"no gear `N`, expected one of 1, 2: .* in neutral"):
        cycled(CASE, "0,5.0,N\n2,6.0,1")
    case = CASE.replace(gears=[*CASE.gears, Gear(name="idle")])
    waiting, driven = (cycled(case, f"{rows}1,0,1\n2,6,1").energy for rows in ("0,0,idle\n", ""))
    assert waiting == driven


@each_seed(5)
def test_no_gear_is_taken_beyond_the_engine_where_another_one_holds(seed: int) -> None:
    """By both rules, over a random engine and steady speeds; counted by hand where none holds."""
    rng = seeded(3410 + seed)
    first, last = rng.uniform(50, 150), rng.uniform(300, 600)
    sets = [CASE.mechanisms[0], CASE.mechanisms[1]._replace(ratio=rng.uniform(0.5, 3.0))]
    car = CAR._replace(engine=[(first, 1e5), (last, 1e5)])
    case = CASE.replace(mechanisms=sets, vehicle=car, inertias={})
    speeds = np.array([rng.uniform(1, 70) for _ in range(40)])
    given = trace(*((float(n), 1.0, "") for n in range(41)))
    given = given._replace(gears=[], speed=speeds, acceleration=np.zeros(40))
    least = rng.uniform(first, last)
    shift = read_shifts(f"1-2: {rng.uniform(5, 60)} m/s/{rng.uniform(1, 5)} m/s")
    for choice in (GearChoice(least), GearChoice(shifts=shift)):
        made = drive(case, given, choice)
        turned = speeds[:, None] * 4.1 / 0.3 * [m.ratio for m in sets]
        own = turned[np.arange(40), [int(name) - 1 for name in made.gears]]
        holds = (turned <= last).any(axis=1)
        assert (own[holds] <= last).all()
        np.testing.assert_allclose(own[~holds], turned[~holds].min(axis=1))
        fast = int((~holds).sum())
        assert made.beyond == fast  # full load is far away, but beyond the last point there is none
        said = {one.id: one.text for one in made.messages}
        assert ("W428" in said) == (fast > 0)
        begin, end = f"in {fast} of 40", f"last point, {last * 30 / math.pi:.6g} rpm"
        assert said.get("W428", begin).startswith(begin)
        assert said.get("W428", end).endswith(end)


@pytest.fixture
def files(folder: Path) -> Path:
    (folder / "car.yaml").write_text(CAR_FILE)
    (folder / "t.csv").write_text(TRACE_FILE)
    rows = "0,0,500\n0,900,500\n400,0,500\n400,900,500\n"
    (folder / "fuel.csv").write_text(f"speed [rad/s],torque [N*m],fuel [g/h]\n{rows}")
    return folder


def test_what_the_engine_cannot_is_a_warning_by_which_strict_fails(files: Path) -> None:
    car = CAR_FILE.replace("fuel: {file: fuel.csv}", "engine: [[0, 90], [300, 90]]")
    (files / "car.yaml").write_text(car)
    (files / "t.csv").write_text("time [s],speed [m/s]\n0,60\n1,60\n2,80\n3,80\n")
    asked = ["cycle", "car.yaml", "t.csv", "-f", "json", "--least-speed", "1000 rpm"]
    ran = vstatics(*asked)
    messages = ran.json["cycle"]["messages"]
    assert ran.status == 0
    assert [one[-6:] for one in messages] == ["[W428]", "[W429]"]
    # the second gear turns 4 v: 240, 280, 320 rad/s, and 1000 kg 20 m/s^2 are beyond any engine
    starts = [message.partition("in 1 of 3 steps, the first at ")[2][:3] for message in messages]
    assert starts == ["2 s", "1 s"]
    assert f"{320 * 30 / math.pi:.6g} rpm" in messages[0]
    assert f"car.yaml: {messages[0][:-7]}" in ran.err  # `tests.commands` drops ids
    assert vstatics(*asked, "--strict").status == 1
    ran = vstatics(*asked, "--strict", "--allow", "W428", "--allow", "W429")
    assert (ran.status, ran.json["cycle"]["messages"]) == (0, [])
    ran = vstatics(*asked[:-1], "1000")
    assert ran.is_wrong_use("read '1000', expected a speed with its unit")
    assert vstatics(*asked[:-2], "--shift", "1-2: 9/6").is_wrong_use("each speed with its unit")


def test_fuel_is_bilinear() -> None:
    """A + b w + c T + d w T is met exactly inside a cell; 9549.3 is 3e4/pi."""
    speeds, torques = np.array([100.0, 300.0, 500.0]), np.array([0.0, 100.0])

    def fuel(w: Any, t: Any) -> Any:
        return 0.2 + 0.001 * w + 0.002 * t + 1e-5 * w * t

    rows = [f"{w},{t},{3600 * fuel(w, t)}" for w in speeds for t in torques]
    text = "\n".join(["speed [rad/s],torque [N*m],fuel [g/h]", *rows])
    read = read_fuel_map(text.encode(), "fuel.csv")
    of_vecto = text.replace("speed", "engine speed").replace("fuel", "fuel consumption")
    in_units = text.replace("torque [N*m],fuel [g/h]", "Nm,g/h")  # GoldenCheetah/issues/1288
    for other in (of_vecto, in_units):
        assert read_fuel_map(other.encode(), "f.csv").fuel.tolist() == read.fuel.tolist()
    w, t = np.array([120.0, 420.0]), np.array([33.0, 71.0])
    np.testing.assert_allclose(read.at(w, t), fuel(w, t), rtol=1e-12)
    np.testing.assert_allclose(read.at(np.array([50.0]), np.array([-9.0])), fuel(100.0, 0.0))
    with pytest.raises(ReadError, match="for each pair; there is no row for 500 rad/s and 100"):
        read_fuel_map(text.encode().rsplit(b"\n", 1)[0], "fuel.csv")
    with pytest.raises(ReadError, match=r"`g/s`; g/kWh times speed \[rpm\] \* torque .*/9549.3"):
        read_fuel_map(b"speed [rpm],torque [N*m],fuel [g/kWh]\n3000,100,250\n", "f.csv")


TORQUE = "speed [rpm],torque [N*m],fuel"


def test_faults_of_files_are_reported_with_their_place(files: Path) -> None:
    for file, text, said in (
        ("t.csv", "time [s],speed [km/h]\n", "no row below the headings"),
        ("t.csv", "time [s],speed [km/h]\n0,1\n", "expected at least two"),
        # rows within a second: github.com/uholeschak/ediabaslib/issues/15
        ("t.csv", "time [s],speed [km/h]\n0,1\n0,2\n", ":3:1: error: time: read 0 s after 0 s, e"),
        ("t.csv", "time [s],speed [kg]\n0,1\n1,2\n", "speed: read the unit 'kg'"),
        ("t.csv", "time [s],speed [km/h]\n0,1\n1,-9\n", ":3:1: error: speed: read -9 km/h, exp"),
        ("t.csv", "time [s],speed [m/s],slope [%]\n0,1,5\n1,2,5\n", "as it is the sine of"),
        ("t.csv", "time [s],speed [m/s],gear\n0,1,low\n1,2,9\n2,2,9\n", ":3:1: error: there is n"),
        ("t.csv", "A title\ntime [s],speed [mph]\n0,0\n5,10\n", "t.csv:2:1: error: the trace has"),
        ("t.csv", "Zeit,Weg\nBench 3,4711\n0,0\n5,9\n", ":1:1: error: read the heading 'Zeit'"),
        ("t.csv", "t,v,g\ns,mph,\n0,0,1\n5,9,1\n", ":1:1: error: the trace has no column `gear`"),
        ("t.csv", "t,v,g\ns,mph,\n0,0,1\n5,9,1\n", "`gear`, `selected gear`, `gear number` or"),
        ("fuel.csv", f"{TORQUE} [kg]\n0,0,1\n", "fuel.csv:1:26: error: fuel: read the unit 'kg'"),
        ("fuel.csv", f"{TORQUE} [g/h]\n0,0,-1\n", ":2:1: error: fuel: read -1 g/h, expected 0 or"),
        ("car.yaml", CAR_FILE.partition("vehicle")[0], "the case has no `vehicle`"),
    ):
        right = (files / file).read_text()
        (files / file).write_text(text)
        assert vstatics("cycle", "car.yaml", "t.csv").gives_nothing(said)
        assert vstatics("check", "car.yaml").fails(said) == (file == "fuel.csv")
        (files / file).write_text(right)
    for command in ("cycle", "damage"):
        ran = vstatics(command, "t.csv", "car.yaml")
        assert ran.is_wrong_use("expected the case first, then the CSV file: car.yaml t.csv")


def test_steps_over_time_are_written_as_a_sweep_that_is_drawn(files: Path) -> None:
    """F = m a at the wheels, M = F r/(i n) at the engine, w = v i/r, no fuel below 0 N*m."""
    command = ("cycle", "car.yaml", "t.csv", "--time-steps")
    assert vstatics(*command, "steps.csv").status == 0
    table = sweep_tables.read((files / "steps.csv").read_bytes(), "steps.csv")
    assert table.varied == ("time [s]",)
    turning = zip([5, 11, 12, 6], [4, 4, 2, 4], strict=True)
    expected = {
        "time [s]": [3, 4.5, 7, 9.5],
        "speed [km/h]": [3.6 * v for v in (5, 11, 12, 6)],
        "gear number": [1, 1, 2, 1],
        "engine speed [rpm]": [v / 0.5 * i * 30 / math.pi for v, i in turning],
        "engine torque [N*m]": [5000 * 0.5 / 4 / 0.8, 2000 * 0.5 / 4 / 0.8, 0, 0],
        "wheel force [N]": [5000, 2000, 0, -12000],
        "fuel [g/h]": [500] * 4,
    }
    assert table.columns == {name: pytest.approx(column) for name, column in expected.items()}
    assert vstatics("plot", "steps.csv", "-k", "curves", "-o", "cycle.svg").status == 0
    assert "engine torque" in (files / "cycle.svg").read_text()
    assert vstatics(*command, "t.csv").status == 2
    assert (files / "t.csv").read_text() == TRACE_FILE
    for output, more in (("-", ()), ("both.csv", ("-o", "both.csv"))):
        assert vstatics(*command, output, *more).is_wrong_use("--time-steps and the report both go")
    assert vstatics(*command, "cycle.png").is_wrong_use("csv is not the format of cycle.png")
    piped = vstatics(*command, "-", "-o", "report.txt")
    assert (piped.status, piped.out) == (0, (files / "steps.csv").read_text())


SLIPPING = CAR_FILE.replace(", fuel: {file: fuel.csv}", "").replace("[A]", "{slip: {A: 0.4}}")


def test_a_slipping_clutch_takes_its_part_of_the_engine() -> None:
    """1000 kg from 5 to 7 m/s take 12000 J: 15000 J before the pair of 0.8, 25000 J of the engine."""
    energy = cycled(loads(SLIPPING), "0,5,low\n4,7,low").energy
    assert [energy.wheels, energy.engine] == pytest.approx([12000, 25000])
    assert energy.lost == pytest.approx({"first": 3000, "second": 0, "slip.A": 10000})


def in_rpm(slip: str, more: str = "") -> Transmission:
    return loads(f"{SLIPPING.replace('0.4', slip)}load: {{speed: 1000 rpm}}\n{more}")


def test_slip_in_rpm_adds_to_the_speed_of_the_engine() -> None:
    """The pair takes 78.125 N*m at 48 rad/s for 500 N; and 0.1 kg*m^2 from 60 to 76 rad/s."""
    case = in_rpm("20 rad/s", "inertias: {engine: 0.1}\n")
    energy = cycled(case, "0,5,low\n4,7,low").energy
    inertia = 0.1 * (76**2 - 60**2) / 2
    assert [energy.inertias, energy.engine] == pytest.approx([inertia, 78.125 * 68 * 4 + inertia])
    assert energy.lost == pytest.approx({"first": 3000, "second": 0, "slip.A": 78.125 * 20 * 4})
    text = SLIPPING.replace("links: [engine", "links: [engine, c").replace(
        "A: 0.4", "A: 20 rad/s, C: 0.2"
    )
    text = text.replace("A: [engine, a]", "C: [engine, c], A: [c, a]")
    case = loads(f"{text}load: {{speed: 1000 rpm}}\n")  # 0.8 w - 20 = 48
    energy = cycled(case, "0,5,low\n4,7,low").energy
    assert [energy.lost["slip.C"], energy.engine] == pytest.approx([78.125 * 68, 78.125 * 340])


def test_of_equal_ratios_the_gear_without_slip_is_the_higher() -> None:
    case = in_rpm("200 rpm")
    case = case.replace(gears=[*case.gears, Gear([1], name="firm")])
    rows = timed("0,5\n4,7")
    assert [*drive(case, rows, GearChoice(0.0, [])).gears] == ["high"]
    case = case.replace(gears=[case.gears[0], case.gears[2]])
    assert [*drive(case, rows, GearChoice(0.0, [])).gears] == ["firm"]


def test_a_slip_of_the_wrong_sign_gives_no_cycle() -> None:
    """At 10.5 m/s the pair turns at 84 rad/s, less 900 rpm: -97.859 rpm."""
    with pytest.raises(CaseError, match=r"engine would turn at -97\.8591 rpm, expected a gear"):
        cycled(in_rpm("-900 rpm"), "0,10,low\n4,11,low")
    for inertias in ("", "inertias: {engine: 0.1}\n"):
        case = loads(SLIPPING.replace("0.4", "-0.4") + inertias)
        with pytest.raises(CaseError, match=r"gear low has no torques .* only a slip above 0 is p"):
            cycled(case, "0,5,low\n4,7,low")


@pytest.mark.parametrize("more", [False, True])
@pytest.mark.parametrize("added", [20, 0])
def test_a_clutch_that_slips_or_overruns_leaves_braking_to_the_brakes(
    added: int, more: bool
) -> None:
    """Energies are added link by link. A clutch that the shaft would drive carries no torque.

    Without slip, the clutch is a freewheel.
    """
    drags, inertias = ((2, 3), (0.1, 0.05)) if more else ((0, 0), (0, 0))
    text = f"drag: {{engine: {drags[0]} N*m, a: {drags[1]} N*m}}\n"
    text += f"inertias: {{engine: {inertias[0]}, a: {inertias[1]}}}\n"
    case = in_rpm("20 rad/s", text.replace("N*m", "N*m" if more else ""))
    if not added:
        freewheel = ShiftElement(2, 1, "A", kind="freewheel")
        elements = [freewheel, *case.shift_elements[1:]]
        case = case.replace(shift_elements=elements, gears=[case.gears[0]._replace(slip={})])
    driven = cycled(case, "0,7,low\n4,5,low\n6,9,low\n9,0.3,low")
    engine = brakes = slip = 0.0
    for v, a, time in ((6, -0.5, 4), (7, 2, 2), (4.65, -2.9, 3)):
        shaft, change = v / 0.5 * 4, a / 0.5 * 4
        asked = 1000 * a * 0.5 / 4
        clutch = asked / 0.8 ** (1 if a > 0 else -1) + inertias[1] * change + drags[1]
        is_open = clutch < 0
        torque = max((0 if is_open else clutch) + drags[0] + inertias[0] * change, 0)
        clutch = torque - drags[0] - inertias[0] * change
        pair = clutch - drags[1] - inertias[1] * change
        force = pair * 0.8 ** (1 if pair > 0 else -1) * 4 / 0.5
        engine += torque * (shaft + added) * time
        brakes += (force - 1000 * a) * v * time
        slip += clutch * added * time
    energy = driven.energy
    assert [energy.engine, energy.lost.get("slip.A", 0)] == pytest.approx([engine, slip])
    assert energy.brakes == pytest.approx(brakes)
    assert energy.engine == pytest.approx(spent(energy), rel=1e-9)
    faster = cycled(case, "0,5,low\n4,9,low")
    assert faster.energy.brakes == pytest.approx(0, abs=1e-6)


@each_seed(2, 40)
def test_brakes_relieve_a_slipping_clutch_before_pairs_with_jagged_maps(seed: int) -> None:
    """Behind the open clutch, drag and inertia of `b` and `c` alone load the pairs.

    From there, the force at the wheels follows without a search.
    """
    rng = seeded(seed)
    maps = [[[at, rng.uniform(0.85, 0.99)] for at in (0, 8, 20, 40, 60)] for _ in "bc"]
    pairs = "".join(
        f"  {name}: {{first: {name}, second: {second}, ratio: 2, "
        f"efficiency: {{over: torque, points: {points}}}}}\n"
        for name, second, points in zip("bc", ("c", "out"), maps, strict=True)
    )
    drag, inertia = rng.uniform(0, 3), rng.uniform(0, 0.5)
    case = loads(
        "links: [engine, b, c, out]\nload: {speed: 1500 rpm, torque: 100 N*m}\n"
        "shift_elements: {C: [engine, b]}\ngears: {low: {slip: {C: 20 rad/s}}}\n"
        f"mechanisms:\n{pairs}drag: {{b: {drag} N*m}}\ninertias: {{b: {inertia}, c: {inertia}}}\n"
        "vehicle: {mass: 1000, radius: 0.5, overrun: [[0, -1000], [100, -1000]]}\n"
    )
    speeds = [(0, 30.0), (0.2, 24.0), (3, 20.5), (5, 15.0), (6, 10.0)]
    brakes, lost = 0.0, {"b": 0.0, "c": 0.0}
    for (start, fast), (end, slow) in pairwise(speeds):
        time, speed, change = end - start, (fast + slow) / 2, (slow - fast) / (end - start)
        torque = -drag
        for name, points, ratio in zip("bc", maps, (8, 4), strict=True):
            torque -= inertia * change * ratio
            places, values = np.transpose(points)
            eta = np.interp(abs(torque), places, values) ** np.sign(torque)
            lost[name] += torque * (1 - eta) * ratio * speed * time
            torque *= 2 * eta
        brakes += (torque / 0.5 - 1000 * change) * speed * time
    energy = cycled(case, trace(*((*row, "low") for row in speeds))).energy
    assert [energy.brakes, energy.lost["slip.C"]] == pytest.approx([brakes, 0], rel=1e-8, abs=1e-3)
    assert {name: energy.lost[name] for name in lost} == pytest.approx(lost, rel=1e-6)


def test_slip_in_a_gear_without_a_ratio_hinders_no_cycle() -> None:
    idle = Gear(slip={1: 0.2}, name="N")
    cases = (CASE.replace(gears=[*CASE.gears, *more]) for more in ((), [idle]))
    cycles = [cycled(case, "0,10,1\n9,20,1") for case in cases]
    assert cycles[0].energy.engine == cycles[1].energy.engine
