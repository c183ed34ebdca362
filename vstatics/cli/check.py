"""`vstatics check`: problems of the input, degrees of freedom, conditions per gear."""

from __future__ import annotations

import click

from vstatics import readers
from vstatics.cli import files
from vstatics.cli.run import calculate, located
from vstatics.diagnosis import conditions
from vstatics.errors import ReadError
from vstatics.results import Results


def summary(file: str, results: Results) -> str:
    """What the case is, and how many conditions each gear has for its speeds."""
    case = results.case
    counts = [
        conditions(case, gear, int(missing), int(excess))
        for gear, missing, excess in zip(case.gears, results.missing, results.excess, strict=True)
    ]
    lines = [
        f"{file}: {case.links} links, {len(case.shift_elements)} shift elements, "
        f"{len(case.mechanisms)} mechanisms, {len(case.gears)} gears; "
        f"{counts[0].freedom} degrees of freedom"
    ]
    names = [element.name for element in case.shift_elements]
    width = max(len(gear.name) for gear in case.gears)
    for gear, count, tied_up in zip(case.gears, counts, results.tied_up, strict=True):
        engaged = " ".join(names[number - 1] for number in gear.engaged) or "nothing"
        verdict = [f"{count.missing} missing"] * (count.missing > 0)
        verdict += [f"{count.excess} in excess"] * (count.excess > 0)
        verdict += ["tied up"] * bool(tied_up)
        lines.append(
            f"  gear {gear.name:{width}}  {count.given} of {count.freedom} conditions: "
            f"{', '.join(verdict) or 'ok'} (engaged: {engaged})"
        )
    return "\n".join(lines) + "\n"


@click.command()
@click.argument("cases", nargs=-1, required=True, type=click.Path(), metavar="CASE...")
@click.option(
    "--from",
    "input_format",
    type=click.Choice(list(readers.READERS)),
    help="Format of the input; else told by the suffix, then by the content.",
)
@click.pass_context
def check(
    context: click.Context, cases: tuple[str, ...], input_format: readers.Format | None
) -> None:
    """Report all problems and warnings of each CASE, and its conditions per gear.

    Problems go to stderr as file:line:col: message, with the line and a caret;
    the count of conditions goes to stdout. There are no tables.

    \b
    Example:
      vstatics check gearbox.yaml

    Exit status: 0 no errors; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    if cases.count(files.STDIN) > 1:
        raise click.UsageError("standard input (-) can be read once")
    failed = False
    for file in cases:
        try:
            reading, results = calculate(file, input_format, None, None)
        except ReadError as error:
            files.show(error.problems)
            failed = True
            continue
        files.show([*reading.warnings, *located(reading, results)])
        name = files.STDIN_NAME if file == files.STDIN else file
        files.write_output(summary(name, results), None)
        failed |= results.failed
    context.exit(1 if failed else 0)
