"""Sequences: steps that wait for what happens, one after the other."""

import math

import pytest

from tests.simulation.control.written import DOG, faults, simulated, steps_of, written
from vstatics.core.errors import path_text
from vstatics.simulation import course, simulate

REST = """duration: 4
start: {speeds: {e: 0, o: 0}}
controls: {C: 0}
torques: {e: 20}
"""
"""The engine runs up with 10 rad/s^2."""


FAST = "speed('e') >= 20 and a == 2"
TIMED = [
    # a step waits for its condition, then for its time
    (f"""up: [{{when: "speed('e') > 7", set: {{a: 1}}}}, {{wait: 0.25, set: {{a: 2}}}},
       {{when: "{FAST}", wait: 0.5, set: {{a: 3}}}}]""",
     [("up", 1, 0.7), ("up", 2, 0.95), ("up", 3, 2.5)]),
    # what is true at once begins at once, and a wait outlasts its condition
    ("early: [{when: \"speed('e') < 5\", wait: 1, set: {a: 1}}]", [("early", 1, 1.0)]),
    # a comparison that is equal goes by the way on which it moves next
    ("""above: [{when: "speed('e') > 0", set: {a: 1}}]
  still: [{when: "speed('o') > 0", set: {a: 2}}]
  equal: [{when: "speed('o') >= 0", set: {a: 3}}]""", [("above", 1, 0.0), ("equal", 1, 0.0)]),
    # in written order, one step at a time, from the first sequence again
    ("""one: [{when: "t >= 1", set: {a: "a + 1"}}, {when: "b > 0.5", set: {a: "a + 10"}}]
  two: [{when: "a > 0.5", set: {b: a}}, {when: "a > 5", set: {b: "b + 100"}}]""",
     [("one", 1, 1.0), ("two", 1, 1.0), ("one", 2, 1.0), ("two", 2, 1.0)]),
]  # fmt: skip


def test_steps_are_done_in_their_order_and_time() -> None:
    for sequences, expected in TIMED:
        motion = simulated(f"{REST}set: {{a: 0, b: 0}}\nsequences:\n  {sequences}\n")
        assert [(one.element, one.step) for one in motion.events] == [one[:2] for one in expected]
        assert {(one.event, one.word) for one in motion.events} == {("step", "step")}
        times = [one[2] for one in expected]
        assert [one.time for one in motion.events] == pytest.approx(times, abs=1e-9)


def test_what_is_not_true_in_time_stops_the_run_and_names_its_step() -> None:
    late = """late: [{when: "t >= 0.5", set: {a: 1}},
         {when: "speed('e') > 30", set: {a: 2}, within: 1.5}]"""
    motion = simulate(written(f"{REST}set: {{a: 0}}\nsequences:\n  {late}\n"))
    assert motion.stopped is not None
    assert "late, step 2" in motion.stopped.message
    assert motion.time[-1] == pytest.approx(2.0, abs=1e-12)
    assert motion.speeds[-1, 0] == pytest.approx(20.0)


def test_a_sequence_that_repeats_begins_again() -> None:
    """A thermostat: up at 0.7 N*m below 5 rad/s, down above 7 rad/s."""
    motion = simulated("""duration: 20
start: {speeds: {e: 0, o: 0}}
controls: {C: 0}
set: {pull: 2}
torques: {e: pull}
sequences:
  hold:
    repeat: true
    steps:
      - {when: "speed('e') > 7", set: {pull: -2}}
      - {when: "speed('e') < 5", set: {pull: 2}}
""")
    times = [time for _, time in steps_of(motion)]
    assert times[:3] == [pytest.approx(one, abs=1e-9) for one in (7.0, 9.0, 11.0)]
    assert [step for step, _ in steps_of(motion)][:4] == [1, 2, 1, 2]


def test_steps_without_end_at_one_instant_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(course, "_MOST_STEPS_AT_ONCE", 50)
    mad = 'mad: {repeat: true, steps: [{when: "t >= 1", set: {a: "a + 1"}}]}'
    stopped = simulate(written(f"{REST}set: {{a: 0}}\nsequences: {{{mad}}}\n")).stopped
    assert stopped is not None
    assert "mad" in stopped.message
    assert "more than 50 steps" in stopped.message


