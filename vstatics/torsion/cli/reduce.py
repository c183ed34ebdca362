"""Command `vstatics torsion reduce`: inertias and compliances reduced to a link."""

from __future__ import annotations

from functools import partial

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import command
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import elastic_case, gear_names, gears_answer, link_name, slope_notes


@command
@click.option(
    "--to",
    required=True,
    metavar="LINK",
    help="Link to which the system is reduced, by its name or number.",
)
@arguments.some_gears
@elastic_case
def reduce_command(request: OneCase, to: str, gears: tuple[str, ...]) -> int:
    """Reduce the inertias and compliances of CASE to one link, in every gear.

    The factors follow from the speeds w of the rigid motion: an inertia J becomes
    J (w_link/w_to)^2, a compliance E becomes E (w_to/w_link)^2. A link at rest, such as
    a casing on its mounting, can support 1 - i times the torque of the link --to. Then its J
    becomes J/(1 - i)^2, and its E becomes E (1 - i)^2. For i = 1 the values are left out. Rigidly
    connected links are one entry under the name of the first link. The CASE - is standard
    input.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion reduce car.yaml --to engine
      vstatics torsion reduce car.yaml --to 'output shaft' --gear 1 -f json

    Exit status 1: the case has an error, or a gear cannot be reduced.
    """

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.torsion.answers import ReductionAnswer
        from vstatics.torsion.reduction.reduced_values import reduce as reduced
        from vstatics.torsion.reduction.tables import reduction_grids

        case = reading.case
        link = link_name(case, to, "--to")
        reductions = reduced(case, link, gear_names(case, gears))
        notes = slope_notes(reading, [gear.name for gear in reductions])
        answer = ReductionAnswer(case.name, link, reductions)
        grids = partial(reduction_grids, link, reductions)
        return gears_answer(reading, reductions, grids, answer, notes)

    return request.answer(calculate, extra="torsion")
