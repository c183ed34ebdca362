"""Written sweeps, back to columns of numbers: CSV, JSON lines, NPZ, Parquet, a workbook."""

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
SHEET = "Variants"
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
    found = columns(data, file)
    try:
        return _of_columns(found)
    except (TypeError, ValueError) as error:
        raise _none(file, error) from None


def columns(data: bytes, file: str) -> dict[str, list[Any]]:
    """The columns of a table, whatever they hold, by their names.

    Raises
    ------
    ReadError
        If it can't be read, or a package is missing.
    """
    try:
        if data.startswith(b"PK"):
            return _workbook(data, file) if is_workbook(data) else _npz(data)
        if data.startswith(b"PAR1"):
            return _parquet(data)
        text = data.decode()
        records: Iterable[Mapping[str, Any]]
        if text.startswith("{"):
            records = [json.loads(line) for line in text.splitlines() if line.strip()]
        else:
            lines = csv.reader(io.StringIO(text))
            heads = [unguarded(head) for head in next(lines)]
            records = [dict(zip(heads, line, strict=True)) for line in lines if line]
        return {name: [one[name] for one in records] for name in records[0]} if records else {}
    except ReadError:
        raise
    except Exception as error:  # noqa: BLE001 - four libraries with errors of their own
        raise _none(file, error) from None


def _none(file: str, error: Exception) -> ReadError:
    text = " ".join(str(error).split())
    return ReadError([of_file("E111", file, f"no table of variants: {text[:200]}")])


def _workbook(data: bytes, file: str) -> dict[str, list[Any]]:
    """The columns of the sheet of a sweep, or of the only one."""
    from vstatics.readers.workbook.cells import read_sheets

    names = [sheet.name for sheet in read_sheets(data, file, ())]
    wanted = SHEET if SHEET in names else names[0]
    if wanted != SHEET and len(names) > 1:
        raise ValueError(
            f"a workbook of {len(names)} sheets, expected one, or one called `{SHEET}`"
        )
    [rows] = (sheet.rows for sheet in read_sheets(data, file, [wanted]) if sheet.name == wanted)
    if not rows:
        raise ValueError("its sheet is empty")
    heads = {cell.column: cell.text for cell in rows[0]}
    found = [{cell.column: cell.text for cell in row} for row in rows[1:]]
    return {name: [row.get(column) for row in found] for column, name in heads.items()}


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
