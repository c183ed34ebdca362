"""Load spectra and life over a duty cycle: sums over the rows by hand, of random cycles."""

import json
import math
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from tests.chance import each_seed, examples, seeded
from tests.commands import json_answer, vstatics
from tests.rejects import rejects
from vstatics import Bearing, CaseError, ReadError, Transmission, example, load, loads, solve
from vstatics.core.explain import explain_gear
from vstatics.core.tables.answer import plain_data
from vstatics.core.writers.named import write_yaml
from vstatics.vehicle.case.fatigue import TorqueStrength
from vstatics.vehicle.operation.load_spectrum import Spectrum, spectrum
from vstatics.vehicle.operation.point_loads import DutyPoints

Z_SUN, Z_RING, PLANETS, RATIO = 30, 78, 3, 2.5
CASE = """\
links: [s, c, out]
output: out
elements:
  P1: {kind: planetary, sun: s, ring: housing, carrier: c, teeth: {sun: 30, ring: 78}, planets: 3}
mechanisms: {pair: {first: c, second: out, ratio: 2.5}}
gears: {"1": []}
mesh_efficiency: {external: 1, internal: 1}
%s
"""
STRENGTH = """\
fatigue:
  P1.sun: {torque: 150 N*m, cycles: 3e6, exponent: 6.6, flanks: apart}
  P1.planet: {torque_of: P1.sun, torque: 140, cycles: 2e6, exponent: 6, sum: 0.8}
  pair: {torque: 300, cycles: 1e6, exponent: 8, contacts: 2, threshold: 0.4}
  sun root: {on: P1.sun, torque: 190, cycles: 1e6, exponent: 9}
bearings:
  pin: {on: P1.planet, torque_of: P1.carrier, load_per_torque: 12 N/(N*m), dynamic: 24 kN}
  main: {on: [s, c], torque_of: P1.sun, load_per_torque: 30, dynamic: 9 kN, exponent: 3}
  out: {on: [out, housing], torque_of: out, load_per_torque: 4, dynamic: 12 kN, exponent: 3}
"""


class Rows:
    """Speeds [rad/s] and torques [N*m] of members in each row by hand, without losses."""

    def __init__(self, chance: Random) -> None:
        size = chance.randint(3, 9)
        self.speeds = np.array([chance.uniform(10, 400) for _ in range(size)])
        self.torques = np.array([chance.uniform(-120, 200) for _ in range(size)])
        self.torques[0] = 0.0
        self.speeds[chance.randrange(1, size)] = 0.0
        self.times = np.array([chance.uniform(1, 500) for _ in range(size)])
        i = 1 + Z_RING / Z_SUN
        carrier = self.speeds / i
        z_planet = (Z_RING - Z_SUN) / 2
        self.of = {
            "P1.sun": (self.torques, self.speeds - carrier),
            "P1.planet": (self.torques, (self.speeds - carrier) * Z_SUN / z_planet),
            "P1.carrier": (-self.torques * i, 0 * carrier),
            "pair.first": (self.torques * i, carrier),
            "out": (np.abs(self.torques) * i * RATIO, carrier / RATIO),
        }

    def points(self, *, shares: bool = False) -> DutyPoints:
        """Points of the only gear."""
        gears = np.zeros(len(self.times), np.int64)
        return DutyPoints(gears, self.speeds, self.torques, self.times, shares)

    def turns(self, name: str) -> Any:
        """Revolutions of a member in each row."""
        return np.abs(self.of[name][1]) * self.times / (2 * math.pi)

    @property
    def moving(self) -> Any:
        """Rows that do not stand."""
        return self.speeds != 0


def duty(rows: Rows, classes: Any = None, keys: str = STRENGTH) -> Spectrum:
    return spectrum(loads(CASE % keys), rows.points(), classes=classes)


