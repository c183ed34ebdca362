"""Tables with colours for terminals, written with the package `rich`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

from rich import box
from rich.cells import cell_len
from rich.table import Table as RichTable
from rich.text import Text

from vstatics.core.groups import filled
from vstatics.core.tables.grid import Cell, Grid

MANY_ROWS = 20
"""Number of rows above which headings are repeated below a table: a terminal often has 24 lines."""


class _TerminalColumn(NamedTuple):
    """Column for a terminal: heading, texts, and three widths in characters."""

    heading: Text
    texts: list[Text]
    least: int
    """Smallest width at which no word or number is cut."""
    whole: int
    """Smallest width at which no text below the heading is folded."""
    natural: int
    """Smallest width at which neither a text nor the heading is folded."""
    is_number: bool
    may_fold: bool


def tables(grid: Grid, width: int, keys: int = 1) -> list[RichTable]:
    """Return a table without a title, or several tables if the columns are too wide.

    A word is cut only if it is wider than the terminal. Columns of signs have small gaps, or no
    gaps if their headings are single letters. A long table repeats its headings below the last row.

    Parameters
    ----------
    grid : Grid
    width : int
        Width of the terminal, in characters.
    keys : int, optional
        Number of leading columns that are repeated in each table.
    """
    grid = grid.spoken
    columns = [_column(grid, group) for group in _groups(grid)]
    first, others = columns[:keys], columns[keys:]
    room = width - _sum(column.least for column in first)
    parts = filled(others, room, lambda column: _sum([column.least]))
    return [_table([*first, *part], width) for part in parts]


def natural_width(grid: Grid) -> int:
    """Return the width of a table without folded lines [characters]."""
    grid = grid.spoken
    return _sum(_column(grid, group).natural for group in _groups(grid))


def whole_width(grid: Grid) -> int:
    """Return the smallest width at which only headings are folded [characters]."""
    grid = grid.spoken
    columns = (_column(grid, group) for group in _groups(grid))
    return _sum(max(column.least, column.whole) for column in columns)


def _sum(widths: Iterable[int]) -> int:
    """Return the width of a table from its column widths, with gaps of two blanks."""
    return sum(width + 2 for width in widths)


def _column(grid: Grid, group: Sequence[int]) -> _TerminalColumn:
    column = grid.columns[group[0]]
    cells = [row[group[0]] for row in grid.cells]
    heading = Text(column.heading)
    texts = [Text(cell.text, cell.style) for cell in cells]
    if column.is_sign:
        headings = [grid.columns[index].heading for index in group]
        heading = _signs_in_line([Cell(letter) for letter in headings], headings)
        texts = [_signs_in_line([row[index] for index in group], headings) for row in grid.cells]
    whole = max((text.cell_len for text in texts), default=0)
    natural = max(heading.cell_len, whole)
    may_fold = not (column.is_sign or column.is_number)
    words = (word for text in (heading, *texts) for word in text.plain.split())
    least = max(map(cell_len, words), default=0) if may_fold else natural
    is_number = column.is_number and not column.is_sign
    return _TerminalColumn(heading, texts, least, whole, natural, is_number, may_fold)


def _table(columns: Sequence[_TerminalColumn], width: int) -> RichTable:
    many = len(columns[0].texts) > MANY_ROWS
    table = RichTable(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_footer=many)
    for number, (column, column_width) in enumerate(
        zip(columns, _widths(columns, width), strict=True)
    ):
        table.add_column(
            column.heading,
            column.heading,
            justify="right" if column.is_number else "left",
            style="" if number or not column.may_fold else "bold",
            overflow="fold",
            no_wrap=not column.may_fold,
            width=column_width,
        )
    for row in zip(*(column.texts for column in columns), strict=True):
        table.add_row(*row)
    return table


def _widths(columns: Sequence[_TerminalColumn], width: int) -> list[int]:
    """Return the column widths for which as few texts as possible are folded.

    Columns that need the least additional width get it first: to avoid folded texts, then to avoid
    folded headings.
    """
    least = [column.least for column in columns]
    widths = [max(min(need, width - _sum(least) + need), 1) for need in least]
    for wanted in ([column.whole for column in columns], [column.natural for column in columns]):
        for _ in range(width - _sum(widths)):
            narrow = [number for number, need in enumerate(wanted) if widths[number] < need]
            if not narrow:
                break
            widths[min(narrow, key=lambda number: wanted[number] - widths[number])] += 1
    return widths


def _groups(grid: Grid) -> list[list[int]]:
    """Return groups of column indices. Adjacent columns of signs form a group."""
    indices = range(len(grid.columns))
    groups = groupby(indices, lambda index: -1 if grid.columns[index].is_sign else index)
    return [list(group) for _, group in groups]


def _signs_in_line(cells: Sequence[Cell], headings: Sequence[str]) -> Text:
    """Return a line with a sign below each heading."""
    widths = [cell_len(heading) for heading in headings]
    gap = Text(" " if max(widths) > 1 else "")
    pairs = zip(cells, widths, strict=True)
    return gap.join(Text(cell.text.ljust(width), cell.style) for cell, width in pairs)
