"""The text of a deck: its encoding, and where its fields stand.

A field counts only at the start of a line, before ``(`` or ``=``; blanks inside its
name and Cyrillic look-alikes do not matter. Everything else is prose.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from vstatics.errors import Place, Problem, ReadError
from vstatics.readers.reading import Source

SCALARS = {"KJG", "KL", "KG", "KNM", "NP", "INP", "IOUT", "IDLE", "COAST"}
"""Fields of one value; they have no index list, and may share a line."""

LISTS = {
    **{name: name for name in ("IAB", "ETAI", "NNM", "UAQ", "KFRI", "NFRI", "KWZ", "KMZ")},
    **{name: name for name in ("NWZ", "WZ", "NMZ", "AMZ")},
    "NZF": "NZF",
    "NZD": "NZD",
}
GEAR_LISTS = {"INP": "INP(I)", "IOUT": "IOUT(I)"}
"""Lists with the name of a scalar: they count only with an index list."""

PARTS = {"NZF": ("1", "2"), "NZD": ("1", "2", "3")}
"""Fields of which there are several, told apart by their second index."""

RESULTS = {
    *("AJK", "W", "WSAT", "WFRI", "AMLG", "AMLGP", "ETA", "IX"),
    *("AMWZ", "AMWZP", "RATIO", "BALANCE", "LOSS", "IDLING", "CONSISTENT", "LOCKED"),
}
"""Names of printed results: a report starts with its input, which ends here."""

LATIN = str.maketrans("АВЕКМНОРСТУХІЈЅԚԜ", "ABEKMHOPCTYXIJSQW")

_LETTERS = r"[^\W\d_](?:\s*[^\W\d_])*"
_BOUND = rf"(?:[0-9]+|{_LETTERS}(?:\s*\([^()]*\))?)"
INDEX_LIST = re.compile(
    rf"\s*\(([^()]*)\)(?:[\s)]*,\s*[^\W\d_]\s*=\s*[0-9]+\s*,\s*{_BOUND})*[\s)]*(:?)"
)
NAME_LINE = re.compile(r"\s*N\s*A\s*M\s*E\s+([A-Z])\s*([0-9]*)\s*")
WORD = re.compile(r"[^\s,;()]+")


class Field(NamedTuple):
    """A field, and where its values may stand."""

    key: str
    line: int
    column: int
    value: int
    """Offset of the first value in the line."""
    end: int | None = None
    """Offset at which the values must end, when another field follows in the line."""


class Named(NamedTuple):
    """A line ``NAME F3: C1``."""

    kind: str
    number: str
    name: str
    line: int
    column: int


@dataclass
class Scan:
    """What a text holds: its fields and names in their order, and what is wrong."""

    source: Source
    last: int
    """Number of the last line of the input."""
    fields: dict[str, Field] = field(default_factory=dict)
    stops: list[int] = field(default_factory=list)
    """Lines at which the values of the field above end: those with a field or a name."""
    names: list[Named] = field(default_factory=list)
    unknown: dict[str, int] = field(default_factory=dict)
    """Words that stand where fields do, and their lines; for hints."""
    problems: list[Problem] = field(default_factory=list)

    def error(self, message: str, line: int, column: int = 1) -> None:
        """Note an error at a place."""
        self.problems.append(Problem(message, place=self.source.place(line, column)))


def texts(data: bytes, file: str) -> Iterator[tuple[str, list[Problem]]]:
    """The text of a file in each encoding that is possible, the likeliest first.

    Raises
    ------
    ReadError
        If the file holds no text.
    """
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _unreadable(file, "the file is UTF-16 text, expected UTF-8: save it as UTF-8")
    if b"\0" in data:
        message = "the file is binary, expected a deck as text: save it as text in UTF-8"
        raise _unreadable(file, message)
    try:
        yield data.decode("utf-8-sig"), []
    except UnicodeDecodeError as error:
        for encoding in ("cp1251", "cp866", "koi8-r"):
            try:
                yield data.decode(encoding), []
            except UnicodeDecodeError:  # CP1251 lacks one byte
                continue
        yield _damaged(data, error.start, file)


def _unreadable(file: str, message: str) -> ReadError:
    return ReadError([Problem(message, place=Place(file, 1, 1))])


def _damaged(data: bytes, start: int, file: str) -> tuple[str, list[Problem]]:
    """The text as UTF-8 with a fault, so that a cut file does not read as gibberish."""
    before = data[:start].decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    text = data.decode("utf-8-sig", errors="replace")
    message = f"byte 0x{data[start]:02X} is no UTF-8 here: the file is damaged or cut"
    return text, [Problem(message, place=Source(file, text).place(line, column))]


def latin(text: str) -> str:
    """Upper case, Cyrillic letters that look like Latin ones made Latin."""
    return text.upper().translate(LATIN)


def scan(source: Source) -> Scan:
    """Find the fields and the names of a deck."""
    found = Scan(source, len(source.lines))
    for number, line in enumerate(source.lines, 1):
        head, opened, start = _head(line)
        if opened == "(" and head in RESULTS and _is_index(line, start):
            found.last = number - 1
            break
        if head in SCALARS and opened == "=":
            _scalars(found, number, line)
        elif head in LISTS or (head in GEAR_LISTS and opened == "("):
            _list(found, number, line, start, head)
        elif (match := _name_line(line)) is not None:
            found.stops.append(number)
            column = len(line) - len(line.lstrip()) + 1
            found.names.append(Named(*match, number, column))
        elif head and opened and head.isascii() and len(head) < 8 and len(found.unknown) < 50:
            found.unknown.setdefault(head, number)
    while found.last > 1 and not source.lines[found.last - 1].strip():
        found.last -= 1
    return found


def _head(line: str) -> tuple[str, str, int]:
    """The word at the start of a line, the sign that follows it, and where that stands."""
    start = len(line) - len(line.lstrip())
    start += line.startswith("(", start)
    ends = [end for end in (line.find("(", start), line.find("=", start)) if end >= 0]
    if not ends or min(ends) - start > 40:  # names are short, even with stray blanks
        return "", "", start
    end = min(ends)
    return latin("".join(line[start:end].split())), line[end], end


def _is_index(line: str, start: int) -> bool:
    match = INDEX_LIST.match(line, start)
    return match is not None and re.fullmatch(r"[A-Z0-9,]+", _squeezed(match)) is not None


def _squeezed(match: re.Match[str]) -> str:
    return latin("".join(match[1].split()))


def _add(found: Scan, new: Field) -> None:
    """Keep a field, unless it was given before."""
    if not found.stops or found.stops[-1] != new.line:
        found.stops.append(new.line)
    first = found.fields.setdefault(new.key, new)
    if first is not new:
        before = f"line {first.line}, column {first.column}"
        message = f"{new.key}: given again, first given in {before}; expected once"
        found.error(message, new.line, new.column)


def _scalars(found: Scan, number: int, line: str) -> None:
    """All fields of a line such as ``KJG= 6 KL= 5 KG= 3 KNM = 2``."""
    heads: list[tuple[str, int, int]] = []
    before = 0
    for equals in re.finditer("=", line):
        words = list(WORD.finditer(line, before, equals.start()))[-5:]
        for word in range(len(words)):
            key = latin("".join(part[0] for part in words[word:]))
            if key in SCALARS:
                heads.append((key, words[word].start(), equals.end()))
                break
        before = equals.end()
    for position, (key, start, value) in enumerate(heads):
        following = heads[position + 1 : position + 2]
        end = following[0][1] if following else None
        _add(found, Field(key, number, start + 1, value, end))


def _list(found: Scan, number: int, line: str, start: int, head: str) -> None:
    """A field such as ``IAB(I),I=1,KG:``; the colon or the whole index list may be missing."""
    column = len(line) - len(line.lstrip()) + 1
    key, value, index = GEAR_LISTS.get(head, head), start + 1, ""
    if line[start] == "(":
        match = INDEX_LIST.match(line, start)
        if match is not None:
            value, index = match.end(), _squeezed(match)
        if match is None or not match[2]:
            value = _past_colon(line, value)
    if head in PARTS:
        parts = PARTS[head]
        part = index.partition(",")[2]
        if part not in parts:
            expected = " or ".join(f"{head}(I,{part})" for part in parts)
            read = f"{head}({index})" if index else line.strip()[:30]
            found.error(f"{head}: read '{read}', expected {expected}", number, column)
            found.stops.append(number)
            return
        key = f"{head}(I,{part})"
    _add(found, Field(key, number, column, value))


def _past_colon(line: str, value: int) -> int:
    """Where values start when the index list has no colon, or is broken before it."""
    colon = line.find(":", value)
    starts_value = re.match(r"[\s,]*[-+.0-9]", line[value:]) is not None
    return value if colon < 0 or starts_value else colon + 1


def _name_line(line: str) -> tuple[str, str, str] | None:
    """Kind, number and name of a line such as ``NAME F3: C1``."""
    before, colon, name = line.partition(":")
    match = NAME_LINE.fullmatch(latin(before)) if colon and len(before) < 40 else None
    if match is None or not (match[2] or match[1] == "T"):
        return None
    return match[1], match[2], name.strip()
