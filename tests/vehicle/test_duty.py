"""Efficiency over a duty cycle, and what its file may say."""

import math
from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.core.summary.capacities import CASE, LOW, case
from vstatics import Gear, Load, Mechanism, Transmission, solve
from vstatics.core.model.parts import OfLoad
from vstatics.vehicle.duty import Duty, cycle


def test_shares_of_energy_give_a_weighted_mean() -> None:
    made = cycle(solve(case()), Duty("energy", {"low": 1, "direct": 3, "N": 0}))
    assert [(one.gear, one.energy) for one in made.stages] == [("low", 0.25), ("direct", 0.75)]
    assert made.efficiency == pytest.approx(0.25 * LOW + 0.75)
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


@pytest.mark.parametrize("torque", [0.5, 0.0])
def test_of_a_dragged_gear_nothing_leaves(torque: float) -> None:
    """.5 N*m (or none) at 300 rad/s through 20:60 and 25:50, all .98; the output adds the rest.

    Drag takes 2 N*m at 100 and 5 N*m at 50 rad/s, the second pair is driven by its output.
    """
    pairs = [Mechanism(1, 2, 0, -3, 0.98), Mechanism(2, 3, 0, -2, 0.98)]
    drag = {2: OfLoad(2.0, torque or 1.0), 3: OfLoad(5.0, torque or 1.0)}
    rpm = math.pi / 30
    little, much = Load(300 / rpm, torque), Load(300 / rpm, 100)
    gears = [Gear(name="little", load=little, drag=drag), Gear(name="much", load=much)]
    results = solve(Transmission(3, [], pairs, gears))
    assert results.dragged.tolist() == [True, False]
    entering = 300 * torque + (2 * 100 - 0.98 * 300 * torque) / 0.98 + 5 * 50
    expected = 0.98**2 * 30000 / (30000 + entering)
    by_time = cycle(results, Duty("time", {"little": 1, "much": 1}))
    assert by_time.efficiency == pytest.approx(expected)
    made = cycle(results, Duty("energy", {"little": 1, "much": 1}))
    assert [one.efficiency for one in made.stages] == pytest.approx([0, 0.98**2])


def test_a_dragged_gear_that_drives_a_further_output_has_what_leaves_there() -> None:
    """A pump takes .25 of the 1 at the input, and what the output adds, which has drag of 2."""
    gear = Gear(torques={3: -0.25}, drag={2: 2.0})
    pairs = [Mechanism(1, 2, 0, 1.0), Mechanism(1, 3, 0, 1.0)]
    made = cycle(solve(Transmission(3, [], pairs, [gear], output=2)), Duty("energy", {"1": 1}))
    assert made.efficiency == pytest.approx(0.25 / 2.25)


def test_what_is_wrong_with_a_duty_cycle_is_reported_with_its_place(folder: Path) -> None:
    for duty, message in (
        ('energy:\n  "7": 2\n  low: 1', "2:3: error: gear 7: there is no such gear"),
        ("energy: {low: 1, N: 2}", "gear N: the gear has no efficiency"),
        ("energy: {low: 0}", "all shares are 0"),
        ("energy: {low: -1}", "read '-1', expected a share of 0 or more"),
        ("energy: {low: 1, low: 2}", "gear low is given twice"),
        ("enrgy: {low: 1}", "did you mean `energy`?"),
        ("energy: [low]", "read a list, expected a share for each gear"),
        ("energy: {low: 1}\ntime: {low: 1}", "expected `energy` or `time`"),
        ("low", "expected `energy` or `time`"),
        ("", "the file is empty"),
        (CASE, "this is a case, expected `energy` or `time` with a share for each gear"),
    ):
        (folder / "duty.yaml").write_text(duty)
        said = vstatics("summary", "-", "--duty", "duty.yaml", stdin=CASE.encode())
        assert said.gives_nothing(message, "duty.yaml")
        (folder / "duty.yaml").write_text("time: {low: 1}")
        text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", "").replace(
            "300 N*m", "1.5"
        )
        said = vstatics("summary", "-", "--duty", "duty.yaml", stdin=text.encode())
        assert said.fails("expected a load with speed and torque")
        assert vstatics("summary", "-", "--duty", "-", stdin=CASE.encode()).status == 2


def test_a_duty_cycle_is_shown_alone_and_of_two_cases(folder: Path) -> None:
    (folder / "duty.yaml").write_text("energy: {low: 25, direct: 75}")
    (folder / "case.yaml").write_text(CASE)
    asked = ("summary", "case.yaml", "--duty", "duty.yaml")
    assert "in all   1.000       0.993" in vstatics(*asked).out
    assert "efficiency of the duty cycle" in vstatics(*asked, "case.yaml").out
    assert json_answer(*asked)["duty"]["efficiency"] == pytest.approx(0.25 * LOW + 0.75)


@pytest.mark.parametrize(("times", "warns"), [("0,1,2,3", 1), ("0,1,1,2", 0), ("1,2,3,4", 0)])
def test_instants_of_a_record_are_doubtful_as_durations(
    times: str, warns: int, folder: Path
) -> None:
    """As durations, instants from 0 would give the last row of a record the largest weight."""
    rows = "".join(f"{time},low,1000,100\n" for time in times.split(","))
    (folder / "duty.csv").write_text(f"time [s],gear,speed [rpm],torque [N*m]\n{rows}")
    (folder / "box.yaml").write_text(CASE, "utf-8")
    said = vstatics("summary", "box.yaml", "--duty", "duty.csv")
    assert (said.status, said.err.count("`time` starts at 0 and rises")) == (0, warns)
