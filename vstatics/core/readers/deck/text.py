"""Text of a deck: the encoding, and the places of the fields.

A field is recognised only at the start of a line, by a name before ``(`` or ``=``. The name can
contain blanks, and Cyrillic letters that look like Latin letters. All other text is prose.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from vstatics.core.errors import Place, Problem, ReadError
from vstatics.core.readers.reading import Source
from vstatics.core.readers.signs import with_plain_blanks
from vstatics.core.start import NamedTuple
from vstatics.core.tables.quantities import PRINTED

SPRINGS = "KSPR"
"""Field with the number of springs. It occurs only in listings, because decks have no springs."""
SPRING = "SPRING "
"""Beginning of the line of each spring, below the field `SPRINGS`."""
SCALARS = {"KJG", "KL", "KG", "KNM", "NP", "INP", "IOUT", "IDLE", "COAST", SPRINGS}
"""Fields with a single value and without an index list. A line can contain several such fields."""

LISTS = {
    *("NZF", "NZD", "IAB", "ETAI", "NNM", "UAQ", "KFRI", "NFRI"),
    *("KWZ", "NWZ", "WZ", "KMZ", "NMZ", "AMZ"),
}
GEAR_LISTS = {"INP": "INP(I)", "IOUT": "IOUT(I)"}
"""Lists that have the name of a scalar field, and are recognised by an index list."""

PARTS = {"NZF": ("1", "2"), "NZD": ("1", "2", "3")}
"""Fields that consist of several lists with different second indices."""

LATIN = str.maketrans("АВЕКМНОРСТУХІЈЅԚԜ", "ABEKMHOPCTYXIJSQW")

_LETTERS = r"[^\W\d_](?:\s*[^\W\d_])*"
_BOUND = rf"(?:[0-9]+|{_LETTERS}(?:\s*\([^()]*\))?)"
INDEX_LIST = re.compile(
    rf"\s*\(([^()]*)\)(?:[\s)]*,\s*[^\W\d_]\s*=\s*[0-9]+\s*,\s*{_BOUND})*[\s)]*([:=]?)"
)
NAME_LINE = r"\s*N\s*A\s*M\s*E\s+([A-Z])\s*([0-9]*)\s*"
WORD = re.compile(r"[^\s,;()]+")


class Field(NamedTuple):
    """Field of a deck, and the place of the values."""

    key: str
    line: int
    column: int
    value: int
    """Offset of the first value in the line."""
    end: int | None = None
    """Offset of the end of the values, if a second field follows on the line."""


class Scan:
    """Fields and names found in a text, in order, with errors."""

    def __init__(self, source: Source, last: int) -> None:
        """Create an empty scan; `last` is the number of the last line of the input."""
        self.source = source
        self.last = last
        self.result = 0
        """Number of the line at which results begin and the deck ends; 0 without results."""
        self.fields: dict[str, Field] = {}
        self.stops: list[int] = []
        """Numbers of lines with a field or a name, where the values of the previous field end."""
        self.names: list[tuple[str, str, str, int, int]] = []
        """Kind, number and name of each line such as ``NAME F3: C1``, with line and column."""
        self.unknown: dict[str, int] = {}
        """Line of each unknown word in the position of a field name, for hints."""
        self.broken: set[str] = set()
        """Names of fields with a wrong second index."""
        self.problems: list[Problem] = []

    def error(self, message: str, line: int, column: int = 1) -> None:
        """Add an error at a place."""
        self.problems.append(Problem("E102", message, place=self.source.place(line, column)))


def latin(text: str) -> str:
    """Return a text in upper case, with Latin letters instead of similar Cyrillic letters."""
    return text.upper().translate(LATIN)


def texts(data: bytes, file: str) -> Iterator[tuple[str, list[Problem]]]:
    """Yield the text of a file in each possible encoding, the most likely first.

    Raises
    ------
    ReadError
        If the file contains no text.
    """
    if data.startswith((b"\xff\xfe", b"\xfe\xff", b"\0\0\xfe\xff")):
        kind = "UTF-32" if b"\0\0" in data[:4] else "UTF-16"
        raise _unreadable(file, f"the file is {kind} text, expected UTF-8: save it as UTF-8")
    # end of a DOS file; the rest of its last block is undefined
    data, _, _ = data.partition(b"\x1a")
    if b"\0" in data:
        raise _unreadable(
            file, "the file is binary, expected a deck as text: save it as text in UTF-8"
        )
    try:
        yield with_plain_blanks(data.removeprefix(BOM_UTF8).decode()), []
    except UnicodeDecodeError as error:
        from vstatics.core.readers.deck.encodings import in_each_encoding  # costs start-up time

        for text in in_each_encoding(data):
            yield with_plain_blanks(text), []
        yield _damaged(data, error.start, file)


def _unreadable(file: str, message: str) -> ReadError:
    return ReadError("E103", message, place=Place(file, 1, 1))


def _damaged(data: bytes, start: int, file: str) -> tuple[str, list[Problem]]:
    """Return the text of damaged UTF-8, such as a truncated file, with an error."""
    before = Source(file, data[:start].decode("utf-8-sig")).lines
    text = data.decode("utf-8-sig", errors="replace")
    message = f"byte 0x{data[start]:02X} is not UTF-8 here: the file is damaged or cut off"
    return text, [
        Problem("E104", message, place=Source(file, text).place(len(before), len(before[-1]) + 1))
    ]


def decode(data: bytes, file: str) -> str:
    """Return the text of a deck or report, in the encoding in which most lines start with a field.

    Raises
    ------
    ReadError
        If the file contains no text.
    """

    def names(text: str) -> int:
        return sum(head(line) != "" for line in Source(file, text).lines)

    return max((text for text, _ in texts(data, file)), key=names)


def holds_deck(data: bytes) -> bool:
    """Return whether any line of a file starts with the name of a field of a deck."""
    try:
        return any(scan(Source("", text)).fields for text, _ in texts(data, ""))
    except ReadError:
        return False


def head(line: str) -> str:
    """Return the name of the field or result at the start of a line; empty for other lines.

    >>> head("N ZD(I,1),I=1,K G : 1 1 4"), head("WSAT(K,I) ..."), head("W = 3"), head("number")
    ('NZD', 'WSAT', '', '')
    """
    kind, word, _ = _opening(line)
    return word if kind else ""


def scan(source: Source) -> Scan:
    """Return the fields and the names of a deck."""
    result = Scan(source, len(source.lines))
    for number, line in enumerate(source.lines, 1):
        kind, what = _meaning(line) if len(line) <= KEPT_CHARACTERS else _read_line(line)
        if kind == "result":
            result.last, result.result = number - 1, number
            _only_report(result, number)
            break
        if kind == "fields":
            for key, column, value, end in what:
                _add(result, Field(key, number, column, value, end))
        elif kind == "broken":
            name, column, message = what
            result.error(message, number, column)
            result.stops.append(number)
            result.broken.add(name)
        elif kind == "name":
            result.stops.append(number)
            *words, column = what
            result.names.append((*words, number, column))
        elif kind == "word" and len(result.unknown) < 50:
            result.unknown.setdefault(what, number)
    while result.last > 1 and not source.lines[result.last - 1].strip():
        result.last -= 1
    return result


def _read_line(line: str) -> tuple[str, Any]:
    """Return the kind and the content of a line; neither depends on other lines.

    The kinds (with contents) are: ``result``, ``fields`` (for each its key, column, and offsets of
    values), ``broken`` for a wrong field (name, column, message), ``name`` (kind, number, text,
    column), ``word`` for an unknown word in the position of a field, and an empty text for other
    lines.
    """
    kind, word, start = _opening(line)
    if kind == "result":
        return kind, None
    if kind == "scalar":
        return "fields", _scalars(line)
    if kind == "list":
        return _list(line, start, word)
    match = _name_line(line)
    if match is not None:
        return "name", (*match, len(line) - len(line.lstrip()) + 1)
    return ("word", word) if word.isascii() and 0 < len(word) < 8 else ("", None)


KEPT_CHARACTERS = 200
"""Largest number of characters of a line whose meaning is cached. Many decks have equal short
lines.
"""
_meaning = lru_cache(maxsize=2000)(_read_line)


def _only_report(result: Scan, first: int) -> None:
    """Add an error if a second report follows the first."""
    for number, line in enumerate(result.source.lines[first:], first + 1):
        if head(line) == "KJG":
            result.error("KJG: another case begins here, expected a single case in a file", number)
            return


def _opening(line: str) -> tuple[str, str, int]:
    """Return the kind of a line, the first word, and the offset of the `(` or `=` after the word.

    The kinds are ``scalar``, ``list``, ``result`` and an empty text.
    """
    start = len(line) - len(line.lstrip())
    start += line.startswith("(", start)
    ends = [end for end in (line.find("(", start), line.find("=", start)) if end >= 0]
    if not ends or min(ends) - start > 40:  # names are short, even with stray blanks
        return "", "", start
    end = min(ends)
    word, opens = latin("".join(line[start:end].split())), line[end] == "("
    if opens and word in PRINTED and _is_index(line, end):
        kind = "result"
    elif not opens and word in SCALARS:
        kind = "scalar"
    else:
        kind = "list" if word in LISTS or (opens and word in GEAR_LISTS) else ""
    return kind, word, end


def _is_index(line: str, start: int) -> bool:
    match = INDEX_LIST.match(line, start)
    index = "" if match is None else _squeezed(match).replace(",", "0")
    return index.isascii() and index.isalnum()


def _squeezed(match: re.Match[str]) -> str:
    return latin("".join(match[1].split()))


def _add(result: Scan, new: Field) -> None:
    """Add a field, or an error if the deck already contains the field."""
    if not result.stops or result.stops[-1] != new.line:
        result.stops.append(new.line)
    first = result.fields.setdefault(new.key, new)
    if first is not new:
        before = f"line {first.line}, column {first.column}"
        result.error(
            f"{new.key}: given again, first given in {before}; expected once", new.line, new.column
        )


def _scalars(line: str) -> tuple[tuple[str, int, int, int | None], ...]:
    """Return all scalar fields of a line such as ``KJG= 6 KL= 5 KG= 3 KNM = 2``."""
    heads = []
    before = 0
    for equals in re.finditer("=", line):
        words = list(WORD.finditer(line, before, equals.start()))[-5:]
        for word in range(len(words)):
            key = latin("".join(part[0] for part in words[word:]))
            if key in SCALARS:
                heads.append((key, words[word].start(), equals.end()))
                break
        before = equals.end()
    ends = [*(start for _, start, _ in heads[1:]), None]
    return tuple(
        (key, start + 1, value, end) for (key, start, value), end in zip(heads, ends, strict=True)
    )


def _list(line: str, start: int, name: str) -> tuple[str, Any]:
    """Read the name of a list such as ``IAB(I),I=1,KG:``; colon and index list can be missing."""
    column = len(line) - len(line.lstrip()) + 1
    key, value, index = GEAR_LISTS.get(name, name), start + 1, ""
    if line[start] == "(":
        match = INDEX_LIST.match(line, start)
        if match is not None:
            value, index = match.end(), _squeezed(match)
        if match is None or not match[2]:  # the colon is missing, or the index list is wrong
            colon = line.find(":", value)
            starts_value = line[value:].lstrip(" \t,").startswith(tuple("-+.0123456789"))
            value = value if colon < 0 or starts_value else colon + 1
    if name in PARTS:
        parts = PARTS[name]
        part = index.partition(",")[2]
        if part not in parts:
            expected = " or ".join(f"{name}(I,{part})" for part in parts)
            read = f"{name}({index})" if index else line.strip()[:30]
            return "broken", (name, column, f"{name}: read '{read}', expected {expected}")
        key = f"{name}(I,{part})"
    return "fields", ((key, column, value, None),)


def _name_line(line: str) -> tuple[str, str, str] | None:
    """Return kind, number and name of a line such as ``NAME F3: C1``; None for other lines."""
    before, colon, name = line.partition(":")
    short = colon and len(before) < 40 and before.lstrip()[:1] in ("N", "n")
    match = re.fullmatch(NAME_LINE, latin(before)) if short else None
    if match is None or not (match[2] or match[1] == "T"):
        return None
    return match[1], match[2], name.strip()
