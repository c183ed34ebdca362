"""Losses by maps over speed and torque: scipy's interpolation and roots, energy balances."""

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from tests.chance import count, examples, seeded
from tests.core.writers.again import is_read_again
from vstatics import CaseError, Gear, Load, Mechanism, ReadError, Transmission, load, loads, solve
from vstatics.core.model.laws import MapLaw
from vstatics.core.model.parts import BatteryBalance
from vstatics.core.readers.named.law_formulas import EfficiencyFormula
from vstatics.core.statics.points.gear_loss import braked_torques

RPM = 30 / math.pi
Grid = tuple[list[float], list[list[float]]]


def random_map(
    chance: Random, *, low: float, high: float, sides: bool = False, rise: float = 1.0
) -> Grid:
    """Columns and rows of a random map; `sides` adds torques below 0."""
    torques = sorted(chance.uniform(0, 400) for _ in range(chance.randint(2, 5)))
    columns = [-torque for torque in reversed(torques)] * sides + torques
    speeds = sorted(chance.uniform(0, 600) for _ in range(chance.randint(2, 5)))
    middle = (low + high) / 2

    def value() -> float:
        return middle + rise * (chance.uniform(low, high) - middle)

    return columns, [[speed, *(value() for _ in columns)] for speed in speeds]


def interpolated(columns: list[float], rows: list[list[float]]) -> Callable[[float, Any], Any]:
    """The map as a function of speed and torque (or torques), by scipy, constant outside."""
    speeds = [row[0] for row in rows]
    inside = RegularGridInterpolator((speeds, columns), np.array([row[1:] for row in rows]))

    def value(speed: float, torque: Any) -> Any:
        x, y = np.clip(speed, speeds[0], speeds[-1]), np.clip(torque, columns[0], columns[-1])
        return inside((x, y))[()]

    return value


@examples(5, 15, 2000)
def test_a_chain_of_gear_pairs_with_maps(examples: int) -> None:
    """Forward, by its first link, a pair passes T u eta(w, T); by its second, T/u eta(w, T/u eta).

    The loss of the gear brakes the input by L/w.
    """
    chance = seeded(51)
    for _ in range(examples):
        speed, torque = chance.uniform(20, 500), chance.uniform(10, 350)
        of_gear = random_map(chance, low=0, high=900)
        mechanisms, passed, turning = [], torque, speed
        passed -= interpolated(*of_gear)(speed, torque) / speed
        for link in range(1, chance.randint(3, 5)):
            grid = random_map(chance, low=0.8, high=1.0, rise=0.3)
            eta, ratio = interpolated(*grid), chance.uniform(0.4, 3)
            if chance.random() < 0.5:
                mechanisms.append(Mechanism(link, link + 1, 0, ratio, MapLaw(*grid)))
                passed *= ratio * eta(turning, passed)
                turning /= ratio
            else:
                mechanisms.append(Mechanism(link + 1, link, 0, 1 / ratio, MapLaw(*grid)))
                most, turning = passed * ratio, turning / ratio
                own = partial(lambda t, b, w, f: t - b * f(w, t), b=most, w=turning, f=eta)
                passed = brentq(own, 0, most + 1, xtol=1e-13)
        gear = Gear(loss=MapLaw(*of_gear, "W"))
        links, load = len(mechanisms) + 1, Load(speed * RPM, torque)
        results = solve(Transmission(links, [], mechanisms, [gear], load=load))
        assert results.lossy_output_torque_Nm == pytest.approx([passed], rel=1e-11)
        lost = interpolated(*of_gear)(speed, torque) / 1000
        assert results.gear_losses_kW == pytest.approx(lost, rel=1e-12)
        assert results.power_balance == pytest.approx(0, abs=1e-12)
        assert {message.id for message in results.messages} <= {"N414"}


