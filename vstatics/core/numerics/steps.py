"""Evenly spaced numbers, calculated only for the requested indices."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import isfinite, lcm
from typing import TYPE_CHECKING

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers

if TYPE_CHECKING:
    from fractions import Fraction

_WHOLE = 2**53
"""Limit up to which a double represents every whole number exactly."""
_HIT = 1e-6
"""Largest distance from `stop` at which it counts as reached, relative to the step."""


@dataclass(frozen=True)
class Steps:
    """Numbers from `start` to `stop`, both included, evenly spaced.

    If start and step are short decimals or fractions, each number is the double closest to the
    exact number. For example, the middle of seven numbers from -0.3 to 0.3 is 0, not 5e-17.
    Otherwise the numbers are interpolated with rounding.

    Parameters
    ----------
    start, stop : float
        First and last number, both finite.
    number : int
        Count of the numbers, at least 2 unless start and stop are equal.

    Examples
    --------
    >>> Steps(-0.3, 0.3, 7)[np.arange(7)]
    array([-0.3, -0.2, -0.1,  0. ,  0.1,  0.2,  0.3])
    """

    start: float
    stop: float
    number: int

    def __len__(self) -> int:
        """Return the count of the numbers."""
        return self.number

    def __getitem__(self, indices: Integers) -> Floats:
        """Return the numbers at the indices, in an array of the same shape."""
        if self._whole is not None:
            first, step, divisor = self._whole
            numbers: Floats = indices * np.float64(step)
            numbers += first
            numbers /= divisor
            return numbers
        part: Floats = indices / np.float64(max(self.number - 1, 1))
        return (1 - part) * self.start + part * self.stop

    @cached_property
    def _whole(self) -> tuple[float, float, float] | None:
        """Start, step and common divisor as whole numbers; None if too large."""
        start = _exact(self.start)
        step = (_exact(self.stop) - start) / max(self.number - 1, 1)
        divisor = lcm(start.denominator, step.denominator)
        first, last = start * divisor, (start + step * (self.number - 1)) * divisor
        sizes: tuple[Fraction, ...] = (first, last, last - first)
        if divisor > _WHOLE or any(abs(size) > _WHOLE for size in sizes):
            return None
        return float(first), float(step * divisor), float(divisor)


def stepped(start: float, stop: float, step: float) -> Steps | None:
    """Return numbers from `start` in steps of `step`, up to `stop` at most.

    The result is None if the step is 0 or leads away from `stop`.

    >>> stepped(0.9, 1, 0.05), stepped(0.9, 1, 0.03)
    (Steps(start=0.9, stop=1.0, number=3), Steps(start=0.9, stop=0.99, number=4))
    """
    if start == stop:
        return Steps(start, stop, 1)
    if step == 0 or (step > 0) != (stop > start):
        return None
    steps = (_exact(stop) - _exact(start)) / _exact(step)
    whole = round(steps)
    if whole and abs(steps - whole) <= _HIT:
        return Steps(start, float(stop), whole + 1)
    whole = int(steps)
    return Steps(start, float(_exact(start) + whole * _exact(step)), whole + 1)


def _exact(value: float) -> Fraction:
    """Return the shortest decimal number that is stored as the given double.

    >>> _exact(0.1)
    Fraction(1, 10)
    """
    from fractions import Fraction

    if not isfinite(value):
        raise ValueError(f"read {value}, expected a finite number")
    return Fraction(repr(float(value)))
