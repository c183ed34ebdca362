"""Carrying out a sweep: to a file or a stream, with what is said when it ends."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import outside_notes, show_problems
from vstatics.core.cli.shared.exit_status import DONE, EMPTY, FAILED, stopped_by
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, going_on_later, kept_pieces
from vstatics.core.errors import Problem, not_allowed, of_file
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.jobs.finished_pieces import FinishedPieces
from vstatics.core.jobs.piece_file import Noticed
from vstatics.core.jobs.stopping import StoppedError
from vstatics.core.model.transmission import Transmission
from vstatics.sweep import blocks, chunk, runs
from vstatics.sweep.cli.estimate import check_room
from vstatics.sweep.formats import Format
from vstatics.sweep.output import Output, SweepReport, description, stream
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.results.selection import WhereCondition
from vstatics.sweep.tasks import SweepTask
from vstatics.sweep.variants.numbered import VariantTable

UNSOLVED = [
    chunk.STATUS[code] for code in (chunk.TIED_UP, chunk.CONFLICT, chunk.INVALID, chunk.STOPPED)
]
"""A variant of this status has no solution at all."""


class SweepRun(NamedTuple):
    """A sweep, who calculates it, and where it goes."""

    plan: SweepPlan
    form: Format
    output: str | None
    sharing: Sharing
    raw: bool
    telling: Telling
    fail_empty: bool = False
    """Whether a sweep without rows fails."""

    @property
    def quiet(self) -> bool:
        """Whether it is said only what is not well."""
        return self.telling.quiet

    @property
    def task(self) -> SweepTask:
        """What there is to do for each piece."""
        return SweepTask(self.plan, self.form, raw=self.raw)


class Ended(NamedTuple):
    """How a sweep ended."""

    status: int
    """Of the command, so far."""
    told: Sequence[Problem] = ()
    """What was said of its runs."""


def carry_out(run: SweepRun) -> Ended:
    """Carry out a sweep."""
    try:
        if run.output is None or is_stream(run.output):
            return to_stream(run)
        return to_file(run, run.output)
    finally:
        if isinstance(run.plan.variants, VariantTable):
            run.plan.variants.close()


def to_file(run: SweepRun, output: str) -> Ended:
    """Write the output file, whole or not at all."""
    from vstatics.core.cli.shared.progress import progress

    plan, sharing, quiet = run.plan, run.sharing, run.quiet
    began = time.perf_counter()
    with FinishedPieces(output) as store:
        check_room(plan, run.form, output, store)
        written = Output(plan, run.form, store, raw=run.raw)
        what = _counted(plan)
        whole = f"{plan.count} {what}"
        with going_on_later(
            output, store, lambda: kept_pieces(written.finished, whole, store, output)
        ):
            made = description(plan, run.form)
            sharing.open(store, output, made, plan.pieces, "variant is calculated", quiet=quiet)
            kept = written.finished
            called = written.task.workers(sharing.processes, sharing.scheduler)
            with called, progress(plan.count, what, quiet=quiet) as advance:
                advance(kept)
                written.calculate(called, advance)
                report = written.assemble(called)
    return _summary(run, report, time.perf_counter() - began, kept)


def to_stream(run: SweepRun) -> Ended:
    """Write rows to stdout, or to what is no file, as they come."""
    from vstatics.core.cli.shared.progress import progress

    plan, sharing = run.plan, run.sharing
    began = time.perf_counter()
    task = run.task
    done = 0
    try:
        with (
            files.stream(run.output) as write,
            task.workers(sharing.processes, sharing.scheduler) as called,
            progress(plan.count, _counted(plan), beside_stdout=True, quiet=run.quiet) as advance,
        ):

            def advanced(variants: int) -> None:
                nonlocal done
                done += variants
                advance(variants)

            report = stream(task, called, advanced, write)
    except StoppedError as stopped:
        files.say(f"stopped after {done} of {plan.count} {_counted(plan)}")
        return Ended(stopped_by(stopped.signal))
    return _summary(run, report, time.perf_counter() - began)


def _where_solved(plan: SweepPlan) -> str:
    """Where a variant of several gears needs a solution."""
    if plan.by_gear or not isinstance(plan.subject, Transmission) or len(plan.asked_gears) < 2:
        return ""
    return " in every gear that is asked for"


def _summary(run: SweepRun, report: SweepReport, seconds: float, kept: int = 0) -> Ended:
    """Say what became of the variants."""
    what = _counted(run.plan)
    output = "<stdout>" if run.output in (None, STDOUT) else run.output
    reasons = [
        f"{report.counts[status]} {status}"
        for status in chunk.STATUS[1:]
        if status in report.counts
    ]
    unlike = f" ({', '.join(reasons)})" if reasons else ""
    before = f", {kept} of them before" if kept else ""
    rate = (report.variants - kept) / max(seconds, 1e-9)
    if reasons or not run.quiet:
        files.say(
            f"{output}: {report.rows} rows of {report.variants} {what}{unlike}{before}; "
            f"{seconds:.3g} s, {float(f'{rate:.3g}'):,.0f} {what} a second"
        )
    if report.outside and not run.quiet:
        files.show(outside_notes(report.outside, run.plan.case, str(output)))
    told = tell_noticed(run, report.noticed)
    solved = sum(count for status, count in report.counts.items() if status not in UNSOLVED)
    if not solved:
        files.say(f"no variant has a solution{_where_solved(run.plan)}")
        tell_reason(run.plan)
        return Ended(FAILED, told)
    if run.plan.where is not None and not report.rows:
        _tell_removed(run.plan.where, report)
    return Ended(EMPTY if run.fail_empty and not report.rows else DONE, told)


def tell_noticed(run: SweepRun, noticed: Sequence[Noticed]) -> Sequence[Problem]:
    """Tell the messages of runs, each once for all variants; they are returned."""
    plan, telling = run.plan, run.telling._replace(notes=True)  # as `simulate` tells them
    if isinstance(plan.subject, Transmission):
        return ()
    file, count = plan.subject.file, plan.variants.count
    told = [
        of_file(
            one.id,
            file,
            f"in {'all' if one.variants == count else f'{one.variants} of'} {count} variants"
            f"{'' if one.variants == count else f', the first is {one.first}'}: {one.text}",
        )
        for one in not_allowed(noticed, telling.allow)
    ]
    show_problems(told, telling, file)
    return told


def _counted(plan: SweepPlan) -> str:
    """What a row may be of."""
    return "gears of variants" if plan.by_gear else "variants"


def _tell_removed(where: WhereCondition, report: SweepReport) -> None:
    """Say how many of those that are left each part of a condition removed."""
    left = report.variants
    for part, removed in zip(where.parts, report.removed, strict=True):
        files.say(f"`{part.text}` removed {removed} of {left}")
        left -= removed


def tell_reason(plan: SweepPlan) -> None:
    """Say why the first variant has no numbers, where that can be told."""
    if isinstance(plan.subject, Transmission):
        files.show(blocks.reason(plan))
    else:
        files.show(runs.reason(plan, plan.subject))
