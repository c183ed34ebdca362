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
from vstatics.core.cli.shared.options import Command, gathered, refuse
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.sharing import Sharing, shared
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.jobs.files import is_stream
from vstatics.core.tables.suffixes import format_of, known, mismatch
from vstatics.sweep import build
from vstatics.sweep.cli.estimate import estimate, most_rows
from vstatics.sweep.cli.run import SweepRun, carry_out
from vstatics.sweep.cli.subject import check_options, limited, read_subject, spare
from vstatics.sweep.file import read_sweep_file
from vstatics.sweep.formats import FORMATS, MOST_ROWS, TEXTS, Format
from vstatics.sweep.options import OPTIONS, Option, SweepOptions, conflicts, says


def declared(command: Command) -> Command:
    """Add the options that sweep files and `vstatics.sweep()` have, too."""
    for name, option in reversed(list(OPTIONS.items())):
        if option.help:
            command = _click_option(name, option)(command)
    return command


def _click_option(name: str, option: Option) -> Callable[[Command], Command]:
    kinds: dict[str, dict[str, Any]] = {
        "path": {"type": click.Path()},
        "count": {"type": click.IntRange(option.least)},
        "flag": {"is_flag": True, "default": None},
        "choice": {"type": click.Choice(option.choices)},
        "text": {"multiple": True, "callback": _once},
        "list": {"multiple": True, "callback": _once},
        "texts": {"multiple": True},
        "vary": {"multiple": True},
    }
    names = filter(None, [option.short, f"--{name}"])
    more = kinds.get(option.kind, {})
    return click.option(*names, metavar=option.metavar, help=option.help, **more)


def _once(_context: click.Context, option: click.Parameter, given: tuple[str, ...]) -> str | None:
    """Return the text of an option, and refuse an option given twice."""
    if len(given) > 1:
        join = "with `and`" if option.name == "where" else "with commas"
        raise click.BadParameter(f"it is given {len(given)} times; expected one, {join}")
    return given[0] if given else None


class Effort(NamedTuple):
    """Options of the execution: estimate only, time limit of a run, failure without rows."""

    fail_empty: bool
    dry_run: bool
    limit: float | None


effort = gathered(
    "effort",
    Effort,
    click.option("--fail-empty", is_flag=True, help="No row makes the exit status 3."),
    click.option("--dry-run", is_flag=True, help="Only say how many, how large, how long."),
    arguments.limit,
)


@click.command()
@click.argument("case", required=False, type=click.Path(), metavar="[CASE]")
@click.option("--file", "sweep_file", type=click.Path(), help="Read the sweep from this YAML file.")
@declared
@shared(
    "a sweep that was stopped",
    formats.raw,
    jobs=click.option(
        "-j", "--jobs", type=click.IntRange(1), default=1, show_default=True, help="Processes."
    ),
)
@effort
@arguments.input_format
@arguments.coast
@arguments.idle
@arguments.telling
def sweep(
    sweep_file: str | None,
    sharing: Sharing,
    raw: bool,
    effort: Effort,
    input_format: readers.Format | None,
    telling: Telling,
    **said: Any,
) -> int:
    """Calculate variants of CASE and write a table: a row each, or the best ones.

    CASE may be a scenario of `vstatics simulate`: then each variant is a run.

    VALUES are low:high:count, low:high:step=STEP, a list a,b,c, or low:high with
    --sample. NAME is D1.ratio or .efficiency; of what is elastic shaft.stiffness,
    .compliance or .damping; engine.inertia; by its path load.speed, drag.out,
    gears.low.torques.x, with a unit on each value, '-50 N*m,50 N*m'; P1.teeth.sun,
    C1.capacity, mesh_efficiency.friction. EXPR and LIST speak of tables by name:
    efficiency[1], speeds[C1,1], max(abs(torques)), D1.ratio; omega[2,1] is the
    second natural frequency in gear 1. Of a scenario NAME is any number of it or of
    its case by its path, shifts.1.overlap, and EXPR speaks of the run: heat[F2],
    locks[F2], max(abs(slips[F2])), peaks[shaft], speeds[out], work.

    \b
    Examples:
      vstatics sweep box.yaml --vary D1.ratio=-0.9:-0.7:201 -o out.csv
      vstatics sweep box.yaml --vary D1.ratio=-3:-2 --vary D2.ratio=-4:-2
                --sample 100000 --max 'min(efficiency)' --best 10
      vstatics sweep box.yaml --vary D3.efficiency=.95,.97 --out losses[D3]
                --where 'efficiency[1] > .95 and max(speeds) < 3'
      vstatics sweep box.yaml --vary 'load.torque=-50 N*m:50 N*m:5' --by gear
      vstatics sweep box.yaml --vary shaft.stiffness=1e3:1e4:91 --out omega[1]
      vstatics sweep shift.yaml --vary shifts.1.overlap=.1:.6:26
                --out 'heat[F2],max(abs(slips[F2]))'
      vstatics sweep --file sweep.yaml --jobs 8 --resume

    \b
    Formats by suffix: .csv .jsonl .ndjson .npz .parquet, for few rows .md .tex
    .xlsx. While it runs, finished pieces lie in OUTPUT.parts; --resume takes
    them up after an interruption.
    Exit status: 0 done; 1 not finished, or no variant has a solution, with
    --strict also if there is a warning on the case or a run;
    2 wrong use; 3 no row, with --fail-empty; 130 or 143 stopped by Ctrl-C or
    SIGTERM.
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
        raise click.UsageError("--raw is for CSV.")
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
    except CaseError as error:  # printed like the problems of a file
        raise ReadError(error.problems) from error


def _unquoted(name: str, given: Any) -> tuple[str, Any]:
    """Remove quotes around a whole option, which some shells leave.

    >>> _unquoted("vary", ("'P1.ratio=-2,-3'", "'a b'.ratio=-2")), _unquoted("best", 5)
    (('vary', ('P1.ratio=-2,-3', "'a b'.ratio=-2")), ('best', 5))
    """
    if isinstance(given, tuple):
        return name, tuple(_unquoted(name, text)[1] for text in given)
    is_whole = isinstance(given, str) and given[:1] == given[-1:] == "'" and given.count("'") == 2
    return name, given[1:-1] if is_whole else given


def _checked(options: SweepOptions, spelled: Callable[[str], str], sharing: Sharing) -> Format:
    """Return the format of the output, and refuse wrong combinations of options."""
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
            f"{form} can't go to a stream, expected a file: -o FILE",
        ),
        (
            form is None and not to_stream,
            f"can't tell the format of {options.output}: expected a suffix of "
            f"{' '.join(known(FORMATS))}, or --format",
        ),
    )
    return form or "csv"