def test_a_back_efficiency_by_a_formula_of_torque() -> None:
    """Driven by its second link, a worm passes T/u eta with eta = 0.5 - 2/(M + 9) at M = T/u eta."""
    law = EfficiencyFormula("0.5 - 2/(T + 9)")
    worm = Mechanism(2, 1, 0, 20.0, 0.9, back_efficiency=law)
    results = solve(Transmission(2, [], [worm], [Gear()], load=Load(100, 4000)))
    # M^2 + M (9 - 100) + 2 * 200 - 900 = 0 with T/u = 200
    expected = (91 + math.sqrt(91**2 + 4 * 500)) / 2
    assert results.lossy_output_torque_Nm == pytest.approx([expected], rel=1e-12)


def test_a_formula_that_gives_no_efficiency_leaves_no_torques() -> None:
    for formula in ("1.2 - w/1000", "0.9 - 2*T", "sqrt(1 - T)"):
        pair = Mechanism(1, 2, 0, 2.0, EfficiencyFormula(formula), name="pair")
        results = solve(Transmission(2, [], [pair], [Gear()], load=Load(1000, 50)))
        assert np.isnan(results.efficiency).all()
        [said] = results.messages
        assert (said.id, "of pair " in said.text) == ("W433", True)


@pytest.mark.parametrize("rises", [0.009, 0.0092])
def test_the_iteration_may_be_slow(rises: float) -> None:
    """Driven by its second link at 100 N*m, a pair has eta = 0.04 + rises 100 eta."""
    law = EfficiencyFormula(f"0.04 + {rises}*T")
    part = Mechanism(2, 1, 0, 1.0, 0.9, back_efficiency=law)
    pair = Mechanism(2, 3, 0, 1.0, EfficiencyFormula("1 + 0*T"))
    results = solve(Transmission(3, [], [part, pair], [Gear()], load=Load(900, 100)))
    assert results.efficiency == pytest.approx([0.04 / (1 - 100 * rises)], rel=1e-11)


@pytest.mark.parametrize("seed", range(54, 60))
def test_a_map_of_the_other_direction_changes_nothing(seed: int) -> None:
    chance, ahead = seeded(seed), MapLaw([0, 9], [[0, 0.8, 0.9], [9, 0.8, 0.9]])
    for _ in range(count(2, 85)):
        back = MapLaw(*random_map(chance, low=0.2, high=1))
        parts = (Mechanism(2, 1, 0, 1.0, each, back_efficiency=back) for each in (0.9, ahead))
        cases = (Transmission(2, [], [part], [Gear()], load=Load(900, 400)) for part in parts)
        constant, with_map = (solve(case).efficiency for case in cases)
        assert constant == pytest.approx(with_map, rel=1e-11, nan_ok=True)


def test_a_trial_that_locks_has_no_efficiency() -> None:
    """With its ring fixed a carrier turns (u - 1)/u; u eta is below 1 at trials, not at eta."""
    values = [0.7, 0.7, 0.4, 0.45]
    part = Mechanism(1, 0, 2, 1.95, MapLaw([0, 100, 200, 300], [[0, *values], [900, *values]]))
    results = solve(Transmission(2, [], [part], [Gear()], load=Load(900, 90)))
    assert results.efficiency == pytest.approx([(1 - 1.95 * 0.7) / (1 - 1.95)], rel=1e-12)


def test_a_formula_that_is_not_used_takes_no_torques_away() -> None:
    """A pair without torque, and the efficiency of the other direction, have no value here."""
    idle = Mechanism(1, 2, 0, 2.0, EfficiencyFormula("0.9 - 2/T"))
    other = Mechanism(1, 3, 0, 2.0, 0.8, back_efficiency=EfficiencyFormula("0.5 - 20/(T + 9)"))
    results = solve(Transmission(3, [], [idle, other], [Gear()], load=Load(1000, 10)))
    assert results.efficiency == pytest.approx([0.8])
    assert "W433" not in {message.id for message in results.messages}


