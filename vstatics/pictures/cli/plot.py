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
from vstatics.core.cli.shared.options import refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import wrong_value
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.extras import higher
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.tables.suffixes import known, suffix_of
from vstatics.core.texts import Language
from vstatics.pictures import misplaced, pages
from vstatics.pictures.cli.options import AskedPicture, options
from vstatics.pictures.drawing.files import FORMATS, Format
from vstatics.pictures.drawing.style import PAGE_HEIGHT, Style
from vstatics.pictures.pair import PairedCase, pair_pages

_FLAGS = {"columns": "x, --y, --z, --by"}
"""Names of options on the command line, by the option in the record of a kind."""


def _with_kinds(command: Callable[..., int]) -> Callable[..., int]:
    """Insert the list of kinds of pictures into the help of a command."""
    lines = (
        f"{kind:13}" + record.help.replace("\n", "\n" + " " * 17)
        for kind, record in picture_kinds().items()
    )
    command.__doc__ = (command.__doc__ or "").replace("KINDS", "\n    ".join(lines))
    return command


@click.command()
@arguments.optional_argument
@options
@arguments.settings
@arguments.language("axes and titles")
@_with_kinds
def plot(
    cases: tuple[str, ...],
    output: str,
    asked: AskedPicture,
    settings: CaseOptions,
    lang: Language,
) -> int:
    """Draw a picture of each CASE: a deck, YAML, JSON or a scenario; - is standard input.

    \b
    KINDS

    \b
    Of a scenario plan shows its run, too; other kinds show its case.
    Two cases to one FILE are on one sheet, over one another, or beside each
    other where there is room: panels A and B.

    Letters keep their size of 8 pt: what is wider than a page goes on below, what is
    higher than 240 mm on a further page.

    \b
    Examples:
      vstatics plot gearbox.yaml --kind plan -o plan.svg
      vstatics plot --kind plan --ratios 2.6,1.7,1,-4 -o wanted.svg
      vstatics plot gearbox.yaml --kind lever --gear 2 -o second.pdf
      vstatics plot old.yaml new.yaml --kind efficiency -o compared.svg
      vstatics plot upshift.yaml --kind shift -o upshift.png
      vstatics plot upshift.yaml --kind shift --out 'vehicle_jerk, heat' -o up.png
      vstatics plot car.yaml --kind traction -o forces.svg
      vstatics plot loads.csv --kind map --z 'efficiency[low]' -o map.svg
      cat gearbox.dat | vstatics plot - --kind efficiency -o losses.png --dark

    Needs matplotlib: pip install "vstatics[plot]"; modes, campbell,
    response and dump need scipy too: "vstatics[plot,torsion]"; scenarios, too:
    "vstatics[plot,simulation]".

    \b
    Exit status: 0 done; 1 a case is in error, a gear is tied up, or there is
    nothing to draw; 2 wrong use.
    """
    record, ratios = picture_kinds()[asked.kind], asked.ratios
    of_case = {"columns": asked.columns, "coast": settings.coast is not None}
    refuse(
        *_misplaced(asked.kind, asked.of_kinds),
        (cases and ratios is not None, "--ratios: without a case"),
        (not cases and ratios is None, "Missing argument 'CASE...'."),
        (
            (record.plots or ratios is not None) and settings[:3] != CaseOptions()[:3],
            "--from, --coast, --idle: they are of a case",
        ),
        *_misplaced(asked.kind, of_case),
    )
    if output != STDOUT and not suffix_of(output) and len(cases) <= 1:
        _refuse_without_suffix(output)
    to = formats.each_by_itself(output, cases, FORMATS, "a picture")
    style = asked.style(lang, math.inf if is_stream(to.output) else PAGE_HEIGHT)
    if ratios is not None:
        return _plot_ratios(ratios, asked.gears, to, style)
    if record.plots:
        status: int = higher(record.plots)(cases, to, style, asked)
        return status
    takes = settings._replace(
        scenarios=True, of_runs="motion" in record.options, of_vibration=record.shows == "vibration"
    )
    if len(cases) > 1 and not to.is_folder:
        return _plot_two(calculate(cases, takes), to, asked, style)
    picture = partial(_shown, form=cast("Format", to.form), asked=asked, style=style)
    return carry_out(Job("plot", takes, to, picture), cases)


