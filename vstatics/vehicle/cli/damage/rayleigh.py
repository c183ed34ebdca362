"""`vstatics damage rayleigh`: life under random stresses of a narrow band."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import gathered, needs, refuse
from vstatics.core.cli.shared.values import above_0, from_0, value, wrong_value
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.cli.damage.numbers import number, stress, write

_strength = gathered(
    "strength",
    Fatigue,
    stress("endurance", "That is borne for so many cycles: '100 MPa'."),
    number("exponent", "Stress to this power by the cycles that are borne is constant."),
    number("cycles", "That are borne at the endurance."),
    click.option(
        "--threshold",
        type=float,
        default=0.6,
        show_default=True,
        callback=value(from_0),
        metavar="X",
        help="Below this part of the endurance there is no damage.",
    ),
    number("sum", "Of damages at which the device fails.", 1.0),
)


@click.command()
@_strength
@stress("deviation", "Standard deviation of the stress: '60 MPa'.")
@click.option(
    "--per-km", type=float, callback=value(above_0), metavar="N", help="Cycles a km: life in km."
)
@formats.options(*formats.TABLES)
def rayleigh(
    strength: Fatigue, deviation: float, per_km: float | None, wanted: OutputOptions
) -> int:
    """Tell the life under a random stress whose amplitudes have Rayleigh's distribution.

    So they have under a stress of a narrow band of frequencies. Life is told in cycles,
    with --per-km in km. Both stresses have their units, or both are bare numbers of one
    unit: only their quotient counts.

    \b
    Examples:
      vstatics damage rayleigh --endurance '100 MPa' --deviation '60 MPa' \\
          --exponent 3 --cycles 4e6 --per-km 100

    \b
    Exit status: 0 done; 2 wrong use.
    """
    measures = {getattr(stress, "measure", None) for stress in (strength.endurance, deviation)}
    refuse((len(measures) > 1, "--endurance, --deviation: expected a unit of both, or of none"))
    needs("torsion", "vstatics damage rayleigh")
    from vstatics.vehicle.damage.rayleigh import rayleigh_life
    from vstatics.vehicle.damage.tables import rayleigh_grid

    with wrong_value():
        life = rayleigh_life(strength, deviation, per_km or 1.0)
    return write(wanted, life, rayleigh_grid(life, "cycles" if per_km is None else "km"))
