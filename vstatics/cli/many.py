"""Several cases: to a directory, a file each, or to one stream."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import click

from vstatics.cli import files, texts
from vstatics.cli.case_job import RULES, Done, calculate_and_write
from vstatics.cli.exit_status import DONE, FAILED, stopped_by
from vstatics.cli.formats import SUFFIXES
from vstatics.cli.job import Job
from vstatics.cli.progress import progress
from vstatics.cli.targets import CaseTask, tasks
from vstatics.errors import ReadError
from vstatics.jobs.files import is_stream, unwritable
from vstatics.jobs.finished_cases import FinishedCases
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

    def summary(self) -> None:
        """Say what became of the cases."""
        line = f"{self.done - len(self.failures)} of {self.total} cases calculated"
        if self.kept:
            line += f" ({self.kept} of them before)"
        if self.failures:
            line += f", {len(self.failures)} failed:"
        for sentence in (line, *self.failures):
            files.say(sentence)


def _failure(done: Done) -> str:
    """The line of a case that failed: its first error, and how many more there are."""
    errors = [problem for problem in done.problems if problem.severity == "error"]
    first = str(errors[0]) if errors else "failed"
    named = bool(errors) and errors[0].place is not None and errors[0].place.file == done.file
    line = f"  {first}" if named else f"  {done.file}: {first}"
    if len(errors) > 1:
        line += f" ... and {len(errors) - 1} more problem{'s' * (len(errors) > 2)}"
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
    suffix = SUFFIXES[job.form.name][0]
    with FinishedCases(folder, suffix, _depends(job)) as finished:
        todo = tasks(cases, folder, suffix, [*others, finished.path])
        try:
            os.makedirs(folder, exist_ok=True)  # noqa: PTH103
            finished.lock()
            if resume:
                todo = _not_done(todo, finished)
            else:
                finished.begin()
        except FileExistsError:
            raise click.UsageError(f"{folder} is a file: expected a directory") from None
        except OSError as error:
            raise ReadError([unwritable(folder, error)]) from None
        count = _Count(len(cases), len(cases) - len(todo))
        kept = f"results are in {folder}; the same command with --resume goes on"
        job = job._replace(finished=finished)
        with _telling(count, kept) as stop, _results(job, todo, jobs) as results:
            for _ in _follow(count, results, stop):
                pass
    if count.total > 1:
        count.summary()
    return count.status


def _not_done(todo: list[CaseTask], finished: FinishedCases) -> list[CaseTask]:
    """What is left of a run that is taken up; all of it where none can be."""
    try:
        without = finished.resume()
    except ReadError as error:  # it had other options
        raise click.UsageError(error.problems[0].message) from None
    if without:
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
    count = _Count(len(cases))
    whole = not is_stream(output)
    kept = f"{output} was not written" if whole else "what was written ends there"
    todo = [CaseTask(file) for file in cases]
    with (
        _telling(count, kept) as stop,
        files.stream(output) as write,
        _results(job, todo, jobs) as results,
    ):
        parts = _follow(count, results, stop, beside_stdout=output in (None, files.STDIN))
        for text in texts.joined(parts, job.form):
            write(text)
    if whole and count.total > 1:
        count.summary()
    return count.status


@contextmanager
def _results(job: Job, todo: Sequence[CaseTask], jobs: int) -> Iterator[Iterator[Done]]:
    """What becomes of each case, in their order, by so many processes."""
    with workers(job, str, jobs=min(jobs, len(todo)), rules=RULES) as called:
        yield (done for _, done in called.each(calculate_and_write, todo, ordered=True))


def _follow(
    count: _Count, results: Iterator[Done], stop: Stop, *, beside_stdout: bool = False
) -> Iterator[bytes]:
    """Tell and count what becomes of each case, and give its part of a stream."""
    with progress(count.total, "cases", beside_stdout=beside_stdout) as advance:
        advance(count.kept)
        for done in results:
            files.show(done.problems)
            if done.stop:
                raise _HaltedError
            yield done.text
            count.add(done)
            advance(1)
            stop.check()


@contextmanager
def _telling(count: _Count, kept: str) -> Iterator[Stop]:
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
    style = job.form.style
    return {
        "command": job.command,
        "--from": job.options.input_format,
        "--coast": job.options.coast,
        "--idle": job.options.idle,
        "--lang": style.lang if job.form.is_text else None,
        "--digits": style.digits,
        "--raw": style.raw or None,
    }
