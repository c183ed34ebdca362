"""`vstatics summary`: the design table of a case, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, get_args

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CalculatedCase, CaseOptions, calculate
from vstatics.errors import CaseError, Place, ReadError
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.summary import Summary
    from vstatics.summary.duty_file import DutyFile

SummaryFormat = Literal["text", "json", "markdown", "latex"]


class _Asked(NamedTuple):
    """What is wanted besides the tables that are always there."""

    at_most: int | None
    """Of further combinations."""
    duty: DutyFile | None


@click.command()
@click.argument("case", type=click.Path())
@click.argument("case2", type=click.Path(), required=False)
@click.option(
    "-f",
    "--format",
    "output_format",
    type=click.Choice(get_args(SummaryFormat)),
    default="text",
    show_default=True,
    help="Format of the tables.",
)
@arguments.output
@click.option(
    "--combinations", is_flag=True, help="Also try all other combinations of shift elements."
)
@click.option(
    "--at-most",
    type=click.IntRange(min=1),
    default=10_000,
    show_default=True,
    metavar="N",
    help="Try no more combinations than these.",
)
@click.option(
    "--duty",
    type=click.Path(),
    metavar="FILE",
    help="Mean efficiency of a duty cycle: YAML with `energy` or `time`, and a share by gear.",
)
@arguments.settings
@click.pass_context
def summary(
    context: click.Context,
    case: str,
    case2: str | None,
    output_format: SummaryFormat,
    output: str | None,
    combinations: bool,
    at_most: int,
    duty: str | None,
    settings: CaseOptions,
) -> None:
    """Ratios, steps, spread, transitions and largest values of CASE; - is standard input.

    Steps and transitions go from a gear to the next one of the same direction. The largest
    values are those over all gears. Sensitivities tell by how many per cent a ratio changes
    when the internal ratio of a mechanism changes by one. With CASE2 the two stand side by
    side, as A and B.

    \b
    Examples:
      vstatics summary gearbox.yaml
      vstatics summary gearbox.yaml other.yaml
      vstatics summary gearbox.yaml --combinations -f markdown > gearbox.md
      vstatics summary gearbox.yaml --duty duty.yaml
      vstatics summary gearbox.yaml -f json | jq .spread

    Markdown and LaTeX have the tables of the text; JSON has all digits.

    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    named = [case] if case2 is None else [case, case2]
    arguments.check_streams([*named, duty or ""])
    files.spare([*named, *filter(None, [duty])], output)
    cycle = None
    if duty is not None:
        from vstatics.summary.duty_file import read_duty

        cycle = read_duty(*files.read_input(duty))
    outcomes = list(calculate(named, settings))
    if all(outcome.results is not None for outcome in outcomes):
        asked = _Asked(at_most if combinations else None, cycle)
        files.write_output(_text(outcomes, output_format, asked), output)
    context.exit(1 if any(outcome.failed for outcome in outcomes) else 0)


def _text(outcomes: Sequence[CalculatedCase], output_format: SummaryFormat, asked: _Asked) -> str:
    """The summary of one case, or of two beside one another."""
    made = [
        _summarized(outcome.results, outcome.file, asked)
        for outcome in outcomes
        if outcome.results is not None
    ]
    if output_format == "json":
        from vstatics.summary.document import write

        return write(made)
    from vstatics.summary import contrast, grids
    from vstatics.tables import latex, markdown
    from vstatics.tables import text as plain

    writer = {"text": plain, "markdown": markdown, "latex": latex}[output_format]
    names = [outcome.results.case.name for outcome in outcomes if outcome.results is not None]
    if len(made) == 1:
        titles, tables = [names[0] or outcomes[0].file], grids.grids(made[0])
    else:
        titles = [
            f"{letter}: {outcome.file}{f' ({name})' if name else ''}"
            for letter, outcome, name in zip("AB", outcomes, names, strict=True)
        ]
        tables = contrast.contrasted(*made)
    text: str = writer.write(titles, tables)
    return text


def _summarized(results: Results, file: str, asked: _Asked) -> Summary:
    """The summary of a case; too many combinations are a problem of its file."""
    from vstatics.summary import summarize

    try:
        made = summarize(results, at_most=asked.at_most)
    except CaseError as error:
        place = Place(file, 0, 0)
        found = [
            problem._replace(place=place, message=f"{problem.message}; see --at-most")
            for problem in error.problems
        ]
        raise ReadError(found) from None
    return made if asked.duty is None else made._replace(cycle=asked.duty.of(results))
