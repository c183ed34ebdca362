"""Rows of a sweep, and what can be said of each.

Where blocks of variants begin is told by the plan alone, never by who calculates them: the
same build gives the same numbers for any number of jobs.
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
    *(one.name for one in (status.DRAGGED, status.NEUTRAL, status.UNDECIDED, status.LOCKED)),
    "not assembled",
    *(one.name for one in (status.TIED_UP, status.CONFLICT)),
    *("invalid", "stopped"),
)
"""What can be said of a variant, the worse the later; a variant has the worst of its gears."""
DRAGGED, OPEN, UNDECIDED, LOCKED, NOT_ASSEMBLED, TIED_UP, CONFLICT, INVALID, STOPPED = range(
    1, len(STATUS)
)


OF_ROWS = ("places", "values", "status", "columns", "objectives")
"""The fields of a chunk that have a row for each of its variants."""


class Chunk(NamedTuple):
    """The variants of a part of a sweep that passed its conditions."""

    start: int
    """The first variant of the part, from 0."""
    places: Integers
    """(rows,) in the order of all variants, or of all their gears where these have rows."""
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
    removed: tuple[int, ...] = ()
    """Of those that are left, how many each part of the condition removed."""
    gears: tuple[str, ...] = ()
    """Names of the gears of a variant, where each has a row."""
    outside: tuple[str, ...] = ()
    """Laws that were asked outside their points."""
    noticed: tuple[Noticed, ...] = ()
    """Messages of runs, each once for all of the part that have it."""

    @property
    def variants(self) -> Integers:
        """(rows,) numbers of the variants."""
        return self.places // len(self.gears) if self.gears else self.places

    @property
    def of_gear(self) -> Codes:
        """(rows,) index of the gear; none where a row is of a variant."""
        gears: Codes = (
            (self.places % len(self.gears)).astype("<u2") if self.gears else np.zeros(0, "<u2")
        )
        return gears

    def to_dataframe(self) -> pd.DataFrame:
        """One row per variant, which is the index, with columns named as in a file.

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
        """What is written of the rows, by the headings of the output."""
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
        """The chunk with these rows only."""
        return self._replace(**{name: getattr(self, name)[chosen] for name in OF_ROWS})


def rows_of(  # noqa: PLR0913 PLR0917 (what is known of a block)
    plan: SweepPlan, start: int, values: Floats, status: Codes, tables: Tables, unknown: Booleans
) -> Chunk:
    """The rows of a block of variants, of those that pass the plan's condition.

    Parameters
    ----------
    plan : SweepPlan
    start : int
        The first variant.
    values : ndarray, shape (variants, targets)
        The varied numbers.
    status : ndarray, shape (variants[, gears])
    tables : Tables
        What was calculated of these variants.
    unknown : ndarray, shape (variants,)
        Of which variants nothing is known: they have NaN, and pass no condition.
    """
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
    )
    return chunk if passed is None or passed.all() else chunk.rows(passed)


def joined(parts: Sequence[Chunk]) -> Chunk:
    """The rows of several chunks, and all that was counted, as one."""
    if len(parts) == 1:
        return parts[0]
    rows: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in parts]) for name in OF_ROWS
    }
    rows |= {"counts": counted(parts), "removed": removed_in(parts)}
    rows |= {"outside": outside_in(parts), "noticed": noticed_in(parts)}
    return parts[0]._replace(**rows)


def counted(parts: Iterable[Chunk | Account]) -> dict[str, int]:
    """How many variants of several parts have a status."""
    counts: Counter[str] = Counter()
    for part in parts:
        counts.update(part.counts)
    return dict(counts)


def removed_in(parts: Iterable[Chunk | Account]) -> tuple[int, ...]:
    """How many variants of several parts each part of the condition removed."""
    return tuple(map(sum, zip(*(part.removed for part in parts), strict=True)))


def outside_in(parts: Iterable[Chunk | Account]) -> tuple[str, ...]:
    """Laws that were asked outside their points in any of several parts."""
    return tuple(dict.fromkeys(name for part in parts for name in part.outside))


def noticed_in(parts: Iterable[Chunk | Account]) -> tuple[Noticed, ...]:
    """Messages of several parts, each once where it differs in numbers alone."""
    found: dict[tuple[str, str], Noticed] = {}
    for one in (one for part in parts for one in part.noticed):
        alike = one.alike
        known = found.get(alike)
        earlier = one if known is None else min(known, one, key=lambda each: each.first)
        found[alike] = earlier._replace(variants=one.variants + (known.variants if known else 0))
    return tuple(found.values())


def _existing(columns: Floats, unknown: Booleans) -> Floats:
    """Columns without -0, with NaN for what is infinite or of which nothing is known."""
    columns += 0.0
    infinite = np.isinf(columns)
    if infinite.any():
        columns[infinite] = np.nan
    if unknown.any():
        columns[unknown] = np.nan
    return columns
