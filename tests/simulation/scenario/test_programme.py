"""What shift elements do that no control moves, in which order shifts are taken."""

from __future__ import annotations

import pytest

from tests.simulation.boxes import held
from tests.simulation.test_closed_forms import links
from tests.simulation.test_golden import happened
from vstatics.model.parts import OfLoad
from vstatics.model.transmission import Gear, ShiftElement, Transmission
from vstatics.simulation import simulate
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.scenario.checks import scenario_doubts
from vstatics.simulation.scenario.laws import constant
from vstatics.simulation.scenario.parts import Control, Scenario, Shift, Start


def dual_clutch() -> Transmission:
    """Engine of .5 kg*m^2 and vehicle of 4.5; each clutch of 600 N*m joins them."""
    clutches = [ShiftElement(1, 2, name, capacity=OfLoad(600.0, 1.0)) for name in ("A", "B")]
    gears = [Gear([1], name="odd"), Gear([2], name="even"), Gear(name="open")]
    return links(0.5, 4.5, elements=tuple(clutches)).replace(gears=gears)


def driven(
    start: Start,
    controls: dict[int, Control] | None = None,
    shifts: tuple[Shift, ...] | None = None,
) -> Motion:
    """100 N*m on the engine for a second."""
    torques = ((1, constant(100.0)),)
    return simulate(Scenario(dual_clutch(), 1.0, start, controls, torques, shifts=shifts))


@pytest.mark.parametrize(
    "start", [Start("odd", 50.0), Start(speeds={1: 50.0}, engaged=(1,))], ids=["gear", "engaged"]
)
def test_an_element_of_the_start_stays_where_no_control_moves_it(start: Start) -> None:
    """All turns as one, with the capacity of the case: 100 N*m on 5 kg*m^2 for 1 s."""
    motion = driven(start, {2: held(0)})
    assert not motion.events
    assert motion.speeds[-1] == pytest.approx([70.0, 70.0], rel=1e-12)
    assert motion.peaks["A"].torque == pytest.approx(100 * 4.5 / 5)


def test_an_element_of_the_start_opens_by_a_control_of_0() -> None:
    """The engine alone: 100 N*m on .5 kg*m^2."""
    motion = driven(Start("odd", 50.0), {1: held(0)})
    assert motion.speeds[-1] == pytest.approx([250.0, 50.0], rel=1e-12)


def test_what_the_start_does_not_engage_is_open() -> None:
    motion = driven(Start(speeds={1: 50.0, 2: 0.0}), {2: held(0)})
    assert motion.speeds[-1] == pytest.approx([250.0, 0.0], rel=1e-12)


@pytest.mark.parametrize("last", ["odd", "open"])
def test_of_shifts_at_one_time_the_last_that_is_written_holds(last: str) -> None:
    """Whatever their names: by these `even` would come first."""
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
    assert [str(one) for one in scenario_doubts(scenario)] == [
        "shifts[2].at: begins at 1 s, but the scenario ends at 1 s: it never happens",
        "shifts[3].at: begins at 2 s, but the scenario ends at 1 s: it never happens",
    ]
