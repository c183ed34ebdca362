"""`vstatics explain`: a gear's matrix, its equations and their solution, its ratio as a formula."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import formats, texts
from vstatics.cli.frame.cases import CalculatedCase, CaseOptions
from vstatics.cli.frame.formats import OutputOptions, TextStyle
from vstatics.cli.frame.one_or_many import carry_out
from vstatics.cli.frame.texts import Job
from vstatics.errors import CaseError, ReadError
from vstatics.statics.results import Results
from vstatics.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.explain.answer import ExplanationAnswer


@click.command()
@arguments.argument
@arguments.some_gears
@formats.options(*formats.TABLES)
@arguments.settings
@arguments.language("the words, but not of names and messages")
def explain(
    cases: tuple[str, ...], gears: tuple[str, ...], wanted: OutputOptions, settings: CaseOptions
) -> int:
    """Explain the gears of each CASE: a deck, YAML or JSON; - is standard input.

    For each gear: the structural-distribution matrix of what is engaged, the speed
    and the torque equations in symbols and numbers with their solution, the signs of
    the power flow and why, links that turn together, and the ratio as a formula.

    \b
    Examples:
      vstatics explain gearbox.dat --gear 1
      vstatics explain gearbox.yaml | less
      vstatics explain gearbox.yaml -f json | jq -r '.gears[].formula.text'

    The formula needs SymPy: pip install "vstatics[formula]".

    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    to = wanted.destination(cases, several=len(cases) > 1)
    show = partial(_shown, gears=gears, style=to.style)
    return carry_out(Job("explain", settings, to, show), cases)


def _shown(
    outcome: CalculatedCase, results: Results, gears: tuple[str, ...], style: TextStyle
) -> texts.CaseOutput:
    """The gears of a case, explained."""
    from vstatics.explain import explain_gear

    case = results.case
    indices = arguments.gear_indices(case, gears)
    try:
        explanations = [explain_gear(results, index + 1) for index in indices]
    except CaseError as error:
        raise ReadError(one.in_file(outcome.file) for one in error.problems) from None

    def as_text(_: str | None) -> str:
        from vstatics.explain import text

        return text.write(explanations, style.digits)

    def grids() -> Iterable[Grid]:
        from vstatics.explain.grids import grids

        return grids(explanations)

    def answer() -> ExplanationAnswer:
        from vstatics.explain.answer import ExplanationAnswer

        return ExplanationAnswer(case.name, explanations)

    return texts.CaseOutput([case.name or outcome.file], {"text": as_text}, grids, answer)
