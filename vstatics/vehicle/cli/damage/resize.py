"""Command `vstatics damage resize`: shaft with an equal fatigue life under other torques."""

from __future__ import annotations

from typing import NamedTuple

import click

from vstatics.core.cli.shared import formats
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.options import Option, command
from vstatics.core.cli.shared.values import above_0, told, value, wrong_value
from vstatics.vehicle.cli.damage.numbers import number, write


class _Diameter(NamedTuple):
    number: float
    unit: str


def _diameter(text: str) -> _Diameter:
    """Parse a diameter; keep its unit, if any."""
    from vstatics.core.readers.named.arithmetic import calculated
    from vstatics.core.readers.named.si_units import measured

    above_0(told(lambda given: measured(given, "length"))(text))
    return _Diameter(*calculated(text))


def _part(name: str, text: str) -> Option:
    return click.option(f"--{name}", type=float, callback=value(above_0), metavar="X", help=text)


@command
@click.option(
    "--diameter",
    required=True,
    callback=value(_diameter),
    metavar="D",
    help="Diameter of the present shaft, such as '42 mm'.",
)
@_part(
    "ratio",
    "Ratio X of a reduction before the new shaft, which then has X times the torque and 1/X of "
    "the cycles.",
)
@_part("torque", "New torque divided by the present torque, instead of --ratio.")
@_part("repeats", "New number of cycles divided by the present number; belongs to --torque.")
@number("exponent", "Exponent m of the S-N curve: stress^m * cycles is constant.", 6.0)
@formats.options(*formats.TABLES)
def resize_command(
    diameter: _Diameter,
    ratio: float | None,
    torque: float | None,
    repeats: float | None,
    exponent: float,
    wanted: OutputOptions,
) -> int:
    """Calculate the diameter and the compliance of a shaft of equal fatigue life.

    The new shaft has the life of the present shaft. The new diameter has the
    unit of the given diameter. The compliances are relative to the present shaft. The
    reduced compliance refers to the faster shaft of the reduction.

    \b
    Examples:
      vstatics damage resize --diameter '42 mm' --ratio 2.9
      vstatics damage resize --diameter 42 --torque 1.3 --repeats 2 -f json
    """
    from vstatics.vehicle.damage.resize import resized, resized_by_ratio
    from vstatics.vehicle.damage.tables import resized_grid

    with wrong_value():
        if ratio is not None and torque is None and repeats is None:
            shaft = resized_by_ratio(diameter.number, ratio, exponent)
        elif ratio is None and torque is not None and repeats is not None:
            shaft = resized(diameter.number, torque, repeats, exponent)
        else:
            raise click.UsageError("expected --ratio, or --torque and --repeats")
    return write(wanted, shaft, resized_grid(shaft, diameter.unit))
