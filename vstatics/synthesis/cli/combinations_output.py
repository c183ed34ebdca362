"""Output of `vstatics synth combinations`: estimates, JSON and tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from operator import attrgetter
from typing import NamedTuple

import click

from vstatics.core.cli.shared import files, one_case, texts
from vstatics.core.cli.shared.estimates import CommandEstimate, size_text
from vstatics.core.cli.shared.estimates import check_room as check_disk_room
from vstatics.core.cli.shared.files import file_name
from vstatics.core.cli.shared.formats import Destination
from vstatics.core.cli.shared.one_case import CaseAnswer
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.progress import Advance, progress
from vstatics.core.errors import listed
from vstatics.core.tables.answer import Count, json_keys, line
from vstatics.core.tables.grid import Grid
from vstatics.core.tables.grid import text as words
from vstatics.synthesis.gears.kinds import EngagedSet, combination_grids
from vstatics.synthesis.gears.search import CombinationSearch, count_text

Batch = Sequence[EngagedSet]
"""Combinations of shift elements that are calculated together."""
STREAMED = ("json", "jsonl")
"""Formats that are written during the search."""
MOST_PRINTED_ROWS = 200_000
"""Largest number of rows of a printed table."""
FRAME = '{"combinations": [\n ', ",\n ", "\n]}\n"
FRAME_OF_PORTS = '{"ports": [\n ', ",\n ", "\n]}\n"
"""Text before, between and after the entries of JSON: combinations, or pairs of input and output.
"""


def check_room(search: CombinationSearch, to: Destination, *, by_torque: bool) -> None:
    """Refuse too long tables, sorting of too many rows, and a file without enough disk space.

    Raises
    ------
    UsageError, ReadError
    """
    is_streamed = to.form in STREAMED
    if search.count > MOST_PRINTED_ROWS and (by_torque or not is_streamed):
        what = f"{to.form} with --sort" if by_torque else to.form
        message = f"{what} is for {MOST_PRINTED_ROWS} rows at most, not for {search.count}"
        without = ", without --sort" if by_torque else ""
        raise click.UsageError(f"{message}: expected -f json or jsonl{without}")
    if is_streamed:
        check_disk_room(_length(search) * search.count, to.output, "--engaged or --shift-elements")


def _length(search: CombinationSearch) -> float:
    lines = [line for batch in search.samples() for line in _lines([*batch.each()])]
    return sum(len(line.encode()) + 3 for line in lines) / len(lines)


@json_keys("elements", "engaged", count="total", bytes="bytes", seconds="seconds")
class CombinationEstimate(NamedTuple):
    """Estimated output of a search for combinations, before any combination is tried."""

    elements: Sequence[str]
    """Names of the shift elements to choose from."""
    engaged: Sequence[Count]
    total: float
    """Number of combinations. The key in JSON is `count`."""
    bytes: float
    """Approximate size as JSON [bytes]."""
    seconds: float


def estimate(search: CombinationSearch) -> CommandEstimate:
    """Estimate the number of combinations, the size of the output and the time of the search."""
    names, engaged = [element.name for element in search.elements], search.sizes
    size = _length(search) * search.count
    rows = {
        "elements": f"{search.choice}: {listed(names)}",
        "engaged": ", ".join(map(str, engaged)),
        "combinations": count_text(search.count),
        "size": f"about {size_text(size)} of JSON",
    }
    length = round(size) if math.isfinite(size) else math.inf
    answer = CombinationEstimate(names, engaged, search.count, length, search.seconds())
    return CommandEstimate(rows, answer, answer.seconds)


def show_estimate(search: CombinationSearch, case: str, to: Destination) -> None:
    """Write the estimate as lines of text, as a JSON object or as a table."""
    known = estimate(search)
    if to.form in (*STREAMED, "text"):
        files.write_output(known.text(to.form), to.output)
        return
    grid = Grid("Estimate", [words(""), words("")], [[*row] for row in known.rows.items()])
    one_case.show(case, to, search.case.name, CaseAnswer(lambda: [grid], {}))


def show(
    search: CombinationSearch, case: str, to: Destination, telling: Telling, *, by_torque: bool
) -> None:
    """Write all combinations. JSON is written during the search unless sorted."""
    with progress(
        int(search.count), "combinations", beside_stdout=to.output is None, quiet=telling.quiet
    ) as advance:
        if to.form in STREAMED:
            with files.stream(to.output) as write:
                batches = _batches(search, advance, by_torque=by_torque)
                for text in _json(batches, as_lines=to.form == "jsonl"):
                    write(files.encoded(text))
            return
        title = search.case.name or file_name(case)
        sets = chain.from_iterable(_batches(search, advance, by_torque=by_torque))
        shown = texts.CaseOutput([title], {}, lambda: combination_grids(sets))
        files.write_pages(texts.alone(file_name(case), shown, to), to.output)


def show_ports(
    searches: Sequence[CombinationSearch],
    case: str,
    to: Destination,
    telling: Telling,
    *,
    by_torque: bool,
) -> None:
    """Write the combinations of each pair of ports; in `jsonl`, a line for each pair."""
    count = int(sum(search.count for search in searches))
    with progress(
        count, "combinations", beside_stdout=to.output is None, quiet=telling.quiet
    ) as advance:
        if to.form in STREAMED:
            first, between, last = ("", "\n", "\n") if to.form == "jsonl" else FRAME_OF_PORTS
            with files.stream(to.output) as write:
                for number, search in enumerate(searches):
                    batches = _batches(search, advance, by_torque=by_torque)
                    block = _block(search, batches, as_line=to.form == "jsonl")
                    write(files.encoded((between if number else first) + block))
                write(files.encoded(last))
            return
        grids = [
            grid
            for search in searches
            for grid in _port_grids(search, _batches(search, advance, by_torque=by_torque))
        ]
        title = searches[0].case.name or file_name(case)
        shown = texts.CaseOutput([title], {}, lambda: grids)
        files.write_pages(texts.alone(file_name(case), shown, to), to.output)


def _ports(search: CombinationSearch) -> tuple[str, str]:
    case = search.case
    return case.link_name(case.input), case.link_name(case.output)


def _block(search: CombinationSearch, batches: Iterable[Batch], *, as_line: bool) -> str:
    first, last = (line(name).rstrip() for name in _ports(search))
    before, between = ("", ", ") if as_line else ("\n  ", ",\n  ")
    body = before + between.join(text for batch in batches for text in _lines(batch))
    return f'{{"input": {first}, "output": {last}, "combinations": [{body}]}}'


def _port_grids(search: CombinationSearch, batches: Iterable[Batch]) -> Iterator[Grid]:
    first, last = _ports(search)
    for grid in combination_grids(chain.from_iterable(batches)):
        yield grid._replace(title=f"{grid.title}, {first} to {last}", key="")


def _batches(search: CombinationSearch, advance: Advance, *, by_torque: bool) -> Iterator[Batch]:
    if by_torque:
        unsorted = _batches(search, advance, by_torque=False)
        yield sorted(chain.from_iterable(unsorted), key=attrgetter("by_torque"))
        return
    for batch in search.batches():
        yield [*batch.each()]
        advance(len(batch.members))


def _json(batches: Iterable[Batch], *, as_lines: bool) -> Iterator[str]:
    """Yield JSON text in pieces: a document, or a line for each combination."""
    first, between, last = ("", "\n", "\n") if as_lines else FRAME
    before = first
    for batch in batches:
        yield before + between.join(_lines(batch))
        before = between
    yield last


def _lines(batch: Batch) -> Iterator[str]:
    engaged = {name for combination in batch for name in combination.engaged}
    names = {name: line(name).rstrip() for name in engaged}
    for combination in batch:
        listed_names = ", ".join(map(names.__getitem__, combination.engaged))
        is_free = "true" if combination.free else "false"
        text = f'{{"engaged": [{listed_names}], "kind": "{combination.kind}", '
        text += f'"ratio": {_number(combination.ratio)}, "free": {is_free}'
        if combination.torques is not None:
            torques = (
                f"{names[name]}: {_number(part)}" for name, part in combination.torques.items()
            )
            text += f', "torques": {{{", ".join(torques)}}}'
        yield text + (
            f', "slip": {_number(combination.slip)}}}' if combination.slip is not None else "}"
        )


def _number(value: float) -> str:
    return repr(value) if math.isfinite(value) else "null"
