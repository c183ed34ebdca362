"""Which sheets a case in a workbook has, and how texts and paths stand in their cells.

A text that begins with a bracket, a brace or a double quote is read as YAML has it, so a list
stands in one cell; whatever else stands in a cell is a text as it is.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from vstatics.core.elements.keys import with_elements
from vstatics.core.model.keys import CASE, ELEMENT, GEAR, MECHANISM
from vstatics.core.model.paths import PathPart, in_quotes, split, written
from vstatics.core.model.shape import ByKey, ByKind, ByName

CASE_SHEET = "case"
"""Of paths and values: what has no sheet of its own."""
LINKS = "links"
"""Of names alone."""
GEARS = "gears"
"""Whose columns are shift elements, too."""
ENGAGED = "x"
MARKS = dict.fromkeys([ENGAGED, "\u0445", "\u00d7", "true"], True)  # the x of Russian, of times
MARKS |= dict.fromkeys(["-", "\u2013", "\u2014", "\u2212", "false"], False)
"""Whether an element is engaged, by what stands in a shift table in place of a number."""
LONGEST_NUMBER = 9
"""Digits of the number of an item; nothing has so many items."""

Part = str | int
"""Of a path: a key, or the number of an item from 1."""

_SPECIAL = ("[", "{", '"')
_WORDS = frozenset({"", "~", "null", "Null", "NULL"})
_UNSAFE = re.compile(
    r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufeff\ufffe\uffff]|_(?=x[0-9A-Fa-f]{4}_)"
)
"""What XML, YAML or a spreadsheet program would change; `_x000a_` is a character to these."""
_ITEM = re.compile(rf"(.*?)((?:\[\d{{1,{LONGEST_NUMBER}}}\])+)\Z", re.DOTALL)


class PartSheet(NamedTuple):
    """A sheet with a row for each part of a case, its name in the first column."""

    first: dict[str, tuple[Part, ...]]
    """Headings that always stand first, and the paths that they are."""
    known: frozenset[str]
    """Keys with which the path of a heading begins."""


def _keys(shape: ByKey) -> frozenset[str]:
    return frozenset(key.name for key in shape.keys)


def _of_elements() -> frozenset[str]:
    [key] = (key for key in with_elements(CASE).keys if key.name == "elements")
    assert isinstance(key.shape, ByName)  # noqa: S101 - so they are declared
    assert isinstance(key.shape.item, ByKind)  # noqa: S101
    return frozenset().union(*map(_keys, key.shape.item.records.values()))


PART_SHEETS = {
    "shift_elements": PartSheet({"first": ("links", 1), "second": ("links", 2)}, _keys(ELEMENT)),
    "mechanisms": PartSheet({}, _keys(MECHANISM)),
    "elements": PartSheet({}, _of_elements()),
    GEARS: PartSheet({}, _keys(GEAR)),
}
"""By the key of the case that they are."""
SHEETS = (CASE_SHEET, LINKS, *PART_SHEETS)


def text_cell(text: str) -> str:
    r"""A text as it stands in a cell: in quotes where it would be taken for something else.

    >>> text_cell("sun"), text_cell("[1] a"), text_cell(" a\r")
    ('sun', '"[1] a"', '" a\\r"')
    """
    plain = text.replace("\n", "").replace("\t", "")
    safe = not _UNSAFE.search(plain) and text == text.strip() and text not in _WORDS
    return text if safe and not text.startswith(_SPECIAL) else flow_cell(text)


def flow_cell(value: Any) -> str:
    """Plain data on one line, as JSON and YAML have it.

    >>> flow_cell([["a", 2.5], []])
    '[["a", 2.5], []]'
    """
    told = json.dumps(value, ensure_ascii=False)
    return _UNSAFE.sub(lambda found: f"\\u{ord(found[0]):04x}", told)


def is_flow(text: str) -> bool:
    """Whether the text of a cell is read as YAML has it.

    >>> is_flow("[[0, 1]]"), is_flow("3000 rpm")
    (True, False)
    """
    return text.startswith(_SPECIAL)


def can_be_path(keys: Sequence[str]) -> bool:
    """Whether keys can be written in a path: none has both kinds of quotes, or is empty."""
    return not any(not key or ('"' in key and "'" in key) for key in keys)


def path_cell(parts: Sequence[Part]) -> str:
    """A path as it stands in a cell; items of lists by their numbers in brackets.

    >>> path_cell(("teeth", "sun")), path_cell(("speeds", "a.b")), path_cell(("points", 2, 1))
    ('teeth.sun', 'speeds."a.b"', 'points[2][1]')
    """
    told = ""
    for part in parts:
        told += f"[{part}]" if isinstance(part, int) else "." * bool(told) + written([part])
    return told


def quoted_path_cell(parts: Sequence[Part]) -> str:
    """The same with its first key in quotes, so that it is no name of a shift element.

    >>> quoted_path_cell(("speeds", "C1"))
    '"speeds".C1'
    """
    more = path_cell(parts[1:])
    dot = "." if more and not more.startswith("[") else ""
    return f"{in_quotes(str(parts[0]))}{dot}{more}"


def path_parts(text: str) -> tuple[Part, ...]:
    """The parts of a path that stands in a cell.

    Raises
    ------
    NoValueError
        If it is none.

    Examples
    --------
    >>> path_parts('speeds."a[1]".x'), path_parts("points[2][1]")
    (('speeds', 'a[1]', 'x'), ('points', 2, 1))
    """
    return tuple(one for part in split(text) for one in _with_items(part, text))


def _with_items(part: PathPart, text: str) -> tuple[Part, ...]:
    """A part of a path, and the items of it that are named in brackets."""
    items = None if text[part.at] in "\"'" else _ITEM.fullmatch(part.name)
    if items is None:
        return (part.name,)
    return (*filter(None, [items[1].strip()]), *map(int, re.findall(r"\d+", items[2])))
