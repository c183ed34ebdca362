"""`vstatics report`: a case and its results as one page of HTML."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import provided, refuse
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import each, named, separated, value
from vstatics.core.statics.results import Results
from vstatics.core.texts import Language, speaking
from vstatics.page.report.asked import SECTIONS, AskedPage, section
from vstatics.simulation.cli.scenario_run import naming_of, run_of
from vstatics.synthesis.cli.found_boxes import listing_in, report_boxes

if TYPE_CHECKING:
    from vstatics.core.summary.sections import CycleOptions, GivenCycle


@click.command()
@arguments.argument
@arguments.required_output(
    "Write to this file, whole or not at all: a case, or two that are compared; several cases to "
    "this directory; - is standard output.",
    unless="watch",
)
@click.option(
    "--watch",
    is_flag=True,
    is_eager=True,
    help="Serve the page of one case, as `vstatics serve` does, which follows its file.",
)
@click.option(
    "--sections",
    metavar="NAME,...",
    multiple=True,
    callback=value(each(section)),
    help=f"These only, on the screen and in print: {', '.join(SECTIONS)}.",
)
@click.option(
    "--gears",
    metavar="G,...",
    multiple=True,
    callback=value(separated),
    help="Of these gears only, by names or numbers.",
)
@click.option("--all", "prints_all", is_flag=True, help="Print all that the screen shows.")
@click.option(
    "--stamp",
    metavar="NAME=TEXT,...",
    multiple=True,
    callback=value(named("NAME=TEXT", str)),
    help="A head on the page, such as author=A. Author,project=P-7,date=2026-11-26.",
)
@provided("duty_options")
@formats.digits
@arguments.language("the words of the page, but not of names and messages")
@arguments.settings
def report(
    cases: tuple[str, ...],
    output: str | None,
    watch: bool,
    sections: tuple[str, ...],
    gears: list[str],
    prints_all: bool,
    stamp: dict[str, str],
    digits: int | None,
    lang: Language,
    settings: CaseOptions,
    duty: CycleOptions | None = None,
) -> int:
    """Write each CASE and its results as one page of HTML; - is standard input.

    A scenario may stand for its case; then the page has its run, too. For what `synth box -f
    json` found the page has all boxes, their families, and diagrams. Two cases and -o FILE give
    a page that compares them, A and B; several cases and -o DIR/ a page each.

    The page has an overview with the stick diagram, the gears, power flow, levers and equations
    of the one that is chosen, the input and all tables, which can be sorted and copied. It loads
    nothing from elsewhere, can be printed, and carries the result as JSON.

    In print it has at most ten pages of A4: the overview, gears with their stick diagrams,
    power flow, efficiency, largest values, and what the case has of vibration and a run;
    --all prints all of it, --sections what it names.

    A page of two cases shows numbers in rpm, N*m and kW or in US units, filters the rows by a
    link, and saves pictures, tables and results. `vstatics serve` offers the same for one case,
    with sliders for its numbers and a run that moves with a slider for the time.

    Pictures need matplotlib, the section on vibration of a case with inertias and springs
    scipy: pip install "vstatics[plot,torsion]". Without them the rest is written.

    \b
    Examples:
      vstatics report gearbox.yaml -o gearbox.html
      vstatics report upshift.yaml -o upshift.html
      vstatics report gearbox.yaml --duty points.csv -o gearbox.html
      vstatics report gearbox.yaml --sections gears,flow --gears 1,R -o a.html
      vstatics report old.yaml new.yaml -o changes.html
      vstatics report gearbox.yaml --stamp author=Me,project=P-7 -o gearbox.html
      cat gearbox.dat | vstatics report - -o - > gearbox.html

    \b
    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    refuse(
        (sections and prints_all, "--sections: what it names is printed, without --all"),
    )
    cycles = duty.files if duty else []
    parts = sections or gears or prints_all or cycles
    own = "--sections, --gears, --all, --duty"
    if watch:
        refuse(
            (len(cases) > 1, "--watch: expected one case"),
            (
                parts or stamp or output,
                "--watch: it serves the whole page, without -o and a choice of parts",
            ),
        )
        from vstatics.page.cli.serve import serve_page

        return serve_page(cases[0], digits, lang, settings)
    assert output is not None  # noqa: S101 - it is required
    settings = settings.on_page
    to = formats.each_by_itself(output, cases, ["html"], "a page", most=2)
    if len(cases) == 1 and (found := listing_in(cases[0])):
        if to.is_folder:
            raise click.UsageError(f"found boxes give one page: expected -o FILE, not {output}")
        refuse((parts, f"{own}: found boxes have a page of their own"))
        with speaking(lang):
            return report_boxes(*found, cases[0], output, digits, stamp)
    if len(cases) == 2 and not to.is_folder:
        refuse((parts, f"{own}: two cases have a page of their own"))
        with speaking(lang):
            options = settings._replace(scenarios=True, of_runs=True)
            return _report_two(cases, output, digits, stamp, options)
    asked = AskedPage(sections, gears, prints_all, stamp)
    to = to._replace(style=TextStyle(lang))
    quiet = settings.telling.quiet
    files.spare(cycles, to.output)
    show = partial(
        _shown, digits=digits, quiet=quiet, asked=asked, cycle=duty.read() if duty else None
    )
    options = settings._replace(scenarios=True, of_runs=True)
    return carry_out(Job("report", options, to, show), cases, others=cycles)


def _report_two(
    cases: tuple[str, ...],
    output: str,
    digits: int | None,
    stamp: dict[str, str],
    settings: CaseOptions,
) -> int:
    """Write the page of two cases; the exit status."""
    both, failed = [], False
    for label, outcome in zip("AB", arguments.calculate(cases, settings), strict=True):
        failed |= outcome.failed
        if outcome.results is not None:
            from vstatics.page.report.pair.paged import paged

            file = os.path.basename(outcome.file)  # noqa: PTH119
            naming, run = naming_of(outcome), run_of(outcome)
            both.append(paged(label, outcome.results, file, outcome.problems, digits, naming, run))
    if len(both) == len(cases):
        from vstatics.page.report.pair.page import pair_page

        files.write_pages([pair_page(both, stamp).encode(errors="backslashreplace")], output)
    return FAILED if failed else DONE


def _shown(
    outcome: CalculatedCase,
    results: Results,
    digits: int | None,
    quiet: bool,
    asked: AskedPage,
    *,
    cycle: GivenCycle | None,
) -> texts.CaseOutput:
    """The page of a case."""
    chosen = arguments.gear_indices(results.case, asked.gears, "--gears") if asked.gears else ()
    own = asked._replace(gears=[results.case.gears[index].name for index in chosen])

    driven = None if cycle is None else cycle.of(results)
    from vstatics.core.summary.sections import doubts

    found = doubts(driven, outcome.file)

    def html(_: str | None) -> str:
        from vstatics.page.report.html_page import page
        from vstatics.page.report.material import gather

        run, naming = run_of(outcome), naming_of(outcome)
        told = [*outcome.problems, *found]
        material = gather(results, told, digits, run, naming, asked=own)
        material = material._replace(summary=material.summary._replace(cycle=driven))
        if material.without and not quiet:
            files.say(f"vstatics report: no pictures: {material.without}")
        if material.vibration and material.vibration.without and not quiet:
            files.say(f"vstatics report: no vibration: {material.vibration.without}")
        return page(material)

    return texts.CaseOutput([], {"html": html}, problems=found)
