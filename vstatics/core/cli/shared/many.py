"""Runs of several cases, with output to files in a directory or to a stream."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager

import click

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.case_tasks import CaseTask, tasks
from vstatics.core.cli.shared.case_work import RULES_OF_CASES, Done, calculate_and_write, in_groups
from vstatics.core.cli.shared.exit_status import DONE, FAILED, stopped_by
from vstatics.core.cli.shared.formats import STREAMS
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.texts import Job
from vstatics.core.errors import ReadError, listed, plural
from vstatics.core.jobs.files import STDOUT, is_stream, unwritable
from vstatics.core.jobs.finished_cases import FinishedCases
from vstatics.core.jobs.finished_parts import FinishedParts
from vstatics.core.jobs.finished_pieces import SUFFIX
from vstatics.core.jobs.stopping import Stop, StoppedError, stoppable
from vstatics.core.jobs.workers import workers


class _HaltedError(Exception):
    """Exception raised if the output of further cases cannot be written."""


class _Count:
    """Numbers of finished, calculated and failed cases of a run."""

    def __init__(self, total: int, finished_before: int) -> None:
        self.total = total
        self.finished_before = self.done = self.calculated = finished_before
        self.doubtful = 0
        """Number of failed cases that have results."""
        self.failures: list[str] = []
        """A line for each failed case."""

    def add(self, done: Done) -> None:
        self.done += 1
        self.calculated += done.has_result
        self.doubtful += done.has_result and done.failed
        if done.failed:
            self.failures.append(_failure(done))

    @property
    def status(self) -> int:
        """Exit status of the command."""
        return FAILED if self.failures else DONE

    def summary(self, telling: Telling) -> None:
        """Print the numbers of calculated and failed cases, with -q only after failures."""
        if telling.quiet and not self.failures:
            return
        line = f"{self.calculated} of {self.total} cases calculated"
        if self.finished_before:
            line += f" ({self.finished_before} of them before)"
        if self.doubtful:
            line += f", {self.doubtful} with errors{' or warnings' * telling.strict}"
        if failed := len(self.failures) - self.doubtful:
            line += f", {failed} failed"
        line += ":" * bool(self.failures)
        for sentence in (line, *self.failures):
            files.say(sentence)


def _failure(done: Done) -> str:
    """Return words for a failed case: first error or warning, and number of further problems."""
    causes = [problem for problem in done.problems if problem.severity == "error"]
    causes = causes or [problem for problem in done.problems if problem.severity == "warning"]
    first = str(causes[0]) if causes else "failed"
    names_file = bool(causes) and causes[0].place is not None and causes[0].place.file == done.file
    line = f"  {first}" if names_file else f"  {done.file}: {first}"
    if len(causes) > 1:
        line += f" ... and {len(causes) - 1} more {plural('problem', len(causes) - 1)}"
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
    """Write the result of each case to a directory, and return the exit status.

    Parameters
    ----------
    others : sequence of str
        Further files that no result may overwrite.

    Raises
    ------
    UsageError
        If a result would overwrite another result or a case, or the earlier run had other options.
    ReadError
        If the directory cannot be written to.
    """
    suffix, telling = job.to.suffix, job.options.telling
    remains = f"results are in {folder}; the same command with --resume goes on"
    with FinishedCases(folder, suffix, _depends(job)) as finished:
        todo = planned = tasks(cases, folder, suffix, [*others, finished.path])
        with _until_written(folder, lambda: remains if finished.exists() else ""):
            todo = _begun(todo, finished, resume=resume, quiet=telling.quiet)
        count = _Count(len(cases), len(cases) - len(todo))
        job = job._replace(finished=finished)
        with _until_stopped(count, remains) as stop, _results(job, todo, jobs) as results:
            for _ in _follow(count, results, stop, telling):
                pass
    if count.total > 1:
        count.summary(telling)
        if job.command == "run" and not telling.quiet:
            _report_others(folder, suffix, planned)
    return count.status


def _report_others(folder: str, suffix: str, planned: Sequence[CaseTask]) -> None:
    """Report results in the directory that are not results of the run's cases."""
    expected = {os.path.basename(str(task.target)) for task in planned}  # noqa: PTH119
    present = {name for name in os.listdir(folder) if name.endswith(suffix) and name[0] != "."}  # noqa: PTH208
    if others := sorted(present - expected):
        count, noun = len(others), plural("result", len(others))
        files.say(
            f"{folder}: {count} further {noun} without a case in this run: {listed(others, 10)}"
        )