@examples(6, 20, 500)
def test_the_classes_of_a_member_hold_its_rows(examples: int) -> None:
    """Each row is in one class of its sign; a sun meets its three planets in a turn."""
    chance = seeded(71)
    for _ in range(examples):
        rows = Rows(chance)
        bounds = sorted(chance.uniform(5, 150) for _ in range(3))
        number = chance.randint(1, 8)
        for classes in (number, bounds):
            found = duty(rows, classes).spectrum
            assert found is not None
            torques, _ = rows.of["P1.sun"]
            sizes, turns = np.abs(torques), rows.turns("P1.sun")
            largest = sizes[rows.moving].max()
            edges = [largest * n / number for n in range(number + 1)]
            edges = edges if classes == number else [0.0, *bounds, math.inf]
            expected = []
            for sign in (1, -1):
                own = rows.moving & (torques * sign > 0)
                for low, high in pairwise(edges) if own.any() else ():
                    among = own & (sizes > low) & (sizes <= high * (1 + 1e-12))
                    time, turned = rows.times[among].sum(), turns[among].sum()
                    mean = 60 * turned / time if time else math.nan
                    end = sign * high if high < math.inf else math.nan
                    expected.append((sign * low, end, turned, 3 * turned, time, mean))
            sun = found["P1.sun"]
            assert [*map(tuple, sun.classes)] == [
                pytest.approx(each, rel=1e-9, abs=1e-9, nan_ok=True) for each in expected
            ]
            idle = rows.moving & (torques == 0)
            assert sun.idle.revolutions == pytest.approx(turns[idle].sum(), rel=1e-9)
            standing = rows.times[~rows.moving].sum()
            assert sun.idle.time == pytest.approx(rows.times[idle].sum() + standing, rel=1e-12)
            assert "P1.planet" not in found


@examples(6, 20, 500)
def test_life_of_members_and_bearings_sums_up_by_rows(examples: int) -> None:
    chance = seeded(72)
    for _ in range(examples):
        rows = Rows(chance)
        found = duty(rows)
        life, bearings = found.life, found.bearings
        assert life is not None
        assert bearings is not None
        moving, total = rows.moving, rows.times.sum()
        for name, member, strength, flanks in (
            ("P1.sun", "P1.sun", (150, 3e6, 6.6, 0.0, 1.0), 3),
            ("P1.planet", "P1.planet", (140, 2e6, 6, 0.0, 0.8), 1),
            ("pair", "pair.first", (300, 1e6, 8, 0.4, 1.0), 2),
            ("sun root", "P1.sun", (190, 1e6, 9, 0.0, 1.0), 3),
        ):
            limit, cycles, m, threshold, at_failure = strength
            torques, contacts = rows.of[member][0], flanks * rows.turns(member)
            part = np.abs(torques) / limit
            harm = np.where(part >= threshold, contacts / cycles * part**m, 0) * moving
            damage = harm.sum()
            if name == "P1.sun":
                damage = max(harm[torques > 0].sum(), harm[torques < 0].sum())
            assert life[name].damage == pytest.approx(damage, rel=1e-9)
            loaded = moving & (torques != 0)
            assert life[name].contacts == pytest.approx(contacts[loaded].sum(), rel=1e-9)
            if damage:
                assert life[name].repeats == pytest.approx(at_failure / damage, rel=1e-9)
                assert life[name].hours == pytest.approx(at_failure / damage * total / 3600)
            else:
                assert (life[name].repeats, life[name].hours) == (None, None)
        for name, turning, owner, per, rating, p in (
            ("pin", "P1.planet", "P1.carrier", 12, 24e3, 10 / 3),
            ("main", "P1.sun", "P1.sun", 30, 9e3, 3),
            ("out", "out", "out", 4, 12e3, 3),
        ):
            turns, force = rows.turns(turning)[moving], per * np.abs(rows.of[owner][0])[moving]
            damage = float(((force / rating) ** p @ turns) / 1e6)
            equivalent = (force**p @ turns / turns.sum()) ** (1 / p)
            own = bearings[name]
            values = [own.damage, own.revolutions, own.equivalent_load, own.hours]
            expected = [damage, turns.sum(), equivalent, total / 3600 / damage]
            assert values == pytest.approx(expected, rel=1e-9)


