"""Which columns of a sweep are drawn: those that are named, else those that it runs over."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, listed, quoted
from vstatics.core.numerics.arrays import Floats
from vstatics.core.suggestions import nearest
from vstatics.core.tables.written_results import GEAR, WrittenSweep


class DrawnColumns(NamedTuple):
    """The columns that a user names; nothing: the sweep tells."""

    x: str = ""
    y: Sequence[str] = ()
    z: str = ""
    by: str = ""


class DrawnRows(NamedTuple):
    """The rows that a panel, or a line, shows."""

    name: str
    """The gear, or the value of the column `by`; nothing where all rows are shown."""
    rows: Sequence[int]


LARGEST = 1e300
"""Bound of what is drawn: sums and differences of larger numbers overflow."""


def numbers(sweep: WrittenSweep, name: str) -> Floats:
    """The numbers of a column, NaN where a row has none.

    Raises
    ------
    CaseError
        If there is no such column, or a number of it is too large for an axis.
    """
    if name not in sweep.columns:
        hint = nearest(name, sweep.columns) or f"; columns are {listed(list(sweep.columns), 12)}"
        raise CaseError("E430", f"the sweep has no column {quoted(name)}{hint}")
    column = np.array(sweep.columns[name])
    if np.nanmax(np.abs(column), initial=0.0) > LARGEST:
        message = f"{quoted(name)} has a number above {LARGEST:g}, which cannot be drawn"
        raise CaseError("E433", message)
    return column


def running(sweep: WrittenSweep, besides: Sequence[str] = ()) -> list[str]:
    """The varied numbers that have several values, but some.

    >>> columns = {"a": [1.0, 2.0], "b": [3.0, 3.0], "ratio[1]": [2.0, 3.0]}
    >>> running(WrittenSweep([0, 1], ["ok", "ok"], columns, ("a", "b")))
    ['a']
    """
    return [
        name for name in sweep.varied if name not in besides and len(set(sweep.columns[name])) > 1
    ]


def axis(sweep: WrittenSweep, named: str, besides: Sequence[str], option: str) -> str:
    """The column of an axis: the one that is named, else the varied number that is left.

    Raises
    ------
    CaseError
        If there is no such column, none is left, or several are.
    """
    if named:
        numbers(sweep, named)
        return named
    left = running(sweep, besides)
    if len(left) != 1:
        what = f"runs over {listed(left)}" if left else "has no further varied number"
        raise CaseError("E431", f"the sweep {what}: expected {option} with the name of a column")
    return left[0]


def results_of(sweep: WrittenSweep, besides: Sequence[str]) -> list[str]:
    """The columns that are no varied numbers, but some."""
    return [name for name in sweep.columns if name not in (*sweep.varied, *besides)]


def parts(sweep: WrittenSweep, asked: DrawnColumns, axes: Sequence[str]) -> list[DrawnRows]:
    """The rows by gear, or by the values of the column that is named; else all of them.

    Raises
    ------
    CaseError
        If several rows of a part have the same place on the axes.
    """
    found = list(rows_by(sweep, asked))
    places = [sweep.columns[name] for name in axes]
    for part in found:
        at = [tuple(column[row] for column in places) for row in part.rows]
        if len(set(at)) < len(at):
            others = running(sweep, [*axes, asked.by])
            told = f", which runs over {listed(others)} too" if others else ""
            raise CaseError(
                "E432",
                f"several rows of the sweep have the same {' and '.join(axes)}{told}: expected "
                "--by with a column that tells them apart, or a sweep with fewer numbers",
            )
    return found


def said_of(sweep: WrittenSweep, part: DrawnRows) -> str:
    """What the status of its rows is, each once."""
    return ", ".join(dict.fromkeys(sweep.status[row] for row in part.rows))


def rows_by(sweep: WrittenSweep, asked: DrawnColumns) -> Iterator[DrawnRows]:
    """The rows by gear, or by the values of the column that is named; else all of them.

    >>> sweep = WrittenSweep([0, 0], ["ok", "ok"], {"u": [1.0, 2.0]}, ("u",), ["low", "high"])
    >>> [(part.name, *part.rows) for part in rows_by(sweep, DrawnColumns())]
    [('low', 0), ('high', 1)]
    """
    every, by = range(len(sweep.variants)), asked.by or GEAR * bool(sweep.gears)
    if not by:
        yield DrawnRows("", every)
        return
    if by == GEAR and sweep.gears:
        for gear in dict.fromkeys(sweep.gears):
            yield DrawnRows(gear, [row for row in every if sweep.gears[row] == gear])
        return
    column = numbers(sweep, by)
    for value in np.unique(column[np.isfinite(column)]).tolist():
        yield DrawnRows(f"{by} = {value:g}", np.flatnonzero(column == value).tolist())
