"""Duty cycles by points: energies against closed forms and against the results of each point."""

import math
from pathlib import Path

import numpy as np
import pytest

from tests.chance import each_seed, seeded, seeds_with_slow
from tests.commands import vstatics
from tests.trains import random_train
from vstatics import (
    CaseError,
    Gear,
    Load,
    Mechanism,
    ReadError,
    ShiftElement,
    Spring,
    Transmission,
    loads,
    solve,
)
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.duty_file import read_duty_table
from vstatics.vehicle.operation.load_spectrum import spectrum
from vstatics.vehicle.operation.point_loads import DutyPoints

PAIRS = Transmission(
    3,
    [],
    [Mechanism(1, 2, 0, 2.0, 0.9, name="a"), Mechanism(2, 3, 0, -3.0, 0.8, name="b")],
    [Gear(name="1")],
    link_names=["in", "mid", "out"],
)


def points(*rows: tuple[float, float, float], are_shares: bool = False) -> DutyPoints:
    """Of speed, torque and weight in gear 1."""
    speeds, torques, weights = map(np.array, zip(*rows, strict=True))
    return DutyPoints(np.zeros(len(rows), int), speeds, torques, weights, are_shares)


def test_a_point_without_torques_says_why() -> None:
    """A set on a freewheel that holds when it drives and overruns when it coasts."""
    freewheel = ShiftElement(2, 0, "F", kind="freewheel")
    case = Transmission(3, [freewheel], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear(name="1")])
    assert spectrum(case, points((100.0, 20.0, 10.0))).energy.in_ == pytest.approx(20_000)
    with pytest.raises(CaseError, match=r"has no torques .*: .*freewheel F overruns") as caught:
        spectrum(case, points((100.0, 20.0, 10.0), (100.0, -20.0, 10.0)))
    assert [one.path for one in caught.value.problems] == [(1,)]


def test_equivalent_torque_and_turns() -> None:
    """T^3 by turns: 20 N*m over 1000 rad, 10 N*m over 500 rad, at the first link."""
    made = spectrum(PAIRS, points((100.0, 20.0, 10.0), (50.0, 10.0, 10.0)))
    one = made.members["a.first"]
    assert one.torque == (20.0, 1)
    found = [one.speed.largest, one.revolutions, one.equivalent_torque]
    mean = ((20**3 * 1000 + 10**3 * 500) / 1500) ** (1 / 3)
    assert found == pytest.approx([100 * 30 / math.pi, 1500 / (2 * math.pi), mean])
    mid = made.members["mid"]
    found = [mid.torque.largest, mid.revolutions]
    assert found == pytest.approx([20 * 2 * 0.9, 750 / (2 * math.pi)])


def test_a_clutch_that_slips_only_without_torque_has_no_equivalent_torque() -> None:
    """C slips in low, where it is disengaged, and carries torque in direct, where it sticks."""
    elements = [ShiftElement(2, 0, "B"), ShiftElement(1, 3, "C")]
    gears = [Gear([1], name="low"), Gear([2], name="direct")]
    case = Transmission(3, elements, [Mechanism(1, 2, 3, -2)], gears)
    both = points((100.0, 20.0, 10.0), (100.0, 20.0, 50.0))._replace(gears=np.array([0, 1]))
    clutch = spectrum(case, both).members["C"]
    assert clutch.torque.largest == pytest.approx(20)
    assert clutch.torque.row == 2
    assert clutch.revolutions == pytest.approx(100 * (1 - 1 / 3) * 10 / (2 * math.pi))
    assert math.isnan(clutch.equivalent_torque)
    dragging = [elements[0], elements[1]._replace(drag=0.1)]  # of 20 N*m, at the slip of low
    energy = spectrum(case.replace(shift_elements=dragging), both).energy
    assert energy.lost["drag.C"] == pytest.approx(0.1 * 20 * 100 * (1 - 1 / 3) * 10)


@seeds_with_slow(8, 25)
def test_random_trains_lose_what_enters_and_does_not_leave(seed: int) -> None:
    """Each point is that of the case with this load; energies are sums over points."""
    rng = seeded(2750 + seed)
    case = random_train(rng).replace(coast=None)
    results = solve(case.replace(load=Load(1000.0, 50.0)))
    ok = results.consistent & np.isfinite(results.losses).all(axis=1)
    whole = np.flatnonzero(ok & np.isfinite(results.lossy_output_torque_Nm)).tolist()
    if not whole or case.freewheels:
        return
    gears = np.array([rng.choice(whole) for _ in range(4)])
    speeds, torques, times = (
        np.array([rng.uniform(low, high) for _ in gears])
        for low, high in ((50, 300), (5, 90), (1, 9))
    )
    try:
        made = spectrum(case, DutyPoints(gears, speeds, torques, times))
    except CaseError:
        return
    entering = leaving = 0.0
    for gear, speed, torque, time in zip(gears, speeds, torques, times, strict=True):
        one = solve(case.replace(load=Load(speed * 30 / math.pi, torque)))
        entering += 1e3 * one.input_power_kW[gear] * time
        leaving += 1e3 * one.output_power_kW[gear] * time
    assert made.energy.in_ == pytest.approx(entering, rel=1e-9)
    assert made.energy.out == pytest.approx(leaving, rel=1e-9)
    lost = math.fsum(made.energy.lost.values())
    assert lost == pytest.approx(entering - leaving, rel=1e-8, abs=1e-6 * entering)


