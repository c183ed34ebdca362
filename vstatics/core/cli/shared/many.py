"""Several cases, each to a file of a directory or all to one stream."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import ExitStack, contextmanager

import click

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.case_tasks import CaseTask, tasks
from vstatics.core.cli.shared.case_work import RULES_OF_CASES, Done, calculate_and_write
from vstatics.core.cli.shared.exit_status import DONE, FAILED, stopped_by
from vstatics.core.cli.shared.formats import STREAMS
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.texts import Job
from vstatics.core.errors import ReadError, listed, plural
from vstatics.core.jobs.files import STDOUT, is_stream, unwritable
from vstatics.core.jobs.finished_cases import FinishedCases
from vstatics.core.jobs.finished_parts import CaseMark, FinishedParts
from vstatics.core.jobs.finished_pieces import SUFFIX
from vstatics.core.jobs.stopping import Stop, StoppedError, stoppable
from vstatics.core.jobs.workers import workers


class _HaltedError(Exception):
    """No case can be written any more."""


class _Count:
    """How far a run has come."""

    def __init__(self, total: int, kept: int = 0) -> None:
        """Begin with the cases that need not be calculated again."""
        self.total, self.kept = total, kept
        self.done = kept
        self.calculated = kept
        self.doubtful = 0
        """So many have results, and yet fail."""
        self.failures: list[str] = []
        """A line for each case that failed."""

    def add(self, done: Done) -> None:
        """Count a case."""
        self.done += 1
        self.calculated += done.has_result
        self.doubtful += done.has_result and done.failed
        if done.failed:
            self.failures.append(_failure(done))

    @property
    def status(self) -> int:
        """The exit status."""
        return FAILED if self.failures else DONE

    def summary(self, *, quiet: bool, strict: bool) -> None:
        """Say what became of the cases; quietly, where one failed."""
        if quiet and not self.failures:
            return
        line = f"{self.calculated} of {self.total} cases calculated"
        if self.kept:
            line += f" ({self.kept} of them before)"
        if self.doubtful:
            line += f", {self.doubtful} with errors{' or warnings' * strict}"
        if without := len(self.failures) - self.doubtful:
            line += f", {without} failed"
        line += ":" * bool(self.failures)
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
    kept = f"results are in {folder}; the same command with --resume goes on"
    with FinishedCases(folder, suffix, _depends(job)) as finished:
        todo = planned = tasks(cases, folder, suffix, [*others, finished.path])
        with _until_written(folder, lambda: kept if finished.exists() else ""):
            todo = _begun(todo, finished, resume=resume, quiet=telling.quiet)
        count = _Count(len(cases), len(cases) - len(todo))
        job = job._replace(finished=finished)
        with _until_stopped(count, kept) as stop, _results(job, todo, jobs) as results:
            for _ in _follow(count, results, stop, telling):
                pass
    if count.total > 1:
        count.summary(quiet=telling.quiet, strict=telling.strict)
        if job.command == "run" and not telling.quiet:
            _tell_others(folder, suffix, planned)
    return count.status


def _tell_others(folder: str, suffix: str, planned: Sequence[CaseTask]) -> None:
    """Name results that are of no case of a run: it may be that the case is no more."""
    own = {os.path.basename(str(task.target)) for task in planned}  # noqa: PTH119
    there = {name for name in os.listdir(folder) if name.endswith(suffix) and name[0] != "."}  # noqa: PTH208
    if others := sorted(there - own):
        count, noun = len(others), plural("result", len(others))
        files.say(f"{folder}: {count} further {noun} of no case of this run: {listed(others, 10)}")


def _begun(
    todo: list[CaseTask], finished: FinishedCases, *, resume: bool, quiet: bool
) -> list[CaseTask]:
    """Begin a run, or take up the one that is there; the cases that are left to be done.

    Raises
    ------
    UsageError
        If there is a file instead of the directory, or --resume does not fit.
    OSError
    """
    try:
        os.makedirs(finished.folder, exist_ok=True)  # noqa: PTH103
    except FileExistsError:
        raise click.UsageError(f"{finished.folder} is a file: expected a directory") from None
    finished.lock()
    if resume:
        return _not_done(todo, finished, quiet=quiet)
    finished.begin()
    return todo


def _not_done(todo: list[CaseTask], finished: FinishedCases, *, quiet: bool) -> list[CaseTask]:
    """What is left of a run that is taken up; all of it where none can be."""
    try:
        without = finished.resume()
    except ReadError as error:
        if error.problems[0].id != "E031":
            raise
        raise click.UsageError(error.problems[0].message) from None  # it had other options
    if without:
        if not quiet:
            files.say(f"{finished.folder}: {without}; every case is calculated")
        finished.begin()
        return todo
    return [task for task in todo if not finished.is_done(task.file, str(task.target))]


def to_stream(
    cases: Sequence[str], output: str | None, job: Job, *, jobs: int, resume: bool = False
) -> int:
    """Write the results of all cases to one stream or file as they come; the exit status.

    Raises
    ------
    UsageError
        If --resume does not fit.
    ReadError
        If it cannot be written.
    """
    telling, whole = job.options.telling, not is_stream(output)
    kept = f"{output} was not written" if whole else "what was written ends there"
    names = {os.path.basename(file) for file in cases}  # noqa: PTH119
    are_alike = len(names) < len({*cases})
    job = job._replace(folders=are_alike and job.to.form in ("json", "jsonl"))
    with ExitStack() as stack:
        parts, done = None, set[str]()
        if whole and job.to.form in STREAMS and len(cases) > 1:
            parts = stack.enter_context(
                FinishedParts(str(output), {**_depends(job), "--format": job.to.form})
            )
            kept += "; the same command with --resume goes on"
            with _until_written(output, lambda: kept if parts.count else ""):
                done = _done_before(parts, cases, resume=resume, quiet=telling.quiet)
            job = job._replace(marked=True)
        count = _Count(len(cases), sum(file in done for file in cases))
        todo = [CaseTask(file) for file in cases if file not in done]
        stop = stack.enter_context(_until_stopped(count, kept, resumable=parts is not None))
        folder = None if parts is None else parts.folder
        write = stack.enter_context(files.stream(output, folder=folder))
        results = stack.enter_context(_results(job, todo, jobs))
        to_stdout = output in (None, STDOUT)
        made = _follow(count, results, stop, telling, beside_stdout=to_stdout, parts=parts)
        if parts is not None:
            made = _in_order(cases, done, parts, made)
        for text in texts.joined(made, job.to, job.own_frame):
            write(text)
        if parts is not None:
            parts.stays = bool(count.failures)
    if whole and count.total > 1:
        count.summary(quiet=telling.quiet, strict=telling.strict)
    if parts is not None and parts.exists():
        there = f"{output}{SUFFIX} keeps the others"
        files.say(f"{there}: the same command with --resume calculates what failed or is changed")
    return count.status


def _done_before(
    parts: FinishedParts, cases: Sequence[str], *, resume: bool, quiet: bool
) -> set[str]:
    """The cases of a run that is taken up of which there are parts."""
    try:
        without = parts.open(resume=resume)
    except ReadError as error:
        if error.problems[0].id != "E031":
            raise
        raise click.UsageError(error.problems[0].message) from None  # it had other options
    if without and not quiet:
        files.say(f"{parts.directory}: {without}; every case is calculated")
    return {file for file in cases if parts.is_done(file)}


def _in_order(
    cases: Sequence[str], done: Collection[str], parts: FinishedParts, coming: Iterator[texts.Part]
) -> Iterator[texts.Part]:
    """The parts of all cases, those that are there already between those that come."""
    for file in cases:
        yield parts.part(file) if file in done else next(coming)
    yield from coming  # nothing, but it ends


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
    parts: FinishedParts | None = None,
) -> Iterator[texts.Part]:
    """Tell and count what becomes of each case, and give its part of a stream, which is kept."""
    quiet, telling = telling.quiet, telling._replace(notes=True)
    with progress(count.total, "cases", beside_stdout=beside_stdout, quiet=quiet) as advance:
        advance(count.kept)
        for done in results:
            files.show(telling.printed(done.problems))
            if done.stop:
                raise _HaltedError
            if parts is not None and done.mark is not None and isinstance(done.part, bytes):
                _put(parts, done.file, done.mark, done.part)
            yield done.part
            count.add(done)
            advance(1)
            stop.check()


def _put(parts: FinishedParts, file: str, mark: CaseMark, part: bytes) -> None:
    """Keep a part; where the disk is full the run is over."""
    try:
        parts.put(file, mark, part)
    except OSError as error:
        files.show([unwritable(parts.path, error)])
        raise _HaltedError from None


@contextmanager
def _until_written(output: str | None, remains: Callable[[], str]) -> Iterator[None]:
    """Let a full disk end a command with a word on its output and on the work that remains.

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
def _until_stopped(count: _Count, kept: str, *, resumable: bool = False) -> Iterator[Stop]:
    """Let Ctrl-C, SIGTERM and a full disk end a run with a word on how far it came.

    Parameters
    ----------
    resumable : bool
        Whether that is said, too, where the output cannot be written.
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
        "--allow": sorted(set(job.options.telling.allow)) or None,
        "--lang": style.lang if job.to.is_text else None,
        "-f source": job.to.form == "source" or None,  # its files have the suffix of listings
        "--digits": style.digits,
        "--raw": style.raw or None,
        "--own-tables": style.own_tables or None,
        "files with folders": job.folders or None,
    }
