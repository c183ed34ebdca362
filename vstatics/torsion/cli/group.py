"""Command group `vstatics torsion`."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup
from vstatics.torsion.annex import ANNEX


class TorsionCommands(LazyGroup):
    """Commands of `vstatics torsion`, loaded when called."""

    modules = ANNEX.groups["torsion"]


@click.group(cls=TorsionCommands)
def torsion() -> None:
    """Calculate a transmission as a torsional system.

    \b
    Examples:
      vstatics torsion modes box.yaml
      vstatics torsion reduce box.yaml --to engine
      vstatics torsion response box.yaml --at engine --orders 2 --speed 600:3000:9
      vstatics torsion dump dump.yaml
    """
