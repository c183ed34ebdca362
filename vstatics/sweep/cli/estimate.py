"""Estimates of a sweep before it is carried out: number of variants, size, time."""

from __future__ import annotations

import io
import time
from dataclasses import replace

from vstatics.core.cli.shared.estimates import CommandEstimate, free_room, size_text
from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.model.transmission import Transmission
from vstatics.sweep import blocks
from vstatics.sweep.chunk import Chunk
from vstatics.sweep.formats import Format
from vstatics.sweep.formats.tables import write_parquet
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.best import BEST
from vstatics.sweep.tasks import data_of

TRIED = 1.0
"""Time limit of a trial run, by which the time of all runs is estimated. [s]"""
SPOTS, ROWS = 16, 16
"""Number of samples from a sweep, and of rows in each, for the mean size of a row."""
LONGEST_NUMBER = 32
"""Largest size of a number in the output, with separators [bytes]."""


def check_room(plan: SweepPlan, form: Format, output: str, pieces: FinishedPieces) -> None:
    """Refuse an output without enough disk space, before anything is written.

    With a condition or an objective, the number of rows is unknown. For Parquet, only the size of
    the uncompressed pieces is known.

    Raises
    ------
    ReadError
        If the space is insufficient; the message gives the needed and the free space.
    """
    if plan.where is not None or plan.objectives:
        return
    free = free_room(pieces.output)
    if free is None:
        return
    free += pieces.folder.size()
    longest = sum(LONGEST_NUMBER + len(name.encode()) for name in plan.output_headings)
    if longest * plan.count <= free:
        return
    size = _row_bytes(plan, form) * plan.count
    if size > free:
        what = "its pieces need" if form == "parquet" else "needs"
        message = (
            f"{what} about {size_text(size)}, but only {size_text(free)} are free: expected fewer "
            "variants or columns, --where, --best, or another disk"
        )
        if pieces.finished():
            message += "; with more room, the same command with --resume continues"
        raise ReadError([of_file("E017", output, message)])


def _row_bytes(plan: SweepPlan, form: Format) -> float:
    last = max(plan.variants.count - ROWS, 0)
    starts = sorted({last * spot // (SPOTS - 1) for spot in range(SPOTS)})
    ends = ((start, min(start + ROWS, plan.variants.count)) for start in starts)
    parts = [blocks.calculate(plan, *two) for two in ends]
    length = sum(memoryview(column).nbytes for part in parts for column in data_of(form, part))
    return length / sum(len(part.places) for part in parts)


def _packed_bytes(plan: SweepPlan, rows: Chunk) -> int:
    """Return the size in bytes of some rows as Parquet, compressed as the whole file would be."""
    file = io.BytesIO()
    write_parquet(file, plan.output_headings, [rows], by_gear=plan.by_gear)
    return file.tell()


def most_rows(plan: SweepPlan) -> int:
    """Return the largest possible number of rows."""
    count = plan.count
    if not plan.objectives:
        return count
    return min(count, plan.best or (BEST if len(plan.objectives) == 1 else count))


def estimate(plan: SweepPlan, form: Format, jobs: int) -> str:
    """Return an estimate of the number of variants, size and time, from a measured block."""
    variants, headings = plan.variants.count, plan.output_headings
    needed, subject = 0.0, plan.subject
    if not isinstance(subject, Transmission) and (needed := subject.seconds(TRIED)):
        plan = replace(plan, subject=subject.limited(TRIED))
    start, stop = blocks.middle(plan)
    first = 100 if isinstance(plan.subject, Transmission) else 1
    # The first calculation takes longer than later ones, so it is not measured.
    blocks.calculate(plan, start, min(start + first, stop))
    began = time.perf_counter()
    rows = blocks.calculate(plan, start, stop)
    data = data_of(form, rows)
    measured = (time.perf_counter() - began) / max(stop - start, 1)
    seconds = (needed or measured) * variants
    part = len(rows.places) / max(stop - start, 1)
    count = round(part * variants)
    if plan.objectives:
        expected = f"the best, at most {min(count, most_rows(plan))}"
    else:
        expected = str(count) if plan.where is None else f"about {count}"
    whole = sum(memoryview(column).nbytes for column in data)
    if form == "parquet":
        whole = _packed_bytes(plan, rows)
    length = whole / max(len(rows.places), 1)
    size = "small" if plan.objectives else f"about {size_text(length * count)}"
    said = {
        "variants": str(variants),
        "rows": expected,
        "columns": f"{len(headings)}: {_listed(headings)}",
        "size": size,
    }
    jobs_used = min(jobs, max(plan.pieces, 1))
    return CommandEstimate(said, {}, seconds / jobs_used, jobs).text("text")


def _listed(names: list[str]) -> str:
    return ", ".join(names if len(names) <= 8 else [*names[:7], "...", names[-1]])
