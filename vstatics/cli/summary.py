"""`vstatics summary`: the design table of a case, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, get_args

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CalculatedCase, CaseOptions, calculate
from vstatics.cli.exit_status import DONE, FAILED
from vstatics.errors import CaseError, ReadError, of_file
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.summary import Summary
    from vstatics.summary.duty_file import DutyFile

SummaryFormat = Literal["text", "json", "markdown", "latex"]


@click.command()
@click.argument("case", type=click.Path())
@click.argument("case2", type=click.Path(), required=False)
@arguments.format_option(get_args(SummaryFormat), "Format of the tables.", default="text")
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
def summary(
    case: str,
    case2: str | None,
    output_format: SummaryFormat,
    output: str | None,
    combinations: bool,
    at_most: int,
    duty: str | None,
    settings: CaseOptions,
) -> int:
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
    calculated = [(one.results, one.file) for one in outcomes if one.results is not None]
    if len(calculated) == len(outcomes):
        most = at_most if combinations else None
        summaries = [_summarized(*results, most, cycle) for results in calculated]
        files.write_output(_text(outcomes, summaries, output_format), output)
    return FAILED if any(outcome.failed for outcome in outcomes) else DONE


def _text(
    outcomes: Sequence[CalculatedCase], summaries: list[Summary], output_format: SummaryFormat
) -> str:
    """The summary of one case, or of two beside one another."""
    if output_format == "json":
        from vstatics.summary.document import write

        return write(summaries)
    from vstatics.summary import contrast, grids
    from vstatics.tables import latex, markdown
    from vstatics.tables import text as plain

    writer = {"text": plain, "markdown": markdown, "latex": latex}[output_format]
    names = [outcome.results.case.name for outcome in outcomes if outcome.results is not None]
    if len(summaries) == 1:
        titles, tables = [names[0] or outcomes[0].file], grids.grids(summaries[0])
    else:
        titles = [
            f"{letter}: {outcome.file}{f' ({name})' if name else ''}"
            for letter, outcome, name in zip("AB", outcomes, names, strict=True)
        ]
        tables = contrast.contrasted(*summaries)
    text: str = writer.write(titles, tables)
    return text


def _summarized(results: Results, file: str, at_most: int | None, duty: DutyFile | None) -> Summary:
    """The summary of a case; too many combinations are a problem of its file."""
    from vstatics.summary import summarize

    try:
        summary = summarize(results, at_most=at_most)
    except CaseError as error:
        raise ReadError(
            of_file(file, f"{problem.message}; see --at-most") for problem in error.problems
        ) from None
    return summary if duty is None else summary._replace(cycle=duty.of(results))
