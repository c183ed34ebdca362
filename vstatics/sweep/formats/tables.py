"""Formats written from all rows of a sweep together: Parquet, and tables for readers.

In Parquet, numbers have all digits, the status is a dictionary, and missing numbers are null.
Markdown, LaTeX and workbooks are for few rows.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from typing import IO, Any

from vstatics.core.tables import latex, markdown, xlsx
from vstatics.core.tables.grid import Cell, Column, Values, exact, grid_of
from vstatics.core.tables.grid import text as words
from vstatics.core.tables.parquet import GROUP, row_groups
from vstatics.core.tables.written_results import GEAR
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import Format


def write_parquet(
    file: IO[bytes], headings: Sequence[str], chunks: Iterable[Chunk], *, by_gear: bool
) -> None:
    """Write chunks to a Parquet file, in groups of rows.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    kinds = {"variant": pa.int64(), "status": pa.dictionary(pa.int8(), pa.string())}
    if by_gear:
        kinds[GEAR] = pa.dictionary(pa.int32(), pa.string())
    schema = pa.schema(
        pa.field(name, kinds.get(name, pa.float64()), nullable=name not in kinds)
        for name in headings
    )
    with parquet.ParquetWriter(file, schema) as writer:
        for group in row_groups(chunks, lambda chunk: len(chunk.variants)):
            batches = [_batch(chunk, schema) for chunk in group]
            writer.write_table(pa.Table.from_batches(batches, schema), row_group_size=2 * GROUP)


def _batch(chunk: Chunk, schema: Any) -> Any:
    pa = import_module("pyarrow")  # slow to import, and optional
    coded = pa.DictionaryArray.from_arrays
    codes = {"status": coded(chunk.status.astype("i1"), list(STATUS))}
    if chunk.gears:
        codes[GEAR] = coded(chunk.of_gear.astype("i4"), list(chunk.gears))
    arrays = [
        codes.get(name) if name in codes else pa.array(column, from_pandas=True)
        for name, column in chunk.output_columns().items()
    ]
    return pa.record_batch(arrays, schema=schema)


CELL_DIGITS = 12
"""Number of significant digits of a cell, as in CSV."""


def text(form: Format, headings: Sequence[str], chunks: Iterable[Chunk], *, by_gear: bool) -> bytes:
    """Write chunks as a table in Markdown, LaTeX or a workbook."""
    word_columns = ("status", GEAR) if by_gear else ("status",)
    columns = (words(name) if name in word_columns else Column(name) for name in headings)
    grid = grid_of("Variants", columns, (row for chunk in chunks for row in _rows(chunk)))
    if form == "xlsx":
        return xlsx.write([("", [grid])], several=False)
    write = markdown.write if form == "markdown" else latex.write
    return write([], [grid]).encode()


def _rows(chunk: Chunk) -> Iterator[Values]:
    columns = [column.tolist() for column in chunk.output_columns().values()]
    place = 1 + len(chunk.names)
    columns[place] = [STATUS[code] for code in columns[place]]
    if chunk.gears:
        columns[place + 1] = [chunk.gears[code] for code in columns[place + 1]]
    for row in zip(*columns, strict=True):
        yield [_cell(value) if isinstance(value, float) else value for value in row]


def _cell(value: float) -> Cell:
    cell = exact(value)
    return cell._replace(text=f"{value:.{CELL_DIGITS}g}") if math.isfinite(value) else cell
