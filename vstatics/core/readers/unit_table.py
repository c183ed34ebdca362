"""Tables in CSV whose headings have units: `speed [rpm],torque [N*m]`."""

from __future__ import annotations

import re
import sys
from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError
from vstatics.core.readers.named.csv_rows import (
    Decimals,
    cells_of,
    decimal,
    expect_cells,
    has_cells,
)
from vstatics.core.readers.named.headings import (
    HeadingError,
    HeadingLine,
    TableColumn,
    is_comment,
    read_headings,
)
from vstatics.core.readers.named.nodes import MOST_PROBLEMS, decode
from vstatics.core.readers.reading import Source

_PLAIN = re.compile(r"[-+0-9.eE, \t]+")
_CLOCK = re.compile(r"\s*(\d{1,9}):([0-5]?\d):([0-5]?\d(?:[.,]\d*)?)\s*")
_DAY_FIRST = re.compile(r"([0-9]{2})\.([0-9]{2})\.([0-9]{4})(?= )")
_DATED = re.compile(r"\s*[0-9]{4}-[0-9]{2}-[0-9]{2}[T ][0-9]{2}:")
_TIMES = "`01:30:00` or `2024-05-06 01:30:00`"
_BLOCK_LINES = 5000
MOST_TABLE_ROWS = 1_000_000
"""Maximum number of rows of a table. A day in steps of 0.1 s has 864,000 rows."""


class UnitTable(NamedTuple):
    """Columns of a table: numbers in SI units, texts, and the line number of each row."""

    numbers: Mapping[str, Sequence[float]]
    texts: Mapping[str, Sequence[str]]
    lines: Sequence[int]
    source: Source
    head: HeadingLine

    def place(self, row: int) -> Place:
        """Return the place of a row; rows are counted from 0."""
        return self.source.place(self.lines[row])

    def read_number(self, name: str, row: int) -> str:
        """Return a number of a row as text, in the unit of its heading."""
        heading = next(heading for heading in self.head.headings if heading.column.name == name)
        return f"{self.numbers[name][row] / heading.size:g} {heading.unit or ''}".rstrip()

    @property
    def head_place(self) -> Place:
        """Place of the line of headings."""
        return self.source.place(self.head.number)


def read_unit_table(  # noqa: PLR0913 (a table needs this many properties)
    data: bytes,
    file: str,
    what: str,
    columns: Sequence[TableColumn],
    id: str,  # noqa: A002
    *,
    skips: bool = False,
) -> UnitTable:
    """Read a table of numbers and texts, with a unit in the heading of each column of numbers.

    Parameters
    ----------
    data : bytes
        Content of the file: a line of headings, then a line for each row. Cells are separated by
        commas, or by semicolons or tabs with decimal commas. Lines above the headings are titles.
    file : str
        Name of the file, for messages.
    what : str
        Kind of the table, in words: ``a duty cycle``.
    columns : sequence of TableColumn
        Columns that the table can have, in any order.
    id : str
        Id of the messages about the table.
    skips : bool
        True if columns with other headings are skipped, not reported.

    Returns
    -------
    UnitTable

    Raises
    ------
    ReadError
        The error contains every problem and its place.

    Examples
    --------
    >>> columns = [TableColumn("speed", "si_speed"), TableColumn("gear", is_text=True)]
    >>> data = b"gear,speed [rpm]\\n1,30\\nR,60"
    >>> table = read_unit_table(data, "a.csv", "a cycle", columns, "E121")
    >>> table.numbers["speed"][0].__round__(6), table.texts["gear"]
    (3.141593, ['1', 'R'])
    """
    source = decode(data, file, what).source
    try:
        head = read_headings(_filled(source.lines, 1), what, columns, skips=skips)
    except HeadingError as error:
        raise ReadError(id, str(error), place=source.place(error.line, error.column)) from None
    rows = _ColumnsRead(head)
    problems = [
        Problem(id, message, (), source.place(line))
        for line, message in rows.read(source.lines, head.last + 1)
    ]
    if len(rows.lines) > MOST_TABLE_ROWS:
        message = f"read more rows, expected {MOST_TABLE_ROWS} at most"
        raise ReadError(id, message, place=source.place(head.number))
    if not (rows.lines or problems):
        message = f"read no row below the headings, expected {what}"
        problems.append(Problem(id, message, (), source.place(head.number)))
    if rows.decimals.doubt:
        line_in_doubt, message = rows.decimals.doubt
        problems.append(Problem(id, message, (), source.place(line_in_doubt)))
    if problems:
        raise ReadError(problems)
    del source.lines  # the lines take more memory than the numbers
    return UnitTable(rows.numbers, rows.texts, rows.lines, source, head)


