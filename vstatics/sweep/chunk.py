"""Chunk of a sweep: rows of a range of variants, with the status of each row.

The plan alone determines where ranges begin, so that results do not depend on the number of
processes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics import status
from vstatics.core.tables.written_results import GEAR
from vstatics.sweep.results.columns import output_headings
from vstatics.sweep.results.meanings import GearRows, Tables, WithStatus

if TYPE_CHECKING:
    import pandas as pd

    from vstatics.core.jobs.piece_file import Account, Noticed
    from vstatics.sweep.plan import SweepPlan

Codes = np.ndarray[Any, np.dtype[np.uint8]]

STATUS = (
    "ok",
    status.DRAGGED.name,
    status.NEUTRAL.name,
    status.UNDECIDED.name,
    status.LOCKED.name,
    "not assembled",
    status.TIED_UP.name,
    status.CONFLICT.name,
    "invalid",
    "stopped",
)
"""Statuses of a variant from harmless to severe. The worst status of all gears counts."""
DRAGGED, OPEN, UNDECIDED, LOCKED, NOT_ASSEMBLED, TIED_UP, CONFLICT, INVALID, STOPPED = range(
    1, len(STATUS)
)


OF_ROWS = ("places", "values", "status", "columns", "objectives")
"""Names of the fields of a chunk that have an entry for each row."""


class Chunk(NamedTuple):
    """Rows of the variants in a range that passed the condition of the sweep."""

    start: int
    """Value of `places` for the first row of the range, even if this row is missing."""
    places: Integers
    """Index of each row among the rows of all variants, from 0, shape (rows,).

    It is the number of the variant. If each gear has a row, it is this number times the number of
    gears, plus the index of the gear.
    """
    values: Floats
    """Varied numbers, shape (rows, targets). [-]"""
    status: Codes
    """Status of each row as an index into `STATUS`, shape (rows,)."""
    columns: Floats
    """Values of the columns of the plan, shape (rows, columns); NaN for undefined values."""
    objectives: Floats
    """Values of the objectives, shape (rows, objectives), negated if maximised, so smaller is
    better.
    """
    counts: Mapping[str, int]
    """Number of variants with each status in the whole range, including removed variants.

    If each gear has a row, rows are counted, here and in `removed`.
    """
    names: tuple[str, ...]
    """Names of the varied numbers."""
    headings: tuple[str, ...]
    """Headings of the columns."""
    removed: tuple[int, ...] = ()
    """Number of variants removed by each expression that `and` joins in the condition, in order."""
    gears: tuple[str, ...] = ()
    """Names of the gears if each gear has a row; otherwise empty."""
    outside: tuple[str, ...] = ()
    """Names of characteristic curves that were evaluated outside the given points."""
    noticed: tuple[Noticed, ...] = ()
    """Messages of simulated runs, each once for the whole range."""
    solved: int = 0
    """Number of variants in the whole range with a solution in all requested gears."""

    @property
    def variants(self) -> Integers:
        """Number of each row's variant, from 0, shape (rows,)."""
        return self.places // len(self.gears) if self.gears else self.places

    @property
    def of_gear(self) -> Codes:
        """Index of each row's gear, shape (rows,); empty if a row represents a whole variant."""
        gears: Codes = (
            (self.places % len(self.gears)).astype("<u2") if self.gears else np.zeros(0, "<u2")
        )
        return gears

    def to_dataframe(self) -> pd.DataFrame:
        """Return a pandas table with columns as in a file, and the number of the variant as index.

        Raises
        ------
        CaseError
            If pandas is missing.
        """
        from vstatics.core.extras import require

        require("pandas", "to_dataframe")
        import pandas as pd

        columns: dict[str, Any] = self.output_columns()
        codes = self.status.astype(np.int64)
        columns["status"] = pd.Categorical.from_codes(codes, categories=pd.Index(STATUS))
        if self.gears:
            of_gear = self.of_gear.astype(np.int64)
            columns[GEAR] = pd.Categorical.from_codes(of_gear, categories=pd.Index(self.gears))
        return pd.DataFrame(columns, index=pd.Index(columns.pop("variant"), name="variant"))

    def output_columns(self) -> dict[str, Floats | Integers | Codes]:
        """Return the columns of an output file, by heading."""
        by_gear = bool(self.gears)
        tables = (
            self.variants,
            *self.values.T,
            self.status,
            *[self.of_gear] * by_gear,
            *self.columns.T,
        )
        headings = output_headings(self.names, self.headings, by_gear=by_gear)
        return dict(zip(headings, tables, strict=True))

    def rows(self, chosen: Integers | Booleans) -> Chunk:
        """Return the chunk with the chosen rows only."""
        return self._replace(**{name: getattr(self, name)[chosen] for name in OF_ROWS})


