"""Selection of the columns of a sweep to draw: named columns, or columns that vary."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, listed, quoted
from vstatics.core.numerics.arrays import Floats
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import plain_names
from vstatics.core.tables.written_results import GEAR, WrittenSweep
from vstatics.sweep.pictures.map_options import MapOptions


class DrawnColumns(NamedTuple):
    """Columns that the user names; an empty name leaves the choice to the picture."""

    x: str = ""
    y: Sequence[str] = ()
    z: str = ""
    by: str = ""
    of_map: MapOptions = MapOptions()


def drawn_columns(x: str, y: Sequence[str], z: str, by: str) -> DrawnColumns:
    """Return the columns that a user names. Deck names of tables are replaced.

    >>> drawn_columns("load.torque", ["ETA[low]"], "", "").y
    ('efficiency[low]',)
    """
    return DrawnColumns(plain_names(x), tuple(map(plain_names, y)), plain_names(z), plain_names(by))


def with_units(sweep: WrittenSweep, selected: DrawnColumns) -> DrawnColumns:
    """Return the named columns with the units of the headings, which the user can omit.

    >>> sweep = WrittenSweep([0], ["ok"], {"load.speed [rpm]": [9.0]}, ("load.speed [rpm]",))
    >>> with_units(sweep, DrawnColumns("load.speed")).x
    'load.speed [rpm]'
    """

    def heading(name: str) -> str:
        alike = [column for column in sweep.columns if column.partition(" [")[0] == name]
        return alike[0] if len(alike) == 1 and name not in sweep.columns else name

    x, z, by = map(heading, (selected.x, selected.z, selected.by))
    return selected._replace(x=x, y=tuple(map(heading, selected.y)), z=z, by=by)


class DrawnRows(NamedTuple):
    """Rows of a sweep that a panel or curve shows."""

    name: str
    """Name of the gear, or value of the column `by`; empty if the panel shows all rows."""
    rows: Sequence[int]


LARGEST = 1e300
"""Largest number that can be drawn; sums and differences of larger numbers could overflow."""


def numbers(sweep: WrittenSweep, name: str) -> Floats:
    """Return the numbers of a column; NaN for rows without a number.

    Raises
    ------
    CaseError
        If the column does not exist, or a number is too large for an axis.
    """
    if name not in sweep.columns:
        hint = nearest(name, sweep.columns) or f"; columns are {listed(list(sweep.columns), 12)}"
        raise CaseError("E430", f"the sweep has no column {quoted(name)}{hint}")
    column = np.array(sweep.columns[name])
    if np.nanmax(np.abs(column), initial=0.0) > LARGEST:
        message = f"{quoted(name)} has a number above {LARGEST:g}, which cannot be drawn"
        raise CaseError("E433", message)
    return column


def running(sweep: WrittenSweep, excluded: Sequence[str] = (), axes: int = 1) -> list[str]:
    """List the varied columns with several values, except the excluded columns.

    The excluded and the listed columns can already fill the axes of the picture. A further column
    that is a function of these columns, such as a linked number, is then left out.

    >>> columns = {"a": [1.0, 2.0], "b": [3.0, 3.0], "c": [1.0, 4.0], "ratio[1]": [2.0, 3.0]}
    >>> sweep = WrittenSweep([0, 1], ["ok", "ok"], columns, ("a", "b", "c"))
    >>> running(sweep), running(sweep, axes=2), running(sweep, ["c"])
    (['a'], ['a', 'c'], [])
    """
    varied = [name for name in sweep.varied if len(set(sweep.columns[name])) > 1]
    before = [name for name in varied if name in excluded]
    count = len(before)
    for name in varied:
        if name not in excluded and (len(before) < axes or not _follows(sweep, name, before)):
            before.append(name)
    return before[count:]


def _follows(sweep: WrittenSweep, name: str, before: Sequence[str]) -> bool:
    """Return whether a column is a function of a grid of columns, or of a monotonic column.

    Columns of a random sample do not count: they are not monotonic, and do not form a grid.
    """
    columns = [sweep.columns[other] for other in before]
    places = list(zip(*columns, strict=True))
    values = dict(zip(places, sweep.columns[name], strict=True))
    if any(
        values[place] != value for place, value in zip(places, sweep.columns[name], strict=True)
    ):
        return False
    if len(columns) == 1:
        return columns[0] in (sorted(columns[0]), sorted(columns[0], reverse=True))
    return len(values) > max(len(set(column)) for column in columns)


def axis(
    sweep: WrittenSweep, named: str, excluded: Sequence[str], option: str, axes: int = 1
) -> str:
    """Return the column of an axis: the named column, or else the only remaining varied column.

    Raises
    ------
    CaseError
        If the named column does not exist, or not exactly one varied column is left.
    """
    if named:
        numbers(sweep, named)
        return named
    left = running(sweep, excluded, axes)
    if len(left) != 1:
        what = f"varies {listed(left)}" if left else "has no further varied number"
        raise CaseError("E431", f"the sweep {what}: expected {option} with the name of a column")
    return left[0]


def results_of(sweep: WrittenSweep, excluded: Sequence[str]) -> list[str]:
    """List the columns of results, except the excluded columns."""
    return [name for name in sweep.columns if name not in (*sweep.varied, *excluded)]


def parts(sweep: WrittenSweep, selected: DrawnColumns, axes: Sequence[str]) -> list[DrawnRows]:
    """Return the rows of each panel or curve. Rows of a panel must have unique coordinates.

    Raises
    ------
    CaseError
        If several rows of a panel or curve have equal values in the columns of the axes.
    """
    row_groups = list(rows_by(sweep, selected))
    places = [sweep.columns[name] for name in axes]
    for part in row_groups:
        at = [tuple(column[row] for column in places) for row in part.rows]
        if len(set(at)) < len(at):
            others = running(sweep, [*axes, selected.by])
            hint = f", as it also varies {listed(others)}" if others else ""
            raise CaseError(
                "E432",
                f"several rows of the sweep have the same {' and '.join(axes)}{hint}: expected "
                "--by with a column that distinguishes them, or a sweep with fewer varied numbers",
            )
    return row_groups


def rows_by(sweep: WrittenSweep, selected: DrawnColumns) -> Iterator[DrawnRows]:
    """Yield the rows by gear or by the values of the column `by`, or all rows together.

    >>> sweep = WrittenSweep([0, 0], ["ok", "ok"], {"u": [1.0, 2.0]}, ("u",), ["low", "high"])
    >>> [(part.name, *part.rows) for part in rows_by(sweep, DrawnColumns())]
    [('low', 0), ('high', 1)]
    """
    every, by = range(len(sweep.variants)), selected.by or GEAR * bool(sweep.gears)
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
