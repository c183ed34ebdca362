"""What a worker does with a piece of a sweep."""

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
from vstatics.sweep.variants.numbered import VariantPart, VariantTable


class SweepTask(NamedTuple):
    """What a worker needs to know to do a piece."""

    plan: SweepPlan
    form: Format
    directory: str = ""
    raw: bool = False
    """Whether headings in CSV stay as they are, also where a spreadsheet calculates them."""
    work: str = ""
    """Hash of the definition of the sweep."""

    def describe(self, item: object) -> str:
        """The variants of a piece, in words."""
        piece = _number(item)
        if not isinstance(piece, int):
            return "putting the output together"
        start, stop = self.plan.span(piece)
        return f"variants {start} to {stop - 1}"

    def workers(self, jobs: int, scheduler: str | None = None) -> Workers:
        """Who does the pieces: no more processes than there are of them."""
        jobs = min(jobs, self.plan.pieces)
        return workers(self, self.describe, jobs=jobs, scheduler=scheduler)


class Portion(NamedTuple):
    """A piece with its variants, for a worker that does not see the file they are in."""

    piece: int
    variants: VariantPart


Item = int | Portion


def items(task: SweepTask, pieces: Iterable[int], *, remote: bool) -> Iterator[Item]:
    """The numbers of pieces, or pieces with their variants where workers need these."""
    variants = task.plan.variants
    for piece in pieces:
        if remote and isinstance(variants, VariantTable):
            yield Portion(piece, VariantPart(variants, *task.plan.span(piece)))
        else:
            yield piece


def calculate(task: SweepTask, item: Item) -> Chunk:
    """The rows of a piece that may get into the output."""
    plan, piece = task.plan, _number(item)
    if isinstance(item, Portion):
        plan = replace(plan, variants=item.variants)
    rows = blocks.calculate(plan, *plan.span(piece))
    return best.within(plan, rows) if plan.objectives else rows


def _number(item: Any) -> Any:
    """The number of a piece, or what is none."""
    return item.piece if isinstance(item, Portion) else item


def lines(task: SweepTask, item: Item) -> tuple[Account, bytes]:
    """An account of a piece, and its rows as text."""
    rows = calculate(task, item)
    told = rows.removed, rows.outside, rows.noticed
    account = Account(_number(item), len(rows.variants), dict(rows.counts), (), *told)
    return account, text.rows(task.form, rows)


def piece_data(task: SweepTask, item: Item) -> tuple[Account, list[Any]]:
    """A piece as it lies on disk: text if that can be the output, else columns."""
    rows = calculate(task, item)
    data = columns_of(rows) if task.plan.objectives else data_of(task.form, rows)
    counts = dict(rows.counts)
    told = rows.removed, rows.outside, rows.noticed, task.work
    return piece_file.piece_bytes(_number(item), len(rows.variants), counts, data, *told)


def piece_sent(task: SweepTask, item: Item) -> tuple[Account, bytes]:
    """A piece from another machine."""
    account, data = piece_data(task, item)
    return account, b"".join(memoryview(one).cast("B") for one in data)


def write_piece(task: SweepTask, piece: int) -> Account:
    """Calculate a piece and leave it on disk."""
    account, data = piece_data(task, piece)
    piece_file.write_piece(task.directory, piece, data)
    return account


def copy(task: SweepTask, copies: Sequence[Copy]) -> int:
    """Copy stretches of pieces into the output."""
    return piece_file.copy(task.directory, copies)


def data_of(form: Format, rows: Chunk) -> list[Any]:
    """The rows of a chunk as they are in the output: as text, or as columns."""
    return [text.rows(form, rows)] if form in TEXTS else columns_of(rows)


def columns_of(rows: Chunk) -> list[Any]:
    """The columns of a chunk, each in one stretch."""
    return [
        np.ascontiguousarray(column, dtype=column.dtype.newbyteorder("<"))
        for column in (*rows.output_columns().values(), *rows.objectives.T)
    ]


def read_chunk(task: SweepTask, account: Account) -> Chunk:
    """A piece of columns back from disk."""
    data = piece_file.read_segments(task.directory, account)
    names, headings, gears = task.plan.names, task.plan.headings, task.plan.gears
    values = 1 + len(names)
    first = values + 1 + bool(gears)
    columns = first + len(headings)
    places = np.frombuffer(data[0], dtype="<i8")
    if gears:
        places = places * len(gears) + np.frombuffer(data[values + 1], dtype="<u2")

    def table(texts: Sequence[bytes]) -> Any:
        arrays = [np.frombuffer(one, dtype="<f8") for one in texts]
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
    )
