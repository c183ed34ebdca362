"""Tables as plain text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, zip_longest
from textwrap import wrap

from vstatics.core.groups import filled
from vstatics.core.tables.grid import Grid

TABLE_WIDTH = 80
"""Largest number of characters in a line.

Wider tables are split between columns of numbers, or between pairs of number and word.
"""
_COMMA = re.compile(r"(?<=,) ")
GAP = "  "
INDENT = "  "
"""Indentation of a row for each level."""


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    """Return titles and tables as plain text.

    Examples
    --------
    >>> from vstatics.core.tables.grid import Column
    >>> grid = Grid("Gears", [Column("gear", is_number=False), Column("ratio")], [["1", "3.500"]])
    >>> print(write(["box"], [grid]), end="")
    box
    <BLANKLINE>
    Gears
    gear  ratio
    1     3.500
    """
    parts = [list(titles)] if titles else []
    for grid in tables:
        part = list(lines(grid))
        if grid.title:  # a title can be a whole sentence
            part[:1] = wrap(part[0], TABLE_WIDTH, break_long_words=False, break_on_hyphens=False)
        parts.append(part)
    return "\n\n".join("\n".join(part) for part in parts) + "\n"


def lines(
    grid: Grid, *, widths: Sequence[int] = (), gap: str = GAP, indent: str = ""
) -> Iterator[str]:
    """Yield the lines of a table, with a line of headings unless all headings are empty.

    Parameters
    ----------
    grid : Grid
    widths : sequence of int, optional
        Fixed widths of the columns, to align several tables. A longer cell shifts the cells after
        it. A longer first cell has its own line. Default: the width of the widest cell.
    gap : str, optional
        Text between columns.
    indent : str, optional
        Text before all lines but the title.
    """
    grid = grid.spoken
    if grid.title:
        yield grid.title
    if not grid.rows:
        return
    rows = [[column.heading for column in grid.columns], *grid.texts]
    for row, level in zip(rows[1:], grid.levels, strict=False):
        row[0] = INDENT * (level - 1) + row[0]
    if not widths and len(_inseparable(grid)) == 1:
        lists = [place for place, column in enumerate(grid.columns) if not column.is_number]
        rows = _folded(rows, lists, TABLE_WIDTH - len(indent) - len(gap) * (len(rows[0]) - 1))
    widths = widths or _widths(rows)
    first = 0 if any(rows[0]) else 1
    for number, columns in enumerate(_pieces(grid, widths, TABLE_WIDTH - len(indent), len(gap))):
        if number:
            yield ""
        for row in rows[first:]:
            if len(row[0]) > widths[0]:
                yield f"{indent}{row[0]}".rstrip()
                row = ["", *row[1:]]  # noqa: PLW2901 - the cells after the first
            padded = (
                (str.rjust if grid.columns[column].is_number else str.ljust)(
                    row[column], widths[column]
                )
                for column in columns
            )
            yield f"{indent}{gap.join(padded)}".rstrip()


def _widths(rows: Iterable[Sequence[str]]) -> list[int]:
    return [max(map(len, column)) for column in zip(*rows, strict=True)]


def _folded(rows: list[list[str]], lists: Sequence[int], room: int) -> list[list[str]]:
    """Return rows no wider than `room`, if commas in the columns `lists` permit it.

    >>> _folded([["set", "sun: a, ring: b, carrier: c"]], [1], 20)
    [['set', 'sun: a, ring: b,'], ['', 'carrier: c']]
    """
    widths = _widths(rows)
    if sum(widths) <= room:
        return rows
    for place in sorted(lists, key=lambda place: -widths[place]):
        least = max(len(part) for row in rows for part in _COMMA.split(row[place]))
        widths[place] = max(least, widths[place] + min(room - sum(widths), 0))
    return [
        list(line)
        for row in rows
        for line in zip_longest(
            *(
                broken(_COMMA.split(cell), width, indent="")
                for cell, width in zip(row, widths, strict=True)
            ),
            fillvalue="",
        )
    ]


def broken(parts: Sequence[str], width: int = TABLE_WIDTH, indent: str = 2 * INDENT) -> list[str]:
    """Return lines of a text, broken only between `parts`.

    Examples
    --------
    >>> broken(["1 lock-up,", "2 forward,", "3 reverse"], width=22)
    ['1 lock-up, 2 forward,', '    3 reverse']
    """
    fitting = [parts[0]]
    for part in parts[1:]:
        if len(fitting[-1]) + 1 + len(part) <= width:
            fitting[-1] += f" {part}"
        else:
            fitting.append(f"{indent}{part}")
    return fitting


def _pieces(grid: Grid, widths: Sequence[int], room: int, gap: int) -> Iterator[list[int]]:
    """Yield the columns of each piece of a split table. The first column is repeated."""
    for groups in filled(
        _inseparable(grid),
        room - widths[0],
        lambda group: sum(gap + widths[column] for column in group),
    ):
        yield [0, *chain.from_iterable(groups)]


def _inseparable(grid: Grid) -> list[list[int]]:
    """Return the groups of columns that must stay together, after the first column.

    Columns of numbers, or pairs of number and word, can be separated. Other tables are not split.
    """
    kinds = [column.is_number for column in grid.columns[1:]]
    places = list(range(1, len(kinds) + 1))
    if all(kinds):
        return [[place] for place in places]
    if kinds == [True, False] * (len(kinds) // 2):
        return [places[at : at + 2] for at in range(0, len(places), 2)]
    return [places]