@pytest.mark.parametrize("load", [400.0, 150.0])
def test_elements_above_their_capacities_are_reported_at_their_rows(load: float) -> None:
    """A held ring bears 2.5 times the sun, as in `run` that without losses, which is larger.

    Its capacity is in N*m, told by any load.
    """
    clutch = ShiftElement(1, 2, "C", capacity=9999 / load)
    brake = ShiftElement(2, 0, "B", capacity=600 / load)
    gears, sets = [Gear([2], name="low"), Gear([1], name="high")], [Mechanism(1, 2, 3, -2.5, 0.96)]
    case = Transmission(3, [clutch, brake], sets, gears, load=Load(None, load))
    rows = points(*((200.0, torque, 1.0) for torque in (239.0, -241.0, 300.0, 900.0)))
    rows = rows._replace(gears=np.array([0, 0, 0, 1]))
    [one] = spectrum(case, rows).messages
    told = "more than its torque capacity of 600 N*m"
    text = f"in 2 of 4 rows B carries up to {2.5 * 300:.5g} N*m, {told}, most in row 3, gear low"
    assert (one.id, one.text) == ("W430", text)
    own = [gears[0]._replace(load=Load(1910.0, 300.0)), gears[1]]
    [alone] = solve(case.replace(gears=own)).messages
    assert (alone.id, alone.text) == ("W430", f"B carries 750 N*m, {told}")
    assert not spectrum(case.replace(allow=("W430",)), rows).messages
    assert not spectrum(case.replace(load=None), rows).messages  # relative to any input torque


def test_faults_of_a_table_are_reported_with_their_place(folder: Path) -> None:
    for text, said in (
        ("time,gear,speed,torque [N*m]\n1,1,2,3\n", ":1:11: error: speed: its unit is missing"),
        ("time,gear,speed [kg],torque [N*m]\n1,1,2,3\n", "speed: read the unit 'kg'"),
        ("time,gear,speed [rpm],torque [N*m]\n1,1,nan,3\n", ":2:1: error: speed: read 'nan'"),
        ("time,gear,speed [rpm],torque [N*m]\n", "no row below the headings"),
        ("gear,speed [rpm],torque [N*m]\n1,2,3\n", "expected exactly one of"),
        ("time,share,gear,speed [rpm],torque [N*m]\n1,1,1,2,3\n", "expected exactly one of"),
        ("time,gear,sped [rpm],torque [N*m]\n1,1,2,3\n", "did you mean `speed`?"),
        ("time,gear,speed [rpm],torque [N*m]\n1,9,2,3\n", ":2:1: error: there is no gear `9`"),
        ("time,gear,speed [rpm],torque [N*m]\n1,1,2\n", ":2:1: error: read 3 cells"),
        ("time,gear,speed [rpm],torque [N*m]\n1,1,0,2\n", "read 0 everywhere, expected a speed"),
        ("time,gear,speed [rpm],torque [N*m]\n-1,1,1,2\n", "time: read -1"),
        ("time,gear,speed [rpm],torque [N*m]\n0,1,1,2\n", "all numbers of `time` are 0, expected"),
    ):
        case = 'links: 2\nmechanisms: {a: {first: 1, second: 2, ratio: 2}}\ngears: {"1": []}\n'
        (folder / "case.yaml").write_text(case)
        (folder / "duty.csv").write_text(text)
        assert vstatics("summary", "case.yaml", "--duty", "duty.csv").gives_nothing(said)