def rows_of(  # noqa: PLR0913 PLR0917 (everything known of a block)
    plan: SweepPlan, start: int, values: Floats, status: Codes, tables: Tables, unknown: Booleans
) -> Chunk:
    """Return the rows of a block of variants that pass the condition of the plan.

    Parameters
    ----------
    plan : SweepPlan
    start : int
        Number of the first variant of the block.
    values : ndarray, shape (variants, targets)
        The varied numbers.
    status : ndarray, shape (variants[, gears])
    tables : Tables
        Results of these variants.
    unknown : ndarray, shape (variants,)
        Mask of variants without results, whose values are NaN and which never pass the condition.
    """
    has_solution = (status < TIED_UP).all(axis=tuple(range(1, status.ndim)))
    if gears := len(plan.gears):
        tables, status = GearRows(tables, gears), status.ravel()
        values, unknown = np.repeat(values, gears, axis=0), np.repeat(unknown, gears)
        start *= gears
    tables = WithStatus(tables, status == 0)
    with np.errstate(all="ignore"):
        columns = _existing(plan.columns(tables, values), unknown)
        objectives = _existing(plan.objective_values(tables, values), unknown)
        if not plan.takes_all:
            objectives[status == NOT_ASSEMBLED] = np.nan
        passed: Booleans | None = None
        removed: tuple[int, ...] = ()
        if plan.where is not None:
            passed, removed = plan.where.passed(tables, values, unknown)
    counts = np.bincount(status, minlength=len(STATUS)).tolist()
    chunk = Chunk(
        start,
        np.arange(start, start + len(values)),
        values,
        status,
        columns,
        objectives,
        {name: count for name, count in zip(STATUS, counts, strict=True) if count},
        plan.names,
        plan.headings,
        removed,
        plan.gears,
        solved=int(has_solution.sum()),
    )
    return chunk if passed is None or passed.all() else chunk.rows(passed)


def joined(parts: Sequence[Chunk]) -> Chunk:
    """Return several chunks as a single chunk, with all rows and the sums of the counts."""
    if len(parts) == 1:
        return parts[0]
    rows: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in OF_ROWS
    }
    return parts[0]._replace(
        counts=counted(parts),
        removed=removed_in(parts),
        outside=outside_in(parts),
        noticed=noticed_in(parts),
        solved=sum(part.solved for part in parts),
        **rows,
    )


def counted(parts: Iterable[Chunk | Account]) -> dict[str, int]:
    """Return the sums of `counts` over several ranges."""
    counts: Counter[str] = Counter()
    for part in parts:
        counts.update(part.counts)
    return dict(counts)


def removed_in(parts: Iterable[Chunk | Account]) -> tuple[int, ...]:
    """Return the sums of `removed` over several ranges."""
    return tuple(map(sum, zip(*(part.removed for part in parts), strict=True)))


def outside_in(parts: Iterable[Chunk | Account]) -> tuple[str, ...]:
    """Return the names of curves that were evaluated outside the given points in several ranges."""
    return tuple(dict.fromkeys(name for part in parts for name in part.outside))


def noticed_in(parts: Iterable[Chunk | Account]) -> tuple[Noticed, ...]:
    """Return the messages of several ranges. Messages that differ only in numbers are merged."""
    merged: dict[tuple[str, str], Noticed] = {}
    for notice in (notice for part in parts for notice in part.noticed):
        alike = notice.alike
        known = merged.get(alike)
        earlier = notice if known is None else min(known, notice, key=lambda each: each.first)
        merged[alike] = earlier._replace(
            variants=notice.variants + (known.variants if known else 0)
        )
    return tuple(merged.values())


def _existing(columns: Floats, unknown: Booleans) -> Floats:
    """Replace -0 by 0, and infinite or unknown values by NaN."""
    columns += 0.0
    infinite = np.isinf(columns)
    if infinite.any():
        columns[infinite] = np.nan
    if unknown.any():
        columns[unknown] = np.nan
    return columns
