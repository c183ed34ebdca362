"""The best rows of a sweep: of a piece, then among those of all pieces.

What is best of all is best of its piece, so each piece keeps few rows.
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
"""So many rows by one objective, where nobody asks for another number."""


def within(plan: SweepPlan, chunk: Chunk) -> Chunk:
    """The rows of a chunk that may be among the best of all."""
    if len(plan.objectives) == 1:
        return chunk.rows(selection.best(chunk.objectives[:, 0], plan.best or BEST))
    return chunk.rows(fronts.non_dominated(chunk.objectives))


def among(plan: SweepPlan, chunks: Callable[[], Iterable[Chunk]]) -> Iterator[Chunk]:
    """The best rows of several chunks: of one objective sorted, else in order of variants.

    Parameters
    ----------
    plan : SweepPlan
    chunks : callable
        Gives all chunks, in order, each with the best of its rows; it is asked twice where
        there are several objectives, so that only these have to be in memory.
    """
    if len(plan.objectives) == 1:
        kept: Chunk | None = None
        for chunk in chunks():
            kept = chunk if kept is None else within(plan, joined([kept, chunk]))
        if kept is not None:
            yield kept
        return
    variants = _front(plan, chunks())
    for chunk in chunks():
        if len(chunk.places):
            ends = np.searchsorted(variants, chunk.places[[0, -1]] + (0, 1))
            yield chunk.rows(np.isin(chunk.places, variants[slice(*ends)], assume_unique=True))


def _front(plan: SweepPlan, chunks: Iterable[Chunk]) -> Integers:
    """The numbers of the variants that no other dominates, or so many of them as are asked for."""
    objectives = np.zeros((0, len(plan.objectives)))
    variants = np.zeros(0, dtype=np.int64)
    for chunk in chunks:
        old, new = fronts.merged(objectives, chunk.objectives)
        objectives = np.concatenate([objectives[old], chunk.objectives[new]])
        variants = np.concatenate([variants[old], chunk.places[new]])
    if plan.best is not None:
        variants = variants[selection.limited(objectives, plan.best)]
    return variants
