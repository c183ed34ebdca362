"""Tables of two cases as one: a row of each below that of the other, then how they differ.

Rows are those of one name, columns those of one heading; gears go by their names so.
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
"""The class of what is not the same, and what heads a row that tells by how much."""
UNEQUAL = Cell("\N{NOT EQUAL TO}", says=DIFFERS)
"""Of what is no number, or differs from 0 or from nothing."""
MOST_WORDS = 3
"""So many columns at most tell rows apart."""
_Keys = Mapping[Hashable, list[Cell]]


def merged(both: Sequence[Grid], labels: str) -> Grid:
    """The tables of two cases as one.

    Parameters
    ----------
    both : sequence of Grid
        Of one title.
    labels : str
        A letter for each.

    Examples
    --------
    >>> from vstatics.core.tables.grid import exact
    >>> columns = [text("gear"), Column("ratio"), Column("step")]
    >>> one, other = (
    ...     Grid("Gears", columns, [["1", exact(i), exact(1.5)]]) for i in (4.0, 5.0)
    ... )
    >>> for row in merged([one, other], "AB").texts:
    ...     print(row)
    ['1', 'A', '4.000', '1.500']
    ['1', 'B', '5.000', '1.500']
    ['change', '', '+25.00 %', '']
    """
    columns = [_columns(one) for one in both]
    places = {**columns[0], **columns[1]}
    words = _words(both)
    rows = [_by_key(one, words) for one in both]
    lines: list[list[Cell | str]] = []
    levels: list[int] = []
    for key in {**rows[0], **rows[1]}:
        own = (one.get(key) for one in rows)
        pair = [_spread(row, there, places) for row, there in zip(own, columns, strict=True)]
        for level, line in _lines(pair, labels):
            lines.append([*line])
            levels.append(level)
    heads = [_head(key, columns, labels) for key in places]
    shown = [heads[0], text("case"), *heads[1:]]
    return both[0]._replace(columns=shown, rows=lines, levels=levels)


def _columns(grid: Grid) -> dict[Hashable, tuple[int, Column]]:
    """Columns with their places, by their headings; one heading may stand over several."""
    keys = _numbered([one.heading for one in grid.columns])
    return {key: (place, grid.columns[place]) for place, key in enumerate(keys)}


def _numbered(keys: Sequence[Hashable]) -> list[Hashable]:
    """The same, each with how many of its kind stand before it."""
    seen: Counter[Hashable] = Counter()
    found: list[Hashable] = []
    for key in keys:
        found.append((key, seen[key]))
        seen[key] += 1
    return found


def _words(both: Sequence[Grid]) -> int:
    """How many first columns tell the rows of both tables apart."""
    for count in range(1, MOST_WORDS + 1):
        if any(column.is_number for one in both for column in one.columns[1:count]):
            break
        keys = [[tuple(row[:count]) for row in one.texts] for one in both]
        if all(len({*own}) == len(own) for own in keys):
            return count
    return 1


def _by_key(grid: Grid, words: int) -> _Keys:
    keys = _numbered([tuple(row[:words]) for row in grid.texts])
    return dict(zip(keys, grid.cells, strict=True))


def _spread(
    row: list[Cell] | None,
    there: Mapping[Hashable, tuple[int, Column]],
    places: Mapping[Hashable, object],
) -> list[Cell | None] | None:
    """A row with a cell for each column of both tables."""
    if row is None:
        return None
    return [row[there[key][0]] if key in there else None for key in places]


def _lines(
    pair: Sequence[list[Cell | None] | None], labels: str
) -> Iterator[tuple[int, list[Cell]]]:
    """The rows of both cases, and what is other between them; each level stays below the last."""
    one, other = pair
    same = [True] * len(one or other or ())
    if one and other:
        same = [True, *map(_are_same, one[1:], other[1:])]
    level = 0
    for row, label in zip(pair, labels, strict=True):
        if row is not None:
            level += 1
            yield level, _line(row, label, same)
    head = _of_case((one or other or [None])[0] or Cell(""), labels[0 if one else 1])
    if not (one and other):
        said = tr("not in {case}", case=labels[1 if one else 0])
        yield level + 1, [head._replace(text=said), *[Cell("")] * len(same)]
    elif not all(same):
        told = zip(same[1:], one[1:], other[1:], strict=True)
        changes = (Cell("") if equal else _change(*cells) for equal, *cells in told)
        yield level + 1, [head._replace(text=CHANGE, is_said=True), Cell(""), *changes]


def _line(row: Sequence[Cell | None], label: str, same: Sequence[bool]) -> list[Cell]:
    first, *others = (one or Cell("") for one in row)
    cells = [
        cell if equal else cell._replace(look=DIFFERS)
        for cell, equal in zip(others, same[1:], strict=True)
    ]
    return [_of_case(first, label), Cell(label), *(_of_case(one, label) for one in cells)]


def _of_case(cell: Cell, label: str) -> Cell:
    """A cell that says of which case it is, and a number with all digits."""
    if cell.value is None:
        return cell._replace(marks={**cell.marks, "case": label}) if cell.marks else cell
    return cell._replace(marks={"number": digits_of(cell.value), **cell.marks, "case": label})


def _are_same(one: Cell | None, other: Cell | None) -> bool:
    if one is None or other is None:
        return one is other
    if one.value is None or other.value is None:
        return one.text == other.text
    return is_same(Figure(other.value), Figure(one.value), ATOL, RTOL)


def _change(one: Cell | None, other: Cell | None) -> Cell:
    """By how much a number is another one, else a sign that it is."""
    old, new = (
        one.value if one is not None and one.value is not None and one.kind is float else math.nan
        for one in (one, other)
    )
    said = percent(Difference("", "", "", new, old).deviation)
    return Cell(said) if said else UNEQUAL


def _head(
    key: Hashable, columns: Sequence[Mapping[Hashable, tuple[int, Column]]], labels: str
) -> Column:
    """A column, which says over it if only one case has it."""
    own = [label for label, one in zip(labels, columns, strict=True) if key in one]
    column = next(one[key][1] for one in columns if key in one)
    if len(own) == len(labels):
        return column
    # what has something over it is not translated any more
    says = column.heading if column.over or column.is_name else heading(column.heading)
    over = f"{tr(column.over)} {tr('only in {case}', case=own[0])}".strip()
    return column._replace(heading=says, over=over)
