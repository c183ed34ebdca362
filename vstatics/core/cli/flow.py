"""`vstatics flow`: the power flow of every gear, with losses and recirculating power."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import OutputOptions, TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.texts import Job
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.core.flow.answer import FlowAnswer


@click.command()
@arguments.argument
@arguments.some_gears
@formats.options(*formats.TABLES)
@arguments.settings
@arguments.language("the words, but not of names and messages")
def flow(
    cases: tuple[str, ...], gears: tuple[str, ...], wanted: OutputOptions, settings: CaseOptions
) -> int:
    """Show where the power goes in every gear of each CASE; - is standard input.

    For each gear: the power through links, mechanisms and engaged shift elements,
    without and with losses, relative to the power at the input link, and in kW if the
    case has a load; that of the teeth, against the carrier, by mechanism, and by mesh
    where meshes share planets; losses and their shares; the balance; power that
    circulates, and the loop that carries it, and whether it may not be in the metal.
    Power of a member is above 0 where it enters the mechanism; ~ marks what is divided
    by convention.

    \b
    Examples:
      vstatics flow gearbox.yaml --gear R
      vstatics flow gearbox.dat -f json | jq '.gears[].lossy.circulating'
      vstatics flow gearbox.yaml other.yaml -o power.xlsx

    \b
    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    to = wanted.destination(cases, several=len(cases) > 1)
    show = partial(_shown, gears=gears, style=to.style)
    return carry_out(Job("flow", settings, to, show), cases)


def _shown(
    outcome: CalculatedCase, results: Results, gears: tuple[str, ...], style: TextStyle
) -> texts.CaseOutput:
    from vstatics.core.flow.power import flows

    powers = flows(results)
    shown = [powers[index] for index in arguments.gear_indices(results.case, gears)]
    case = results.case

    def as_text(_: str | None) -> str:
        from vstatics.core.flow.text import text

        return "\n".join(text(gear_flow, style.digits) for gear_flow in shown)

    def grids() -> Iterable[Grid]:
        from vstatics.core.flow.rows import flow_grids

        return flow_grids(shown)

    def answer() -> FlowAnswer:
        from vstatics.core.flow.answer import CONVENTIONS, FlowAnswer

        return FlowAnswer(CONVENTIONS, case.name, shown)

    return texts.CaseOutput([case.name or outcome.file], {"text": as_text}, grids, answer)
