"""`vstatics summary`: ratios, step ratios, transitions and largest values of a case."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.core.annexes import module_of_method
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions, calculate, show_problems
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import Destination, OutputOptions
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import command, provided, refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import above_0, torque, value
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import higher
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid

if TYPE_CHECKING:
    from vstatics.core.summary import Summary
    from vstatics.core.summary.answer import SummaryAnswer
    from vstatics.core.summary.sections import CycleOptions, GivenCycle


MOST_COMBINATIONS = 10_000
"""Largest number of combinations of shift elements that are calculated by default."""


@command
@arguments.argument
@formats.options(*formats.TABLES, output_help=formats.OF_SEVERAL_CASES)
@click.option(
    "--combinations",
    is_flag=True,
    help="Add the gears of all other combinations of shift elements.",
)
@click.option(
    "--at-most",
    type=click.IntRange(min=1),
    metavar="N",
    help="Largest number of combinations to try.  [default: 10000]",
)
@provided("duty_options")
@click.option(
    "--output-torque",
    callback=value(torque),
    metavar="TORQUE",
    help="With `inertias`: external torque on the output for accelerations, such as -1200 or "
    "'-1200 N*m'.  [default: 0]",
)
@click.option(
    "--reserve",
    type=click.FloatRange(min=0, min_open=True, max=1e6),
    callback=value(above_0),
    metavar="FACTOR",
    help="Add the torque capacity that each shift element needs: its largest torque times FACTOR, "
    "such as 1.2.",
)
@provided("box_option")
@arguments.settings
@arguments.language(arguments.WORDS)
def summary_command(
    cases: tuple[str, ...],
    wanted: OutputOptions,
    combinations: bool,
    at_most: int | None,
    output_torque: float | None,
    reserve: float | None,
    settings: CaseOptions,
    boxes: tuple[int, ...] = (),
    duty: CycleOptions | None = None,
) -> int:
    """Summarize each CASE: ratios, step ratios, spread, shifts and largest values.

    Step ratios and shifts are between neighbouring gears of one direction. The largest values
    are taken over all gears. A sensitivity is the change of a ratio in % when the basic ratio
    of a mechanism changes by 1 %. Several cases are shown side by side as A, B and C. -o
    DIRECTORY/ writes a separate summary of each case. Instead of cases you can give the
    gearboxes found by `synth box -f json`. The CASE `-` is standard input.

    \b
    Examples:
      vstatics summary gearbox.yaml
      vstatics new other.yaml --template aisin-8speed
      vstatics summary gearbox.yaml other.yaml
      vstatics summary gearbox.yaml --combinations -o gearbox.md
      vstatics summary gearbox.yaml -f json | jq .spread
      vstatics synth box --sets 1 --shift-elements 2 --engaged 1 \\
          --ratios 3,1 -o boxes.json
      vstatics summary boxes.json --gearbox 1

    Markdown and LaTeX have the tables of the text. XLSX and CSV have the same tables with
    all digits. JSON has an entry for each case.

    Exit status 1: a case has an error, or a gear is tied up.
    """
    refuse((at_most is not None and not combinations, "--at-most needs --combinations"))
    others = duty.files if duty else []
    to = wanted.destination([*cases, *others], several=len(cases) > 1, together=True)
    arguments.check_streams([*cases, *others])
    given = duty.read() if duty else None
    settings = settings._replace(load=given.load if given else None)
    summarized = partial(
        _summarized,
        at_most=at_most or (MOST_COMBINATIONS if combinations else None),
        duty=given,
        output_torque=output_torque or 0.0,
        reserve=reserve,
    )
    if len(cases) == 1 and module_of_method("calculated_boxes"):
        calculated = higher("calculated_boxes")(cases[0], boxes, settings)
        if calculated is not None:
            return _of_boxes(list(calculated), summarized, to)
    if boxes:
        raise click.UsageError("--gearbox: expected one file of found gearboxes instead of cases")
    if len(cases) == 1 or to.is_folder or to.form in ("json", "jsonl"):
        show = partial(_shown, summarized=summarized)
        return carry_out(Job("summary", settings, to, show), cases, others=others)
    return _side_by_side(calculate(cases, settings), summarized, to)


def _of_boxes(
    outcomes: Sequence[CalculatedCase],
    summarized: Callable[[CalculatedCase, Results], Summary],
    to: Destination,
) -> int:
    """Write the summaries of gearboxes from a synthesis, as a table or as JSON."""
    if to.is_folder:
        message = f"found gearboxes have one output: expected -o FILE, not {to.output}"
        raise click.UsageError(message)
    if to.form not in ("json", "jsonl"):
        return _side_by_side(outcomes, summarized, to)
    parts = [
        texts.among_several(case, _shown(case, case.results, summarized), to)
        for case in outcomes
        if case.results is not None
    ]
    files.write_data(b"".join(texts.joined(parts, to)), to.output)
    return FAILED if any(case.failed for case in outcomes) else DONE


def _side_by_side(
    outcomes: Iterable[CalculatedCase],
    summarized: Callable[[CalculatedCase, Results], Summary],
    to: Destination,
) -> int:
    from vstatics.core.summary.contrast import contrasted, letters
    from vstatics.core.summary.sections import doubts

    failed, summaries = False, []
    for outcome in outcomes:
        failed |= outcome.failed
        if outcome.results is not None:
            try:
                summary = summarized(outcome, outcome.results)
                dubious = doubts(summary.cycle, outcome.file)
                telling = outcome.telling._replace(notes=True)
                show_problems(dubious, telling, outcome.file)
                failed |= telling.fails(dubious)
                summaries.append((outcome, summary))
            except ReadError as error:
                files.show(error.problems)
                failed = True
    if summaries:
        titles = [
            f"{letter}: {outcome.file}{f' ({name})' if name else ''}"
            for letter, (outcome, summary) in zip(letters(len(summaries)), summaries, strict=True)
            for name in [summary.results.case.name]
        ]
        shown = texts.CaseOutput(
            titles, {}, lambda: contrasted([summary for _, summary in summaries])
        )
        files.write_pages(texts.alone(summaries[0][0].file, shown, to), to.output)
    return FAILED if failed else DONE


def _summarized(
    outcome: CalculatedCase,
    results: Results,
    at_most: int | None,
    duty: GivenCycle | None,
    output_torque: float,
    reserve: float | None,
) -> Summary:
    """Return the summary of a case. Too many combinations are a problem of the file."""
    from vstatics.core.summary import summarize

    try:
        summary = summarize(results, at_most=at_most, output_torque=output_torque, reserve=reserve)
    except CaseError as error:
        if any(problem.path[:1] == ("gears",) for problem in error.problems):
            raise outcome.located(error) from None
        with files.problems_of_file(outcome.file, "; see --at-most"):
            raise
    return summary if duty is None else summary._replace(cycle=duty.of(results))


def _shown(
    outcome: CalculatedCase,
    results: Results,
    summarized: Callable[[CalculatedCase, Results], Summary],
) -> texts.CaseOutput:
    from vstatics.core.summary.sections import doubts

    summary = summarized(outcome, results)

    def tables() -> Iterable[Grid]:
        from vstatics.core.summary.tables import summary_grids

        return summary_grids(summary)

    def answer() -> SummaryAnswer:
        from vstatics.core.summary.answer import summary_answer

        return summary_answer(summary)

    title = results.case.name or outcome.file
    problems = doubts(summary.cycle, outcome.file)
    return texts.CaseOutput([title], {}, tables, answer, problems=problems)
