"""Best rows of a sweep, selected first within each piece, then among all pieces.

The best rows of the sweep are among the best rows of their pieces, so each piece stores few rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import numpy as np

from vstatics.core.numerics import fronts
from vstatics.core.numerics.arrays import Integers
from vstatics.sweep.chunk import Chunk, joined
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results import selection

BEST = 20
"""Default number of best rows for a single objective."""


def within(plan: SweepPlan, chunk: Chunk) -> Chunk:
    """Return the rows of a chunk that can be among the best rows of the sweep."""
    if len(plan.objectives) == 1:
        return chunk.rows(selection.best(chunk.objectives[:, 0], plan.best or BEST))
    return chunk.rows(fronts.non_dominated(chunk.objectives))


def among(plan: SweepPlan, chunks: Callable[[], Iterable[Chunk]]) -> Iterator[Chunk]:
    """Yield the best rows of several chunks, sorted by the objective or, with several, by variant.

    Parameters
    ----------
    plan : SweepPlan
    chunks : callable
        Function that yields all chunks in order, each with its best rows. With several objectives
        it is called twice, so that only the objectives are in memory.
    """
    if len(plan.objectives) == 1:
        best_rows: Chunk | None = None
        for chunk in chunks():
            best_rows = chunk if best_rows is None else within(plan, joined([best_rows, chunk]))
        if best_rows is not None:
            yield best_rows
        return
    variants = _front(plan, chunks())
    for chunk in chunks():
        if len(chunk.places):
            ends = np.searchsorted(variants, chunk.places[[0, -1]] + (0, 1))
            yield chunk.rows(np.isin(chunk.places, variants[slice(*ends)], assume_unique=True))


def _front(plan: SweepPlan, chunks: Iterable[Chunk]) -> Integers:
    objectives = np.zeros((0, len(plan.objectives)))
    variants = np.zeros(0, dtype=np.int64)
    for chunk in chunks:
        old, new = fronts.merged(objectives, chunk.objectives)
        objectives = np.concatenate([objectives[old], chunk.objectives[new]])
        variants = np.concatenate([variants[old], chunk.places[new]])
    if plan.best is not None:
        variants = variants[selection.limited(objectives, plan.best)]
    return variants
