"""`vstatics convert`: conversion of a case from one format to another."""

from __future__ import annotations

import click

from vstatics.core import readers
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.options import OUTPUT, command, under
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import ReadError
from vstatics.core.writers.saving import case_data


@command
@click.argument("source", type=FILE, metavar="IN")
@click.argument("target", type=FILE, metavar="OUT")
@arguments.input_format
@arguments.telling
@under(
    OUTPUT,
    click.option(
        "--to",
        "output_format",
        type=click.Choice([*readers.FORMATS, "matrices"]),
        help="Format of OUT.  [default: by the suffix]",
    ),
)
def convert_command(
    source: str,
    target: str,
    input_format: readers.Format | None,
    output_format: str | None,
    telling: Telling,
) -> int:
    """Convert a case from the file IN to the file OUT; `-` is standard input or output.

    The formats are deck (.dat), YAML, JSON, XLSX and matrices. An existing file OUT is
    replaced. Numbers and names are kept exactly.

    \b
      deck      has mechanisms instead of gear sets, and freewheels are engaged
                in the gears in which they hold. A case with springs, inertias or
                stiffnesses cannot be written as a deck. Torques and speeds in
                rpm and N*m become relative to the input.
      xlsx      has a sheet for each kind of part.
      matrices  are Evseenko's tables 1 and 2 in CSV, with a row for each link.
                Table 1 has a column for the sun (a), carrier (h) and ring (b)
                of each planetary gear set, with 1 at its link, or -1 if the
                link is the input. Table 2 has a column for each shift element,
                with -1 at the first link and 1 at the second. The program
                cannot read these tables.

    Everything that the format cannot keep is listed, and the exit status is 1.

    \b
    Examples:
      vstatics new planetary.yaml --template planetary
      vstatics convert planetary.yaml planetary.json
      vstatics convert gearbox.yaml gearbox.xlsx
      vstatics convert gearbox.xlsx - --to yaml
      vstatics convert gearbox.yaml - --to matrices
    """
    files.spare([source], target)
    wanted = output_format or readers.format_of_name(target)
    if wanted is None:
        raise click.UsageError(
            f"cannot determine the format of {target}: expected a suffix such as .dat, "
            f".yaml, .json, .xlsx, or --to{formats.hint_of_pictures(target)}"
        )
    reading = arguments.read_data(*files.read_input(source), input_format, telling)
    if left_out := [problem for problem in reading.warnings if problem.id == "W807"]:
        raise ReadError(problem._replace(id="E014") for problem in left_out)
    with files.problems_of_file(source):
        data, lost = case_data(reading.case, wanted)
    files.write_data(data, target)
    for loss in lost:
        files.say(f"{target}: not kept: {loss}")
    return FAILED if lost or telling.fails(reading.warnings) else DONE
