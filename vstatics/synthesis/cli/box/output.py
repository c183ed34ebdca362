"""Output of `vstatics synth box`: a single text, or a directory with all found gearboxes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Container, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import starmap
from typing import NamedTuple

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.formats import Destination, TextStyle
from vstatics.core.cli.shared.progress import progress
from vstatics.core.cli.shared.texts import CaseOutput
from vstatics.core.errors import plural
from vstatics.core.extras import missing
from vstatics.core.jobs.alone import Workers
from vstatics.core.jobs.files import hash_of, hash_of_file, replace
from vstatics.core.jobs.state_files import StateFolder
from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.answer import as_json
from vstatics.core.tables.grid import Grid
from vstatics.core.writers.saving import case_data
from vstatics.synthesis.boxes.batches.work import BoxWork
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.choice import RankedBox
from vstatics.synthesis.boxes.listing import BoxListing, drawn_boxes, listed_box, wanted_of
from vstatics.synthesis.boxes.tables import all_boxes, box_grids

TABLES = {"text": "boxes.txt", "json": "boxes.json"}
"""Names in a directory of the files with the result, by format."""
MOST_DRAWN_CASES = 300
"""Largest number of gearboxes with a diagram. Drawing takes most of the time of writing."""
CASE_SECONDS, DIAGRAM_SECONDS = 0.002, 0.15
"""Approximate processor times for the case and the diagram of a gearbox with two gear sets. [s]"""
RESULT_NAMES = re.compile(r"box-\d{4,}\.(yaml|svg)|boxes\.(svg|html|csv|json|txt)")
"""Names of files that a search writes, and which the next search in the directory removes."""
RECORD = ".vstatics-boxes"
"""Name of the file with the hashes of all written files, by which edited files are recognised."""


@dataclass(frozen=True)
class FoundBoxes:
    """Result of a search."""

    search: BoxSearch
    searched: int
    """Number of examined gearboxes."""
    with_ratios: int
    """Number of gearboxes with the wanted ratios, before the filter."""
    boxes: tuple[RankedBox, ...]
    """Gearboxes that pass the filter, in order."""
    given_up: int
    """Number of sets of shift elements that were not examined completely, but could give gearboxes.
    """

    @cached_property
    def listing(self) -> BoxListing:
        """Record of the found gearboxes for JSON. Conversion to cases takes some time."""
        boxes = tuple(starmap(listed_box, enumerate(self.boxes, 1)))
        return BoxListing(self.searched, boxes, self.given_up, wanted_of(self.search))

    @property
    def title(self) -> str:
        """Numbers of gear sets, shift elements and engaged shift elements, as a title."""
        search = self.search
        sets = f"{search.sets} {plural('set', search.sets)}"
        elements = f"{search.elements} {plural('shift element', search.elements)}"
        return f"{sets}, {elements}, {search.engaged} of them engaged in each gear"

    def text(self, form: str, style: TextStyle) -> bytes:
        """Return the result in a format. JSON lines have a line for each gearbox."""
        by_format = {
            "json": lambda _: as_json(self.listing, "json"),
            "jsonl": lambda _: "".join(as_json(box, "jsonl") for box in self.listing.boxes),
        }
        return self._text(
            form, style, by_format, lambda: box_grids(self.searched, self.boxes, self.given_up)
        )

    def table(self, style: TextStyle) -> bytes:
        """Return all gearboxes as a table in CSV."""
        return self._text("csv", style, {}, lambda: iter([all_boxes(self.boxes)]))

    def _text(
        self,
        form: str,
        style: TextStyle,
        by_format: Mapping[str, Callable[[str | None], str]],
        grids: Callable[[], Iterator[Grid]],
    ) -> bytes:
        shown = CaseOutput([self.title], by_format, grids)
        [content] = texts.alone(self.title, shown, Destination(form, None, style))
        return content


class BoxFiles(NamedTuple):
    """Gearbox whose files are to be written."""

    name: str
    """File name without suffix."""
    case: Transmission
    is_drawn: bool


def write_folder(
    folder: str, result: FoundBoxes, style: TextStyle, called: Workers, *, quiet: bool
) -> None:
    """Write all found gearboxes into a directory: cases, diagrams, tables and a page.

    Raises
    ------
    OSError
        If a file cannot be written.
    """
    from vstatics.synthesis.report.boxes import box_pages

    os.makedirs(folder, exist_ok=True)  # noqa: PTH103
    items = _items(result)
    hashes: dict[str, str] = {}
    state = StateFolder(folder, has_results=True)
    with (
        state.appending(RECORD) as record,
        progress(len(items) + 1, "boxes written", quiet=quiet) as advance,
    ):

        def put(name: str, content: bytes) -> None:
            hashes[name] = hash_of(content)
            # The hash is recorded before the file exists, so that an interrupted search can
            # continue.
            record(f"\n{hashes[name]}".encode())
            path = os.path.join(folder, name)  # noqa: PTH118
            if os.path.islink(path):  # noqa: PTH114 (the target of a link is not changed)
                os.unlink(path)  # noqa: PTH108
            replace(path, content)

        for item, contents in called.each(box_files, items):
            for suffix, content in contents.items():
                put(f"{item.name}{suffix}", content)
            advance(1)
        pages = box_pages(result.listing) if result.boxes else {}
        for name, content in pages.items():
            put(name, content)
        advance(1)
        _remove_earlier_files(folder, hashes)
        put("boxes.csv", result.table(TextStyle(raw=style.raw)))
        # JSON is written last: if this file exists, the directory is complete.
        for form, name in TABLES.items():
            put(name, result.text(form, style))
    state.replace(RECORD, "".join(f"{known}\n" for known in hashes.values()).encode())
    if result.boxes and not quiet and (lacking := missing("plot", "a diagram")):
        files.say(f"warning: {folder}: no box has a diagram: {lacking} [E014]")
    elif len(items) > MOST_DRAWN_CASES and not quiet:
        some = "those of the Pareto list, the first of each family, and the next in order"
        files.say(f"{folder}: {MOST_DRAWN_CASES} of {len(items)} boxes have a diagram: {some}")


def drawn_count(boxes: int) -> int:
    """Return the number of gearboxes with a diagram; 0 if the packages for pictures are missing."""
    return 0 if missing("plot", "a diagram") else min(boxes, MOST_DRAWN_CASES)


def writing_seconds(boxes: int) -> float:
    """Estimate the time that a single process takes to write gearboxes [s].

    >>> round(writing_seconds(2000))
    49
    """
    return boxes * CASE_SECONDS + drawn_count(boxes) * DIAGRAM_SECONDS


def _items(result: FoundBoxes) -> list[BoxFiles]:
    numbers = range(1, len(result.boxes) + 1)
    drawn, count = set(numbers), drawn_count(len(numbers))
    if count < len(drawn):
        drawn = {box.number for box in drawn_boxes(result.listing, count)}
    width = max(4, len(str(len(result.boxes))))
    return [
        BoxFiles(f"box-{number:0{width}}", box.found.case, number in drawn)
        for number, box in zip(numbers, result.boxes, strict=True)
    ]


def box_files(_: BoxWork, item: BoxFiles) -> dict[str, bytes]:
    """Return the files of a gearbox by suffix: the case, and the stick diagram if drawn."""
    data, _lost = case_data(item.case, "yaml")
    contents = {".yaml": data}
    if item.is_drawn:
        from vstatics.synthesis.pictures.stick import stick_diagram

        contents[".svg"] = stick_diagram(item.case)
    return contents


def of_others(folder: str) -> str:
    """Return the name of a file that a search would replace but no search has written, or ""."""
    if not os.path.isdir(folder):  # noqa: PTH112
        return ""
    known = frozenset[str]()
    with suppress(OSError), StateFolder(folder, has_results=True).reading(RECORD) as record:
        known = frozenset(record.read().decode(errors="replace").split())
    for name in sorted(filter(RESULT_NAMES.fullmatch, os.listdir(folder))):  # noqa: PTH208
        path = os.path.join(folder, name)  # noqa: PTH118
        if not os.path.islink(path) and hash_of_file(path) not in known:  # noqa: PTH114
            return name
    return ""


def _remove_earlier_files(folder: str, new_names: Container[str]) -> None:
    for name in os.listdir(folder):  # noqa: PTH208
        if RESULT_NAMES.fullmatch(name) and name not in new_names:
            os.unlink(os.path.join(folder, name))  # noqa: PTH108, PTH118