def test_a_step_shifts_and_what_has_a_control_goes_by_that() -> None:
    case = """links: [e, o, m]
inertias: {e: 2, o: 3}
mechanisms: {low: {first: m, second: o, ratio: 2}}
shift_elements:
  C: {links: [e, o], capacity: 100 N*m}
  L: {links: [e, m], capacity: 100 N*m}
gears: {"1": [L], "2": [C]}
"""
    begin = 'duration: 4\nstart: {gear: "1", speed: 100}\ntorques: {e: 20}\n'
    shift = '{when: "speed(\'o\') > 60", shift: {to: "2", overlap: 0.2}}'
    motion = simulated(f"{begin}sequences: {{up: [{shift}]}}\n", case)
    [(_, shifted)] = steps_of(motion)
    # 2 + 3/4 kg*m^2 at the engine: the output reaches 60 when the engine has 120 rad/s
    assert shifted == pytest.approx(20 * (2 + 3 / 4) / 20, abs=1e-9)
    assert [one.element for one in motion.events if one.event == "locks"] == ["C"]
    same = simulated(f'{begin}shifts: [{{at: {shifted!r}, to: "2", overlap: 0.2}}]\n', case)
    assert motion.speeds[-1].tolist() == pytest.approx(same.speeds[-1].tolist(), rel=1e-8)
    assert motion.energy.heat["C"] == pytest.approx(same.energy.heat["C"], rel=1e-7)


def test_a_dog_clutch_closes_and_opens_by_steps() -> None:
    """Equal parts of the momentum, 2*90/5 rad/s, then the engine is alone again."""
    steps = "[{when: \"speed('e') > 90\", dog: {D: closed}}, {wait: 1, dog: {D: open}}]"
    start = "duration: 3\nstart: {speeds: {e: 80, o: 0}}\ntorques: {e: 20}\n"
    motion = simulated(f"{start}sequences: {{join: {steps}}}\n", DOG)
    joined = 2 * 90 / 5
    assert motion.energy.impact == pytest.approx(0.5 * 2 * 90**2 - 0.5 * 5 * joined**2)
    assert motion.speeds[-1].tolist() == pytest.approx([joined + 4 + 10, joined + 4])


CONDITIONS = (
    ("abs(speed('e') - 20) < 0.5", 1.95), ("sqrt(20 - speed('e')) < 1", 1.9),
    ("min(t, 1) >= 1", 1.0), ("t == 1.2 and sin(t) > 0.5", 1.2),
    ("1/t < speed('e')", math.sqrt(0.1)), ("(t > 0.5) + (t > 1.5) >= 2", 1.5),
    ("exp(t) == 3", math.log(3)), ("1/(t - 1) > 5", 1.0), ("not t == 0", 0.0),
    ("min(speed('e'), 10) >= 10", 1.0), ("max(speed('e'), 25) > 25", 2.5),
    ("sqrt(abs(speed('e') - 20)) < 1", 1.9), ("abs(t - 2) < 0.001", 1.999),
    ("sqrt(1.5 - t) < 0.1", 1.49), ("(t > 0.7) - 0.5 > 0", 0.7), ("t == 1.2", 1.2),
    ("speed('e') == 20", 2.0), ("not speed('e') != 20", 2.0), ("abs(speed('e') - 20) == 0", 2.0),
    ("min(sin(t), 0.5) == 0.5", math.asin(0.5)),
    ("sin(100*t) > 0.99999999", math.asin(0.99999999) / 100), ("1/t < 1", 1.0),
    ("1e3*(sin(500*t) - 0.99999) > abs(speed('o'))", math.asin(0.99999) / 500), ("t != 1.2", 0.0),
    ("not speed('e') == 0", 0.0),
)  # fmt: skip
"""Conditions, each with the time at which it becomes true; the speed is 10 t."""


@pytest.mark.parametrize("conditions", [CONDITIONS[:9], CONDITIONS[9:]])
def test_a_condition_that_bends_is_true_when_it_is_first(
    conditions: list[tuple[str, float]],
) -> None:
    for when, at in conditions:
        step = f'{{when: "{when}", set: {{a: 1}}}}'
        motion = simulated(f"{REST}set: {{a: 0}}\nsequences: {{s: [{step}]}}\n")
        assert steps_of(motion) == [(1, pytest.approx(at, abs=1e-9))], when


