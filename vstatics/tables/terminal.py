"""Tables with colours for a person at a terminal; `rich` is imported by nothing else in tables."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from rich import box
from rich.table import Table as RichTable
from rich.text import Text

from vstatics.tables.grid import Cell, Grid


def table(grid: Grid) -> RichTable:
    """A table without its title; numbers are never cut, words are folded.

    Columns of signs stand side by side, without a gap where their headings are letters.
    """
    made = RichTable(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    shown = []
    for places in _groups(grid):
        column = grid.columns[places[0]]
        cells = [row[places[0]] for row in grid.cells]
        heading = Text(column.heading)
        texts = [Text(cell.text, cell.style) for cell in cells]
        if column.is_sign:
            headings = [grid.columns[place].heading for place in places]
            heading = _beside([Cell(one) for one in headings], headings)
            texts = [_beside([row[place] for place in places], headings) for row in grid.cells]
            made.add_column(heading, no_wrap=True)
        elif column.is_number:
            wide = max(len(cell.text) for cell in cells)
            made.add_column(heading, justify="right", no_wrap=True, min_width=wide)
        else:
            numbers = [cell.text.split()[0] for cell in cells if cell.value is not None]
            wide = max(map(len, numbers), default=0)
            style = "" if places[0] else "bold"
            made.add_column(heading, style=style, overflow="fold", min_width=wide)
        shown.append(texts)
    for row in zip(*shown, strict=True):
        made.add_row(*row)
    return made


def _groups(grid: Grid) -> list[list[int]]:
    """Columns that are one at a terminal: signs beside one another."""
    places = range(len(grid.columns))
    groups = groupby(places, lambda place: -1 if grid.columns[place].is_sign else place)
    return [list(group) for _, group in groups]


def _beside(cells: Sequence[Cell], headings: Sequence[str]) -> Text:
    """One sign under each heading."""
    width = max(map(len, headings))
    gap = Text(" " if width > 1 else "")
    return gap.join(Text(cell.text.ljust(width), cell.style) for cell in cells)
