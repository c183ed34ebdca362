"""Rows of CSV that people give, as spreadsheets write it: with commas, semicolons or tabs.

Where a comma is the decimal sign, as in German or Russian, a spreadsheet separates by semicolons.
Every reader of such a file asks here which sign separates, and takes its numbers from here.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from vstatics.core.readers.named.arithmetic import slip

_CALCULATION = re.compile(r"[-+*/() .,0-9eE]+")
_THOUSANDS = re.compile(r"(?<![.,\d])[1-9]\d{0,2}\.\d{3}(?![.,\deE])")
_COMMA_THOUSANDS = re.compile(r"(?<![.,\d])[1-9]\d{0,2},\d{3}(?![.,\deE])")
_FRACTION = re.compile(r"(?<![.,\d])\d*\.\d+(?![.,\d])")
_TOLD_SEPARATOR = re.compile(r'\s*"?sep=[^"\n]"?[\s,;]*', re.IGNORECASE)
"""The line with which a spreadsheet is told what separates, as the headings do, too."""


def separator_of(head: str) -> str:
    """Return the sign that separates the cells of a table, by its line of headings.

    Examples
    --------
    >>> heads = "time [s];speed [km/h]", "a,b", "speed [rpm];,2;,5", "Time, s\\tSpeed, mph"
    >>> [separator_of(head) for head in heads]
    [';', ',', ';', '\\t']
    """
    if "\t" in head.strip():
        return "\t"
    semicolons, commas = head.count(";"), head.count(",")
    return ";" if semicolons >= max(1, commas) else ","


class Decimals:
    """The numbers of one table, with decimal points where commas stood between semicolons or tabs.

    A point there may be a decimal one, or stand between thousands as in `1.200`: that is told by
    the other numbers. It is a decimal one if some has a point that can't be anything else, such as
    `0.5`, and none a comma. Between tabs the same holds for a comma, as in `1,200`.

    >>> german = Decimals(";")
    >>> [german.with_points(cell, 2) for cell in ("-36,5", "-78,5/30", "1.200", "a,b")]
    ['-36.5', '-78.5/30', '1.200', 'a,b']
    >>> german.doubt
    (2, "read '1.200', 1200 with decimal commas but 1.2 with ... points; write 1200 or 1,200")

    Attributes
    ----------
    are_commas : bool
        Whether a number had a comma.
    """

    def __init__(self, separator: str) -> None:
        self.are_commas = False
        self._separator = separator
        self._are_points = False
        self._doubts: dict[str, tuple[int, str]] = {}
        """By the sign that may stand between thousands: the first line, and the number."""

    def with_points(self, cell: str, line: int) -> str:
        """Return a cell with decimal points, where it is a number between semicolons or tabs."""
        if self._separator == "," or not _CALCULATION.fullmatch(cell):
            return cell
        if self._separator == "\t" and (thousands := _COMMA_THOUSANDS.search(cell)):
            self._doubts.setdefault(",", (line, thousands[0]))
        else:
            self.are_commas |= "," in cell
        if thousands := _THOUSANDS.search(cell):
            self._doubts.setdefault(".", (line, thousands[0]))
        else:
            self._are_points |= bool(_FRACTION.search(cell))
        return cell.replace(",", ".")

    @property
    def doubt(self) -> tuple[int, str] | None:
        """The first line with a number that may be two, and what to say of it."""
        if "," in self._doubts and (self._are_points or not self.are_commas):
            line, text = self._doubts[","]
            whole, point = text.replace(",", ""), text.replace(",", ".")
            readings = f"{float(point):g} with decimal commas but {whole} with decimal points"
            return line, f"read '{text}', {readings}; write {point} or {whole}"
        if "." in self._doubts and (self.are_commas or not self._are_points):
            line, text = self._doubts["."]
            whole = text.replace(".", "")
            readings = f"{whole} with decimal commas but {float(text):g} with decimal points"
            return line, f"read '{text}', {readings}; write {whole} or {text.replace('.', ',')}"
        return None


def has_cells(line: str) -> bool:
    """Whether anything stands in the cells of a line.

    >>> has_cells(" ;;"), has_cells("0;"), has_cells("sep=;")
    (False, True, False)
    """
    filled = line.strip(" \t\r\n,;")
    return bool(filled) and not (filled[0] in 'sS"' and _TOLD_SEPARATOR.fullmatch(line))


def cells_of(line: str, separator: str) -> list[str]:
    """The cells of a line without blanks around them.

    Raises
    ------
    ValueError
        With what was expected.
    """
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator), [])]
    except csv.Error as error:
        raise ValueError(f"no CSV: {error}") from None


def decimal(cell: str) -> float:
    """A finite decimal number.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> decimal("2,5")
    Traceback (most recent call last):
    ValueError: expected a finite number (with a decimal point)
    """
    try:
        number = float(cell) if "_" not in cell else math.nan
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"expected a finite number{slip(cell)}")
    return number


def headings_of(cells: Sequence[str]) -> list[str]:
    """The headings of a table, whose lines may end with empty cells.

    >>> headings_of(["speed [rpm]", "gear", "", " "])
    ['speed [rpm]', 'gear']
    """
    count = max((number for number, cell in enumerate(cells, 1) if cell.strip()), default=0)
    return list(cells[:count])


def expect_cells(cells: Sequence[str], expected: int, separator: str) -> None:
    """Expect a cell for each heading, and empty ones behind these.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> expect_cells(["0", "5", "1", ""], 2, ",")
    Traceback (most recent call last):
    ValueError: read 4 cells, expected 2, as the headings; with decimal commas, semicolons ...
    """
    read = len(cells)
    if read == expected:
        return
    if read < expected or any(map(str.strip, cells[expected:])):
        commas = separator == "," and read > expected
        hint = "; with decimal commas, semicolons have to separate the cells" if commas else ""
        count = "1 cell" if read == 1 else f"{read} cells"
        raise ValueError(f"read {count}, expected {expected}, as the headings{hint}")


def numbered_rows(lines: Iterable[str]) -> Iterator[tuple[int, list[str]]]:
    """Yield rows of numbers that are not empty, each with the number of its last line.

    The first is that of the headings, and no other one is longer; numbers have decimal points.

    Raises
    ------
    ValueError
        With what was expected.
    """
    below = iter(lines)
    above, head = next((line for line in enumerate(below) if has_cells(line[1])), (0, ""))
    separator, columns = separator_of(head), 0
    decimals = Decimals(separator)
    rows = csv.reader(chain([head], below), delimiter=separator)
    try:
        for row in rows:
            if not any(map(str.strip, row)):
                continue
            columns = columns or len(headings_of(row))
            line = above + rows.line_num
            if len(row) > columns:
                try:
                    expect_cells(row, columns, separator)
                except ValueError as error:
                    raise ValueError(f"line {line}: {error}") from None
            yield line, [decimals.with_points(cell, line) for cell in row[:columns]]
    except csv.Error as error:
        raise ValueError(f"expected CSV: {error}") from None
    if decimals.doubt:
        raise ValueError("line {}: {}".format(*decimals.doubt))
