"""Drag of open shift elements is no grip: phases of a shift and bars of elements are without it.

A box of two gears shifts up or down under load, with brake and clutch, or with a freewheel in
place of the brake. Instants by events of the run and by its controls: the oncoming element takes
torque from the instant at which the shift begins, up to the event at which the off-going one slips
or overruns; then the speeds change up to the event at which the oncoming one locks.
"""

from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest

from tests.chance import examples, seeded
from tests.simulation.control.written import simulated
from vstatics import Results, solve
from vstatics.pictures import render
from vstatics.pictures.drawing.style import Style
from vstatics.simulation import Motion, load_scenario, simulate
from vstatics.simulation.pictures.elements import states
from vstatics.simulation.pictures.gears import ShiftPhase, element_sets, gear_pieces, phases
from vstatics.simulation.report.runs.record import recorded

BOX = """
inertias: {{in: 0.3, ring: 0.05, out: 7}}
mechanisms:
  set: {{first: in, second: ring, third: out, ratio: -1.5, efficiency: 0.98}}
shift_elements:
  B: {{{brake}, capacity: 900 N*m{drag_B}}}
  C: {{links: [in, ring], capacity: 700 N*m{drag_C}}}
  D: {{links: [out, ring], capacity: 700 N*m{drag_D}}}
gears: {{low: [{low}], high: [C], idle: [D]}}
load: {{speed: 3000 rpm, torque: 150 N*m}}
"""
SHIFT = """
case: box.yaml
duration: 3
start: {{gear: {before}, speed: {speed} rpm}}
shifts: [{{at: {at}, to: {after}, overlap: {overlap}}}]
torques: {{in: {torque}, out: -{load}}}
"""
FREE = "kind: freewheel"
BRAKE = "links: [ring, housing]"
FREEWHEEL = f"{BRAKE}, {FREE}"


def drag(random: Random) -> str:
    """Drag as a case gives it: a number, a formula of the slip, points of it."""
    size = random.uniform(0.2, 6)
    laws = f"{size:.3f} N*m", f'"{size:.3f} + 2e-3*w"', f'"{size / 200:.5f}*w"'
    points = f"[[0, {size:.3f}], [300, {2 * size:.3f}]]"
    return f", drag: {random.choice([*laws, points])}"


class Texts(NamedTuple):
    """A case, a scenario, and the instants between which its capacities change [s]."""

    case: str
    scenario: str
    begins: float
    ends: float


def shift(random: Random, *, with_drag: bool) -> Texts:
    is_up, is_freewheel = random.random() < 0.6, random.random() < 0.3
    is_freewheel = is_freewheel and is_up
    given: dict[str, Any] = {
        "brake": FREEWHEEL if is_freewheel else BRAKE, "low": "" if is_freewheel else "B",
        "drag_B": "" if is_freewheel else drag(random),
        "drag_C": drag(random), "drag_D": drag(random),
        "before": "low" if is_up else "high", "after": "high" if is_up else "low",
        "speed": random.randint(2500, 4000) if is_up else random.randint(800, 1500),
        "at": round(random.uniform(0.5, 1), 2), "overlap": round(random.uniform(0.2, 0.6), 2),
        "torque": random.randint(100, 200) if is_up else -random.randint(20, 60),
        "load": random.randint(100, 300),
    }  # fmt: skip
    if not with_drag:
        given |= dict.fromkeys(("drag_B", "drag_C", "drag_D"), "")
    begins, ends = given["at"], given["at"] + given["overlap"]
    return Texts(BOX.format(**given), SHIFT.format(**given), begins, ends)


def run(texts: Texts, folder: Path) -> tuple[Results, Motion]:
    path = folder / "shift.yaml"
    for text, name in zip(texts[:2], ("box.yaml", path.name), strict=True):
        (folder / name).write_text(text)
    scenario = load_scenario(path)
    return solve(scenario.case), simulate(scenario)


