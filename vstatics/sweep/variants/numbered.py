"""Numbered variants, which can be requested in any order and always have the same values."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Hashable, Iterable
from typing import Protocol

import numpy as np

from vstatics.core.errors import CaseError, Problem, ReadError, count_of
from vstatics.core.jobs.spool import Spool
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.steps import Steps
from vstatics.sweep.variants.targets import Varied
from vstatics.sweep.variants.variation import MOST, DrawnNumbers, Span, Variation


class Variants(Protocol):
    """Variants of a case, numbered from 0, with the values of the varied numbers."""

    @property
    def targets(self) -> tuple[Varied, ...]:
        """Varied numbers, in the order of the columns of a block."""

    @property
    def count(self) -> int:
        """Number of variants."""

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of the variants from `start` up to, but excluding, `stop`.

        The shape is (stop - start, len(targets)), and each column is contiguous. Blocks can be
        requested in any order; the values of a variant never change.
        """


class VariantGrid:
    """Grid of all combinations of values; the values of the last variation change fastest.

    Parameters
    ----------
    variations : iterable of Variation
        Varied numbers with lists or steps of values, not with ranges.

    Raises
    ------
    ReadError
        If a number is varied twice, or has a range instead of values.
    CaseError
        If there are 2**63 variants or more.

    Examples
    --------
    >>> from vstatics.sweep.variants.targets import Target
    >>> ratio, efficiency = Target("D1.ratio", 0, "ratio"), Target("D1.efficiency", 0, "efficiency")
    >>> grid = VariantGrid([Variation(ratio, Steps(-3, -2, 3)),
    ...              Variation(efficiency, np.array([0.95, 0.97]))])
    >>> grid.count
    6
    >>> grid.block(1, 4)
    array([[-3.  ,  0.97],
           [-2.5 ,  0.95],
           [-2.5 ,  0.97]])
    """

    def __init__(self, variations: Iterable[Variation]) -> None:
        self.targets, self.values = _listed(list(variations))
        self.count = math.prod(map(len, self.values))
        if self.count > MOST:
            message = f"the grid has {self.count} variants, expected fewer than 2**63: "
            raise CaseError("E704", message + "give fewer values, or take a sample")

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of a block of variants; see `Variants`."""
        block = empty_block(self, start, stop)
        numbers = np.arange(start, stop)
        for column, values in reversed(list(enumerate(self.values))):
            numbers, indices = np.divmod(numbers, len(values))
            block[:, column] = values[indices]
        return block


class Zip:
    """Variants of parallel lists: first the first values of all numbers, then the second values.

    Parameters
    ----------
    variations : iterable of Variation
        Varied numbers with lists or steps of equal length.

    Raises
    ------
    ReadError
        If a number is varied twice, has a range instead of values, or the numbers of values differ.
    """

    def __init__(self, variations: Iterable[Variation]) -> None:
        variations = list(variations)
        self.targets, self.values = _listed(variations)
        self.count = len(self.values[0]) if self.values else 0
        problems = [
            Problem(
                "E705",
                f"{variation.target.name} has {count_of('value', len(values))}, but "
                f"{self.targets[0].name} has {self.count}: pairs need the same number of values",
                place=variation.place,
            )
            for variation, values in zip(variations, self.values, strict=True)
            if len(values) != self.count
        ]
        if problems:
            raise ReadError(problems)

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of a block of variants; see `Variants`."""
        block = empty_block(self, start, stop)
        numbers = np.arange(start, stop)
        for column, values in enumerate(self.values):
            block[:, column] = values[numbers]
        return block


