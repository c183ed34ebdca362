"""`vstatics compare`: two results, number by number."""

from __future__ import annotations

from collections.abc import Callable

import click

from vstatics.cli import files
from vstatics.cli.cases import Command
from vstatics.cli.exit_status import DONE, FAILED
from vstatics.readers.results import read_results
from vstatics.tables.compare import ATOL, RTOL, Difference, differences
from vstatics.tables.figures import WrittenResult


def _differ(
    actual: list[WrittenResult], expected: list[WrittenResult], atol: float, rtol: float
) -> list[str]:
    """The lines to print: one for each difference, with the number of the result."""
    if len(actual) != len(expected):
        counts = f"{len(actual)} results", f"{len(expected)} results"
        return [str(Difference("file", "", "", *counts))]
    lines = []
    for number, (one, other) in enumerate(zip(actual, expected, strict=True), 1):
        front = f"result {number}: " if len(actual) > 1 else ""
        pairs = differences(one, other, atol=atol, rtol=rtol)
        lines += [f"{front}{difference}" for difference in pairs]
    return lines


def _tolerance(name: str, default: float, says: str) -> Callable[[Command], Command]:
    least = click.FloatRange(min=0)
    return click.option(name, type=least, default=default, show_default=True, help=says)


@click.command()
@click.argument("actual", type=click.Path())
@click.argument("expected", type=click.Path())
@_tolerance("--atol", ATOL, "Absolute tolerance.")
@_tolerance("--rtol", RTOL, "Tolerance relative to the expected number.")
def compare(actual: str, expected: str, atol: float, rtol: float) -> int:
    """Compare two results, listing or JSON, number by number; - is standard input.

    A number from a listing matches anything within half of its last digit. What
    differs is named by table, row and gear; then the exit status is 1.

    \b
    Example, in CI:
      vstatics run gearbox.yaml -f json | vstatics compare - golden/gearbox.json
    """
    if actual == expected == files.STDIN:
        raise click.UsageError("standard input (-) can be read once")
    one, other = (read_results(*files.read_input(file)) for file in (actual, expected))
    lines = _differ(one, other, atol, rtol)
    if lines:
        files.write_output("\n".join(lines) + "\n", None)
        files.say(f"{actual} and {expected} differ in {len(lines)} place{'s' * (len(lines) > 1)}")
    return FAILED if lines else DONE
