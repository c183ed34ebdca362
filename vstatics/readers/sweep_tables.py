"""Written sweeps, back to columns of numbers: CSV, JSON lines, NPZ and Parquet."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Mapping
from typing import Any

from vstatics.errors import ReadError, of_file
from vstatics.extras import missing
from vstatics.tables.csv import unguarded
from vstatics.tables.written_results import GEAR, WrittenSweep

NUMBER, STATUS = "variant", "status"
WORKBOOK = b"xl/workbook.xml"
"""In every XLSX, which is an archive like NPZ."""


def is_sweep(data: bytes) -> bool:
    """Whether a file begins as a table of variants does."""
    return data.startswith((b"PK\x03\x04", b"PAR1", b"variant,", b'{"variant": '))


def is_workbook(data: bytes) -> bool:
    """Whether a file is XLSX, of whatever."""
    return data.startswith(b"PK") and WORKBOOK in data


def read(data: bytes, file: str) -> WrittenSweep:
    """The columns of a sweep.

    Raises
    ------
    ReadError
        If it can't be read, or a package is missing.
    """
    if is_workbook(data):
        message = "no table of variants: a workbook; expected NPZ, Parquet, CSV or JSON lines"
        raise ReadError([of_file("E111", file, message)])
    try:
        if data.startswith(b"PK"):
            return _of_columns(_npz(data))
        if data.startswith(b"PAR1"):
            return _of_columns(_parquet(data))
        text = data.decode()
        records: Iterable[Mapping[str, Any]]
        if text.startswith("{"):
            records = [json.loads(line) for line in text.splitlines() if line.strip()]
        else:
            lines = csv.reader(io.StringIO(text))
            heads = [unguarded(head) for head in next(lines)]
            records = [dict(zip(heads, line, strict=True)) for line in lines if line]
        columns = {name: [one[name] for one in records] for name in records[0]} if records else {}
        return _of_columns(columns)
    except ReadError:
        raise
    except Exception as error:  # noqa: BLE001 - four libraries with errors of their own
        text = " ".join(str(error).split())
        raise ReadError([of_file("E111", file, f"no table of variants: {text[:200]}")]) from None


def _npz(data: bytes) -> dict[str, Any]:
    import numpy as np

    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        columns = {name: archive[name].tolist() for name in archive.files}
    words = {STATUS: columns.pop("statuses")}
    if "gears" in columns:
        words[GEAR] = columns.pop("gears")
    return columns | {
        name: [texts[code] for code in columns[name]] for name, texts in words.items()
    }


def _parquet(data: bytes) -> dict[str, Any]:
    if message := missing("parquet", "Parquet"):
        raise ReadError("E014", message)
    import pyarrow as pa  # type: ignore[import-untyped]
    import pyarrow.parquet as pq  # type: ignore[import-untyped]

    found: dict[str, Any] = pq.read_table(pa.BufferReader(data)).to_pydict()
    return found


def _of_columns(columns: Mapping[str, list[Any]]) -> WrittenSweep:
    """Numbers, of which NaN is none, under the names of their columns."""
    names = list(columns)
    place = names.index(STATUS) if STATUS in names else len(names)
    by_gear = names[place + 1 : place + 2] == [GEAR]
    numbers = {
        name: [math.nan if one in (None, "") else float(one) for one in column]
        for at, (name, column) in enumerate(columns.items())
        if name not in (NUMBER, STATUS) and not (by_gear and at == place + 1)
    }
    return WrittenSweep(
        [int(number) for number in columns.get(NUMBER, ())],
        [str(one) for one in columns.get(STATUS, ())],
        numbers,
        tuple(name for name in names[:place] if name != NUMBER),
        [str(one) for one in columns[GEAR]] if by_gear else (),
    )
