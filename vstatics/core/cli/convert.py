"""`vstatics convert`: conversion of a case from one format to another."""

from __future__ import annotations

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.writers.saving import case_data


@click.command()
@click.argument("source", type=click.Path(), metavar="IN")
@click.argument("target", type=click.Path(), metavar="OUT")
@arguments.input_format
@arguments.telling
@click.option(
    "--to",
    "output_format",
    type=click.Choice([*readers.READERS, "matrices"]),
    help="Format of OUT; else told by the suffix.",
)
def convert(
    source: str,
    target: str,
    input_format: readers.Format | None,
    output_format: str | None,
    telling: Telling,
) -> int:
    """Convert the case IN to OUT: deck (.dat), YAML, JSON or XLSX; - is a stream.

    OUT is written over if it is there, so that a conversion can be repeated.
    Numbers and names are kept to the last digit; torques and speeds with a unit are
    written relative to the load. A workbook (XLSX) has a sheet for the parts of each kind.
    A deck has mechanisms in place of elements, and
    freewheels are engaged where they hold. What the format cannot keep is listed, and
    the exit status is 1. A deck of a case with springs, inertias or stiffnesses is not
    written at all. Matrices are written only: two tables in CSV that show the structure of
    planetary gear sets and nothing else, links by members of the sets and links by shift
    elements.

    \b
    Examples:
      vstatics convert gearbox.dat gearbox.yaml
      vstatics convert gearbox.yaml - --to deck
      vstatics convert gearbox.yaml gearbox.xlsx
      vstatics convert gearbox.yaml - --to matrices
    """
    files.spare([source], target)
    wanted = output_format or readers.format_of_name(target)
    if wanted is None:
        raise click.UsageError(
            f"cannot determine the format of {target}: expected a suffix such as .dat, .yaml, .json, "
            ".xlsx, or --to"
        )
    reading = arguments.read_data(*files.read_input(source), input_format, telling)
    if left_out := [problem for problem in reading.warnings if problem.id == "W807"]:
        raise ReadError(problem._replace(id="E014") for problem in left_out)
    try:
        data, lost = case_data(reading.case, wanted)
    except CaseError as error:
        raise ReadError(problem.in_file(source) for problem in error.problems) from error
    files.write_data(data, target)
    for loss in lost:
        files.say(f"{target}: not kept: {loss}")
    return FAILED if lost or telling.fails(reading.warnings) else DONE