def shown(results: Results, motion: Motion) -> list[ShiftPhase]:
    sets, rows = element_sets(results), states(motion)
    return phases(sets, motion, gear_pieces(sets, motion, rows), rows)


def expected(motion: Motion, texts: Texts) -> list[tuple[str, float, float]]:
    gone, locked = [event for event in motion.events if event.element in {"B", "C"}][:2]
    assert (gone.event, locked.event) == ("slips", "locks")
    found = [("torque", texts.begins, gone.time), ("inertia", gone.time, locked.time)]
    by_control = gone.word != "overruns"  # a freewheel lets go at once
    if by_control and locked.time < texts.ends:
        found.append(("torque", locked.time, texts.ends))
    return found


@examples(1, 4, 300)
def test_phases_of_random_shifts_are_those_without_drag(tmp_path: Path, examples: int) -> None:
    """Each shift twice: phases by its own events, and the same ones, later or earlier by 10 ms."""
    for seed in range(examples):
        found = []
        for with_drag in (False, True):
            texts = shift(seeded(seed), with_drag=with_drag)
            results, motion = run(texts, tmp_path)
            drawn = [(one.phase, one.start, one.end) for one in shown(results, motion)]
            for one, other in zip(drawn, expected(motion, texts), strict=True):
                assert one[0] == other[0]
                assert one[1:] == pytest.approx(other[1:])
            found.append([one for one in drawn if one[2] - one[1] > 0.02])
            bars = {row.name: (row.slips, row.sticks) for row in states(motion)}
            assert set(bars) == {"B", "C"}
            told = {one["name"]: one for one in recorded(results, motion)["elements"]}
            assert {name: (told[name]["slips"], told[name]["sticks"]) for name in bars} == bars
            assert "slips" not in told["D"]
        without, dragged = found
        for one, other in zip(without, dragged, strict=True):
            assert other[0] == one[0]
            assert other[1:] == pytest.approx(one[1:], abs=0.01)


def test_a_freewheel_that_overruns_under_drag_is_open(tmp_path: Path) -> None:
    """It holds low gear up to the shift, and drags for two seconds after it."""
    random = seeded(0)
    texts = next(
        one for one in (shift(random, with_drag=True) for _ in range(99)) if FREE in one.case
    )
    case = texts.case.replace("kind: freewheel", "kind: freewheel, drag: 2.5 N*m")
    results, motion = run(texts._replace(case=case), tmp_path)
    assert any(event.word == "overruns" for event in motion.events)
    drawn = [(one.phase, one.start, one.end) for one in shown(results, motion)]
    assert drawn == expected(motion, texts)
    brake = next(row for row in states(motion) if row.name == "B")
    assert (brake.slips, brake.sticks[0][0], len(brake.sticks)) == ((), 0.0, 1)


def test_a_freewheel_that_is_overcome_slips() -> None:
    """It holds 30 of the 50 N*m, half of what turns one of two equal wheels back."""
    motion = simulated(
        "duration: 1\nstart: {speeds: {a: 0, b: 0}}\ntorques: {a: -100}\ncontrols: {}\n",
        "links: [a, b]\ninertias: {a: 1, b: 1}\n"
        "shift_elements: {F: {links: [a, b], kind: freewheel, capacity: 30 N*m}}\n",
    )
    [row] = states(motion)
    assert (row.slips, row.sticks) == (((0.0, 1.0),), ())


def test_the_picture_has_these_phases(tmp_path: Path) -> None:
    """`data-phase` in SVG, and titles of bars: D drags for three seconds and has no bar."""
    results, motion = run(shift(seeded(3), with_drag=True), tmp_path)
    svg = render(results, "shift", "svg", Style(), motion=motion)
    text = svg.decode() if isinstance(svg, bytes) else str(svg)
    assert text.count('data-phase="torque"') == 2
    assert "D slips" not in text
