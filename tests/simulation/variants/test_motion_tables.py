"""Tables of a run in expressions: what is asked of a motion that is written out by hand."""

import math

import numpy as np
import pytest

from tests.rejects import rejects
from tests.simulation.variants.scenarios import SCENARIO, subject
from vstatics import ReadError
from vstatics.simulation import Motion
from vstatics.simulation.record.motion import Energy, Event, EventKind, Peak, Reached
from vstatics.simulation.variants.motion_tables import MotionTables
from vstatics.sweep.build import plan
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import read_expression
from vstatics.sweep.runs import calculate

SUBJECT = subject()
CHANGES: list[tuple[float, EventKind]] = [(0.4, "locks"), (0.5, "slips"), (0.55, "locks")]
MOTION = Motion(
    np.array([0.0, 0.3, 0.6]),
    ("sun", "ring", "carrier"),
    ("brake", "lock-up"),
    ("brake", "lock-up", "set"),
    np.array([[50.0, -30.0, 0.0], [45.0, -5.0, 15.0], [60.0, 0.0, 24.0]]),
    np.array([[-30.0, 80.0], [-5.0, 50.0], [0.0, 60.0]]),
    np.array([[-120.0, 0.0, 40.0], [-120.0, 0.0, 50.0], [-20.0, 0.0, 45.0]]),
    np.zeros((3, 2)),
    (*(Event(at, "brake", kind) for at, kind in CHANGES), Event(0.2, "lock-up", "impact", 7.0)),
    Energy(600.0, {"brake": 850.0}, {"brake": 2.5e5}, {"set": 3.0}, -260.0, 0.0, 7.0, 1e-9),
    {"brake": Peak(-120.0, 0.1), "set": Peak(50.0, 0.3)},
    (Reached("carrier", 10.0, 0.2, 1.0, 5.0), Reached("carrier", 20.0, 0.5, 4.0, math.nan)),
)
VALUES = np.zeros((1, 0))


def value(text: str) -> float:
    tables = MotionTables(MOTION, SUBJECT.rows)
    calculated = read_expression(text, SUBJECT, [], "--out")(tables, VALUES)
    assert calculated.shape == (1,)
    return float(calculated[0])


def test_expressions_speak_of_a_run() -> None:
    for text, expected in (
        ("speeds[carrier]", 24.0),  # what runs along time is told at the end
        ("last(speeds[carrier])", 24.0),
        ("speeds[sun] - speeds[carrier]", 36.0),
        ("max(speeds[sun] - speeds[carrier])", 50.0),
        ("max(abs(slips[brake]))", 30.0),
        ("max(slips)", 80.0),
        ("min(torques[brake])", -120.0),
        ("max(time*(speeds[carrier] < 20))", 0.3),
        ("time", 0.6),
        ("heat[brake]", 850.0),
        ("heat[lock-up]", 0.0),
        ("sum(heat)", 850.0),
        ("heat_per_area[brake]/1000", 250.0),
        ("losses[set]", 3.0),
        ("peaks[brake]", -120.0),
        ("max(abs(peaks))", 120.0),
        ("peak_times[set]", 0.3),
        ("locks[brake]", 0.4),
        ("last_locks[#1]", 0.55),
        ("breaks[brake]", 0.5),
        ("reverses[brake]", math.nan),
        ("impacts[2]", 0.2),
        ("events[brake]", 3.0),
        ('time_to["carrier 20"]', 0.5),
        ("distance_to[#1]", 5.0),
        ("work - kinetic - impact", 853.0),
        ("balance", 1e-9),
        ("heat[brake] > 800 and locks[brake] < .5", 1.0),
        ("duration + controls.brake.1.2", 120.6),
        ("mechanisms.set.ratio", -1.5),
    ):
        quoted = text.replace("[lock-up]", '["lock-up"]')
        assert value(quoted) == pytest.approx(expected, rel=1e-12, nan_ok=True)


def test_a_table_has_a_column_for_each_row() -> None:
    columns = read_columns("speeds, heat, abs(peaks), work", SUBJECT, [])
    assert columns.headings == (
        *("speeds[sun]", "speeds[ring]", "speeds[carrier]", "heat[brake]", 'heat["lock-up"]'),
        *("abs(peaks)[brake]", 'abs(peaks)["lock-up"]', "abs(peaks)[set]", "work"),
    )
    made = columns(MotionTables(MOTION, SUBJECT.rows), VALUES)
    expected = [60, 0, 24, 850, 0, 120, math.nan, 50, 600]
    np.testing.assert_array_equal(made, [expected])
    without = columns(MotionTables(None, SUBJECT.rows), VALUES)
    assert np.isnan(without).all()


def test_mistakes_are_reported() -> None:
    for text, said in (
        ("heet[brake]", "a run has no table `heet`; did you mean `heat`?"),
        ("brake", "a run has no table `brake`; a name goes in brackets: heat[brake]"),
        ("gears[1]", "a run has no table `gears`"),
        ("heat[brak]", "there is no friction `brak`, expected one of `brake`, `lock-up`"),
        ("time_to[carrier]", "there are 2 target `carrier`, expected one of `carrier 10`"),
        ("speeds[sun,1]", "read one part too many, expected speeds[link]"),
        ("work[brake]", "`work` has no rows"),
        ("sum(slips)", "a sum over all instants has no meaning"),
        ("speeds + heat", "`speeds` has one value per link and `heat` one per friction"),
        ("controls.brake.scale", "`controls.brake.scale` is not written in the document"),
        ("duratio.x", "has a key `duratio`; did you mean `duration`?"),
    ):
        with rejects(ReadError, said):
            read_expression(text, SUBJECT, [], "--out")


def test_what_is_asked_of_runs_is_calculated_of_them_and_steps_have_their_times() -> None:
    """The carrier's speed is 50.856751 t rad/s to the lock, as in pictures/test_shift.py."""
    sequences = b"""set: {grip: 120}
sequences:
  up: [{wait: 0.2, set: {grip: 120}}, {when: "locks('brake')", set: {grip: 120}},
       {wait: 9, set: {grip: 1}}]
"""
    scenario = subject(SCENARIO.replace(b"brake: [[0, 120]]", b"brake: grip") + sequences)
    out = "max(accelerations[carrier]), steps[up,1], steps[up,2], steps[up,3], last(slip_power)"
    made = plan(scenario, SweepOptions.of(vary=["torques.sun=40"], out=out))
    assert made.headings[1:4] == ("steps[up,1]", "steps[up,2]", "steps[up,3]")
    chunk = calculate(made, scenario, 0, 1)
    expected = [50.856751, 0.2, 0.410054006, math.nan, 0.0, 0.0]
    assert chunk.columns[0] == pytest.approx(expected, rel=1e-8, abs=1e-8, nan_ok=True)


def test_numbers_of_formulas_vary() -> None:
    """The brake takes its torque times the slip, which is largest at the start: 34.9 rad/s."""
    numbers = SCENARIO.replace(b"brake: [[0, 120]]", b"brake: 40*grip") + b"numbers: {grip: 3}\n"
    scenario = subject(numbers)
    made = plan(scenario, SweepOptions.of(vary=["numbers.grip=3,4"], out="max(slip_power[brake])"))
    found = calculate(made, scenario, 0, 2).columns[:, 0]
    assert found == pytest.approx(34.9065850 * np.array([120, 160]), rel=1e-8)


def test_only_what_is_asked_for_is_calculated() -> None:
    made = plan(SUBJECT, SweepOptions.of(vary=["torques.sun=40"], out="max(jerks[2]), work, heat"))
    assert SUBJECT.asked(made.selections) == [("jerks", "ring")]
