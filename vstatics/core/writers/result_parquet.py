"""Results of many cases in the format Parquet, with one number per row as in CSV."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import Any

import numpy as np

from vstatics.core.statics.results import Results
from vstatics.core.tables.answer import PROGRAM
from vstatics.core.tables.parquet import GROUP, row_groups
from vstatics.core.tables.values import places, tables

NAMES = ("case", "table", "row", "gear")


def rows(file: str, results: Results) -> bytes:
    """Return the rows of the results of a case as an Arrow stream, for the function `joined`.

    The columns are case, table, row, gear and value. The distribution matrix does not depend on the
    gear: its rows are named ``link:device``, and their gear is empty. A missing value is null.
    """
    # Imported here because pyarrow costs start-up time and may be missing.
    pa = import_module("pyarrow")
    shown = tables(results)
    index = [place for table in shown for place in places(table)]
    name = file.encode(errors="backslashreplace").decode()  # file names are not always valid UTF-8
    columns = [[name] * len(index), *map(list, zip(*index, strict=True))]
    coded = [pa.array(column, pa.string()).dictionary_encode() for column in columns]
    numbers = pa.array(np.concatenate([table.values.ravel() for table in shown]), from_pandas=True)
    batch = pa.record_batch([*coded, numbers], names=[*NAMES, "value"])
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, batch.schema) as writer:
        writer.write_batch(batch)
    return bytes(sink.getvalue())


def joined(parts: Iterable[bytes]) -> Iterator[bytes]:
    """Yield the pieces of a Parquet file of all results; its metadata state the program.

    Parameters
    ----------
    parts : iterable of bytes
        Streams that `rows` returns; empty streams are skipped.
    """
    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    columns = [*((name, pa.string()) for name in NAMES), ("value", pa.float64())]
    schema = pa.schema(columns, metadata={"program": PROGRAM})
    read = (pa.ipc.open_stream(part).read_all().cast(schema) for part in filter(None, parts))
    sink = _Drained()
    with parquet.ParquetWriter(pa.PythonFile(sink, mode="w"), schema) as writer:
        for group in row_groups(read, len):
            writer.write_table(pa.concat_tables(group), row_group_size=2 * GROUP)
            yield sink.drained()
    yield sink.drained()


class _Drained(io.RawIOBase):
    """Output file in memory, from which written bytes can be taken during writing."""

    def __init__(self) -> None:
        self.pieces: list[bytes] = []
        self.size = 0

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        self.pieces.append(bytes(data))
        self.size += len(self.pieces[-1])
        return len(self.pieces[-1])

    def tell(self) -> int:
        return self.size

    def drained(self) -> bytes:
        """Return and remove the bytes that were written since the last call."""
        taken, self.pieces = b"".join(self.pieces), []
        return taken
