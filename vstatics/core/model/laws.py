"""Drag, efficiency or loss as a function of speed, torque or both, and checks of such laws."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, Literal, Self, TypeVar

import numpy as np

from vstatics.core.errors import Path, Problem, count_of, percent, quoted, spoken
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.parts import RAD_PER_RPM, Gear, Law, Load, Size
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.numerics.tolerances import TIE

_BOTH = "a `load` with both, such as `load: {speed: 2000 rpm, torque: 100 N*m}`"
"""Words for the expected operating point in messages."""
MOST_LAW_POINTS = 10_000
"""Largest number of points in a law."""
_UNITS = {"speed": " rad/s", "torque": " N*m"}
ACase = TypeVar("ACase", bound=TransmissionFields)
LossUnit = Literal["", "W", "kW", "N*m"]
"""Unit of the values of a loss map; empty for an efficiency map."""


class PointLaw(Law):
    """Law given by points. Values are interpolated linearly and held constant outside the points.

    Parameters
    ----------
    points : sequence of pairs
        Speed [rad/s] or torque [N*m], 0 or more in ascending order, with the value of the law.
    over : {"speed", "torque"}
        Quantity on which the value depends.

    Examples
    --------
    >>> law = PointLaw([(0, 2.0), (300, 3.5)])
    >>> law.at(150.0), law.at(np.array([0, 1000])).tolist(), float(law)
    (2.75, [2.0, 3.5], 2.0)
    """

    def __new__(
        cls, points: Sequence[Sequence[float]], over: Literal["speed", "torque"] = "speed"
    ) -> Self:
        """Create a law. The points are checked later, with the case."""
        law = super().__new__(cls, points[0][1] if points else 1.0)
        law.points = tuple((float(x), float(y)) for x, y in points)
        law.over = over
        return law

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments of the constructor, for pickling."""
        return self.points, self.over

    def at(self, *sizes: Size) -> Size:
        """Return the value at a speed [rad/s] or torque [N*m], a number or an array."""
        (size,) = sizes
        x, y = zip(*self.points, strict=True)
        values = np.interp(size, x, y)
        return values if isinstance(size, np.ndarray) else float(values)  # type: ignore[no-any-return]

    def is_outside(self, *sizes: Floats) -> Booleans:
        """Return flags that mark speeds or torques outside the points."""
        (size,) = sizes
        return _is_outside(size, self.points[0][0], self.points[-1][0])

    def domain(self) -> str:
        """Return the range of the points as text for messages."""
        sizes = [x for x, _ in self.points]
        return speed_range(sizes) if self.over == "speed" else torque_range(sizes)

    @cached_property
    def table(self) -> LookupTable:
        """Points as a lookup table with a single row."""
        x, y = zip(*self.points, strict=True)
        return LookupTable((0.0,), (y,), x)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value of the law."""
        values = [y for _, y in self.points]
        return min(values), max(values)


class MapLaw(Law):
    """Law given by a map. Values are interpolated bilinearly and held constant outside the map.

    Parameters
    ----------
    columns : sequence of float
        Torques in ascending order. [N*m]
    rows : sequence of sequence of float
        Speed [rad/s] of each row, in ascending order, followed by the value at each torque.
    unit : {"", "W", "kW", "N*m"}
        Unit of the values of a loss; empty for an efficiency.

    Examples
    --------
    >>> law = MapLaw([0, 100], [[0, 0.8, 0.9], [50, 0.9, 1.0]])
    >>> law.at(25.0, 50.0), law.at(np.array([0.0, 80.0]), np.array([0.0, 300.0])).tolist()
    (0.9, [0.8, 1.0])
    """

    columns: tuple[float, ...]
    rows: tuple[tuple[float, ...], ...]
    unit: LossUnit

    def __new__(
        cls, columns: Sequence[float], rows: Sequence[Sequence[float]], unit: LossUnit = ""
    ) -> Self:
        """Create a law. The map is checked later, with the case."""
        law = super().__new__(cls, rows[0][1] if rows and rows[0][1:] else 1.0)
        law.over, law.unit = "both", unit
        law.columns = tuple(map(float, columns))
        law.rows = tuple(tuple(map(float, row)) for row in rows)
        return law

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments of the constructor, for pickling."""
        return self.columns, self.rows, self.unit

    @cached_property
    def table(self) -> LookupTable:
        """Map as a lookup table."""
        return LookupTable(
            tuple(row[0] for row in self.rows), tuple(row[1:] for row in self.rows), self.columns
        )

    def at(self, *sizes: Size) -> Size:
        """Return the value at a speed [rad/s] and a torque [N*m], numbers or arrays."""
        speed, torque = sizes
        if isinstance(speed, np.ndarray) or isinstance(torque, np.ndarray):
            return self.table.along(*np.broadcast_arrays(speed, torque))
        return self.table.at(speed, torque)

    def is_outside(self, *sizes: Floats) -> Booleans:
        """Return flags that mark pairs of speed and torque outside the map."""
        speed, torque = sizes
        return _is_outside(speed, self.rows[0][0], self.rows[-1][0]) | _is_outside(
            torque, self.columns[0], self.columns[-1]
        )

    def domain(self) -> str:
        """Return the range of the map as text for messages."""
        return f"{speed_range([row[0] for row in self.rows])}, {torque_range(self.columns)}"

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value of the law."""
        values = [value for row in self.rows for value in row[1:]]
        return min(values), max(values)

    @property
    def _definition(self) -> tuple[object, ...]:
        return type(self), self.columns, self.rows, self.unit

    def __repr__(self) -> str:
        """Return the full definition, so that cases with different maps have different texts."""
        return f"MapLaw({self.columns!r}, {self.rows!r}, {self.unit!r})"


def speed_range(speeds: Sequence[float]) -> str:
    """Return the range of ascending speeds [rad/s] as text.

    >>> speed_range([5 * math.pi, 50 * math.pi])
    '150 to 1500 rpm'
    """
    return f"{speeds[0] / RAD_PER_RPM:.6g} to {speeds[-1] / RAD_PER_RPM:.6g} rpm"


def torque_range(torques: Sequence[float]) -> str:
    """Return the range of ascending torques [N*m] as text."""
    return f"{torques[0]:.6g} to {torques[-1]:.6g} N*m"


def _is_outside(size: Floats, first: float, last: float) -> Booleans:
    """Return flags that mark magnitudes outside two ends by more than rounding."""
    slack = TIE * max(abs(first), abs(last))
    return (size < first - slack) | (size > last + slack)


def of_law(  # noqa: PLR0913
    law: Law, path: Path, *, low: float, high: float, what: str, signed: bool = False
) -> Iterator[Problem]:
    """Check the points or the map of a law, whose values must be from `low` to `high`.

    Values of a formula are checked later, at the operating point. Torques below 0 need `signed`.
    """
    if isinstance(law, MapLaw):
        problems = _of_map(law, path, low=low, high=high, what=what, signed=signed)
    elif isinstance(law, PointLaw):
        inner = (*path, "points") if path[-1] in ("efficiency", "back_efficiency") else path
        problems = _of_points(law, inner, low=low, high=high, what=what)
    else:
        return
    for problem in problems:
        yield _in_file(problem, law, path) if law.file else problem


def _in_file(problem: Problem, law: Law, path: Path) -> Problem:
    """Return a problem at a law, with the name of its file."""
    file = quoted(os.path.basename(law.file))  # noqa: PTH119 (pathlib costs start-up time)
    return problem._replace(path=path, message=f"read {file}: {problem.message}")


def _of_points(law: Law, path: Path, *, low: float, high: float, what: str) -> Iterator[Problem]:
    """Check that points ascend, begin at 0 or above, and have values from `low` to `high`."""
    if len(law.points) > MOST_LAW_POINTS:
        yield Problem(
            "E266", f"read {len(law.points)} points, expected {MOST_LAW_POINTS} at most", path
        )
        return
    if not law.points:
        yield Problem("E266", "read no points, expected at least one", path)
    least, unit = -math.inf, _UNITS[law.over]
    for number, (x, y) in enumerate(law.points, 1):
        if not 0 <= x < math.inf:
            message = f"read {x:g}{unit}, expected a {law.over} of 0 or more: magnitudes count"
            yield Problem("E266", message, (*path, number, 1))
        elif x <= least:
            above = f"a {law.over} above {least:g}{unit}"
            message = f"read {x:g}{unit}, expected {above}: points must ascend"
            yield Problem("E266", message, (*path, number, 1))
        if not low <= y <= high or not math.isfinite(y):
            yield Problem("E266", f"read {y:g}, expected {what}{percent(y)}", (*path, number, 2))
        least = max(least, x)


def _of_map(  # noqa: PLR0913
    law: MapLaw, path: Path, *, low: float, high: float, what: str, signed: bool
) -> Iterator[Problem]:
    """Check that a map is complete, ascends and has values from `low` to `high`.

    Torques below 0 need `signed`.
    """
    columns, rows = law.columns, law.rows
    if len(columns) * len(rows) > MOST_LAW_POINTS:
        message = f"read {len(columns) * len(rows)} points, expected {MOST_LAW_POINTS} at most"
        yield Problem("E266", message, path)
        return
    for name, numbers, noun in (("columns", columns, "torques"), ("rows", rows, "speeds")):
        if len(numbers) < 2:
            message = f"read {len(numbers)}, expected two {noun} or more"
            yield Problem("E266", message, (*path, name))
    yield from _ascending(columns, "torque", -math.inf if signed else 0.0, (*path, "columns"))
    speeds = [row[0] for row in rows if row]
    for problem in _ascending(speeds, "speed", 0.0, (*path, "rows")):
        yield problem._replace(path=(*problem.path, 1))
    for number, row in enumerate(rows, 1):
        place = (*path, "rows", number)
        if len(row) != len(columns) + 1:
            message = f"read {count_of('number', len(row))}, expected {len(columns) + 1}"
            more = "the speed, and a value for each of the `columns`"
            yield Problem("E266", f"{message}: {more}", place)
        for column, value in enumerate(row[1:], 2):
            if not low <= value <= high or not math.isfinite(value):
                is_idle = value == 0 in (row[0], columns[column - 2])
                hint = "; omit columns of torque 0 and rows of speed 0" if is_idle else ""
                message = f"read {value:g}, expected {what}{percent(value)}{hint}"
                yield Problem("E266", message, (*place, column))


def _ascending(numbers: Sequence[float], noun: str, least: float, path: Path) -> Iterator[Problem]:
    before, unit = -math.inf, _UNITS[noun]
    for place, number in enumerate(numbers, 1):
        message = ""
        if not least <= number or not math.isfinite(number):
            sign = " of 0 or more: magnitudes count" if least == 0 else ", finite"
            message = f"read {number:g}{unit}, expected a {noun}{sign}"
        elif number <= before:
            above = f"a {noun} above {before:g}{unit}"
            message = f"read {number:g}{unit}, expected {above}: {noun}s must ascend"
        if message:
            yield Problem("E266", message, (*path, place))
        before = max(before, number)


def of_balances(case: TransmissionFields) -> Iterator[Problem]:
    """Check battery balances: links, efficiencies, power, and a link without speed and torque."""
    for number, gear in enumerate(case.gears, 1):
        if gear.balance is None:
            continue
        path: Path = ("gears", number, "balance")
        for link, efficiency in gear.balance.efficiencies:
            if not (hasattr(link, "__index__") and 0 < link <= case.own_links):
                expected = f"a link number from 1 to {case.own_links}"
                yield Problem("E269", f"read {link!r}, expected {expected}", path)
                return
            expected = "an efficiency above 0 and up to 1"
            if isinstance(efficiency, Law):
                yield from of_law(
                    efficiency,
                    (*path, link),
                    low=math.ulp(0.0),
                    high=1,
                    what=expected,
                    signed=True,
                )
            elif not 0 < efficiency <= 1:
                message = f"read {efficiency:g}, expected {expected}"
                yield Problem("E269", message, (*path, link))
        if not math.isfinite(gear.balance.battery):
            message = f"read {gear.balance.battery:g}, expected a finite power"
            yield Problem("E269", message, (*path, "battery"))
        ends = gear.input or case.input, gear.output or case.main_output
        if not gear.open_links(ends):
            expected = "expected at least one such link, neither input nor output"
            yield Problem("E269", f"read no link without speed and torque, {expected}", path)


def without_loads(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors for laws in a gear whose operating point has no speed or no torque.

    Statics needs both, simulation does not. Only the first such gear is reported.
    """
    places: list[Path] = [
        ("mechanisms", number, name)
        for number, part in enumerate(case.mechanisms, 1)
        for name in ("efficiency", "back_efficiency")
        if isinstance(getattr(part, name), Law)
    ]
    elements = enumerate(case.shift_elements, 1)
    places += [("shift_elements", n, "drag") for n, part in elements if isinstance(part.drag, Law)]
    places += [("drag", link) for link, drag in case.drag.items() if isinstance(drag, Law)]
    for number, gear in enumerate(case.gears, 1):
        load = case.gear_load(gear)
        if load.speed is not None and load.torque is not None:
            continue
        keys = [key for key in ("balance", "loss") if getattr(gear, key) is not None]
        of_balance: list[Path] = [("gears", number, key) for key in keys]
        for path in (*places, *_of_gear(gear, number), *of_balance):
            what = "speed" if load.speed is None else "torque"
            message = (
                "it depends on speed and torque, but the operating point of gear "
                f"{gear.name or number} has no {what}"
            )
            yield Problem("E267", f"{message}: expected {_BOTH}", path)
        return


