"""Changed input data of a case by path, such as `P4.teeth.ring` or `gears.3.engaged`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vstatics.core.model.paths import PARTS, by_name, dotted
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.writers.named import mapping


class CaseChange(NamedTuple):
    """Changed value of a case. If a case does not have the key, its value is missing."""

    path: str
    expected: Any
    actual: Any


_WORDS = ("name", "description", "source")
"""Keys that do not affect results."""
_SETS = ("engaged", "open", "allow")
"""Keys of lists whose order is irrelevant."""


def case_changes(actual: Transmission, expected: Transmission) -> Iterator[CaseChange]:
    """Yield all changes of a case, in the order of the keys.

    An added or removed part is a single change. Values that differ by more than rounding are
    changes, because even a small change of the case can explain differences of results.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> parts = [ShiftElement(1, 2), ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)]
    >>> old, new = (Transmission(3, *parts, [Gear(held)]) for held in ([1], [2]))
    >>> for change in case_changes(new, old):
    ...     print(*change)
    gears.1.engaged ['F1'] ['T2']
    """
    data = [mapping(case) for case in (actual, expected)]
    plain = [mapping(case, units=False) for case in (actual, expected)]
    if any(units == relative for units, relative in zip(data, plain, strict=True)):
        data = plain  # relative values are compared, because a deck has no units
    ports = _ports(actual, expected), _ports(expected, actual)
    here, there = (_by_path({**case, **port}) for case, port in zip(data, ports, strict=True))
    yield from _changes((), here, there)


def _ports(case: Transmission, other: Transmission) -> dict[str, str]:
    ports = {"input": case.link_name(case.input)}
    if not (case.outputs or other.outputs):
        ports["output"] = case.link_name(case.output)
    return {key: link for key, link in ports.items() if link in other.link_names}


def _by_path(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data of a case by first key of a path, without keys that do not affect results."""
    parts: dict[str, Any] = {}
    for key, value in case.items():
        if key in (*PARTS, "converters"):
            for name, part in value.items():
                parts[name] = {"links": part} if isinstance(part, list) else part
        elif key == "inertias":
            parts |= {dotted(by_name((key, str(link)))): inertia for link, inertia in value.items()}
        elif key == "links" and isinstance(value, list):
            parts[key] = {name: name for name in value}
        elif key not in _WORDS:
            parts[key] = value
    return parts


def _changes(path: tuple[str, ...], actual: Any, expected: Any) -> Iterator[CaseChange]:
    if isinstance(actual, Mapping) and isinstance(expected, Mapping):
        for key in [*expected, *(key for key in actual if key not in expected)]:
            here, there = actual.get(key), expected.get(key)
            yield from _changes((*path, str(key)), here, there)
    elif _is_same(path, actual, expected):
        return
    elif (
        isinstance(actual, list)
        and isinstance(expected, list)
        and len(actual) == len(expected)
        and not any(isinstance(item, str) for item in (*actual, *expected))
    ):  # the path of an item contains the number of the item
        for number, (here, there) in enumerate(zip(actual, expected, strict=True), 1):
            yield from _changes((*path, str(number)), here, there)
    else:
        yield CaseChange(dotted(path), expected, actual)


def _is_same(path: tuple[str, ...], actual: Any, expected: Any) -> bool:
    if isinstance(actual, float) and isinstance(expected, int | float):
        return math.isclose(actual, expected, rel_tol=0, abs_tol=ATOL + RTOL * abs(expected))
    if isinstance(actual, list) and isinstance(expected, list) and path[-1] in _SETS:
        return sorted(map(str, actual)) == sorted(map(str, expected))
    return bool(actual == expected)
