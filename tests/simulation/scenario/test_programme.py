"""What shift elements can carry, what they do that no control moves, the order of shifts."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import CASES, vstatics
from tests.simulation.boxes import held
from tests.simulation.test_closed_forms import links
from tests.simulation.test_golden import happened
from vstatics import CaseError, Gear, ShiftElement, Transmission
from vstatics.core import readers
from vstatics.core.model.parts import OfLoad
from vstatics.simulation import Motion, Points, Scenario, Shift, Start, constant, simulate
from vstatics.simulation.scenario.checks import scenario_doubts
from vstatics.simulation.scenario.programme import programmes

WHEEL = """\
links: [wheel]
inertias: {{wheel: 2}}
shift_elements: {{B: {{links: [wheel, housing], capacity: {capacity}}}}}
gears: {{n: [], held: [B]}}
{load}
"""


def wheel(capacity: str, load: str = "") -> Transmission:
    return readers.read(WHEEL.format(capacity=capacity, load=load).encode(), "wheel.yaml").case


@pytest.mark.parametrize(
    ("capacity", "load"),
    [("40", ""), ("40 N*m", ""), ("2", "load: {torque: 20 N*m}"), ("2", "load: {torque: -20 N*m}")],
)
def test_a_brake_of_40_newton_metres_stops_a_wheel(capacity: str, load: str) -> None:
    """2 kg*m^2 at 10 rad/s have 100 J and stop after 2 10/40 s, however the capacity is given."""
    case = wheel(capacity, load)
    motion = simulate(Scenario(case, 1.0, Start("n", 10.0), shifts=(Shift(0.0, "held"),)))
    assert [(one.event, round(one.time, 9)) for one in motion.events] == [("locks", 0.5)]
    assert motion.energy.heat["B"] == pytest.approx(100, rel=1e-12)


def test_a_note_says_that_a_capacity_without_a_unit_is_in_newton_metres(folder: Path) -> None:
    held = Start("held", 0.0)
    [told] = simulate(Scenario(wheel("40"), 1.0, held)).messages
    assert (told.severity, "N*m (B)" in told.text) == ("note", True)
    for case in (wheel("40 N*m"), wheel("2", "load: {torque: 20 N*m}")):
        assert simulate(Scenario(case, 1.0, held)).messages == ()
    (folder / "wheel.yaml").write_text(WHEEL.format(capacity="40", load=""), "utf-8")
    scenario = "{case: wheel.yaml, duration: 1, start: {gear: held, speed: 0}}"
    (folder / "stop.yaml").write_text(scenario, "utf-8")
    said = vstatics("check", "stop.yaml")
    assert said.status == 0
    assert said.err.startswith("wheel.yaml:3:57: note: shift_elements.B.capacity: the case has no")


@pytest.mark.parametrize("more", ["drag: {wheel: 2}", ""])
def test_drag_without_a_unit_and_without_a_load_is_an_error_at_its_place(more: str) -> None:
    element = "B: {links: [wheel, housing]" + ("}" if more else ", drag: 2}")
    text = f"links: [wheel]\ninertias: {{wheel: 2}}\nshift_elements: {{{element}}}\n{more}\n"
    read = readers.read(text.encode(), "wheel.yaml")
    with pytest.raises(CaseError) as caught:
        simulate(Scenario(read.case, 1.0, Start(speeds={1: 10.0})))
    [problem] = caught.value.problems
    assert "is 2 of the input torque" in problem.message
    located = read.locate(problem._replace(path=problem.path[1:]))
    assert located.place is not None
    assert located.place.line == (4 if more else 3)


@pytest.mark.parametrize("path", sorted(CASES.glob("*.yaml")), ids=lambda path: path.stem)
def test_no_shipped_case_has_a_capacity_that_is_no_number(path: Path) -> None:
    """In every gear and shift, with its load and without one; infinite is what holds anything."""
    case = readers.load(path)
    for one in (case, case.replace(load=None)):
        shifts = tuple(Shift(float(number), gear.name) for number, gear in enumerate(one.gears))
        scenario = Scenario(one, 99.0, Start(one.gears[0].name, 1.0), shifts=shifts)
        for programme in programmes(scenario, tuple(one.gears[0].engaged)):
            assert isinstance(programme.curve, Points)
            assert not np.isnan([*programme.curve.y, programme.factor]).any()


def dual_clutch() -> Transmission:
    """Engine of .5 kg*m^2 and vehicle of 4.5; each clutch of 600 N*m joins them."""
    clutches = [ShiftElement(1, 2, name, capacity=OfLoad(600.0, 1.0)) for name in ("A", "B")]
    gears = [Gear([1], name="odd"), Gear([2], name="even"), Gear(name="open")]
    return links(0.5, 4.5, elements=tuple(clutches)).replace(gears=gears)


def driven(start: Start, controls: Any = None, shifts: Any = None) -> Motion:
    """100 N*m on the engine for a second."""
    torques = ((1, constant(100.0)),)
    return simulate(Scenario(dual_clutch(), 1.0, start, controls, torques, shifts=shifts))


def test_an_element_of_the_start_stays_where_no_control_moves_it() -> None:
    """All turns as one, with the capacity of the case: 100 N*m on 5 kg*m^2 for 1 s."""
    for start in (Start("odd", 50.0), Start(speeds={1: 50.0}, engaged=(1,))):
        motion = driven(start, {2: held(0)})
        assert not motion.events
        assert motion.speeds[-1] == pytest.approx([70.0, 70.0], rel=1e-12)
        assert motion.peaks["A"].torque == pytest.approx(100 * 4.5 / 5)


def test_what_no_start_engages_or_a_control_of_0_opens_is_open() -> None:
    """The engine alone: 100 N*m on .5 kg*m^2."""
    motion = driven(Start("odd", 50.0), {1: held(0)})
    assert motion.speeds[-1] == pytest.approx([250.0, 50.0], rel=1e-12)
    motion = driven(Start(speeds={1: 50.0, 2: 0.0}), {2: held(0)})
    assert motion.speeds[-1] == pytest.approx([250.0, 0.0], rel=1e-12)


@pytest.mark.parametrize("last", ["odd", "open"])
def test_of_shifts_at_one_time_the_last_that_is_written_holds(last: str) -> None:
    first = "open" if last == "odd" else "odd"
    shifts = Shift(0.5, "even"), Shift(0.5, first), Shift(0.5, last)
    motion = driven(Start("odd", 50.0), shifts=shifts)
    engine = 50 + 10 + (10 if last == "odd" else 100)
    assert motion.speeds[-1, 0] == pytest.approx(engine, rel=1e-12)
    slips = [("A", "slips", 0.5)] if last == "open" else []
    assert happened(motion) == slips


def test_a_shift_that_begins_at_the_end_or_later_is_doubtful() -> None:
    shifts = Shift(0.5, "even"), Shift(1.0, "odd"), Shift(2.0, "open")
    scenario = Scenario(dual_clutch(), 1.0, Start("odd"), shifts=shifts)
    told = [(one.id, one.path) for one in scenario_doubts(scenario)]
    assert told == [("W603", ("shifts", number, "at")) for number in (2, 3)]
