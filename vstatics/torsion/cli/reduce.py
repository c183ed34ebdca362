"""Command `vstatics torsion reduce`: inertias and compliances reduced to a link."""

from __future__ import annotations

from functools import partial

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import elastic_case, gear_names, gears_answer, link_name, slope_notes


@click.command()
@click.option("--to", required=True, metavar="LINK", help="The link, by its name or number.")
@arguments.some_gears
@elastic_case
def reduce(request: OneCase, to: str, gears: tuple[str, ...]) -> int:
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
