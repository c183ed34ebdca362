"""`vstatics compare`: two results, number by number."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import NamedTuple

import click

from vstatics.cli.frame import files
from vstatics.cli.frame.documents import is_a
from vstatics.cli.frame.exit_status import DONE, FAILED
from vstatics.cli.frame.options import Command
from vstatics.errors import plural
from vstatics.readers import sweep_tables
from vstatics.readers.results import read_results
from vstatics.tables.compare import ATOL, RTOL, differences
from vstatics.tables.compare_sweeps import sweep_differences
from vstatics.tables.names import quantity_named
from vstatics.tables.written_results import WrittenResult


class Tolerances(NamedTuple):
    """How numbers are compared, and keys of the tables that are not."""

    atol: float
    rtol: float
    leave_out: frozenset[str]


def _differ(
    actual: Sequence[WrittenResult], expected: Sequence[WrittenResult], how: Tolerances
) -> list[str]:
    """The lines to print: one for each difference, with the case among several."""
    if max(len(actual), len(expected)) == 1:
        return [str(one) for one in differences(actual[0], expected[0], **how._asdict())]
    found, wanted = _named(actual, expected)
    lines = [f"{name}: not there, expected it" for name in wanted if name not in found]
    for name, result in found.items():
        if name not in wanted:
            lines.append(f"{name}: there, expected no such result")
            continue
        pairs = differences(result, wanted[name], **how._asdict())
        lines += [f"{name}: {difference}" for difference in pairs]
    return lines


def _named(
    actual: Sequence[WrittenResult], expected: Sequence[WrittenResult]
) -> list[dict[str, WrittenResult]]:
    """Both by what tells the results of each apart: file, name of the case, or number."""
    for name in map(attrgetter, ("file", "case_name")):
        keys = [[name(one) for one in results] for results in (actual, expected)]
        if all(all(side) and len(set(side)) == len(side) for side in keys):
            break
    else:
        keys = [[f"result {n}" for n, _ in enumerate(side, 1)] for side in (actual, expected)]
    return [dict(zip(*pair, strict=True)) for pair in zip(keys, (actual, expected), strict=True)]


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
def compare(
    actual: str, expected: str, atol: float, rtol: float, leave_out: tuple[str, ...]
) -> int:
    """Compare two results number by number; - is standard input.

    Results of run: listing, JSON, JSON lines, CSV, in any mix. Cases are those of one
    file, else of one name, gears those of one name, else of one number. Or two sweeps:
    CSV, JSON lines, NPZ, Parquet, by the number of the variant. What differs is named by
    table, row and gear; then the exit status is 1. A number from a listing matches
    anything within half of its last digit.

    \b
    Examples, in CI:
      vstatics run gearbox.yaml -f json | vstatics compare - golden/gearbox.json
      vstatics compare new.csv old.csv --leave-out losses
    """
    if actual == expected == files.STDIN:
        raise click.UsageError("standard input (-) can be read once")
    left = frozenset(quantity_named(name).key for name in leave_out)
    how = Tolerances(atol, rtol, left)
    read = [files.read_input(file) for file in (actual, expected)]
    sweeps = [is_a("sweep", *file) for file in read]
    if all(sweeps):
        one, other = (sweep_tables.read(*file) for file in read)
        lines = list(sweep_differences(one, other, **how._asdict()))
    elif any(sweeps):
        raise click.UsageError("one is a sweep, the other is not: expected two of a kind")
    else:
        left_side, right_side = (read_results(*file) for file in read)
        lines = _differ(left_side, right_side, how)
    if lines:
        files.write_output("\n".join(lines) + "\n", None)
        places = plural("place", len(lines))
        files.say(f"{actual} and {expected} differ in {len(lines)} {places}")
    return FAILED if lines else DONE
