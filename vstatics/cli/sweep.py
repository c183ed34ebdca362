"""`vstatics sweep`: variants of a case, to a table."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import cast, get_args

import click

from vstatics import readers
from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.sweep_run import estimate, in_good_order, run
from vstatics.errors import CaseError, ReadError
from vstatics.jobs.files import is_stream
from vstatics.model.transmission import IdleConvention, Transmission
from vstatics.sweep import build
from vstatics.sweep.file import METHODS, Settings, Text, read_sweep_file
from vstatics.sweep.formats import SUFFIXES, TEXTS, Format, format_of_name


@click.command()
@click.argument("case", required=False, type=click.Path(), metavar="[CASE]")
@click.option("--file", "sweep_file", type=click.Path(), help="Read the sweep from this YAML file.")
@click.option("--vary", multiple=True, metavar="NAME=VALUES", help="Vary a number; repeatable.")
@click.option("--zip", "together", is_flag=True, default=None, help="Values in pairs, not a grid.")
@click.option("--sample", type=click.IntRange(1), metavar="N", help="N points between low:high.")
@click.option("--method", type=click.Choice(METHODS), help="How they are picked.  [default: sobol]")
@click.option("--seed", type=click.IntRange(0), metavar="S", help="Of --sample.  [default: 0]")
@click.option("--variants", type=click.Path(), metavar="FILE", help="A CSV table of variants.")
@click.option("--out", metavar="LIST", help="The columns.  [default: ratio,efficiency]")
@click.option("--where", metavar="EXPR", help="Keep variants for which this is true.")
@click.option("--min", "least", multiple=True, metavar="EXPR", help="Keep those with the least.")
@click.option("--max", "most", multiple=True, metavar="EXPR", help="Keep those with the most.")
@click.option("--best", type=click.IntRange(1), metavar="N", help="So many.  [default: 20]")
@click.option("-o", "--output", type=click.Path(), help="Write to this file, whole or not at all.")
@click.option(
    "-f",
    "--format",
    "output_format",
    type=click.Choice(get_args(Format)),
    help="Format of the output; else told by the suffix, CSV on stdout.",
)
@click.option(
    "-j", "--jobs", type=click.IntRange(1), default=1, show_default=True, help="Processes."
)
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler, such as tcp://HOST:8786.")
@click.option("--resume", is_flag=True, help="Go on with a sweep that was stopped.")
@click.option("--dry-run", is_flag=True, help="Only say how many, how large, how long.")
@arguments.input_format
@arguments.coast
@arguments.idle
@click.pass_context
def sweep(
    context: click.Context,
    case: str | None,
    sweep_file: str | None,
    vary: tuple[str, ...],
    together: bool | None,
    sample: int | None,
    method: str | None,
    seed: int | None,
    variants: str | None,
    out: str | None,
    where: str | None,
    least: tuple[str, ...],
    most: tuple[str, ...],
    best: int | None,
    output: str | None,
    output_format: Format | None,
    jobs: int,
    scheduler: str | None,
    resume: bool,
    dry_run: bool,
    input_format: readers.Format | None,
    coast: bool | None,
    idle: IdleConvention | None,
) -> None:
    """Calculate variants of CASE and write a table: a row each, or the best ones.

    VALUES are low:high:count, low:high:step=STEP, a list a,b,c, or low:high with
    --sample. EXPR and LIST speak of tables by name: efficiency[1], speeds[C1,1],
    max(abs(torques)), D1.ratio.

    \b
    Examples:
      vstatics sweep box.yaml --vary D1.ratio=-0.9:-0.7:201 -o out.csv
      vstatics sweep box.yaml --vary D1.ratio=-3:-2 --vary D2.ratio=-4:-2
                --sample 100000 --max 'min(efficiency)' --best 10
      vstatics sweep box.yaml --vary D3.efficiency=.95,.97 --out losses[D3]
                --where 'efficiency[1] > .95 and max(speeds) < 3'
      vstatics sweep --file sweep.yaml --jobs 8 --resume

    \b
    Formats by suffix: .csv .jsonl .ndjson .npz .parquet. While it runs, finished
    pieces lie in OUTPUT.parts; --resume takes them up after an interruption.
    Exit status: 0 done; 1 not finished, or no variant has a solution;
    2 wrong use; 130 or 143 stopped by Ctrl-C or SIGTERM.
    """
    given = Settings(
        case=case,
        vary=tuple(map(Text, vary)),
        zip=together,
        sample=sample,
        method=method,
        seed=seed,
        variants=variants,
        out=None if out is None else Text(out),
        where=None if where is None else Text(where),
        min=tuple(map(Text, least)),
        max=tuple(map(Text, most)),
        best=best,
        output=output,
        format=output_format,
        coast=coast,
        idle=idle,
    )
    if sweep_file is not None:
        given = given.over(read_sweep_file(*files.read_input(sweep_file)))
    form = _checked(given, resume=resume, jobs=jobs, scheduler=scheduler)
    files.spare(filter(None, [given.case, given.variants, sweep_file]), given.output)

    def carry_out() -> int:
        build.check_packages(given, form, scheduler)
        plan = build.plan(_case(given.case or "", input_format), given)
        if dry_run:
            files.write_output(estimate(plan, form, jobs), None)
            return 0
        return run(plan, form, given.output, jobs=jobs, scheduler=scheduler, resume=resume)

    with _told():
        status = in_good_order(carry_out)
    context.exit(status)


def _checked(given: Settings, *, resume: bool, jobs: int, scheduler: str | None) -> Format:
    """The format of the output; wrong combinations of options are wrong use."""
    to_stream = is_stream(given.output)
    best = given.min or given.max
    wrong = {
        "Missing argument 'CASE' (or `case` in --file).": given.case is None,
        "Nothing is varied: expected --vary, or --variants.": not (given.vary or given.variants),
        "--variants is a table of all variants: it excludes --vary, --zip and --sample.": (
            given.variants and (given.vary or given.zip or given.sample)
        ),
        "--zip and --sample exclude one another.": given.zip and given.sample,
        "--method and --seed belong to --sample.": (
            not given.sample and (given.method or given.seed is not None)
        ),
        "--best needs --min or --max: the best by what?": given.best is not None and not best,
        "--resume needs a file to go on with: -o FILE.": resume and to_stream,
        "--jobs and --scheduler exclude one another.": scheduler and jobs > 1,
    }
    for message, is_wrong in wrong.items():
        if is_wrong:
            raise click.UsageError(message)
    form = cast("Format | None", given.format) or format_of_name(given.output or "")
    if to_stream and (form or "csv") not in TEXTS:
        raise click.UsageError(f"{form} can't go to a stream, expected a file: -o FILE")
    if form is None and not to_stream:
        raise click.UsageError(
            f"can't tell the format of {given.output}: expected a suffix of "
            f"{' '.join(SUFFIXES)}, or --format"
        )
    return form or "csv"


def _case(file: str, input_format: readers.Format | None) -> Transmission:
    reading = readers.read(*files.read_input(file), input_format)
    files.show(arguments.serious(reading.warnings))
    return reading.case


@contextmanager
def _told() -> Iterator[None]:
    """What ends a sweep is told like what ends a reading."""
    try:
        yield
    except ReadError:
        raise
    except CaseError as error:
        raise ReadError(error.problems) from error
