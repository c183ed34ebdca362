"""`vstatics torsion modes`: natural frequencies and shapes in every gear."""

from __future__ import annotations

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import formats
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import OutputOptions
from vstatics.cli.frame.one_case import one_text, problems_of, show, tell
from vstatics.cli.frame.problems import Telling
from vstatics.cli.torsion.case import gear_names, located, needs_scipy


@click.command()
@click.argument("case", type=click.Path())
@arguments.some_gears
@click.option(
    "--modes",
    "count",
    type=click.IntRange(1),
    metavar="N",
    help="The first N modes that are not rigid; all when not given, of a case with more than 50 "
    "links the first 20.",
)
@formats.options(*formats.TABLES)
@arguments.input_format
@arguments.coast
@arguments.telling
def modes(
    case: str,
    gears: tuple[str, ...],
    count: int | None,
    wanted: OutputOptions,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Calculate natural frequencies and shapes of CASE in every gear; - is standard input.

    CASE has `inertias` of links [kg*m^2] and `springs`, mechanisms or shift elements with
    a `stiffness` [N*m/rad]; everything else is rigid. For each mode: the frequency without
    damping and with it, amplitudes of links (the largest is 1), torques of all devices at
    these, shares of the energy, the number of nodes. Given speeds, losses and drag take no
    part; freewheels hold as in `vstatics run`.

    \b
    Examples:
      vstatics torsion modes cases/moskvich412.yaml
      vstatics torsion modes box.yaml --gear 1 --modes 3
      vstatics torsion modes box.yaml -f json | jq '.gears[].modes[].omega'

    \b
    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    to = one_text(wanted, [case])
    needs_scipy()
    from vstatics.torsion.documents import modes_document
    from vstatics.torsion.vibration.gear_modes import modes as modes_of
    from vstatics.torsion.vibration.grids import modes_grids

    reading = arguments.read_one(case, input_format, telling)
    with problems_of(reading):
        found = modes_of(reading.case, gear_names(reading.case, gears), count=count, coast=coast)
    faults = [(one.name, "error", one.error) for one in found if one.error]
    doubts = [(one.name, "warning", text) for one in found for text in one.warnings]
    problems = list(located(reading, [*faults, *doubts]))
    tell(problems, telling, case)
    name = reading.case.name
    show(case, to, name, lambda: modes_grids(found), lambda: modes_document(name, found))
    return FAILED if faults or telling.fails([*reading.warnings, *problems]) else DONE
