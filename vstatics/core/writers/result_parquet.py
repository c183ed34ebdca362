"""Results of many cases in Parquet, in long form (one number per row) as in CSV."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from importlib import import_module

import numpy as np

from vstatics.core.statics.results import Results
from vstatics.core.tables.answer import PROGRAM
from vstatics.core.tables.parquet import GROUP, row_groups
from vstatics.core.tables.values import places, tables

NAMES = ("case", "table", "row", "gear")


def rows(file: str, results: Results) -> bytes:
    """Return the rows of a result as an Arrow stream, which `joined` reads.

    The columns are case, table, row, gear and value. A value that does not exist is null. The
    distribution matrix does not depend on the gear, so the column is empty, and the row is
    ``link:device``.
    """
    pa = import_module("pyarrow")  # costs start-up time, and can be missing
    shown = tables(results)
    index = [place for table in shown for place in places(table)]
    name = file.encode(errors="backslashreplace").decode()  # file names need not be UTF-8
    columns = [[name] * len(index), *map(list, zip(*index, strict=True))]
    coded = [pa.array(column, pa.string()).dictionary_encode() for column in columns]
    numbers = pa.array(np.concatenate([table.values.ravel() for table in shown]), from_pandas=True)
    batch = pa.record_batch([*coded, numbers], names=[*NAMES, "value"])
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, batch.schema) as writer:
        writer.write_batch(batch)
    return bytes(sink.getvalue())


def joined(parts: Iterable[bytes]) -> Iterator[bytes]:
    """Yield a Parquet file of all results, piece by piece.

    Parameters
    ----------
    parts : iterable of bytes
        Streams of `rows`; empty streams are skipped.
    """
    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    columns = [*((name, pa.string()) for name in NAMES), ("value", pa.float64())]
    schema = pa.schema(columns, metadata={"program": PROGRAM})
    read = (pa.ipc.open_stream(part).read_all().cast(schema) for part in filter(None, parts))
    sink = io.BytesIO()
    with parquet.ParquetWriter(pa.PythonFile(sink, mode="w"), schema) as writer:
        for group in row_groups(read, len):
            writer.write_table(pa.concat_tables(group), row_group_size=2 * GROUP)
            yield _drained(sink)
    yield _drained(sink)


def _drained(sink: io.BytesIO) -> bytes:
    """Return the bytes written since the last call."""
    taken = sink.getvalue()
    sink.seek(0)
    sink.truncate()
    return taken
