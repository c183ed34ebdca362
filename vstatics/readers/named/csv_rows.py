"""Rows of CSV that people give, as spreadsheets write it: with commas, or with semicolons.

Where a comma is the decimal sign, as in German or Russian, a spreadsheet separates by semicolons.
Every reader of such a file asks here which sign separates, and takes its numbers from here.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import chain
from pathlib import Path

from vstatics.readers.named.arithmetic import slip
from vstatics.readers.named.nodes import encoding_of

_CALCULATION = re.compile(r"[-+*/() .,0-9eE]+")
_NOTED: ContextVar[set[str] | None] = ContextVar("noted files", default=None)


@contextmanager
def noted_files() -> Iterator[set[str]]:
    """Note which files are read in this block, or would be if they were there.

    >>> with noted_files() as noted:
    ...     try:
    ...         csv_rows(Path("nowhere.csv"), 100)
    ...     except OSError:
    ...         noted
    {'nowhere.csv'}
    """
    noted: set[str] = set()
    token = _NOTED.set(noted)
    try:
        yield noted
    finally:
        _NOTED.reset(token)


def csv_rows(file: Path, most: int) -> list[tuple[int, list[str]]]:
    """Lines that are not empty, each with its number.

    Parameters
    ----------
    file : Path
    most : int
        Of its bytes.

    Raises
    ------
    OSError
    ValueError
        With what was expected.
    """
    noted = _NOTED.get()
    if noted is not None:
        noted.add(str(file))
    with file.open("rb") as opened:
        data = opened.read(most + 1)
    if len(data) > most:
        raise ValueError(f"expected a file of {most // 1000} kB at most")
    try:
        text = data.decode(encoding_of(data))
    except UnicodeDecodeError:
        raise ValueError("expected text in UTF-8") from None
    return list(numbered_rows(io.StringIO(text)))


def separator_of(head: str) -> str:
    """The sign that separates the cells of a table, by its line of headings.

    >>> [separator_of(head) for head in ("time [s];speed [km/h]", "a,b", "speed [rpm];,2;,5")]
    [';', ',', ';']
    """
    return ";" if head.count(";") >= max(1, head.count(",")) else ","


def with_points(cell: str, separator: str) -> str:
    """A cell with decimal points, where it is a number between semicolons.

    >>> with_points("-36,5", ";"), with_points("-78,5/30", ";"), with_points("-36,5", ",")
    ('-36.5', '-78.5/30', '-36,5')
    """
    is_number = separator == ";" and _CALCULATION.fullmatch(cell)
    return cell.replace(",", ".") if is_number else cell


def has_cells(line: str) -> bool:
    """Whether anything stands in the cells of a line.

    >>> has_cells(" ;;"), has_cells("0;")
    (False, True)
    """
    return bool(line.strip(" \t\r\n,;"))


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


def expect_cells(read: int, expected: int, separator: str) -> None:
    """Expect a cell for each heading.

    Raises
    ------
    ValueError
        With what was expected.

    Examples
    --------
    >>> expect_cells(4, 2, ",")
    Traceback (most recent call last):
    ValueError: read 4 cells, expected 2, as the headings; with decimal commas, semicolons ...
    """
    if read != expected:
        commas = separator == "," and read > expected
        hint = "; with decimal commas, semicolons have to separate the cells" if commas else ""
        count = "1 cell" if read == 1 else f"{read} cells"
        raise ValueError(f"read {count}, expected {expected}, as the headings{hint}")


def numbered_rows(lines: Iterable[str]) -> Iterator[tuple[int, list[str]]]:
    """Rows of numbers that are not empty, each with the number of its last line.

    The first is that of the headings, and no other one is longer; numbers have decimal points.

    Raises
    ------
    ValueError
        With what was expected.
    """
    rest = iter(lines)
    above, head = next((one for one in enumerate(rest) if has_cells(one[1])), (0, ""))
    separator, columns = separator_of(head), 0
    rows = csv.reader(chain([head], rest), delimiter=separator)
    try:
        for row in rows:
            if not any(map(str.strip, row)):
                continue
            columns = columns or len(row)
            line = above + rows.line_num
            if any(map(str.strip, row[columns:])):
                try:
                    expect_cells(len(row), columns, separator)
                except ValueError as error:
                    raise ValueError(f"line {line}: {error}") from None
            cells = row[:columns]
            if separator != ",":
                cells = [with_points(cell, separator) for cell in cells]
            yield line, cells
    except csv.Error as error:
        raise ValueError(f"expected CSV: {error}") from None
