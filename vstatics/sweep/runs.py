"""Calculation of a range of variants of a scenario, in which each variant is a simulated run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.errors import Problem
from vstatics.core.jobs.piece_file import Noticed
from vstatics.sweep.chunk import Chunk, joined, rows_of
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.documents import SweptDocument

LEAST_PIECE, MOST_PIECES = 16, 4096
"""Smallest number of runs in a piece (about half a second), and largest number of pieces."""


def piece_of_runs(count: int) -> int:
    """Return the number of runs in a piece, for a sweep of `count` runs.

    >>> piece_of_runs(1000), piece_of_runs(10**6)
    (16, 245)
    """
    return max(LEAST_PIECE, -(-count // MOST_PIECES))


def calculate(plan: SweepPlan, subject: SweptDocument, start: int, stop: int) -> Chunk:
    """Simulate the variants from `start` up to, but without, `stop`."""
    asked = subject.asked(plan.selections)
    return joined([_row(plan, subject, number, asked) for number in range(start, stop)])


def reason(plan: SweepPlan, subject: SweptDocument) -> list[Problem]:
    """Return the reasons why the first variant has no results; empty if results exist."""
    return subject.reason(plan.variants.targets, plan.variants.block(0, 1)[0].tolist())


def _row(
    plan: SweepPlan, subject: SweptDocument, number: int, asked: Sequence[tuple[str, str]]
) -> Chunk:
    """Simulate a variant, and return the row if the variant passes the condition."""
    values = plan.variants.block(number, number + 1)
    outcome = subject.outcome(plan.variants.targets, values[0], asked)
    status, unknown = np.array([outcome.status], np.uint8), np.array([outcome.unknown])
    row = rows_of(plan, number, values, status, outcome.tables, unknown)
    messages = [Noticed(message.id, message.text, number, 1) for message in outcome.messages]
    return row._replace(
        noticed=tuple({message.alike: message for message in reversed(messages)}.values())
    )
