"""`vstatics simulate --samples`: many runs with numbers that are drawn, and their statistics."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import wraps
from typing import Any, NamedTuple, cast

import click
import numpy as np

from vstatics import readers
from vstatics.cli.frame import files
from vstatics.cli.frame.cases import Command
from vstatics.cli.frame.exit_status import DONE, FAILED, stopped_by
from vstatics.cli.frame.formats import Destination, OutputOptions
from vstatics.cli.frame.one_case import show
from vstatics.cli.frame.problems import Telling
from vstatics.cli.sweep.run import run, tell_reason
from vstatics.cli.sweep.subject import read_scenario_subject, spare
from vstatics.errors import CaseError, ReadError
from vstatics.jobs.files import is_stream
from vstatics.jobs.stopping import StoppedError
from vstatics.jobs.workers import cores
from vstatics.numerics.arrays import Floats
from vstatics.sweep import build
from vstatics.sweep.formats import Format
from vstatics.sweep.kept.statistics import columns_statistics, statistics_document, statistics_grids
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.plan import SweepPlan
from vstatics.sweep.tasks import SweepTask, calculate
from vstatics.sweep.variants.subject import Document, VariedScenario
from vstatics.tables.suffixes import format_of, known

ROWS = ("csv", "jsonl", "npz", "parquet")
"""Formats of the variants themselves, which are read again for the statistics."""


class SampleOptions(NamedTuple):
    """How many runs, and who calculates them."""

    samples: int | None = None
    """None: one run, of the scenario as it is."""
    seed: int | None = None
    out: str | None = None
    jobs: int | None = None
    scheduler: str | None = None
    resume: bool = False

    def check(self, **of_one_run: bool) -> None:
        """Refuse what belongs to samples where there are none, and what goes not with them.

        Parameters
        ----------
        **of_one_run : bool
            Options that are for one run, and whether they are given.

        Raises
        ------
        UsageError
        """
        of_one = [f"--{name}" for name, given in of_one_run.items() if given]
        if self.samples is not None and of_one:
            raise click.UsageError(f"{of_one[0]} is for one run, without --samples.")
        given = {f"--{name}": value for name, value in self._asdict().items() if name != "samples"}
        alone = [name for name, value in given.items() if value not in (None, False)]
        if self.samples is None and alone:
            raise click.UsageError(f"{alone[0]} belongs to --samples.")
        if self.scheduler and (self.jobs or 1) > 1:
            raise click.UsageError("--jobs and --scheduler exclude one another.")


def options(command: Command) -> Command:
    """The options of samples; the command gets `sampling`."""

    @wraps(command)
    def with_sampling(*values: Any, **others: Any) -> Any:
        said = {name: others.pop(name) for name in SampleOptions._fields}
        return command(*values, sampling=SampleOptions(**said), **others)

    decorated: Any = with_sampling
    for option in reversed(_OPTIONS):
        decorated = option(decorated)
    return decorated  # type: ignore[no-any-return]


_OPTIONS: tuple[Callable[[Any], Any], ...] = (
    click.option(
        "--samples",
        type=click.IntRange(1),
        metavar="N",
        help="N runs with numbers drawn as `samples` says: their statistics; -o has the runs.",
    ),
    click.option("--seed", type=click.IntRange(0), metavar="S", help="Of --samples.  [default: 0]"),
    click.option("--out", metavar="LIST", help="What is told of --samples, as in a sweep."),
    click.option("-j", "--jobs", type=click.IntRange(1), help="Processes.  [default: all cores]"),
    click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler, such as tcp://HOST:8786."),
    click.option("--resume", is_flag=True, help="Go on with --samples that were stopped."),
)


def run_samples(
    scenario: Document,
    case: str | None,
    case_format: readers.Format | None,
    rtol: float,
    sampling: SampleOptions,
    wanted: OutputOptions,
    telling: Telling,
) -> int:
    """Run the variants, write them if that is asked for, and show the statistics.

    Raises
    ------
    ReadError
        If there can be no such samples.
    UsageError
    """
    form = _format(wanted)
    if sampling.resume and form is None:
        raise click.UsageError("--resume needs a file to go on with: -o FILE.")
    subject, warnings = read_scenario_subject(scenario, telling, case, case_format)
    varied = replace(cast("VariedScenario", subject), rtol=rtol)
    spare(varied, wanted.output)
    options = SweepOptions.of(sample=sampling.samples, seed=sampling.seed, out=sampling.out)
    jobs = 1 if sampling.scheduler else sampling.jobs or cores()
    try:
        build.check_packages(SweepOptions(), form or "csv", sampling.scheduler)
        plan = build.sample_plan(varied, options)
        if form is None:
            found = _collected(plan, jobs, sampling.scheduler, telling)
        else:
            found = _written(plan, form, str(wanted.output), jobs, sampling, wanted, telling)
    except CaseError as error:
        raise ReadError(error.problems) from error
    if isinstance(found, int):
        return found
    statistics = columns_statistics(found)
    to = Destination("text", None, wanted.style) if form else wanted.destination([])
    title = varied.own.name or varied.own.scenario.case.name
    show(
        scenario.file,
        to,
        title,
        lambda: statistics_grids(plan.names, statistics),
        lambda: statistics_document(plan.names, statistics),
    )
    return FAILED if telling.fails(warnings) else DONE


def _format(wanted: OutputOptions) -> Format | None:
    """In which format the variants are written; none if only statistics are shown."""
    if wanted.output is None or is_stream(wanted.output):
        return None
    told = wanted.form or format_of(wanted.output, ROWS)
    if told not in ROWS:
        expected = " ".join(known(ROWS))
        raise click.UsageError(f"{wanted.output}: --samples writes {expected}, expected a suffix")
    return cast("Format", told)


def _written(
    plan: SweepPlan,
    form: Format,
    output: str,
    jobs: int,
    sampling: SampleOptions,
    wanted: OutputOptions,
    telling: Telling,
) -> Mapping[str, Floats] | int:
    """The columns of the variants, which lie in a file then; else an exit status."""
    from vstatics.readers import sweep_tables

    status = run(
        plan,
        form,
        output,
        jobs=jobs,
        scheduler=sampling.scheduler,
        raw=wanted.style.raw,
        resume=sampling.resume,
        quiet=telling.quiet,
    )
    if status:
        return status
    read = sweep_tables.read(*files.read_input(output))
    return {name: np.array(numbers) for name, numbers in read.columns.items()}


def _collected(
    plan: SweepPlan, jobs: int, scheduler: str | None, telling: Telling
) -> Mapping[str, Floats] | int:
    """The columns of the variants in memory; or an exit status."""
    from vstatics.cli.frame.progress import progress
    from vstatics.sweep.chunk import joined

    task = SweepTask(plan, "csv")
    count = plan.variants.count
    called = task.workers(jobs, scheduler)
    chunks = []
    try:
        with called, progress(count, "runs", quiet=telling.quiet) as advance:
            for _, chunk in called.each(calculate, range(plan.pieces), ordered=True):
                chunks.append(chunk)
                advance(len(chunk.variants))
    except StoppedError as stopped:
        files.say(f"stopped after {sum(len(one.variants) for one in chunks)} of {count} runs")
        return stopped_by(stopped.signal)
    made = joined(chunks)
    reasons = [f"{number} {status}" for status, number in made.counts.items() if status != "ok"]
    if reasons:
        files.say(f"{count} runs, of which {' and '.join(reasons)}")
    if not made.counts.get("ok"):
        files.say("no run has a result")
        tell_reason(plan)
        return FAILED
    tables = np.concatenate([made.values, made.columns], axis=1)
    return dict(zip((*plan.names, *plan.headings), tables.T, strict=True))
