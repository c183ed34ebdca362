"""Rejection of numbers so large or small that results would be rounding errors.

A mistyped exponent is rejected at its position in the document, before speeds reach 1e90 rad/s.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import count
from typing import Any

from vstatics.core.errors import Path, Problem
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import Transmission
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points, Road
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.tolerances import LARGEST_NUMBER, LEAST_NUMBER, UNLIKE_INERTIAS

_NOT_NUMBERS = (str, int, type(None))
"""Types of values without a size: names, counts, flags and missing values."""


def size_problems(scenario: Scenario) -> Iterator[Problem]:
    """Yield a problem for each number of a scenario or case that is too large or too small.

    Examples
    --------
    >>> from vstatics import Gear, Transmission
    >>> case = Transmission(1, [], [], [Gear()], inertias={1: 1e-98})
    >>> for problem in size_problems(Scenario(case, 1e90)):
    ...     print(problem)
    case.inertias[1]: read 1e-98, expected 0 or a number from 1e-15 to 1e+15 [E663]
    duration: read 1e+90, expected a number from 1e-15 to 1e+15 [E663]
    """
    case = scenario.case
    names = case.link_names
    for key in ("inertias", "masses", "springs", "shift_elements", "mechanisms"):
        yield from _of_numbers(getattr(case, key), ("case", key))
    yield from _of_unlike(case)
    start = scenario.start
    yield from _of_numbers(scenario.duration, ("duration",))
    of_links = {
        names[link - 1]: speed for link, speed in start.speeds.items() if link <= len(names)
    }
    for key, speeds in (("speed", start.speed), ("speeds", of_links)):
        yield from _of_numbers(speeds, ("start", key), least=0.0)  # a calculated 0 can be 1e-16
    elements = case.shift_elements
    for number, control in (scenario.controls or {}).items():
        if 0 < number <= len(elements):
            path = "controls", elements[number - 1].name
            yield from _of_numbers(getattr(control, "law", control), path)
            yield from _of_numbers(getattr(control, "scale", 0.0), (*path, "scale"))
    for link, law in scenario.torques:
        if 0 < link <= len(names):
            path = "torques", names[link - 1]
            yield from _of_numbers(law, (*path, "road") if isinstance(law, Road) else path)
    for number, limit in scenario.limits.items():
        if 0 < number <= len(case.springs):
            yield from _of_numbers(limit, ("limits", case.springs[number - 1].name))
    yield from _of_numbers(scenario.converters, ("converters",))
    yield from _of_numbers(scenario.shifts or (), ("shifts",))


def _of_numbers(part: Any, path: Path, least: float = LEAST_NUMBER) -> Iterator[Problem]:
    """Yield a problem for each number of impossible size in a value, with its path."""
    if isinstance(part, float):
        read = part.given if isinstance(part, OfLoad) else part
        size = abs(read)
        if LARGEST_NUMBER < size < math.inf or 0 < size < least:
            none = "0 or " if size < 1 else ""
            yield Problem(
                "E663",
                f"read {read:g}, expected {none}a number from {LEAST_NUMBER:g} to "
                f"{LARGEST_NUMBER:g}",
                path,
            )
    elif isinstance(part, Points):
        for number, point in enumerate(zip(part.x, part.y, strict=False), 1):
            places = ((*path, number, 1), (*path, number, 2)) if len(part.x) > 1 else (path, path)
            for value, place in zip(point, places, strict=True):
                yield from _of_numbers(value, place)
    elif isinstance(part, Formula):
        for value in part.constants:
            yield from _of_numbers(value, path)
    else:
        for name, value in _parts(part):
            if not isinstance(value, _NOT_NUMBERS):
                yield from _of_numbers(value, (*path, name), least)


def _parts(whole: Any) -> Iterable[tuple[str | int, Any]]:
    if isinstance(whole, tuple):
        return zip(getattr(whole, "_fields", count(1)), whole, strict=False)
    return whole.items() if isinstance(whole, Mapping) else ()


def _of_unlike(case: Transmission) -> Iterator[Problem]:
    """Yield a problem for each inertia that rounding would lose next to the largest inertia."""
    largest = max(case.heavy.values(), default=0.0)
    for link, inertia in case.heavy.items():
        if 0 < inertia < largest * UNLIKE_INERTIAS:
            yield Problem(
                "E664",
                f"read {inertia:g}, expected at least {UNLIKE_INERTIAS:g} of the largest inertia, "
                f"{largest:g}: leave it out, as a link can have no inertia",
                ("case", "masses" if link in case.masses else "inertias", link),
            )
