"""A part of a sweep of a scenario: each variant is a run."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from vstatics.core.elements.part_numbers import are_assembled
from vstatics.core.errors import CaseError, Problem, ReadError
from vstatics.core.jobs.piece_file import Noticed
from vstatics.simulation.record.asked import TABLES
from vstatics.sweep.chunk import INVALID, NOT_ASSEMBLED, STOPPED, Chunk, joined, rows_of
from vstatics.sweep.motion_tables import MotionTables, along_time
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.asked import asked_rows
from vstatics.sweep.variants.scenario_numbers import NumberPath
from vstatics.sweep.variants.subject import VariedScenario

LEAST_PIECE, MOST_PIECES = 16, 4096
"""Runs of a piece, which take about half a second; more where there were too many pieces."""


def piece_of_runs(count: int) -> int:
    """How many of so many runs are a piece.

    >>> piece_of_runs(1000), piece_of_runs(10**6)
    (16, 245)
    """
    return max(LEAST_PIECE, -(-count // MOST_PIECES))


def calculate(plan: SweepPlan, subject: VariedScenario, start: int, stop: int) -> Chunk:
    """Run the variants from `start` up to `stop`, one after the other."""
    asked = asked_columns(plan, subject)
    return joined([_row(plan, subject, number, asked) for number in range(start, stop)])


def reason(plan: SweepPlan, subject: VariedScenario) -> list[Problem]:
    """Why the first variant has no numbers, if it has none."""
    paths = [path for path in plan.variants.targets if isinstance(path, NumberPath)]
    try:
        motion = subject.run(paths, plan.variants.block(0, 1)[0].tolist())
    except (ReadError, CaseError) as error:
        return error.problems
    return [motion.stopped] if motion.stopped else []


def asked_columns(plan: SweepPlan, subject: VariedScenario) -> list[tuple[str, str]]:
    """The columns of a run that a plan asks for, and no run has of itself."""
    asked = {
        one
        for expression in plan.expressions
        for part in expression.selections
        if part.table in TABLES and along_time(part.table)
        for one in asked_rows(part, subject.rows(TABLES[part.table].kind))
    }
    return sorted(asked)


def _row(
    plan: SweepPlan, subject: VariedScenario, number: int, asked: Sequence[tuple[str, str]]
) -> Chunk:
    """The row of a variant, if it passes the plan's condition."""
    values = plan.variants.block(number, number + 1)
    paths = [path for path in plan.variants.targets if isinstance(path, NumberPath)]
    motion, status = None, np.array([INVALID], dtype=np.uint8)
    if np.isfinite(values).all():
        with suppress(ReadError, CaseError):
            motion = subject.run(paths, values[0].tolist(), asked)
    if motion is not None:
        status[0] = STOPPED if motion.stopped else 0
    without = status > 0
    if motion is not None and motion.case and not status[0]:
        varied = {str(path.keys[1]) for path in paths if path.keys[0] == "elements"}
        status[0] = 0 if are_assembled(motion.case, varied) else NOT_ASSEMBLED
    mechanisms = len(subject.own.scenario.case.mechanisms)
    tables = MotionTables(None if without[0] else motion, subject.rows, mechanisms)
    row = rows_of(plan, number, values, status, tables, without)
    told = [Noticed(one.id, one.text, number, 1) for one in (motion.messages if motion else ())]
    return row._replace(noticed=tuple({one.alike: one for one in reversed(told)}.values()))
