"""A part of a sweep of a document: each variant is a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.errors import Problem
from vstatics.core.jobs.piece_file import Noticed
from vstatics.sweep.chunk import Chunk, joined, rows_of
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.documents import SweptDocument

LEAST_PIECE, MOST_PIECES = 16, 4096
"""Runs of a piece, which take about half a second; more where there were too many pieces."""


def piece_of_runs(count: int) -> int:
    """How many of so many runs are a piece.

    >>> piece_of_runs(1000), piece_of_runs(10**6)
    (16, 245)
    """
    return max(LEAST_PIECE, -(-count // MOST_PIECES))


def calculate(plan: SweepPlan, subject: SweptDocument, start: int, stop: int) -> Chunk:
    """Run the variants from `start` up to `stop`, one after the other."""
    asked = subject.asked(part for one in plan.expressions for part in one.selections)
    return joined([_row(plan, subject, number, asked) for number in range(start, stop)])


def reason(plan: SweepPlan, subject: SweptDocument) -> list[Problem]:
    """Why the first variant has no numbers, if it has none."""
    return subject.reason(plan.variants.targets, plan.variants.block(0, 1)[0].tolist())


def _row(
    plan: SweepPlan, subject: SweptDocument, number: int, asked: Sequence[tuple[str, str]]
) -> Chunk:
    """The row of a variant, if it passes the plan's condition."""
    values = plan.variants.block(number, number + 1)
    outcome = subject.outcome(plan.variants.targets, values[0], asked)
    status, unknown = np.array([outcome.status], np.uint8), np.array([outcome.unknown])
    row = rows_of(plan, number, values, status, outcome.tables, unknown)
    told = [Noticed(one.id, one.text, number, 1) for one in outcome.messages]
    return row._replace(noticed=tuple({one.alike: one for one in reversed(told)}.values()))