@examples(8, 25, 500)
def test_machines_with_maps_balance_a_battery(examples: int) -> None:
    """Sum of P eta of generators less P/eta of motors is the power of the battery."""
    chance = seeded(52)
    balanced = 0
    for _ in range(examples):
        grids = [random_map(chance, low=0.7, high=0.95, sides=n > 0, rise=0.5) for n in range(2)]
        grids[0][0][0] = 0.0  # the least torque of either direction
        battery = chance.uniform(-3, 3)
        machines = [(2, MapLaw(*grids[0])), (4, MapLaw(*grids[1]))]
        balance = BatteryBalance(machines, battery)
        gear = Gear(speeds={2: chance.uniform(-0.8, 0.8)}, balance=balance)
        mechanisms = [Mechanism(1, 2, 3, -2.0, 0.98), Mechanism(4, 3, 0, 3.0, 0.97)]
        results = solve(Transmission(4, [], mechanisms, [gear], load=Load(2000, 100), output=3))
        if not results.consistent.all():
            continue
        balanced += 1
        total = 0.0
        for (link, _), grid in zip(machines, grids, strict=True):
            power = -results.port_powers_kW[0, link - 1]
            speed = results.speeds_rpm[0, link - 1] / RPM
            along = -1000 * power / abs(speed)
            eta = interpolated(*grid)(abs(speed), along if min(grid[0]) < 0 else abs(along))
            total += power * eta if power > 0 else power / eta
        assert total == pytest.approx(battery, abs=1e-9)
    assert balanced > examples / 5


def test_the_input_torque_of_a_passed_torque() -> None:
    """The torque passed on is that of the input less the brake torque; counted on a fine grid."""
    chance = seeded(53)
    for _ in range(count(20, 300)):
        columns, rows = random_map(chance, low=0, high=150)
        law, speed = MapLaw(columns, rows, "N*m"), chance.uniform(1, 500)
        value = interpolated(columns, rows)
        torque = chance.uniform(-300, 500)
        passed = torque - value(speed, abs(torque))
        tried = np.linspace(-1000, 1000, 8001)
        left = tried - value(speed, abs(tried)) - passed
        roots = int((np.sign(left[1:]) != np.sign(left[:-1])).sum())
        [found], [solutions] = braked_torques(law, np.array([speed]), np.array([passed]))
        assert (solutions == 1) == (roots == 1)
        assert solutions != 1 or found == pytest.approx(torque, rel=1e-10)


CASE = """\
links: [a, b]
load: {{speed: 200 rad/s, torque: 100 N*m}}
mechanisms: {{D: {{first: a, second: b, ratio: -2, efficiency: {efficiency}}}}}
gears: {{low: {{loss: {loss}}}}}
"""
LOSS = "{over: [speed, torque], columns: [0, 200 N*m], rows: [[0, 20, 60], [6000 rpm, 300, 700]]}"


def test_a_map_is_read_from_a_file_in_any_order_and_written_as_it_is(tmp_path: Path) -> None:
    efficiency = "motor torque [N*m];n [rpm];eta [%]\n0;0;90\n50;0;95\n50;3000;97,0 %\n0;3000;92\n"
    (tmp_path / "map.csv").write_text(efficiency, "utf-8")
    loss = "speed [rad/s],torque [N*m],power loss [kW]\n0,0,0.1\n0,9,0.2\n100,9,0.4\n100,0,0.3\n"
    (tmp_path / "loss.csv").write_text(loss, "utf-8")
    file = tmp_path / "case.yaml"
    both = ["{over: [speed, torque], file: map.csv}", "{over: [speed, torque], file: loss.csv}"]
    file.write_text(CASE.format(efficiency=both[0], loss=both[1]), "utf-8")
    case = load(file)
    law: Any = case.mechanisms[0].efficiency
    assert law.columns == (0, 50)
    assert law.rows == ((0, 0.9, 0.95), (pytest.approx(100 * math.pi), 0.92, 0.97))
    assert case.gears[0].loss == MapLaw([0, 9], [[0, 0.1, 0.2], [100, 0.3, 0.4]], "kW")
    assert is_read_again(case)


