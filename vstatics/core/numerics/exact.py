"""Conversion of fractions, in which `elimination` does not round, to floats."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any


def rounded(value: Any) -> Any:
    """Return a value in which floats replace fractions, also in named tuples, lists and mappings.

    >>> rounded((Fraction(1, 4), [Fraction(10) ** 400], {"a": "b"}))
    (0.25, [inf], {'a': 'b'})
    """
    if isinstance(value, Fraction):
        try:
            return float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    if isinstance(value, tuple):
        items = map(rounded, value)
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    if isinstance(value, list):
        return list(map(rounded, value))
    if isinstance(value, Mapping):
        return {key: rounded(item) for key, item in value.items()}
    return value
