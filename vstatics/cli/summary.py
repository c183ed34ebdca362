"""`vstatics summary`: the design table of a case, and what follows from it."""

from __future__ import annotations

from typing import Literal, get_args

import click

from vstatics import readers
from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import Settings, calculate
from vstatics.model import IdleConvention
from vstatics.results import Results

SummaryFormat = Literal["text", "json"]


@click.command()
@click.argument("case", type=click.Path())
@click.option(
    "-f",
    "--format",
    "output_format",
    type=click.Choice(get_args(SummaryFormat)),
    default="text",
    show_default=True,
    help="Format of the tables.",
)
@click.option("-o", "--output", type=click.Path(), help="Write to this file, whole or not at all.")
@arguments.input_format
@arguments.coast
@arguments.idle
@click.pass_context
def summary(
    context: click.Context,
    case: str,
    output_format: SummaryFormat,
    output: str | None,
    input_format: readers.Format | None,
    coast: bool | None,
    idle: IdleConvention | None,
) -> None:
    """Ratios, steps, spread, transitions and largest values of CASE; - is standard input.

    Steps and transitions go from a gear to the next one of the same direction. The largest
    values are those over all gears. Sensitivities tell by how many per cent a ratio changes
    when the internal ratio of a mechanism changes by one.

    \b
    Examples:
      vstatics summary gearbox.yaml
      vstatics summary gearbox.yaml -f json | jq .spread

    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    [outcome] = calculate([case], Settings(input_format, coast, idle))
    if outcome.results is not None:
        files.write_output(_text(outcome.results, outcome.file, output_format), output)
    context.exit(1 if outcome.failed else 0)


def _text(results: Results, file: str, output_format: SummaryFormat) -> str:
    from vstatics.insight.summary import summarize

    made = summarize(results)
    if output_format == "json":
        from vstatics.insight.summary.document import document, write

        return write([document(made)])
    from vstatics.insight.summary import plain
    from vstatics.insight.summary.grids import grids

    return plain.write(made.results.case.name or file, grids(made))
