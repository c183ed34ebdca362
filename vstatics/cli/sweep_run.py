"""Carrying out a sweep: to a file or a stream, with what is said when it ends."""

from __future__ import annotations

import os
import stat
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from vstatics.cli import files
from vstatics.errors import CaseError, Place, Problem
from vstatics.jobs.files import opened
from vstatics.jobs.stopping import StoppedError, stoppable
from vstatics.jobs.store import SUFFIX, Store
from vstatics.sweep.chunk import STATUS
from vstatics.sweep.formats import Format
from vstatics.sweep.output import Output, SweepReport, description, stream
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.tasks import SweepTask
from vstatics.sweep.variants import VariantTable

UNSOLVED = ("tied up", "conflict", "invalid")
"""A variant of this status has no solution at all."""


def is_stream(output: str | None) -> bool:
    """Whether the output is no file that could be replaced."""
    if output is None or output == files.STDIN:
        return True
    if output.startswith(("/dev/std", "/dev/fd/")):  # whatever they lead to, they stay
        return True
    with suppress(OSError):
        mode = os.stat(output).st_mode  # noqa: PTH116
        return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))
    return False


def in_good_order(act: Callable[[], int]) -> int:
    """Do something that Ctrl-C and SIGTERM end in good order; its exit status."""
    try:
        with stoppable():
            return act()
    except StoppedError as stopped:  # before there was anything to keep
        files.say("stopped; nothing was finished")
        return stopped.status


def run(
    plan: SweepPlan,
    form: Format,
    output: str | None,
    *,
    jobs: int,
    scheduler: str | None,
    resume: bool,
) -> int:
    """Carry out a sweep; its exit status."""
    try:
        if output is None or is_stream(output):
            return to_stream(plan, form, output, jobs, scheduler)
        return to_file(plan, form, output, jobs, scheduler, resume=resume)
    finally:
        if isinstance(plan.variants, VariantTable):
            plan.variants.close()


def to_file(
    plan: SweepPlan, form: Format, output: str, jobs: int, scheduler: str | None, *, resume: bool
) -> int:
    """Write the output file, whole or not at all; the exit status."""
    from vstatics.cli.progress import progress
    from vstatics.jobs.workers import workers

    began = time.perf_counter()
    with Store(output) as store:
        if resume and not store.exists() and os.path.exists(output):  # noqa: PTH110
            files.say(f"{output} may be of another sweep: every variant is calculated again")
        written = Output(plan, form, store)
        try:
            store.open(description(plan, form), plan.pieces, resume=resume)
            kept = written.finished
            called = workers(
                written.task,
                written.task.describe,
                jobs=min(jobs, plan.pieces),
                scheduler=scheduler,
            )
            with called, progress(plan.variants.count, "variants") as advance:
                advance(kept)
                written.calculate(called, advance)
                report = written.assemble(called)
        except StoppedError as stopped:
            files.say(f"stopped; {_kept(written, output)}")
            return stopped.status
        except OSError as error:
            files.show([_unwritable(output, error)])
            files.say(_kept(written, output))
            return 1
        except CaseError as error:
            files.show(error.problems)
            if store.finished():
                files.say(_kept(written, output))
            return 1
    return _summary(output, report, kept, time.perf_counter() - began)


def _unwritable(output: str, error: OSError) -> Problem:
    return Problem(f"can't be written: {error.strerror or error}", place=Place(output, 0, 0))


def _kept(written: Output, output: str) -> str:
    """What there is to go on with after an end before the end."""
    plan = written.task.plan
    if not written.finished:
        return "nothing was finished"
    return (
        f"{written.finished} of {plan.variants.count} variants are finished and kept in "
        f"{output}{SUFFIX}; the same command with --resume goes on"
    )


def to_stream(
    plan: SweepPlan, form: Format, output: str | None, jobs: int, scheduler: str | None
) -> int:
    """Write rows to stdout, or to what is no file, as they come; the exit status."""
    from vstatics.cli.progress import progress
    from vstatics.jobs.workers import workers

    began = time.perf_counter()
    task = SweepTask(plan, form)
    name = "<stdout>" if output in (None, files.STDIN) else str(output)
    done = 0
    try:
        called = workers(task, task.describe, jobs=min(jobs, plan.pieces), scheduler=scheduler)
        with (
            _opened(output) as write,
            called,
            progress(plan.variants.count, "variants", beside_stdout=True) as advance,
        ):

            def advanced(variants: int) -> None:
                nonlocal done
                done += variants
                advance(variants)

            report = stream(task, called, advanced, write)
    except StoppedError as stopped:
        files.say(f"stopped after {done} of {plan.variants.count} variants")
        return stopped.status
    except BrokenPipeError:
        raise  # the reader has seen enough
    except OSError as error:
        files.show([_unwritable(name, error)])
        return 1
    return _summary(name, report, 0, time.perf_counter() - began)


@contextmanager
def _opened(output: str | None) -> Iterator[Callable[[bytes], Any]]:
    """What writes to a stream, at once."""
    if output is None or output == files.STDIN:
        if sys.stdout is None:
            raise OSError(files.CLOSED)
        sys.stdout.flush()
        buffer = sys.stdout.buffer

        def write(data: bytes) -> None:
            buffer.write(data)
            buffer.flush()

        yield write
    else:
        with opened(output) as write_there:
            yield write_there


def _summary(output: str, report: SweepReport, kept: int, seconds: float) -> int:
    """Say what became of the variants; the exit status."""
    reasons = [
        f"{report.counts[status]} {status}" for status in STATUS[1:] if status in report.counts
    ]
    told = f" ({', '.join(reasons)})" if reasons else ""
    before = f", {kept} of them before" if kept else ""
    rate = (report.variants - kept) / max(seconds, 1e-9)
    files.say(
        f"{output}: {report.rows} rows of {report.variants} variants{told}{before}; "
        f"{seconds:.3g} s, {float(f'{rate:.3g}'):,.0f} variants a second"
    )
    solved = sum(count for status, count in report.counts.items() if status not in UNSOLVED)
    if not solved:
        files.say("no variant has a solution")
    return 0 if solved else 1
