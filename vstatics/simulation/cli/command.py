"""Command `vstatics simulate`: simulation of a case over time under a scenario."""

from __future__ import annotations

import signal
from collections.abc import Iterable
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.exit_status import DONE, FAILED, stopped_by
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.one_case import one_text, tell
from vstatics.core.cli.shared.options import command, needs, refuse
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import higher
from vstatics.core.tables.file_suffixes import known
from vstatics.simulation.cli.options import SimulateOptions, options
from vstatics.simulation.cli.scenario_run import expect_damage, run_columns, run_problems
from vstatics.simulation.cli.watched import watched

if TYPE_CHECKING:
    from vstatics.core.tables.grid import Grid
    from vstatics.simulation.record.motion import Motion
    from vstatics.simulation.scenario.file import ScenarioFile

MOST_INSTANTS = 1_000_000
"""Largest number of instants that `--time-step` adds."""
WITH_COLUMNS = ("csv", "json", "jsonl", "npz", "parquet")
"""Output formats that contain columns over time."""


@command
@options
def simulate_command(asked: SimulateOptions) -> int:
    """Simulate a shift, a launch or another SCENARIO over time; `-` is standard input.

    SCENARIO is a YAML file with a case, a duration and an initial state. Shifts, or
    capacities of shift elements and external torques over time, determine the run. CASE
    replaces the case of the scenario. Text output lists the events, energies and largest
    torques. A CSV, JSON, NPZ or Parquet file has the speeds, slips and torques over time.
    --out adds columns to the file:

    \b
      accelerations, jerks, powers       of links
      powers                             of springs
      heat, slip_power, temperatures     of shift elements
      states                             of the scenario
      vehicle_speed, vehicle_acceleration, vehicle_jerk
                                         of a link with a road

    A simulation that stops early prints the time and the reason, and writes the results so
    far. With --samples, text output lists means, standard deviations and quantiles of
    torques and energies, and a file has a row for each run.

    \b
    Examples:
      vstatics new driveline-8hp70.yaml --template driveline-8hp70
      vstatics new scenarios/upshift.yaml --template scenarios/8hp70-upshift
      vstatics simulate scenarios/upshift.yaml
      vstatics simulate scenarios/upshift.yaml -o upshift.csv --time-step 0.01
      vstatics simulate scenarios/upshift.yaml -o upshift.json \\
          --out 'accelerations[vehicle], heat[C]'
      vstatics simulate scenarios/upshift.yaml -f json | jq .energy
      vstatics new moskvich-start.yaml --template moskvich-start
      vstatics new scenarios/starts.yaml --template scenarios/moskvich-samples
      vstatics simulate scenarios/starts.yaml --samples 10 --seed 1 -o starts.csv

    \b
    Exit status 1: the scenario or its case has an error, or the simulation
    stopped early, for example by --limit.
    """
    scenario, case, telling = asked.scenario, asked.case, asked.telling
    inputs = [scenario, *([case] if case else [])]
    arguments.check_streams(inputs)
    asked.sampling.check(**{"time-step": asked.step is not None}, method=asked.method != "events")
    _check_method(asked)
    to = one_text(asked.wanted, inputs)
    needs("simulation", "vstatics simulate")
    if asked.sampling.samples is not None:
        from vstatics.simulation.cli.samples import run_samples

        return run_samples(asked)
    _check_format(asked, to.form)
    if to.form == "parquet":
        needs("parquet", "Parquet")
    read = _read(asked, to.output)
    if asked.damage:
        expect_damage(read.reading)
    step, duration = asked.step, read.scenario.duration
    _check_step(step, duration)
    from vstatics.simulation.run import simulate as simulated

    try:
        with watched(scenario, duration, asked.limit, quiet=telling.quiet) as watch:
            motion = simulated(
                read.scenario,
                step=step,
                rtol=asked.rtol,
                method=asked.method,
                watch=watch,
                columns=run_columns(asked.sampling.out, read.scenario),
            )
    except CaseError as error:
        raise ReadError(map(read.locate, error.problems)) from None
    messages = [*run_problems(read, motion)]
    problems = [*read.reading.warnings, *messages]
    notes = [problem for problem in messages if problem.severity == "note"]
    tell(problems, telling, scenario)
    tell(notes, telling._replace(notes=True), scenario)
    show(scenario, to, read, motion, damage=asked.damage)
    if watch.interrupted and motion.stopped is not None:
        return stopped_by(signal.SIGINT)
    failed = motion.stopped is not None or telling.fails(problems)
    return FAILED if failed else DONE


def _read(asked: SimulateOptions, output: str | None) -> ScenarioFile:
    from vstatics.simulation.cli.documents import read_with_case  # slow import, not for --help

    text = files.read_input(asked.scenario)
    try:
        read = read_with_case(*text, asked.input_format, asked.case, output)
    except ReadError as error:
        raise ReadError(asked.telling.printed(error.problems)) from None
    return read.allowing(asked.telling.allow)


def _check_method(asked: SimulateOptions) -> None:
    events = {"--limit": asked.limit, "--out": asked.sampling.out, "--damage": asked.damage or None}
    used = [option for option, given in events.items() if given is not None]
    refuse(
        *((asked.method != "events", f"{option} is for the method `events`.") for option in used)
    )


def _check_format(asked: SimulateOptions, form: str) -> None:
    refuse(
        (
            asked.sampling.out is not None and form not in WITH_COLUMNS,
            f"--out asks for columns over time: expected -o with {' '.join(known(WITH_COLUMNS))}.",
        ),
        (
            asked.damage and form in ("csv", "npz", "parquet"),
            "--damage is for text and JSON: expected -o with .txt or .json.",
        ),
    )


def _check_step(step: float | None, duration: float) -> None:
    if step is not None and duration / step > MOST_INSTANTS:
        raise click.BadParameter(
            f"read {step:g} s of {duration:g} s, expected at least {duration / MOST_INSTANTS:g}",
            param_hint="--time-step",
        )


def show(
    scenario: str, to: Destination, read: ScenarioFile, motion: Motion, *, damage: bool
) -> None:
    """Write a motion in the format of the destination."""
    from vstatics.core.tables.straight import in_both_units
    from vstatics.simulation.record.answer import lay_out, motion_answer
    from vstatics.simulation.record.columns import as_csv, as_npz, as_parquet
    from vstatics.simulation.record.tables import motion_grids

    title = read.name or read.scenario.case.name or file_name(scenario)
    targets = bool(read.scenario.targets)

    def grids() -> Iterable[Grid]:
        of_damage = [higher("damage_grid")(motion.damage)] if damage else []
        return in_both_units(read.scenario.case, [*motion_grids(motion), *of_damage])

    shown = texts.CaseOutput(
        [title],
        {
            "csv": lambda _: as_csv(motion, raw=to.style.raw),
            "npz": lambda _: as_npz(motion),
            "parquet": lambda _: as_parquet(motion),
        },
        grids,
        lambda: motion_answer(motion, read.scenario.case.name, targets=targets, damage=damage),
        lay_out,
    )
    files.write_pages(texts.alone(file_name(scenario), shown, to), to.output)
