"""`vstatics report`: a case and its results as one page of HTML."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING

import click

from vstatics.cli.frame import cases as arguments
from vstatics.cli.frame import files, formats, texts
from vstatics.cli.frame.cases import CalculatedCase, CaseOptions
from vstatics.cli.frame.found_boxes import listing_in, report_boxes
from vstatics.cli.frame.one_or_many import carry_out
from vstatics.cli.frame.scenario_run import run_of
from vstatics.cli.frame.texts import Job
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.report.material import Naming


@click.command()
@arguments.argument
@arguments.required_output(
    "Write to this file, whole or not at all; several cases to this directory; - is "
    "standard output."
)
@formats.digits
@arguments.settings
def report(cases: tuple[str, ...], output: str, digits: int | None, settings: CaseOptions) -> int:
    """Write each CASE and its results as one page of HTML; - is standard input.

    A scenario may stand for its case; then the page has its run, too. For what `synth box -f
    json` found the page has all boxes, their families, and diagrams.

    The page has an overview with the stick diagram, the gears, power flow, levers and equations
    of the one that is chosen, the input and all tables, which can be sorted and copied. It loads
    nothing from elsewhere, can be printed, and carries the result as JSON.

    Pictures need matplotlib, the section on vibration of a case with inertias and springs
    scipy: pip install "vstatics[plot,torsion]". Without them the rest is written.

    \b
    Examples:
      vstatics report gearbox.yaml -o gearbox.html
      vstatics report upshift.yaml -o upshift.html
      cat gearbox.dat | vstatics report - -o - > gearbox.html

    \b
    Exit status: 0 done; 1 a case is in error or a gear is tied up; 2 wrong use.
    """
    to = formats.each_by_itself(output, cases, ["html"], "a page")
    if len(cases) == 1 and (found := listing_in(cases[0])):
        if to.is_folder:
            raise click.UsageError(f"found boxes give one page: expected -o FILE, not {output}")
        return report_boxes(*found, cases[0], output, digits)
    show = partial(_shown, digits=digits, quiet=settings.telling.quiet)
    return carry_out(
        Job("report", settings._replace(scenarios=True, of_runs=True), to, show), cases
    )


def _shown(
    outcome: CalculatedCase, results: Results, digits: int | None, quiet: bool
) -> texts.CaseOutput:
    """The page of a case."""

    def html(_: str | None) -> str:
        from vstatics.report import gather, page

        material = gather(results, outcome.problems, digits, run_of(outcome), _naming(outcome))
        if material.without and not quiet:
            files.say(f"vstatics report: no pictures: {material.without}")
        if material.vibration and material.vibration.without and not quiet:
            files.say(f"vstatics report: no vibration: {material.vibration.without}")
        return page(material)

    return texts.CaseOutput([], {"html": html})


def _naming(outcome: CalculatedCase) -> Naming:
    """The name of the file for what has none itself, and what happens in a scenario."""
    from vstatics.report.material import Naming

    path, read = outcome.file, outcome.scenario
    file = "" if path == files.STDIN_NAME else os.path.splitext(os.path.basename(path))[0]  # noqa: PTH119, PTH122
    return Naming(file) if read is None else Naming(read.name or file, read.description)
