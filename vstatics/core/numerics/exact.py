"""Fractions, in which `elimination` does not round, made floats again."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any


def rounded(value: Any) -> Any:
    """The same with floats in place of fractions, in records, lists and mappings too.

    >>> rounded((Fraction(1, 4), [Fraction(10) ** 400], {"a": "b"}))
    (0.25, [inf], {'a': 'b'})
    """
    if isinstance(value, Fraction):
        try:
            return float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    if isinstance(value, tuple):
        made = map(rounded, value)
        return type(value)(*made) if hasattr(value, "_fields") else tuple(made)
    if isinstance(value, list):
        return list(map(rounded, value))
    if isinstance(value, Mapping):
        return {key: rounded(own) for key, own in value.items()}
    return value