def test_a_torque_at_a_bound_belongs_below_it() -> None:
    rows = Rows(seeded(73))
    rows.speeds[:] = 100.0
    rows.torques[:] = 50 * (1 + 1e-12)
    found = duty(rows, [50.0, 100.0]).spectrum
    assert found is not None
    assert [each.time > 0 for each in found["P1.sun"].classes] == [True, False, False]
    rows.torques[:] = 0.4 * 300 / (1 + Z_RING / Z_SUN) * (1 - 1e-12)  # at the threshold of `pair`
    life = duty(rows).life
    assert life is not None
    assert life["pair"].damage > 0


def test_rounding_neither_turns_a_member_nor_loads_it() -> None:
    """In gear 2 nothing holds the carrier, in gear 3 the gear set rotates as a block."""
    bearing = Bearing("set.long", 9.0, 9e3, "set.ring")
    case = example("ravigneaux-aod").replace(bearings={"pin": bearing})
    gears = np.array([1, 2, 0])
    points = DutyPoints(gears, np.full(3, 250.0), np.array([97.0, 80, 70]), np.array([9.0, 5, 3]))
    found = spectrum(case, points, classes=2).spectrum
    assert found is not None
    for name in ("carrier", "set.carrier"):
        assert found[name].idle.time == 9
    assert sum(each.time for each in found["set.carrier"].classes if each.to < 0) == 0
    points = DutyPoints(gears[1:2], np.array([250.0]), np.array([97.0]), np.array([9.0]))
    bearings = spectrum(case, points).bearings
    assert bearings is not None
    assert bearings["pin"][:2] == (0, 0)
    assert math.isnan(bearings["pin"].equivalent_load)
    assert bearings["pin"].hours is None


def test_without_torque_the_spectrum_is_empty() -> None:
    points = DutyPoints(np.array([0]), np.array([9.0]), np.array([0.0]), np.array([9.0]))
    assert plain_data(spectrum(loads(CASE % ""), points, classes=2))["spectrum"] == {}


def test_a_case_with_strengths_of_members_is_explained() -> None:
    case = loads(CASE % STRENGTH)
    for ratios in (None, [-2.6, 2.0]):
        assert "u_pair (1 - u_P1)" in str(explain_gear(solve(case, ratios=ratios), "1"))


@pytest.mark.usefixtures("folder")
def test_strengths_follow_mechanisms_that_become_gear_sets() -> None:
    strength = "{torque: 9, cycles: 9, exponent: 3}"
    text = f"""\
links: [a, b]
mechanisms: {{D: {{first: a, second: housing, third: b, ratio: -2.5}}}}
gears: {{"1": []}}
fatigue: {{D.first: {strength}}}
bearings: {{b: {{on: [a, b], torque_of: D.third, load_per_torque: 1, dynamic: 9}}}}
"""
    Path("case.yaml").write_text(text, "utf-8")
    assert vstatics("synth", "teeth", "case.yaml", "--write", "teeth.yaml").status == 0
    made = load("teeth.yaml")
    assert [*made.fatigue] == ["D.sun"]
    assert Bearing.of(made)["b"].torque_of == "D.carrier"
    Path("teeth.yaml").rename("case.yaml")
    assert vstatics("synth", "teeth", "case.yaml").status == 0


def test_shares_give_classes_in_parts_and_a_life_in_hours() -> None:
    rows = Rows(seeded(74))
    case = loads(CASE % STRENGTH)
    timed = spectrum(case, rows.points(), classes=4)
    shared = spectrum(case, rows.points(shares=True), classes=4)
    assert timed.life is not None
    assert shared.life is not None
    assert shared.spectrum is not None
    for name, life in timed.life.items():
        assert shared.life[name].hours == pytest.approx(life.hours, rel=1e-9)
    times = [each.time for each in shared.spectrum["s"].classes] + [shared.spectrum["s"].idle.time]
    assert sum(times) == pytest.approx(1)
    [heads] = [grid.columns for grid in shared.grids() if grid.key == "duty spectrum"]
    assert [head.heading for head in heads[3:6]] == ["turns a second", "contacts", "share"]


