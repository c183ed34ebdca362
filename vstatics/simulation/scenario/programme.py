"""The capacity of each shift element over time: by its control, by shifts, or by its gear."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.errors import CaseError, Problem, listed
from vstatics.model.parts import Friction, Law, OfLoad, ShiftElement
from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.arrays import Floats
from vstatics.numerics.lookup_table import LookupTable
from vstatics.simulation.scenario.laws import Curve, Points, constant
from vstatics.simulation.scenario.parts import Capacity, Scenario


class Look(NamedTuple):
    """What a formula gives, by the time and by all that is seen."""

    at: Callable[[float, Sequence[float]], float]
    along: Callable[[Floats, Floats], Floats]
    """At many times, with what is seen as rows."""


class Programme(NamedTuple):
    """What a shift element can carry over time."""

    curve: Curve
    """Capacity [N*m], or pressure [Pa]; infinite where it holds anything."""
    factor: float = 1.0
    """By which the curve is multiplied."""
    is_dog: bool = False
    """Whether it holds anything or nothing, and joins at once."""
    largest: float | None = None
    """Which the capacity of the case allows. [N*m or Pa]"""
    look: Look | None = None
    """Where more than the time is seen: the value of the curve then."""
    table: LookupTable | None = None
    """Of coefficients of friction by slip and temperature, where these count."""
    rub: Look | None = None
    """The coefficient of the table."""

    def seen_at(self, time: float, seen: Sequence[float]) -> float:
        """What it gives while it sees something: cut at 0, and at what the case allows."""
        assert self.look is not None  # noqa: S101 - it is asked of these alone
        most = math.inf if self.largest is None else self.largest
        made = self.factor * min(max(self.look.at(time, seen), 0.0), most)
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


def _controlled(control: object, element: ShiftElement, case: Transmission) -> Programme:
    if isinstance(control, Capacity):
        pack = element.pack
        factor = control.scale * (pack.per_pressure if pack else 1.0)
        return Programme(control.law, factor, largest=largest_control(element, case))
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
