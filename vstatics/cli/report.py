"""`vstatics report`: a case and its results as one page of HTML."""

from __future__ import annotations

import os

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files
from vstatics.cli.cases import CaseOptions, calculate
from vstatics.cli.exit_status import DONE, FAILED
from vstatics.jobs.files import is_stream


@click.command()
@arguments.case_argument
@arguments.required_output("Write to this file, whole or not at all; - is standard output.")
@arguments.settings
def report(case: str, output: str, settings: CaseOptions) -> int:
    """Write CASE and its results as one page of HTML; - is standard input.

    The page has the input, ratios, pictures, the power flow of each gear, transitions,
    largest values and all tables; a click on a heading sorts those of the results. It loads nothing
    from elsewhere, can be printed, and carries the result as JSON.

    Pictures need matplotlib: pip install "vstatics[plot]". Without it the page has none.

    \b
    Examples:
      vstatics report gearbox.yaml -o gearbox.html
      cat gearbox.dat | vstatics report - -o - > gearbox.html

    \b
    Exit status: 0 done; 1 the case is in error or a gear is tied up; 2 wrong use.
    """
    files.spare([case], output)
    suffix = os.path.splitext(output)[1].lower()  # noqa: PTH122
    if suffix not in ("", ".html", ".htm") and not is_stream(output):
        raise click.UsageError(
            f"the page is HTML: expected a file that ends in .html, not {suffix}"
        )
    [outcome] = calculate([case], settings)
    if outcome.results is not None:
        from vstatics.report import gather, page

        material = gather(outcome.results, outcome.problems)
        if material.without and not settings.telling.quiet:
            files.say(f"vstatics report: no pictures: {material.without}")
        files.write_output(page(material), output)
    return FAILED if outcome.failed else DONE
