"""Settings of a comparison: tolerances, and tables that are not compared."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from vstatics.core.errors import ReadError, quoted
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.tables.names import quantity_named


class Tolerances(NamedTuple):
    """Tolerances of a comparison, and names of tables that are not compared."""

    atol: float = ATOL
    rtol: float = RTOL
    leave_out: frozenset[str] = frozenset()


def tolerance(number: float) -> float:
    """Check and return a tolerance.

    Raises
    ------
    ValueError
        If the tolerance is negative or not finite.
    """
    if not 0 <= number < math.inf:
        raise ValueError(f"read {number:g}, expected a finite number of 0 or more")
    return number


def read_tolerance(text: str) -> float:
    """Return a tolerance from a number or a percentage.

    >>> read_tolerance("1e-9"), read_tolerance("5%")
    (1e-09, 0.05)
    """
    from vstatics.core.readers.named.scalars import number  # costs start-up time

    try:
        return tolerance(number(text))
    except ValueError:
        expected = "a finite number of 0 or more, such as 1e-6 or 5%"
        raise ValueError(f"read {quoted(text)}, expected {expected}") from None


def left_out(names: str | Iterable[str]) -> frozenset[str]:
    """Convert names or deck names of tables to names.

    Raises
    ------
    ReadError
        If a table does not exist.

    Examples
    --------
    >>> sorted(left_out("ratio") | left_out(["losses", "ETA"]))
    ['efficiency', 'losses', 'ratio']
    """
    given = [names] if isinstance(names, str) else names
    tables = set()
    for name in given:
        if "," in name:
            raise ReadError("E113", f"{quoted(name)} is not a table: give each name separately")
        tables.add(quantity_named(name).name)
    return frozenset(tables)
