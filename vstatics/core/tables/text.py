"""Tables as plain text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.tables.grid import Grid

TABLE_WIDTH = 80
"""A table that is wider goes on below, if its columns are numbers, or numbers and words in turn."""
GAP = "  "
INDENT = "  "
"""Of a level."""


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    """Tables one below the other.

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
    parts += [list(lines(grid)) for grid in tables]
    return "\n\n".join("\n".join(part) for part in parts) + "\n"


def lines(
    grid: Grid, *, widths: Sequence[int] = (), gap: str = GAP, indent: str = ""
) -> Iterator[str]:
    """The lines of a table; without headings it has no line of these.

    Parameters
    ----------
    widths : sequence of int, optional
        Of columns that are the same in all tables: a longer cell moves those after it, and
        a longer first cell has a line of its own. Else a column suits its widest cell.
    gap : str, optional
        Between columns.
    indent : str, optional
        Before everything but the title.
    """
    grid = grid.spoken
    if grid.title:
        yield grid.title
    if not grid.rows:
        return
    rows = [[column.heading for column in grid.columns], *grid.texts]
    for row, level in zip(rows[1:], grid.levels, strict=False):
        row[0] = INDENT * (level - 1) + row[0]
    widths = widths or [max(map(len, column)) for column in zip(*rows, strict=True)]
    first = 0 if any(rows[0]) else 1
    for number, chosen in enumerate(_pieces(grid, widths, TABLE_WIDTH - len(indent), len(gap))):
        if number:
            yield ""
        for row in rows[first:]:
            if len(row[0]) > widths[0]:
                yield f"{indent}{row[0]}".rstrip()
                row = ["", *row[1:]]  # noqa: PLW2901 - the rest of it
            padded = (
                (str.rjust if grid.columns[place].is_number else str.ljust)(
                    row[place], widths[place]
                )
                for place in chosen
            )
            yield f"{indent}{gap.join(padded)}".rstrip()


def _pieces(grid: Grid, widths: Sequence[int], room: int, gap: int) -> Iterator[list[int]]:
    """Columns that stand beside one another; the first one is repeated."""
    chosen, width = [0], widths[0]
    for together in _together(grid):
        more = sum(gap + widths[place] for place in together)
        if width + more > room and len(chosen) > 1:
            yield chosen
            chosen, width = [0], widths[0]
        chosen += together
        width += more
    yield chosen


def _together(grid: Grid) -> list[list[int]]:
    """Columns behind the first that are not parted.

    Numbers may be, also those that have words beside them; other tables stay whole.
    """
    kinds = [column.is_number for column in grid.columns[1:]]
    places = list(range(1, len(kinds) + 1))
    if all(kinds):
        return [[place] for place in places]
    if kinds == [True, False] * (len(kinds) // 2):
        return [places[at : at + 2] for at in range(0, len(places), 2)]
    return [places]
