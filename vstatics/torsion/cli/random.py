"""Command `vstatics torsion random`: standard deviations and life under random excitation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import command, gathered
from vstatics.core.cli.shared.values import FILE, value
from vstatics.core.errors import Problem, quoted
from vstatics.core.readers.reading import Reading
from vstatics.torsion.cli.case import (
    CASE_OPTIONS,
    WorkingGears,
    gears_answer,
    link_name,
    working_notes,
    working_options,
)
from vstatics.torsion.cli.response import speeds_of

if TYPE_CHECKING:
    from vstatics.core.numerics.arrays import Floats
    from vstatics.torsion.random.random_vibration import Excitation, GearRandom


@command
@click.option("--at", required=True, metavar="LINK", help="Link that is excited, by its name.")
@click.option(
    "--by",
    type=click.Choice(["torque", "motion"]),
    default="torque",
    show_default=True,
    help="Quantity of the spectrum: a torque on LINK [N*m], or the angle of LINK [rad].",
)
@click.option(
    "--input",
    "source",
    required=True,
    type=FILE,
    metavar="FILE",
    help="YAML file of the spectrum: `white`, `variance` with `correlation`, or `points`.",
)
@click.option(
    "--omega",
    metavar="A:B:N",
    callback=value(speeds_of, "--omega"),
    help="Frequencies of the calculated spectra, in rad/s: N frequencies from A to B, or a list.",
)
@working_options()
@gathered("request", OneCase, *CASE_OPTIONS)
def random_command(
    request: OneCase,
    at: str,
    by: Excitation,
    source: str,
    omega: Floats | None,
    chosen: WorkingGears,
) -> int:
    """Calculate the random vibration of CASE in every gear; `-` is standard input.

    You get the standard deviations of twists, torques and motions of links, the number of
    upward crossings of the mean per second, the half widths of the resonance peaks, and the
    life of components with `fatigue`. Spectra are two-sided over omega: the variance is
    twice the integral from 0 to infinity. Values without a finite variance are left out.

    \b
    Examples:
      vstatics new car.yaml --template moskvich-start
      echo 'white: 0.5' > engine.yaml
      vstatics torsion random car.yaml --at engine --input engine.yaml
      echo '{variance: 1e-4, correlation: [[1, 0.3, 0.8]],
        speed: 36 km/h}' > road.yaml
      vstatics torsion random car.yaml --at vehicle --by motion \\
          --input road.yaml

    \b
    Exit status 1: the case or FILE has an error, or a gear cannot be excited.
    """
    to = request.destination(source)

    def calculate(reading: Reading) -> CaseAnswer:
        from vstatics.torsion.answers import RandomAnswer
        from vstatics.torsion.random.random_vibration import random_vibration
        from vstatics.torsion.random.spectrum_file import read_spectrum
        from vstatics.torsion.random.tables import random_grids

        case = reading.case
        link = link_name(case, at, "--at")
        spectrum = read_spectrum(*files.read_input(source))
        working = chosen.of(case)
        names = [at_point.gear.name for at_point in working]
        gears = random_vibration(
            case, link, spectrum, names, by=by, omegas=omega, speed_ratios=chosen.ratios
        )
        answer = RandomAnswer(case.name, link, by, gears)
        problems = [*_lifeless(reading, gears), *working_notes(reading, working)]
        return gears_answer(reading, gears, lambda: random_grids(gears), answer, problems)

    return request.answer(calculate, to, extra="torsion")


def _lifeless(reading: Reading, gears: Sequence[GearRandom]) -> Iterator[Problem]:
    """Yield warnings about components with a fatigue strength that no gear treats as elastic."""
    from vstatics.torsion.random.random_vibration import of_stress

    excited = [gear for gear in gears if not gear.error]
    elastic = {name for gear in excited for name in gear.devices}
    strengths = of_stress(reading.case.fatigue)
    for number, name in enumerate(reading.case.fatigue, 1):
        if excited and name in strengths and name not in elastic:
            text = (
                f"{quoted(name)} is rigid or disengaged, so it has no life; give it a `stiffness`"
            )
            yield reading.locate(Problem("W880", text, ("fatigue", number)))
