"""Reader of the files (parts) in a workbook, with limited size: sheets, texts, formats."""

from __future__ import annotations

import datetime as dt
import io
import posixpath
import re
import zipfile
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

MOST_UNPACKED_BYTES = 10_000_000
"""Largest unpacked size of all parts that are read. [bytes]"""
MOST_STYLE_BYTES = 20_000_000
"""Largest size of the part with the cell formats. [bytes]

The limit is high because only the numbers of date formats are stored.
"""
MOST_NESTED_ELEMENTS = 100
MOST_WORKBOOK_SHEETS = 1000
_PART_PIECE = 2**16
"""Number of bytes of a part that are parsed at once."""
_BUILT_IN_DATES = frozenset([*range(14, 23), *range(27, 37), *range(45, 48), *range(50, 59)])
"""Numbers of built-in formats for dates or times."""
_NO_DATE = re.compile(r'"[^"]*"|\[(?!hh?\]|mm?\]|ss?\])[^\]]*\]|[_\\].')
"""Pattern of literal parts of a number format: texts, colours, single letters."""

Start = Callable[[str, Mapping[str, str]], object]
End = Callable[[str], object]


def parse(
    stream: io.BufferedIOBase | Any, start: Start, end: End = lambda _: None, text: Any = None
) -> None:
    """Parse the XML elements of a part, and call handlers with element names without namespace.

    Raises
    ------
    ValueError
        If the part is nested too deeply, or has a document type, whose entities could be hostile.
    ExpatError
        If the part is not valid XML.
    """
    from xml.parsers import expat  # costs start-up time

    depth = 0

    def started(name: str, attributes: Mapping[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > MOST_NESTED_ELEMENTS:
            raise ValueError(f"nested deeper than {MOST_NESTED_ELEMENTS} levels")
        start(name.rpartition(":")[2], attributes)

    def ended(name: str) -> None:
        nonlocal depth
        depth -= 1
        end(name.rpartition(":")[2])

    def refused(*_: object) -> None:
        raise ValueError("a document type, expected none")

    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler, parser.EndElementHandler = started, ended
    parser.StartDoctypeDeclHandler = refused
    if text:
        parser.CharacterDataHandler = text
    while piece := stream.read(_PART_PIECE):
        parser.Parse(piece)
    parser.Parse(b"", True)  # noqa: FBT003 (signature of expat)


class PackedParts:
    """Parts (files) inside a workbook.

    Raises
    ------
    ValueError
        If the workbook is larger than any case.
    Exception
        Of various classes if the workbook is damaged.
    """

    def __init__(self, data: bytes) -> None:
        """Read the list of sheets."""
        self._packed = zipfile.ZipFile(io.BytesIO(data))
        files = self._packed.NameToInfo  # some programs write backslashes in paths
        files |= {path.replace("\\", "/"): file for path, file in files.items()}
        self._left = MOST_UNPACKED_BYTES
        roots = self._relations("")
        self._book = next((path for kind, path in roots.values() if kind == "officeDocument"), "")
        self._book = self._book or "xl/workbook.xml"
        self.sheets: dict[str, str] = {}
        """Path of the part of each sheet, by sheet name; empty for a chart."""
        self._first_day = dt.datetime(1899, 12, 30)  # noqa: DTZ001 (days have no time zone)
        self._named: list[tuple[str, str]] = []
        with self._open(self._book) as part:
            parse(part, self._sheet)
        self._related = self._relations(self._book)
        for name, key in self._named:
            kind, path = self._related.get(key, ("", ""))
            self.sheets[name] = path if kind == "worksheet" else ""

    def parse(self, path: str, start: Start, end: End = lambda _: None, text: Any = None) -> None:
        """Parse the XML elements of a file inside the workbook."""
        with self._open(path) as part:
            parse(part, start, end, text)

    def _sheet(self, name: str, attributes: Mapping[str, str]) -> None:
        if name == "workbookPr" and attributes.get("date1904") in ("1", "true"):
            self._first_day = dt.datetime(1904, 1, 1)  # noqa: DTZ001
        if name == "sheet":
            key = next((value for key, value in attributes.items() if key.endswith(":id")), "")
            self._named.append((attributes.get("name", ""), key))
            if len(self._named) > MOST_WORKBOOK_SHEETS:
                raise ValueError(f"expected at most {MOST_WORKBOOK_SHEETS} sheets")

    def _open(self, path: str) -> Any:
        member = self._packed.getinfo(path)
        self._left -= member.file_size
        if self._left < 0:
            size = (MOST_UNPACKED_BYTES - self._left) / 1e6
            raise ValueError(
                f"{size:.0f} MB when unpacked, expected at most {MOST_UNPACKED_BYTES / 1e6:.0f}"
            )
        return self._packed.open(member)

    def _relations(self, of: str) -> dict[str, tuple[str, str]]:
        folder, name = posixpath.split(of)
        relations = {}

        def start(name: str, attributes: Mapping[str, str]) -> None:
            if name == "Relationship" and attributes.get("TargetMode") != "External":
                path = posixpath.normpath(posixpath.join("/", folder, attributes["Target"]))
                kind = attributes.get("Type", "").rpartition("/")[2]
                relations[attributes.get("Id", "")] = kind, path.lstrip("/")

        path = posixpath.join(folder, "_rels", f"{name}.rels")
        if path in self._packed.NameToInfo:
            self.parse(path, start)
        return relations

    def date(self, value: str) -> str:
        """Return date and time as text from a number of days; an invalid value is unchanged."""
        try:
            return str(self._first_day + dt.timedelta(days=float(value)))
        except (OverflowError, ValueError):
            return value

    def _part(self, kind: str) -> str:
        """Return the path of a part, by kind; empty if missing."""
        paths = [path for of, path in self._related.values() if of == kind]
        return next((path for path in paths if path in self._packed.NameToInfo), "")

    @cached_property
    def texts(self) -> list[str]:
        """Texts that cells refer to by index, without phonetic hints."""
        texts = []
        parts: list[str] = []
        inside = []

        def start(name: str, _: Mapping[str, str]) -> None:
            inside.append(name)
            if name == "si":
                parts.clear()

        def end(name: str) -> None:
            inside.pop()
            if name == "si":
                texts.append("".join(parts).replace("x005F_", ""))

        def text(read: str) -> None:
            if inside[-1] == "t" and "rPh" not in inside:
                parts.append(read)

        if path := self._part("sharedStrings"):
            self.parse(path, start, end, text)
        return texts

    @cached_property
    def dates(self) -> frozenset[int]:
        """Numbers of the cell formats for dates or times."""
        codes = {}
        formats = []
        section = ""

        def start(name: str, attributes: Mapping[str, str]) -> None:
            nonlocal section
            if name == "xf":
                formats.extend([attributes.get("numFmtId", "0")] * (section == "cellXfs"))
            elif name == "numFmt":
                codes[attributes.get("numFmtId", "")] = attributes.get("formatCode", "")
            elif name in ("cellXfs", "cellStyleXfs", "dxfs"):
                section = name

        if path := self._part("styles"):
            member = self._packed.getinfo(path)
            if member.file_size > MOST_STYLE_BYTES:
                most = MOST_STYLE_BYTES / 1e6
                raise ValueError(
                    f"formats of {member.file_size / 1e6:.0f} MB, expected at most {most:.0f}"
                )
            with self._packed.open(member) as part:
                parse(part, start)
        return frozenset(n for n, key in enumerate(formats) if _is_date(key, codes.get(key)))


def _is_date(number: str, code: str | None) -> bool:
    """Return whether a number format is for dates or times.

    >>> _is_date("14", None), _is_date("165", "[h]:mm"), _is_date("165", '0.0 "days"')
    (True, True, False)
    """
    if code is None:
        return number.isdecimal() and len(number) < 4 and int(number) in _BUILT_IN_DATES
    return bool(re.search("[dmhysDMHYS]", _NO_DATE.sub("", code.partition(";")[0])))
