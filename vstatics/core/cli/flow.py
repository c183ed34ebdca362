"""`vstatics flow`: the power flow of every gear, with losses and recirculating power."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import OutputOptions, TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import command
from vstatics.core.cli.shared.texts import Job
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.core.flow.answer import FlowAnswer


@command
@arguments.argument
@arguments.some_gears
@formats.options(*formats.TABLES, output_help=formats.OF_SEVERAL_CASES)
@arguments.settings
@arguments.language(arguments.WORDS)
def flow_command(
    cases: tuple[str, ...], gears: tuple[str, ...], wanted: OutputOptions, settings: CaseOptions
) -> int:
    """Show the power flow, the losses and the recirculating power in every gear.

    For each gear of each CASE (`-` is standard input) you get

    \b
      - the power through links, mechanisms and engaged shift elements, with and
        without losses, relative to the input power, and in kW if the case has an
        operating point;
      - the rolling (tooth) power relative to the carrier, by mechanism, and by
        mesh where meshes share planets;
      - the losses, their shares, and the balance of power;
      - the recirculating power with the loop that carries it, and a note if the
        loop can be an artefact of the model.

    Power of a member is positive where it enters the mechanism. The sign ~ marks values
    that are split by convention, because several splits are possible.

    \b
    Examples:
      vstatics flow gearbox.yaml --gear R
      vstatics flow gearbox.yaml -f json | jq '.gears[].lossy.circulating'
      vstatics flow gearbox.yaml -o power.xlsx

    Exit status 1: a case has an error, or a gear is tied up.
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
