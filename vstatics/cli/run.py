"""`vstatics run`: calculate cases and write the results."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import click

from vstatics import readers, statics
from vstatics.cli import files
from vstatics.errors import Problem, ReadError
from vstatics.readers.reading import Reading
from vstatics.results import Results

OutputFormat = Literal["listing", "json", "csv"]


def calculate(
    file: str, format_: readers.Format | None, coast: bool | None, idle: Any
) -> tuple[Reading, Results]:
    """Read a case and calculate it, with the conventions of the command line.

    Raises
    ------
    ReadError
        If the file cannot be read as a case.
    """
    reading = readers.read(*files.read_input(file), format_)
    case = reading.case
    case = replace(
        case,
        coast=case.coast if coast is None else coast,
        idle=idle or case.idle,
    )
    return reading, statics.solve(case)


def located(reading: Reading, results: Results) -> list[Problem]:
    """The messages of a result as problems with the place of their gear."""
    numbers = {gear.name: number for number, gear in enumerate(results.case.gears, 1)}
    found = []
    for message in results.messages:
        if message.gear:
            place = reading.locate(Problem("", ("gears", numbers[message.gear]))).place
            text = f"gear {message.gear}: {message.text}"
            found.append(Problem(text, place=place, severity=message.severity))
    return found


def write(
    results: list[Results],
    documents: list[dict[str, Any]],
    output_format: OutputFormat,
    lang: Literal["en", "ru"],
    *,
    several: bool,
) -> str:
    """Results as text in the format asked for; each writer is imported when it is needed."""
    if output_format == "json":
        from vstatics.writers import result_json

        return result_json.write(documents, several=several)
    if output_format == "csv":
        from vstatics.writers import result_csv

        return result_csv.write(results, several=several)
    from vstatics.writers import listing

    return "\n".join(listing.write(result, lang) for result in results)


@click.command()
@click.argument("cases", nargs=-1, required=True, type=click.Path(), metavar="CASE...")
@click.option(
    "-f",
    "--format",
    "output_format",
    type=click.Choice(["listing", "json", "csv"]),
    default="listing",
    show_default=True,
    help="Format of the results.",
)
@click.option("-o", "--output", type=click.Path(), help="Write to this file, whole or not at all.")
@click.option(
    "--from",
    "input_format",
    type=click.Choice(list(readers.READERS)),
    help="Format of the input; else told by the suffix, then by the content.",
)
@click.option(
    "--lang",
    type=click.Choice(["en", "ru"]),
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
    type=click.Choice(["published", "exact"]),
    help="Sign of idle mechanisms; else as the case says.",
)
@click.pass_context
def run(
    context: click.Context,
    cases: tuple[str, ...],
    output_format: OutputFormat,
    output: str | None,
    input_format: readers.Format | None,
    lang: Literal["en", "ru"],
    coast: bool | None,
    idle: str | None,
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
    if cases.count(files.STDIN) > 1:
        raise click.UsageError("standard input (-) can be read once")
    failed = False
    results: list[Results] = []
    documents: list[dict[str, Any]] = []
    for file in cases:
        try:
            reading, result = calculate(file, input_format, coast, idle)
        except ReadError as error:
            files.show(error.problems)
            documents.append({"case": file, "errors": [str(p) for p in error.problems]})
            failed = True
            continue
        files.show([*reading.warnings, *located(reading, result)])
        failed |= result.failed
        results.append(result)
        if output_format == "json":
            from vstatics.writers import result_json

            documents.append(result_json.document(result))
    several = len(cases) > 1
    if results or (several and output_format == "json"):
        try:
            text = write(results, documents, output_format, lang, several=several)
            files.write_output(text, output)
        except ReadError as error:
            files.show(error.problems)
            failed = True
    context.exit(1 if failed else 0)
