"""Command `vstatics damage rayleigh`: life under a narrow-band random stress."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import command, gathered, needs, refuse
from vstatics.core.cli.shared.values import above_0, from_0, value, wrong_value
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.cli.damage.numbers import number, stress, write

MOST_SAMPLES = 10_000_000
"""Largest number of random samples."""

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
@click.option(
    "--samples",
    type=click.IntRange(1, MOST_SAMPLES),
    metavar="N",
    help="Number of random samples of a scattered endurance or deviation, for the distribution "
    "of lives.",
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    metavar="S",
    help="Seed of the random numbers.  [default: 0]",
)
@formats.options(*formats.TABLES)
def rayleigh_command(
    strength: Fatigue,
    deviation: float,
    per_km: float | None,
    samples: int | None,
    seed: int | None,
    wanted: OutputOptions,
) -> int:
    """Calculate the fatigue life under a narrow-band random stress.

    The amplitudes of such a stress have a Rayleigh distribution. The life is given in
    cycles, or in km with --per-km. Give both stresses with a unit, or both as numbers in
    the same unit. Only their ratio matters.

    Each stress can be a distribution: 'lognormal(100 MPa, 0.08)' has the median and the
    standard deviation of the natural logarithm, 'normal(100 MPa, 8 MPa)' mean and standard
    deviation. With --samples you get the lives that 10 % and 50 % of the parts do not reach,
    the mean life, and the share of failed parts over life.

    \b
    Examples:
      vstatics damage rayleigh --endurance '100 MPa' --deviation '60 MPa' \\
          --exponent 3 --cycles 4e6 --per-km 100
      vstatics damage rayleigh --endurance 'lognormal(100 MPa, 0.08)' \\
          --deviation '60 MPa' --exponent 3 --cycles 4e6 --samples 100000
    """
    measures = {getattr(stress, "measure", None) for stress in (strength.endurance, deviation)}
    refuse((len(measures) > 1, "--endurance, --deviation: expected a unit of both, or of none"))
    needs("torsion", "vstatics damage rayleigh")
    from vstatics.vehicle.damage.rayleigh import rayleigh_life, scattered_life
    from vstatics.vehicle.damage.scatter import Scattered
    from vstatics.vehicle.damage.tables import rayleigh_grid

    scatters = any(isinstance(each, Scattered) for each in (strength.endurance, deviation))
    given = "a distribution of --endurance or --deviation, such as 'lognormal(100 MPa, 0.08)'"
    refuse((samples is not None and not scatters, f"--samples: expected {given}"))
    refuse((scatters and samples is None, "read a distribution, expected --samples as well"))
    refuse((seed is not None and samples is None, "--seed: expected --samples as well"))
    with wrong_value():
        if samples is None:
            life = rayleigh_life(strength, deviation, per_km or 1.0)
        else:
            life = scattered_life(strength, deviation, per_km or 1.0, samples, seed or 0)
    return write(wanted, life, rayleigh_grid(life, "cycles" if per_km is None else "km"))
