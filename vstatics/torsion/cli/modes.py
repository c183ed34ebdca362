"""Command `vstatics torsion modes`: natural frequencies and shapes in every gear."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import (
    WorkingGears,
    elastic_case,
    gears_answer,
    located,
    working_notes,
    working_options,
)


@click.command()
@working_options(
    click.option(
        "--modes",
        "count",
        type=click.IntRange(1),
        metavar="N",
        help="The first N modes that are not rigid; all when not given, of a case with more "
        "than 50 links the first 20.",
    )
)
@elastic_case
def modes(request: OneCase, chosen: WorkingGears, count: int | None) -> int:
    """Calculate natural frequencies and shapes of CASE in every gear; - is standard input.

    CASE has `inertias` of links [kg*m^2], or `masses` [kg] of those that move straight,
    and `springs`, mechanisms or shift elements with a `stiffness` [N*m/rad; straight
    N/m]; everything else is rigid. For each mode: the frequency without
    damping and with it, amplitudes of links (the largest is 1), torques of all devices at
    these, shares of the energy, the number of nodes. Given speeds, losses and drag take no
    part; freewheels hold as in `vstatics run`, and springs with `points` have their slopes
    at what they carry there under the torque at the input. Converters are open, but in the
    damped vibration, where they resist by their slopes at the speeds and torques of the load.

    \b
    Examples:
      vstatics torsion modes cases/moskvich412.yaml
      vstatics torsion modes box.yaml --gear 1 --modes 3
      vstatics torsion modes box.yaml -f json | jq '.gears[].modes[].omega'

    \b
    Exit status: 0 done; 1 the case is in error or in a gear nothing can move;
    2 wrong use.
    """

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.torsion.answers import ModesAnswer
        from vstatics.torsion.vibration.gear_modes import modes as modes_of
        from vstatics.torsion.vibration.tables import modes_grids

        case = reading.case
        working = chosen.of(case)
        names = [at_point.gear.name for at_point in working]
        gears = modes_of(case, names, count=count, speed_ratios=chosen.ratios)
        notes = working_notes(reading, working)
        known = {text for gear in working for text in gear.doubts}
        doubts = (
            (gear.name, text) for gear in gears for text in gear.warnings if text not in known
        )
        problems = [*located(reading, doubts, "W503"), *notes]
        answer = ModesAnswer(case.name, gears)
        return gears_answer(reading, gears, lambda: modes_grids(gears), answer, problems)

    return request.answer(calculate, extra="torsion")
