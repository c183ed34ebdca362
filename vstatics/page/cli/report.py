"""Command `vstatics report`: write a case and its results as an HTML page."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.annexes import module_of_method
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import OUTPUT, command, gathered, provided, refuse, under
from vstatics.core.cli.shared.texts import Job
from vstatics.core.cli.shared.values import each, named, separated, value
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher
from vstatics.core.statics.results import Results
from vstatics.core.texts import Language, speaking
from vstatics.page.cli.scenarios import naming_of, run_of
from vstatics.page.report.asked import SECTIONS, AskedPage, section

if TYPE_CHECKING:
    from vstatics.core.summary.sections import CycleOptions, GivenCycle


class PageOptions(NamedTuple):
    """Options of `vstatics report`: sections, digits, language, case settings, duty cycle."""

    asked: AskedPage
    digits: int | None
    lang: Language
    settings: CaseOptions
    duty: CycleOptions | None = None
    """Options of the duty cycle, if the annex `vehicle` is installed."""

    @property
    def duty_files(self) -> list[str]:
        """Files of the duty cycle; empty without a duty cycle."""
        return self.duty.files if self.duty else []


@command
@arguments.argument
@arguments.required_output(
    "Output file for one case, or for two cases to compare; `-` means standard output. For several "
    "cases, a directory. A file is written completely or not at all.",
    unless="watch",
)
@under(
    OUTPUT,
    click.option(
        "--watch",
        is_flag=True,
        is_eager=True,
        help="Serve the page and update it when the case is saved, as `vstatics serve` does.",
    ),
)
@gathered(
    "page",
    PageOptions,
    gathered(
        "asked",
        AskedPage,
        click.option(
            "--sections",
            metavar="NAME,...",
            multiple=True,
            callback=value(each(section)),
            help=f"Sections to show and to print: {', '.join(SECTIONS)}.",
        ),
        click.option(
            "--gears",
            metavar="G,...",
            multiple=True,
            callback=value(separated),
            help="Gears to show, by names or numbers.",
        ),
        click.option("--all", "prints_all", is_flag=True, help="Print all sections."),
        click.option(
            "--stamp",
            metavar="NAME=TEXT,...",
            multiple=True,
            callback=value(named("NAME=TEXT", str)),
            help="Entries of the page header, such as author=Me,project=P-7.",
        ),
    ),
    provided("duty_options"),
    formats.digits,
    arguments.language(arguments.WORDS),
    arguments.settings,
)
def report_command(
    cases: tuple[str, ...], output: str | None, watch: bool, page: PageOptions
) -> int:
    """Write each CASE with its results as an HTML page; `-` is standard input.

    Instead of a case you can give a scenario, whose page includes the simulation, or the
    gearboxes found by `synth box -f json`. Two cases and -o FILE give a page that compares
    them as A and B. Several cases and -o DIR/ give a page for each case.

    The page begins with an overview and the stick diagram. It shows power flow, levers and
    equations of a chosen gear, the input, and all tables, which you can sort and copy. It
    loads nothing from elsewhere and contains the result as JSON. A printed page has at most
    ten A4 pages: overview, gears, power flow, efficiency, largest values, and vibration and
    simulation if the case has them. To print all sections, use --all. To select sections,
    use --sections.

    A page of two cases has additional tools: units (rpm, N*m and kW, or US units), a filter by
    link, and buttons that save pictures, tables and results. `vstatics serve` has these tools
    for one case, with sliders for its numbers and for the time of a simulation.

    Pictures need matplotlib and networkx, the vibration section needs scipy: pip install
    ".[plot,torsion]" in the source folder. If these packages are missing, the pictures
    and the vibration section are left out.

    \b
    Examples:
      vstatics report gearbox.yaml -o gearbox.html
      vstatics report gearbox.yaml --sections gears,flow --gears 1,R -o a.html
      vstatics report gearbox.yaml --stamp author=Me,project=P-7 -o gearbox.html
      vstatics new other.yaml --template aisin-8speed
      vstatics report gearbox.yaml other.yaml -o changes.html
      cat gearbox.yaml | vstatics report - -o - > page.html

    Exit status 1: a case has an error, or a gear is tied up.
    """
    asked, settings = page.asked, page.settings
    refuse(
        (
            asked.sections and asked.prints_all,
            "--sections: what it names is printed, without --all",
        ),
    )
    parts = asked.sections or asked.gears or asked.prints_all or page.duty_files
    options = "--sections, --gears, --all, --duty"
    if watch:
        refuse(
            (len(cases) > 1, "--watch: expected one case"),
            (
                parts or asked.stamp or output,
                "--watch: it serves the whole page, without -o and a choice of parts",
            ),
        )
        from vstatics.page.cli.serve import serve_page

        return serve_page(cases[0], page.digits, page.lang, settings)
    assert output is not None  # noqa: S101 - the option is required
    to = formats.each_by_itself(output, cases, ["html"], "a page")
    if len(cases) == 1 and (listing := _listing_in(cases[0])):
        if to.is_folder:
            raise click.UsageError(f"found boxes give one page: expected -o FILE, not {output}")
        refuse((parts, f"{options}: found boxes have a page of their own"))
        with speaking(page.lang):
            status: int = higher("report_boxes")(
                *listing, cases[0], output, page.digits, page.asked.stamp
            )
            return status
    takes = settings.on_page._replace(scenarios=True, of_runs=True)
    if len(cases) == 2 and not to.is_folder:
        refuse((parts, f"{options}: two cases have a page of their own"))
        with speaking(page.lang):
            return _report_two(cases, output, page._replace(settings=takes))
    to = to._replace(style=TextStyle(page.lang))
    files.spare(page.duty_files, to.output)
    cycle = page.duty.read() if page.duty else None
    takes = takes._replace(load=cycle.load if cycle else None)
    show = partial(_page_output, page=page, cycle=cycle)
    return carry_out(Job("report", takes, to, show), cases, others=page.duty_files)


def _listing_in(file: str) -> tuple[object, object] | None:
    """Return the gearboxes listed in a file of `synth box`, and its document.

    The result is None if the file is a case.
    """
    if not module_of_method("listing_in"):
        return None
    listing: tuple[object, object] | None = higher("listing_in")(file)
    return listing


def _report_two(cases: tuple[str, ...], output: str, page: PageOptions) -> int:
    both, failed = [], False
    for label, outcome in zip("AB", arguments.calculate(cases, page.settings), strict=True):
        failed |= outcome.failed
        if outcome.results is not None:
            from vstatics.page.report.pair.paged import paged

            file = os.path.basename(outcome.file)  # noqa: PTH119
            try:
                case = paged(
                    label,
                    outcome.results,
                    file,
                    outcome.problems,
                    page.digits,
                    naming_of(outcome),
                    run_of(outcome),
                )
            except CaseError as error:
                raise outcome.located(error) from None
            both.append(case)
    if len(both) == len(cases):
        from vstatics.page.report.pair.page import pair_page

        shown = pair_page(both, page.asked.stamp)
        files.write_pages([shown.encode(errors="backslashreplace")], output)
    return FAILED if failed else DONE


def _page_output(
    outcome: CalculatedCase, results: Results, page: PageOptions, cycle: GivenCycle | None
) -> texts.CaseOutput:
    asked, quiet = page.asked, page.settings.telling.quiet
    chosen = arguments.gear_indices(results.case, asked.gears, "--gears") if asked.gears else ()
    chosen_page = asked._replace(gears=[results.case.gears[index].name for index in chosen])

    from vstatics.core.summary.sections import doubts

    duty = cycle.of(results) if cycle else None
    warnings = doubts(duty, outcome.file)

    def html(_: str | None) -> str:
        from vstatics.page.report.html_page import page as html_page
        from vstatics.page.report.material import gather

        messages = [*outcome.problems, *warnings]
        scenario = run_of(outcome), naming_of(outcome)
        try:
            material = gather(results, messages, page.digits, *scenario, asked=chosen_page)
        except CaseError as error:
            raise outcome.located(error) from None
        material = material._replace(summary=material.summary._replace(cycle=duty))
        if material.without and not quiet:
            files.say(f"vstatics report: no pictures: {material.without}")
        for key, part in material.parts.items():
            if part.without and not quiet:
                files.say(f"vstatics report: no {key}: {part.without}")
        return html_page(material)

    return texts.CaseOutput([], {"html": html}, problems=warnings)
