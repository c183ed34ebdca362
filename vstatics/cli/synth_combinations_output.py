"""What `vstatics synth combinations` writes: before it begins, and what it finds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import click

from vstatics.cli import files, texts
from vstatics.cli.amounts import duration_text, size_text
from vstatics.cli.cases import CalculatedCase
from vstatics.cli.disk_room import check_room as check_disk_room
from vstatics.cli.formats import Destination
from vstatics.cli.one_case import file_name
from vstatics.cli.progress import Advance, progress
from vstatics.cli.telling import Telling
from vstatics.errors import listed
from vstatics.synthesis.combination_grids import combination_grids
from vstatics.synthesis.combination_search import CombinationSearch, count_text
from vstatics.synthesis.engaged_kinds import EngagedKind
from vstatics.synthesis.engaged_sets import EngagedSets

STREAMED = ("json", "jsonl")
"""Formats that are written as they are found."""
MOST_ROWS = 200_000
"""Of any other format."""
FRAME = '{"combinations": [\n ', ",\n ", "\n]}\n"
"""Around the entries of JSON, and between them."""


def check_room(search: CombinationSearch, to: Destination) -> None:
    """Refuse tables that nobody reads, and a file that its disk has no room for.

    Raises
    ------
    UsageError, ReadError
    """
    if to.form not in STREAMED:
        if search.count > MOST_ROWS:
            message = f"{to.form} is for {MOST_ROWS} rows at most, not for {search.count}"
            raise click.UsageError(f"{message}: expected -f json or jsonl")
        return
    check_disk_room(_length(search) * search.count, to.output, "--engaged or --elements")


def _length(search: CombinationSearch) -> float:
    """About how many bytes a combination has in JSON."""
    lines = [line for batch in search.samples() for line in _lines(batch)]
    return sum(len(line.encode()) + 3 for line in lines) / len(lines)


def estimate(search: CombinationSearch) -> str:
    """How many combinations, how large, about how long."""
    lines = {
        "elements": f"{search.choice}: {listed([one.name for one in search.elements])}",
        "engaged": ", ".join(map(str, search.sizes)),
        "combinations": count_text(search.count),
        "size": f"about {size_text(_length(search) * search.count)} of JSON",
        "time": f"about {duration_text(search.seconds())}",
    }
    return "".join(f"{name:12}  {value}\n" for name, value in lines.items())


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
        outcome = CalculatedCase(file_name(case), None, [])
        files.write_data(
            texts.alone(outcome, shown, texts.OutputForm(to.form, to.style)), to.output
        )


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
    from vstatics.writers import plain_json

    names = [plain_json.line(element.name).rstrip() for element in found.elements]
    kinds = [f'"kind": "{kind.word}"' for kind in EngagedKind]
    columns = (found.members, found.kinds, found.ratios, found.free)
    for members, kind, ratio, free in zip(*(one.tolist() for one in columns), strict=True):
        engaged = ", ".join([names[one] for one in members])
        number = repr(ratio) if math.isfinite(ratio) else "null"
        is_free = "true" if free else "false"
        yield f'{{"engaged": [{engaged}], {kinds[kind]}, "ratio": {number}, "free": {is_free}}}'
