"""Command group `vstatics damage`."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup
from vstatics.vehicle.annex import ANNEX


class DamageCommands(LazyGroup):
    """Commands of `vstatics damage`; `record` is the default."""

    modules = ANNEX.groups["damage"]

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Insert the default command if none is named, and parse the arguments."""
        if args and args[0] not in (*self.modules, *ctx.help_option_names):
            args = ["record", *args]
        return super().parse_args(ctx, args)


@click.group(cls=DamageCommands)
def damage_command() -> None:
    """Calculate fatigue damage and life under varying torque.

    `vstatics damage CASE RECORD.csv` is short for `vstatics damage record CASE RECORD.csv`.

    \b
    Examples:
      vstatics damage record --help
      vstatics damage rayleigh --endurance '100 MPa' --deviation '60 MPa' \\
          --exponent 3 --cycles 4e6 --per-km 100
      vstatics damage resize --diameter '42 mm' --ratio 2.9
    """
