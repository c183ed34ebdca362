"""Conversion of the values in a document to a scenario, with plain floats in SI units.

The key of a value, and the case, determine which units are allowed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from vstatics.core.errors import Path, Problem, count_of, quoted
from vstatics.core.model.converters import converters_of
from vstatics.core.model.part_checks import no_unit
from vstatics.core.model.parts import ShiftElement
from vstatics.core.model.shape import STRAIGHT, UNIT_OF, InUnit, Measure
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.named.nodes import Spots
from vstatics.simulation.scenario.distribution import Distribution
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.given import GivenControl, GivenLaw, GivenSteps, GivenTable
from vstatics.simulation.scenario.laws import (
    Curve,
    Over,
    Points,
    Resistance,
    Road,
    TorqueLaw,
    WheelRadius,
    constant,
)
from vstatics.simulation.scenario.parts import (
    Capacity,
    Control,
    ControlState,
    Dog,
    Scenario,
    SequenceStep,
    Shift,
    Start,
    StaticTorque,
    StepSequence,
)
from vstatics.simulation.scenario.table_call import UNREADABLE
from vstatics.simulation.scenario.words import elastic_names

_OVER: Mapping[str, Measure] = {"time": "time", "speed": "si_speed", "angle": "angle"}
Turning = Callable[[float], float]
"""Function from vehicle speed [m/s] to the speed of a link [rad/s]."""
FASTEST_WITHOUT_UNIT = 1000.0
"""Largest plausible start speed, 9,549 rpm; a larger number was probably meant in rpm. [rad/s]"""
_STRAIGHT = ", since the link moves straight"


class ScenarioValues:
    """Builder of a scenario, which reports units that do not fit.

    Parameters
    ----------
    case : Transmission
    spots : Spots
        Positions in the document of the scenario, which also collect problems.
    """

    def __init__(self, case: Transmission, spots: Spots) -> None:
        self.case = case
        self.spots = spots
        self.turning: dict[int, Turning] = dict.fromkeys(case.masses, float)
        self.doubts: list[Problem] = []

    def scenario(self, values: Mapping[str, Any]) -> Scenario:
        """Return the scenario described by the values of a document."""
        torques = tuple(self._torques(values.get("torques", {})))
        self.turning |= {link: law.turning for link, law in torques if isinstance(law, Road)}
        controls, shifts = values.get("controls"), values.get("shifts")
        return Scenario(
            self.case,
            float(values["duration"]),
            self._start(values.get("start") or {}),
            None if controls is None else dict(self._controls(controls)),
            torques,
            converters_of(values.get("converters", {})) or tuple(self.case.converters),
            None if shifts is None else tuple(_shift(shift, shift["at"]) for shift in shifts),
            {
                link: self._speeds(given, link, ("targets", link))
                for link, given in values.get("targets", {}).items()
            },
            settings={name: float(value) for name, value in values.get("set", {}).items()},
            states=tuple(_state(name, state) for name, state in values.get("states", {}).items()),
            sequences=tuple(self._sequences(values.get("sequences", {}))),
            speeds={
                link: self._given_speed(speed, link)
                for link, speed in values.get("speeds", {}).items()
            },
            limits={
                number: self._curve(limit, self._limit_measure(number), ("limits", number))
                for number, limit in values.get("limits", {}).items()
            },
            static=_static(values.get("static")),
            speed_ratios={
                number: _ratios(ratio) for number, ratio in values.get("speed_ratios", {}).items()
            },
        )

    def tables(self, given: Mapping[str, Any]) -> Iterator[tuple[str, LookupTable]]:
        """Yield each lookup table with its name; unreadable tables contain zeros."""
        for number, (name, table) in enumerate(given.items(), 1):
            if isinstance(table, GivenTable) and table.file:
                yield name, self._table_file(table.file, ("tables", number, "file"))
            elif isinstance(table, GivenTable):
                columns = _floats(table.columns) or (0.0,)
                yield name, self._table(columns, table.rows, ("tables", number, "rows"))
            elif isinstance(table, Sequence):
                yield name, self._table((0.0,), table, ("tables", number))
            else:
                yield name, LookupTable((0.0,), ((float(table or 0.0),),))

    def _table(
        self, columns: tuple[float, ...], rows: Sequence[Sequence[float]], path: Path
    ) -> LookupTable:
        """Return a table from rows of x and values; missing rows become a row of zeros."""
        unreadable = {*self.spots.unreadable}
        is_known = unreadable.isdisjoint((path[:2], (*path[:2], "columns")))
        if not rows and is_known:
            self.spots.tell(path, "read no rows, expected at least one")
        for number, row in enumerate(rows, 1):
            if is_known and len(row) != len(columns) + 1 and (*path, number) not in unreadable:
                self.spots.tell(
                    (*path, number),
                    f"read {count_of('number', len(row))}, expected {len(columns) + 1}: x, "
                    "and a value for each column",
                )
        read = [_floats(row) for row in rows if len(row) == len(columns) + 1]
        read = read or [(0.0,) * (len(columns) + 1)]
        return LookupTable(tuple(x for x, *_ in read), tuple(row[1:] for row in read), columns)

    def _table_file(self, name: str, path: Path) -> LookupTable:
        from vstatics.simulation.scenario.table_files import table_of

        try:
            return table_of(self.spots.document.source.file, name)
        except OSError as error:
            message = f"read {quoted(name)}, which cannot be read: {error.strerror or error}"
        except ValueError as error:
            message = f"read {quoted(name)}: {error}"
        self.spots.tell(path, message)
        return UNREADABLE

    def _sequences(self, given: Mapping[str, Any]) -> Iterator[StepSequence]:
        for number, (name, sequence) in enumerate(given.items(), 1):
            is_long = isinstance(sequence, GivenSteps)
            path: Path = ("sequences", number, *["steps"] * is_long)
            steps = sequence.steps if is_long else sequence
            done = tuple(self._step(step, (*path, place)) for place, step in enumerate(steps, 1))
            yield StepSequence(name, done, is_long and sequence.repeat)

    def _step(self, given: Mapping[str, Any], path: Path) -> SequenceStep:
        roads = {self.case.link_name(link): turns for link, turns in self.turning.items()}
        shift, when = given.get("shift"), given.get("when")
        try:
            when = when and when.with_wheel_speeds(roads)
        except ValueError as error:
            self.spots.tell((*path, "when"), str(error))
        return SequenceStep(
            when,
            _limit(given.get("within"), math.inf),
            float(given["wait"]),
            {name: _as_curve(value) for name, value in (given.get("set") or {}).items()},
            _shift(shift, 0.0) if shift else None,
            {number: state == "closed" for number, state in (given.get("dog") or {}).items()},
        )

    def samples(self, values: Mapping[str, Any]) -> dict[str, Distribution]:
        """Return the distributions of random numbers, by path."""
        given = values.get("samples", {})
        return {
            path: Distribution(*map(_plain, distribution)) for path, distribution in given.items()
        }

    def _start(self, values: Mapping[str, Any]) -> Start:
        names = elastic_names(self.case)
        straight = {spring.name for spring in self.case.springs if self.case.is_straight(spring)}
        gear, link = values.get("gear"), 0
        with suppress(ValueError):  # the checks report an unknown gear
            link = self.case.gear_input(self.case.gears[self.case.gear_number(gear or "") - 1])
        return Start(
            gear,
            self._start_speed(values.get("speed", 0.0), link, ("start", "speed")),
            {
                link: self._start_speed(speed, link, ("start", "speeds", link))
                for link, speed in values.get("speeds", {}).items()
            },
            tuple(values.get("engaged", ())),
            values.get("settled", False),
            {
                names[number - 1]: self._number(
                    twist,
                    "length" if names[number - 1] in straight else "angle",
                    ("start", "twists", number),
                )
                for number, twist in values.get("twists", {}).items()
            },
            {
                link: self._number(
                    angle,
                    "length" if link in self.case.masses else "angle",
                    ("start", "angles", link),
                )
                for link, angle in values.get("angles", {}).items()
            },
        )

    def _start_speed(self, given: Any, link: int, path: Path) -> float:
        is_turning = link not in self.case.masses and not getattr(given, "measure", None)
        if is_turning and given > FASTEST_WITHOUT_UNIT:
            self.doubts.append(no_unit(given, "rad/s", "most engines", path))
        return self._speed(given, link, path)

    def _speed(self, given: Any, link: int, path: Path) -> float:
        """Return a speed of a link [rad/s]; a vehicle speed is converted to a wheel speed."""
        if getattr(given, "measure", None) == "velocity":
            if turning := self.turning.get(link):
                return turning(float(given))
            self.spots.tell(
                path,
                "read a velocity, expected a speed in rad/s or rpm; a velocity belongs to "
                "a link with a `road`",
            )
        if link in self.case.masses:
            return self._number(given, "velocity", path, _STRAIGHT)
        return float(given)

    def _speeds(self, given: Any, link: int, path: Path) -> tuple[float, ...]:
        if not isinstance(given, list):
            return (self._speed(given, link, path),)
        speeds = enumerate(given, 1)
        return tuple(self._speed(speed, link, (*path, number)) for number, speed in speeds)

    def _given_speed(self, given: Any, link: int) -> Curve:
        """Return a speed over time [rad/s]; vehicle speeds are converted to wheel speeds."""
        path = ("speeds", link)
        if isinstance(given, Formula):
            return given
        if not isinstance(given, Sequence):
            return constant(self._speed(given or 0.0, link, path))
        times, speeds = zip(*given, strict=True) if given else ((), ())
        return Points(_floats(times), self._speeds([*speeds], link, path))

    def _controls(self, given: Mapping[int, Any]) -> Iterator[tuple[int, Control]]:
        for number, control in given.items():
            path: Path = ("controls", number)
            element = self.case.shift_elements[number - 1]
            if not isinstance(control, GivenControl):
                yield number, Capacity(self._capacity(control, element, path))
            elif control.dog is not None:
                yield number, Dog(tuple((float(t), state == "closed") for t, state in control.dog))
            else:
                key = "formula" if control.points is None else "points"
                law = self._capacity(getattr(control, key), element, (*path, key))
                yield number, Capacity(law, float(control.scale))

    def _capacity(self, given: Any, element: ShiftElement, path: Path) -> Points | Formula:
        """Return a torque capacity over time, a pressure if the shift element has friction."""
        measure: Measure = "pressure" if element.pack else "si_torque"
        return self._curve(
            given,
            measure,
            path,
            f", since {element.name} has {'' if element.pack else 'no '}`friction`",
        )

    def _curve(
        self, given: Any, measure: Measure, path: Path, why: str = "", along: Over = "time"
    ) -> Points | Formula:
        if isinstance(given, Formula):
            return given
        if not isinstance(given, Sequence):
            return constant(self._number(given, measure, path, why) or 0.0)  # 0.0 instead of -0.0
        over = STRAIGHT.get(_OVER[along], "time") if measure == "force" else _OVER[along]
        points = [
            (
                self._number(x, over, (*path, number, 1), f": the points are over {along}"),
                self._number(y, measure, (*path, number, 2), why),
            )
            for number, (x, y) in enumerate(given, 1)
        ]
        x, y = zip(*points, strict=True) if points else ((), ())
        return Points(x, y, along)

    def _limit_measure(self, spring: int) -> Measure:
        springs = self.case.springs[spring - 1 : spring]
        return "force" if any(map(self.case.is_straight, springs)) else "si_torque"

    def _number(self, value: Any, measure: Measure, path: Path, why: str = "") -> float:
        """Return a number; report a unit that does not fit."""
        if isinstance(value, InUnit) and value.measure not in (None, measure):
            read, unit = UNIT_OF[value.measure], UNIT_OF[measure]
            self.spots.tell(path, f"read a number in {read}, expected a number in {unit}{why}")
        return 0.0 if value is None else float(value)

    def _torques(self, given: Mapping[int, Iterable[Any]]) -> Iterator[tuple[int, TorqueLaw]]:
        for link, laws in given.items():
            several = list(laws)
            for number, law in enumerate(several, 1):
                listed = self.spots.has(("torques", link, number)) and len(several) > 1
                path = ("torques", link, number) if listed else ("torques", link)
                read = self._law(law, path)
                name = self.case.link_names[link - 1]
                yield link, read.on_link(name) if isinstance(read, Formula) else read

    def _law(self, given: Any, path: Path) -> TorqueLaw:
        straight = path[1] in self.case.masses
        measure: Measure = "force" if straight else "si_torque"
        why = _STRAIGHT * straight
        if not isinstance(given, GivenLaw):
            return self._curve(given, measure, path, why)
        if given.resistance is not None:
            return Resistance(self._number(given.resistance, measure, (*path, "resistance"), why))
        if given.road is not None:
            return _road(given.road)
        along: Any = given.over or "time"
        key = "formula" if given.points is None else "points"
        return self._curve(getattr(given, key), measure, (*path, key), why, along)


def _road(given: Road) -> Road:
    radius = given.radius
    wheel = WheelRadius(*map(float, radius if isinstance(radius, WheelRadius) else (radius,)))
    rolling = given.rolling
    if isinstance(rolling, Sequence):
        rolling = tuple((float(speed), float(part)) for speed, part in rolling)
    else:
        rolling = float(rolling)
    others = float(given.drag_area), float(given.slope), wheel.by_torque
    return Road(float(given.mass), wheel.free, rolling, *others)


def _limit(given: float | None, unlimited: float) -> float:
    return unlimited if given is None else float(given)


def _state(name: str, given: Mapping[str, Any]) -> ControlState:
    return ControlState(
        name,
        _as_curve(given["rate"]),
        float(given["start"]),
        _limit(given.get("min"), -math.inf),
        _limit(given.get("max"), math.inf),
    )


def _static(given: Mapping[str, Any] | None) -> StaticTorque | None:
    return StaticTorque(given["gear"], float(given["torque"] or 0.0)) if given else None


def _shift(given: Mapping[str, Any], at: float) -> Shift:
    return Shift(float(at), given["to"], float(given["overlap"]))


def _as_curve(given: Any) -> Curve:
    return given if isinstance(given, Formula) else constant(given or 0.0)


def _ratios(given: Any) -> Curve:
    if isinstance(given, Formula) or not isinstance(given, Sequence):
        return _as_curve(given)
    times, ratios = zip(*given, strict=True) if given else ((), ())
    return Points(_floats(times), _floats(ratios))


def _floats(values: Iterable[float]) -> tuple[Any, ...]:
    return tuple(map(float, values))


def _plain(value: Any) -> Any:
    """Return a number or a tuple of numbers as plain floats; None remains None."""
    if isinstance(value, tuple):
        return _floats(value)
    return None if value is None else float(value)
