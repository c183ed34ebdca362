"""`vstatics synth`: group of the commands that find gearboxes."""

from __future__ import annotations

import click

from vstatics.core.cli.shared.lazy_group import LazyGroup
from vstatics.synthesis.annex import ANNEX


class SynthesisCommands(LazyGroup):
    """Commands of `vstatics synth`, imported when used."""

    modules = ANNEX.groups["synth"]


@click.group(cls=SynthesisCommands)
def synth_command() -> None:
    """Find gearboxes for wanted ratios, and ratios, gears or tooth numbers of a case.

    \b
    Examples:
      vstatics synth structures --sets 3 --classes sets --count
      vstatics synth case 0-1-2-0-3-1 --input L0 --output L1 -o box.yaml
      vstatics synth combinations box.yaml --shift-elements auto
      vstatics synth fit gearbox.yaml --ratios 1=4.7 --write fitted.yaml
      vstatics synth teeth gearbox.yaml --ratios P1=-2.03 --write teeth.yaml
      vstatics synth box --sets 1 --shift-elements 2 --engaged 1 \\
          --ratios 3,1 -o found/
    """
