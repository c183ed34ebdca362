"""Command `vstatics torsion random`: standard deviations and life under random excitation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.one_case import CaseAnswer, OneCase
from vstatics.core.cli.shared.options import gathered
from vstatics.core.cli.shared.values import value
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


@click.command()
@click.option("--at", required=True, metavar="LINK", help="The link that is excited, by its name.")
@click.option(
    "--by",
    type=click.Choice(["torque", "motion"]),
    default="torque",
    show_default=True,
    help="What the spectrum is of: a torque on LINK [N*m], or its angle [rad].",
)
@click.option(
    "--input",
    "source",
    required=True,
    type=click.Path(),
    metavar="FILE",
    help="YAML with `white`, `variance` and `correlation`, or `points`.",
)
@click.option(
    "--omega",
    metavar="A:B:N",
    callback=value(speeds_of, "--omega"),
    help="Where spectra are asked for, in rad/s: N from A to B, or a list with commas.",
)
@working_options()
@gathered("request", OneCase, *CASE_OPTIONS)
def random(
    request: OneCase,
    at: str,
    by: Excitation,
    source: str,
    omega: Floats | None,
    chosen: WorkingGears,
) -> int:
    """Calculate the random vibration of CASE in every gear; - is standard input.

    Standard deviations of twists, torques and links, upward crossings, half widths of the
    peaks of modes, and the life of devices with `fatigue`. A spectrum is two-sided over
    omega: the variance is twice its integral from 0 on. What has no variance has no value.

    \b
    Examples:
      vstatics torsion random box.yaml --at engine --input engine.yaml
      vstatics torsion random box.yaml --at road --by motion --input road.yaml

    \b
    Exit status: 0 done; 1 the case or FILE is in error or a gear can't be
    excited; 2 wrong use.
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
    """Warn of devices that have a fatigue strength but are not elastic in any gear."""
    excited = [gear for gear in gears if not gear.error]
    elastic = {name for gear in excited for name in gear.devices}
    for number, name in enumerate(reading.case.fatigue, 1):
        if excited and name not in elastic:
            text = f"{quoted(name)} is rigid or open: its life is not told; give it a `stiffness`"
            yield reading.locate(Problem("W880", text, ("fatigue", number)))
