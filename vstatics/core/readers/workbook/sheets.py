"""Sheets of a case in a workbook, and the conversion of texts and paths to cells and back.

A cell whose text begins with a bracket, a brace or a double quote is read as YAML, so that a cell
can contain a list. Every other cell is a plain text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from vstatics.core.elements.keys import with_elements
from vstatics.core.errors import Path
from vstatics.core.model.keys import CASE, ELEMENT, GEAR, MECHANISM
from vstatics.core.model.paths import PathPart, in_quotes, split, written
from vstatics.core.model.shape import ByKey, ByKind, ByName

CASE_SHEET = "case"
"""Name of the sheet of paths and values, for all keys that have no separate sheet."""
LINKS = "links"
"""Name of the sheet with the names of links, in a single column."""
GEARS = "gears"
"""Name of the sheet of gears, whose columns can be shift elements."""
ENGAGED = "x"
MARKS = {
    **dict.fromkeys([ENGAGED, "\u0445", "\u00d7"], True),  # Latin and Cyrillic x, times
    **dict.fromkeys(["true", "yes", "да", "●", "✓", "✔"], True),
    **dict.fromkeys(["-", "\u2013", "\u2014", "\u2212"], False),
    **dict.fromkeys(["false", "no", "нет", "·"], False),
}
"""Marks in a shift table, including those that `vstatics run` prints: True if engaged."""
LONGEST_NUMBER = 9
"""Maximum number of digits of an item number."""

Part = str | int
"""Part of a path: a key, or the number of an item from 1."""

_SPECIAL = ("[", "{", '"')
_WORDS = frozenset({"", "~", "null", "Null", "NULL"})
_UNSAFE = re.compile(
    r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufeff\ufffe\uffff]|_(?=x[0-9A-Fa-f]{4}_)"
)
"""Pattern of characters that XML, YAML or spreadsheets would change, such as `_x000a_`."""
_ITEM = re.compile(rf"(.*?)((?:\[\d{{1,{LONGEST_NUMBER}}}\])+)\Z", re.DOTALL)


class PartSheet(NamedTuple):
    """Declaration of a sheet with a row for each part; the first column contains the name."""

    first: dict[str, Path]
    """Headings that come first, each with its path."""
    known: frozenset[str]
    """Keys with which the path in a heading can begin."""


def _keys(shape: ByKey) -> frozenset[str]:
    return frozenset(key.name for key in shape.keys)


def _of_elements() -> frozenset[str]:
    [key] = (key for key in with_elements(CASE).keys if key.name == "elements")
    assert isinstance(key.shape, ByName)  # noqa: S101 (as declared)
    assert isinstance(key.shape.item, ByKind)  # noqa: S101
    return frozenset().union(*map(_keys, key.shape.item.records.values()))


PART_SHEETS = {
    "shift_elements": PartSheet({"first": ("links", 1), "second": ("links", 2)}, _keys(ELEMENT)),
    "mechanisms": PartSheet({}, _keys(MECHANISM)),
    "elements": PartSheet({}, _of_elements()),
    GEARS: PartSheet({}, _keys(GEAR)),
}
"""Sheets of parts by the key in a case."""
SHEETS = (CASE_SHEET, LINKS, *PART_SHEETS)


def text_cell(text: str) -> str:
    r"""Return a text as a cell, in quotes if the plain text would have another meaning.

    >>> text_cell("sun"), text_cell("[1] a"), text_cell(" a\r")
    ('sun', '"[1] a"', '" a\\r"')
    """
    plain = text.replace("\n", "").replace("\t", "")
    safe = not _UNSAFE.search(plain) and text == text.strip() and text not in _WORDS
    return text if safe and not text.startswith(_SPECIAL) else flow_cell(text)


def flow_cell(value: Any) -> str:
    """Return plain data as a single line that is valid JSON and YAML.

    >>> flow_cell([["a", 2.5], []])
    '[["a", 2.5], []]'
    """
    text = json.dumps(value, ensure_ascii=False)
    return _UNSAFE.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


def is_flow(text: str) -> bool:
    """Return whether the text of a cell is read as YAML.

    >>> is_flow("[[0, 1]]"), is_flow("3000 rpm")
    (True, False)
    """
    return text.startswith(_SPECIAL)


def can_be_path(keys: Sequence[str]) -> bool:
    """Return whether keys can be written as a path: not empty, and without both kinds of quotes."""
    return not any(not key or ('"' in key and "'" in key) for key in keys)


def path_cell(parts: Sequence[Part]) -> str:
    """Return a path as a cell, with item numbers in brackets.

    >>> path_cell(("teeth", "sun")), path_cell(("speeds", "a.b")), path_cell(("points", 2, 1))
    ('teeth.sun', 'speeds."a.b"', 'points[2][1]')
    """
    path = ""
    for part in parts:
        path += f"[{part}]" if isinstance(part, int) else "." * bool(path) + written([part])
    return path


def quoted_path_cell(parts: Sequence[Part]) -> str:
    """Return a path as a cell with a quoted first key, which distinguishes it from shift elements.

    >>> quoted_path_cell(("speeds", "C1"))
    '"speeds".C1'
    """
    below = path_cell(parts[1:])
    dot = "." if below and not below.startswith("[") else ""
    return f"{in_quotes(str(parts[0]))}{dot}{below}"


def path_parts(text: str) -> Path:
    """Split the path in a cell into parts.

    Raises
    ------
    NoValueError
        If the text is not a path.

    Examples
    --------
    >>> path_parts('speeds."a[1]".x'), path_parts("points[2][1]")
    (('speeds', 'a[1]', 'x'), ('points', 2, 1))
    """
    return tuple(item for part in split(text) for item in _with_items(part, text))


def _with_items(part: PathPart, text: str) -> Path:
    """Return the key of a part of a path, followed by item numbers in brackets."""
    items = None if text[part.at] in "\"'" else _ITEM.fullmatch(part.name)
    if items is None:
        return (part.name,)
    return (*filter(None, [items[1].strip()]), *map(int, re.findall(r"\d+", items[2])))
