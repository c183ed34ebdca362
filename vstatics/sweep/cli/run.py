"""Execution of a sweep with output to a file or stream, and a report at the end."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import outside_notes, show_problems
from vstatics.core.cli.shared.exit_status import DONE, EMPTY, FAILED, stopped_by
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, going_on_later, kept_pieces
from vstatics.core.errors import Problem, count_of, not_allowed, of_file, plural, quoted, spoken
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
from vstatics.sweep.results.linked import table_of
from vstatics.sweep.results.selection import WhereCondition
from vstatics.sweep.tasks import SweepTask


class SweepRun(NamedTuple):
    """Plan of a sweep with the options of execution and output."""

    plan: SweepPlan
    form: Format
    output: str | None
    sharing: Sharing
    raw: bool
    telling: Telling
    fail_empty: bool = False
    """True if a sweep without rows is a failure."""

    @property
    def quiet(self) -> bool:
        """True if only failures are reported."""
        return self.telling.quiet

    @property
    def task(self) -> SweepTask:
        """Task that workers receive."""
        return SweepTask(self.plan, self.form, raw=self.raw)


class Ended(NamedTuple):
    """Outcome of a sweep."""

    status: int
    """Exit status of the command, not yet considering warnings."""
    messages: Sequence[Problem] = ()
    """Messages of simulated runs."""


def carry_out(run: SweepRun) -> Ended:
    """Execute a sweep, write the output, and report the outcome."""
    try:
        if run.output is None or is_stream(run.output):
            return to_stream(run)
        return to_file(run, run.output)
    finally:
        if table := table_of(run.plan.variants):
            table.close()


def to_file(run: SweepRun, output: str) -> Ended:
    """Calculate a sweep and write the output file, completely or not at all."""
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
            definition = description(plan, run.form)
            sharing.open(
                store, output, definition, plan.pieces, "variant is calculated", quiet=quiet
            )
            finished_before = written.finished
            called = written.task.workers(sharing.processes, sharing.scheduler)
            with called, progress(plan.count, what, quiet=quiet) as advance:
                advance(finished_before)
                written.calculate(called, advance)
                report = written.assemble(called)
    return _summary(run, report, time.perf_counter() - began, finished_before)


def to_stream(run: SweepRun) -> Ended:
    """Calculate a sweep and write rows to a stream, such as stdout, during the calculation."""
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
    if not isinstance(plan.subject, Transmission) or len(plan.gears or plan.asked_gears) < 2:
        return ""
    return " in every gear that is asked for"


def _summary(run: SweepRun, report: SweepReport, seconds: float, finished_before: int = 0) -> Ended:
    what = _counted(run.plan)
    output = "<stdout>" if run.output in (None, STDOUT) else run.output
    reasons = [
        f"{report.counts[status]} {status}"
        for status in chunk.STATUS[1:]
        if status in report.counts
    ]
    unlike = f" ({', '.join(reasons)})" if reasons else ""
    before = f", {finished_before} of them before" if finished_before else ""
    rows = count_of("row", report.rows)
    noun = what.removesuffix("s")
    variants = count_of(noun, report.variants)
    if run.plan.by_gear:
        variants += f", {run.plan.count // run.plan.variants.count} in each variant"
    rate = float(f"{(report.variants - finished_before) / max(seconds, 1e-9):.3g}")
    if reasons or not run.quiet:
        files.say(
            f"{output}: {rows} of {variants}{unlike}{before}; "
            f"{seconds:.3g} s, {rate:,.0f} {plural(noun, round(rate))} a second"
        )
    if report.outside and not run.quiet:
        files.show(outside_notes(report.outside, run.plan.case, str(output)))
    messages = tell_noticed(run, report.noticed)
    if not report.solved:
        files.say(f"no variant has a solution{_where_solved(run.plan)}")
        tell_reason(run.plan)
        return Ended(FAILED, messages)
    if run.plan.where is not None and not report.rows:
        _print_removed(run.plan.where, report)
    if run.plan.objectives and not report.rows and sum(report.removed) < report.variants:
        names = spoken(quoted(objective.expression.text) for objective in run.plan.objectives)
        files.say(f"no variant has a value for {names}")
    return Ended(EMPTY if run.fail_empty and not report.rows else DONE, messages)


def tell_noticed(run: SweepRun, noticed: Sequence[Noticed]) -> Sequence[Problem]:
    """Print and return the messages of simulated runs, each once for all variants."""
    # Notes are shown, as by `vstatics simulate`.
    plan, telling = run.plan, run.telling._replace(notes=True)
    if isinstance(plan.subject, Transmission):
        return ()
    file, count = plan.subject.file, plan.variants.count
    messages = [
        of_file(
            note.id,
            file,
            f"in {'all' if note.variants == count else f'{note.variants} of'} "
            f"{count_of('variant', count)}"
            f"{'' if note.variants == count else f', the first is {note.first}'}: {note.text}",
        )
        for note in not_allowed(noticed, telling.allow)
    ]
    show_problems(messages, telling, file)
    return messages


def _counted(plan: SweepPlan) -> str:
    return "gears" if plan.by_gear else "variants"


def _print_removed(where: WhereCondition, report: SweepReport) -> None:
    remaining = report.variants
    for part, removed in zip(where.parts, report.removed, strict=True):
        files.say(f"`{part.text}` removed {removed} of {remaining}")
        remaining -= removed


def tell_reason(plan: SweepPlan) -> None:
    """Print the reason if the first variant has no results."""
    if isinstance(plan.subject, Transmission):
        files.show(blocks.reason(plan))
    else:
        files.show(runs.reason(plan, plan.subject))
