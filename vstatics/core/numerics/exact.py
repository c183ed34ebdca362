"""Conversion of fractions, in which `elimination` does not round, to floats."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

_WITHOUT_FRACTIONS = frozenset({float, int, bool, str, type(None)})
"""Types of values that contain no fraction."""


def rounded(value: Any) -> Any:
    """Return a value in which floats replace fractions, also in named tuples, lists and mappings.

    >>> rounded((Fraction(1, 4), [Fraction(10) ** 400], {"a": "b"}))
    (0.25, [inf], {'a': 'b'})
    """
    kind = value.__class__
    if kind in _WITHOUT_FRACTIONS:
        return value
    if kind is Fraction:
        return _nearest(value)
    if isinstance(value, tuple):
        items = map(rounded, value)
        return kind(*items) if hasattr(value, "_fields") else tuple(items)
    if isinstance(value, list):
        return list(map(rounded, value))
    if isinstance(value, Mapping):
        return {key: rounded(item) for key, item in value.items()}
    return value


def _nearest(fraction: Fraction) -> float:
    try:
        return float(fraction)
    except OverflowError:
        return math.inf if fraction > 0 else -math.inf
