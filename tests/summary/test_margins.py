"""Margins of shift elements with a capacity, and efficiency over a duty cycle.

Sun in, carrier out, u = -2.5, efficiency .96. In `low` the brake holds the ring with 2.5
without losses and 2.4 with them, and the efficiency is 3.4/3.5; in `direct` the clutch
joins sun and ring, carries 2.5/3.5, and nothing is lost.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.commands import vstatics
from vstatics import CaseError, ReadError, Transmission, solve
from vstatics.readers.named.reader import read_json, read_yaml
from vstatics.summary.duty import Duty, cycle
from vstatics.summary.extremes import margins
from vstatics.writers import deck, named

CASE = """\
links: 3
load: {speed: 1000 rpm, torque: 200 N*m}
shift_elements:
  C: {links: [1, 2], capacity: 300 N*m}
  B: {links: [2, housing], capacity: 3}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears:
  low: {engaged: [B]}
  creep: {engaged: [B], load: {torque: 100 N*m}}
  direct: {engaged: [C], load: {speed: 2000 rpm}}
  N: {}
"""
LOW = 3.4 / 3.5


def case(text: str = CASE) -> Transmission:
    return read_yaml(text.encode(), "case.yaml").case


def test_a_margin_is_the_capacity_by_the_larger_torque() -> None:
    """300/(200 * 2.5/3.5); 600/(200 * 2.5), and twice that with half the load."""
    clutch, brake = margins(solve(case()))
    nan = float("nan")
    assert clutch.by_gear == pytest.approx([nan, nan, 2.1, nan], nan_ok=True)
    assert brake.by_gear == pytest.approx([1.2, 2.4, nan, nan], nan_ok=True)
    assert (clutch.gear, brake.gear) == ("direct", "low")
    assert brake.least == pytest.approx(1.2)


def test_a_capacity_needs_no_load_when_it_is_relative() -> None:
    text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", "").replace("300 N*m", "1.5")
    clutch, brake = margins(solve(case(text)))
    assert clutch.least == pytest.approx(2.1)
    assert brake.least == pytest.approx(1.2)


def test_a_capacity_with_a_unit_is_related_to_the_load_of_the_case() -> None:
    assert case().shift_elements[0].capacity == pytest.approx(1.5)
    for load in ("", "load: {speed: 1000 rpm}\n"):
        text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", load)
        with pytest.raises(ReadError, match="read 300 N"):
            case(text)


@pytest.mark.parametrize("capacity", ["0", "-3", "0 N*m", "-3 N*m"])
def test_a_capacity_is_above_0(capacity: str) -> None:
    with pytest.raises(ReadError, match="expected a torque above 0"):
        case(CASE.replace("300 N*m", capacity))


def test_a_capacity_is_above_0_in_the_library_too() -> None:
    wrong = case().shift_elements[0]._replace(capacity=-1.0)
    with pytest.raises(CaseError, match="expected a torque above 0"):
        replace(case(), shift_elements=[wrong])


def test_capacities_are_written_and_read_again() -> None:
    own = case()
    assert read_yaml(named.write_yaml(own).encode(), "again.yaml").case == own
    assert read_json(named.write_json(own).encode(), "again.json").case == own
    assert "capacity of shift element C" in deck.lost(own)


def test_margins_are_shown() -> None:
    said = vstatics("summary", "-", stdin=CASE.encode())
    lines = [line.split() for line in said.out.splitlines()]
    assert ["C", "300.0", "2.100", "direct"] in lines
    assert ["B", "600.0", "1.200", "low"] in lines
    made = json.loads(vstatics("summary", "-", "-f", "json", stdin=CASE.encode()).out)
    assert made["margins"][1] == {
        "element": "B",
        "capacity": 3.0,
        "by_gear": [pytest.approx(1.2), pytest.approx(2.4), None, None],
        "least": pytest.approx(1.2),
        "gear": "low",
    }


def test_shares_of_energy_give_a_weighted_mean() -> None:
    made = cycle(solve(case()), Duty("energy", {"low": 1, "direct": 3, "N": 0}))
    assert [(one.gear, one.energy) for one in made.stages] == [("low", 0.25), ("direct", 0.75)]
    assert made.efficiency == pytest.approx(0.25 * LOW + 0.75)


def test_shares_may_have_a_sum_that_no_number_holds() -> None:
    made = cycle(solve(case()), Duty("energy", {"low": 1e308, "direct": 1e308}))
    assert [one.energy for one in made.stages] == [0.5, 0.5]
    assert made.efficiency == pytest.approx((LOW + 1) / 2)


def test_shares_of_time_are_weighted_by_the_input_power() -> None:
    """200 N*m at 1000 and at 2000 rpm: of equal times direct has twice the energy."""
    results = solve(case())
    made = cycle(results, Duty("time", {"low": 10, "direct": 10}))
    assert [one.energy for one in made.stages] == pytest.approx([1 / 3, 2 / 3])
    assert made.efficiency == pytest.approx((LOW + 2) / 3)
    made = cycle(results, Duty("time", {"creep": 2, "low": 1}))
    assert made.efficiency == pytest.approx(LOW)


@pytest.mark.parametrize(
    ("duty", "message"),
    [
        ('energy: {low: 1, "7": 2}', "2:3: error: gear 7: there is no such gear"),
        ("energy: {low: 1, N: 2}", "gear N: the gear has no efficiency"),
        ("energy: {low: 0}", "all shares are 0"),
        ("energy: {low: -1}", "read '-1', expected a share of 0 or more"),
        ("energy: {low: much}", "read 'much', expected a share"),
        ("energy: {low: 1, low: 2}", "gear low is given twice"),
        ("enrgy: {low: 1}", "did you mean `energy`?"),
        ("energy: [low]", "read a list, expected a share for each gear"),
        ("energy: {low: 1}\ntime: {low: 1}", "expected `energy` or `time`"),
        ("low", "expected `energy` or `time`"),
        ("", "the file is empty"),
    ],
)
def test_what_is_wrong_with_a_duty_cycle_is_told_with_its_place(
    duty: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "duty.yaml"
    file.write_text(duty.replace(': {low: 1, "7": 2}', ':\n  "7": 2\n  low: 1'))
    said = vstatics("summary", "-", "--duty", file, stdin=CASE.encode())
    assert (said.status, said.out) == (1, "")
    assert message in said.err
    assert str(file) in said.err


def test_shares_of_time_need_a_load(tmp_path: Path) -> None:
    file = tmp_path / "duty.yaml"
    file.write_text("time: {low: 1}")
    text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", "").replace("300 N*m", "1.5")
    said = vstatics("summary", "-", "--duty", file, stdin=text.encode())
    assert said.status == 1
    assert "expected a load with speed and torque" in said.err


def test_a_duty_cycle_is_shown_alone_and_of_two_cases(tmp_path: Path) -> None:
    duty, file = tmp_path / "duty.yaml", tmp_path / "case.yaml"
    duty.write_text("energy: {low: 25, direct: 75}")
    file.write_text(CASE)
    said = vstatics("summary", file, "--duty", duty)
    assert "in all   1.000        .993" in said.out
    both = vstatics("summary", file, file, "--duty", duty)
    assert "efficiency of the duty cycle" in both.out
    made = json.loads(vstatics("summary", file, "--duty", duty, "-f", "json").out)
    assert made["duty"]["efficiency"] == pytest.approx(0.25 * LOW + 0.75)


def test_standard_input_is_the_case_or_the_duty_cycle() -> None:
    said = vstatics("summary", "-", "--duty", "-", stdin=CASE.encode())
    assert said.status == 2
