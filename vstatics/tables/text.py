"""Tables of a summary as plain text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vstatics.tables.grid import Column, Grid

WIDTH = 80
"""A table that is wider goes on below, where its last column is one of numbers."""
GAP = "  "


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    """Tables one below the other.

    Examples
    --------
    >>> grid = Grid("Gears", [Column("gear", is_number=False), Column("ratio")], [["1", "3.500"]])
    >>> print(write(["box"], [grid]), end="")
    box
    <BLANKLINE>
    Gears
    gear  ratio
    1     3.500
    """
    parts = [list(titles)] if titles else []
    parts += [_table(grid) for grid in tables]
    return "\n\n".join("\n".join(lines) for lines in parts) + "\n"


def _table(grid: Grid) -> list[str]:
    lines = [grid.title]
    if not grid.rows:
        return lines
    for number, chosen in enumerate(_pieces(grid)):
        lines += [""] * bool(number)
        lines += _lines(
            [grid.columns[place] for place in chosen],
            [[row[place] for place in chosen] for row in grid.rows],
        )
    return lines


def _widths(grid: Grid) -> list[int]:
    cells = [[column.heading for column in grid.columns], *grid.rows]
    return [max(map(len, column)) for column in zip(*cells, strict=True)]


def _pieces(grid: Grid) -> Iterator[list[int]]:
    """Columns that stand beside one another; the first one is repeated."""
    widths = _widths(grid)
    chosen, width = [0], widths[0]
    for place in range(1, len(widths)):
        width += len(GAP) + widths[place]
        if width > WIDTH and len(chosen) > 1 and all(one.is_number for one in grid.columns[1:]):
            yield chosen
            chosen, width = [0], widths[0] + len(GAP) + widths[place]
        chosen.append(place)
    yield chosen


def _lines(columns: Sequence[Column], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    widths = _widths(Grid("", columns, rows))
    for row in ([column.heading for column in columns], *rows):
        cells = (
            cell.rjust(width) if column.is_number else cell.ljust(width)
            for cell, column, width in zip(row, columns, widths, strict=True)
        )
        yield GAP.join(cells).rstrip()