def test_strengths_and_bearings_are_written_as_they_were_read() -> None:
    case = loads(CASE % STRENGTH)
    assert loads(write_yaml(case)) == case
    assert case.fatigue["pair"] == TorqueStrength(300, 8, 1e6, 2.0, threshold=0.4)


T, B = "torque: 9, cycles: 9, exponent: 3", "load_per_torque: 1, dynamic: 9"


def test_what_cannot_be_is_refused_at_its_place() -> None:
    for keys, said in (
        (f"fatigue: {{P9.sun: {{{T}}}}}", "there is no link or member `P9"),
        (f"fatigue: {{P1.planet: {{{T}}}}}", "expected `torque_of`"),
        (
            f"fatigue: {{m: {{{T}}}}}\nsprings: {{m: {{links: [s], stiffness: 9}}}}",
            "`m` is a spring",
        ),
        (f"fatigue: {{a: {{on: P1.planet, {T}}}}}", "P1.planet is a"),
        (f"fatigue: {{a: {{on: P9.sun, {T}}}}}", "or member `P9.sun`"),
        (
            "fatigue: {a: {on: P1.sun, endurance: 9, cycles: 9, exponent: 3}}",
            "read `on` with `endurance`",
        ),
        (f"fatigue: {{P1.sun: {{{T}, endurance: 9 MPa}}}}", "read `endurance` with `torque`"),
        ("fatigue: {P1.sun: {cycles: 9, exponent: 3}}", "`endurance` is missing"),
        ("fatigue: {P1.sun: {torque: 0, cycles: 9, exponent: 3}}", "expected a torque above 0"),
        (f"fatigue: {{P1.planet: {{torque_of: P1.planet, {T}}}}}", "with a torque `P1.planet`"),
        (f"bearings: {{b: {{on: x, {B}}}}}", "no link or member `x`"),
        (f"bearings: {{b: {{on: [s, x], torque_of: s, {B}}}}}", "no link `x`"),
        (f"bearings: {{b: {{on: [s, c], {B}}}}}", "expected `torque_of` of b"),
        (f"bearings: {{b: {{on: P1.planet, {B}}}}}", "expected `torque_of` of b"),
        (f"bearings: {{b: {{on: P1.carrier, {B}}}}}", "does not turn against"),
        (f"bearings: {{b: {{on: [s, s], torque_of: s, {B}}}}}", "does not turn against"),
        (f"fatigue: {{s: {{{T}, flanks: apart}}}}", "is a magnitude"),
        (f"fatigue: {{P1.sun: {{torque_of: s, {T}, flanks: apart}}}}", "is a magnitude"),
        ("bearings: {b: {on: s, load_per_torque: 0, dynamic: 9 kN}}", "a load per torque above 0"),
        ("bearings: {b: {on: s, load_per_torque: 1 N, dynamic: 9}}", "load_per_torque: read '1 N'"),
    ):
        with rejects(ReadError, said, ":8:"):
            loads(CASE % keys)


def test_members_of_gear_sets_in_error_are_not_reported_as_missing() -> None:
    wrong = {"ratio: 2.5": "ratio: x", "ring: 78": "ring: 0", "sun: s": "sun: [s]"}
    for read, written in wrong.items():
        with pytest.raises(ReadError) as caught:
            loads((CASE % STRENGTH).replace(read, written))
        assert "E880" not in {problem.id for problem in caught.value.problems}


CAR = """\
links: [engine, w]
mechanisms: {p: {first: engine, second: w, ratio: 8, efficiency: 0.95}}
gears: {"-1": []}
inertias: {engine: 0.04, w: 0.5}
vehicle: {mass: 1500, radius: 0.3, engine: [[0, 900], [2000, 900]], overrun: [[0, -900]]}
"""