def of_sought_ratios(case: TransmissionFields) -> Iterator[Problem]:
    """Yield errors for gears whose load cannot determine the speed ratios of converters."""
    without_load: list[tuple[int, str]] = []
    for number, gear in enumerate(case.gears, 1):
        sought = [case.mechanisms[place].name for place in case.sought_converters(gear)]
        load = case.gear_load(gear)
        if len(sought) > 1:
            message = (
                f"read {spoken(sought)} without a speed ratio, but a load determines the speed "
                "ratio of one converter only: give the others under `speed_ratios`, or list them "
                "under `open`"
            )
            yield Problem("E271", message, ("gears", number))
        elif sought and (load.speed is None or load.torque is None):
            message = (
                f"the speed ratio of {sought[0]} depends on the load, but the operating point of "
                f"the gear has no {'speed' if load.speed is None else 'torque'}: expected {_BOTH}, "
                "or the speed ratio under `speed_ratios`"
            )
            without_load.append((number, message))
    yield from case.problems_of_gears("E267", without_load)


def with_load(case: ACase, load: Load) -> ACase:
    """Return a case at `load` if its operating points lack a value for losses or converters."""
    if not any(problem.id == "E267" for problem in (*without_loads(case), *of_sought_ratios(case))):
        return case
    gears = [gear._replace(load=None) for gear in case.gears]
    return replace(case, gears=gears, load=load)


def with_varied_load(case: ACase, varied: Iterable[str]) -> ACase:
    """Return a case with placeholders for a missing speed or torque of `load` that varies.

    Parameters
    ----------
    varied : iterable of str
        Paths of varied numbers, also with units, such as `load.speed [rpm]`.
    """
    paths = {path.partition(" ")[0] for path in varied}
    load = given = case.load or Load()
    if load.speed is None and "load.speed" in paths:
        load = load._replace(speed=1000.0)
    if load.torque is None and "load.torque" in paths:
        load = load._replace(torque=1.0)
    return case if load is given else replace(case, load=load)


def _of_gear(gear: Gear, number: int) -> list[Path]:
    return [
        ("gears", number, name, owner)
        for name in ("drag", "open_drag")
        for owner, torque in getattr(gear, name).items()
        if isinstance(torque, Law)
    ]
