"""Work on a single case of several: reading, calculation and writing, in any process."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from itertools import groupby, islice
from time import perf_counter
from typing import NamedTuple

import click

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.case_tasks import CaseTask
from vstatics.core.cli.shared.cases import (
    CalculatedCase,
    Steps,
    case_in_steps,
    completed,
    unexpected,
)
from vstatics.core.cli.shared.texts import Job
from vstatics.core.errors import Problem, ReadError, of_file
from vstatics.core.jobs.alone import Rules
from vstatics.core.jobs.files import OWN_FAULTS, unwritable
from vstatics.core.jobs.finished_cases import CaseMark, case_mark
from vstatics.core.jobs.page_files import set_pages_aside


class Done(NamedTuple):
    """Outcome of a case, for the process that counts cases and prints messages."""

    file: str
    problems: list[Problem]
    failed: bool = True
    has_result: bool = False
    """True if the case has output, possibly for some gears only."""
    part: texts.Part = b""
    """Output of the case, for a stream with the output of all cases."""
    stop: bool = False
    """True if the output of further cases cannot be written either."""
    left: str = ""
    """New name of an earlier result, which is renamed if the case failed."""
    mark: CaseMark | None = None
    """Hashes that identify the case, if its output is stored for a resumed run."""


def calculate_and_write(job: Job, task: CaseTask) -> Done:
    """Read, calculate and write a case; return all errors as problems."""
    return completed(_in_steps(job, task))


GROUP_SIZE = 32
"""Largest number of cases in a group."""
GROUP_SECONDS = 0.1
"""Time after which the remaining cases of a group are completed one after the other. [s]"""


def in_groups(job: Job, tasks: Iterable[CaseTask]) -> Iterator[Done]:
    """Yield the outcomes of cases, calculated by this process in groups.

    Each step is carried out for all cases of a group before the next step. This takes less
    time for many small cases, because code and data of a step stay in the processor's cache.
    A pipe is a group by itself, so that no other case waits for its text.
    """
    for is_file, alike in groupby(tasks, _is_in_a_file):
        size = GROUP_SIZE if is_file else 1
        while group := [_with_outcome(job, task) for task in islice(alike, size)]:
            yield from _outcomes(group)


def _outcomes(group: list[Iterator[Done | None]]) -> Iterator[Done]:
    outcomes: list[Done | None] = [None] * len(group)
    end = perf_counter() + GROUP_SECONDS
    while perf_counter() < end and not all(outcomes):
        for number, steps in enumerate(group):
            if perf_counter() < end:
                outcomes[number] = outcomes[number] or next(steps)
    for outcome, steps in zip(outcomes, group, strict=True):
        yield outcome or next(filter(None, steps))


def _is_in_a_file(task: CaseTask) -> bool:
    return os.path.isfile(task.file)  # noqa: PTH113 - `Path.is_file` refuses long names


def _with_outcome(job: Job, task: CaseTask) -> Iterator[Done | None]:
    """Yield None after each step of a case, then the outcome."""
    yield (yield from _in_steps(job, task))


def _in_steps(job: Job, task: CaseTask) -> Steps[Done]:
    case, shown = _shown_of_case(job, (yield from case_in_steps(task.file, job.options)))
    file, problems = case.file, case.problems
    try:
        if task.target is None or job.finished is None:
            part = texts.among_several(case, shown, job.to, folders=job.folders)
            is_kept = job.marked and not case.failed
            mark = case_mark(case.data, _named_files(case)) if is_kept else None
            return Done(file, problems, case.failed, shown is not None, part, mark=mark)
        if shown is None or case.results is None:
            return Done(file, problems, left=set_pages_aside(task.target))
        result = texts.alone(file, shown, job.to)
        yield
        named_files = _named_files(case)
        job.finished.put(task.target, result, case.data, named_files, failed=case.failed)
    except ReadError as error:  # a page would overwrite a file that is not a page
        return Done(file, [*problems, *error.problems])
    except OSError as error:
        return Done(
            file,
            [*problems, unwritable(task.target, error)],
            stop=error.errno not in OWN_FAULTS,
        )
    except Exception as error:  # noqa: BLE001 - further cases must be calculated
        return Done(file, [*problems, unexpected(file, error)])
    return Done(file, problems, case.failed, has_result=True)


def _named_files(case: CalculatedCase) -> set[str]:
    return {law.file for law in case.results.case.laws if law.file} if case.results else set()


def _shown_of_case(
    job: Job, case: CalculatedCase
) -> tuple[CalculatedCase, texts.CaseOutput | None]:
    """Return the outcome and the output of a case. Without output, the case has failed."""
    if case.results is None:
        return case, None
    try:
        shown = job.show(case, case.results)
        return case.with_told(shown.problems), shown
    except ReadError as error:
        causes = error.problems
    except click.BadParameter as error:
        causes = [of_file("E090", case.file, error.message)]
    except Exception as error:  # noqa: BLE001 - further cases must be calculated
        causes = [unexpected(case.file, error)]
    return case._replace(results=None, problems=[*case.problems, *causes]), None


def _given_up(task: CaseTask) -> Done:
    message = "the process that calculated it died twice (out of memory, or killed)"
    return Done(task.file, [of_file("E011", task.file, message)])


def _is_only_here(task: CaseTask) -> bool:
    """Return whether a case is read from a stream, which other processes cannot read."""
    return task.file == files.STDIN or task.file.startswith(("/dev/", "/proc/"))


RULES_OF_CASES = Rules(ahead=64, tries=2, lost=_given_up, here=_is_only_here)