@pytest.mark.usefixtures("folder")
def test_steps_of_a_cycle_are_points_of_a_duty_cycle() -> None:
    """The torque of the input is that of the engine less J dw/dt; a stop is time."""
    Path("car.yaml").write_text(CAR, "utf-8")
    trace = "time [s],speed [m/s]\n0,0\n10,8\n16,2\n18,0\n25,0\n"
    Path("trace.csv").write_text(trace, "utf-8")
    answer = json_answer("cycle", "car.yaml", "trace.csv", "--steps", "steps.csv", "-f", "json")
    said = vstatics(
        *("summary", "car.yaml", "--duty", "steps.csv", "--spectrum", "2", "-f", "json")
    )
    assert said.status == 0
    assert "inertias behind the input, of w, load no member" in said.err
    [summary] = [json.loads(said.out)]
    duty, energy = summary["duty"], answer["cycle"]["energy"]
    force = 1500 * 0.3 / 8
    rows = [(4.0, 0.8, 10), (5.0, -1.0, 6), (1.0, -1.0, 2)]
    torques = []
    for _, a, _ in rows:
        at_output = force * 8 * a + 0.5 * a / 0.3
        torques.append(at_output / 8 * (1 / 0.95 if at_output > 0 else 0.95))
    turns = [v / 0.3 * 8 * t / (2 * math.pi) for v, _, t in rows]
    first = duty["spectrum"]["p.first"]
    assert sum(each["revolutions"] for each in first["classes"]) == pytest.approx(sum(turns))
    assert first["classes"][-1]["to"] < 0 < first["classes"][0]["to"]
    assert duty["members"]["p.first"]["torque"]["largest"] == pytest.approx(
        max(torques, key=abs), rel=1e-9
    )
    assert first["idle"] == {"revolutions": 0, "time": 7}
    assert energy["lost"]["p"] == pytest.approx(duty["energy"]["lost"]["p"], rel=1e-9)
    Path("car.yaml").write_text(f"{CAR}coast: true\n", "utf-8")
    coasting = json_answer("summary", "car.yaml", "--duty", "steps.csv", "-f", "json")["duty"]
    assert coasting["energy"] == duty["energy"]


@pytest.mark.usefixtures("folder")
@each_seed(2, 100)
def test_steps_in_which_a_freewheel_would_overrun_are_points_of_a_duty_cycle(seed: int) -> None:
    """The engine turns the dragging shaft `s` alone, and the brakes stop the vehicle.

    The freewheel then has a torque of 0, at which statics would let it overrun.
    """
    rng = seeded(seed)
    drag, ratio = 10 ** rng.uniform(-3, 1), rng.uniform(1, 8)
    Path("car.yaml").write_text(
        "links: [engine, s, sun, w]\nload: {speed: 1500 rpm, torque: 100 N*m}\n"
        "shift_elements: {F: {kind: freewheel, links: [sun, s]}}\n"
        f"mechanisms:\n  p: {{first: engine, second: s, ratio: {rng.uniform(0.5, 2)}}}\n"
        f"  q: {{first: sun, second: w, ratio: {ratio}, efficiency: {rng.uniform(0.8, 1)}}}\n"
        f"gears: {{low: []}}\ndrag: {{w: {drag} N*m}}\n"
        f"vehicle: {{mass: 1500, radius: {rng.uniform(0.1, 0.6)}, overrun: [[0, -900]]}}\n",
        "utf-8",
    )
    Path("trace.csv").write_text("time [s],speed [m/s]\n0,20\n6,12\n9,3\n", "utf-8")
    answer = json_answer("cycle", "car.yaml", "trace.csv", "--steps", "steps.csv")
    duty = json_answer("summary", "car.yaml", "--duty", "steps.csv")
    lost = answer["cycle"]["energy"]["lost"]["drag.w"]
    assert duty["duty"]["energy"]["lost"]["drag.w"] == pytest.approx(lost)


