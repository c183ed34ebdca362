"""What `vstatics synth box` writes: its result as one text, or a directory with all found boxes."""

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
"""The result in a directory, by format."""
MOST_DRAWN_CASES = 300
"""So many boxes have a diagram, which is most of the time in which they are written."""
CASE_SECONDS, DIAGRAM_SECONDS = 0.002, 0.15
"""Of a processor, about, for the files of a box of two sets."""
OWN = re.compile(r"box-\d{4,}\.(yaml|svg)|boxes\.(svg|html|csv|json|txt)")
"""Names of files of a search; those of an earlier one are removed."""
RECORD = ".vstatics-boxes"
"""Has the hash of each file as a search has written it, so that what is edited is not lost."""


@dataclass(frozen=True)
class FoundBoxes:
    """What a search has given."""

    search: BoxSearch
    searched: int
    with_ratios: int
    """So many boxes have the ratios, whether they are wanted or not."""
    boxes: tuple[RankedBox, ...]
    """Those that are wanted, in their order."""
    given_up: int
    """Choices of shift elements that may be boxes, too."""

    @cached_property
    def listing(self) -> BoxListing:
        """As it is answered; its cases take some time."""
        boxes = tuple(starmap(listed_box, enumerate(self.boxes, 1)))
        return BoxListing(self.searched, boxes, self.given_up, wanted_of(self.search))

    @property
    def title(self) -> str:
        """What was searched for."""
        search = self.search
        sets = f"{search.sets} {plural('set', search.sets)}"
        elements = f"{search.elements} {plural('element', search.elements)}"
        return f"{sets}, {elements}, {search.engaged} engaged"

    def text(self, form: str, style: TextStyle) -> bytes:
        """The result in a format; in JSON lines each box is one."""
        own = {
            "json": lambda _: as_json(self.listing, "json"),
            "jsonl": lambda _: "".join(as_json(one, "jsonl") for one in self.listing.boxes),
        }
        return self._text(
            form, style, own, lambda: box_grids(self.searched, self.boxes, self.given_up)
        )

    def table(self, style: TextStyle) -> bytes:
        """All boxes as a table in CSV."""
        return self._text("csv", style, {}, lambda: iter([all_boxes(self.boxes)]))

    def _text(
        self,
        form: str,
        style: TextStyle,
        own: Mapping[str, Callable[[str | None], str]],
        grids: Callable[[], Iterator[Grid]],
    ) -> bytes:
        shown = CaseOutput([self.title], own, grids)
        [made] = texts.alone(self.title, shown, Destination(form, None, style))
        return made


class BoxFiles(NamedTuple):
    """What the files of a box are made of."""

    name: str
    """Without suffix."""
    case: Transmission
    is_drawn: bool


def write_folder(
    folder: str, found: FoundBoxes, style: TextStyle, called: Workers, *, quiet: bool
) -> None:
    """Write all found boxes into a directory: cases, diagrams, tables, a page.

    Raises
    ------
    OSError
        If a file can't be written.
    """
    from vstatics.synthesis.report.boxes import box_pages

    os.makedirs(folder, exist_ok=True)  # noqa: PTH103
    items = _items(found)
    own: dict[str, str] = {}
    state = StateFolder(folder, has_results=True)
    with (
        state.appending(RECORD) as record,
        progress(len(items) + 1, "boxes written", quiet=quiet) as advance,
    ):

        def put(name: str, content: bytes) -> None:
            own[name] = hash_of(content)
            record(f"\n{own[name]}".encode())  # before it is there, so a killed one can go on
            _put(folder, name, content)

        for item, contents in called.each(box_files, items):
            for suffix, content in contents.items():
                put(f"{item.name}{suffix}", content)
            advance(1)
        pages = box_pages(found.listing) if found.boxes else {}
        for name, content in pages.items():
            put(name, content)
        advance(1)
        _forget(folder, own)
        put("boxes.csv", found.table(TextStyle(raw=style.raw)))
        for form, name in TABLES.items():  # the document last: where it is all is
            put(name, found.text(form, style))
    state.replace(RECORD, "".join(f"{known}\n" for known in own.values()).encode())
    if found.boxes and not quiet and (lacking := missing("plot", "a diagram")):
        files.say(f"warning: {folder}: no box has a diagram: {lacking} [E014]")
    elif len(items) > MOST_DRAWN_CASES and not quiet:
        some = "those of the Pareto list, the first of each family, and the next in order"
        files.say(f"{folder}: {MOST_DRAWN_CASES} of {len(items)} boxes have a diagram: {some}")


def drawn_count(boxes: int) -> int:
    """Return how many boxes have a diagram: none without the extra for pictures."""
    return 0 if missing("plot", "a diagram") else min(boxes, MOST_DRAWN_CASES)


def writing_seconds(boxes: int) -> float:
    """About how long one process writes so many boxes.

    >>> round(writing_seconds(2000))
    49
    """
    return boxes * CASE_SECONDS + drawn_count(boxes) * DIAGRAM_SECONDS


def _items(found: FoundBoxes) -> list[BoxFiles]:
    """Each box with its name; not more of them are drawn than anybody can look at."""
    numbers = range(1, len(found.boxes) + 1)
    drawn, count = set(numbers), drawn_count(len(numbers))
    if count < len(drawn):
        drawn = {box.number for box in drawn_boxes(found.listing, count)}
    width = max(4, len(str(len(found.boxes))))
    return [
        BoxFiles(f"box-{number:0{width}}", box.found.case, number in drawn)
        for number, box in zip(numbers, found.boxes, strict=True)
    ]


def box_files(_: BoxWork, item: BoxFiles) -> dict[str, bytes]:
    """The files of a box by their suffixes: its case, and its stick diagram."""
    data, _lost = case_data(item.case, "yaml")
    made = {".yaml": data}
    if item.is_drawn:
        from vstatics.synthesis.pictures.stick import stick_diagram

        made[".svg"] = stick_diagram(item.case)
    return made


def _put(folder: str, name: str, content: bytes) -> None:
    """Write a file; a link of that name goes, and the file that it leads to stays as it is."""
    path = os.path.join(folder, name)  # noqa: PTH118
    if os.path.islink(path):  # noqa: PTH114
        os.unlink(path)  # noqa: PTH108
    replace(path, content)


def of_others(folder: str) -> str:
    """A file with a name that a search gives, but not as one wrote it; "" if there is none."""
    if not os.path.isdir(folder):  # noqa: PTH112
        return ""
    known = frozenset[str]()
    with suppress(OSError), StateFolder(folder, has_results=True).reading(RECORD) as record:
        known = frozenset(record.read().decode(errors="replace").split())
    for name in sorted(filter(OWN.fullmatch, os.listdir(folder))):  # noqa: PTH208
        path = os.path.join(folder, name)  # noqa: PTH118
        if not os.path.islink(path) and hash_of_file(path) not in known:  # noqa: PTH114
            return name
    return ""


def _forget(folder: str, kept: Container[str]) -> None:
    """Remove files of an earlier search."""
    for name in os.listdir(folder):  # noqa: PTH208
        if OWN.fullmatch(name) and name not in kept:
            os.unlink(os.path.join(folder, name))  # noqa: PTH108, PTH118