def _misplaced(kind: str, given: Mapping[str, object]) -> list[tuple[bool, str]]:
    """List the rules that refuse options which a kind of picture does not have."""
    return [(True, f"--{_FLAGS.get(name, name)}: {why}") for name, why in misplaced(kind, given)]


def _plot_ratios(
    ratios: list[float], gears: Sequence[str], to: formats.Destination, style: Style
) -> int:
    from vstatics.pictures.plan.wanted import case_of_ratios

    with wrong_value("--ratios"):
        case = case_of_ratios(ratios, style)
    drawn = pages(solve(case), "plan", cast("Format", to.form), style, _chosen(case, gears))
    files.write_pages(drawn, to.output)
    return DONE


def _chosen(case: Transmission, gears: Sequence[str]) -> list[int]:
    """Return the numbers of the chosen gears, without repetitions."""
    return [arguments.gear_number(case, gear) for gear in dict.fromkeys(gears)]


def _asked_case(
    outcome: CalculatedCase, results: Results, asked: AskedPicture, style: Style
) -> tuple[PairedCase, Style]:
    """Return the case to draw, with its run if the kind shows runs, and the style.

    Raises
    ------
    BadParameter
        If a gear or link does not exist.
    """
    kind_options, chosen, motion = (
        picture_kinds()[asked.kind].options,
        _chosen(results.case, asked.gears),
        None,
    )
    if "motion" in kind_options and outcome.scenario is not None:
        results, motion = higher("drawn_run")(outcome, results, asked.out)
    if "orders" in kind_options:
        style = _excited(outcome, results, style)
    name = os.path.basename(outcome.file)  # noqa: PTH119
    return PairedCase(name, results, chosen, motion), style


def _excited(outcome: CalculatedCase, results: Results, style: Style) -> Style:
    """Return a style with the speeds of a scenario.

    Raises
    ------
    BadParameter
        If the link does not exist.
    """
    excited = style.excited
    if excited.at:
        with wrong_value("--at"):
            results.case.link_number(excited.at)
    if outcome.scenario is not None:
        excited = excited._replace(speeds=outcome.scenario.input_speeds)
    return style._replace(excited=excited)


def _plot_two(
    outcomes: Iterable[CalculatedCase], to: formats.Destination, asked: AskedPicture, style: Style
) -> int:
    both, failed = [], False
    for outcome in outcomes:
        failed |= outcome.failed
        if outcome.results is not None:
            drawn, style = _asked_case(outcome, outcome.results, asked, style)
            both.append(drawn)
    if len(both) == 2:
        sheets = pair_pages(both, asked.kind, cast("Format", to.form), style)
        files.write_pages(sheets, to.output)
    return FAILED if failed else DONE


def _refuse_without_suffix(output: str) -> None:
    if not (is_stream(output) or output.endswith("/") or os.path.isdir(output)):  # noqa: PTH112
        expected = " ".join(known(FORMATS))
        raise click.UsageError(
            f"can't tell the format of {output}: expected a suffix of {expected}"
        )


def _shown(
    outcome: CalculatedCase, results: Results, form: Format, asked: AskedPicture, style: Style
) -> texts.CaseOutput:
    (_, results, chosen, motion), style = _asked_case(outcome, results, asked, style)
    try:
        drawn = pages(results, asked.kind, form, style, chosen, motion=motion)
    except CaseError as error:
        raise ReadError(problem.in_file(outcome.file) for problem in error.problems) from None
    return texts.CaseOutput([], {form: lambda _: drawn})
