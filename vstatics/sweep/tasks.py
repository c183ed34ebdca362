"""Task of a worker process: the calculation of a piece of a sweep."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.jobs import piece_file
from vstatics.core.jobs.alone import Workers
from vstatics.core.jobs.piece_file import Account, Copy
from vstatics.core.jobs.workers import workers
from vstatics.sweep import blocks
from vstatics.sweep.chunk import Chunk
from vstatics.sweep.formats import TEXTS, Format, text
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results import best
from vstatics.sweep.results.linked import table_of
from vstatics.sweep.variants.numbered import VariantPart


class SweepTask(NamedTuple):
    """Data that every worker of a sweep receives: the plan and the form of the output."""

    plan: SweepPlan
    form: Format
    directory: str = ""
    raw: bool = False
    """True to write CSV headings without the apostrophe that prevents use as formulas."""
    work: str = ""
    """Hash of everything that determines the result, by which stored pieces are recognised."""

    def describe(self, item: object) -> str:
        """Return the variants of a piece in words, for messages about the work."""
        piece = _number(item)
        if not isinstance(piece, int):
            return "putting the output together"
        start, stop = self.plan.span(piece)
        return f"variants {start} to {stop - 1}"

    def workers(self, jobs: int, scheduler: str | None = None) -> Workers:
        """Return workers for the pieces. There are at most as many processes as pieces."""
        jobs = min(jobs, self.plan.pieces)
        return workers(self, self.describe, jobs=jobs, scheduler=scheduler)


class Portion(NamedTuple):
    """Piece of a sweep with the values of its variants, for a worker without access to the file."""

    piece: int
    variants: VariantPart


Item = int | Portion


def items(task: SweepTask, pieces: Iterable[int], *, remote: bool) -> Iterator[Item]:
    """Yield the numbers of pieces; for remote workers, pieces with the values of the variants."""
    variants = task.plan.variants
    for piece in pieces:
        if remote and table_of(variants):
            yield Portion(piece, VariantPart(variants, *task.plan.span(piece)))
        else:
            yield piece


def calculate(task: SweepTask, item: Item) -> Chunk:
    """Calculate a piece, and return the rows that can be in the output."""
    plan, piece = task.plan, _number(item)
    if isinstance(item, Portion):
        plan = replace(plan, variants=item.variants)
    rows = blocks.calculate(plan, *plan.span(piece))
    return best.within(plan, rows) if plan.objectives else rows


def _number(item: Any) -> Any:
    return item.piece if isinstance(item, Portion) else item


def lines(task: SweepTask, item: Item) -> tuple[Account, bytes]:
    """Calculate a piece, and return its account (counts and messages) and its rows as text."""
    rows = calculate(task, item)
    notes = rows.removed, rows.outside, rows.noticed, rows.solved
    account = Account(_number(item), len(rows.variants), dict(rows.counts), (), *notes)
    return account, text.rows(task.form, rows)


def piece_data(task: SweepTask, item: Item) -> tuple[Account, list[Any]]:
    """Calculate a piece, and return its account (counts and messages) and its rows as stored."""
    rows = calculate(task, item)
    data = columns_of(rows) if task.plan.objectives else data_of(task.form, rows)
    counts = dict(rows.counts)
    notes = rows.removed, rows.outside, rows.noticed, rows.solved, task.work
    return piece_file.piece_bytes(_number(item), len(rows.variants), counts, data, *notes)


def piece_sent(task: SweepTask, item: Item) -> tuple[Account, bytes]:
    """Calculate a piece, and return its account and its stored form as sent between machines."""
    account, data = piece_data(task, item)
    return account, b"".join(memoryview(segment).cast("B") for segment in data)


def write_piece(task: SweepTask, piece: int) -> Account:
    """Calculate and store a piece, and return its account (counts and messages)."""
    account, data = piece_data(task, piece)
    piece_file.write_piece(task.directory, piece, data)
    return account


def copy(task: SweepTask, copies: Sequence[Copy]) -> int:
    """Copy segments of pieces into the output, and return the number of bytes."""
    return piece_file.copy(task.directory, copies)


def data_of(form: Format, rows: Chunk) -> list[Any]:
    """Return the rows of a chunk in the stored form: as text, or as columns."""
    return [text.rows(form, rows)] if form in TEXTS else columns_of(rows)


def columns_of(rows: Chunk) -> list[Any]:
    """Return the columns of a chunk as contiguous arrays."""
    return [
        np.ascontiguousarray(column, dtype=column.dtype.newbyteorder("<"))
        for column in (*rows.output_columns().values(), *rows.objectives.T)
    ]


def read_chunk(task: SweepTask, account: Account) -> Chunk:
    """Read a piece that was stored as columns."""
    data = piece_file.read_segments(task.directory, account)
    names, headings, gears = task.plan.names, task.plan.headings, task.plan.gears
    values = 1 + len(names)
    first = values + 1 + bool(gears)
    columns = first + len(headings)
    places = np.frombuffer(data[0], dtype="<i8")
    if gears:
        places = places * len(gears) + np.frombuffer(data[values + 1], dtype="<u2")

    def table(texts: Sequence[bytes]) -> Any:
        arrays = [np.frombuffer(column, dtype="<f8") for column in texts]
        return np.array(arrays).reshape(len(arrays), account.rows).T

    return Chunk(
        account.piece * task.plan.piece * (len(gears) or 1),
        places,
        table(data[1:values]),
        np.frombuffer(data[values], dtype=np.uint8),
        table(data[first:columns]),
        table(data[columns:]),
        account.counts,
        names,
        headings,
        account.removed,
        gears,
        solved=account.solved,
    )
