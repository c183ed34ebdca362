"""Signals recorded over time: columns of a CSV file, as `vstatics simulate` writes them."""

from __future__ import annotations

import re
from array import array
from collections.abc import Container, Mapping, Sequence
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, listed, quoted
from vstatics.core.model.shape import Measure
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.csv_rows import decimal, numbered_rows
from vstatics.core.readers.named.headings import TableColumn, is_comment, with_unit, without_titles
from vstatics.core.readers.named.nodes import MOST_PROBLEMS, decode
from vstatics.core.readers.reading import Source
from vstatics.core.readers.unit_table import Clock
from vstatics.core.suggestions import nearest
from vstatics.core.tables.csv import unguarded

_UNIT = re.compile(r"(?!nan|inf)(?:[^\W\d_]|1/|°)", re.IGNORECASE)
"""Pattern of the beginning of a unit. The texts `nan` and `inf` are undefined numbers."""


class RecordedColumns(NamedTuple):
    """Requested columns of a recorded file, in SI units, by name."""

    columns: Mapping[str, Floats]
    headings: tuple[str, ...]
    """Headings of all columns of the file."""
    lines: Sequence[int]
    """Line number of each row."""
    source: Source

    def place(self, row: int) -> Place:
        """Return the place in the file of a row; rows are counted from 0."""
        return self.source.place(self.lines[row])

    def lacks(self, identity: str, heading: str) -> Problem:
        """Return the problem that a column is missing, with the most similar headings."""
        kind, bracket, _ = heading.partition("[")
        alike = [name for name in self.headings if bracket and name.startswith(kind + bracket)]
        known = alike or self.headings
        return self.problem(
            identity,
            f"there is no column {quoted(heading)}{nearest(heading, known)}; "
            f"columns {f'of {kind} ' * bool(alike)}are {listed(known)}",
        )

    def problem(self, identity: str, message: str) -> Problem:
        """Return a problem at the line of headings."""
        return Problem(identity, message, (), self.source.place(1))


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
        places = _places(headings, wanted, source.place(head))
        columns = {name: array("d") for name in places}
        below = next(rows, None)
        if below and (with_units := _with_units(headings, below[1], wanted, places)):
            places, below = with_units, None
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
                    message = f"{name}: read {cell.strip()[:40]!r}, {error}"
                    problems.append(Problem("E121", message, (), source.place(line)))
            if len(problems) >= MOST_PROBLEMS:
                break
    except ValueError as error:
        raise ReadError("E121", str(error), place=source.place(1)) from None
    if problems:
        raise ReadError(problems)
    return RecordedColumns(
        {name: np.array(column) for name, column in columns.items()}, headings, lines, source
    )


def _places(
    headings: Sequence[str], wanted: Mapping[str, Measure | None], head: Place
) -> dict[str, tuple[int, float]]:
    """Return the index of each requested column, and the factor from the unit to SI."""
    places = {}
    for place, heading in enumerate(headings):
        name = _wanted(heading, wanted)
        if name in places:
            raise ReadError(
                "E121", f"{name}: read two columns of this name, expected one", place=head
            )
        if name in wanted:
            measure, size = wanted[name], 1.0
            if measure is not None and heading != name:
                column = TableColumn(name, measure, may_be_bare=True)
                try:
                    size = column.size(with_unit(heading)[1] or None)
                except ValueError as error:
                    raise ReadError("E121", str(error), place=head) from None
            places[name] = place, size
    return places


def _with_units(
    headings: Sequence[str],
    row: Sequence[str],
    wanted: Mapping[str, Measure | None],
    places: Mapping[str, tuple[int, float]],
) -> dict[str, tuple[int, float]]:
    """Return the index and the factor of each column, with units from the row below the headings.

    The result is empty if the row is not a row of units. If it contains a unit of time, the cells
    of other columns can be empty.
    """
    units = [cell.strip().strip("[]()") for cell in row]
    some = any(map(TableColumn("time", "time").accepts, units))
    if len(units) < len(headings) or not all(
        _UNIT.match(units[place]) or (some and not units[place]) for place, _ in places.values()
    ):
        return {}
    named = [f"{heading} [{unit}]" for heading, unit in zip(headings, units, strict=True)]
    try:
        with_units = _places(named, wanted, Place("", 1, 1))
    except ReadError:
        return {}
    return with_units if with_units.keys() == places.keys() else {}


def _wanted(heading: str, wanted: Container[str]) -> str:
    """Return the name in a heading: the full heading if requested, else without the unit.

    Capitals in a heading are ignored if the requested name, such as `time`, has none. They matter
    in names with brackets, because `a` and `A` can be two links.
    """
    name, _ = with_unit(heading)
    name = name.lower() if name.lower() in wanted and "[" not in name else name
    return name if name in wanted and heading not in wanted else heading