def test_a_load_spectrum_in_percent_of_a_single_gear(folder: Path) -> None:
    """ISO 281: 18 000, 15 000 and 0 turns an hour at 2, 1 and 4 kN, C = 20 kN, p = 3."""
    case = (
        "links: [in, out]\nmechanisms: {a: {first: in, second: out, ratio: 2}}\n"
        "bearings: {b: {on: in, torque_of: in, load_per_torque: 20 N/(N*m), dynamic: 20 kN, "
        "exponent: 3}}\n"
    )
    (folder / "case.yaml").write_text(case + 'gears: {"1": []}\n')
    points = "share [%],n [rpm],M [N*m]\n30,1000,100\n50,500,-50\n20,0,200\n"
    (folder / "duty.csv").write_text(points)
    said = vstatics("summary", "case.yaml", "--duty", "duty.csv", "-f", "json")
    damage = 18e3 / 1e6 / 10**3 + 15e3 / 1e6 / 20**3
    assert said.json["duty"]["bearings"]["b"]["hours"] == pytest.approx(1 / damage)
    (folder / "case.yaml").write_text(case + 'gears: {"1": [], "2": []}\n')
    missing = ":1:1: error: `gear` is missing, expected the gear of each point, as the case has 2"
    assert vstatics("summary", "case.yaml", "--duty", "duty.csv").gives_nothing(missing)
    # pandas writes whole numbers beside an empty cell as 1.0
    rows = "time,gear,n [rpm],M [N*m]\n0:18:0,1.0,1000,100\n0:30:0,1.0,500,50\n720,,0,0\n"
    shaft = rows.replace("n [", "Shaft speed [").replace("M [", "shaft_torque [")
    for text in (rows, rows.replace("time", "t [s]"), rows.replace("n [", "omega ["), shaft):
        (folder / "duty.csv").write_text(text)
        said = vstatics("summary", "case.yaml", "--duty", "duty.csv", "-f", "json")
        assert said.json["duty"]["bearings"]["b"]["hours"] == pytest.approx(1 / damage)


BEYOND = """
links: [engine, a, out]
shift_elements: {A: [engine, a], B: [a, out]}
load: {speed: 1000 rpm, torque: 50 N*m}
drag: {a: [[0, 1], [100, 3]]}
mechanisms: {pair: {first: engine, second: out, ratio: 4}}
gears: {fast: [A], slow: [B]}
vehicle: {mass: 1000, radius: 0.5}
"""
"""The speed of `a` is that of the engine, or a quarter of it."""


@pytest.mark.parametrize(("gear", "is_outside"), [("fast", 1), ("slow", 0)])
def test_a_note_tells_points_outside_a_law_in_the_gear_of_each(
    folder: Path, gear: str, is_outside: int
) -> None:
    """Of a duty cycle, and of a driving cycle with v = w r/4."""
    (folder / "case.yaml").write_text(BEYOND)
    row = f"1,{gear},120,90\n"
    (folder / "duty.csv").write_text(f"time [s],gear,speed [rad/s],torque [N*m]\n{row}")
    (folder / "trace.csv").write_text(f"time [s],speed [m/s],gear\n0,15,{gear}\n1,15,{gear}\n")
    said = "note: outside the points of a (0 to 954.93 rpm), the value of the nearest end point ap"
    for given in ("summary case.yaml --duty duty.csv", "cycle case.yaml trace.csv"):
        assert vstatics(*given.split()).err.count(said) == is_outside
        assert said not in vstatics(*given.split(), "--allow", "N414").err


def test_an_equivalent_torque_says_of_which_exponent(folder: Path) -> None:
    (folder / "case.yaml").write_text(BEYOND)
    (folder / "duty.csv").write_text("time [s],gear,speed [rad/s],torque [N*m]\n1,fast,100,40\n")
    asked = ["summary", "case.yaml", "--duty", "duty.csv", "-f"]
    for form in ("text", "markdown", "csv"):
        for given, told in ([], "3"), (["--exponent", "6.5"], "6.5"):
            found = vstatics(*asked, form, *given).out.replace("\\", "")
            assert f"equivalent, p = {told}, N*m" in found
    titled = b"A title\n" + (folder / "duty.csv").read_bytes()
    assert vstatics(*asked[:3], "-", stdin=titled).out == vstatics(*asked[:4]).out


def test_points_are_a_record_of_the_torques_of_devices() -> None:
    """The example of ASTM E1049-85, 5.4.4, in 100 N*m, on a spring behind a pair of ratio 2."""
    shaft = Spring({2: 1, 3: -1}, stiffness=9e3, name="shaft")
    strengths = {"shaft": Fatigue(100e6, 3, 4e6, section_modulus=4e-6, threshold=0)}
    pair, gear = Mechanism(1, 2, 0, 2.0, name="pair"), Gear(name="1")
    case = Transmission(3, [], [pair], [gear], springs=[shaft], fatigue=strengths)
    example = (-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0)
    made = spectrum(case, points(*((100.0, 50 * torque, 1.0) for torque in example)))
    assert made.damage["shaft"].damage == pytest.approx(5.341796875e-7, rel=1e-12)
    assert made.damage["shaft"].cycles[-1].range == pytest.approx(900)


