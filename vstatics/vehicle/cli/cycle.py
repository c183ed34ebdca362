"""Command `vstatics cycle`: drive a case with a vehicle through a driving cycle."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from functools import partial
from itertools import repeat
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import OUTPUT, RenamedOption, command, gathered, under
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import FILE, value
from vstatics.core.errors import CaseError, Problem, of_file
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.statics.results import Results
from vstatics.core.tables import csv
from vstatics.core.tables.file_suffixes import mismatch
from vstatics.core.tables.grid import Grid, grid_of, word
from vstatics.vehicle.case.vehicle import Vehicle

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission
    from vstatics.vehicle.operation.drive_cycle import CycleAnswer, DriveCycle
    from vstatics.vehicle.operation.fuel_map import FuelMap
    from vstatics.vehicle.operation.gear_choice import GearChoice
    from vstatics.vehicle.operation.shifting import ShiftSpeed
    from vstatics.vehicle.operation.trace import Trace


_PARTS = {"battery_lost": "lost: battery", "machine_lost": "lost: machine"}
"""Names of energies in the printed table, by a different name in JSON."""


def _engine_speed(text: str) -> float:
    from vstatics.core.readers.named.units import quantity

    try:
        speed = quantity(text, "speed") * math.pi / 30
    except ValueError as error:
        raise ValueError(f"read {text!r}, {error}") from None
    if speed < 0:
        raise ValueError(f"read {text!r}, expected a speed of 0 or more")
    return speed


def _shifts(text: str) -> list[ShiftSpeed]:
    from vstatics.vehicle.operation.shifting import read_shifts

    return read_shifts(text)


def _choice(
    least_speed: float | None, shifts: list[ShiftSpeed] | None, strategy: str | None
) -> GearChoice:
    from vstatics.vehicle.operation.gear_choice import GearChoice

    if shifts is not None and (strategy is not None or least_speed is not None):
        other = "--least-speed" if strategy is None else "--strategy"
        raise click.UsageError(f"{other} and --shift exclude one another")
    return GearChoice(least_speed, shifts or (), least_loss=strategy is not None)


@command
@click.argument("case", type=FILE)
@click.argument("trace", type=FILE)
@formats.options(*formats.TABLES)
@gathered(
    "choice",
    _choice,
    click.option(
        "--least-speed",
        callback=value(_engine_speed),
        metavar="SPEED",
        help="Engage the highest gear in which the engine has at least this speed, such as "
        "'1200 rpm'. If no such gear exists, engage the lowest gear that does not overspeed the "
        "engine.",
    ),
    click.option(
        "--shift",
        "shifts",
        callback=value(_shifts),
        metavar="TEXT",
        help="Vehicle speeds of upshifts and downshifts, such as '1-2: 15 km/h/12 km/h, "
        "2-3: 30 km/h/25 km/h'.",
    ),
    click.option(
        "--strategy",
        type=click.Choice(["least-loss"]),
        help="Engage in each time step the gear in which engine or battery supplies the least "
        "energy, or absorbs the most when braking, within full load. If a gear allows it, the "
        "engine turns at --least-speed or faster (default: its first full-load point).",
    ),
)
@under(
    OUTPUT,
    click.option(
        "--time-steps",
        "steps",
        cls=RenamedOption,
        former=["--steps"],
        type=FILE,
        metavar="FILE",
        help="CSV file for the values of each time step; `plot --kind curves` draws it.",
    ),
)
@gathered("settings", CaseOptions, arguments.input_format, arguments.idle, arguments.telling)
def cycle_command(
    case: str,
    trace: str,
    wanted: OutputOptions,
    steps: str | None,
    choice: GearChoice,
    settings: CaseOptions,
) -> int:
    """Drive the vehicle of CASE through a driving cycle: energies, losses and fuel.

    TRACE is a table with the columns `time [s]` and `speed [km/h]`, and optionally `gear`, and
    `slope` (sine of the angle) or `grade` (rise divided by horizontal distance). Published
    files of driving cycles can be used without changes. In a time step, between two rows, the
    speed is the mean of the rows, the acceleration is constant, and gear and slope are taken
    from the first row. If the column `gear` is missing, give --least-speed, --shift or
    --strategy.

    The engine supplies the power of wheels, inertias, losses and drag torques. If it cannot
    brake enough (`overrun`), the brakes absorb the rest. A warning lists the time steps in
    which the engine would exceed its full load or its largest speed. The engine must drive
    alone: a gear with a balance, given torques or given speeds other than 0 is an error. Fuel
    needs a map in the vehicle: `fuel: {file: fuel.csv}`. A vehicle with a `machine` instead of
    an `engine` is electric: the results are the energy of the battery, the consumption and the
    recuperation.

    \b
    Examples:
      echo 'vehicle: {mass: 1900 kg, radius: 0.33, final_drive: 3.15,
        rolling: 0.012, drag_area: 0.7,
        engine: [[100, 250], [300, 400], [600, 350]]}' >> gearbox.yaml
      printf 'time [s],speed [km/h]\\n0,0\\n20,50\\n30,50\\n40,0\\n' > trace.csv
      vstatics cycle gearbox.yaml trace.csv --least-speed '1200 rpm'
      vstatics cycle gearbox.yaml trace.csv --shift '1-2: 25 km/h/20 km/h'
      vstatics cycle gearbox.yaml trace.csv --least-speed '1200 rpm' \\
          -f json | jq .cycle.energy
      vstatics cycle gearbox.yaml trace.csv --least-speed '1200 rpm' \\
          --time-steps steps.csv
      vstatics plot steps.csv --kind curves -o cycle.svg

    Exit status 1: the case or the trace has an error, or a gear has no torques.
    """
    to = wanted.destination([case, trace])
    files.spare([case, trace], steps)
    if steps is not None and steps == (to.output or STDOUT):
        where = "standard output" if steps == STDOUT else steps
        message = f"--time-steps and the report both go to {where}"
        raise click.UsageError(f"{message}; expected another file, as in `-o report.txt`")
    if steps and not is_stream(steps) and (message := mismatch("csv", steps)):
        raise click.UsageError(f"--time-steps: {message}")
    arguments.check_streams([case, trace])
    arguments.check_order(case, trace)
    from vstatics.vehicle.operation.trace import read_trace

    read = read_trace(*files.read_input(trace, TABLE_BYTES))
    show = partial(_shown, trace=read, choice=choice, steps=steps)
    return carry_out(
        Job("cycle", settings.at_nominal_load, to, show),
        (case,),
        others=[trace],
    )


def _shown(
    outcome: CalculatedCase, results: Results, trace: Trace, choice: GearChoice, steps: str | None
) -> texts.CaseOutput:
    driven = _driven(outcome, results, trace, choice)
    if steps:
        with files.stream(steps) as write:
            for part in _as_sweep(driven):
                write(part.encode())

    def tables() -> Iterator[Grid]:
        energy = driven.energy
        parts = (
            *("battery", "battery_lost", "auxiliary", "machine_lost", "machine", "engine"),
            *("wheels", "inertias", "brakes"),
        )
        known = ((name, getattr(energy, name)) for name in parts)
        rows = [(word(_PARTS.get(name, name)), part) for name, part in known if part is not None]
        rows += [(word(f"lost: {name}"), loss) for name, loss in energy.lost.items() if loss]
        yield grid_of("Energy over the cycle", ["", "energy, J"], rows, key="energy")
        row = [driven.duration, driven.distance, driven.fuel]
        headings = ["duration, s", "distance, m", "fuel, g"]
        if driven.battery is not None and driven.consumption is not None:
            row[2:] = [driven.consumption, driven.battery.out, driven.battery.returned]
            headings[2:] = ["kWh/100 km", "from battery, J", "to battery, J"]
        yield grid_of("Cycle", headings, [row], key="cycle")

    def answer() -> CycleAnswer:
        from vstatics.vehicle.operation.drive_cycle import CycleAnswer

        return CycleAnswer(results.case.name, driven)

    titles = [results.case.name or outcome.file]
    places = {note.id: note.place for note in trace.notes}
    problems = [
        of_file(message.id, outcome.file, message.text)
        if message.id not in places
        else Problem(message.id, message.text, (), places[message.id])
        for message in driven.messages
    ]
    return texts.CaseOutput(titles, {}, tables, answer, problems=problems)


def _as_sweep(driven: DriveCycle) -> Iterator[str]:
    from vstatics.vehicle.operation.trace import blocks

    time, *others = driven.steps
    first = others.index("duration [s]") + 1
    yield csv.lines([["variant", time, "status", *others[:first], "gear", *others[first:]]])
    gears = list(map(csv.guarded, driven.gears))
    for block in blocks(len(driven.gears)):
        # + 0.0 avoids -0.0
        times, *numbers = ((driven.steps[name][block] + 0.0).tolist() for name in (time, *others))
        columns = [range(block.start, block.stop), times, repeat("ok"), *numbers[:first]]
        columns += [gears[block], *numbers[first:]]
        yield csv.lines((map(str, row) for row in zip(*columns, strict=False)), raw=True)


def read_fuel(case: Transmission, file: str) -> FuelMap | None:
    """Return the fuel map that a case in a file names; None without a fuel map.

    Raises
    ------
    ReadError
        If the fuel map cannot be read, or has errors.
    """
    vehicle = Vehicle.of(case)
    if vehicle is None or not vehicle.fuel:
        return None
    from vstatics.vehicle.operation.fuel_map import read_fuel_map

    path = os.path.join(os.path.dirname(file), vehicle.fuel)  # noqa: PTH118, PTH120
    return read_fuel_map(*files.read_input(path, regular=True))


def _driven(
    outcome: CalculatedCase, results: Results, trace: Trace, choice: GearChoice
) -> DriveCycle:
    from vstatics.vehicle.operation.drive_cycle import drive

    try:
        return drive(results.case, trace, choice, read_fuel(results.case, outcome.file))
    except CaseError as error:
        problems = [_placed(problem, trace, outcome.file) for problem in error.problems]
        raise outcome.located(CaseError(problems)) from None


def _placed(problem: Problem, trace: Trace, file: str) -> Problem:
    """Return a problem at its row in the driving cycle, or with a file name if it has no row."""
    row = next(iter(problem.path), None)
    if isinstance(row, int):
        return problem._replace(path=(), place=trace.table.place(row))
    return problem if problem.path or problem.place else problem.in_file(file)
