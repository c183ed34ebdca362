"""A part of a sweep: from a plan and two numbers of variants to the rows between them.

Everything is calculated in blocks, so that the results of a block stay in tens of
megabytes. Where blocks begin is told by the case and the part alone, never by who
calculates it: the same build gives the same numbers for any number of jobs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.statics import status
from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.sweep.block_tables import BlockTables, block_tables, possible_numbers

if TYPE_CHECKING:
    import pandas as pd

    from vstatics.jobs.pieces import Account
    from vstatics.model.transmission import Transmission
    from vstatics.sweep.plan import SweepPlan

Codes = np.ndarray[Any, np.dtype[np.uint8]]

_OF_GEARS = (status.NEUTRAL, status.UNDECIDED, status.LOCKED, status.TIED_UP, status.CONFLICT)
STATUS = ("ok", *(one.name for one in _OF_GEARS), "invalid")
"""What can be said of a variant, the worse the later; a variant has the worst of its gears."""
OPEN, UNDECIDED, LOCKED, TIED_UP, CONFLICT, INVALID = range(1, len(STATUS))

BLOCK_BYTES = 32 * 2**20
LEAST_BLOCK, MOST_BLOCK = 256, 16384


class Chunk(NamedTuple):
    """The variants of a part of a sweep that passed its conditions."""

    start: int
    """The first variant of the part, from 0."""
    variants: Integers
    """(rows,) numbers of the variants."""
    values: Floats
    """(rows, targets): the varied numbers. [-]"""
    status: Codes
    """(rows,) index into `STATUS`."""
    columns: Floats
    """(rows, columns): what was asked for; NaN does not exist."""
    objectives: Floats
    """(rows, objectives): what is to be small, or large."""
    counts: Mapping[str, int]
    """How many variants of the whole part have a status, those without a row too."""
    names: tuple[str, ...]
    """Of the varied numbers."""
    headings: tuple[str, ...]
    """Of the columns."""

    def to_dataframe(self) -> pd.DataFrame:
        """One row per variant, which is the index, with columns named as in a file.

        Raises
        ------
        CaseError
            If pandas is missing.
        """
        from vstatics.extras import require

        require("pandas", "to_dataframe")
        import pandas as pd

        codes = self.status.astype(np.int64)
        status: Any = pd.Categorical.from_codes(codes, categories=pd.Index(STATUS))
        columns: dict[str, Any] = {
            **dict(zip(self.names, np.transpose(self.values), strict=True)),
            "status": status,
            **dict(zip(self.headings, self.columns.T, strict=True)),
        }
        return pd.DataFrame(columns, index=pd.Index(self.variants, name="variant"))

    def rows(self, chosen: Integers | Booleans) -> Chunk:
        """The chunk with these rows only."""
        return self._replace(
            variants=self.variants[chosen],
            values=self.values[chosen],
            status=self.status[chosen],
            columns=self.columns[chosen],
            objectives=self.objectives[chosen],
        )


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


def joined(parts: Sequence[Chunk]) -> Chunk:
    """The rows of several chunks, and all that was counted, as one."""
    if len(parts) == 1:
        return parts[0]
    fields = ("variants", "values", "status", "columns", "objectives")
    rows: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in fields
    }
    return parts[0]._replace(**rows, counts=counted(parts))


def counted(parts: Iterable[Chunk | Account]) -> dict[str, int]:
    """How many variants of several parts have a status."""
    counts: Counter[str] = Counter()
    for part in parts:
        counts.update(part.counts)
    return dict(counts)


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
    """The rows of a block; the plan's condition is asked before columns are made."""
    values = plan.variants.block(start, stop)
    possible, invalid = possible_numbers(plan.case, plan.variants.targets, values)
    tables = block_tables(plan, possible)
    status = _status(tables, own, len(values))
    status[invalid] = INVALID
    with np.errstate(all="ignore"):
        columns = _existing(plan.columns(tables, values), invalid)
        objectives = _existing(plan.objective_values(tables, values), invalid)
        passed = None if plan.where is None else plan.where(tables, values).astype(np.bool_)
    counts = np.bincount(status, minlength=len(STATUS)).tolist()
    chunk = Chunk(
        start,
        np.arange(start, stop),
        values,
        status,
        columns,
        objectives,
        {name: count for name, count in zip(STATUS, counts, strict=True) if count},
        plan.names,
        plan.headings,
    )
    if passed is None:
        return chunk
    passed &= ~invalid
    return chunk if passed.all() else chunk.rows(passed)


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
        *((OPEN, wrong) for wrong in unlike),
        (UNDECIDED, results.undecided),
        (LOCKED, results.locked),
        (TIED_UP, results.tied_up),
        (CONFLICT, results.conflict),
    ):
        if said.any():
            status[said.any(axis=1)] = code
    return status


def _existing(columns: Floats, invalid: Booleans) -> Floats:
    """Columns without -0, with NaN for what is infinite or belongs to an invalid variant."""
    columns += 0.0
    infinite = np.isinf(columns)
    if infinite.any():
        columns[infinite] = np.nan
    if invalid.any():
        columns[invalid] = np.nan
    return columns
