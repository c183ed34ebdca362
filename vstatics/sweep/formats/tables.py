"""Markdown, LaTeX and workbooks of a sweep: for few rows, that people read."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import Format
from vstatics.tables import latex, markdown, xlsx
from vstatics.tables.grid import Cell, Column, Grid, Row, exact, text, whole

CELL_DIGITS = 12
"""Significant ones, as in CSV."""


def write(
    path: str, form: Format, names: Sequence[str], headings: Sequence[str], chunks: Iterable[Chunk]
) -> None:
    """Write chunks to a file, as one table.

    Raises
    ------
    OSError
    """
    columns = [
        Column("variant"),
        *map(Column, names),
        text("status"),
        *map(Column, headings),
    ]
    grid = Grid("Variants", columns, list(_rows(chunks)))
    if form == "xlsx":
        data = xlsx.write([("", [grid])], several=False)
    else:
        writer = markdown if form == "markdown" else latex
        data = writer.write([], [grid]).encode()
    with open(path, "wb") as file:  # noqa: PTH123
        file.write(data)


def _rows(chunks: Iterable[Chunk]) -> Iterator[Row]:
    for chunk in chunks:
        parts = chunk.variants, chunk.values, chunk.status, chunk.columns
        for variant, values, status, results in zip(*(one.tolist() for one in parts), strict=True):
            number: Row = [whole(variant)]
            yield [*number, *map(_cell, values), STATUS[status], *map(_cell, results)]


def _cell(value: float) -> Cell:
    """A number in as many digits as CSV has."""
    cell = exact(value)
    return cell._replace(text=f"{value:.{CELL_DIGITS}g}") if math.isfinite(value) else cell
