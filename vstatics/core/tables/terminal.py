"""Tables with colours for a person at a terminal; `rich` is imported by nothing else in tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

from rich import box
from rich.cells import cell_len
from rich.table import Table as RichTable
from rich.text import Text

from vstatics.core.tables.grid import Cell, Grid


class _TerminalColumn(NamedTuple):
    """A column at a terminal: texts below a heading, and the widths that it can have."""

    heading: Text
    texts: list[Text]
    least: int
    """With no word cut, and no number."""
    whole: int
    """With no text below the heading folded."""
    natural: int
    """With no line folded."""
    is_number: bool
    may_fold: bool


def tables(grid: Grid, width: int, keys: int = 1) -> list[RichTable]:
    """A table without its title, or several below one another where it is too wide.

    Words are cut only where one alone is too wide. Columns of signs stand side by side,
    without a gap where their headings are letters.

    Parameters
    ----------
    grid : Grid
    width : int
        Of the terminal, in characters.
    keys : int, optional
        So many columns stand in each of the tables.
    """
    grid = grid.spoken
    places = [_place(grid, group) for group in _groups(grid)]
    parts = [list(range(keys))]
    for number in range(keys, len(places)):
        if len(parts[-1]) > keys and _sum(places[n].least for n in [*parts[-1], number]) > width:
            parts.append(list(range(keys)))
        parts[-1].append(number)
    return [_table([places[number] for number in part], width) for part in parts]


def natural_width(grid: Grid) -> int:
    """The width of a table whose lines are not folded, in characters."""
    grid = grid.spoken
    return _sum(_place(grid, group).natural for group in _groups(grid))


def _sum(widths: Iterable[int]) -> int:
    """The width of a table with columns of these widths: two blanks go with each."""
    return sum(width + 2 for width in widths)


def _place(grid: Grid, group: Sequence[int]) -> _TerminalColumn:
    column = grid.columns[group[0]]
    cells = [row[group[0]] for row in grid.cells]
    heading = Text(column.heading)
    texts = [Text(cell.text, cell.style) for cell in cells]
    if column.is_sign:
        headings = [grid.columns[place].heading for place in group]
        heading = _beside([Cell(one) for one in headings], headings)
        texts = [_beside([row[place] for place in group], headings) for row in grid.cells]
    whole = max((text.cell_len for text in texts), default=0)
    natural = max(heading.cell_len, whole)
    may_fold = not (column.is_sign or column.is_number)
    words = (word for text in (heading, *texts) for word in text.plain.split())
    least = max(map(cell_len, words), default=0) if may_fold else natural
    is_number = column.is_number and not column.is_sign
    return _TerminalColumn(heading, texts, least, whole, natural, is_number, may_fold)


def _table(places: Sequence[_TerminalColumn], width: int) -> RichTable:
    made = RichTable(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    for number, (place, wide) in enumerate(zip(places, _widths(places, width), strict=True)):
        made.add_column(
            place.heading,
            justify="right" if place.is_number else "left",
            style="" if number or not place.may_fold else "bold",
            overflow="fold",
            no_wrap=not place.may_fold,
            width=wide,
        )
    for row in zip(*(place.texts for place in places), strict=True):
        made.add_row(*row)
    return made


def _widths(places: Sequence[_TerminalColumn], width: int) -> list[int]:
    """Of the columns: the least ones, then what room is left goes to those that lack least.

    First so that no text folds, then no heading, which costs one line at most.
    """
    least = [place.least for place in places]
    widths = [max(min(one, width - _sum(least) + one), 1) for one in least]
    for wanted in ([one.whole for one in places], [one.natural for one in places]):
        for _ in range(width - _sum(widths)):
            narrow = [number for number, most in enumerate(wanted) if widths[number] < most]
            if not narrow:
                break
            widths[min(narrow, key=lambda number: wanted[number] - widths[number])] += 1
    return widths


def _groups(grid: Grid) -> list[list[int]]:
    """Columns that are one at a terminal: signs beside one another."""
    places = range(len(grid.columns))
    groups = groupby(places, lambda place: -1 if grid.columns[place].is_sign else place)
    return [list(group) for _, group in groups]


def _beside(cells: Sequence[Cell], headings: Sequence[str]) -> Text:
    """One sign under each heading."""
    widths = [cell_len(heading) for heading in headings]
    gap = Text(" " if max(widths) > 1 else "")
    pairs = zip(cells, widths, strict=True)
    return gap.join(Text(cell.text.ljust(width), cell.style) for cell, width in pairs)
