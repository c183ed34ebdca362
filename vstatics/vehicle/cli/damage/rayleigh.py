"""`vstatics damage rayleigh`: life under random stresses of a narrow band."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import command, gathered, needs, refuse
from vstatics.core.cli.shared.values import above_0, from_0, value, wrong_value
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.cli.damage.numbers import number, stress, write

_strength = gathered(
    "strength",
    Fatigue,
    stress("endurance", "Endurance limit, the stress amplitude at --cycles, such as '100 MPa'."),
    number("exponent", "Exponent m of the S-N curve: stress^m * cycles is constant."),
    number("cycles", "Number of cycles to failure at the endurance limit."),
    click.option(
        "--threshold",
        type=float,
        default=0.6,
        show_default=True,
        callback=value(from_0),
        metavar="X",
        help="Stress, relative to the endurance limit, below which a cycle does no damage.",
    ),
    number("sum", "Sum of damages at which the component fails.", 1.0),
)


@command
@_strength
@stress("deviation", "Standard deviation of the stress, such as '60 MPa'.")
@click.option(
    "--per-km",
    type=float,
    callback=value(above_0),
    metavar="N",
    help="Number of cycles per km, for the life in km.",
)
@formats.options(*formats.TABLES)
def rayleigh_command(
    strength: Fatigue, deviation: float, per_km: float | None, wanted: OutputOptions
) -> int:
    """Calculate the fatigue life under a narrow-band random stress.

    The amplitudes of such a stress have a Rayleigh distribution. The life is given in
    cycles, or in km with --per-km. Give both stresses with a unit, or both as numbers in
    the same unit; only their ratio matters.

    \b
    Examples:
      vstatics damage rayleigh --endurance '100 MPa' --deviation '60 MPa' \\
          --exponent 3 --cycles 4e6 --per-km 100
    """
    measures = {getattr(stress, "measure", None) for stress in (strength.endurance, deviation)}
    refuse((len(measures) > 1, "--endurance, --deviation: expected a unit of both, or of none"))
    needs("torsion", "vstatics damage rayleigh")
    from vstatics.vehicle.damage.rayleigh import rayleigh_life
    from vstatics.vehicle.damage.tables import rayleigh_grid

    with wrong_value():
        life = rayleigh_life(strength, deviation, per_km or 1.0)
    return write(wanted, life, rayleigh_grid(life, "cycles" if per_km is None else "km"))
