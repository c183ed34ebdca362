"""How results are compared: by which tolerances, and without which tables."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from vstatics.core.errors import ReadError, quoted
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.tables.names import quantity_named


class Tolerances(NamedTuple):
    """How numbers are compared, and keys of the tables that are not."""

    atol: float = ATOL
    rtol: float = RTOL
    leave_out: frozenset[str] = frozenset()


def tolerance(number: float) -> float:
    """A tolerance that can be one.

    Raises
    ------
    ValueError
    """
    if not 0 <= number < math.inf:
        raise ValueError(f"read {number:g}, expected a finite number of 0 or more")
    return number


def left_out(names: str | Iterable[str]) -> frozenset[str]:
    """The keys of tables that are not compared, by a name or several.

    Raises
    ------
    ReadError
        If there is no such table.

    Examples
    --------
    >>> sorted(left_out("ratio") | left_out(["losses", "efficiency"]))
    ['ETA', 'losses', 'ratio']
    """
    given = [names] if isinstance(names, str) else names
    keys = set()
    for name in given:
        if "," in name:
            raise ReadError("E113", f"{quoted(name)} is no table: give each of them by itself")
        keys.add(quantity_named(name).key)
    return frozenset(keys)
