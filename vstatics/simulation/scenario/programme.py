"""Torque capacity of each shift element over time, set by controls, shifts or the gear."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed
from vstatics.core.model.parts import Friction, Law, OfLoad, ShiftElement
from vstatics.core.model.springs import SpringLimit
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.expressions.grammar import Tree
from vstatics.core.readers.expressions.operands import Constant
from vstatics.simulation.scenario.algebra import applied, times
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Points, bends, constant
from vstatics.simulation.scenario.parts import Capacity, Scenario
from vstatics.simulation.tolerances import MADE_CAPACITY


class Look(NamedTuple):
    """Formula as a function of time and of all quantities that formulas can read."""

    at: Callable[[float, Sequence[float]], float]
    along: Callable[[Floats, Floats], Floats]
    """Values at many times; the second argument has a row for each quantity."""
    places: tuple[int, ...] = ()
    """Indices of the quantities that the formula reads, among all quantities."""


class Programme(NamedTuple):
    """Torque capacity of a contact or spring over time."""

    curve: Curve
    """Capacity [N*m] or pressure [Pa]; infinite for a closed dog clutch."""
    factor: float = 1.0
    """Factor of the curve, such as torque per pressure and coefficient of friction."""
    is_dog: bool = False
    """True if the capacity is always unlimited or 0, as in a dog clutch."""
    largest: float | None = None
    """Largest control according to the case, to which feedback control is clipped. [N*m or Pa]"""
    given: Curve | None = None
    """Control over time before it was clipped at the capacity in the case."""
    look: Look | None = None
    """Control as a function of the motion, for feedback control."""
    table: LookupTable | None = None
    """Table of coefficients of friction over slip and temperature."""
    rub: Look | None = None
    """Coefficient of friction from `table`, as a function of the motion."""
    is_mean: bool = False
    """True if `look` is a mean of clipped controls, along which a motion slides."""
    sides: tuple[Look, ...] = ()
    """Control below and above zero slip, if a formula jumps there; else empty."""
    jumps: Collection[tuple[Tree, ...]] = ()
    """Pairs of terms, compared in the formula, that are equal at zero slip."""
    follows: SpringLimit | None = None
    """Torque limit that grows with the torque of another spring; `curve` is its base."""

    def on_side(self, side: float) -> Programme:
        """Return the programme above (`side` = 1) or below (-1) zero slip."""
        return self._replace(look=self.sides[side > 0]) if self.sides else self

    def seen_at(self, time: float, seen: Sequence[float], *, clipped: bool = True) -> float:
        """Return the capacity under feedback control, clipped from 0 to `largest` by default."""
        assert self.look is not None  # noqa: S101 - only for feedback control
        value = self.look.at(time, seen)
        if clipped and not self.is_mean:
            value = min(max(value, 0.0), math.inf if self.largest is None else self.largest)
        capacity = self.factor * value
        return capacity * self.rub.at(time, seen) if self.rub else capacity

    def seen_along(self, times: Floats, seen: Floats) -> Floats:
        """Return the capacity at many times under feedback control, clipped from 0 to `largest`."""
        assert self.look is not None  # noqa: S101 - only for feedback control
        values = self.look.along(times, seen)
        capacity = self.factor * (values if self.is_mean else np.clip(values, 0.0, self.largest))
        return capacity * self.rub.along(times, seen) if self.rub else capacity


OPEN = Programme(constant(0.0))


def programmes(scenario: Scenario, engaged: tuple[int, ...]) -> list[Programme]:
    """Return the capacity over time of each shift element.

    A freewheel has the capacity in the case, or an unlimited capacity. A shift element without a
    control follows the shifts, or remains as at the start.

    Parameters
    ----------
    scenario : Scenario
    engaged : sequence of int
        Numbers of the shift elements that are engaged at the start.

    Raises
    ------
    CaseError
        If the overlap of a shift needs a capacity that the case lacks, or its gear is unknown.
    """
    controls = scenario.controls or {}
    result = []
    problems: list[Problem] = []
    for number, element in enumerate(scenario.case.shift_elements, 1):
        control = controls.get(number)
        if element.is_freewheel:
            held = newton_metres(element.capacity, scenario.case)
            factor = 1 / friction_at(element.pack)
            result.append(Programme(constant(math.inf if held is None else held), factor))
        elif control is not None:
            controlled = _controlled(control, element, scenario.case, engaged=number in engaged)
            result.append(controlled)
        else:
            try:
                result.append(_shifted(number, element, scenario, engaged=number in engaged))
            except CaseError as error:
                problems += error.problems
    if problems:
        raise CaseError(problems)
    for index, element in enumerate(scenario.case.shift_elements):
        table = element.pack.table if element.pack and not result[index].is_dog else None
        if table is not None:
            slips, values = zip(*((row[0], row[1:]) for row in table.rows), strict=True)
            result[index] = result[index]._replace(table=LookupTable(slips, values, table.columns))
    return result


def newton_metres(number: float | None, case: Transmission) -> float | None:
    """Return a capacity or a drag torque of a case [N*m].

    A number without a unit is relative to the torque of `load`. Without a `load` it is in N*m.
    """
    if number is None:
        return None
    if isinstance(number, OfLoad):
        return abs(number.given)
    return abs(number * (load_torque(case) or 1.0))


def load_torque(case: Transmission) -> float | None:
    """Return the torque of `load`, if any, to which torques without a unit are relative [N*m]."""
    return case.load.torque if case.load else None


def bare_capacities(case: Transmission) -> Iterator[Problem]:
    """Yield a note that capacities without a unit are in N*m if the case has no load."""
    bare = [
        number
        for number, element in enumerate(case.shift_elements, 1)
        if element.capacity is not None and not isinstance(element.capacity, OfLoad)
    ]
    if bare and not load_torque(case):
        names = listed([case.shift_elements[number - 1].name for number in bare], 6)
        yield Problem(
            "N603",
            "the case has no `load` with a torque, so a capacity without a unit is in N*m "
            f"({names})",
            ("case", "shift_elements", bare[0], "capacity"),
        )


def friction_at(friction: Friction | Law | None, slip: float = 0.0) -> float:
    """Return the coefficient of friction at a slip [rad/s], or a drag [N*m]; 1 without friction."""
    if friction is None:
        return 1.0
    if isinstance(friction, Law):
        return float(friction.at(abs(slip)))
    return friction_points(friction).at(abs(slip))


def friction_points(friction: Friction | Law) -> Points:
    """Return the coefficient of friction, or the drag, over the slip."""
    slips, values = zip(*friction.points, strict=True)
    return Points(slips, values, "speed")


def largest_control(element: ShiftElement, case: Transmission) -> float | None:
    """Return the control that reaches the capacity in the case [N*m, or Pa with `friction`]."""
    largest, pack = newton_metres(element.capacity, case), element.pack
    if largest is None or pack is None:
        return largest
    return largest / (pack.per_pressure * friction_at(pack))


def cut_controls(scenario: Scenario) -> Iterator[Problem]:
    """Yield a note on each control over time that is clipped at the capacity in the case."""
    for number, control in (scenario.controls or {}).items():
        element = scenario.case.shift_elements[number - 1]
        most = largest_control(element, scenario.case)
        if most is None or not isinstance(control, Capacity):
            continue
        law = _scaled(control)
        if isinstance(law, Formula) and law.seen:
            continue
        turns = sorted(bends(within(law, most), scenario.duration))
        whens = [0.0, *(time for time in turns if 0 < time < scenario.duration), scenario.duration]
        for first, last in pairwise(whens):
            if law.at(first / 2 + last / 2) > most * (1 + MADE_CAPACITY):
                note = cut_note(first, element.name, most)
                yield Problem("N605", note, ("controls", element.name))
                break


def cut_note(time: float, name: str, largest: float) -> str:
    """Return the note about a control that is clipped from a time on [s]."""
    return (
        f"at {time:.6g} s the control of {name} is above the capacity in the case, {largest:g}: "
        "it is limited to this capacity from then on"
    )


def within(law: Curve, largest: float) -> Curve:
    """Return a curve clipped to the range from 0 to `largest`.

    >>> within(Points((0.0, 4.0), (-10.0, 30.0)), 20.0)
    Points(x=(0.0, 1.0, 3.0, 4.0), y=(0.0, 0.0, 20.0, 20.0), over='time')
    """
    if isinstance(law, Formula):
        above = applied("max", law.whole, Constant(0.0))
        return law._replace(tree=applied("min", above, Constant(largest)))
    points = [(law.x[0], law.y[0])]
    for (x, y), (later, later_value) in pairwise(zip(law.x, law.y, strict=True)):
        passed = [
            bound for bound in (0.0, largest) if min(y, later_value) < bound < max(y, later_value)
        ]
        points += sorted(
            (x + (bound - y) / (later_value - y) * (later - x), bound) for bound in passed
        )
        points.append((later, later_value))
    at, values = zip(*points, strict=True)
    return Points(at, tuple(min(max(bound, 0.0), largest) for bound in values))


def bounded(law: Curve, factor: float = 1.0, largest: float | None = None) -> Programme:
    """Return the programme of a control or limit over time, clipped from 0 to `largest`."""
    if isinstance(law, Formula) and law.seen:
        return Programme(law, factor, largest=largest)
    return Programme(within(law, math.inf if largest is None else largest), factor, given=law)


def _scaled(control: Capacity) -> Curve:
    law, scale = control
    if isinstance(law, Points):
        return Points(law.x, tuple(scale * value for value in law.y))
    return law._replace(tree=times(Constant(scale), law.whole))


def _controlled(
    control: object, element: ShiftElement, case: Transmission, *, engaged: bool
) -> Programme:
    if isinstance(control, Capacity):
        factor = element.pack.per_pressure if element.pack else 1.0
        return bounded(_scaled(control), factor, largest_control(element, case))
    times: list[float] = []
    held: list[float] = []
    for time, closed in getattr(control, "points", ()):
        first = math.inf if engaged and not closed else 0.0  # closed until it opens
        times += [time, time]
        held += [held[-1] if held else first, math.inf if closed else 0.0]
    if not times:
        return OPEN
    skipped = 0 if times[0] > 0 else 1
    return Programme(Points(tuple(times[skipped:]), tuple(held[skipped:])), is_dog=True)


def _shifted(number: int, element: ShiftElement, scenario: Scenario, *, engaged: bool) -> Programme:
    """Return the capacity over time of a shift element that the shifts engage and release."""
    held = newton_metres(element.capacity, scenario.case)
    anything = held is None or element.kind == "dog_clutch"
    capacity = math.inf if held is None or anything else held
    points = [(0.0, capacity if engaged else 0.0)]
    for index, (at, name, overlap) in enumerate(scenario.shifts or (), 1):
        try:
            gear = scenario.case.gears[scenario.case.gear_number(name) - 1]
        except ValueError as error:
            raise CaseError("E662", str(error), ("shifts", index, "to")) from None
        target = capacity if number in gear.engaged else 0.0
        now = _value_before(points, at)
        earlier = [point for point in points if point[0] < at]
        moment = at + overlap
        if now == target and all(value == target for time, value in points if time >= at):
            points = [*earlier, (at, now)] if earlier else points
        elif not anything:
            points = [*earlier, (at, now), (moment, target)]
        elif overlap and element.kind != "dog_clutch":
            raise CaseError(
                "E661",
                f"{element.name} has no capacity in the case, so it cannot change over "
                f"{overlap:g} s: give it a `capacity` there, or an overlap of 0",
                ("shifts", index),
            )
        else:
            moment = moment if target else at
            points = [*earlier, (at, now), (moment, now), (moment, target)]
    # the capacity in the case already contains the coefficient of friction at zero slip
    factor = 1.0 if anything else 1 / friction_at(element.pack)
    times, capacities = zip(*points, strict=True)
    return Programme(Points(times, capacities), factor, is_dog=anything)


def _value_before(points: list[tuple[float, float]], time: float) -> float:
    before = [point for point in points if point[0] < time]
    after = [point for point in points if point[0] >= time]
    if not before:
        return points[0][1]
    if not after or before[-1][1] == after[0][1]:
        return before[-1][1]
    (t0, v0), (t1, v1) = before[-1], after[0]
    return v0 + (v1 - v0) * (time - t0) / (t1 - t0)
