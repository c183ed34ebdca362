"""Linear systems over the rational numbers: what has one value has it exactly."""

from collections.abc import Sequence
from fractions import Fraction

Row = list[Fraction]
ZERO, ONE = Fraction(0), Fraction(1)


def exact(value: float) -> Fraction:
    """The number that the shortest decimal of a float shows: -2.461 is -2461/1000."""
    return Fraction(repr(float(value)))


def sign(value: Fraction) -> int:
    """Sign of a number, 0 for zero."""
    return (value > 0) - (value < 0)


def times(*factors: Fraction | None) -> Fraction | None:
    """Product of numbers that may be unknown; 0 if one of them is known to be 0."""
    product = ONE
    for factor in factors:
        if factor == 0:
            return ZERO
    for factor in factors:
        if factor is None:
            return None
        product *= factor
    return product


class Linear:
    """The system ``matrix @ x = right`` in reduced row echelon form (Gauss-Jordan)."""

    def __init__(self, matrix: Sequence[Row], right: Row, size: int) -> None:
        """Eliminate; `size` is the number of unknowns, the matrix may have no rows."""
        self.size = size
        rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
        self.pivots: list[int] = []
        for column in range(size):
            self._clear(rows, column)
        self.rank = len(self.pivots)
        self.rows = rows[: self.rank]
        self.consistent = all(row[size] == 0 for row in rows[self.rank :])
        self.excess = len(rows) - self.rank
        self.missing = size - self.rank

    def _clear(self, rows: list[Row], column: int) -> None:
        """Make `column` a column of the unit matrix if a row is left for it."""
        rank = len(self.pivots)
        found = next((i for i in range(rank, len(rows)) if rows[i][column]), None)
        if found is None:
            return
        rows[rank], rows[found] = rows[found], rows[rank]
        pivot = rows[rank][column]
        rows[rank] = [number / pivot if number else number for number in rows[rank]]
        for i, row in enumerate(rows):
            factor = row[column]
            if i != rank and factor:
                rows[i] = [a - factor * b if b else a for a, b in zip(row, rows[rank], strict=True)]
        self.pivots.append(column)

    def functional(self, coefficients: Row, constant: Fraction = ZERO) -> Fraction | None:
        """``coefficients @ x + constant`` if all solutions agree on it, else None."""
        if not self.consistent:
            return None
        rest, value = list(coefficients), constant
        for pivot, row in zip(self.pivots, self.rows, strict=True):
            factor = coefficients[pivot]
            if factor:
                value += factor * row[self.size]
                rest = [a - factor * b for a, b in zip(rest, row, strict=False)]
        return None if any(rest) else value

    def unknown(self, index: int) -> Fraction | None:
        """One unknown, counted from 0."""
        return self.functional(self.unit(index))

    def unit(self, *indices: int) -> Row:
        """A row with +1 at the first index and -1 at a second one; -1 is no index."""
        row = [ZERO] * self.size
        for index, value in zip(indices, (ONE, -ONE), strict=False):
            if index >= 0:
                row[index] += value
        return row

    def loose(self) -> list[int]:
        """Indices of the unknowns that the homogeneous system leaves open."""
        open_columns = [c for c in range(self.size) if c not in self.pivots]
        moved = {
            pivot
            for pivot, row in zip(self.pivots, self.rows, strict=True)
            if any(row[c] for c in open_columns)
        }
        return sorted(moved | set(open_columns))
