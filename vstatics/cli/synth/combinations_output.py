"""What `vstatics synth combinations` writes: before it begins, and what it finds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import click

from vstatics.cli.frame import files, one_case, texts
from vstatics.cli.frame.estimates import CommandEstimate, size_text
from vstatics.cli.frame.estimates import check_room as check_disk_room
from vstatics.cli.frame.formats import Destination
from vstatics.cli.frame.one_case import CaseAnswer, file_name
from vstatics.cli.frame.problems import Telling
from vstatics.cli.frame.progress import Advance, progress
from vstatics.errors import listed
from vstatics.synthesis.gears.kinds import EngagedSets, combination_grids
from vstatics.synthesis.gears.search import CombinationSearch, count_text
from vstatics.tables.answer import Count, line, told
from vstatics.tables.grid import Grid
from vstatics.tables.grid import text as words

STREAMED = ("json", "jsonl")
"""Formats that are written as they are found."""
MOST_PRINTED_ROWS = 200_000
"""Of any other format."""
FRAME = '{"combinations": [\n ', ",\n ", "\n]}\n"
FRAME_OF_PORTS = '{"ports": [\n ', ",\n ", "\n]}\n"
"""Around the entries of JSON, and between them; the same of pairs of ports."""


def check_room(search: CombinationSearch, to: Destination) -> None:
    """Refuse tables that nobody reads, and a file that its disk has no room for.

    Raises
    ------
    UsageError, ReadError
    """
    if to.form not in STREAMED:
        if search.count > MOST_PRINTED_ROWS:
            message = f"{to.form} is for {MOST_PRINTED_ROWS} rows at most, not for {search.count}"
            raise click.UsageError(f"{message}: expected -f json or jsonl")
        return
    check_disk_room(_length(search) * search.count, to.output, "--engaged or --elements")


def _length(search: CombinationSearch) -> float:
    """About how many bytes a combination has in JSON."""
    lines = [line for batch in search.samples() for line in _lines(batch)]
    return sum(len(line.encode()) + 3 for line in lines) / len(lines)


@told("elements", "engaged", count="total", bytes="bytes", seconds="seconds")
class CombinationEstimate(NamedTuple):
    """What is known before any combination is tried."""

    elements: Sequence[str]
    """Names of those to choose from."""
    engaged: Sequence[Count]
    total: float
    """Of combinations; `count` in JSON."""
    bytes: float
    """About so many of JSON."""
    seconds: float


def estimate(search: CombinationSearch) -> CommandEstimate:
    """How many combinations, how large, about how long."""
    names, engaged = [one.name for one in search.elements], search.sizes
    size = _length(search) * search.count
    said = {
        "elements": f"{search.choice}: {listed(names)}",
        "engaged": ", ".join(map(str, engaged)),
        "combinations": count_text(search.count),
        "size": f"about {size_text(size)} of JSON",
    }
    length = round(size) if math.isfinite(size) else math.inf
    answer = CombinationEstimate(names, engaged, search.count, length, search.seconds())
    return CommandEstimate(said, answer, answer.seconds)


def show_estimate(search: CombinationSearch, case: str, to: Destination) -> None:
    """Write it: lines as text, an object as JSON, else a table."""
    known = estimate(search)
    if to.form in (*STREAMED, "text"):
        files.write_output(known.text(to.form), to.output)
        return
    grid = Grid("Estimate", [words(""), words("")], [[*row] for row in known.rows.items()])
    one_case.show(case, to, search.case.name, CaseAnswer(lambda: [grid], {}))


def show(search: CombinationSearch, case: str, to: Destination, telling: Telling) -> None:
    """Write all combinations; JSON as they are found."""
    with progress(
        int(search.count), "combinations", beside_stdout=to.output is None, quiet=telling.quiet
    ) as advance:
        if to.form in STREAMED:
            with files.stream(to.output) as write:
                for text in _json(search, advance, as_lines=to.form == "jsonl"):
                    write(files.encoded(text))
            return
        title = search.case.name or file_name(case)
        found = (one for batch in _watched(search, advance) for one in batch.each())
        shown = texts.CaseOutput([title], {}, lambda: combination_grids(found))
        files.write_pages(texts.alone(file_name(case), shown, to), to.output)


def show_ports(
    searches: Sequence[CombinationSearch], case: str, to: Destination, telling: Telling
) -> None:
    """Write the combinations of each pair of ports; a line for each pair as `jsonl`."""
    count = int(sum(search.count for search in searches))
    with progress(
        count, "combinations", beside_stdout=to.output is None, quiet=telling.quiet
    ) as advance:
        if to.form in STREAMED:
            first, between, last = ("", "\n", "\n") if to.form == "jsonl" else FRAME_OF_PORTS
            with files.stream(to.output) as write:
                for number, search in enumerate(searches):
                    block = _block(search, advance, as_line=to.form == "jsonl")
                    write(files.encoded((between if number else first) + block))
                write(files.encoded(last))
            return
        grids = [grid for search in searches for grid in _port_grids(search, advance)]
        title = searches[0].case.name or file_name(case)
        shown = texts.CaseOutput([title], {}, lambda: grids)
        files.write_pages(texts.alone(file_name(case), shown, to), to.output)


def _ports(search: CombinationSearch) -> tuple[str, str]:
    """Their names."""
    case = search.case
    return case.link_name(case.input), case.link_name(case.output)


def _block(search: CombinationSearch, advance: Advance, *, as_line: bool) -> str:
    """The combinations of a pair of ports in JSON."""
    first, last = (line(name).rstrip() for name in _ports(search))
    found = (text for batch in _watched(search, advance) for text in _lines(batch))
    before, between = ("", ", ") if as_line else ("\n  ", ",\n  ")
    body = before + between.join(found)
    return f'{{"input": {first}, "output": {last}, "combinations": [{body}]}}'


def _port_grids(search: CombinationSearch, advance: Advance) -> Iterator[Grid]:
    """The tables of a pair of ports, which their titles name."""
    first, last = _ports(search)
    found = (one for batch in _watched(search, advance) for one in batch.each())
    for grid in combination_grids(found):
        yield grid._replace(title=f"{grid.title}, {first} to {last}", key="")


def _watched(search: CombinationSearch, advance: Advance) -> Iterator[EngagedSets]:
    for batch in search.batches():
        yield batch
        advance(len(batch.members))


def _json(search: CombinationSearch, advance: Advance, *, as_lines: bool) -> Iterator[str]:
    """JSON piece by piece: a document, or a line for each combination."""
    first, between, last = ("", "\n", "\n") if as_lines else FRAME
    before = first
    for batch in _watched(search, advance):
        yield before + between.join(_lines(batch))
        before = between
    yield last


def _lines(found: EngagedSets) -> Iterator[str]:
    """Combinations as JSON, an object each."""
    names = {element.name: line(element.name).rstrip() for element in found.elements}
    for one in found.each():
        engaged = ", ".join(map(names.__getitem__, one.engaged))
        is_free = "true" if one.free else "false"
        text = f'{{"engaged": [{engaged}], "kind": "{one.kind}", "ratio": {_number(one.ratio)}, '
        text += f'"free": {is_free}'
        if one.torques is not None:
            torques = (f"{names[name]}: {_number(part)}" for name, part in one.torques.items())
            text += f', "torques": {{{", ".join(torques)}}}'
        yield text + (f', "slip": {_number(one.slip)}}}' if one.slip is not None else "}")


def _number(value: float) -> str:
    return repr(value) if math.isfinite(value) else "null"
