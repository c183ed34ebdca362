"""`vstatics flow`: where the power goes in every gear, what is lost and what circulates."""

from __future__ import annotations

from typing import Literal

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate_to
from vstatics.cli.exit_status import DONE, FAILED


@click.command()
@arguments.case_argument
@arguments.one_gear
@arguments.text_or_json
@arguments.output
@arguments.settings
def flow(
    case: str,
    gear: str | None,
    output_format: Literal["text", "json"],
    output: str | None,
    settings: CaseOptions,
) -> int:
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
    outcome = calculate_to(output, case, settings)
    if outcome.results is None:
        return FAILED
    from vstatics.flow.power import flows

    case_of_gears, powers = outcome.results.case, flows(outcome.results)
    if gear is not None:
        powers = [powers[arguments.gear_number(case_of_gears, gear) - 1]]
    if output_format == "text":
        from vstatics.flow.text import text

        written = "\n".join(map(text, powers))
    else:
        from vstatics.flow.document import write

        written = write(case_of_gears.name, powers)
    files.write_output(written, output)
    return FAILED if outcome.failed else DONE
