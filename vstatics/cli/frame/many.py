"""Several cases, each to a file of a directory or all to one stream; what is refused beforehand."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache, partial
from typing import NamedTuple

import click

from vstatics.cli.frame import files, texts
from vstatics.cli.frame.cases import CalculatedCase, calculate_one, unexpected
from vstatics.cli.frame.exit_status import DONE, FAILED, stopped_by
from vstatics.cli.frame.problems import Telling
from vstatics.cli.frame.progress import progress
from vstatics.cli.frame.texts import Job
from vstatics.errors import Problem, ReadError, of_file, plural
from vstatics.jobs.alone import Rules
from vstatics.jobs.files import OWN_FAULTS, STDOUT, is_stream, unwritable
from vstatics.jobs.finished_cases import FinishedCases
from vstatics.jobs.page_files import set_pages_aside
from vstatics.jobs.stopping import Stop, StoppedError, stoppable
from vstatics.jobs.workers import workers


class _HaltedError(Exception):
    """No case can be written any more."""


class _Count:
    """How far a run has come."""

    def __init__(self, total: int, kept: int = 0) -> None:
        """Begin with the cases that need not be calculated again."""
        self.total, self.kept = total, kept
        self.done = kept
        self.failures: list[str] = []
        """A line for each case that failed."""

    def add(self, done: Done) -> None:
        """Count a case."""
        self.done += 1
        if done.failed:
            self.failures.append(_failure(done))

    @property
    def status(self) -> int:
        """The exit status."""
        return FAILED if self.failures else DONE

    def summary(self, *, quiet: bool) -> None:
        """Say what became of the cases; quietly, where one failed."""
        if quiet and not self.failures:
            return
        line = f"{self.done - len(self.failures)} of {self.total} cases calculated"
        if self.kept:
            line += f" ({self.kept} of them before)"
        if self.failures:
            line += f", {len(self.failures)} failed:"
        for sentence in (line, *self.failures):
            files.say(sentence)


def _failure(done: Done) -> str:
    """The line of a case that failed: its first error, and how many more there are.

    Without an error it is a warning that made it fail.
    """
    why = [problem for problem in done.problems if problem.severity == "error"]
    why = why or [problem for problem in done.problems if problem.severity == "warning"]
    first = str(why[0]) if why else "failed"
    named = bool(why) and why[0].place is not None and why[0].place.file == done.file
    line = f"  {first}" if named else f"  {done.file}: {first}"
    if len(why) > 1:
        line += f" ... and {len(why) - 1} more {plural('problem', len(why) - 1)}"
    return line + (f" (its earlier result is {done.left} now)" if done.left else "")


def to_directory(
    cases: Sequence[str],
    folder: str,
    job: Job,
    *,
    jobs: int,
    resume: bool,
    others: Sequence[str],
) -> int:
    """Write the result of each case into a directory; the exit status.

    Parameters
    ----------
    others : sequence of str
        Further files that no result may overwrite.

    Raises
    ------
    UsageError
        If results would overwrite one another or a case, or --resume does not fit.
    ReadError
        If the directory cannot be written to.
    """
    suffix, telling = job.to.suffix, job.options.telling
    with FinishedCases(folder, suffix, _depends(job)) as finished:
        todo = tasks(cases, folder, suffix, [*others, finished.path])
        try:
            os.makedirs(folder, exist_ok=True)  # noqa: PTH103
            finished.lock()
            if resume:
                todo = _not_done(todo, finished, quiet=telling.quiet)
            else:
                finished.begin()
        except FileExistsError:
            raise click.UsageError(f"{folder} is a file: expected a directory") from None
        except OSError as error:
            raise ReadError([unwritable(folder, error)]) from None
        count = _Count(len(cases), len(cases) - len(todo))
        kept = f"results are in {folder}; the same command with --resume goes on"
        job = job._replace(finished=finished)
        with _until_stopped(count, kept) as stop, _results(job, todo, jobs) as results:
            for _ in _follow(count, results, stop, telling):
                pass
    if count.total > 1:
        count.summary(quiet=telling.quiet)
    return count.status


def _not_done(todo: list[CaseTask], finished: FinishedCases, *, quiet: bool) -> list[CaseTask]:
    """What is left of a run that is taken up; all of it where none can be."""
    try:
        without = finished.resume()
    except ReadError as error:  # it had other options
        raise click.UsageError(error.problems[0].message) from None
    if without:
        if not quiet:
            files.say(f"{finished.folder}: {without}; every case is calculated")
        finished.begin()
        return todo
    return [task for task in todo if not finished.is_done(task.file, str(task.target))]


def to_stream(cases: Sequence[str], output: str | None, job: Job, *, jobs: int) -> int:
    """Write the results of all cases to one stream or file as they come; the exit status.

    Raises
    ------
    ReadError
        If it cannot be written.
    """
    count, telling = _Count(len(cases)), job.options.telling
    whole = not is_stream(output)
    kept = f"{output} was not written" if whole else "what was written ends there"
    todo = [CaseTask(file) for file in cases]
    with (
        _until_stopped(count, kept) as stop,
        files.stream(output) as write,
        _results(job, todo, jobs) as results,
    ):
        to_stdout = output in (None, STDOUT)
        parts = _follow(count, results, stop, telling, beside_stdout=to_stdout)
        for text in texts.joined(parts, job.to, job.own_frame):
            write(text)
    if whole and count.total > 1:
        count.summary(quiet=telling.quiet)
    return count.status


@contextmanager
def _results(job: Job, todo: Sequence[CaseTask], jobs: int) -> Iterator[Iterator[Done]]:
    """What becomes of each case, in their order, by so many processes."""
    with workers(job, str, jobs=min(jobs, len(todo)), rules=RULES_OF_CASES) as called:
        yield (done for _, done in called.each(calculate_and_write, todo, ordered=True))


def _follow(
    count: _Count,
    results: Iterator[Done],
    stop: Stop,
    telling: Telling,
    *,
    beside_stdout: bool = False,
) -> Iterator[texts.Part]:
    """Tell and count what becomes of each case, and give its part of a stream."""
    quiet = telling.quiet
    with progress(count.total, "cases", beside_stdout=beside_stdout, quiet=quiet) as advance:
        advance(count.kept)
        for done in results:
            files.show(telling.printed(done.problems))
            if done.stop:
                raise _HaltedError
            yield done.part
            count.add(done)
            advance(1)
            stop.check()


@contextmanager
def _until_stopped(count: _Count, kept: str) -> Iterator[Stop]:
    """Let Ctrl-C, SIGTERM and a full disk end a run with a word on how far it came."""
    try:
        with stoppable() as stop:
            yield stop
    except StoppedError as stopped:
        status = stopped_by(stopped.signal)
    except _HaltedError:
        status = 1
    else:
        return
    files.say(f"stopped after {count.done} of {count.total} cases; {kept}")
    raise click.exceptions.Exit(status)


def _depends(job: Job) -> dict[str, object]:
    """What the results depend on, besides the cases."""
    style = job.to.style
    return {
        "command": job.command,
        "--from": job.options.input_format,
        "--coast": job.options.coast,
        "--idle": job.options.idle,
        "--strict": job.options.telling.strict,  # a result without errors counts as done or not
        "--lang": style.lang if job.to.is_text else None,
        "--digits": style.digits,
        "--raw": style.raw or None,
        "--own-tables": style.own_tables or None,
    }


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
    case, shown = _shown_of_case(job, calculate_one(task.file, job.options))
    file, problems = case.file, case.problems
    try:
        if task.target is None or job.finished is None:
            return Done(file, problems, case.failed, texts.among_several(case, shown, job.to))
        if shown is None or case.results is None:
            return Done(file, problems, left=set_pages_aside(task.target))
        result = texts.alone(file, shown, job.to)
        beside = {law.file for law in case.results.case.laws if law.file}
        job.finished.put(task.target, result, case.data, beside, failed=case.failed)
    except ReadError as error:  # a page would overwrite a file of others
        return Done(file, [*problems, *error.problems])
    except OSError as error:
        return Done(
            file,
            [*problems, unwritable(task.target, error)],
            stop=error.errno not in OWN_FAULTS,
        )
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        return Done(file, [*problems, unexpected(file, error)])
    return Done(file, problems, case.failed)


def _shown_of_case(
    job: Job, case: CalculatedCase
) -> tuple[CalculatedCase, texts.CaseOutput | None]:
    """What is shown of a case; one that lacks what was asked for fails."""
    if case.results is None:
        return case, None
    try:
        return case, job.show(case, case.results)
    except ReadError as error:
        why = error.problems
    except click.BadParameter as error:
        why = [of_file("E090", case.file, error.message)]
    except Exception as error:  # noqa: BLE001 - the other cases are to go on
        why = [unexpected(case.file, error)]
    return case._replace(results=None, problems=[*case.problems, *why]), None


def _given_up(task: CaseTask) -> Done:
    """What is said of a case that is given up."""
    message = "the process that calculated it died, twice (out of memory, or killed)"
    return Done(task.file, [of_file("E011", task.file, message)])


def _is_only_here(task: CaseTask) -> bool:
    """Whether only this process can read a case: another one has other streams."""
    return task.file == files.STDIN or task.file.startswith(("/dev/", "/proc/"))


RULES_OF_CASES = Rules(ahead=64, tries=2, lost=_given_up, here=_is_only_here)


STDIN_STEM = "stdin"


class CaseTask(NamedTuple):
    """A case, and the file for its result; None where it goes to a stream."""

    file: str
    target: str | None = None


def tasks(
    cases: Sequence[str], folder: str, suffix: str, others: Sequence[str] = ()
) -> list[CaseTask]:
    """The file for the result of each case: its stem with the suffix, in the folder.

    Parameters
    ----------
    others : sequence of str
        Further files that must not be overwritten.

    Raises
    ------
    UsageError
        If a case is named twice, two results have one name, or one would overwrite a
        case; every pair is named.

    Examples
    --------
    >>> [task.target for task in tasks(["a/x.dat", "y.v2.yaml"], "results", ".json")]
    ['results/x.json', 'results/y.v2.json']
    """
    planned = [CaseTask(file, os.path.join(folder, _stem(file) + suffix)) for file in cases]  # noqa: PTH118
    real = partial(_real_path, lru_cache(maxsize=None)(os.path.realpath))
    refused = []
    inputs: dict[str, CaseTask] = {}
    for task in planned:
        before = inputs.setdefault(real(task.file), task)
        if before is not task:
            same = f" (the same file as {before.file})" if before.file != task.file else ""
            refused.append(f"{task.file} is named twice{same}")
    results: dict[str, str] = {}
    for file, target in inputs.values():
        place = real(str(target))
        before_file = results.setdefault(place, file)
        if before_file is not file:
            refused.append(f"{before_file} and {file} would both give {target}")
        if place in inputs:
            refused.append(f"the result of {file} would overwrite the case {inputs[place].file}")
    refused += [
        f"the result of {results[real(other)]} would overwrite {other}"
        for other in others
        if real(other) in results
    ]
    if refused:
        raise click.UsageError("nothing was calculated:\n  " + "\n  ".join(refused))
    return planned


def _stem(file: str) -> str:
    """The name of a case without folder and suffix."""
    if file == files.STDIN:
        return STDIN_STEM
    return os.path.splitext(os.path.basename(file))[0]  # noqa: PTH119, PTH122


def _real_path(real_folder: Callable[[str], str], file: str) -> str:
    """The path of a file without links; what is no file is itself."""
    if file == files.STDIN:
        return file
    folder, name = os.path.split(file)
    if os.path.islink(file) or name in ("", ".", ".."):  # noqa: PTH114
        return os.path.realpath(file)
    return os.path.join(real_folder(folder), name)  # noqa: PTH118
