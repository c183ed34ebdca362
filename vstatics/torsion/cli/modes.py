"""Command `vstatics torsion modes`: natural frequencies and shapes in every gear."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import command
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import (
    WorkingGears,
    elastic_case,
    gears_answer,
    located,
    working_notes,
    working_options,
)


@command
@working_options(
    click.option(
        "--modes",
        "count",
        type=click.IntRange(1),
        metavar="N",
        help="Number of elastic modes, the lowest first.  [default: all, or 20 for a case with "
        "more than 50 links]",
    )
)
@elastic_case
def modes_command(request: OneCase, chosen: WorkingGears, count: int | None) -> int:
    """Calculate the natural frequencies and mode shapes of CASE in every gear.

    CASE (`-` is standard input) has `inertias` [kg*m^2] of links, or `masses` [kg] of links in
    translation, and `springs`, mechanisms or shift elements with a `stiffness` [N*m/rad, or
    N/m]. All other parts are rigid. For each mode you get the frequency with and without
    damping, the amplitudes of the links (the largest is 1), the torques of all components
    at these amplitudes, the shares of the energy, and the number of nodes.

    Given speeds, losses and drag torques have no influence. Freewheels hold as in `vstatics
    run`. Springs with `points` have the slope at their torque under the given input torque.
    Converters transmit nothing, but in damped vibration they act as dampers, linearised at
    the operating point.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion modes car.yaml
      vstatics torsion modes car.yaml --gear 1 --modes 3
      vstatics torsion modes car.yaml -f json | jq '.gears[].modes[].omega'

    Exit status 1: the case has an error, or nothing can move in a gear.
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