def _begun(
    todo: list[CaseTask], finished: FinishedCases, *, resume: bool, quiet: bool
) -> list[CaseTask]:
    """Begin or resume a run, and return the cases that remain to be calculated.

    Raises
    ------
    UsageError
        If the directory is a file, or the earlier run had other options.
    OSError
    """
    try:
        os.makedirs(finished.folder, exist_ok=True)  # noqa: PTH103
    except FileExistsError:
        raise click.UsageError(f"{finished.folder} is a file: expected a directory") from None
    finished.lock()
    if resume:
        with _other_options_as_wrong_use():
            why_not = finished.resume()
        if why_not:
            if not quiet:
                files.say(f"{finished.folder}: {why_not}; every case is calculated")
            finished.begin()
            return todo
        return [task for task in todo if not finished.is_done(task.file, str(task.target))]
    finished.begin()
    return todo


@contextmanager
def _other_options_as_wrong_use() -> Iterator[None]:
    """Run the block. Treat other options in the earlier run as wrong use of --resume."""
    try:
        yield
    except ReadError as error:
        if error.problems[0].id != "E031":
            raise
        raise click.UsageError(error.problems[0].message) from None


def to_stream(
    cases: Sequence[str], output: str | None, job: Job, *, jobs: int, resume: bool = False
) -> int:
    """Write the results of all cases to a stream or file, and return the exit status.

    Raises
    ------
    UsageError
        If the earlier run had other options.
    ReadError
        If the output cannot be written.
    """
    telling, is_file = job.options.telling, not is_stream(output)
    remains = f"{output} was not written" if is_file else "the output ends there"
    names = {os.path.basename(file) for file in cases}  # noqa: PTH119
    are_alike = len(names) < len({*cases})
    job = job._replace(folders=are_alike and job.to.form in ("json", "jsonl"))
    with ExitStack() as stack:
        parts, done = None, set[str]()
        if is_file and job.to.form in STREAMS and len(cases) > 1:
            parts = stack.enter_context(
                FinishedParts(str(output), {**_depends(job), "--format": job.to.form})
            )
            remains += "; the same command with --resume goes on"
            with _until_written(output, lambda: remains if parts.count else ""):
                done = _done_before(parts, cases, resume=resume, quiet=telling.quiet)
            job = job._replace(marked=True)
        count = _Count(len(cases), sum(file in done for file in cases))
        todo = [CaseTask(file) for file in cases if file not in done]
        stop = stack.enter_context(_until_stopped(count, remains, resumable=parts is not None))
        folder = None if parts is None else parts.folder
        write = stack.enter_context(files.stream(output, folder=folder))
        results = stack.enter_context(_results(job, todo, jobs))
        to_stdout = output in (None, STDOUT)
        coming = _follow(count, results, stop, telling, beside_stdout=to_stdout, parts=parts)
        if parts is not None:
            coming = _in_order(cases, done, parts, coming)
        for text in texts.joined(coming, job.to, job.own_frame):
            write(text)
        if parts is not None:
            parts.stays = bool(count.failures)
    if is_file and count.total > 1:
        count.summary(telling)
    if parts is not None and parts.exists():
        there = f"{output}{SUFFIX} keeps the others"
        files.say(f"{there}: the same command with --resume calculates what failed or is changed")
    return count.status


