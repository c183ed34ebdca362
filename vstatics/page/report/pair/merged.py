"""Tables of two cases merged into one: each row of A, the row of B, and their change.

Rows correspond if their names are equal, and columns if their headings are equal. Gears therefore
correspond by name.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Iterator, Mapping, Sequence

from vstatics.core.comparison.layout import percent
from vstatics.core.comparison.numbers import Difference, is_same
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.tables.grid import Cell, Column, Grid, text
from vstatics.core.tables.written_results import Figure
from vstatics.core.texts import heading, tr
from vstatics.pictures.paged.marks import digits_of

DIFFERS, CHANGE = "differs", "change"
"""CSS class of cells that differ between the cases, and label of rows with changes."""
UNEQUAL = Cell("\N{NOT EQUAL TO}", says=DIFFERS)
"""Cell of a change that is not a percentage, for example of a text or from zero."""
MOST_WORDS = 3
"""Largest number of leading text columns that together identify a row."""
_Keys = Mapping[Hashable, list[Cell]]


def merged(both: Sequence[Grid], labels: str) -> Grid:
    """Merge corresponding tables of two cases.

    Parameters
    ----------
    both : sequence of Grid
        Two tables with equal titles.
    labels : str
        Letters of both cases, such as "AB".

    Examples
    --------
    >>> from vstatics.core.tables.grid import exact
    >>> columns = [text("gear"), Column("ratio"), Column("step")]
    >>> old, new = (
    ...     Grid("Gears", columns, [["1", exact(i), exact(1.5)]]) for i in (4.0, 5.0)
    ... )
    >>> for row in merged([old, new], "AB").texts:
    ...     print(row)
    ['1', 'A', '4.000', '1.500']
    ['1', 'B', '5.000', '1.500']
    ['change', '', '+25.00 %', '']
    """
    columns = [_columns(grid) for grid in both]
    places = {**columns[0], **columns[1]}
    words = _words(both)
    rows = [_by_key(grid, words) for grid in both]
    lines: list[list[Cell | str]] = []
    levels: list[int] = []
    for key in {**rows[0], **rows[1]}:
        key_rows = (grid.get(key) for grid in rows)
        pair = [
            _spread(row, table_columns, places)
            for row, table_columns in zip(key_rows, columns, strict=True)
        ]
        for level, line in _lines(pair, labels):
            lines.append([*line])
            levels.append(level)
    heads = [_head(key, columns, labels) for key in places]
    shown = [heads[0], text("case"), *heads[1:]]
    return both[0]._replace(columns=shown, rows=lines, levels=levels)


def _columns(grid: Grid) -> dict[Hashable, tuple[int, Column]]:
    """Return each column with its index, by heading. Repeated headings have different keys."""
    keys = _numbered([column.heading for column in grid.columns])
    return {key: (place, grid.columns[place]) for place, key in enumerate(keys)}


def _numbered(keys: Sequence[Hashable]) -> list[Hashable]:
    """Return each key with the number of its earlier occurrences, so that the results differ."""
    seen: Counter[Hashable] = Counter()
    numbered: list[Hashable] = []
    for key in keys:
        numbered.append((key, seen[key]))
        seen[key] += 1
    return numbered


def _words(both: Sequence[Grid]) -> int:
    """Return the number of leading text columns that identify the rows of both tables."""
    for count in range(1, MOST_WORDS + 1):
        if any(column.is_number for grid in both for column in grid.columns[1:count]):
            break
        keys = [[tuple(row[:count]) for row in grid.texts] for grid in both]
        if all(len({*table_keys}) == len(table_keys) for table_keys in keys):
            return count
    return 1


def _by_key(grid: Grid, words: int) -> _Keys:
    keys = _numbered([tuple(row[:words]) for row in grid.texts])
    return dict(zip(keys, grid.cells, strict=True))


def _spread(
    row: list[Cell] | None,
    columns: Mapping[Hashable, tuple[int, Column]],
    places: Mapping[Hashable, object],
) -> list[Cell | None] | None:
    """Return a row arranged in the columns of both tables, with gaps for missing columns."""
    if row is None:
        return None
    return [row[columns[key][0]] if key in columns else None for key in places]


def _lines(
    pair: Sequence[list[Cell | None] | None], labels: str
) -> Iterator[tuple[int, list[Cell]]]:
    """Yield the rows of A, of B and of their change, each with its level of indentation."""
    old, new = pair
    same = [True] * len(old or new or ())
    if old and new:
        same = [True, *map(_are_same, old[1:], new[1:])]
    level = 0
    for row, label in zip(pair, labels, strict=True):
        if row is not None:
            level += 1
            yield level, _line(row, label, same)
    head = _of_case((old or new or [None])[0] or Cell(""), labels[0 if old else 1])
    if not (old and new):
        note = tr("not in {case}", case=labels[1 if old else 0])
        yield level + 1, [head._replace(text=note), *[Cell("")] * len(same)]
    elif not all(same):
        triples = zip(same[1:], old[1:], new[1:], strict=True)
        changes = (Cell("") if equal else _change(*cells) for equal, *cells in triples)
        yield level + 1, [head._replace(text=CHANGE, is_said=True), Cell(""), *changes]


def _line(row: Sequence[Cell | None], label: str, same: Sequence[bool]) -> list[Cell]:
    first, *others = (cell or Cell("") for cell in row)
    cells = [
        cell if equal else cell._replace(look=DIFFERS)
        for cell, equal in zip(others, same[1:], strict=True)
    ]
    return [_of_case(first, label), Cell(label), *(_of_case(cell, label) for cell in cells)]


def _of_case(cell: Cell, label: str) -> Cell:
    """Mark a cell with the letter of its case and, for a number, with all digits."""
    if cell.value is None:
        return cell._replace(marks={**cell.marks, "case": label}) if cell.marks else cell
    return cell._replace(marks={"number": digits_of(cell.value), **cell.marks, "case": label})


def _are_same(old: Cell | None, new: Cell | None) -> bool:
    if old is None or new is None:
        return old is new
    if old.value is None or new.value is None:
        return old.text == new.text
    return is_same(Figure(new.value), Figure(old.value), ATOL, RTOL)


def _change(first: Cell | None, second: Cell | None) -> Cell:
    """Return the cell of the relative change of a number, or of a not-equal sign."""
    old, new = (
        cell.value
        if cell is not None and cell.value is not None and cell.kind is float
        else math.nan
        for cell in (first, second)
    )
    change = percent(Difference("", "", "", new, old).deviation)
    return Cell(change) if change else UNEQUAL


def _head(
    key: Hashable, columns: Sequence[Mapping[Hashable, tuple[int, Column]]], labels: str
) -> Column:
    """Return the merged column of a heading, with a note if either case lacks it."""
    owners = [
        label
        for label, columns_of_case in zip(labels, columns, strict=True)
        if key in columns_of_case
    ]
    column = next(columns_of_case[key][1] for columns_of_case in columns if key in columns_of_case)
    if len(owners) == len(labels):
        return column
    # Headings below a common heading are names, so they are not translated.
    name = column.heading if column.over or column.is_name else heading(column.heading)
    over = f"{tr(column.over)} {tr('only in {case}', case=owners[0])}".strip()
    return column._replace(heading=name, over=over)
