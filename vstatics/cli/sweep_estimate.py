"""What `vstatics sweep --dry-run` says: how many variants, how large, about how long."""

from __future__ import annotations

import math
import time

from vstatics.sweep import chunk
from vstatics.sweep.best import BEST
from vstatics.sweep.formats import TEXTS, Format
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.tasks import SweepTask, columns_of, text_of


def estimate(plan: SweepPlan, form: Format, jobs: int) -> str:
    """Calculate a block of the sweep, and tell from it about the whole."""
    variants, columns = plan.variants.count, len(plan.names) + len(plan.headings) + 2
    start, stop = _middle_block(plan)
    chunk.calculate(plan, start, min(start + 100, stop))  # the first time costs more
    began = time.perf_counter()
    made = chunk.calculate(plan, start, stop)
    data = [text_of(SweepTask(plan, form), made)] if form in TEXTS else columns_of(made)
    seconds = (time.perf_counter() - began) / max(stop - start, 1) * variants
    part = len(made.variants) / max(stop - start, 1)
    rows = round(part * variants)
    if plan.objectives:
        most = plan.best or (BEST if len(plan.objectives) == 1 else rows)
        told = f"the best, at most {min(rows, most)}"
    else:
        told = str(rows) if plan.where is None else f"about {rows}"
    length = sum(memoryview(one).nbytes for one in data) / max(len(made.variants), 1)
    size = "small" if plan.objectives else f"about {_size(length * rows)}"
    processes = f" with {jobs} jobs" if jobs > 1 else ""
    lines = {
        "variants": str(variants),
        "rows": told,
        "columns": f"{columns}: {_listed(['variant', *plan.names, 'status', *plan.headings])}",
        "size": size,
        "time": f"about {_duration(seconds / min(jobs, max(plan.pieces, 1)))}{processes}",
    }
    return "".join(f"{name:9} {value}\n" for name, value in lines.items())


def _middle_block(plan: SweepPlan) -> tuple[int, int]:
    """A block in the middle of the sweep."""
    start, stop = plan.span(plan.pieces // 2)
    blocks = list(chunk.blocks(plan.case, start, stop))
    return blocks[len(blocks) // 2]


def _listed(names: list[str], most: int = 8) -> str:
    return ", ".join(names if len(names) <= most else [*names[: most - 1], "...", names[-1]])


def _size(length: float) -> str:
    """Bytes as one says them.

    >>> _size(999), _size(1.3e9)
    ('999 bytes', '1.3 GB')
    """
    units = ("bytes", "kB", "MB", "GB", "TB")
    power = min(int(math.log10(max(length, 1)) / 3), len(units) - 1)
    return f"{length / 1000**power:.3g} {units[power]}"


def _duration(seconds: float) -> str:
    """A duration as one says it.

    >>> _duration(0.2), _duration(90), _duration(9000)
    ('a second', '1.5 minutes', '2.5 hours')
    """
    if seconds < 1:
        return "a second"
    if seconds < 60:
        return f"{seconds:.0f} s"
    if seconds < 3600:
        return f"{seconds / 60:.2g} minutes"
    return f"{seconds / 3600:.3g} hours"
