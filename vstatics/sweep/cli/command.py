"""`vstatics sweep`: variants of a case, written as a table."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, cast

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import FormatChoice, hint_of_pictures
from vstatics.core.cli.shared.options import (
    INPUT,
    PROCESSING,
    Command,
    command,
    gathered,
    refuse,
    under,
)
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, shared
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.jobs.files import is_stream
from vstatics.core.tables.file_suffixes import format_of, known, mismatch
from vstatics.sweep import build
from vstatics.sweep.cli.estimate import estimate, most_rows
from vstatics.sweep.cli.run import SweepRun, carry_out
from vstatics.sweep.cli.subject import check_options, limited, read_subject, spare
from vstatics.sweep.file import read_sweep_file
from vstatics.sweep.formats import FORMATS, MOST_ROWS, TEXTS, Format
from vstatics.sweep.options import OPTIONS, Option, SweepOptions, conflicts, says


def declared(command: Command) -> Command:
    """Add the options of a sweep that sweep files and `vstatics.sweep()` also have."""
    for name, option in reversed(list(OPTIONS.items())):
        if option.help:
            command = _click_option(name, option)(command)
    return command


def _click_option(name: str, option: Option) -> Callable[[Command], Command]:
    kinds: dict[str, dict[str, Any]] = {
        "path": {"type": FILE},
        "count": {"type": click.IntRange(option.least)},
        "flag": {"is_flag": True, "default": None},
        "choice": {"type": FormatChoice(option.choices)},
        "text": {"multiple": True, "callback": _once},
        "list": {"multiple": True, "callback": _once},
        "texts": {"multiple": True},
        "vary": {"multiple": True},
    }
    names = filter(None, [option.short, f"--{option.key or name}", name])
    more = kinds[option.kind]
    declaration = click.option(*names, metavar=option.metavar, help=option.help, **more)
    return under(option.heading, declaration)


def _once(_context: click.Context, option: click.Parameter, given: tuple[str, ...]) -> str | None:
    if len(given) > 1:
        join = "with `and`" if option.name == "where" else "with commas"
        raise click.BadParameter(f"it is given {len(given)} times; expected one, {join}")
    return given[0] if given else None


class Effort(NamedTuple):
    """Options of the execution: failure without rows, estimate only, time limit of a run."""

    fail_empty: bool
    dry_run: bool
    limit: float | None


effort = gathered(
    "effort",
    Effort,
    under(
        PROCESSING,
        click.option(
            "--fail-empty", is_flag=True, help="Exit with status 3 if the table has no rows."
        ),
        click.option(
            "--dry-run",
            is_flag=True,
            help="Print only the number of variants, the size of the table and the estimated time.",
        ),
    ),
    arguments.limit,
)


@command
@click.argument("case", required=False, type=FILE, metavar="[CASE]")
@under(
    INPUT,
    click.option(
        "--file", "sweep_file", type=FILE, help="YAML file with the options of the sweep."
    ),
)
@declared
@shared(
    "a sweep that was stopped",
    formats.raw,
    jobs=click.option(
        "-j",
        "--jobs",
        type=click.IntRange(1),
        default=1,
        show_default=True,
        metavar="N",
        help="Number of worker processes.",
    ),
)
@effort
@arguments.input_format
@arguments.coast
@arguments.idle
@arguments.telling
def sweep_command(
    sweep_file: str | None,
    sharing: Sharing,
    raw: bool,
    effort: Effort,
    input_format: readers.Format | None,
    telling: Telling,
    **said: Any,
) -> int:
    """Calculate variants of CASE and write a table with a row for each variant.

    CASE can be a scenario of `vstatics simulate`. Each variant is then a simulation.

    \b
    NAME    is the path of a number in the case: P1.teeth.sun, P1.ratio,
            P1.efficiency, load.speed, load.torque, gears.low.torques.x,
            drag.out, shaft.stiffness, engine.inertia, C1.capacity,
            mesh_efficiency.friction; in a scenario also shifts.1.overlap
    VALUES  are LOW:HIGH:COUNT, LOW:HIGH:step=STEP, a list A,B,C, or LOW:HIGH
            with --sample; each value can have a unit, as in '-50 N*m:50 N*m:5'
    FORMULA calculates a number from varied, earlier linked and other numbers of
            the case: --with 'P1.teeth.planet=(P1.teeth.ring - P1.teeth.sun)/2'
    EXPR    and LIST use tables by name: efficiency[1], speeds[C1,1], P1.ratio,
            max(abs(torques)); omega[2,1] is the second natural frequency in
            gear 1. For a scenario: heat[F2], locks[F2], max(abs(slips[F2])),
            peaks[shaft], speeds[out], work

    \b
    Examples:
      vstatics sweep gearbox.yaml --vary P1.efficiency=0.95:0.99:5 -o losses.csv
      vstatics sweep gearbox.yaml --vary P4.teeth.sun=21:25:3 --by gear
      vstatics sweep gearbox.yaml --vary P3.efficiency=0.95,0.97 \\
          --out 'losses[P3]' --where 'efficiency[1] > 0.9 and max(speeds) < 9'
      vstatics sweep gearbox.yaml --vary P1.efficiency=0.95:0.99 \\
          --vary P2.efficiency=0.95:0.99 --sample 100 \\
          --max 'min(efficiency)' --best 10
      vstatics new car.yaml --template moskvich412
      vstatics sweep car.yaml --vary load.torque='50 N*m:150 N*m:3' --by gear
      vstatics sweep car.yaml --vary propshaft.stiffness=2e4:4e4:5 \\
          --out 'omega[1]'
      vstatics new moskvich-start.yaml --template moskvich-start
      vstatics new scenarios/start.yaml --template scenarios/moskvich-start
      vstatics sweep scenarios/start.yaml --vary start.speeds.engine=200:260:3 \\
          --out 'heat[clutch],peaks[tyres]'

    The suffix of -o gives the format: .csv .jsonl .ndjson .npz .parquet, and for tables
    with few rows .md .tex .xlsx. During the run, finished pieces are kept in OUTPUT.parts.
    --resume continues from them.

    \b
    Exit status 1: the sweep is not finished, no variant has a solution in all
    requested gears, or with --strict there is a warning on the case or a run.
    """
    of_command = SweepOptions.of(**dict(map(_unquoted, said, said.values())))
    of_file = SweepOptions()
    if sweep_file is not None:
        of_file = read_sweep_file(*files.read_input(sweep_file))
    options = of_command.over(of_file)

    def spelled(name: str) -> str:
        in_file = says(getattr(of_file, name)) and not says(getattr(of_command, name))
        return f"`{name}`" if in_file else f"--{name}"

    form = _checked(options, spelled, sharing)
    if raw and form != "csv":
        raise click.UsageError("--raw applies to CSV only.")
    files.spare(filter(None, [options.case, options.variants, sweep_file]), options.output)

    try:
        build.check_packages(options, form, sharing.scheduler)
        subject, problems = read_subject(options, input_format, telling)
        spare(subject, options.output)
        check_options(subject, coast=options.coast, idle=options.idle)
        subject = limited(subject, effort.limit)
        plan = build.plan(subject, options)
        if most_rows(plan) > MOST_ROWS.get(form, math.inf):
            message = f"{form} is for {MOST_ROWS[form]} rows at most, not for {most_rows(plan)}"
            raise click.UsageError(f"{message}: expected another format, or --best")
        if effort.dry_run:
            files.write_output(estimate(plan, form, sharing.processes), None)
            status = DONE
        else:
            fails = effort.fail_empty
            run = SweepRun(plan, form, options.output, sharing, raw, telling, fails)
            status, messages = carry_out(run)
            problems = [*problems, *messages]
        return status or (FAILED if telling.fails(problems) else DONE)
    except CaseError as error:  # printed in the same way as problems of a file
        raise ReadError(error.problems) from error


def _unquoted(name: str, given: Any) -> tuple[str, Any]:
    """Remove quotes around a whole option value, which some shells leave.

    >>> _unquoted("vary", ("'P1.ratio=-2,-3'", "'a b'.ratio=-2")), _unquoted("best", 5)
    (('vary', ('P1.ratio=-2,-3', "'a b'.ratio=-2")), ('best', 5))
    """
    if isinstance(given, tuple):
        return name, tuple(_unquoted(name, text)[1] for text in given)
    is_whole = isinstance(given, str) and given[:1] == given[-1:] == "'" and given.count("'") == 2
    return name, given[1:-1] if is_whole else given


def _checked(options: SweepOptions, spelled: Callable[[str], str], sharing: Sharing) -> Format:
    """Return the format of the output file, and refuse contradictory options."""
    to_stream = is_stream(options.output)
    against = [
        (True, message if message.endswith("?") else f"{message}.")
        for message in conflicts(vars(options), spelled)
    ]
    refuse(
        (options.case is None, "Missing argument 'CASE' (or `case` in --file)."),
        (
            not (options.vary or options.variants),
            "Nothing is varied: expected --vary, --variants, or a sweep file by --file.",
        ),
        *against,
    )
    sharing.check(options.output)
    form_of_suffix = format_of(options.output or "", FORMATS)
    form = cast("Format | None", options.format) or form_of_suffix
    message = "" if to_stream else mismatch(form, str(options.output))
    as_text = form in TEXTS and format_of(str(options.output), ["text"])
    refuse(
        (message and not as_text, f"{spelled('format')} {message}"),
        (
            to_stream and (form or "csv") not in TEXTS,
            f"{form} cannot be written to a stream, expected a file: -o FILE",
        ),
        (
            form is None and not to_stream,
            f"cannot determine the format of {options.output}: expected a suffix of "
            f"{' '.join(known(FORMATS))}, or --format{hint_of_pictures(str(options.output))}",
        ),
    )
    return form or "csv"
