"""Rows of CSV files as spreadsheets write them: with commas, semicolons or tabs.

In countries with a decimal comma, such as Germany or Russia, spreadsheets separate cells by
semicolons. All readers of such files take the separator and the numbers from this module.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from vstatics.core.readers.named.arithmetic import slip

_CALCULATION = re.compile(r"[-+*/() .,%0-9eE]+")
_THOUSANDS = re.compile(r"(?<![.,\d])[1-9]\d{0,2}\.\d{3}(?![.,\deE])")
_COMMA_THOUSANDS = re.compile(r"(?<![.,\d])[1-9]\d{0,2},\d{3}(?![.,\deE])")
_OF_TWO_SIGNS = re.compile(r"\.\d{3},\d|,\d{3}\.\d")
"""Pattern of grouped digits with a decimal sign, such as 1.234,5, which tables must not contain."""
_FRACTION = re.compile(r"(?<![.,\d])\d*\.\d+(?![.,\d])")
_SEPARATOR_LINE = re.compile(r'\s*"?sep=[^"\n]"?[\s,;]*', re.IGNORECASE)
"""Line such as `sep=;` for spreadsheets. Here the headings determine the separator."""


def separator_of(head: str) -> str:
    """Return the separator of the cells of a table, as used in the line of headings.

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
    """Converter to decimal points for the numbers in a table with semicolons or tabs.

    In such tables a point can be a decimal point or separate thousands, as in `1.200`. It is a
    decimal point if another number, such as `0.5`, has no other meaning, and no number contains a
    comma. The same rule applies to a comma between tabs, as in `1,200`.

    >>> german = Decimals(";")
    >>> [german.with_points(cell, 2) for cell in ("-36,5", "-78,5/30", "1.200", "a,b")]
    ['-36.5', '-78.5/30', '1.200', 'a,b']
    >>> german.doubt
    (2, "read '1.200', 1200 with decimal commas but 1.2 with ... points; write 1200 or 1,200")

    Attributes
    ----------
    are_commas : bool
        True if a number with a decimal comma was read.
    """

    def __init__(self, separator: str) -> None:
        self.are_commas = False
        self._separator = separator
        self._are_points = False
        self._doubts: dict[str, tuple[int, str]] = {}
        """First line and number that are ambiguous, by the sign that can separate thousands."""

    def with_points(self, cell: str, line: int) -> str:
        """Return a cell with a decimal point if it is a number with a decimal comma."""
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
        return cell if _OF_TWO_SIGNS.search(cell) else cell.replace(",", ".")

    @property
    def doubt(self) -> tuple[int, str] | None:
        """Line and message of the first ambiguous number, if any."""
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
    """Return whether any cell of a line has content; ``sep=;`` only declares the separator.

    >>> has_cells(" ;;"), has_cells("0;"), has_cells("sep=;")
    (False, True, False)
    """
    filled = line.strip(" \t\r\n,;")
    return bool(filled) and not (filled[0] in 'sS"' and _SEPARATOR_LINE.fullmatch(line))


def cells_of(line: str, separator: str) -> list[str]:
    """Return the cells of a line without surrounding blanks.

    >>> cells_of('2, "1,5"', ","), len(cells_of("x" * 200_000, ",")[0])
    (['2', '1,5'], 200000)
    """
    try:
        cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:  # a cell is too long
        cells = line.split(separator)
    return [cell.strip() for cell in cells]


def placed_cells(line: str, separator: str) -> list[tuple[str, int]]:
    """Return the cells of a line, without blanks and quotes, each with the column from 1.

    >>> placed_cells('t; "v, km/h"', ";")
    [('t', 1), ('v, km/h', 5)]
    """
    blanks = rf"(?:(?!{separator})\s)*"
    cell = re.compile(rf'{blanks}(?:"((?:[^"]|"")*)"{blanks}|([^{separator}]*))({separator}|\Z)')
    cells = []
    position = 0
    while match := cell.match(line, position):
        quoted, plain, end = match.groups()
        text = plain.strip() if quoted is None else quoted.replace('""', '"')
        cells.append((text, match.start(2 if quoted is None else 1) + 1))
        if not end:
            break
        position = match.end()
    return cells


def decimal(cell: str) -> float:
    """Return a cell as a finite decimal number.

    Raises
    ------
    ValueError
        The message states the expectation.

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
    """Return the headings of a table without the empty cells at the end of the line.

    >>> headings_of(["speed [rpm]", "gear", "", " "])
    ['speed [rpm]', 'gear']
    """
    count = max((number for number, cell in enumerate(cells, 1) if cell.strip()), default=0)
    return list(cells[:count])


def expect_cells(cells: Sequence[str], expected: int, separator: str) -> None:
    """Check that a row has a cell for each heading, and only empty cells after these.

    Raises
    ------
    ValueError
        The message states the expectation.

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
    """Yield the non-empty rows of a table, each with the number of its last line.

    The first row contains the headings, and no other row is longer. Numbers are converted to
    decimal points.

    Raises
    ------
    ValueError
        If the text is not CSV, a row is too long, or a number is ambiguous.
    """
    below = iter(lines)
    above, head = next((line for line in enumerate(below) if has_cells(line[1])), (0, ""))
    separator, columns = separator_of(head), 0
    decimals = Decimals(separator)
    rows = csv.reader(chain([head], below), delimiter=separator, skipinitialspace=True)
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
