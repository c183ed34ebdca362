"""`vstatics synth`: the group of commands that find gearboxes."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup
from vstatics.synthesis.annex import ANNEX


class SynthesisCommands(LazyGroup):
    """Commands of `vstatics synth`."""

    modules = ANNEX.groups["synth"]


@click.group(cls=SynthesisCommands)
def synth() -> None:
    """Find a gearbox: schemes of planetary sets, gears of a case, ratios, whole gearboxes.

    \b
    Examples:
      vstatics synth structures --sets 3 --classes sets
      vstatics synth case 0-1-2-0-3-1 --input L0 --output L1 -o box.yaml
      vstatics synth combinations box.yaml --elements auto --write gears.yaml
      vstatics synth fit box.yaml --ratios 1=3.5 --write fitted.yaml
      vstatics synth box --sets 1 --elements 2 --engaged 1 --ratios 3,1 -o found/
      vstatics synth teeth fitted.yaml --write teeth.yaml
    """
