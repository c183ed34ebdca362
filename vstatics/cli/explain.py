"""`vstatics explain`: a gear's matrix, its equations and their solution, its ratio as a formula."""

from __future__ import annotations

from typing import Literal

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate_to
from vstatics.cli.exit_status import DONE, FAILED


@click.command()
@arguments.case_argument
@click.option(
    "--gear",
    "gears",
    multiple=True,
    metavar="G",
    help="This gear only, by its name or number; may be given several times.",
)
@arguments.text_or_json
@arguments.output
@arguments.settings
def explain(
    case: str,
    gears: tuple[str, ...],
    output_format: Literal["text", "json"],
    output: str | None,
    settings: CaseOptions,
) -> int:
    """Explain the gears of CASE: a deck, YAML or JSON; - is standard input.

    For each gear: the structural-distribution matrix of what is engaged, the speed
    and the torque equations in symbols and numbers with their solution, the signs of
    the power flow and why, links that turn together, and the ratio as a formula.

    \b
    Examples:
      vstatics explain gearbox.dat --gear 1
      vstatics explain gearbox.yaml | less
      vstatics explain gearbox.yaml -f json | jq -r '.gears[].formula.text'

    The formula needs SymPy: pip install "vstatics[formula]".

    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    outcome = calculate_to(output, case, settings)
    results = outcome.results
    if results is not None:
        from vstatics.explain import document, text
        from vstatics.explain import explain as explained

        case_of_gears = results.case
        numbers = [arguments.gear_number(case_of_gears, gear) for gear in gears]
        indices = [number - 1 for number in numbers] or range(len(case_of_gears.gears))
        explanations = [explained(results, index) for index in indices]
        as_text = output_format == "text"
        files.write_output(
            text.write(explanations) if as_text else document.write(case_of_gears, explanations),
            output,
        )
    return FAILED if outcome.failed else DONE
