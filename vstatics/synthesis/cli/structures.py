"""`vstatics synth structures`: list all schemes of a number of planetary sets."""

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
from vstatics.core.cli.shared.options import gathered
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.values import each, value, wrong_value
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
"""Duration above which an estimate is printed. [s]"""
WIDEST_NAME = len("10 links")
QUICK_SETS = 3
"""Number of sets that are listed faster than estimated."""


def _links(text: str) -> int:
    number = typed_number(text, 2 * search.MOST_SETS + 1)
    if number is None:
        raise ValueError("expected a number of links")
    return number


@click.command()
@gathered(
    "asked",
    StructureSearch,
    click.option(
        "--sets",
        type=click.IntRange(1, search.MOST_SETS),
        required=True,
        metavar="N",
        help=f"The number of planetary sets, 1 to {search.MOST_SETS}.",
    ),
    click.option(
        "--all",
        "unsound",
        is_flag=True,
        help="Also schemes in which some sets turn as one body whatever their ratios.",
    ),
    click.option(
        "--classes",
        type=click.Choice(get_args(Classes)),
        default="none",
        show_default=True,
        help="Which schemes are one: none; up to renaming of the sets; also with sun and ring "
        "exchanged (members); also with the members of a set in any order.",
    ),
    click.option("--ports", is_flag=True, help="With every choice of an input and an output."),
    click.option(
        "--matrix", is_flag=True, help="With the matrix of each: which members a link joins."
    ),
    click.option(
        "--links",
        multiple=True,
        callback=value(each(_links)),
        metavar="J",
        help="Only schemes with so many links; may be repeated, or hold commas.",
    ),
)
@click.option("--count", "counted", is_flag=True, help="Only how many there are.")
@click.option("--dry-run", is_flag=True, help="Only about how many, how large, how long.")
@click.option(
    "-f", "--format", "form", type=click.Choice(FORMATS), help="A list is JSON lines in both."
)
@click.option("-o", "--output", type=click.Path(), help="Write to this file, whole or not at all.")
def structures(
    asked: StructureSearch, counted: bool, dry_run: bool, form: str | None, output: str | None
) -> None:
    """List all schemes of N planetary sets, or count them.

    A scheme tells which suns, carriers and rings are one link; its sets hang together, and
    it leaves two degrees of freedom or more. A line of JSON for each has its `code` (the
    links of sun, carrier and ring of each set in turn, from 0), its number of `links`, with
    --ports the links of `input` and `output`, with --matrix its `matrix`: a row for each
    link, a column for each sun, carrier and ring, 1 where the link has it, else 0.

    \b
    Examples:
      vstatics synth structures --sets 2
      vstatics synth structures --sets 4 --classes sets --count
      vstatics synth structures --sets 5 --classes sets --ports --dry-run
    """
    if counted and asked.matrix:
        raise click.UsageError("--matrix is of a list: expected it without --count")
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
    """Estimated number, size and duration of schemes."""

    schemes: Flat[StructureCount]
    exact: bool
    bytes: Count | None
    seconds: Known


def _counted(asked: StructureSearch, by_links: Mapping[int, int]) -> StructureCount:
    numbers = {str(links): number for links, number in by_links.items()}
    return StructureCount(asked.sets, sum(by_links.values()), numbers)


def _expected_count(asked: StructureSearch, output: str | None, *, listed: bool) -> int:
    """Estimate the number of schemes; print a long duration, and check the disk space.

    Raises
    ------
    ReadError
    """
    if asked.sets <= QUICK_SETS:
        return 0
    estimated = estimate(asked, listed=listed)
    check_room(estimated.bytes, output, "--count, --classes, --links, or another disk")
    if estimated.seconds > LONG:
        size = f", {size_text(estimated.bytes)}" if listed else ""
        text = (
            f"{about(estimated.total)} schemes{size}, in about {duration_text(estimated.seconds)}"
        )
        files.show([Problem("N003", text)])
    return round(estimated.total)


def _known(asked: StructureSearch, *, listed: bool) -> CommandEstimate:
    """Estimate the number, size and duration of schemes."""
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
