"""Markdown, LaTeX and workbooks of a sweep: for few rows, that people read."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import Format
from vstatics.tables import latex, markdown, xlsx
from vstatics.tables.grid import Cell, Column, Values, exact, grid_of, text

CELL_DIGITS = 12
"""Significant ones, as in CSV."""


def write(path: str, form: Format, headings: Sequence[str], chunks: Iterable[Chunk]) -> None:
    """Write chunks to a file, as one table.

    Raises
    ------
    OSError
    """
    columns = (text(one) if one == "status" else Column(one) for one in headings)
    grid = grid_of("Variants", columns, (row for chunk in chunks for row in _rows(chunk)))
    if form == "xlsx":
        data = xlsx.write([("", [grid])], several=False)
    else:
        writer = markdown if form == "markdown" else latex
        data = writer.write([], [grid]).encode()
    with open(path, "wb") as file:  # noqa: PTH123
        file.write(data)


def _rows(chunk: Chunk) -> Iterator[Values]:
    columns = [column.tolist() for column in chunk.output_columns().values()]
    place = 1 + len(chunk.names)
    columns[place] = [STATUS[code] for code in columns[place]]
    for row in zip(*columns, strict=True):
        yield [_cell(one) if isinstance(one, float) else one for one in row]


def _cell(value: float) -> Cell:
    """A number in as many digits as CSV has."""
    cell = exact(value)
    return cell._replace(text=f"{value:.{CELL_DIGITS}g}") if math.isfinite(value) else cell
