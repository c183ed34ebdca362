"""One case among several: from its file to the file of its result, or to a part of a stream."""

from __future__ import annotations

import contextlib
import errno
import os
import stat
from typing import NamedTuple

from vstatics.cli import files, texts
from vstatics.cli.cases import Outcome, Settings, calculate_one, unexpected
from vstatics.cli.targets import Task
from vstatics.errors import Place, Problem
from vstatics.jobs.files import replace
from vstatics.jobs.record import Record, State, state
from vstatics.statics.results import Language

OWN_FAULTS = {errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP, errno.EILSEQ}
"""Errors of writing that one name has; any other would meet every case."""
OLD = ".old"


class Job(NamedTuple):
    """How each case is done."""

    settings: Settings
    output_format: texts.OutputFormat
    lang: Language
    record: Record | None = None
    """Of the directory that results go to, if they do."""


class Done(NamedTuple):
    """What became of a case, without its results."""

    file: str
    problems: list[Problem]
    failed: bool = True
    text: bytes = b""
    """Its part of a stream."""
    stop: bool = False
    """Whether the others can't be written either."""
    left: str = ""
    """Where an earlier result of a case that failed is now."""


def work(job: Job, task: Task) -> Done:
    """Read, calculate and write a case; nothing that is wrong with it is raised."""
    case = None if job.record is None else state(task.file)
    outcome = calculate_one(task.file, job.settings)
    try:
        if task.target is None:
            text = files.encoded(texts.part(outcome, job.output_format, job.lang))
            return Done(outcome.file, outcome.problems, outcome.failed, text)
        return _to_file(job, outcome, task.target, case)
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        problems = [*outcome.problems, unexpected(outcome.file, error)]
        return Done(outcome.file, problems)


def lost(task: Task) -> Done:
    """What is told of a case at which processes died."""
    message = "the process that calculated it died, twice (out of memory, or killed)"
    return Done(task.file, [Problem(message, place=Place(task.file, 0, 0))])


def _to_file(job: Job, outcome: Outcome, target: str, case: State | None) -> Done:
    try:
        if outcome.results is None:
            return Done(outcome.file, outcome.problems, left=_set_aside(target))
        data = files.encoded(texts.alone(outcome, job.output_format, job.lang))
        replace(target, data)
        if job.record is not None:
            job.record.note(target, case, failed=outcome.failed)
    except OSError as error:
        stop = error.errno not in OWN_FAULTS
        problems = [*outcome.problems, files.unwritable(target, error)]
        return Done(outcome.file, problems, stop=stop)
    return Done(outcome.file, outcome.problems, outcome.failed)


def _set_aside(target: str) -> str:
    """Rename the result of an earlier run, so that nobody takes it for one of this case."""
    with contextlib.suppress(FileNotFoundError):
        if stat.S_ISREG(os.lstat(target).st_mode):
            os.replace(target, target + OLD)  # noqa: PTH105
            return target + OLD
    return ""
