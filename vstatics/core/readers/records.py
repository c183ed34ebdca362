"""Signals recorded over time: columns of a CSV file, as `vstatics simulate` writes them."""

from __future__ import annotations

from array import array
from collections.abc import Container, Mapping, Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, listed, quoted
from vstatics.core.model.shape import Measure
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.csv_rows import decimal, numbered_rows
from vstatics.core.readers.named.headings import (
    OTHER_SEPARATORS,
    SEPARATOR_HINT,
    CellError,
    Heading,
    TableColumn,
    is_comment,
    with_unit,
    with_units_below,
    without_titles,
)
from vstatics.core.readers.named.nodes import MOST_PROBLEMS, decode
from vstatics.core.readers.reading import Source
from vstatics.core.readers.unit_table import Clock
from vstatics.core.suggestions import nearest
from vstatics.core.tables.csv import unguarded


class RecordedColumns(NamedTuple):
    """Requested columns of a recorded file, in SI units, by name."""

    columns: Mapping[str, Floats]
    headings: tuple[str, ...]
    """Headings of all columns of the file."""
    lines: Sequence[int]
    """Line number of each row."""
    source: Source
    head: int
    """Line number of the headings."""

    def place(self, row: int) -> Place:
        """Return the place in the file of a row; rows are counted from 0."""
        return self.source.place(self.lines[row])

    def lacks(self, identity: str, heading: str) -> Problem:
        """Return the problem that a column is missing, with the most similar headings."""
        kind, bracket, _ = heading.partition("[")
        alike = [name for name in self.headings if bracket and name.startswith(kind + bracket)]
        known = alike or self.headings
        is_part = any(heading in OTHER_SEPARATORS.split(name) for name in known)
        hint = SEPARATOR_HINT if is_part else nearest(heading, known)
        return self.problem(
            identity,
            f"there is no column {quoted(heading)}{hint}; "
            f"columns {f'of {kind} ' * bool(alike)}are {listed(known)}",
        )

    def problem(self, identity: str, message: str) -> Problem:
        """Return a problem at the line of headings."""
        return Problem(identity, message, (), self.source.place(self.head))


def read_record(data: bytes, file: str, wanted: Mapping[str, Measure | None]) -> RecordedColumns:
    """Read the wanted columns that a file contains.

    Parameters
    ----------
    data : bytes
        Content of the file: a line of headings, then a line for each instant. Units can be in a
        line below the headings. After the first row that begins with a number, lines that begin
        with `#` or `%` are comments.
    file : str
        Name of the file, for messages.
    wanted : mapping of str to str or None
        Measure of each wanted column, by its heading without a unit; None accepts any unit. In the
        file a unit can follow the heading in brackets or parentheses.

    Returns
    -------
    RecordedColumns

    Raises
    ------
    ReadError
        Contains every cell of a requested column that is not a finite number, or a repeated column.

    Examples
    --------
    >>> data = b"time,torques[shaft] [kN*m],note\\n0,1.5,on\\n.1,-2,off"
    >>> record = read_record(data, "a.csv", {"torques[shaft]": "si_torque"})
    >>> record.columns["torques[shaft]"]
    array([ 1500., -2000.])
    """
    source = decode(data, file, "a record").source
    rows = numbered_rows(without_titles(source.lines, lambda cell: _wanted(cell, wanted) in wanted))
    problems = []
    lines = array("q")
    try:
        head, first = next(rows, (1, []))
        headings = tuple(unguarded(cell.strip()) for cell in first)
        used = _headings(headings, wanted, source.place(head))
        columns = {heading.column.name: array("d") for heading in used}
        below = next(rows, None)
        if below and (with_units := _with_units(used, below[1], source.place(below[0]))):
            used, below = with_units, None
        places = {heading.column.name: (heading.place, heading.size) for heading in used}
        clock, in_numbers = Clock(), False
        for line, row in chain([below] if below else [], rows):
            if in_numbers and is_comment(row[0]):
                continue
            lines.append(line)
            in_numbers = in_numbers or row[0].strip(" -+.")[:1].isdigit()
            for name, (place, size) in places.items():
                cell = row[place] if place < len(row) else ""
                is_clock = wanted[name] == "time" and ":" in cell
                seconds = clock.seconds(cell) if is_clock else None
                try:
                    columns[name].append(decimal(cell) * size if seconds is None else seconds)
                except ValueError as error:
                    count = f"; the row has {len(row)} of {len(headings)} cells"
                    count = count if place >= len(row) else ""
                    message = f"{name}: read {cell.strip()[:40]!r}, {error}{count}"
                    problems.append(Problem("E121", message, (), source.place(line)))
            if len(problems) >= MOST_PROBLEMS:
                break
    except ValueError as error:
        raise ReadError("E121", str(error), place=source.place(1)) from None
    if problems:
        raise ReadError(problems)
    return RecordedColumns(
        {name: np.array(column) for name, column in columns.items()}, headings, lines, source, head
    )


def _headings(
    cells: Sequence[str], wanted: Mapping[str, Measure | None], head: Place
) -> list[Heading]:
    """Return the headings of the requested columns."""
    headings: dict[str, Heading] = {}
    for place, cell in enumerate(cells):
        name = _wanted(cell, wanted)
        if name in headings:
            raise ReadError(
                "E121", f"{name}: read two columns of this name, expected one", place=head
            )
        if name in wanted:
            measure = wanted[name]
            column = TableColumn(name, measure, may_be_bare=True, any_unit=measure is None)
            heading = Heading(column, place, with_unit(cell)[1] or None if cell != name else None)
            try:
                _ = heading.size
            except ValueError as error:
                raise ReadError("E121", str(error), place=head) from None
            headings[name] = heading
    return list(headings.values())


def _with_units(headings: Sequence[Heading], row: Sequence[str], place: Place) -> list[Heading]:
    """Return headings with the units of the row below; empty if that is not a row of units."""
    try:
        return with_units_below(headings, row)
    except CellError as error:
        raise ReadError("E121", str(error), place=place) from None


def _wanted(heading: str, wanted: Container[str]) -> str:
    """Return the name in a heading: the full heading if requested, else without the unit.

    Capitals in a heading are ignored if the requested name, such as `time`, has none. They matter
    in names with brackets, because `a` and `A` can be two links.
    """
    name, _ = with_unit(heading)
    name = name.lower() if name.lower() in wanted and "[" not in name else name
    return name if name in wanted and heading not in wanted else heading
