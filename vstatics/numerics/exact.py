"""Elimination without rounding, in fractions: for few and small systems, as it is slow."""

from __future__ import annotations

from fractions import Fraction

from vstatics.numerics.elimination import Arithmetic, Entry, large_enough
from vstatics.numerics.traced import Number, plain


def _exact(number: Number | Fraction) -> Fraction:
    return number if isinstance(number, Fraction) else Fraction(repr(float(plain(number))))


def _exact_entry(number: Number) -> tuple[Fraction, float]:
    return _exact(number), 0.0


def _exact_quotient(entry: Entry, pivot: Entry) -> tuple[Fraction, float]:
    return _exact(entry[0]) / _exact(pivot[0]), 0.0


def _exact_less(entry: Entry, factor: Entry, term: Entry) -> tuple[Fraction, float]:
    return _exact(entry[0]) - _exact(factor[0]) * _exact(term[0]), 0.0


EXACT = Arithmetic(_exact_entry, _exact_quotient, _exact_less, large_enough)  # type: ignore[arg-type]
"""Fractions of the decimals that numbers show, without rounding; of one case only."""
