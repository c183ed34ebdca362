"""`vstatics run`: calculate cases and write the results."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

import click

from vstatics import readers
from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import Outcome, calculate
from vstatics.model import IdleConvention
from vstatics.results import Language

OutputFormat = Literal["listing", "json", "csv"]


def as_text(outcomes: Sequence[Outcome], output_format: OutputFormat, lang: Language) -> str:
    """Results in the format asked for; each writer is imported when it is needed.

    A single case that failed gives nothing; among several it has an entry in JSON.
    """
    results = [outcome.results for outcome in outcomes if outcome.results is not None]
    several = len(outcomes) > 1
    if not results and not (several and output_format == "json"):
        return ""
    if output_format == "json":
        from vstatics.writers import result_json

        documents = [
            result_json.failure(outcome.file, outcome.problems)
            if outcome.results is None
            else result_json.document(outcome.results)
            for outcome in outcomes
        ]
        return result_json.write(documents, several=several)
    if output_format == "csv":
        from vstatics.writers import result_csv

        named = [(o.file, o.results) for o in outcomes if o.results is not None]
        return result_csv.write(named, several=several)
    from vstatics.writers import listing

    reports = [(o.file, listing.write(o.results, lang)) for o in outcomes if o.results is not None]
    return "\n".join(f"==> {file} <==\n{text}" if several else text for file, text in reports)


@click.command()
@arguments.argument
@click.option(
    "-f",
    "--format",
    "output_format",
    type=click.Choice(get_args(OutputFormat)),
    default="listing",
    show_default=True,
    help="Format of the results.",
)
@click.option("-o", "--output", type=click.Path(), help="Write to this file, whole or not at all.")
@arguments.input_format
@click.option(
    "--lang",
    type=click.Choice(get_args(Language)),
    default="en",
    show_default=True,
    help="Language of the headings of a listing.",
)
@click.option(
    "--coast/--drive",
    default=None,
    help="Power enters at the output (engine braking), or at the input; else as the case says.",
)
@click.option(
    "--idle",
    type=click.Choice(get_args(IdleConvention)),
    help="Sign of idle mechanisms; else as the case says.",
)
@click.pass_context
def run(
    context: click.Context,
    cases: tuple[str, ...],
    output_format: OutputFormat,
    output: str | None,
    input_format: readers.Format | None,
    lang: Language,
    coast: bool | None,
    idle: IdleConvention | None,
) -> None:
    """Calculate every gear of each CASE: a deck, YAML or JSON; - is standard input.

    \b
    Examples:
      vstatics run gearbox.dat
      vstatics run gearbox.yaml -f json | jq .ratio
      vstatics run *.dat -f csv -o all.csv
      cat gearbox.dat | vstatics run - --coast

    \b
    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    Neutral, indeterminate and friction-locked gears are messages, not errors.
    """
    outcomes = list(calculate(cases, input_format, coast, idle))
    failed = any(outcome.failed for outcome in outcomes)
    text = as_text(outcomes, output_format, lang)
    if text:
        files.write_output(text, output)
    context.exit(1 if failed else 0)
