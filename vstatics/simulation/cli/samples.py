"""Command `vstatics simulate --samples`: many runs with random numbers, and their statistics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias, cast

import click
import numpy as np

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED, stopped_by
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.one_case import CaseAnswer, show
from vstatics.core.errors import CaseError, Problem, ReadError, count_of
from vstatics.core.jobs.files import is_stream
from vstatics.core.jobs.stopping import StoppedError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.file_suffixes import format_of, known
from vstatics.simulation.cli.documents import read_swept_document
from vstatics.simulation.cli.options import SimulateOptions
from vstatics.simulation.cli.scenario_run import expect_damage
from vstatics.simulation.variants.samples import sample_plan
from vstatics.simulation.variants.statistics import (
    columns_statistics,
    samples_answer,
    statistics_grids,
)
from vstatics.sweep import build
from vstatics.sweep.cli.run import SweepRun, carry_out, tell_noticed, tell_reason
from vstatics.sweep.cli.subject import spare
from vstatics.sweep.formats import Format
from vstatics.sweep.options import SweepOptions
from vstatics.sweep.tasks import calculate

ROWS = ("csv", "jsonl", "npz", "parquet")
"""Output formats that can be read again to calculate the statistics."""


def run_samples(asked: SimulateOptions) -> int:
    """Run the samples, write the results if an output is given, and show statistics.

    Raises
    ------
    ReadError
        If the scenario has no samples, or if they cannot be run.
    UsageError
    """
    sampling, wanted, telling = asked.sampling, asked.wanted, asked.telling
    sampling.sharing.check(wanted.output)
    form: Format | None = None
    if wanted.output is not None and not is_stream(wanted.output):
        written = wanted.form or format_of(wanted.output, ROWS)
        if written not in ROWS:
            raise click.UsageError(
                f"{wanted.output}: --samples writes {' '.join(known(ROWS))}, expected a suffix"
            )
        form = cast("Format", written)
    scenario = files.read_input(asked.scenario)
    subject, problems = read_swept_document(*scenario, telling, asked.case, asked.input_format)
    varied = replace(subject, rtol=asked.rtol, limit=asked.limit)
    spare(varied, wanted.output)
    out = sampling.out
    if asked.damage:
        expect_damage(varied.own.reading)
        out = out and f"{out},damage"  # the default columns already contain the damage
    options = SweepOptions.of(sample=sampling.samples, seed=sampling.seed, out=out)
    try:
        build.check_packages(SweepOptions(), form or "csv", sampling.sharing.scheduler)
        plan = sample_plan(varied, options)
        run = SweepRun(
            plan,
            form or "csv",
            wanted.output,
            sampling.sharing,
            wanted.style.raw,
            telling,
        )
        columns, messages = _written(run) if form else _collected(run)
    except CaseError as error:
        raise ReadError(error.problems) from error
    if isinstance(columns, int):
        return columns
    answer = samples_answer(plan.names, columns_statistics(columns))
    to = Destination("text", None, wanted.style) if form else wanted.destination([])
    shown = CaseAnswer(lambda: statistics_grids(answer), answer)
    show(varied.file, to, varied.own.name or varied.own.scenario.case.name, shown)
    return FAILED if telling.fails([*problems, *messages]) else DONE


Collected: TypeAlias = tuple[Mapping[str, Floats] | int, Sequence[Problem]]
"""Results of all runs by column, or the exit status of a failure; then the messages of runs."""


def _written(run: SweepRun) -> Collected:
    """Write the results of all runs to a file, and return the columns of the file."""
    from vstatics.core.readers import sweep_tables

    status, messages = carry_out(run)
    if status:
        return status, messages
    output = Path(str(run.output))  # the file needs no size limit, because this command wrote it
    read = sweep_tables.read(output.read_bytes(), str(output))
    return {name: np.array(numbers) for name, numbers in read.columns.items()}, messages


def _collected(run: SweepRun) -> Collected:
    from vstatics.core.cli.shared.progress import progress
    from vstatics.sweep.chunk import joined

    plan = run.plan
    count = plan.variants.count
    workers = run.task.workers(run.sharing.processes, run.sharing.scheduler)
    chunks = []
    try:
        with workers, progress(count, "runs", quiet=run.quiet) as advance:
            for _, chunk in workers.each(calculate, range(plan.pieces), ordered=True):
                chunks.append(chunk)
                advance(len(chunk.variants))
    except StoppedError as stopped:
        files.say(f"stopped after {sum(len(chunk.variants) for chunk in chunks)} of {count} runs")
        return stopped_by(stopped.signal), ()
    results = joined(chunks)
    reasons = [f"{number} {status}" for status, number in results.counts.items() if status != "ok"]
    if reasons:
        files.say(f"{count_of('run', count)}, of which {' and '.join(reasons)}")
    messages = tell_noticed(run, results.noticed)
    if not results.counts.get("ok"):
        files.say("no run has a result")
        tell_reason(plan)
        return FAILED, messages
    tables = np.concatenate([results.values, results.columns], axis=1)
    return dict(zip((*plan.names, *plan.headings), tables.T, strict=True)), messages
