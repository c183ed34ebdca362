"""Fixed points ``x = f(x)`` of functions that change little from call to call."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

_MOST_SECANTS = 40
"""Largest number of secant steps from a starting point."""

Vector = Sequence[float]


class FixedPoints:
    """Fixed points of functions of a few unknowns, by the secant method of Broyden (1965).

    The slopes of a function are reused for the next function, which then needs few evaluations.

    Parameters
    ----------
    size : int
        Number of unknowns.

    Examples
    --------
    >>> fixed_points = FixedPoints(1)
    >>> def function(x):
    ...     return [0.5 + 0.2 * math.cos(x[0])]
    >>> [x] = fixed_points.near([1.0], function, [1e-14])
    >>> abs(0.5 + 0.2 * math.cos(x) - x) <= 1e-14
    True
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self._begin_again()

    def _begin_again(self) -> None:
        places = range(self.size)
        self.slopes = [[float(row == column) for column in places] for row in places]
        """Approximate inverse of the derivative of ``x - f(x)``."""

    def near(
        self, begin: Vector, function: Callable[[Vector], Vector], least: Vector
    ) -> Vector | None:
        """Return a fixed point whose residual is at most `least`, None if the search fails.

        Among several fixed points, it is usually the nearest to `begin`.
        """
        same = self._by_secants(begin, function, least)
        if same is None:
            self._begin_again()
            same = self._by_secants(begin, function, least)
        if same is None and all(map(math.isfinite, function(begin))):
            from scipy.optimize import root

            def left(x: Vector) -> list[float]:
                return [after - before for after, before in zip(function(x), x, strict=True)]

            self._begin_again()
            near = root(left, begin).x.tolist()  # type: ignore[arg-type] # scipy accepts lists
            same = self._by_secants(near, function, least)
        return same

    def _by_secants(
        self, begin: Vector, function: Callable[[Vector], Vector], least: Vector
    ) -> Vector | None:
        at, after = begin, function(begin)
        left = [y - x for x, y in zip(at, after, strict=True)]
        for _ in range(_MOST_SECANTS):
            if all(abs(size) <= limit for size, limit in zip(left, least, strict=True)):
                return at
            if not all(map(math.isfinite, left)):
                return None
            change = _times(self.slopes, left)
            at = [x + dx for x, dx in zip(at, change, strict=True)]
            before, left = left, [y - x for x, y in zip(at, function(at), strict=True)]
            turned = [old - new for old, new in zip(before, left, strict=True)]
            self._update(change, _times(self.slopes, turned))
        return None

    def _update(self, change: Vector, moved: Vector) -> None:
        """Update the slopes to map the last change of the residual to the last step."""
        along = _dot(change, moved)
        if not along:
            return
        shares = [_dot(change, column) for column in zip(*self.slopes, strict=True)]
        for row, wanted, given in zip(self.slopes, change, moved, strict=True):
            factor = (wanted - given) / along
            row[:] = [old + factor * share for old, share in zip(row, shares, strict=True)]


def _times(matrix: Sequence[Vector], vector: Vector) -> list[float]:
    return [_dot(row, vector) for row in matrix]


def _dot(first: Vector, second: Vector) -> float:
    return sum(map(math.prod, zip(first, second, strict=True)))
