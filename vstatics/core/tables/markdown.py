"""Tables as Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from vstatics.core.tables.grid import Grid

_SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|~$&])")


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    r"""Write tables with pipes and sentences as list items.

    Examples
    --------
    >>> from vstatics.core.tables.grid import Column
    >>> grid = Grid("Gears", [Column("gear", is_number=False), Column("ratio")], [["a|b", "3.5"]])
    >>> print(write(["box"], [grid]), end="")
    # box
    <BLANKLINE>
    **Gears**
    <BLANKLINE>
    | gear | ratio |
    | :--- | ---: |
    | a\|b | 3.5 |
    """
    parts = [f"# {escaped(title)}" for title in titles]
    for is_prose, some in groupby(tables, lambda grid: bool(grid.prose)):
        if is_prose:
            parts.append("\n".join(f"- {escaped(grid.title)}" for grid in some))
        else:
            parts += ["\n".join(_lines(grid)) for grid in some]
    return "\n\n".join(parts) + "\n"


def escaped(text: str) -> str:
    r"""Escape all special characters of Markdown in a text.

    >>> print(escaped("N*m"))
    N\*m
    """
    return _SPECIAL.sub(r"\\\1", text)


def _lines(grid: Grid) -> Iterator[str]:
    grid = grid.spoken
    yield f"**{escaped(grid.title)}**"
    if not grid.rows:
        return
    yield ""
    yield _row([escaped(column.heading) for column in grid.columns])
    yield _row(["---:" if column.is_number else ":---" for column in grid.columns])
    for row in grid.texts:
        yield _row(map(escaped, row))


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"
