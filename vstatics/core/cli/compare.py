"""`vstatics compare`: changes of the case, and differences of two results."""

from __future__ import annotations

import json
import os
from collections.abc import Callable

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import FormatChoice
from vstatics.core.cli.shared.options import Command, command, completing, gathered, refuse
from vstatics.core.cli.shared.values import FILE, value
from vstatics.core.comparison import layout
from vstatics.core.comparison.compared_files import (
    content,
    file_stem,
    sweep_alone,
    verdicts_of_directories,
    verdicts_of_files,
)
from vstatics.core.comparison.tolerances import Tolerances, left_out, read_tolerance
from vstatics.core.comparison.verdicts import Verdict, unreadable, verdict
from vstatics.core.errors import ReadError, count_of
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.tables.answer import plain_data
from vstatics.core.tables.quantities import QUANTITIES
from vstatics.core.writers.junit import CaseOutcome, junit

FORMATS = ("text", "markdown", "json", "junit")


def _tolerance(name: str, default: float, says: str) -> Callable[[Command], Command]:
    return click.option(
        name,
        metavar="FLOAT",
        default=str(default),
        show_default=True,
        callback=value(read_tolerance),
        help=says,
    )


@command
@click.argument("actual", type=FILE)
@click.argument("expected", type=FILE)
@gathered(
    "how",
    Tolerances,
    _tolerance(
        "--atol", ATOL, "Absolute part of the allowed deviation of a number; --rtol adds a part."
    ),
    _tolerance(
        "--rtol",
        RTOL,
        "Tolerance of a number, relative to the expected number, such as 1e-6 or 0.1%.",
    ),
    click.option(
        "--leave-out",
        multiple=True,
        metavar="TABLE",
        callback=value(left_out),
        shell_complete=completing(lambda: (quantity.name for quantity in QUANTITIES)),
        help="Leave out this table, such as efficiency or losses. Repeatable.",
    ),
)
@click.option("--all", "all_numbers", is_flag=True, help="List every number that differs.")
@click.option("--summary", is_flag=True, help="Print only the first line of each case.")
@click.option(
    "-f",
    "--format",
    "form",
    type=FormatChoice(FORMATS),
    default="text",
    show_default=True,
    help="Format of the output.",
)
def compare_command(
    actual: str,
    expected: str,
    how: Tolerances,
    all_numbers: bool,
    summary: bool,
    form: str,
) -> int:
    """Compare two results: changes of the case, and changes of the results.

    ACTUAL and EXPECTED (`-` is standard input) are results of `run` in any two formats, two
    directories of results, or two tables of `sweep`. Files of two directories are paired by
    their names without suffix. Cases and gears are paired by their names, otherwise by their
    positions. Rows of a sweep are paired by the number of the variant.

    The first line states the number of differences. Then the changes of the case are
    listed, and the largest changes of ratios, step ratios, efficiencies and other tables,
    as expected -> actual. The deviation is (actual - expected)/|expected|: a ratio of -3
    that becomes -4 deviates by -33 %. A number from a listing matches everything within
    half a unit of its last digit. Messages, names, descriptions and sources are not compared.

    Exit status 1: a number differs, or a result is new, missing or unreadable.

    \b
    Examples, in CI:
      mkdir golden && vstatics run gearbox.yaml -f json -o golden/gearbox.json
      vstatics run gearbox.yaml -f json | vstatics compare - golden/gearbox.json
      vstatics run *.yaml -f json -o new/
      vstatics compare new/ golden/ -f junit > compare.xml
      vstatics compare new/ golden/ --leave-out losses --summary
    """
    refuse(
        (actual == expected == files.STDIN, "standard input (-) can be read only once"),
        (all_numbers and summary, "--all and --summary exclude each other"),
        (form in ("json", "junit") and (all_numbers or summary), f"{form} has all numbers"),
    )
    folders = [os.path.isdir(path) for path in (actual, expected)]  # noqa: PTH112
    if any(folders):
        for path in (actual, expected):
            refuse((not os.path.exists(path), f"{path}: no such file or directory"))  # noqa: PTH110
        refuse(
            (
                not all(folders),
                "one is a directory, the other is not: expected two files or directories",
            )
        )
        comparison = verdict([*verdicts_of_directories(actual, expected, how)])
    else:
        try:
            comparison = _of_files(actual, expected, how)
        except ReadError as error:
            if form == "text":
                raise
            comparison = verdict([unreadable(file_stem(actual), error.problems)])
    for case in comparison.cases:
        files.show(case.problems)
    count = sum(len(case.differences) or case.differs for case in comparison.cases)
    if form == "json":
        lines = [json.dumps(plain_data(comparison), ensure_ascii=False, indent=1)]
    elif form == "junit":
        lines = [_as_junit(comparison)]
    else:
        lines = _lines(comparison, form, all_numbers=all_numbers, summary=summary)
        tally = all(folders) or (len(comparison.cases) > 1 and lines)
        lines += [comparison.tally] * bool(tally)
    if lines:
        files.write_output("\n".join(lines) + "\n", None)
    if count:
        names = " and ".join(map(files.file_name, (actual, expected)))
        files.say(f"{names} differ in {count_of('place', count)}")
    return FAILED if count else DONE


def _of_files(actual: str, expected: str, how: Tolerances) -> Verdict:
    contents = [files.read_input(file, TABLE_BYTES) for file in (actual, expected)]
    actual_content, expected_content = (content(*file) for file in contents)
    names = contents[0][1], contents[1][1]
    refuse((message := sweep_alone(actual_content, expected_content, names), message))
    return verdict(verdicts_of_files(actual_content, expected_content, names, how))


def _lines(total: Verdict, form: str, *, all_numbers: bool, summary: bool) -> list[str]:
    lay_out = layout.markdown if form == "markdown" else layout.text
    lines: list[str] = []
    for case in total.cases:
        if case.state != "same":
            about_case = lay_out(case, all_numbers=all_numbers)
            lines += about_case[: 1 if summary else None]
            lines += [""] * (form == "markdown")
    return lines


def _as_junit(total: Verdict) -> str:
    """Return the outcome of each case as JUnit XML. Changes of the case alone are not failures."""
    return junit(
        "vstatics compare",
        [
            CaseOutcome(
                case.name,
                case.state * case.differs,
                case.headline,
                "\n".join(layout.text(case)) * (case.state != "same"),
            )
            for case in total.cases
        ],
    ).rstrip("\n")