class VariantTable:
    """Variants from a table given by the user, a variant in each row.

    The rows of a `Spool` are in a temporary file, so that pickled copies are small; call `close`
    after use.

    Parameters
    ----------
    targets : iterable of Varied
        Varied numbers, in the order of the columns.
    rows : ndarray, shape (variants, targets), or Spool
        Rows in memory, or in a temporary file.
    digest : str, optional
        Hash of the rows, by which plans distinguish tables; by default it is calculated from an
        array.

    Examples
    --------
    >>> from vstatics.sweep.variants.targets import Target
    >>> table = VariantTable([Target("D1.ratio", 0, "ratio")], np.array([[-2.0], [-3.0]]))
    >>> table.count, table.block(1, 2)
    (2, array([[-3.]]))
    """

    def __init__(
        self, targets: Iterable[Varied], rows: Floats | Spool, digest: str | None = None
    ) -> None:
        self.targets = tuple(targets)
        if not isinstance(rows, Spool):
            rows = np.array(rows, np.float64, order="F")
            if rows.ndim != 2 or rows.shape[1] != len(self.targets):
                expected = f"(variants, {len(self.targets)})"
                raise ValueError(f"read a table of shape {rows.shape}, expected {expected}")
            digest = digest or hashlib.sha256(np.ascontiguousarray(rows).data).hexdigest()
        self._rows, self.digest = rows, digest
        self.count = rows.rows if isinstance(rows, Spool) else len(rows)

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of a block of variants; see `Variants`."""
        block = empty_block(self, start, stop)
        rows = self._rows
        block[:] = rows.take(start, stop) if isinstance(rows, Spool) else rows[start:stop]
        return block

    def close(self) -> None:
        """Remove the temporary file if created by the current process."""
        if isinstance(self._rows, Spool):
            self._rows.close()


class VariantPart:
    """Values of a range of variants of a table, for a computer without the table.

    >>> from vstatics.sweep.variants.targets import Target
    >>> table = VariantTable([Target("D1.ratio", 0, "ratio")], np.array([[-2.0], [-3.0], [-4.0]]))
    >>> VariantPart(table, 1, 3).block(2, 3)
    array([[-4.]])
    """

    def __init__(self, whole: Variants, start: int, stop: int) -> None:
        self.targets = whole.targets
        self.count = whole.count
        self.start = start
        self.values = whole.block(start, stop)

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of variants `start` up to, but excluding, `stop`; see `Variants`.

        All these variants must lie within the part.
        """
        end = self.start + len(self.values)
        if not self.start <= start <= stop <= end:
            raise IndexError(f"variants {start} to {stop} of a part from {self.start} to {end}")
        return np.array(self.values[start - self.start : stop - self.start], order="F")


def empty_block(variants: Variants, start: int, stop: int) -> Floats:
    """Return an uninitialised array for a block of variants, each column contiguous.

    Raises
    ------
    IndexError
        If the variants do not exist.
    """
    if not 0 <= start <= stop <= variants.count:
        raise IndexError(f"variants {start} to {stop} of {variants.count}")
    return np.empty((stop - start, len(variants.targets)), order="F")


def checked_targets(variations: Iterable[Variation]) -> tuple[Varied, ...]:
    """Return the varied numbers of variations.

    Raises
    ------
    ReadError
        If a number is varied twice or has no values.
    """
    seen: set[Hashable] = set()
    problems = []
    targets = []
    for target, values, place in variations:
        if target.numbers & seen:
            message = f"{target.name} is varied twice, expected each number once"
            problems.append(Problem("E706", message, place=place))
        if not isinstance(values, Span | DrawnNumbers) and not len(values):
            message = f"{target.name} has no values, expected at least one"
            problems.append(Problem("E707", message, place=place))
        seen |= target.numbers
        targets.append(target)
    if problems:
        raise ReadError(problems)
    return tuple(targets)


def _listed(variations: list[Variation]) -> tuple[tuple[Varied, ...], tuple[Floats | Steps, ...]]:
    targets = checked_targets(variations)
    listed: list[Floats | Steps] = []
    problems: list[Problem] = []
    for target, values, place in variations:
        if isinstance(values, Span):
            span = f"{values.low:g}:{values.high:g}"
            message = (
                f"{target.name}={span} needs the number of values, such as {span}:5 for five values"
            )
            problems.append(Problem("E708", f"{message}, or --sample N", place=place))
        elif isinstance(values, DrawnNumbers):
            message = f"{target.name} has a distribution, expected values, or a sample"
            problems.append(Problem("E709", message, place=place))
        else:
            listed.append(values)
    if problems:
        raise ReadError(problems)
    return targets, tuple(listed)
