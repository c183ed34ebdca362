"""What was recorded over time: some columns of a CSV file, as `vstatics simulate` writes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.errors import Place, Problem, ReadError, listed, nearest, quoted
from vstatics.model.shape import Measure
from vstatics.numerics.arrays import Floats
from vstatics.readers.named.csv_rows import decimal, numbered_rows
from vstatics.readers.named.nodes import MOST_PROBLEMS, decode
from vstatics.readers.named.si_units import measured
from vstatics.readers.reading import Source
from vstatics.tables.csv import unguarded


class RecordedColumns(NamedTuple):
    """Columns that were found, in SI, by their names."""

    columns: Mapping[str, Floats]
    headings: tuple[str, ...]
    """All that there are."""
    lines: Sequence[int]
    """Of the rows."""
    source: Source

    def place(self, row: int) -> Place:
        """Where a row stands, counted from 0."""
        return self.source.place(self.lines[row])

    def lacks(self, identity: str, heading: str) -> Problem:
        """The problem that a column is missing; those of its kind are told, if there are some."""
        kind, bracket, _ = heading.partition("[")
        such = [one for one in self.headings if bracket and one.startswith(kind + bracket)]
        known = such or self.headings
        there = f"columns {f'of {kind} ' * bool(such)}are {listed(known)}"
        message = f"there is no column {quoted(heading)}{nearest(heading, known)}; {there}"
        return self.problem(identity, message)

    def problem(self, identity: str, message: str) -> Problem:
        """A problem of the columns as such."""
        return Problem(identity, message, (), self.source.place(1))


def read_record(data: bytes, file: str, wanted: Mapping[str, Measure | None]) -> RecordedColumns:
    """Read those of the wanted columns that there are.

    Parameters
    ----------
    data : bytes
        A line of headings, then a line for each instant.
    file : str
        Its name, for messages.
    wanted : mapping of str to str
        Headings, behind which a unit may stand in brackets, with what they measure; None: whatever
        their unit is.

    Raises
    ------
    ReadError
        With every cell of these that is no finite number, and its line, or a column that is there
        twice.

    Examples
    --------
    >>> data = b"time,torques[shaft] [kN*m],note\\n0,1.5,on\\n.1,-2,off"
    >>> record = read_record(data, "a.csv", {"torques[shaft]": "si_torque"})
    >>> record.columns["torques[shaft]"]
    array([ 1500., -2000.])
    """
    source = decode(data, file, "a record").source
    try:
        rows = numbered_rows(source.lines)
    except ValueError as error:
        raise ReadError([Problem("E121", str(error), (), source.place(1))]) from None
    head, first = rows.pop(0) if rows else (1, [])
    headings = tuple(unguarded(cell.strip()) for cell in first)
    places: dict[str, tuple[int, float]] = {}
    for place, heading in enumerate(headings):
        name, size = _named(heading, wanted, source, head)
        if name in places:
            message = f"{name}: read two columns of this name, expected one"
            raise ReadError([Problem("E121", message, (), source.place(head))])
        if name in wanted:
            places[name] = place, size
    problems: list[Problem] = []
    values: dict[str, list[float]] = {name: [] for name in places}
    for line, row in rows:
        for name, (place, size) in places.items():
            cell = row[place].strip() if place < len(row) else ""
            try:
                values[name].append(decimal(cell) * size)
            except ValueError as error:
                message = f"{name}: read {cell[:40]!r}, {error}"
                problems.append(Problem("E121", message, (), source.place(line)))
        if len(problems) >= MOST_PROBLEMS:
            break
    if problems:
        raise ReadError(problems)
    made = {name: np.array(column) for name, column in values.items()}
    return RecordedColumns(made, headings, [line for line, _ in rows], source)


def _named(
    heading: str, wanted: Mapping[str, Measure | None], source: Source, line: int
) -> tuple[str, float]:
    """The name that a heading has without its unit, and the size of that in SI."""
    name, bracket, unit = heading.rpartition(" [")
    measure = wanted.get(name.strip())
    if heading in wanted or not bracket or name.strip() not in wanted:
        return heading, 1.0
    if measure is None:
        return name.strip(), 1.0
    try:
        return name.strip(), measured(f"1 {unit.removesuffix(']')}", measure)
    except ValueError as error:
        message = f"{name.strip()}: read the unit {unit.removesuffix(']')[:40]!r}, {error}"
        raise ReadError([Problem("E121", message, (), source.place(line))]) from None
