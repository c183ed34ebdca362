"""Elimination without rounding, in fractions: for few and small systems, as it is slow."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from vstatics.numerics.elimination import Arithmetic, Entry
from vstatics.numerics.traced import Number, plain


def _exact(number: Number | Fraction) -> Fraction:
    return number if isinstance(number, Fraction) else Fraction(repr(float(plain(number))))


def _exact_entry(number: Number) -> tuple[Fraction, float]:
    return _exact(number), 0.0


def _exact_quotient(entry: Entry, pivot: Entry) -> tuple[Fraction, float]:
    return _exact(entry[0]) / _exact(pivot[0]), 0.0


def _exact_less(entry: Entry, factor: Entry, term: Entry) -> tuple[Fraction, float]:
    return _exact(entry[0]) - _exact(factor[0]) * _exact(term[0]), 0.0


def _any_pivot(pivot: Number, other: Number) -> bool:  # noqa: ARG001
    return True


EXACT = Arithmetic(_exact_entry, _exact_quotient, _exact_less, _any_pivot)  # type: ignore[arg-type]
"""Fractions, of floats those of the decimals that they show; of one case only."""


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