GEARED = """
links: [in, small_sun, large_sun, carrier, ring]
output: ring
elements:
  pair: {kind: gear_pair, first: in, second: small_sun, teeth: {first: 20, second: 60}}
  train: {kind: ravigneaux, small_sun: small_sun, large_sun: large_sun, ring: ring,
    carrier: carrier, teeth: {small_sun: 30, large_sun: 36, ring: 84, short: 22, long: 24}}
shift_elements: {B: [carrier, housing], C: [large_sun, carrier]}
gears: {low: [B], direct: [C]}
fatigue:
"""


def test_elements_bear_what_their_first_member_carries() -> None:
    """As mechanisms do; of an element of several meshes each mesh has a life of its own."""
    strength = "{section_modulus: 4e-6, endurance: 1e8, exponent: 3, cycles: 4e6, threshold: 0}"
    first = ["pair", "train.small_sun-short", "train.large_sun-long", "train.short-long"]
    text = GEARED + "".join(f"  {name}: {strength}\n" for name in first)
    rows = points((100.0, 40.0, 1.0), (100.0, 90.0, 1.0))
    made = spectrum(loads(text, format="yaml"), rows)
    ranges = {name: one.cycles[-1].range for name, one in made.damage.items() if one.cycles}
    assert [*made.damage] == first
    sun = made.members["train.small_sun"].torque.largest
    found = [ranges[name] for name in ("pair", "train.small_sun-short", "train.short-long")]
    of_sun = abs(sun) * 50 / 90
    assert found == pytest.approx([50, of_sun, of_sun * 22 / 30 * 0.98])


def test_torques_of_variators_and_converters_follow_from_the_speeds() -> None:
    """M_second = -M_first eta/i of a variator, -K M_first of a converter; drag of 1 N*m behind."""
    for kind, speed_ratio, torque_ratio in (
        ("variator, efficiency: 0.9", 0.4, 0.9 / 0.4),
        ("variator, efficiency: 0.8", -0.5, 0.8 / -0.5),
        ("converter, points: [[0, 2.2], [0.85, 1], [1, 1]]", 0.34, 2.2 - 0.4 * 1.2),
    ):
        own = f"{{first: eng, second: out, speed_ratio: {speed_ratio}, kind: {kind}}}"
        case = loads(
            f"links: [eng, out]\nmechanisms: {{h: {own}}}\ngears: {{1: []}}\n"
            "drag: {out: 1 N*m}\nload: {speed: 2000 rpm, torque: 100 N*m}\n"
        )
        found = spectrum(case, points((200.0, 100.0, 10.0)))
        assert found.members["h.second"].torque.largest == pytest.approx(
            -100 * torque_ratio, rel=1e-9
        )
        assert found.energy.lost["h"] == pytest.approx(200e3 * (1 - speed_ratio * torque_ratio))
        assert found.energy.lost["drag.out"] == pytest.approx(10 * abs(200 * speed_ratio))
        closed = found.energy.in_ - found.energy.out - sum(found.energy.lost.values())
        assert closed == pytest.approx(0, abs=1e-6)


@each_seed(10, 200)
def test_wild_numbers_of_a_duty_cycle_end_in_numbers_or_at_their_line(seed: int) -> None:
    """Numbers of any size: no warning of NumPy, which would be an error here."""
    rng = seeded(5400 + seed)
    for _ in range(20):
        sizes = [1.0, rng.random(), *(10.0 ** rng.randint(-320, 308) for _ in range(2))]
        rows = [
            f"{rng.choice(sizes)!r},1,{rng.choice('- ')}{rng.choice(sizes)!r},{rng.choice(sizes)!r}"
            for _ in range(3)
        ]
        text = "\n".join(["time [s],gear,speed [rad/s],torque [N*m]", *rows])
        problems = []
        try:
            made = read_duty_table(text.encode(), "d.csv").of(solve(PAIRS))
            assert math.isfinite(made.energy.in_)
        except ReadError as error:
            problems = error.problems
        assert all(problem.place and problem.place.line > 1 for problem in problems)


@pytest.mark.parametrize(
    "headings",
    [
        "duration [s],gear,n [rpm],M [Nm]",
        # capitals distinguish headings, as in github.com/jtablesaw/tablesaw/issues/104
        "t,gear,n,T\ns,,rpm,N*m",
        # headings that are units, as in github.com/GoldenCheetah/GoldenCheetah/issues/1288
        "Seconds,gear,RPM,Nm",
    ],
)
def test_a_duty_cycle_has_the_documented_names_of_speed_and_torque(headings: str) -> None:
    """Names as in docs/units.md, also with a `duration`; work is torque times angle."""
    table = read_duty_table(f"{headings}\n10,1,300,20\n30,1,600,5\n".encode(), "d.csv")
    work = 20 * 10 * math.pi * 10 + 5 * 20 * math.pi * 30
    assert table.of(solve(PAIRS)).energy.in_ == pytest.approx(work)
