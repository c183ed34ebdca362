"""A part of a sweep of a case: from a plan and two numbers of variants to the rows between.

Everything is calculated in blocks, so that the results of a block stay in tens of megabytes.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.sweep.block_tables import BlockTables, block_tables, possible_numbers
from vstatics.sweep.chunk import (
    CONFLICT,
    DRAGGED,
    INVALID,
    LOCKED,
    OPEN,
    TIED_UP,
    UNDECIDED,
    Chunk,
    Codes,
    joined,
    rows_of,
)

if TYPE_CHECKING:
    from vstatics.model.transmission import Transmission
    from vstatics.sweep.plan import SweepPlan

BLOCK_BYTES = 32 * 2**20
LEAST_BLOCK, MOST_BLOCK = 256, 16384


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
    own = solve(plan.case) if plan.asks_for_results else None
    parts = [_block(plan, own, *ends) for ends in blocks(plan.case, start, stop)]
    return joined(parts)


def blocks(case: Transmission, start: int, stop: int) -> Iterator[tuple[int, int]]:
    """The ends of the blocks of a part, of nearly equal size."""
    most = min(max(BLOCK_BYTES // variant_bytes(case), LEAST_BLOCK), MOST_BLOCK)
    number = -(-(stop - start) // most)
    ends = [start + (stop - start) * block // number for block in range(number + 1)]
    return pairwise(ends)


def variant_bytes(case: Transmission) -> int:
    """About how much memory the results of a variant take."""
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    numbers = 3 * case.links + 3 * elements + 5 * mechanisms + 2 * len(case.springs) + 11
    return len(case.gears) * (8 * numbers + elements + 2 * mechanisms + 6)


def _block(plan: SweepPlan, own: Results | None, start: int, stop: int) -> Chunk:
    """The rows of a block."""
    values = plan.variants.block(start, stop)
    possible, invalid = possible_numbers(plan.case, plan.targets, values)
    tables = block_tables(plan, possible)
    status = _status(tables, own, len(values))
    status[invalid] = INVALID
    return rows_of(plan, start, values, status, tables, invalid)


def _status(tables: BlockTables, own: Results | None, variants: int) -> Codes:
    """The worst that can be said of the gears of each variant.

    Whole arrays are asked first: most often nothing is to be said of any variant. Where modes
    alone are asked for it is said of the gears that are asked for.
    """
    status = np.zeros(variants, dtype=np.uint8)
    results, modes = tables
    if results is None or own is None:
        if modes is not None:
            status[modes.tied_up] = TIED_UP
            status[modes.conflict] = CONFLICT
        return status
    unlike = ((results.missing > 0) & (own.missing == 0), ~results.balanced & own.balanced)
    for code, said in (
        (DRAGGED, results.dragged),
        *((OPEN, wrong) for wrong in unlike),
        (UNDECIDED, results.undecided),
        (LOCKED, results.locked),
        (TIED_UP, results.tied_up),
        (CONFLICT, results.conflict),
    ):
        if said.any():
            status[said.any(axis=1)] = code
    return status
