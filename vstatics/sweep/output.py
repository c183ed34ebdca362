"""Output file of a sweep: calculated piece by piece, then assembled and moved into place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.extras import build
from vstatics.core.jobs import piece_file
from vstatics.core.jobs.alone import Alone, Workers
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import Account, Copy, Noticed
from vstatics.sweep import chunk, tasks
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import MOST_ROWS, Format, text
from vstatics.sweep.formats.npz import ArchiveLayout, ColumnType
from vstatics.sweep.formats.npz import layout as npz_layout
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results import best
from vstatics.sweep.tasks import SweepTask

Advance = Callable[[int], None]


class SweepReport(NamedTuple):
    """Outcome of a sweep, for the report at the end."""

    rows: int
    counts: dict[str, int]
    """Number of variants, or of gears of variants, with each status."""
    removed: tuple[int, ...]
    """Number removed by each expression that `and` joins in the condition, in order."""
    outside: tuple[str, ...]
    """Names of characteristic curves that were evaluated outside the given points."""
    noticed: tuple[Noticed, ...]
    """Messages of simulated runs."""
    solved: int
    """Number of variants with a solution in all requested gears."""

    @classmethod
    def of(cls, accounts: Sequence[Account]) -> SweepReport:
        """Return the outcome of a sweep from the accounts of all pieces."""
        return cls(
            sum(account.rows for account in accounts),
            chunk.counted(accounts),
            chunk.removed_in(accounts),
            chunk.outside_in(accounts),
            chunk.noticed_in(accounts),
            sum(account.solved for account in accounts),
        )

    @property
    def variants(self) -> int:
        """Number of calculated variants, or of gears of variants."""
        return sum(self.counts.values())


def description(plan: SweepPlan, form: Format) -> dict[str, Any]:
    """Return the description of a sweep that is stored next to the finished pieces."""
    return {
        "what": "unfinished sweep of vstatics; the same command with --resume goes on",
        "build": build(),
        "fingerprint": plan.fingerprint(form),
        "pieces": plan.pieces,
        "variants": plan.variants.count,
        "varied": list(plan.names),
        "columns": list(plan.headings),
        "where": plan.where and plan.where.text,
        "objectives": [
            f"{'min' if objective.sign > 0 else 'max'} {objective.expression.text}"
            for objective in plan.objectives
        ],
        "format": form,
    }


def column_types(plan: SweepPlan) -> list[ColumnType]:
    """Return names and types of the columns of the output."""
    types = {"variant": "<i8", "status": "u1"}
    place = 2 + len(plan.names)
    return [
        ColumnType(name, np.dtype("<u2" if plan.by_gear and n == place else types.get(name, "<f8")))
        for n, name in enumerate(plan.output_headings)
    ]


class Output:
    """Output file of a sweep: calculation of pieces in a store, and assembly to the file."""

    def __init__(
        self, plan: SweepPlan, form: Format, store: FinishedPieces, *, raw: bool = False
    ) -> None:
        """Store the plan and the folder of pieces. `raw` affects only the assembly."""
        self._task = SweepTask(plan, form, store.directory, raw)
        self.store = store

    @property
    def task(self) -> SweepTask:
        """Task for the workers. The hash of the work is known only after the store is opened."""
        return self._task._replace(work=self.store.work)

    @property
    def pending(self) -> Iterator[int]:
        """Numbers of the missing pieces; an iterator, because there can be millions."""
        pieces = range(self.task.plan.pieces)
        return (piece for piece in pieces if piece not in self.store.accounts)

    @property
    def finished(self) -> int:
        """Number of variants in stored pieces, including pieces not yet reported as progress."""
        plan = self.task.plan
        spans = [plan.span(piece) for piece in self.store.finished() if piece < plan.pieces]
        return sum(stop - start for start, stop in spans) * (len(plan.gears) or 1)

    def calculate(self, workers: Workers, advance: Advance) -> None:
        """Calculate and store the missing pieces.

        Raises
        ------
        CaseError
            If a piece cannot be calculated; the message names the variants.
        OSError
            If a piece cannot be written.
        """
        for account in self._accounts(workers):
            self.store.accounts[account.piece] = account
            advance(account.variants)

    def _accounts(self, workers: Workers) -> Iterator[Account]:
        if workers.remote:
            items = tasks.items(self.task, self.pending, remote=True)
            for _, (account, data) in workers.each(tasks.piece_sent, items):
                piece_file.write_piece(self.task.directory, account.piece, [data])
                yield account
        else:
            for _, account in workers.each(tasks.write_piece, self.pending):
                yield account

    def assemble(self, workers: Workers) -> SweepReport:
        """Assemble the pieces into the output file and move the file into place.

        Raises
        ------
        OSError
            If the output cannot be written; the pieces are kept.
        """
        plan, form = self.task.plan, self.task.form
        accounts = [self.store.accounts[piece] for piece in range(plan.pieces)]
        report = SweepReport.of(accounts)
        if plan.objectives:
            accounts = list(self._select(accounts))
        try:
            if form in ("parquet", *MOST_ROWS):
                from vstatics.sweep.formats import tables

                rows = plan.output_headings, self._chunks(accounts)
                with self.store.folder.writing(piece_file.ASSEMBLED) as file:
                    if form == "parquet":
                        tables.write_parquet(file, *rows, by_gear=plan.by_gear)
                    else:
                        file.write(tables.text(form, *rows, by_gear=plan.by_gear))
            else:
                self._copy(workers, self._layout(accounts))
        except BaseException:
            # An incomplete output would only take space.
            self.store.folder.remove(piece_file.ASSEMBLED)
            raise
        self.store.finish()
        return report._replace(rows=sum(account.rows for account in accounts))

    def _layout(self, accounts: Sequence[Account]) -> ArchiveLayout:
        plan, form = self.task.plan, self.task.form
        if form == "npz":
            codes = {"statuses": STATUS, **({"gears": plan.gears} if plan.gears else {})}
            return npz_layout(column_types(plan), accounts, codes)
        head = text.head(form, plan.output_headings, raw=self.task.raw)
        copies, place = [], len(head)
        for account in accounts:
            copies.append(Copy(account.piece, 0, place, account.length))
            place += account.length
        return ArchiveLayout([(0, head)], copies, place)

    def _copy(self, workers: Workers, layout: ArchiveLayout) -> None:
        """Write the headers of an archive, and let the workers copy the pieces into the archive."""
        with self.store.folder.writing(piece_file.ASSEMBLED) as file:
            file.truncate(layout.length)
            for place, text in layout.texts:
                file.seek(place)
                file.write(text)
        by_piece: dict[int, list[Copy]] = {}
        for part in layout.copies:
            by_piece.setdefault(part.piece, []).append(part)
        here: Workers = Alone(self.task, self.task.describe) if workers.remote else workers
        for _ in here.each(tasks.copy, by_piece.values()):
            pass

    def _chunks(self, accounts: Sequence[Account]) -> Iterator[Chunk]:
        for account in accounts:
            yield tasks.read_chunk(self.task, account)

    def _select(self, accounts: Sequence[Account]) -> Iterator[Account]:
        """Store the best rows of all pieces as new pieces, and yield the new accounts in order."""
        number = self.task.plan.pieces
        for selected in best.among(self.task.plan, lambda: self._chunks(accounts)):
            data = tasks.data_of(self.task.form, selected)
            rows, work = len(selected.variants), self.task.work
            account, buffers = piece_file.piece_bytes(number, rows, {}, data, work=work)
            piece_file.write_piece(self.task.directory, number, buffers)
            yield account
            number += 1


def stream(
    task: SweepTask, workers: Workers, advance: Advance, write: Callable[[bytes], Any]
) -> SweepReport:
    """Calculate all variants and write the rows as text, in order, without files of pieces.

    If the first piece cannot be calculated, nothing is written.

    Raises
    ------
    CaseError
        If a piece cannot be calculated; the message names the variants.
    OSError
        If `write` fails.
    """
    plan, form = task.plan, task.form
    items = tasks.items(task, range(plan.pieces), remote=workers.remote)
    heads = [text.head(form, plan.output_headings, raw=task.raw)]

    def put(data: bytes = b"") -> None:
        write(heads.pop() + data if heads else data)

    if plan.objectives:
        candidates: list[Chunk] = []
        for _, calculated in workers.each(tasks.calculate, items, ordered=True):
            advance(sum(calculated.counts.values()))
            candidates = [best.within(plan, chunk.joined([*candidates, calculated]))]
        rows = 0
        for selected in best.among(plan, lambda: candidates):
            rows += len(selected.variants)
            put(text.rows(form, selected))
        put()
        [whole] = candidates
        notes = whole.removed, whole.outside, whole.noticed, whole.solved
        return SweepReport(rows, dict(whole.counts), *notes)
    accounts = []
    for _, (account, data) in workers.each(tasks.lines, items, ordered=True):
        accounts.append(account)
        put(data)
        advance(account.variants)
    return SweepReport.of(accounts)
