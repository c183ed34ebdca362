"""The capacity of each shift element over time: by its control, by shifts, or by its gear."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed
from vstatics.core.model.parts import Friction, Law, OfLoad, ShiftElement
from vstatics.core.model.springs import SpringLimit
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import applied, times
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Points, bends, constant
from vstatics.simulation.scenario.parts import Capacity, Scenario
from vstatics.simulation.tolerances import MADE_CAPACITY


class Look(NamedTuple):
    """What a formula gives, by the time and by all that is seen."""

    at: Callable[[float, Sequence[float]], float]
    along: Callable[[Floats, Floats], Floats]
    """At many times, with what is seen as rows."""
    places: tuple[int, ...] = ()
    """What of all that it sees."""


class Programme(NamedTuple):
    """What a shift element can carry over time."""

    curve: Curve
    """Capacity [N*m], or pressure [Pa]; infinite where it holds anything."""
    factor: float = 1.0
    """By which the curve is multiplied."""
    is_dog: bool = False
    """Whether it holds anything or nothing, and joins at once."""
    largest: float | None = None
    """Which the capacity of the case allows, of a control that sees something. [N*m or Pa]"""
    given: Curve | None = None
    """The control of which the curve is what the case allows."""
    look: Look | None = None
    """Where more than the time is seen: the value of the curve then."""
    table: LookupTable | None = None
    """Of coefficients of friction by slip and temperature, where these count."""
    rub: Look | None = None
    """The coefficient of the table."""
    follows: SpringLimit | None = None
    """Of a limit by the torque of another spring: its base is the curve."""

    def seen_at(self, time: float, seen: Sequence[float]) -> float:
        """What it gives while it sees something: cut at 0, and at what the case allows."""
        assert self.look is not None  # noqa: S101 - it is asked of these alone
        most = math.inf if self.largest is None else self.largest
        made = self.factor * min(max(self.look.at(time, seen), 0.0), most)
        return made * self.rub.at(time, seen) if self.rub else made

    def uncut_at(self, time: float, seen: Sequence[float]) -> float:
        """The same without any cut."""
        assert self.look is not None  # noqa: S101 - it is asked of these alone
        made = self.factor * self.look.at(time, seen)
        return made * self.rub.at(time, seen) if self.rub else made

    def seen_along(self, times: Floats, seen: Floats) -> Floats:
        """The same at many times, with what is seen as rows."""
        assert self.look is not None  # noqa: S101 - it is asked of these alone
        made: Floats = self.factor * np.clip(self.look.along(times, seen), 0.0, self.largest)
        return made * self.rub.along(times, seen) if self.rub else made


OPEN = Programme(constant(0.0))
HOLDS = Programme(constant(math.inf), is_dog=True)


def programmes(scenario: Scenario, engaged: tuple[int, ...]) -> list[Programme]:
    """The programme of each shift element; that of a freewheel is its capacity.

    What no control moves stays as the start has it, or goes by the shifts.

    Parameters
    ----------
    scenario : Scenario
    engaged : sequence of int
        Numbers of the shift elements that are engaged at the start.

    Raises
    ------
    CaseError
        Of a shift whose elements have no capacity to be moved, of an unknown gear.
    """
    controls = scenario.controls or {}
    found = []
    problems: list[Problem] = []
    for number, element in enumerate(scenario.case.shift_elements, 1):
        control = controls.get(number)
        if element.is_freewheel:
            held = newton_metres(element.capacity, scenario.case)
            factor = 1 / friction_at(element.pack)
            found.append(Programme(constant(math.inf if held is None else held), factor))
        elif control is not None:
            found.append(_controlled(control, element, scenario.case))
        else:
            try:
                found.append(_shifted(number, element, scenario, engaged=number in engaged))
            except CaseError as error:
                problems += error.problems
    if problems:
        raise CaseError(problems)
    return [*map(_warmed, found, scenario.case.shift_elements)]


def _warmed(programme: Programme, element: ShiftElement) -> Programme:
    """With its coefficients by temperature, if it rubs and they do depend on it."""
    table = element.pack.table if element.pack and not programme.is_dog else None
    if table is None:
        return programme
    slips, values = zip(*((row[0], row[1:]) for row in table.rows), strict=True)
    return programme._replace(table=LookupTable(slips, values, table.columns))


def newton_metres(number: float | None, case: Transmission) -> float | None:
    """A capacity or a drag of a case as a torque [N*m].

    Without a unit it is relative to the torque of the load; where there is none it is in N*m.
    """
    if number is None:
        return None
    if isinstance(number, OfLoad):
        return abs(number.given)
    return abs(number * (load_torque(case) or 1.0))


def load_torque(case: Transmission) -> float | None:
    """To which torques without a unit are related [N*m]; None where the case tells none."""
    return case.load.torque if case.load else None


def bare_capacities(case: Transmission) -> Iterator[Problem]:
    """A note on capacities without a unit that are taken in N*m, as there is no load."""
    bare = [
        number
        for number, one in enumerate(case.shift_elements, 1)
        if one.capacity is not None and not isinstance(one.capacity, OfLoad)
    ]
    if bare and not load_torque(case):
        names = listed([case.shift_elements[number - 1].name for number in bare], 6)
        why = "the case has no `load` with a torque"
        message = f"{why}, so a capacity without a unit is in N*m ({names})"
        path = ("case", "shift_elements", bare[0], "capacity")
        yield Problem("N603", message, path)


def friction_at(friction: Friction | Law | None, slip: float = 0.0) -> float:
    """The coefficient of friction at a slip [rad/s], a drag [N*m]; 1 of what has no pack."""
    if friction is None:
        return 1.0
    if isinstance(friction, Law):
        torque: float = friction.at(abs(slip))
        return torque
    return friction_points(friction).at(abs(slip))


def friction_points(friction: Friction | Law) -> Points:
    """The coefficient of friction, or the drag, over the slip."""
    slips, values = zip(*slip_points(friction), strict=True)
    return Points(slips, values, "speed")


def slip_points(friction: Friction | Law | None) -> tuple[tuple[float, float], ...]:
    """Slips with what there is at each; none of a formula."""
    if friction is None or isinstance(friction, Law):
        return () if friction is None else friction.points
    return friction.points


def largest_control(element: ShiftElement, case: Transmission) -> float | None:
    """What a control may give at most by the capacity of the case [N*m]; with a pack [Pa]."""
    largest, pack = newton_metres(element.capacity, case), element.pack
    if largest is None or pack is None:
        return largest
    return largest / (pack.per_pressure * friction_at(pack))


def cut_controls(scenario: Scenario) -> Iterator[Problem]:
    """A note on each control that follows from the time and is cut at the capacity of the case."""
    for number, control in (scenario.controls or {}).items():
        element = scenario.case.shift_elements[number - 1]
        most = largest_control(element, scenario.case)
        if most is None or not isinstance(control, Capacity):
            continue
        law = _scaled(control)
        if isinstance(law, Formula) and law.seen:
            continue
        turns = sorted(bends(within(law, most), scenario.duration))
        whens = [0.0, *(one for one in turns if 0 < one < scenario.duration), scenario.duration]
        for first, last in pairwise(whens):
            if law.at(first / 2 + last / 2) > most * (1 + MADE_CAPACITY):
                note = cut_note(first, element.name, most)
                yield Problem("N605", note, ("controls", element.name))
                break


def cut_note(time: float, name: str, largest: float) -> str:
    """What is said of a control that is cut from a time on [s]."""
    return (
        f"at {time:.6g} s the control of {name} is above the capacity in the case, {largest:g}: "
        "it is cut there, then and later"
    )


def within(law: Curve, largest: float) -> Curve:
    """A control as it acts: 0 where it is below, and no more than the case allows.

    >>> within(Points((0.0, 4.0), (-10.0, 30.0)), 20.0)
    Points(x=(0.0, 1.0, 3.0, 4.0), y=(0.0, 0.0, 20.0, 20.0), over='time')
    """
    if isinstance(law, Formula):
        above = applied("max", law.whole, Constant(0.0))
        return law._replace(tree=applied("min", above, Constant(largest)))
    points = [(law.x[0], law.y[0])]
    for (x, y), (later, other) in pairwise(zip(law.x, law.y, strict=True)):
        passed = [one for one in (0.0, largest) if min(y, other) < one < max(y, other)]
        points += sorted((x + (one - y) / (other - y) * (later - x), one) for one in passed)
        points.append((later, other))
    at, values = zip(*points, strict=True)
    return Points(at, tuple(min(max(one, 0.0), largest) for one in values))


def bounded(law: Curve, factor: float = 1.0, largest: float | None = None) -> Programme:
    """The programme of a control, or of a limit, as it acts."""
    if isinstance(law, Formula) and law.seen:
        return Programme(law, factor, largest=largest)
    acts = within(law, math.inf if largest is None else largest)
    return Programme(acts, factor, given=law)


def _scaled(control: Capacity) -> Curve:
    """The law of a control, multiplied."""
    law, scale = control
    if isinstance(law, Points):
        return Points(law.x, tuple(scale * one for one in law.y))
    return law._replace(tree=times(Constant(scale), law.whole))


def _controlled(control: object, element: ShiftElement, case: Transmission) -> Programme:
    if isinstance(control, Capacity):
        factor = element.pack.per_pressure if element.pack else 1.0
        return bounded(_scaled(control), factor, largest_control(element, case))
    times: list[float] = []
    held: list[float] = []
    for time, closed in getattr(control, "points", ()):
        before = held[-1] if held else 0.0
        times += [time, time]
        held += [before, math.inf if closed else 0.0]
    if not times:
        return OPEN
    first = 0 if times[0] > 0 else 1
    return Programme(Points(tuple(times[first:]), tuple(held[first:])), is_dog=True)


def _shifted(number: int, element: ShiftElement, scenario: Scenario, *, engaged: bool) -> Programme:
    """Of an element that is moved by shifts; what is on its way is taken from where it is."""
    held = newton_metres(element.capacity, scenario.case)
    anything = held is None or element.kind == "dog_clutch"
    capacity = math.inf if held is None or anything else held
    points = [(0.0, capacity if engaged else 0.0)]
    for index, (at, name, overlap) in enumerate(scenario.shifts or (), 1):
        gear = _gear(scenario.case, name, index)
        target = capacity if number in gear.engaged else 0.0
        now = _at(points, at)
        kept = [point for point in points if point[0] < at]
        moment = at + overlap
        if now == target and all(value == target for time, value in points if time >= at):
            points = [*kept, (at, now)] if kept else points
        elif not anything:
            points = [*kept, (at, now), (moment, target)]
        elif overlap and element.kind != "dog_clutch":
            message = (
                f"{element.name} has no capacity in the case, so it can't change over "
                f"{overlap:g} s: give it a `capacity` there, or an overlap of 0"
            )
            raise CaseError("E661", message, ("shifts", index))
        else:
            moment = moment if target else at
            points = [*kept, (at, now), (moment, now), (moment, target)]
    # the capacity of the case is that at the begin of slip, whatever the pack
    factor = 1.0 if anything else 1 / friction_at(element.pack)
    times, capacities = zip(*points, strict=True)
    return Programme(Points(times, capacities), factor, is_dog=anything)


def _at(points: list[tuple[float, float]], time: float) -> float:
    """The value just before a time, of points that may be infinite."""
    before = [point for point in points if point[0] < time]
    after = [point for point in points if point[0] >= time]
    if not before:
        return points[0][1]
    if not after or before[-1][1] == after[0][1]:
        return before[-1][1]
    (t0, v0), (t1, v1) = before[-1], after[0]
    return v0 + (v1 - v0) * (time - t0) / (t1 - t0)


def _gear(case: Transmission, name: str, index: int) -> Gear:
    try:
        return case.gears[case.gear_number(name) - 1]
    except ValueError as error:
        raise CaseError("E662", str(error), ("shifts", index, "to")) from None
