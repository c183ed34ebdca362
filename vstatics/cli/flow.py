"""`vstatics flow`: where the power goes in every gear, what is lost and what circulates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate
from vstatics.model.transmission import Transmission

if TYPE_CHECKING:
    from vstatics.flow.power import GearFlow


@click.command()
@arguments.case_argument
@arguments.one_gear
@arguments.text_or_json
@arguments.output
@arguments.settings
@click.pass_context
def flow(
    context: click.Context,
    case: str,
    gear: str | None,
    output_format: Literal["text", "json"],
    output: str | None,
    settings: CaseOptions,
) -> None:
    """Show where the power goes in every gear of CASE; - is standard input.

    For each gear: the power through links, mechanisms and engaged shift elements,
    without and with losses, relative to the power at the input link, and in kW if the
    case has a load; losses and their shares; the balance; power that circulates, and
    the loop that carries it. Power of a member is above 0 where it enters the mechanism.

    \b
    Examples:
      vstatics flow gearbox.yaml --gear R
      vstatics flow gearbox.dat -f json | jq '.gears[].lossy.circulating'

    \b
    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    files.spare([case], output)
    [outcome] = calculate([case], settings)
    if outcome.results is None:
        context.exit(1)
    from vstatics.flow.power import flows

    found = flows(outcome.results)
    if gear is not None:
        found = [found[arguments.gear_number(outcome.results.case, gear) - 1]]
    files.write_output(_text(outcome.results.case, found, output_format), output)
    context.exit(1 if outcome.failed else 0)


def _text(case: Transmission, found: list[GearFlow], output_format: str) -> str:
    if output_format == "text":
        from vstatics.flow.text import text

        return "\n".join(map(text, found))
    from vstatics.flow.document import write

    return write(case.name, found)
