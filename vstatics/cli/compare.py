"""`vstatics compare`: two results, what changed first."""

from __future__ import annotations

import json
import os
from collections.abc import Callable

import click

from vstatics.cli.frame import files
from vstatics.cli.frame.documents import is_a
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.options import Command, refuse
from vstatics.comparison import layout
from vstatics.comparison.numbers import ATOL, RTOL
from vstatics.comparison.pairs import verdicts_of_directories, verdicts_of_files
from vstatics.comparison.sweeps import sweep_differences
from vstatics.comparison.verdicts import Tolerances, Verdict, verdict
from vstatics.errors import plural
from vstatics.readers import sweep_tables
from vstatics.readers.results import read_results
from vstatics.tables.answer import plain_data
from vstatics.tables.names import quantity_named
from vstatics.writers.junit import CaseOutcome, junit

FORMATS = ("text", "markdown", "json", "junit")


def _tolerance(name: str, default: float, says: str) -> Callable[[Command], Command]:
    least = click.FloatRange(min=0)
    return click.option(name, type=least, default=default, show_default=True, help=says)


@click.command()
@click.argument("actual", type=click.Path())
@click.argument("expected", type=click.Path())
@_tolerance("--atol", ATOL, "Absolute tolerance.")
@_tolerance("--rtol", RTOL, "Tolerance relative to the expected number.")
@click.option(
    "--leave-out",
    multiple=True,
    metavar="TABLE",
    help="Do not compare this table, by name or alias; may be given several times.",
)
@click.option("--all", "all_numbers", is_flag=True, help="Every number that differs.")
@click.option("--summary", is_flag=True, help="The first line of each case alone.")
@click.option("-f", "--format", "form", type=click.Choice(FORMATS), default="text", help="Format.")
def compare(
    actual: str,
    expected: str,
    atol: float,
    rtol: float,
    leave_out: tuple[str, ...],
    all_numbers: bool,
    summary: bool,
    form: str,
) -> int:
    """Compare two results, - is standard input: what changed in the case, and what by that.

    Results of run: listing, JSON, JSON lines, CSV, in any mix; or two directories of
    them, by the paths of the files without suffix. Cases are those of one file, else of
    one name, gears those of one name, else of one number. The first line tells how much
    differs, then come changes of the case and the largest ones of ratios, steps,
    efficiencies and other tables, as expected -> actual, 20 lines at most.
    A number from a listing matches anything within half of its last digit.
    Or two sweeps: CSV, JSON lines, NPZ, Parquet, by the number of the variant.

    Exit status: 0 no number differs; 1 one does, or a result is added or gone; 2 wrong use.

    \b
    Examples, in CI:
      vstatics run gearbox.yaml -f json | vstatics compare - golden/gearbox.json
      vstatics compare new/ golden/ -f junit > compare.xml
      vstatics compare new.csv old.csv --leave-out losses
    """
    refuse(
        (actual == expected == files.STDIN, "standard input (-) can be read once"),
        (all_numbers and summary, "--all and --summary exclude each other"),
        (form in ("json", "junit") and (all_numbers or summary), f"{form} has all numbers"),
    )
    left = frozenset(quantity_named(name).key for name in leave_out)
    how = Tolerances(atol, rtol, left)
    folders = [os.path.isdir(one) for one in (actual, expected)]  # noqa: PTH112
    failed = False
    if any(folders):
        for path in (actual, expected):
            refuse((not os.path.exists(path), f"{path}: no such file or directory"))  # noqa: PTH110
        refuse((not all(folders), "one is a directory, the other is not: expected two of a kind"))
        cases = []
        for one in verdicts_of_directories(actual, expected, how, files.read_input):
            if isinstance(one, list):
                files.show(one)
                failed = True
            else:
                cases.append(one)
        made = verdict(cases)
    else:
        read = [files.read_input(file) for file in (actual, expected)]
        sweeps = [is_a("sweep", *file) for file in read]
        if any(sweeps):
            refuse(
                (not all(sweeps), "one is a sweep, the other is not: expected two of a kind"),
                (form != "text", f"sweeps are compared as text, not as {form}"),
            )
            tables = [sweep_tables.read(*file) for file in read]
            lines = list(sweep_differences(tables[0], tables[1], **how._asdict()))
            return _told(lines, len(lines), actual, expected)
        results = [read_results(*file) for file in read]
        names = read[0][1], read[1][1]
        made = verdict(verdicts_of_files(results[0], results[1], names, how))
    count = sum(len(one.found) or one.differs for one in made.cases)
    if form == "json":
        text = json.dumps(plain_data(made), ensure_ascii=False, indent=1)
        status = _told([text], count, actual, expected)
    elif form == "junit":
        status = _told([_as_junit(made)], count, actual, expected)
    else:
        lines = _lines(made, form, all_numbers=all_numbers, summary=summary)
        tally = all(folders) or (len(made.cases) > 1 and lines)
        status = _told([*lines, *[made.tally] * bool(tally)], count, actual, expected)
    return FAILED if failed else status


def _lines(made: Verdict, form: str, *, all_numbers: bool, summary: bool) -> list[str]:
    """What is told of all cases that are not the same."""
    lay_out = layout.markdown if form == "markdown" else layout.text
    lines: list[str] = []
    for one in made.cases:
        if one.state != "same":
            own = lay_out(one, all_numbers=all_numbers)
            lines += own[: 1 if summary else None]
            lines += [""] * (form == "markdown")
    return lines


def _as_junit(made: Verdict) -> str:
    """A test case for each; changes of a case without effect are told, and no failure."""
    return junit(
        "vstatics compare",
        [
            CaseOutcome(
                one.name,
                one.state * one.differs,
                one.headline,
                "\n".join(layout.text(one)) * (one.state != "same"),
            )
            for one in made.cases
        ],
    ).rstrip("\n")


def _told(lines: list[str], count: int, actual: str, expected: str) -> int:
    """Write lines; the exit status by what differs, which is counted on stderr."""
    if lines:
        files.write_output("\n".join(lines) + "\n", None)
    if count:
        files.say(f"{actual} and {expected} differ in {count} {plural('place', count)}")
    return FAILED if count else DONE
