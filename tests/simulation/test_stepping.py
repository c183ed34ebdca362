"""A run that is advanced: as one run, and back again."""

import math
from typing import Any

import numpy as np
import pytest

from tests.chance import each_seed, seeded
from tests.simulation.control.written import simulated, written
from vstatics import CaseError
from vstatics.simulation import Motion, SteppedRun, begin

LAG = """duration: 5
start: {speeds: {e: 200, o: 0}}
set: {command: 0, target: 20}
states: {p: {rate: "(command - p)/0.06"}}
controls: {C: p}
"""
SHIFT = """sequences:
  shift:
    - {when: "t >= 0.5", set: {command: 80}}
    - {when: "slip('C') < 20", set: {target: 5}, within: 3}
    - {when: "locks('C')", wait: 0.1, set: {command: 600}}
"""


def told(run: SteppedRun | Motion) -> list[tuple[str, str]]:
    return [(one.element, one.event) for one in run.events]


def is_the_run(run: SteppedRun, whole: Motion, rel: float = 1e-9, near: float = 0.0) -> None:
    """Speeds at the end and events are those of a run."""
    assert told(run) == told(whole)
    times = [[one.time for one in each.events] for each in (run, whole)]
    assert times[0] == pytest.approx(times[1], abs=rel)
    speeds = np.array([*run.speeds.values()])
    assert speeds == pytest.approx(whole.speeds[-1], rel=rel, abs=near)


def test_steps_are_one_run() -> None:
    """By 100 steps whose ends lie beside the times of the sequence."""
    run = begin(written(LAG + SHIFT))
    for _ in range(100):
        run.advance(0.05)
    assert run.time == pytest.approx(5, abs=1e-12)
    is_the_run(run, simulated(LAG + SHIFT))


def test_who_commands_from_outside_is_a_sequence() -> None:
    """A command at 0.5 s by a step of a sequence, or by the one who advances."""
    whole = simulated(LAG + 'sequences: {shift: [{when: "t >= 0.5", set: {command: 80}}]}\n')
    run = begin(written(LAG))
    run.advance(0.5)
    run.advance(4.5, command=80)
    is_the_run(run, whole._replace(events=whole.events[1:]))


def test_the_duration_ends_nothing() -> None:
    """Without torques the momentum stays: 2 200/(2 + 3) rad/s once the clutch has locked."""
    run = begin(written(LAG))
    run.advance(20, p=30, command=30)
    assert run.speeds == pytest.approx({"e": 80.0, "o": 80.0}, rel=1e-9)


def test_what_jumps_behind_the_duration_is_met_exactly() -> None:
    """The momentum of an engine of 2 kg*m^2 by 30 N*m until 10 s, or in two pulses before 13 s."""
    pulses = "30*(sin(t) > 0.5)", 30 * 4 * math.pi / 3
    for torque, impulse in (("[[0, 30], [10, 30], [10, 0]]", 300.0), pulses):
        run = begin(written(f"{LAG}torques: {{e: {torque}}}\n"))
        run.advance(4)
        run.advance(9)
        assert run.speeds["e"] == pytest.approx(200 + impulse / 2, rel=1e-12)


def test_back_again() -> None:
    """What is tried from a state leaves it as it was, events, sequences and all."""
    run = begin(written(LAG + SHIFT + 'torques: {e: "3*sin(5*t) - 1e-4*speed**2"}\n'))
    run.advance(3.3)
    before, speeds, events = run.state, run.speeds, run.events
    ends = []
    for command in (80, 300, 80):
        run.state = before
        assert (run.time, run.speeds, run.events) == (3.3, speeds, events)
        run.advance(1, command=command)
        ends.append((run.speeds, run.events))
    assert ends[0] == ends[2]
    assert ends[0] != ends[1]


def test_what_is_set_comes_before_sequences() -> None:
    """A step that waits for a number is done at the instant at which that is set."""
    run = begin(written(LAG + 'sequences: {s: [{when: "target < 10", set: {command: 80}}]}\n'))
    run.advance(1)
    run.advance(1, target=5)
    assert [(one.element, one.time) for one in run.events] == [("s", 1.0)]


REFUSED: list[tuple[Any, dict[str, Any], str]] = [
    (1.0, {"comand": 1.0}, r"no `comand` to set; did you mean `command`\?"),
    (1.0, {"xyz": 1.0}, "no `xyz` to set, expected command, target, p"),
    (1.0, {"p": float("nan")}, "p is nan, expected a number"),
    (1.0, {"p": "a"}, "p is a, expected a number"),
    (1.0, {"p": 101.0}, "p: read 101, expected at most 100, its max"),
    ("x", {}, "advance by x s, expected a number above 0"),
    (0.0, {}, "advance by 0.0 s, expected a number above 0"),
    (float("inf"), {}, "advance by inf s, expected a number above 0"),
]


def test_what_cannot_be_set_or_read() -> None:
    run = begin(written(LAG.replace('0.06"', '0.06", max: 100')))
    for seconds, settings, message in REFUSED:
        with pytest.raises(CaseError, match=message):
            run.advance(seconds, **settings)
    with pytest.raises(CaseError, match="no link `zz`, expected e, o"):
        run.speeds["zz"]
    assert (run.time, run.speeds["e"]) == (0, 200)


def test_a_state_is_one_that_a_run_was_in() -> None:
    run = begin(written(LAG))
    before: Any = 3
    with pytest.raises(CaseError, match="state is 3, expected the state of a run"):
        run.state = before
    run.advance(1)
    assert run.time == 1


def test_a_run_that_has_no_way_on_stays_where_it_was() -> None:
    """The condition of a step that must be true within 0.5 s never is."""
    step = '{when: "target < 10", within: 0.5, set: {p: 1}}'
    run = begin(written(f"{LAG}sequences: {{s: [{step}]}}\n"))
    run.advance(0.4)
    with pytest.raises(CaseError, match="did not become true within"):
        run.advance(0.2)
    assert run.time == 0.4
    run.advance(0.2, target=1)
    assert told(run) == [("s", "step")]


@each_seed(4, 60)
def test_random_loops_are_stepped_as_they_run(seed: int) -> None:
    """A loop with integral and lag, advanced by random times."""
    rng = seeded(seed)
    gain, lag, target = rng.uniform(1, 20), rng.uniform(0.02, 0.2), rng.uniform(5, 40)
    scenario = f"""duration: 2
start: {{speeds: {{e: {rng.uniform(100, 300)}, o: {rng.uniform(0, 90)}}}}}
set: {{target: {target}}}
states:
  x: {{rate: "{gain}*(slip('C') - target)", min: -200, max: 300}}
  p: {{rate: "(x + {gain}*(slip('C') - target) - p)/{lag}"}}
controls: {{C: "max(p, 10)"}}
torques: {{e: "{rng.uniform(20, 90)} - 0.1*speed", o: -{rng.uniform(10, 60)}}}
sequences:
  s: {{repeat: true, steps: [{{when: "t >= 0.3", wait: 0.4, set: {{target: "target/2"}}}}]}}
"""
    whole, run = simulated(scenario), begin(written(scenario))
    while run.time < 2:
        run.advance(min(rng.uniform(0.001, 0.2), 2 - run.time))
    is_the_run(run, whole, 1e-8, 1e-7)
