"""`vstatics torsion`: the transmission as a torsional system; each of its commands is a module."""

from __future__ import annotations

import click

from vstatics.cli.lazy_group import LazyGroup

COMMANDS = {
    "modes": ("vstatics.cli.torsion_modes", "Natural frequencies and shapes in every gear."),
    "dump": ("vstatics.cli.torsion_dump", "The largest torque when the clutch is dumped."),
}


class TorsionCommands(LazyGroup):
    """The commands of `vstatics torsion`."""

    modules = COMMANDS


@click.group(cls=TorsionCommands)
def torsion() -> None:
    """Calculate a transmission as a torsional system.

    \b
    Examples:
      vstatics torsion dump dump.yaml
    """
