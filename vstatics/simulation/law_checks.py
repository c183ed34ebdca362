"""What laws, points and formulas of a scenario must fulfil, at whatever path they stand."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from vstatics.errors import Path, Problem, ReadError, quoted, spoken
from vstatics.simulation.formula import Formula
from vstatics.simulation.laws import Points, Resistance, Road, TorqueLaw


def of_law(law: TorqueLaw, path: Path) -> Iterator[Problem]:
    """Of a torque: numbers that can be, points in order, known names."""
    match law:
        case Formula():
            yield from of_formula(law, ["t", "speed", "angle"], path)
        case Points():
            yield from of_points(law, path)
        case Resistance():
            if not 0 <= law.torque < math.inf:
                message = f"read {law.torque:g}, expected a torque of 0 or more"
                yield Problem(message, (*path, "resistance"))
        case Road():
            yield from _of_road(law, (*path, "road"))


def _of_road(road: Road, path: Path) -> Iterator[Problem]:
    limits: dict[str, tuple[Callable[[float], bool], str]] = {
        "mass": (lambda value: value > 0, "a mass above 0"),
        "radius": (lambda value: value > 0, "a radius above 0"),
        "rolling": (lambda value: value >= 0, "a coefficient of 0 or more"),
        "drag_area": (lambda value: value >= 0, "an area of 0 or more"),
        "slope": (lambda value: -1 <= value <= 1, "the sine of an angle, from -1 to 1"),
    }
    for name, (holds, expected) in limits.items():
        value = getattr(road, name)
        if not (holds(value) and math.isfinite(value)):
            yield Problem(f"read {value:g}, expected {expected}", (*path, name))


def of_characteristic(
    points: Sequence[tuple[float, float, float]], path: Path
) -> Iterator[Problem]:
    """Of a converter: speed ratios in order, no negative torque ratio."""
    if not points:
        yield Problem("read no points, expected one at least", path)
    yield from _ascending([ratio for ratio, _, _ in points], "speed ratios in their order", path)
    for number, row in enumerate(points, 1):
        yield from of_finite(row, "a number", (*path, number))
        if row[1] < 0:
            message = f"read {row[1]:g}, expected a torque ratio K of 0 or more"
            yield Problem(message, (*path, number, 2))
        if row[2] < 0 and row[0] < 1:
            message = f"read {row[2]:g}, expected a lambda of 0 or more up to i = 1"
            yield Problem(message, (*path, number, 3))


def of_formula(formula: Formula, names: Sequence[str], path: Path) -> Iterator[Problem]:
    """One that can be read, with known names alone."""
    try:
        others = sorted(formula.variables.difference(names))
    except ReadError as error:
        yield from (problem._replace(path=path, place=None) for problem in error.problems)
        return
    if others:
        yield Problem(f"read {quoted(others[0])}, expected a formula of {spoken(names)}", path)


def of_points(points: Points, path: Path) -> Iterator[Problem]:
    """As many values as abscissas, finite and in order."""
    if not points.x or len(points.x) != len(points.y):
        yield Problem("expected points, one at least, each of two numbers", path)
    yield from of_finite([*points.x, *points.y], "a number", path)
    yield from _ascending(points.x, f"points in the order of the {points.over}", path)


def of_times(times: Sequence[float], path: Path) -> Iterator[Problem]:
    """One time at least, finite and in order."""
    if not times:
        yield Problem("read no times, expected one at least", path)
    yield from of_finite(times, "a time", path)
    yield from _ascending(times, "times in their order", path)


def _ascending(values: Sequence[float], expected: str, path: Path) -> Iterator[Problem]:
    for number, (one, other) in enumerate(pairwise(values), 2):
        if other < one:
            message = f"read {other:g} behind {one:g}, expected {expected}"
            yield Problem(message, (*path, number))
            return


def of_finite(values: Sequence[float], expected: str, path: Path) -> Iterator[Problem]:
    """The first of some numbers that is infinite or does not exist."""
    for value in values:
        if not math.isfinite(value):
            yield Problem(f"read {value:g}, expected {expected} that is finite", path)
            return