def _filled(lines: Iterable[str], first: int) -> Iterator[tuple[int, str]]:
    return ((number, line) for number, line in enumerate(lines, first) if has_cells(line))


class Clock:
    """Reader of clock times, with or without a date."""

    def __init__(self) -> None:
        self._midnight: datetime | None = None

    def seconds(self, cell: str) -> float | None:
        """Return a time such as `01:30:00` in seconds, whatever unit the heading gives.

        The result is None for other cells. A time with a date counts from midnight of the first
        dated row; without a time zone it is in UTC.
        """
        if clock := _CLOCK.fullmatch(cell):
            hours, minutes, seconds = clock.groups()
            return 3600.0 * int(hours) + 60 * int(minutes) + float(seconds.replace(",", "."))
        dated = _DAY_FIRST.sub(r"\3-\2-\1", cell.strip())
        if not _DATED.match(dated):
            return None
        try:
            moment = datetime.fromisoformat(dated)
        except ValueError:
            return None
        moment = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
        self._midnight = self._midnight or moment.replace(hour=0, minute=0, second=0, microsecond=0)
        return (moment - self._midnight).total_seconds()


class _ColumnsRead:
    """Rows of a table, collected column by column."""

    def __init__(self, head: HeadingLine) -> None:
        self.head = head
        self.decimals = Decimals(head.separator)
        self.lines = array("q")
        self.numbers: dict[str, array[float]] = {}
        self.texts: dict[str, list[str]] = {}
        self._sizes: list[tuple[int, str, float, array[float]]] = []
        self._words: list[tuple[int, list[str]]] = []
        self._clock = Clock()
        self._times = {h.column.name for h in head.headings if h.column.measure == "time"}
        for heading in head.headings:
            name, place = heading.column.name, heading.place
            if heading.column.is_text:
                self._words.append((place, self.texts.setdefault(name, [])))
            else:
                numbers = self.numbers.setdefault(name, array("d"))
                self._sizes.append((place, name, heading.size, numbers))
        self._has_comments = all(place for place, _ in self._words)

    def read(self, lines: Sequence[str], first: int) -> Iterator[tuple[int, str]]:
        """Add all rows, and yield up to `MOST_PROBLEMS` faults, each with a line number."""
        faults = 0
        for start in range(first, len(lines) + 1, _BLOCK_LINES):
            block = lines[start - 1 : start - 1 + _BLOCK_LINES]
            for number, line in _filled(block, start) if not self.add_plain(start, block) else ():
                try:
                    self.add(number, line)
                except ValueError as error:
                    yield number, str(error)
                    faults += 1
                    if faults == MOST_PROBLEMS:
                        return
            if len(self.lines) > MOST_TABLE_ROWS:
                return

    def add_plain(self, first: int, lines: Sequence[str]) -> bool:
        """Add a block of lines at once; return False if some cell is not a plain number."""
        commas, text = self.head.width - 1, ",".join(lines)
        if (
            self._words
            or self.head.separator != ","
            or not _PLAIN.fullmatch(text)
            or any(line.count(",") != commas for line in lines)
        ):
            return False
        try:
            flat = np.fromiter(map(float, text.split(",")), float)
        except ValueError:
            return False
        cells = flat.reshape(len(lines), self.head.width)
        if not np.isfinite(cells).all():
            return False
        self.lines.extend(range(first, first + len(lines)))
        for place, _, size, column in self._sizes:
            column.frombytes((cells[:, place] * size).tobytes())
        return True

    def add(self, number: int, line: str) -> None:
        """Add a row.

        Raises
        ------
        ValueError
            The error names the cell that cannot be read.
        """
        if self._has_comments and is_comment(line):
            return
        separator = self.head.separator
        cells = cells_of(line, separator) if '"' in line else line.split(separator)
        expect_cells(cells, self.head.width, separator)
        self.lines.append(number)
        for place, name, size, column in self._sizes:
            cell = cells[place]
            is_clock = name in self._times and ":" in cell
            seconds = self._clock.seconds(cell) if is_clock else None
            try:
                if seconds is None:
                    seconds = decimal(self.decimals.with_points(cell, number)) * size
                column.append(seconds)
            except ValueError as error:
                hint = f" or a time such as {_TIMES}" if is_clock else ""
                raise ValueError(f"{name}: read {cell.strip()[:40]!r}, {error}{hint}") from None
        for place, words in self._words:
            words.append(sys.intern(cells[place].strip()))
