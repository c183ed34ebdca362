"""`vstatics synth`: the gearbox to be found; each of its commands is a module."""

from __future__ import annotations

import click

from vstatics.cli.lazy_group import LazyGroup

COMMANDS = {
    "structures": ("vstatics.cli.synth_structures", "All schemes of so many planetary sets."),
    "case": ("vstatics.cli.synth_case", "A case of one of them."),
    "combinations": (
        "vstatics.cli.synth_combinations",
        "What each combination of shift elements of a case does.",
    ),
    "fit": ("vstatics.cli.synth_fit", "Ratios of mechanisms for wanted ratios of gears."),
}


class SynthesisCommands(LazyGroup):
    """The commands of `vstatics synth`."""

    modules = COMMANDS


@click.group(cls=SynthesisCommands)
def synth() -> None:
    """Find a gearbox: schemes of planetary sets, gears of a case, ratios for wanted gears."""
