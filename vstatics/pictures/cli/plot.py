"""`vstatics plot`: draw a picture of a case."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import cast

import click

from vstatics.core.annexes import picture_kinds
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions, calculate
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import command, needs, refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import wrong_value
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import higher
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.tables.file_suffixes import known, suffix_of
from vstatics.core.texts import Language
from vstatics.pictures import misplaced, pages
from vstatics.pictures.cli.options import AskedPicture, options
from vstatics.pictures.drawing.files import FORMATS, Format
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.pictures.pair import PairedCase, pair_pages

_MISSING_PACKAGE = "E014"
_FLAGS = {
    "columns": "x, --y, --z, --by",
    "wheels": "teeth",
    "classes": "spectrum",
    "best_gear": "best-gear",
}
"""Spelling of an option on the command line, by name in the record of a kind of picture."""


def _with_kinds(command: Callable[..., int]) -> Callable[..., int]:
    lines = (
        f"{kind:13}" + record.help.replace("\n", "\n" + " " * 17)
        for kind, record in picture_kinds().items()
    )
    command.__doc__ = (command.__doc__ or "").replace("KINDS", "\n    ".join(lines))
    return command


@command
@arguments.optional_argument
@options
@arguments.settings
@arguments.language("axes and titles")
@_with_kinds
def plot_command(
    cases: tuple[str, ...],
    output: str,
    asked: AskedPicture,
    settings: CaseOptions,
    lang: Language,
) -> int:
    """Draw a picture of each CASE: a deck, YAML, JSON or a scenario.

    \b
    KINDS

    For a scenario, --kind shift and --kind plan draw the simulation. All other kinds draw the
    case. Two cases to one FILE are drawn in one picture, with common axes or as panels A and B.
    The CASE `-` is standard input.

    Text has a size of 8 pt. A picture that is wider than the page continues below, and a
    picture that is higher than 240 mm continues on further pages: FILE-2.svg and so on, or
    pages of one PDF.

    \b
    Examples:
      vstatics plot gearbox.yaml --kind stick -o stick.svg
      vstatics plot gearbox.yaml --kind flow --gear R -o flow.png
      vstatics plot gearbox.yaml --kind lever --gear 2 -o second.pdf
      vstatics plot --kind plan --ratios 2.6,1.7,1,-4 -o wanted.svg
      vstatics new other.yaml --template aisin-8speed
      vstatics plot gearbox.yaml other.yaml --kind efficiency -o compared.svg
      echo 'vehicle: {mass: 1900 kg, radius: 0.33, final_drive: 3.15,
        rolling: 0.012, drag_area: 0.7,
        engine: [[100, 250], [300, 400], [600, 350]]}' >> gearbox.yaml
      vstatics plot gearbox.yaml --kind traction -o forces.svg
      vstatics new moskvich-start.yaml --template moskvich-start
      vstatics new scenarios/start.yaml --template scenarios/moskvich-start
      vstatics plot scenarios/start.yaml --kind shift --out heat -o start.png
      vstatics sweep gearbox.yaml --vary P1.efficiency=0.9:0.99:4 \\
          --vary P2.efficiency=0.9:0.99:4 --out 'efficiency[1]' -o losses.csv
      vstatics plot losses.csv --kind map --z 'efficiency[1]' -o map.svg
      cat gearbox.yaml | vstatics plot - --kind efficiency -o losses.png --dark

    Pictures need matplotlib and networkx: pip install ".[plot]" in the source folder. --kind
    modes, campbell, response and dump, and pictures of scenarios, also need scipy: pip install
    ".[plot,torsion,simulation]".

    Exit status 1: a case has an error, a gear is tied up, or there is nothing to draw.
    """
    record, ratios = picture_kinds()[asked.kind], asked.ratios
    of_case = {"columns": asked.columns, "coast": settings.coast is not None}
    refuse(
        *_misplaced(asked.kind, asked.of_kinds),
        (cases and ratios is not None, "--ratios: expected no case"),
        (not cases and ratios is None, "Missing argument 'CASE...'."),
        (
            (record.plots or ratios is not None) and settings[:3] != CaseOptions()[:3],
            "--from, --coast, --unloaded: only a case has them",
        ),
        *_misplaced(asked.kind, of_case),
    )
    if output != STDOUT and not suffix_of(output) and len(cases) <= 1:
        _refuse_without_suffix(output)
    to = formats.each_by_itself(output, cases, FORMATS, "a picture")
    needs("plot", "a picture")
    style = asked.style(lang, math.inf if is_stream(to.output) else PAGE_HEIGHT)
    if record.reads:
        try:
            style = style._replace(data=higher(record.reads)(asked.files))
        except ValueError as error:
            raise click.UsageError(str(error)) from None
    if ratios is not None:
        return _plot_ratios(ratios, asked.gears, to, style, quiet=settings.telling.quiet)
    if record.plots:
        status: int = higher(record.plots)(cases, to, style, asked)
        return status
    of_runs = "motion" in record.options
    is_nominal = of_runs or record.at_any_load
    takes = (settings.at_nominal_load if is_nominal else settings)._replace(
        scenarios=True, of_runs=of_runs, of_vibration=record.shows == "vibration"
    )
    if len(cases) > 1 and not to.is_folder:
        return _plot_two(calculate(cases, takes), to, asked, style, quiet=settings.telling.quiet)
    picture = partial(_shown, form=cast("Format", to.form), asked=asked, style=style)
    return carry_out(Job("plot", takes, to, picture), cases)


def _misplaced(kind: str, given: Mapping[str, object]) -> list[tuple[bool, str]]:
    """List pairs of True and a message for each option that the kind of picture does not have."""
    return [(True, f"--{_FLAGS.get(name, name)}: {why}") for name, why in misplaced(kind, given)]


def _plot_ratios(
    ratios: list[float],
    gears: Sequence[str],
    to: formats.Destination,
    style: Style,
    *,
    quiet: bool,
) -> int:
    from vstatics.pictures.plan.wanted import case_of_ratios

    with wrong_value("--ratios"):
        case = case_of_ratios(ratios, style)
    drawn = pages(
        solve(case), "plan", cast("Format", to.form), style, arguments.gear_numbers(case, gears)
    )
    files.write_pages(drawn, to.output, quiet=quiet)
    return DONE


def _asked_case(
    outcome: CalculatedCase, results: Results, asked: AskedPicture, style: Style
) -> tuple[PairedCase, Style]:
    """Return the case to draw, with the run if the kind of picture shows a run, and the style.

    Raises
    ------
    BadParameter
        If a gear or link does not exist.
    """
    kind_options, chosen, motion = (
        picture_kinds()[asked.kind].options,
        arguments.gear_numbers(results.case, asked.gears),
        None,
    )
    if "motion" in kind_options and outcome.scenario is not None:
        results, motion = higher("drawn_run")(outcome, results, asked.out)
    if "orders" in kind_options:
        style = _excited(outcome, results, style)
    name = os.path.basename(outcome.file)  # noqa: PTH119
    return PairedCase(name, results, chosen, motion), style


def _excited(outcome: CalculatedCase, results: Results, style: Style) -> Style:
    """Return the style with the input speeds of the scenario, if any, added to the excitation.

    Raises
    ------
    BadParameter
        If the link named by ``--at`` does not exist.
    """
    excited = style.excited
    if excited.at:
        with wrong_value("--at"):
            results.case.link_number(excited.at)
    if outcome.scenario is not None:
        excited = excited._replace(speeds=outcome.scenario.input_speeds)
    return style._replace(excited=excited)


def _plot_two(
    outcomes: Iterable[CalculatedCase],
    to: formats.Destination,
    asked: AskedPicture,
    style: Style,
    *,
    quiet: bool,
) -> int:
    both, failed = [], False
    for outcome in outcomes:
        failed |= outcome.failed
        if outcome.results is not None:
            drawn, style = _asked_case(outcome, outcome.results, asked, style)
            both.append(drawn)
    if len(both) == 2:
        sheets = pair_pages(both, asked.kind, cast("Format", to.form), style)
        files.write_pages(sheets, to.output, quiet=quiet)
    return FAILED if failed else DONE


def _refuse_without_suffix(output: str) -> None:
    if not (is_stream(output) or output.endswith("/") or os.path.isdir(output)):  # noqa: PTH112
        expected = " ".join(known(FORMATS))
        raise click.UsageError(
            f"{output} has no suffix that gives its format: expected one of {expected}"
        )


def _shown(
    outcome: CalculatedCase, results: Results, form: Format, asked: AskedPicture, style: Style
) -> texts.CaseOutput:
    (_, results, chosen, motion), style = _asked_case(outcome, results, asked, style)
    try:
        drawn = pages(results, asked.kind, form, style, chosen, motion=motion)
    except CaseError as error:
        if error.problems[0].id == _MISSING_PACKAGE:  # a missing package is not a fault of the case
            raise ReadError(error.problems) from None
        problems = (
            each if each.path or each.place else each.in_file(outcome.file)
            for each in error.problems
        )
        raise outcome.located(CaseError(problems)) from None
    return texts.CaseOutput([], {form: lambda _: drawn})
