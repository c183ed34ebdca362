"""What is other in a case, by paths as of a sweep: `P4.teeth.ring`, `gears.3.engaged`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vstatics.core.model.paths import PARTS, by_name, dotted
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.writers.named import mapping


class CaseChange(NamedTuple):
    """A value of a case that is not as expected; None where there is none."""

    path: str
    expected: Any
    actual: Any


_WORDS = ("name", "description", "source")
"""They change nothing."""
_SETS = ("engaged", "allow")
"""Lists whose order says nothing."""


def case_changes(
    actual: Transmission, expected: Transmission, *, atol: float = ATOL, rtol: float = RTOL
) -> Iterator[CaseChange]:
    """All that is other in a case, in the order of its keys.

    What is new or gone is one path. Numbers are the same as those of results are.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> parts = [ShiftElement(1, 2), ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)]
    >>> one, other = (Transmission(3, *parts, [Gear(held)]) for held in ([1], [2]))
    >>> for change in case_changes(other, one):
    ...     print(*change)
    gears.1.engaged ['F1'] ['T2']
    """
    told = [mapping(case) for case in (actual, expected)]
    plain = [mapping(case, units=False) for case in (actual, expected)]
    if any(one == other for one, other in zip(told, plain, strict=True)):
        told = plain  # one of them knows no units, as a deck, so both are parts of the load
    ports = _ports(actual, expected), _ports(expected, actual)
    here, there = (_by_path({**one, **port}) for one, port in zip(told, ports, strict=True))
    yield from _changes((), here, there, atol, rtol)


def _ports(case: Transmission, other: Transmission) -> dict[str, str]:
    """Input and output, where they are links of both: an order of links may tell them, too."""
    ports = {"input": case.link_name(case.input)}
    if not (case.outputs or other.outputs):
        ports["output"] = case.link_name(case.output)
    return {key: link for key, link in ports.items() if link in other.link_names}


def _by_path(case: Mapping[str, Any]) -> dict[str, Any]:
    """The case with its parts under their own names, without what changes nothing."""
    found: dict[str, Any] = {}
    for key, value in case.items():
        if key in (*PARTS, "converters"):
            for name, part in value.items():
                found[name] = {"links": part} if isinstance(part, list) else part
        elif key == "inertias":
            found |= {dotted(by_name((key, str(link)))): inertia for link, inertia in value.items()}
        elif key == "links" and isinstance(value, list):
            found[key] = {name: name for name in value}
        elif key not in _WORDS:
            found[key] = value
    return found


def _changes(
    way: tuple[str, ...], actual: Any, expected: Any, atol: float, rtol: float
) -> Iterator[CaseChange]:
    if isinstance(actual, Mapping) and isinstance(expected, Mapping):
        for key in [*expected, *(key for key in actual if key not in expected)]:
            here, there = actual.get(key), expected.get(key)
            yield from _changes((*way, str(key)), here, there, atol, rtol)
    elif _is_same(way, actual, expected, atol, rtol):
        return
    elif _are_numbered(actual, expected):
        for number, (here, there) in enumerate(zip(actual, expected, strict=True), 1):
            yield from _changes((*way, str(number)), here, there, atol, rtol)
    else:
        yield CaseChange(dotted(way), expected, actual)


def _are_numbered(actual: Any, expected: Any) -> bool:
    """Whether two values are lists whose items have paths by their numbers: not those of names."""
    lists = isinstance(actual, list) and isinstance(expected, list)
    return (
        lists
        and len(actual) == len(expected)
        and not any(isinstance(item, str) for item in (*actual, *expected))
    )


def _is_same(way: tuple[str, ...], actual: Any, expected: Any, atol: float, rtol: float) -> bool:
    if isinstance(actual, float) and isinstance(expected, int | float):
        return math.isclose(actual, expected, rel_tol=0, abs_tol=atol + rtol * abs(expected))
    if isinstance(actual, list) and isinstance(expected, list) and way[-1] in _SETS:
        return sorted(map(str, actual)) == sorted(map(str, expected))
    return bool(actual == expected)