def test_a_mistake_is_reported_with_its_place() -> None:
    for text, fault in (
        ('set: {a: 0}\nsequences:\n  s: [{when: "t > 1"}]',
         "8:7 sequences.s[1]: read a step with nothing"),
        ("sequences:\n  s: [{set: {b: 1}}]", "sequences.s[1].set.b: read `b`"),
        ("set: {a: 0}\nsequences:\n  s: [{when: \"slip('D') > 1\", set: {a: 1}}]",
         "read `D`, expected a shift element"),
        ('set: {a: 0}\nsequences:\n  s: [{when: "t + 1", set: {a: 1}}]', "expected a condition"),
        ('set: {a: 0}\nsequences:\n  s: [{when: "slip > 1", set: {a: 1}}]',
         "name the link or component, as in slip('C')"),
        ("set: {a: 0}\nsequences:\n  s: [{set: {a: 1}, within: 0}]", "expected a time above 0"),
        ("sequences:\n  s: [{dog: {C: closed}}]", "C is not a dog clutch"),
        ('sequences:\n  s: [{shift: {to: "9"}}]', "expected the name of a gear"),
        ("sequences: {s: []}", "read no steps"),
        ("speeds: {housing: 3}", "speeds.housing: read the housing"),
        ("set: {on: 1}", "is true or false in YAML"),
        ("set: {a: 0}\nnumbers: {a: 1}", "is already the name of something else"),
        ("set: {speed: 0}", "is a word of formulas"),
        ("states: {p: {start: 0}}", "`rate` is missing"),
        ("states: {p: {rate: 1, start: 3, max: 2}}", "expected at most 2, its max"),
        ("states: {p: {rate: 1, max: 2}}\nsequences: {s: [{set: {p: 3}}]}",
         "7:24 sequences.s[1].set.p: read 3, expected at most 2, its max"),
        ("tables: {q: [[1, 0], [0, 1]]}", "expected rows in ascending order"),
        ("tables: {q: {file: missing.csv}}", "cannot be read"),
        ("tables: {q: {columns: [0, 1], rows: [[1, 2, 3], [0, 1, 2]]}}",
         "6:49 tables.q.rows[2]: read 0 after 1"),
        ("tables: {q: {columns: [0, 1], rows: [[0, 1, 2], [1, 2]]}}",
         "6:49 tables.q.rows[2]: read 2 numbers, expected 3"),
        ("tables: {q: {columns: [0, 1], rows: []}}", "read no rows"),
        ("tables: {q: {columns: [], rows: [[1, 2, 3]]}}", "read 3 numbers, expected 2"),
        ("tables: {q: []}", "read no rows"),
    ):  # fmt: skip
        told = faults(REST + text + "\n")
        assert any(fault in one for one in told), told
    [fault] = faults(REST.replace("{C: 0}", "{C: \"torque('C')\"}"))
    assert fault.startswith("4:16")
    assert "which only `rate` and `when` can contain" in fault


def test_what_is_no_number_stops_the_run_and_is_named() -> None:
    for text, identity, path in (
        ('set: {a: 0}\nsequences: {s: [{when: "t > 1", set: {a: 1/a}}]}',
         "E677", "sequences.s[1].set.a"),
        ("set: {a: 0}\nsequences: "
         '{s: [{set: {a: 1}, wait: 1}, {when: "sqrt(t - 2) < 3", set: {a: 1}}]}',
         "E650", "sequences.s[2].when"),
        ('states: {p: {start: 1, rate: "p^2"}}', "E700", "states.p.rate"),
        ('states: {p: {rate: "sqrt(1 - t)"}}', "E700", "states.p.rate"),
        ('speeds: {o: "sqrt(1 - t) - 1"}', "E700", "speeds.o"),
        ("controls: {C: \"sqrt(20 - speed('e'))\"}", "E700", "controls.C"),
    ):  # fmt: skip
        rest = REST.replace("controls: {C: 0}\n", "") if "controls" in text else REST
        stopped = simulate(written(f"{rest}{text}\n")).stopped
        assert stopped is not None
        assert (stopped.id, path_text(stopped.path)) == (identity, path)


def test_a_state_that_a_formula_sets_beyond_its_limits_is_reported_once() -> None:
    """From -1, its min, on it rises with the time: 20 N*m for 3 s, then t - 4 for 1 s."""
    step = '{when: "t >= 3", wait: 0.5, set: {p: "-10*t"}}'
    states = "states: {p: {start: 20, rate: 0, min: -1}}\n"
    repeats = f"sequences: {{s: {{repeat: true, steps: [{step}]}}}}\n"
    motion = simulated(REST.replace("20", "p") + states + repeats)
    [note] = [one.text for one in motion.messages if one.id == "N611"]
    assert note.startswith("at 3.5 s p is set beyond its limits: read -35, expected at least -1")
    assert motion.speeds[-1, 0] == pytest.approx((20 * 3.5 - 0.5) / 2)


def test_formulas_of_one_text_call_each_their_own_table() -> None:
    text = REST.replace("{e: 20}", '{e: "m(t)"}') + "tables: {m: [[0, 20]]}\n"
    ends = [simulated(one).speeds[-1, 0] for one in (text, text.replace("[0, 20]", "[0, 30]"))]
    assert ends == pytest.approx([4 * 20 / 2, 4 * 30 / 2])
