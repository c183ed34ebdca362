"""`vstatics torsion`: the transmission as a torsional system; each of its commands is a module."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup

COMMANDS = {
    "modes": ("vstatics.torsion.cli.modes", "Natural frequencies and shapes in every gear."),
    "reduce": ("vstatics.torsion.cli.reduce", "Inertias and compliances on one link."),
    "simplify": ("vstatics.torsion.cli.simplify", "Fewer masses, the same low frequencies."),
    "response": ("vstatics.torsion.cli.response", "Amplitudes and torques by orders and speeds."),
    "random": ("vstatics.torsion.cli.random", "Deviations and life under random excitation."),
    "dump": ("vstatics.torsion.cli.dump", "The largest torque when the clutch is dumped."),
    "identify": ("vstatics.torsion.cli.measured", "Compliances from a measured frequency."),
    "damping": ("vstatics.torsion.cli.measured", "Dampings from logarithmic decrements."),
}


class TorsionCommands(LazyGroup):
    """The commands of `vstatics torsion`."""

    modules = COMMANDS


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
