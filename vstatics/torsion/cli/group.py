"""Command group `vstatics torsion`."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup
from vstatics.torsion.annex import ANNEX


class TorsionCommands(LazyGroup):
    """Commands of `vstatics torsion`, imported only when called."""

    modules = ANNEX.groups["torsion"]


@click.group(cls=TorsionCommands)
def torsion_command() -> None:
    """Calculate the torsional vibration of a transmission, and the torque of a clutch dump.

    \b
    Examples:
      vstatics new car.yaml --template moskvich412
      vstatics torsion modes car.yaml --gear 1
      vstatics torsion reduce car.yaml --to engine
      vstatics torsion response car.yaml --orders 2 --speed 600:3000:9
      vstatics torsion dump car.yaml
    """