def test_a_file_with_a_map_that_is_wrong_is_reported(tmp_path: Path) -> None:
    text = CASE.format(efficiency="{over: [speed, torque], file: map.csv}", loss=LOSS)
    file = tmp_path / "case.yaml"
    file.write_text(text, "utf-8")
    for rows, said in (
        ("0,0,0.9\n0,5,0.9\n9,0,0.9\n", "a full grid: there is no value at 9 rpm, 5 lb ft"),
        ("0,0,0.9\n0,0,0.8\n", "line 3: 0 rpm, 0 lb ft is on line 2, too; expected each point"),
        ("0,0,1.2\n0,5,0.9\n9,0,0.9\n9,5,1\n", "`map.csv`, line 2: read 1.2, expected an eff"),
        ("0,0,0\n0,5,0\n9,0,0\n9,5,1\n", "read 0, .*; omit all rows with speed 0 or torque 0"),
        ("0,0,0.9\n0,5,0.9\n", "`map.csv`: read 1, expected two speeds or more"),
        ("0,0\n", "line 2: expected 3 numbers"),
    ):
        (tmp_path / "map.csv").write_text(f"speed [rpm],torque [lb ft],efficiency\n{rows}", "utf-8")
        with pytest.raises(ReadError, match=said):
            load(file)


def test_maps_that_cannot_be_are_refused_at_their_places() -> None:
    one, flat = "{over: [speed, torque], columns: %s, rows: %s}", "[[0, 1, 1], [9, 1, 1]]"
    for columns, rows, said in (
        ("[0, 5, 5]", "[[0, 1, 1, 1], [9, 1, 1, 1]]", r"columns\[3\]: read 5 N.m, expected a t"),
        ("[-1, 5]", flat, r"columns\[1\]: read -1 N.m, expected a torque of 0 or"),
        ("[0, 5]", "[[9, 1, 1], [0, 1, 1]]", r"rows\[2\]\[1\]: read 0 rad/s, expected a speed ab"),
        ("[0, 5]", "[[0, 1, 1], [9, 1]]", r"rows\[2\]: read 2 numbers, expected 3: the speed, and"),
        # an efficiency says nothing where no power flows: sandialabs/WecOptTool/issues/176
        ("[0, 5]", "[[0, 1, 0], [9, 1, 1]]", r"rows\[1\]\[3\]: read 0, .*1; omit columns of tor"),
        ("[0, 5]", "[[1, 0, 1], [9, 1, 1]]", r"rows\[1\]\[2\]: read 0, .*1; omit columns of tor"),
        ("[1, 5]", "[[1, 1, 0], [9, 1, 1]]", r"rows\[1\]\[3\]: read 0, .*above 0 and up to 1 \["),
        ("[0, 5]", "[[0, 90, 1], [9, 1, 1]]", r"read 90, .* up to 1, such as 0\.9 for 90 % \["),
        ("[0]", "[[0, 1], [9, 1]]", r"columns: read 1, expected two torques or more"),
    ):
        with pytest.raises(ReadError, match=said):
            loads(CASE.format(efficiency=one % (columns, rows), loss=LOSS))
    for loss, said in (
        ("500", "low.loss: read '500', expected a mapping with `over`, `columns` and `rows`"),
        ("{over: [torque, speed], columns: [0], rows: []}", r"^[^\n]*loss.over: read '\[torque, "),
        ("{over: speed, points: [[0, 1]]}", "loss.over: read 'speed', expected `.speed, torque.`"),
        ("{over: [speed, torque], file: a.csv, unit: W}", "read `file` and `unit`"),
        (LOSS.replace("700", "-7"), r"loss.rows\[2\]\[3\]: read -7, expected a loss of 0 or more"),
    ):
        with pytest.raises(ReadError, match=said):
            loads(CASE.format(efficiency="1", loss=loss))
    with pytest.raises(CaseError, match=r"loss: it depends on speed and torque, but .* no speed"):
        solve(loads(CASE.format(efficiency="1", loss=LOSS)).replace(load=Load(torque=1.0)))