def test_classes_that_cannot_be_are_wrong_use() -> None:
    for classes, said in {
        "0": "read '0', expected a number of classes from 1 to 1000",
        "50,20 N*m": "expected bounds above 0 in ascending order",
        "50,100": "expected a number of classes",
        "5 kW": "expected a number of classes",
    }.items():
        asked = "summary", "x.yaml", "--duty", "d.csv", "--spectrum", classes
        assert vstatics(*asked).is_wrong_use(said)


@pytest.mark.usefixtures("folder")
def test_a_deck_holds_neither_bearings_nor_losses_of_gears() -> None:
    loss = "{over: [speed, torque], columns: [0, 9], rows: [[0, 1, 1], [9, 1, 1]]}"
    text = (CASE % STRENGTH).replace('"1": []', f'"1": {{loss: {loss}}}')
    Path("case.yaml").write_text(text + "load: {speed: 9 rpm, torque: 9 N*m}\n", "utf-8")
    said = vstatics("convert", "case.yaml", "case.dat")
    for what in ("loss of gear 1", "bearing of pin, main, out", "fatigue strength of P1.sun"):
        assert what in said.err
    assert not Path("case.dat").exists()
    printed = vstatics("run", "case.yaml", "-f", "source")
    assert "the published listing has no field for losses of gears as a whole: 1" in printed.err


@pytest.mark.usefixtures("folder")
def test_points_are_read_below_a_comment_beside_other_speeds_and_stand_in_no_gear() -> None:
    Path("case.yaml").write_text(CASE % STRENGTH, "utf-8")
    rows = "speed [km/h],duration [s],gear,speed [rpm],torque [N*m]\n9,10,1,900,50\n0,5,,0,0\n"
    answers = []
    for text in (rows, "\ufeff" + rows, "# steps\n" + rows):
        Path("d.csv").write_text(text, "utf-8")
        answers.append(json_answer("summary", "case.yaml", "--duty", "d.csv", "-f", "json")["duty"])
    assert answers == 3 * answers[:1]
    assert answers[0]["members"]["s"]["revolutions"] == pytest.approx(150)
    for changed in (rows.replace(" [s]", ""), rows.replace("5,,0,0", "5,N,0,9")):
        Path("d.csv").write_text(changed, "utf-8")
        again = json_answer("summary", "case.yaml", "--duty", "d.csv", "-f", "json")["duty"]
        assert again == answers[0]
    Path("d.csv").write_text(rows.replace(",10,", ",-1,"), "utf-8")
    said = vstatics("summary", "case.yaml", "--duty", "d.csv")
    assert "duration: read -1, expected 0 or more" in said.err


def test_an_unknown_torque_leaves_the_life_unknown() -> None:
    """Two brakes hold the ring, so the torque of neither is known, even in part of a turn."""
    text = CASE.replace("ring: housing", "ring: r").replace("links: [s,", "links: [r, s,")
    text = text.replace(
        "output: out", "input: s\noutput: out\nshift_elements: {A: [r, housing], B: [r, housing]}"
    )
    text = text.replace('"1": []', '"1": [A, B]')
    bearing = "torque_of: A, load_per_torque: 1, dynamic: 9 kN"
    keys = f"bearings: {{b: {{on: s, {bearing}}}, still: {{on: r, {bearing}}}}}\n"
    keys += "fatigue: {tooth: {on: P1.sun, torque_of: A, torque: 9, cycles: 1e6, exponent: 6}}"
    rows = Rows(seeded(76))
    rows.times /= 2 * rows.turns("P1.sun").max()
    results = spectrum(loads(text % keys), rows.points())
    assert results.life is not None
    assert math.isnan(results.life["tooth"].damage)
    assert results.bearings is not None
    assert results.bearings["still"].damage == 0
    assert math.isnan(results.bearings["b"].damage)
    assert results.bearings["b"].hours is None


def test_a_cycle_that_never_moves_is_an_error() -> None:
    rows = Rows(seeded(75))
    rows.speeds[:] = 0.0
    case: Transmission = loads(CASE % "")
    with pytest.raises(CaseError, match="read 0 everywhere, expected a speed"):
        spectrum(case, rows.points())
