"""One case among several: from its file to the file of its result, or to a part of a stream."""

from __future__ import annotations

from typing import NamedTuple

import click

from vstatics.cli import files, texts
from vstatics.cli.cases import CalculatedCase, calculate_one, unexpected
from vstatics.cli.job import Job
from vstatics.cli.targets import CaseTask
from vstatics.errors import Problem, ReadError, of_file
from vstatics.jobs.alone import Rules
from vstatics.jobs.files import OWN_FAULTS, set_aside, unwritable


class Done(NamedTuple):
    """What became of a case, without its results."""

    file: str
    problems: list[Problem]
    failed: bool = True
    part: texts.Part = b""
    """Of a stream."""
    stop: bool = False
    """Whether the others can't be written either."""
    left: str = ""
    """Where an earlier result of a case that failed is now."""


def calculate_and_write(job: Job, task: CaseTask) -> Done:
    """Read, calculate and write a case; nothing that is wrong with it is raised."""
    case, shown = _shown(job, calculate_one(task.file, job.options))
    file, problems = case.file, case.problems
    try:
        if task.target is None or job.finished is None:
            return Done(file, problems, case.failed, texts.among_several(case, shown, job.form))
        if shown is None:
            return Done(file, problems, left=set_aside(task.target))
        result = texts.alone(case, shown, job.form)
        job.finished.put(task.target, result, case.data, failed=case.failed)
    except OSError as error:
        return Done(
            file,
            [*problems, unwritable(task.target, error)],
            stop=error.errno not in OWN_FAULTS,
        )
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        return Done(file, [*problems, unexpected(file, error)])
    return Done(file, problems, case.failed)


def _shown(job: Job, case: CalculatedCase) -> tuple[CalculatedCase, texts.CaseOutput | None]:
    """What is shown of a case; one that lacks what was asked for fails."""
    if case.results is None:
        return case, None
    try:
        return case, job.show(case)
    except ReadError as error:
        why = error.problems
    except click.BadParameter as error:
        why = [of_file(case.file, error.message)]
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        why = [unexpected(case.file, error)]
    return case._replace(results=None, problems=[*case.problems, *why]), None


def _lost(task: CaseTask) -> Done:
    """What is said of a case that is given up."""
    message = "the process that calculated it died, twice (out of memory, or killed)"
    return Done(task.file, [of_file(task.file, message)])


def _is_only_here(task: CaseTask) -> bool:
    """Whether only this process can read a case: another one has other streams."""
    return task.file == files.STDIN or task.file.startswith(("/dev/", "/proc/"))


RULES = Rules(ahead=64, tries=2, lost=_lost, here=_is_only_here)
