"""Lookup tables for formulas, read from CSV files."""

from __future__ import annotations

from itertools import zip_longest
from pathlib import Path

from vstatics.core.numerics.lookup_table import LookupTable
from vstatics.core.readers.named.csv_files import lines_of
from vstatics.core.readers.named.csv_rows import numbered_rows
from vstatics.core.readers.named.headings import (
    CellError,
    Heading,
    TableColumn,
    is_comment,
    is_row_of_numbers,
    with_unit,
    with_units_below,
    without_titles,
)
from vstatics.simulation.scenario.given import si_number

MOST_TABLE_BYTES = 5_000_000
"""Largest size of a CSV file. [bytes]"""


def table_of(scenario: str, name: str) -> LookupTable:
    """Read a table from a CSV file, whose name is relative to the folder of a scenario.

    Raises
    ------
    OSError
        If the file cannot be opened.
    ValueError
        If the content is not a table; the message says what was expected.
    """
    lines = lines_of(Path(scenario).parent / name, MOST_TABLE_BYTES)
    return _table(list(numbered_rows(without_titles(lines, _has_unit))))


def _has_unit(cell: str) -> bool:
    """Return whether a cell has a unit, unlike a number with a decimal comma."""
    return bool(with_unit(cell)[1]) and not is_row_of_numbers(cell)


def _table(rows: list[tuple[int, list[str]]]) -> LookupTable:
    """Build a table from numbered lines: a heading, then rows of numbers.

    The heading has the quantity of the first column with its unit, then a number per column. A
    single further column has any heading. Units can also be in a row below the headings.

    Raises
    ------
    ValueError
        If a row is not numbers; the message says what was expected.

    Examples
    --------
    >>> head = ["speed [rpm]", "0.2", "1"]
    >>> _table([(1, head), (2, ["0", "10", "50"]), (3, ["3000", "20", "90"])]).at(1000.0, 1.0)
    90.0
    >>> _table([(1, ["time [ms]", "pedal"]), (2, ["0", "0.5"]), (3, ["1000", "1"])]).at(0.5)
    0.75
    >>> _table([(1, ["time", "pedal"]), (2, ["ms", "%"]), (3, ["0", "5"]), (4, ["4", "9"])]).at(0.0)
    0.05
    """
    heads = rows[0][1] if rows else []
    with_own_unit = heads if len(heads) == 2 else heads[:1]
    headings = [
        Heading(TableColumn(head, any_unit=True), place, unit)
        for place, (head, unit) in enumerate(
            zip_longest(heads, (with_unit(head)[1] for head in with_own_unit))
        )
    ]
    below = rows[1:]
    if below:
        line, row = below[0]
        try:
            with_units = with_units_below(headings, row)
        except CellError as error:
            raise ValueError(f"line {line}: {error}") from None
        if with_units:
            headings, below = with_units, below[1:]
    units = [heading.unit or "" for heading in headings]
    if len(heads) < 2 or not units[0]:
        raise ValueError("expected a CSV file with a head such as `speed [rpm],0.2,0.5,1`")
    columns = tuple(_number(head, rows[0][0]) for head in heads[1:]) if len(heads) > 2 else (0.0,)
    x, values = [], []
    for line, row in below:
        if is_comment(row[0]):
            continue
        if len(row) != len(heads):
            raise ValueError(f"line {line}: expected {len(heads)} numbers")
        abscissa, *ordinates = (
            _number(cell, line, of) for cell, of in zip(row, units, strict=True)
        )
        x.append(abscissa)
        values.append(tuple(ordinates))
    if not x:
        raise ValueError("expected a row at least, below the head")
    return LookupTable(tuple(x), tuple(values), columns)


def _number(cell: str, line: int, unit: str = "") -> float:
    """Return a number in SI units from a cell, with the unit of its column if it has one."""
    text = f"{cell} {unit}".strip()
    try:
        return si_number(text)
    except ValueError as error:
        read = text[:40] if cell.strip() else "an empty cell"
        raise ValueError(f"line {line}: read {read}, {error}") from None
