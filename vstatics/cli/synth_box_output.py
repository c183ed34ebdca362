"""What `vstatics synth box` writes: its result as one text, or a directory with all found boxes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from vstatics.cli import files, texts
from vstatics.cli.cases import CalculatedCase
from vstatics.cli.convert import write
from vstatics.cli.formats import TextStyle
from vstatics.cli.progress import progress
from vstatics.cli.texts import CaseOutput, OutputForm
from vstatics.errors import plural
from vstatics.jobs.alone import Workers
from vstatics.jobs.files import replace
from vstatics.model.transmission import Transmission
from vstatics.synthesis.box import BoxSearch
from vstatics.synthesis.box_choice import RankedBox
from vstatics.synthesis.box_document import box_document
from vstatics.synthesis.box_grids import all_boxes, box_grids
from vstatics.synthesis.box_work import BoxWork
from vstatics.tables.grid import Grid
from vstatics.writers import plain_json

TABLES = {"text": "boxes.txt", "json": "boxes.json"}
"""The result in a directory, by format."""
OWN = re.compile(r"box-\d{4,}\.(yaml|svg)|boxes\.(svg|html)")
"""Names of files that not every search has; those of an earlier one are removed."""


@dataclass(frozen=True)
class FoundBoxes:
    """What a search has given."""

    search: BoxSearch
    searched: int
    with_ratios: int
    """So many boxes have the ratios, whether they are wanted or not."""
    boxes: tuple[RankedBox, ...]
    """Those that are wanted, in their order."""

    @cached_property
    def document(self) -> dict[str, Any]:
        """As plain data; its cases take some time."""
        return box_document(self.searched, self.boxes)

    @property
    def title(self) -> str:
        """What was searched for."""
        search = self.search
        sets = f"{search.sets} {plural('set', search.sets)}"
        return f"{sets}, {search.elements} elements, {search.engaged} engaged"

    def text(self, form: str, style: TextStyle) -> bytes:
        """The result in a format; in JSON lines each box is one."""
        as_json = {
            "json": lambda _: f"{plain_json.text(self.document)}\n",
            "jsonl": lambda _: "".join(map(plain_json.line, self.document["boxes"])),
        }
        return self._text(form, style, as_json, lambda: box_grids(self.searched, self.boxes))

    def table(self, style: TextStyle) -> bytes:
        """All boxes as a table in CSV."""
        return self._text("csv", style, {}, lambda: iter([all_boxes(self.boxes)]))

    def _text(
        self,
        form: str,
        style: TextStyle,
        as_json: Mapping[str, Callable[[str | None], str]],
        grids: Callable[[], Iterator[Grid]],
    ) -> bytes:
        shown = CaseOutput([self.title], as_json, grids)
        return texts.alone(CalculatedCase(self.title, None, []), shown, OutputForm(form, style))


def write_folder(
    folder: str, found: FoundBoxes, style: TextStyle, called: Workers, *, quiet: bool
) -> None:
    """Write all found boxes into a directory: cases, diagrams, tables, a page.

    Raises
    ------
    OSError
        If a file can't be written.
    """
    from vstatics.report.boxes import box_pages

    os.makedirs(folder, exist_ok=True)  # noqa: PTH103
    names = file_names(len(found.boxes))
    with progress(2 * len(names) + 1, "files", quiet=quiet) as advance:
        for name, box in zip(names, found.boxes, strict=True):
            text, _ = write(box.found.case, "yaml")
            _put(folder, f"{name}.yaml", files.encoded(text))
            advance(1)
        items = zip(names, (box.found.case for box in found.boxes), strict=True)
        for (name, _), picture in called.each(draw, items):
            _put(folder, f"{name}.svg", picture)
            advance(1)
        pages = box_pages(found.document) if found.boxes else {}
        for name, content in pages.items():
            _put(folder, name, content)
        advance(1)
    own = {f"{name}{suffix}" for name in names for suffix in (".yaml", ".svg")}
    _forget(folder, own | pages.keys())
    _put(folder, "boxes.csv", found.table(TextStyle(raw=style.raw)))
    for form, name in TABLES.items():  # the document last: where it is all is
        _put(folder, name, found.text(form, style))


def draw(_: BoxWork, item: tuple[str, Transmission]) -> bytes:
    """The stick diagram of a case with its name."""
    from vstatics.pictures.box_stick import stick_diagram

    return stick_diagram(item[1])


def file_names(count: int) -> list[str]:
    """Names of the files of so many boxes, without suffix.

    >>> file_names(2)
    ['box-0001', 'box-0002']
    """
    width = max(4, len(str(count)))
    return [f"box-{number:0{width}}" for number in range(1, count + 1)]


def _put(folder: str, name: str, content: bytes) -> None:
    replace(os.path.join(folder, name), content)  # noqa: PTH118


def _forget(folder: str, kept: AbstractSet[str]) -> None:
    """Remove files of an earlier search."""
    for name in os.listdir(folder):  # noqa: PTH208
        if OWN.fullmatch(name) and name not in kept:
            os.unlink(os.path.join(folder, name))  # noqa: PTH108, PTH118
