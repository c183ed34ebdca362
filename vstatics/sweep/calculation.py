"""The variants of a part of a sweep -> rows, of a case or of a scenario."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.model.transmission import Transmission

if TYPE_CHECKING:
    from vstatics.sweep.chunk import Chunk
    from vstatics.sweep.plan import SweepPlan

MEASURED_RUNS = 8
"""So many runs tell how long all of them take."""


def calculate(plan: SweepPlan, start: int, stop: int) -> Chunk:
    """Calculate the variants from `start` up to `stop`.

    Parameters
    ----------
    plan : SweepPlan
    start, stop : int
        Numbers of variants, from 0; `stop` is not included.

    Returns
    -------
    Chunk
        With a row for each variant that passed the plan's condition.
    """
    subject = plan.subject
    if isinstance(subject, Transmission):
        from vstatics.sweep.blocks import calculate as of_blocks

        return of_blocks(plan, start, stop)
    from vstatics.sweep.runs import calculate as of_runs  # others need no simulation

    return of_runs(plan, subject, start, stop)


def middle(plan: SweepPlan) -> tuple[int, int]:
    """The ends of a block in the middle of a sweep, by which the whole is estimated."""
    start, stop = plan.span(plan.pieces // 2)
    if not isinstance(plan.subject, Transmission):
        return start, min(stop, start + MEASURED_RUNS)
    from vstatics.sweep.blocks import blocks

    ends = list(blocks(plan.subject, start, stop))
    return ends[len(ends) // 2]
