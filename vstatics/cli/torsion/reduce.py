"""`vstatics torsion reduce`: inertias and compliances on one link."""

from __future__ import annotations

import click

from vstatics import readers
from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import formats
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.formats import OutputOptions
from vstatics.cli.frame.one_case import one_text, show, tell
from vstatics.cli.frame.problems import Telling
from vstatics.cli.torsion.case import coasting, gear_names, link_name, located, needs_scipy


@click.command()
@click.argument("case", type=click.Path())
@click.option("--to", required=True, metavar="LINK", help="The link, by its name or number.")
@arguments.some_gears
@formats.options(*formats.TABLES)
@arguments.input_format
@arguments.coast
@arguments.telling
def reduce(
    case: str,
    to: str,
    gears: tuple[str, ...],
    wanted: OutputOptions,
    input_format: readers.Format | None,
    coast: bool | None,
    telling: Telling,
) -> int:
    """Reduce inertias and compliances of CASE to one link, in every gear; - is standard input.

    By the speeds of the rigid motion: J (w_link/w_to)^2 and E (w_to/w_link)^2. A link that
    stands, such as a casing on its mounting, is scaled by the reaction that it takes,
    J/(1 - i)^2 and E (1 - i)^2; where the ratio is 1 there is none. Rigidly joined links
    are one entry under the first.

    \b
    Examples:
      vstatics torsion reduce box.yaml --to engine
      vstatics torsion reduce box.yaml --to propshaft --gear 1 -f json

    \b
    Exit status: 0 done; 1 the case is in error or a gear can't be reduced;
    2 wrong use.
    """
    to_file = one_text(wanted, [case])
    needs_scipy()
    from vstatics.torsion.documents import reduction_document
    from vstatics.torsion.reduction.grids import reduction_grids
    from vstatics.torsion.reduction.reduced_values import reduce as reduced

    reading = coasting(arguments.read_one(case, input_format, telling), coast)
    link = link_name(reading.case, to, "--to")
    found = reduced(reading.case, link, gear_names(reading.case, gears))
    faults = list(located(reading, [(one.name, "error", one.error) for one in found if one.error]))
    tell(faults, telling, case)
    name = reading.case.name
    show(
        case,
        to_file,
        name,
        lambda: reduction_grids(link, found),
        lambda: reduction_document(name, link, found),
    )
    return FAILED if faults or telling.fails(reading.warnings) else DONE
