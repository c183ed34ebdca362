"""Markdown, LaTeX and workbooks of a sweep: for few rows, that people read."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import Format
from vstatics.tables import latex, markdown, xlsx
from vstatics.tables.grid import Cell, Column, Values, exact, grid_of
from vstatics.tables.grid import text as words

CELL_DIGITS = 12
"""Significant ones, as in CSV."""


def text(form: Format, headings: Sequence[str], chunks: Iterable[Chunk]) -> bytes:
    """Chunks as one table."""
    columns = (words(one) if one == "status" else Column(one) for one in headings)
    grid = grid_of("Variants", columns, (row for chunk in chunks for row in _rows(chunk)))
    if form == "xlsx":
        return xlsx.write([("", [grid])], several=False)
    write = markdown.write if form == "markdown" else latex.write
    return write([], [grid]).encode()


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
