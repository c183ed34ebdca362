"""`vstatics explain`: a gear's matrix, its equations and their solution, its ratio as a formula."""

from __future__ import annotations

from typing import Literal

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate
from vstatics.model.transmission import Transmission


def _chosen(case: Transmission, gears: tuple[str, ...]) -> list[int]:
    """Indices of the gears that are asked for, all of them if none is named."""
    return [arguments.gear_number(case, gear) - 1 for gear in gears] or list(range(len(case.gears)))


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
@click.pass_context
def explain(
    context: click.Context,
    case: str,
    gears: tuple[str, ...],
    output_format: Literal["text", "json"],
    output: str | None,
    settings: CaseOptions,
) -> None:
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
    files.spare([case], output)
    [outcome] = calculate([case], settings)
    results = outcome.results
    if results is not None:
        from vstatics.explain import document, text
        from vstatics.explain import explain as explained

        made = [explained(results, number) for number in _chosen(results.case, gears)]
        written = (
            text.write(made) if output_format == "text" else document.write(results.case, made)
        )
        files.write_output(written, output)
    context.exit(1 if outcome.failed else 0)
