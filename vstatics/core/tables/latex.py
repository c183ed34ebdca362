"""Tables as LaTeX for `\\input`, without any package."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Iterator, Sequence
from itertools import chain, groupby, starmap

from vstatics.core.groups import filled
from vstatics.core.tables.grid import NO, NOTHING, YES, Cell, Column, Grid

_COMMANDS = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",  # a straight double quote needs the font encoding T1
    "[": "{[}",  # at the start of a row, LaTeX would read a length
    "]": "{]}",
    "*": "{*}",
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    YES: r"$\bullet$",
    NO: r"$\cdot$",
}
_SPECIAL = re.compile("[" + re.escape("".join(_COMMANDS)) + "]")


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    r"""Return tables in the environment `tabular`, and sentences as list items.

    Examples
    --------
    >>> from vstatics.core.tables.grid import Column
    >>> grid = Grid("Gears", [Column("gear", is_number=False), Column("ratio")], [["R_1", "-3.5"]])
    >>> print(write([], [grid]), end="")
    \noindent\textbf{Gears}\par\nobreak\smallskip
    \noindent\begin{tabular}{lr}
    \hline
    gear & ratio \\
    \hline
    R\_1 & $-3.5$ \\
    \hline
    \end{tabular}
    """
    parts = [rf"\noindent\textbf{{{escaped(title)}}}\par" for title in titles]
    for is_prose, some in groupby(tables, lambda grid: bool(grid.prose)):
        if is_prose:
            items = (rf"\item {grid.prose}" for grid in some)
            parts.append("\n".join([r"\begin{itemize}", *items, r"\end{itemize}"]))
        else:
            pages = chain.from_iterable(_pages(grid.spoken) for grid in some)
            parts += ["\n".join(_lines(grid)) for grid in pages]
    return "\n\n\\medskip\n".join(parts) + "\n"


def escaped(text: str) -> str:
    r"""Return a text with all special characters of LaTeX escaped.

    >>> print(escaped("50 % of R_1, --seed 3"))
    50 \% of R\_1, -{}-seed 3
    """
    return _SPECIAL.sub(lambda match: _COMMANDS[match[0]], text).replace("--", "-{}-")


PAGE, SMALL_PAGE = 66, 86
"""Number of characters per line in usual and in small type."""
SHORT, ENOUGH = 20, 24
"""Width of a column of words [characters]: up to SHORT, lines are not broken; from ENOUGH on, a
column with broken lines needs no smaller type.
"""

MOST_ROWS = 28
"""Largest number of rows of a table on a page."""


def _pages(grid: Grid) -> Iterator[Grid]:
    """Split a table into pieces that fit a page. Each piece has the first column."""
    if not grid.rows:
        yield grid
        return
    lengths = _lengths(grid)
    widths = [
        length if column.is_number else min(length, ENOUGH)
        for length, column in zip(lengths, grid.columns, strict=True)
    ]
    groups = [*filled(range(1, len(widths)), SMALL_PAGE - widths[0], widths.__getitem__)]
    for start in range(0, len(grid.rows), MOST_ROWS):
        rows = grid._replace(rows=grid.rows[start : start + MOST_ROWS])
        yield from (rows.with_columns([0, *group]) for group in groups)


def _lengths(grid: Grid) -> list[int]:
    """Return the width of each column in characters, including the gap to the next column.

    A heading above numbers has one word per line, so only its longest word counts.
    """
    headings = [
        max(column.heading.split() or [""], key=len) if column.is_number else column.heading
        for column in grid.columns
    ]
    return [max(map(len, column)) + 2 for column in zip(headings, *grid.texts, strict=True)]


def _lines(grid: Grid) -> Iterator[str]:
    title = rf"\noindent\textbf{{{escaped(grid.title)}}}\par"
    if not grid.rows:
        yield title
        return
    yield rf"{title}\nobreak\smallskip"
    lengths = _lengths(grid)
    heads = [len(column.heading) + 2 for column in grid.columns]
    is_wide = sum(map(max, lengths, heads)) > PAGE
    page, broken = _broken(grid, lengths) if is_wide else (PAGE, {})
    is_small = page > PAGE
    alignment = "".join(
        rf"p{{{0.89 * broken[index] / page:.3f}\linewidth}}"
        if index in broken
        else "r"
        if column.is_number
        else "l"
        for index, column in enumerate(grid.columns)
    )
    if is_small:
        yield r"{\footnotesize\setlength{\tabcolsep}{3pt}"
    yield rf"\noindent\begin{{tabular}}{{{alignment}}}"
    yield r"\hline"
    yield _row(
        (
            _heading(column.heading) if is_wide and column.is_number else escaped(column.heading)
            for column in grid.columns
        ),
        broken,
    )
    yield r"\hline"
    for row in grid.cells:
        yield _row(starmap(_cell, zip(row, grid.columns, strict=True)), broken)
    yield r"\hline"
    yield r"\end{tabular}" + "}" * is_small


def _broken(grid: Grid, lengths: Sequence[int]) -> tuple[int, dict[int, float]]:
    """Return the number of characters per line, and the widths of broken columns by index."""
    long = {
        index: length
        for index, length in enumerate(lengths)
        if length > SHORT and not grid.columns[index].is_number
    }
    unbroken = sum(lengths) - sum(long.values())
    page = PAGE if unbroken + ENOUGH * len(long) <= PAGE else SMALL_PAGE
    room: float = max(page - unbroken, SHORT)
    widths: dict[int, float] = {}
    for index in sorted(long, key=long.__getitem__):  # short columns leave room for long columns
        widths[index] = min(long[index], room / (len(long) - len(widths)))
        room -= widths[index]
    return page, widths


def _heading(text: str) -> str:
    words = escaped(text).split()
    stacked = r"\\ ".join(words)
    return rf"\shortstack[r]{{{stacked}}}" if len(words) > 1 else stacked


def _cell(cell: Cell, column: Column) -> str:
    if cell.math:
        return f"${cell.math}$"
    if column.is_number and cell.text == NOTHING:
        return "--"
    is_negative = column.is_number and cell.text.startswith("-")
    return f"${cell.text}$" if is_negative else escaped(cell.text)


def _row(cells: Iterable[str], broken: Container[int]) -> str:
    r"""Return a row. A ragged cell redefines `\\`, so a row with broken cells needs another end."""
    ragged = (
        rf"\raggedright {cell}" if index in broken else cell for index, cell in enumerate(cells)
    )
    return f"{' & '.join(ragged)} " + (r"\tabularnewline" if broken else r"\\")
