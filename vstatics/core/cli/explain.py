"""`vstatics explain`: matrix, equations, solution and ratio formula of a gear."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.formats import OutputOptions, TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import command, gathered, refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.errors import listed
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.core.explain.answer import ExplanationAnswer


class AskedExercise(NamedTuple):
    """Options of an exercise on a gear: worksheet or solution, and seed of its numbers."""

    worksheet: bool
    solution: bool
    seed: int | None


@command
@arguments.argument
@arguments.some_gears
@gathered(
    "asked",
    AskedExercise,
    click.option(
        "--worksheet", is_flag=True, help="Write an exercise with given values and blanks."
    ),
    click.option("--solution", is_flag=True, help="Write the solution of --worksheet."),
    click.option(
        "--seed",
        type=click.IntRange(min=0),
        metavar="N",
        help="Replace teeth and ratios of the exercise with random values. All gear sets can be "
        "assembled.",
    ),
)
@formats.options(*formats.TABLES, output_help=formats.OF_SEVERAL_CASES)
@arguments.settings
@arguments.language(arguments.WORDS)
def explain_command(
    cases: tuple[str, ...],
    gears: tuple[str, ...],
    asked: AskedExercise,
    wanted: OutputOptions,
    settings: CaseOptions,
) -> int:
    """Explain each gear: the equations, their solution, and the ratio as a formula.

    For each gear of each CASE (`-` is standard input) you get the structural-distribution
    matrix of the engaged state, the equations of speeds and torques in symbols and numbers
    with their solution, the direction of power flow with its reason, the links that turn
    together, and the ratio as a formula.

    \b
    Examples:
      vstatics explain gearbox.yaml --gear 1
      vstatics explain gearbox.yaml | less
      vstatics explain gearbox.yaml -f json | jq -r '.gears[].formula.text'
      vstatics explain gearbox.yaml --gear 2 --worksheet --seed 7 -o exercise.tex
      vstatics explain gearbox.yaml --gear 2 --solution --seed 7 -o solution.tex

    The formula needs python-flint: pip install ".[formula]" in the source folder.

    Exit status 1: a case has an error, or a gear is tied up.
    """
    to = wanted.destination(cases, several=len(cases) > 1)
    worksheet, solution, seed = asked
    exercise = worksheet or solution
    refuse(
        (worksheet and solution, "expected only one of --worksheet (with blanks) and --solution"),
        (exercise and len(gears) > 1, "an exercise covers one gear: expected one --gear G"),
        (
            seed is not None and not exercise,
            "--seed needs --worksheet or --solution",
        ),
        (
            worksheet and to.form in ("json", "jsonl"),
            f"-f {to.form} needs --solution, because --worksheet has blanks instead of numbers",
        ),
        (
            exercise and to.form in ("csv", "xlsx"),
            f"-f {to.form} cannot hold sentences: expected text, markdown or latex",
        ),
    )
    if exercise:
        show_exercise = partial(_exercise, gears=gears, seed=seed, solved=solution)
        return carry_out(Job("explain", settings, to, show_exercise), cases)
    show = partial(_shown, gears=gears, style=to.style)
    return carry_out(Job("explain", settings, to, show), cases)


def _exercise(
    outcome: CalculatedCase,
    results: Results,
    gears: tuple[str, ...],
    seed: int | None,
    *,
    solved: bool,
) -> texts.CaseOutput:
    from vstatics.core.explain.exercise import exercise, grids

    index, *further_gears = arguments.gear_indices(results.case, gears)
    if further_gears:
        names = listed(results.gears, 12)
        message = f"an exercise covers one gear, expected one of {names}"
        raise click.BadParameter(message, param_hint="--gear")
    with files.problems_of_file(outcome.file):
        sheet = exercise(results, results.case.gears[index].name, seed=seed)
    shown = partial(grids, sheet, solved=solved)
    return texts.CaseOutput(sheet.titles(outcome.file), {}, shown, sheet.document)


def _shown(
    outcome: CalculatedCase, results: Results, gears: tuple[str, ...], style: TextStyle
) -> texts.CaseOutput:
    from vstatics.core.explain import explain_gear

    case = results.case
    indices = arguments.gear_indices(case, gears)
    with files.problems_of_file(outcome.file):
        explanations = [explain_gear(results, case.gears[index].name) for index in indices]

    def as_text(_: str | None) -> str:
        from vstatics.core.explain import text

        return text.write(explanations, style.digits)

    def grids() -> Iterable[Grid]:
        from vstatics.core.explain.tables import explanation_grids

        return explanation_grids(explanations)

    def answer() -> ExplanationAnswer:
        from vstatics.core.explain.answer import ExplanationAnswer

        return ExplanationAnswer(case.name, explanations)

    return texts.CaseOutput([case.name or outcome.file], {"text": as_text}, grids, answer)
