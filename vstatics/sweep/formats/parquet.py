"""Parquet, by pyarrow: full numbers, the status as a dictionary, what does not exist as null."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from typing import IO, Any

from vstatics.sweep.chunk import STATUS, Chunk

GROUP = 262_144
"""Rows of a row group, at most one piece more."""


def write(file: IO[bytes], headings: Sequence[str], chunks: Iterable[Chunk]) -> None:
    """Write chunks to a file, one row group at a time.

    Raises
    ------
    OSError
    """
    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    kinds = {"variant": pa.int64(), "status": pa.dictionary(pa.int8(), pa.string())}
    schema = pa.schema(
        pa.field(one, kinds.get(one, pa.float64()), nullable=one not in kinds) for one in headings
    )
    with parquet.ParquetWriter(file, schema) as writer:
        for group in _groups(chunks):
            batches = [_batch(chunk, schema) for chunk in group]
            writer.write_table(pa.Table.from_batches(batches, schema), row_group_size=2 * GROUP)


def _groups(chunks: Iterable[Chunk]) -> Iterator[list[Chunk]]:
    """Chunks together, so that the row groups have a good size."""
    group: list[Chunk] = []
    rows = 0
    for chunk in chunks:
        group.append(chunk)
        rows += len(chunk.variants)
        if rows >= GROUP:
            yield group
            group, rows = [], 0
    if group:
        yield group


def _batch(chunk: Chunk, schema: Any) -> Any:
    pa = import_module("pyarrow")  # costs start-up time, and may be missing
    status = pa.DictionaryArray.from_arrays(chunk.status.astype("i1"), list(STATUS))
    arrays = [
        status if name == "status" else pa.array(column, from_pandas=True)
        for name, column in chunk.output_columns().items()
    ]
    return pa.record_batch(arrays, schema=schema)
