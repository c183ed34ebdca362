"""Tables as LaTeX, for `\\input`; no package is needed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from vstatics.tables.grid import NO, NOTHING, YES, Grid

_COMMANDS = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",  # the sign itself needs a font encoding
    "[": "{[}",  # at the start of a row it would be a length
    "]": "{]}",
    "*": "{*}",
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    YES: r"$\bullet$",
    NO: r"$\cdot$",
}
_SPECIAL = re.compile("[" + re.escape("".join(_COMMANDS)) + "]")


def write(titles: Sequence[str], tables: Iterable[Grid]) -> str:
    r"""Tables in the environment `tabular`, one below the other.

    Examples
    --------
    >>> from vstatics.tables.grid import Column
    >>> grid = Grid("Gears", [Column("gear", is_number=False), Column("ratio")], [["R_1", "-3.5"]])
    >>> print(write([], [grid]), end="")
    \noindent\textbf{Gears}\par
    \begin{tabular}{lr}
    \hline
    gear & ratio \\
    \hline
    R\_1 & $-3.5$ \\
    \hline
    \end{tabular}
    """
    parts = [rf"\noindent\textbf{{{escaped(title)}}}\par" for title in titles]
    parts += ["\n".join(_lines(grid)) for grid in tables]
    return "\n\n\\medskip\n".join(parts) + "\n"


def escaped(text: str) -> str:
    r"""A text in which no sign means anything to LaTeX.

    >>> print(escaped("50 % of R_1"))
    50 \% of R\_1
    """
    return _SPECIAL.sub(lambda found: _COMMANDS[found[0]], text)


def _lines(grid: Grid) -> Iterator[str]:
    grid = grid.spoken
    yield rf"\noindent\textbf{{{escaped(grid.title)}}}\par"
    if not grid.rows:
        return
    alignment = "".join("r" if column.is_number else "l" for column in grid.columns)
    yield rf"\begin{{tabular}}{{{alignment}}}"
    yield r"\hline"
    yield _row(escaped(column.heading) for column in grid.columns)
    yield r"\hline"
    for row in grid.texts:
        cells = zip(row, grid.columns, strict=True)
        yield _row(_number(cell) if column.is_number else escaped(cell) for cell, column in cells)
    yield r"\hline"
    yield r"\end{tabular}"


def _number(cell: str) -> str:
    """A number with a true minus, or a blank for one."""
    if cell == NOTHING:
        return "--"
    return f"${cell}$" if cell.startswith("-") else escaped(cell)


def _row(cells: Iterable[str]) -> str:
    return f"{' & '.join(cells)} \\\\"
