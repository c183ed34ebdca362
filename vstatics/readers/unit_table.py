"""Tables in CSV whose headings tell units: `speed [rpm],torque [N*m]`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from vstatics.errors import Place, Problem, ReadError, nearest, quoted, spoken
from vstatics.model.shape import UNIT_OF, Measure
from vstatics.readers.named.csv_rows import (
    Decimals,
    cells_of,
    decimal,
    expect_cells,
    has_cells,
    headings_of,
    separator_of,
)
from vstatics.readers.named.nodes import MOST_PROBLEMS, decode
from vstatics.readers.named.si_units import measured
from vstatics.readers.reading import Source

MOST_TABLE_ROWS = 1_000_000
"""Rows of a table; a day in tenths of a second has 864,000."""


class TableColumn(NamedTuple):
    """A column that a table may have."""

    name: str
    measure: Measure | None = None
    """What its numbers are in SI; None: of numbers without a unit, or of texts."""
    is_text: bool = False
    optional: bool = False
    may_be_bare: bool = False
    """Whether a heading without a unit means the unit of SI."""
    meaning: str = ""
    """Ends the message about a unit that may not stand there."""
    sizes: Mapping[str, float] | None = None
    """Sizes of the only units that may stand there, where these are no measure."""

    @property
    def heading(self) -> str:
        """As it may be written.

        >>> TableColumn("speed", "si_speed").heading
        'speed [rad/s]'
        """
        if self.sizes:
            return f"{self.name} [{next(iter(self.sizes))}]"
        return f"{self.name} [{UNIT_OF[self.measure]}]" if self.measure else self.name


class UnitTable(NamedTuple):
    """A table that was read: numbers in SI, and the line of each row."""

    numbers: dict[str, list[float]]
    texts: dict[str, list[str]]
    lines: list[int]
    source: Source

    def place(self, row: int) -> Place:
        """Where a row stands, counted from 0."""
        return self.source.place(self.lines[row])


def read_unit_table(
    data: bytes,
    file: str,
    what: str,
    columns: Sequence[TableColumn],
    id: str,  # noqa: A002
) -> UnitTable:
    """Read a table.

    Parameters
    ----------
    data : bytes
        A line of headings, then a line for each row, with commas, or with semicolons and
        decimal commas.
    file : str
        Its name, for messages.
    what : str
        What it is, in words: ``a duty cycle``.
    columns : sequence of TableColumn
        Those that it may have, in any order.
    id : str
        Of what is wrong in it.

    Raises
    ------
    ReadError
        With every problem and its place.

    Examples
    --------
    >>> columns = [TableColumn("speed", "si_speed"), TableColumn("gear", is_text=True)]
    >>> data = b"gear,speed [rpm]\\n1,30\\nR,60"
    >>> table = read_unit_table(data, "a.csv", "a cycle", columns, "E121")
    >>> table.numbers["speed"][0].__round__(6), table.texts["gear"]
    (3.141593, ['1', 'R'])
    """
    source = decode(data, file, what).source
    lines = [(number, line) for number, line in enumerate(source.lines, 1) if has_cells(line)]
    if not lines:
        raise ReadError([Problem(id, f"read nothing, expected {what}", (), source.place(1))])
    problems: list[Problem] = []
    (first, headings), *rows = lines
    try:
        separator = separator_of(headings)
        found = _headings(headings_of(cells_of(headings, separator)), what, columns)
    except ValueError as error:
        raise ReadError([Problem(id, str(error), (), source.place(first))]) from None
    if not rows:
        message = f"there is no row below the headings, expected {what}"
        problems.append(Problem(id, message, (), source.place(first)))
    if len(rows) > MOST_TABLE_ROWS:
        message = f"read {len(rows)} rows, expected {MOST_TABLE_ROWS} at most"
        raise ReadError([Problem(id, message, (), source.place(first))])
    table = UnitTable(
        {one.name: [] for one, _ in found if not one.is_text},
        {one.name: [] for one, _ in found if one.is_text},
        [number for number, _ in rows],
        source,
    )
    decimals = Decimals(separator)
    for number, line in rows:
        try:
            cells = cells_of(line, separator)
            expect_cells(cells, len(found), separator)
            _add(table, cells, found, partial(decimals.with_points, line=number))
        except ValueError as error:
            problems.append(Problem(id, str(error), (), source.place(number)))
            if len(problems) >= MOST_PROBLEMS:
                break
    if decimals.doubt:
        line_of_it, message = decimals.doubt
        problems.append(Problem(id, message, (), source.place(line_of_it)))
    if problems:
        raise ReadError(problems)
    return table


def _headings(
    cells: Sequence[str], what: str, columns: Sequence[TableColumn]
) -> list[tuple[TableColumn, float]]:
    """The columns in their order, each with the size of its unit in SI."""
    by_name = {one.name: one for one in columns}
    found: list[tuple[TableColumn, float]] = []
    for cell in cells:
        name, bracket, unit = (part.strip() for part in cell.partition("["))
        known = by_name.get(name)
        if known is None:
            expected = spoken([quoted(one.heading) for one in columns], "or")
            hint = nearest(name, by_name)
            raise ValueError(f"read the heading {cell[:40]!r}, expected {expected}{hint}")
        if any(one is known for one, _ in found):
            raise ValueError(f"two columns are called {quoted(name)}")
        found.append((known, _size(known, unit.removesuffix("]").strip(), bool(bracket))))
    names = [one.name for one, _ in found]
    missing = [one.heading for one in columns if not one.optional and one.name not in names]
    if missing:
        raise ValueError(f"{spoken(map(quoted, missing))} is missing, expected {what}")
    return found


def _size(column: TableColumn, unit: str, told: bool) -> float:  # noqa: FBT001
    """The unit of a column in SI."""
    if column.sizes is not None:
        if unit not in column.sizes:
            expected = spoken(map(quoted, column.sizes), "or")
            message = f"{column.name}: read the unit {unit[:40]!r}, expected {expected}"
            raise ValueError(message + column.meaning)
        return column.sizes[unit]
    if column.measure is None:
        if told:
            message = f"{column.name}: read the unit {unit[:40]!r}, expected none"
            raise ValueError(message + column.meaning)
        return 1.0
    if not told and column.may_be_bare:
        return 1.0
    if not unit:
        raise ValueError(f"{column.name}: its unit is missing, such as {quoted(column.heading)}")
    try:
        return measured(f"1 {unit}", column.measure)
    except ValueError as error:
        raise ValueError(f"{column.name}: read the unit {unit[:40]!r}, {error}") from None


def _add(
    table: UnitTable,
    cells: Sequence[str],
    found: Sequence[tuple[TableColumn, float]],
    with_points: Callable[[str], str],
) -> None:
    """Add a row; a ValueError says what of it can't be read."""
    for cell, (column, unit) in zip(cells, found, strict=False):
        if column.is_text:
            table.texts[column.name].append(cell)
            continue
        try:
            table.numbers[column.name].append(decimal(with_points(cell)) * unit)
        except ValueError as error:
            raise ValueError(f"{column.name}: read {cell[:40]!r}, {error}") from None