def _done_before(
    parts: FinishedParts, cases: Sequence[str], *, resume: bool, quiet: bool
) -> set[str]:
    with _other_options_as_wrong_use():
        why_not = parts.open(resume=resume)
    if why_not and not quiet:
        files.say(f"{parts.directory}: {why_not}; every case is calculated")
    return {file for file in cases if parts.is_done(file)}


def _in_order(
    cases: Sequence[str], done: Collection[str], parts: FinishedParts, coming: Iterator[texts.Part]
) -> Iterator[texts.Part]:
    for file in cases:
        yield parts.part(file) if file in done else next(coming)
    yield from coming  # this only runs the generator to its end


@contextmanager
def _results(job: Job, todo: Sequence[CaseTask], jobs: int) -> Iterator[Iterator[Done]]:
    """Yield an iterator of the outcomes of cases in their order, calculated by `jobs` processes."""
    if min(jobs, len(todo)) <= 1:
        yield in_groups(job, todo)
        return
    with workers(job, str, jobs=min(jobs, len(todo)), rules=RULES_OF_CASES) as called:
        yield (done for _, done in called.each(calculate_and_write, todo, ordered=True))


def _follow(
    count: _Count,
    results: Iterator[Done],
    stop: Stop,
    telling: Telling,
    *,
    beside_stdout: bool = False,
    parts: FinishedParts | None = None,
) -> Iterator[texts.Part]:
    """Report and count the outcome of each case; store and yield the output of the case."""
    quiet, telling = telling.quiet, telling._replace(notes=True)
    with progress(count.total, "cases", beside_stdout=beside_stdout, quiet=quiet) as advance:
        advance(count.finished_before)
        for done in results:
            files.show(telling.printed(done.problems))
            if done.stop:
                raise _HaltedError
            if parts is not None and done.mark is not None and isinstance(done.part, bytes):
                try:
                    parts.put(done.file, done.mark, done.part)
                except OSError as error:
                    files.show([unwritable(parts.path, error)])
                    raise _HaltedError from None
            yield done.part
            count.add(done)
            advance(1)
            stop.check()


@contextmanager
def _until_written(output: str | None, remains: Callable[[], str]) -> Iterator[None]:
    """Run the block. If the output cannot be written, report what is stored, and exit.

    Raises
    ------
    Exit
    """
    try:
        yield
    except OSError as error:
        files.show([unwritable(output, error)])
        if line := remains():
            files.say(line)
        raise click.exceptions.Exit(FAILED) from None


@contextmanager
def _until_stopped(count: _Count, remains: str, *, resumable: bool = False) -> Iterator[Stop]:
    """Run the block. After Ctrl-C, SIGTERM or a full disk, report the finished work, and exit.

    Parameters
    ----------
    resumable : bool
        True if the run can be resumed after a failure to write the output.
    """
    try:
        with stoppable() as stop:
            yield stop
    except StoppedError as stopped:
        status = stopped_by(stopped.signal)
    except _HaltedError:
        status = FAILED
    except ReadError as error:
        if not resumable:
            raise
        files.show(error.problems)
        status = FAILED
    else:
        return
    files.say(f"stopped after {count.done} of {count.total} cases; {remains}")
    raise click.exceptions.Exit(status)


def _depends(job: Job) -> dict[str, object]:
    """Return the options that affect results, and must be equal in a resumed run."""
    style = job.to.style
    return {
        "command": job.command,
        "--from": job.options.input_format,
        "--coast": job.options.coast,
        "--unloaded": job.options.idle,
        # a result with warnings counts as done without --strict
        "--strict": job.options.telling.strict,
        "--allow": sorted(set(job.options.telling.allow)) or None,
        "--lang": style.lang if job.to.is_text else None,
        "-f source": job.to.form == "source" or None,  # this format has the suffix of listings
        "--digits": style.digits,
        "--raw": style.raw or None,
        "--own-tables": style.own_tables or None,
        "files with folders": job.folders or None,
    }
