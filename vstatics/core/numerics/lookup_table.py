"""Tables of values over one or two variables, with linear interpolation."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers


class LookupTable(NamedTuple):
    """Lookup table with linear interpolation between the points and constant values outside.

    Parameters
    ----------
    x : sequence of float
        Variable of the rows, ascending. A table of one variable jumps at an x that appears twice,
        and has the later value there.
    values : sequence of sequence of float
        Row of values for each x, with one value for each of `columns`.
    columns : sequence of float
        Variable of the columns, ascending. A table with a single column has one variable.

    Examples
    --------
    >>> engine = LookupTable((100.0, 300.0), ((0.0, 200.0), (0.0, 100.0)), (0.0, 1.0))
    >>> engine.at(200.0, 0.5), engine.at(0.0, 2.0)
    (75.0, 200.0)
    >>> LookupTable((0.0, 1.0), ((0.5,), (1.0,))).at(0.5)
    0.75
    """

    x: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]
    columns: tuple[float, ...] = (0.0,)

    @property
    def variables(self) -> int:
        """Number of variables, 1 or 2."""
        return 1 if len(self.columns) == 1 else 2

    def at(self, x: float, y: float = 0.0) -> float:
        """Return the value at x and y."""
        row, part = _place(self.x, x)
        if len(self.columns) == 1:
            first, last = self.values[row][0], self.values[row + (part > 0)][0]
            return first + part * (last - first)
        column, share = _place(self.columns, y)
        next_column = column + (share > 0)
        ends = [
            row_values[column] + share * (row_values[next_column] - row_values[column])
            for row_values in (self.values[row], self.values[row + (part > 0)])
        ]
        return ends[0] + part * (ends[1] - ends[0])

    def along(self, x: Any, y: Any = 0.0) -> Floats:
        """Return the values at arrays of x and y."""
        (row, part), values = _places(self.x, np.asarray(x, float)), np.array(self.values)
        behind = row + (part > 0)
        if len(self.columns) == 1:
            return np.asarray(values[row, 0] + part * (values[behind, 0] - values[row, 0]))
        column, share = _places(self.columns, np.asarray(y, float))
        next_column = column + (share > 0)
        first, last = (
            values[index, column] + share * (values[index, next_column] - values[index, column])
            for index in (row, behind)
        )
        return np.asarray(first + part * (last - first))

    def values_over(self, x: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Return bounds of the values at x for y from `low` to `high`.

        The bounds are exact where x is a row, or at most one column is between `low` and `high`.
        """
        start = np.searchsorted(self.columns, low, "right")
        stop = np.searchsorted(self.columns, high, "left")
        ends = self.along(x, low), self.along(x, high)
        inner = self._extremes(np.array(self.values), x, start, np.maximum(start + 1, stop))
        bounds = zip((np.minimum, np.maximum), inner, strict=True)
        least, largest = (
            np.where(stop > start, f(f(*ends), values), f(*ends)) for f, values in bounds
        )
        return least, largest

    def slopes_over(self, x: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Return bounds of the slopes over y at x, for y from `low` to `high`."""
        slopes = np.diff(self.values) / np.diff(self.columns)
        start = np.searchsorted(self.columns, low, "right")
        stop = np.searchsorted(self.columns, high, "left")
        start, stop = np.minimum(start, stop), np.maximum(start, stop) + 1
        return self._extremes(np.pad(slopes, ((0, 0), (1, 1))), x, start, stop)

    def _extremes(
        self, numbers: Floats, x: Floats, start: Integers, stop: Integers
    ) -> tuple[Floats, Floats]:
        """Return bounds of `numbers`, interpolated at x, in columns from `start` to before `stop`.

        Each level contains the extremes over twice as many neighbours as the level before.
        """
        row, part = _places(self.x, x)
        level = np.frexp(stop - start)[1] - 1
        extremes = []
        for function in (np.minimum, np.maximum):
            levels = [numbers]
            for width in 2 ** np.arange(int(level.max(initial=0))):
                levels.append(function(levels[-1], np.roll(levels[-1], -width, axis=1)))
            both = np.array(levels)
            at = (
                np.minimum(start, numbers.shape[1] - 1),
                np.minimum(stop, numbers.shape[1]) - 2**level,
            )
            first, last = (
                function(*(both[level, index, place] for place in at))
                for index in (row, row + (part > 0))
            )
            extremes.append(first + part * (last - first))
        return extremes[0], extremes[1]

    def line_at(self, x: float) -> tuple[float, float]:
        """Return the straight line that the table follows near x, as value at 0 and slope.

        The table must have a single variable.
        """
        row, part = _place(self.x, x)
        if not part:
            return self.values[row][0], 0.0
        slope = (self.values[row + 1][0] - self.values[row][0]) / (self.x[row + 1] - self.x[row])
        return self.values[row][0] - slope * self.x[row], slope


def _place(steps: Sequence[float], x: float) -> tuple[int, float]:
    """Return the index of the point before x, and the position of x in the interval (0 to 1)."""
    behind = bisect_right(steps, x)
    if behind in (0, len(steps)):
        return max(0, behind - 1), 0.0
    first, last = steps[behind - 1 : behind + 1]
    return behind - 1, (x - first) / (last - first)


def _places(steps: Sequence[float], x: Floats) -> tuple[Integers, Floats]:
    at = np.array(steps)
    behind = np.searchsorted(at, x, side="right")
    inside = (behind > 0) & (behind < len(at))
    row = np.clip(behind, 1, len(at)) - 1
    first, last = at[row], at[np.minimum(row + 1, len(at) - 1)]
    part = np.where(inside, (x - first) / np.where(inside, last - first, 1.0), 0.0)
    return row, part
