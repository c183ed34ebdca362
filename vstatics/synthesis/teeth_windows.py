"""Which ratios of an element are of use where its teeth are too many to list.

Only teeth with an error up to some limit are listed then: the limit grows from the least error
that any ratios could have, until enough teeth are found. All below it are known by then.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.synthesis.teeth_rows import TeethRows
from vstatics.synthesis.teeth_targets import TeethTarget, least_errors

SLICES = 64
"""A range of ratios is cut into so many."""
ROUNDS = 6
"""So often all ranges are cut."""
WIDEST = 20.0
"""Larger limits of errors are none."""
HALVINGS = 30


def ends_by_ranges(rows: TeethRows) -> tuple[Floats, Floats]:
    """The least and largest ratios that the ranges of teeth alone allow [-]."""
    low, high = [], []
    for ratio in rows.layout.ratios:
        sizes = [1.0, 1.0]
        for wheel, power in ratio.powers.items():
            ends = sorted(max(float(end), 1.0) ** power for end in rows.ends(wheel))
            sizes = [size * end for size, end in zip(sizes, ends, strict=True)]
        first, second = sorted(ratio.sign * size for size in sizes)
        low.append(first)
        high.append(second)
    return np.array(low), np.array(high)


def narrowed(
    targets: Sequence[TeethTarget], low: Floats, high: Floats, most: float
) -> tuple[Floats, Floats] | None:
    """Ranges of all ratios outside which every error is above `most`; None where all are.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from vstatics.synthesis.gear_formula import GearFormula
    >>> formula = GearFormula("ratio", {1: Fraction(1)}, {0: Fraction(1)})
    >>> target = TeethTarget("P", -3.0, formula, {0: 0}, "absolute")
    >>> ends = narrowed([target], np.array([-8.0]), np.array([-1.0]), 0.5)
    >>> bool(-3.6 < ends[0][0] <= -3.5), narrowed([target], *ends, 0.5) is not None
    (True, True)
    >>> narrowed([target], np.array([-8.0]), np.array([-4.0]), 0.5)
    """
    low, high = low.copy(), high.copy()
    for _ in range(ROUNDS):
        before = high - low
        for column in range(len(low)):
            sign = math.copysign(1.0, low[column])
            cuts = sign * np.geomspace(abs(low[column]), abs(high[column]), SLICES + 1)
            cuts[0], cuts[-1] = low[column], high[column]
            parts = np.repeat(low[np.newaxis], SLICES, axis=0)
            parts_high = np.repeat(high[np.newaxis], SLICES, axis=0)
            parts[:, column], parts_high[:, column] = cuts[:-1], cuts[1:]
            kept = np.flatnonzero(least_errors(targets, parts, parts_high) <= most)
            if not len(kept):
                return None
            low[column], high[column] = cuts[kept[0]], cuts[kept[-1] + 1]
        if (high - low > 0.9 * before).all():
            break
    return low, high


def limits_of_errors(targets: Sequence[TeethTarget], low: Floats, high: Floats) -> Iterator[float]:
    """Limits of errors to be tried in turn; the last one is none."""
    least, most = 0.0, WIDEST
    if narrowed(targets, low, high, most) is not None:
        for _ in range(HALVINGS):
            middle = (least + most) / 2
            if narrowed(targets, low, high, middle) is None:
                least = middle
            else:
                most = middle
        more = 1e-5
        while most + more < WIDEST:
            yield most + more
            more *= 4
    yield math.inf
