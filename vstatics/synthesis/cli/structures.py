"""`vstatics synth structures`: list all schemes of a number of planetary gear sets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, get_args

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.estimates import (
    CommandEstimate,
    about,
    check_room,
    duration_text,
    size_text,
)
from vstatics.core.cli.shared.formats import WHOLE_OUTPUT, FormatChoice
from vstatics.core.cli.shared.options import OUTPUT, command, gathered, under
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.values import FILE, each, value, wrong_value
from vstatics.core.errors import Problem, typed_number
from vstatics.core.jobs.files import is_stream
from vstatics.core.tables.answer import Count, Flat, Known, as_json, json_keys
from vstatics.synthesis.structures import growth as search
from vstatics.synthesis.structures.counts import count
from vstatics.synthesis.structures.estimate import estimate
from vstatics.synthesis.structures.growth import Classes, StructureSearch
from vstatics.synthesis.structures.json_lines import lines

FORMATS = ("json", "jsonl")
LONG = 60
"""Estimated time above which the estimate is printed before the list or count. [s]"""
WIDEST_NAME = len("10 links")
QUICK_SETS = 3
"""Largest number of gear sets for which listing takes less time than estimating."""


def _links(text: str) -> int:
    number = typed_number(text, 2 * search.MOST_SETS + 1)
    if number is None:
        raise ValueError("expected a number of links")
    return number


@command
@gathered(
    "asked",
    StructureSearch,
    click.option(
        "--sets",
        type=click.IntRange(1, search.MOST_SETS),
        required=True,
        metavar="N",
        help="Number of planetary gear sets.",
    ),
    click.option(
        "--all",
        "unsound",
        is_flag=True,
        help="Include structures in which some gear sets are always locked up.",
    ),
    click.option(
        "--classes",
        type=click.Choice(get_args(Classes)),
        default="none",
        show_default=True,
        help="List only one of several structures that differ only in the names of gear sets "
        "(sets), or also in an exchange of sun and ring (members) or of all members (order).",
    ),
    click.option(
        "--ports", is_flag=True, help="List each structure with every pair of input and output."
    ),
    click.option(
        "--matrix", is_flag=True, help="Add the matrix of links and members of each structure."
    ),
    click.option(
        "--links",
        multiple=True,
        callback=value(each(_links)),
        metavar="J",
        help="Numbers of links of the listed structures, such as 5,6. Repeatable.",
    ),
)
@click.option("--count", "counted", is_flag=True, help="Print only the number of structures.")
@click.option("--dry-run", is_flag=True, help="Print only estimates of number, size and time.")
@under(
    OUTPUT,
    click.option(
        "-f",
        "--format",
        "form",
        type=FormatChoice(FORMATS),
        help="Format of the output. A list of structures is JSON lines in both formats.",
    ),
    click.option("-o", "--output", type=FILE, help=WHOLE_OUTPUT),
)
def structures_command(
    asked: StructureSearch, counted: bool, dry_run: bool, form: str | None, output: str | None
) -> None:
    """List or count all structures of N planetary gear sets.

    A structure states which suns, carriers and rings are one link. All gear sets are
    connected, and at least two degrees of freedom remain. The output has a line of JSON for
    each structure with

    \b
      code     the links of sun, carrier and ring of each gear set, from 0
      links    the number of links
      input, output  with --ports: the links of input and output
      matrix   with --matrix: a row for each link, a column for each sun, carrier
               and ring; 1 where the member belongs to the link, else 0

    \b
    Examples:
      vstatics synth structures --sets 2
      vstatics synth structures --sets 4 --classes sets --count
      vstatics synth structures --sets 5 --classes sets --ports --dry-run
    """
    if counted and asked.matrix:
        raise click.UsageError("--matrix cannot be combined with --count")
    with wrong_value("--links"):
        search.check_search(asked)
    if dry_run:
        known = _known(asked, listed=not counted)
        files.write_output(known.text(form, WIDEST_NAME), output)
        return
    expected = _expected_count(asked, output, listed=not counted)
    if counted:
        with progress(expected, "schemes") as advance:
            by_links = count(asked, advance)
        files.write_output(as_json(_counted(asked, by_links), form), output)
        return
    with (
        files.stream(output) as write,
        progress(expected, "schemes", beside_stdout=is_stream(output)) as advance,
    ):
        for batch in search.batches(asked):
            text = lines(asked, batch)
            write(text)
            advance(text.count(b"\n"))


@json_keys("sets", count="total", by_links="by_links")
class StructureCount(NamedTuple):
    """Number of schemes, in total and by number of links."""

    sets: Count
    total: Count
    by_links: Mapping[str, Count]


class StructureEstimate(NamedTuple):
    """Estimated number of schemes, size of the list, and time of the command."""

    schemes: Flat[StructureCount]
    exact: bool
    bytes: Count | None
    seconds: Known


def _counted(asked: StructureSearch, by_links: Mapping[int, int]) -> StructureCount:
    numbers = {str(links): number for links, number in by_links.items()}
    return StructureCount(asked.sets, sum(by_links.values()), numbers)


def _expected_count(asked: StructureSearch, output: str | None, *, listed: bool) -> int:
    """Return the estimated number of schemes, or 0 for a quick search.

    The number is also printed if the search takes long.

    Raises
    ------
    ReadError
        If the disk space does not suffice.
    """
    if asked.sets <= QUICK_SETS:
        return 0
    estimated = estimate(asked, listed=listed)
    check_room(estimated.bytes, output, "--count, --classes, --links, or another disk")
    if estimated.seconds > LONG:
        size = f", {size_text(estimated.bytes)}" if listed else ""
        count, time = about(estimated.total), duration_text(estimated.seconds)
        text = f"{count} structures{size}, in about {time}"
        files.show([Problem("N003", text)])
    return round(estimated.total)


def _known(asked: StructureSearch, *, listed: bool) -> CommandEstimate:
    """Estimate the number of schemes, the size of the list, and the time of the command."""
    estimated = estimate(asked, listed=listed)
    say = str if estimated.exact else about
    rows = {"schemes": say(estimated.total)}
    for links, number in estimated.by_links.items():
        rows[f"{links} links"] = say(number)
    if listed:
        rows["size"] = f"about {size_text(estimated.bytes)}"
    rounded = {links: round(number) for links, number in estimated.by_links.items()}
    size = round(estimated.bytes) if listed else None
    answer = StructureEstimate(_counted(asked, rounded), estimated.exact, size, estimated.seconds)
    return CommandEstimate(rows, answer, estimated.seconds)
