"""Readers of the results of sweeps, as columns: CSV, JSON lines, NPZ, Parquet, workbooks."""

from __future__ import annotations

import csv
import io
import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from vstatics.core.errors import ReadError, of_file, quoted
from vstatics.core.extras import missing
from vstatics.core.jobs.input_files import TABLE_BYTES
from vstatics.core.readers.reading import Source
from vstatics.core.tables.csv import unguarded
from vstatics.core.tables.names import plain_names
from vstatics.core.tables.written_results import GEAR, GEAR_NUMBER, WrittenSweep

if TYPE_CHECKING:
    from zipfile import ZipFile

    from vstatics.core.numerics.arrays import Floats

    Column: TypeAlias = list[Any] | Floats

MOST_TABLE_CELLS = 20_000_000
"""Largest number of cells of a table; 20 million Python numbers take 640 MB."""
TOO_DEEP = "nested too deeply, expected numbers and texts"
NUMBER, STATUS = "variant", "status"
DURATION = "duration [s]"
"""First column of the points of a duty cycle, which `vstatics cycle` writes below the time steps.
"""
SHEET = "Variants"
WORKBOOK = b"xl/workbook.xml"
"""Name of a file in every XLSX archive, which distinguishes it from an NPZ archive."""


def is_sweep(data: bytes) -> bool:
    """Return whether a file begins like a table of variants, the result of a sweep."""
    return data.startswith((b"PK\x03\x04", b"PAR1", b"variant,", b'{"variant": '))


def is_workbook(data: bytes) -> bool:
    """Return whether a file is a workbook in XLSX format."""
    return data.startswith(b"PK") and WORKBOOK in data


def read(data: bytes, file: str) -> WrittenSweep:
    """Read a sweep from CSV, JSON lines, NPZ, Parquet or a workbook.

    Parameters
    ----------
    data : bytes
        The content of a file.
    file : str
        Name of the file, for messages.

    Returns
    -------
    WrittenSweep
        The variants with their statuses, and a column for each quantity.

    Raises
    ------
    ReadError
        If the file cannot be read, or a package is missing.

    Examples
    --------
    >>> data = b"variant,i,status,ratio\\n1,2.5,ok,3.5\\n"
    >>> read(data, "sweep.csv").columns
    {'i': [2.5], 'ratio': [3.5]}
    """
    table = columns(data, file)
    try:
        return _of_columns(table)
    except (TypeError, ValueError, OverflowError) as error:
        raise _no_sweep(file, error) from None


def columns(data: bytes, file: str) -> dict[str, Column]:
    """Read a table as columns of equal length, by name.

    Raises
    ------
    ReadError
        If the file cannot be read, or a package is missing.
    """
    try:
        if data.startswith(b"PK"):
            return _workbook(data, file) if is_workbook(data) else read_npz(data)
        if data.startswith(b"PAR1"):
            table = open_parquet(data, file).read(use_threads=False)
            from pyarrow.types import is_floating  # type: ignore[import-untyped]

            _expect_different(table.column_names)
            return {
                name: column.to_numpy() if is_floating(column.type) else column.to_pylist()
                for name, column in zip(table.column_names, table.columns, strict=True)
            }
        text = data.decode()
        if text.startswith("["):
            rows = json.loads(text, object_pairs_hook=_different_keys)
            text = "\n".join(map(json.dumps, rows))
        return _json_lines(text, file) if text.startswith("{") else _csv(text, file)
    except ReadError:
        raise
    except Exception as error:  # noqa: BLE001 (four libraries with their classes of errors)
        raise _no_sweep(file, error) from None


_SEVERAL = (
    "has several values, expected one object per row; pandas writes rows with "
    "`to_json(orient='records')`"
)


def _no_sweep(file: str, error: Exception, line: int = 0) -> ReadError:
    text = " ".join(str(error).split()) or type(error).__name__
    return ReadError(
        "E111", f"not a table of variants: {text[:200]}", place=Source(file, "").place(line)
    )


def expect_size(cells: int, size: int = 0) -> None:
    """Check that the number of cells and the unpacked size [bytes] of a table are not too large.

    Raises
    ------
    ValueError
        If the table is too large.

    Examples
    --------
    >>> expect_size(30_000_000)
    Traceback (most recent call last):
    ValueError: it has 30,000,000 cells, expected at most 20,000,000
    """
    if cells > MOST_TABLE_CELLS:
        raise ValueError(f"it has {cells:,} cells, expected at most {MOST_TABLE_CELLS:,}")
    if size > TABLE_BYTES:
        raise ValueError(
            f"it has {size / 1e6:,.0f} MB when unpacked, expected at most {TABLE_BYTES / 1e6:g} MB"
        )


def _csv(text: str, file: str) -> dict[str, Column]:
    lines = csv.reader(io.StringIO(text))
    names = [unguarded(head) for head in next(lines)]
    _expect_different(names)
    rows = []
    for line in lines:
        if line and len(line) != len(names):
            error = ValueError(f"read {len(line)} cells, expected {len(names)}, as in the heading")
            raise _no_sweep(file, error, lines.line_num)
        rows += [line] * bool(line)
        expect_size(len(rows) * len(names))
    return {name: [row[place] for row in rows] for place, name in enumerate(names)}


def _json_lines(text: str, file: str) -> dict[str, Column]:
    """Read columns from JSON objects, which must all have the keys of the first object."""
    table: dict[str, list[Any]] = {}
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        try:
            row = json.loads(line, object_pairs_hook=_different_keys)
            if not isinstance(row, dict):
                raise ValueError("read no JSON object")  # noqa: TRY004, TRY301 (a wrong text)
            table = table or {name: [] for name in row}
            if several := next((name for name in row if isinstance(row[name], dict | list)), None):
                raise ValueError(f"{quoted(several)} {_SEVERAL}")  # noqa: TRY301
            for name in table:
                if name not in row:
                    raise ValueError(f"the key {quoted(name)} is missing")  # noqa: TRY301
                table[name].append(row[name])
            if len(row) > len(table):
                other = next(name for name in row if name not in table)
                raise ValueError(f"the key {quoted(other)} is not in the first line")  # noqa: TRY301
            expect_size(len(table) * len(next(iter(table.values()), ())))
        except (RecursionError, ValueError) as error:
            deep = isinstance(error, RecursionError)
            raise _no_sweep(file, ValueError(TOO_DEEP) if deep else error, number) from None
    return dict(table)


def _different_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    _expect_different([name for name, _ in pairs])
    return dict(pairs)


def _expect_different(names: Sequence[str]) -> None:
    """Check that the names of columns, or the keys of a JSON object, are different.

    Raises
    ------
    ValueError
    """
    if len({*names}) < len(names):
        twice = next(name for name, number in Counter(names).items() if number > 1)
        raise ValueError(f"{quoted(twice)} is given twice, expected each name once")


def _workbook(data: bytes, file: str) -> dict[str, Column]:
    """Read the sheet of variants of a workbook, or the only sheet."""
    from vstatics.core.readers.workbook.cells import read_sheets

    names = [sheet.name for sheet in read_sheets(data, file, ())]
    wanted = SHEET if SHEET in names else names[0]
    if wanted != SHEET and len(names) > 1:
        raise ValueError(
            f"read a workbook of {len(names)} sheets, expected one, or one called `{SHEET}`"
        )
    [rows] = (sheet.rows for sheet in read_sheets(data, file, [wanted]) if sheet.name == wanted)
    if not rows:
        raise ValueError("its sheet is empty")
    heads = {cell.column: cell.text for cell in rows[0]}
    _expect_different([*heads.values()])
    rows_below = [{cell.column: cell.text for cell in row} for row in rows[1:]]
    return {name: [row.get(column) for row in rows_below] for column, name in heads.items()}


def read_npz(data: bytes) -> dict[str, Column]:
    """Read the arrays of an NPZ file; codes of statuses and gears are replaced by texts.

    Raises
    ------
    ValueError
        If the arrays are not a table.
    Exception
        Of various classes if the file is damaged.
    """
    import numpy as np

    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        _expect_declared(archive.zip)
        arrays = {name: archive[name] for name in archive.files}
    words = [(STATUS, "statuses"), (GEAR, "gears")]
    texts = {name: arrays.pop(key) for name, key in words if {name, key} <= arrays.keys()}
    length = next((array.size for array in arrays.values()), 0)
    for name, array in arrays.items():
        if array.ndim != 1 or array.dtype.kind not in "biufUS":
            raise ValueError(f"{quoted(name)} is not a row of numbers")
        if len(array) != length:
            raise ValueError(
                f"{quoted(name)} has {len(array)} numbers, expected {length}, as the others"
            )
    for name, words_of_codes in texts.items():
        codes = arrays[name]
        if codes.dtype.kind not in "iu" or not np.isin(codes, np.arange(len(words_of_codes))).all():
            raise ValueError(f"{quoted(name)} has other numbers than its texts")
    return {
        name: texts[name][array].tolist() if name in texts else array
        for name, array in arrays.items()
    }


def _expect_declared(packed: ZipFile) -> None:
    """Check before unpacking that the archive declares complete arrays of permitted size.

    Raises
    ------
    ValueError
    """
    from numpy.lib import format as npy

    cells = size = 0
    for member in packed.infolist():
        with packed.open(member) as opened:
            version = npy.read_magic(opened)
            reader = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
            shape, _, dtype = reader(opened)
            declared = math.prod(shape) * dtype.itemsize
            if declared > member.file_size - opened.tell():
                raise ValueError(f"{quoted(member.filename)} is cut off")
        cells, size = cells + math.prod(shape), size + declared
        expect_size(cells, size)


def open_parquet(data: bytes, file: str) -> Any:
    """Open a Parquet file after checking its declared size.

    Raises
    ------
    ReadError
        If the package for Parquet is missing.
    ValueError
        If the tables are too large.
    Exception
        Of various classes if the file is damaged.
    """
    if message := missing("parquet", "Parquet"):
        raise ReadError([of_file("E014", file, message)])
    import pyarrow as pa  # type: ignore[import-untyped]
    import pyarrow.parquet as pq  # type: ignore[import-untyped]

    opened = pq.ParquetFile(pa.BufferReader(data))
    about = opened.metadata
    groups = [about.row_group(number) for number in range(about.num_row_groups)]
    rows = sum(group.num_rows for group in groups)
    expect_size(rows * about.num_columns, sum(group.total_byte_size for group in groups))
    return opened


def _of_columns(columns: Mapping[str, Column]) -> WrittenSweep:
    """Build a sweep from the columns of a table.

    Raises
    ------
    TypeError, ValueError, OverflowError
    """
    if not columns:
        raise ValueError("it is empty")
    for name in (NUMBER, STATUS):
        if name not in columns:
            raise ValueError(f"the column `{name}` is missing, which every sweep has")
    numbered = [columns.get(name, ()) for name in (GEAR_NUMBER, GEAR)]
    columns = _plain_headings(_without_points(columns))
    names = list(columns)
    place = names.index(STATUS)
    by_gear = names[place + 1 : place + 2] == [GEAR]
    numbers = {
        name: _numbers(name, column)
        for at, (name, column) in enumerate(columns.items())
        if name not in (NUMBER, STATUS) and not (by_gear and at == place + 1)
    }
    return WrittenSweep(
        [int(number) for number in columns[NUMBER]],
        list(map(str, columns[STATUS])),
        numbers,
        tuple(name for name in names[:place] if name != NUMBER),
        [str(gear) for gear in columns[GEAR]] if by_gear else (),
        {float(number): str(gear) for number, gear in zip(*numbered, strict=False)},
    )


def _without_points(columns: Mapping[str, Column]) -> Mapping[str, Column]:
    """Return the columns of a driving cycle without the rows of duty-cycle points."""
    names = list(columns)
    points = names.index(DURATION) if DURATION in names else len(names)
    return {name: columns[name] for name in names[:points]} if GEAR in names[points:] else columns


def _plain_headings(columns: Mapping[str, Column]) -> dict[str, Column]:
    """Return columns with present names, also for older sweeps with names of the deck.

    A column keeps its deck name if another column already has the present name.
    """
    plain = {name: plain_names(name) for name in columns}
    return {
        plain[name] if plain[name] == name or plain[name] not in columns else name: column
        for name, column in columns.items()
    }


def _numbers(name: str, column: Column) -> list[float]:
    """Convert the cells of a column to numbers, with NaN for empty cells.

    Raises
    ------
    ValueError
        At the first cell that is not a finite number.
    """
    numbers = []
    for row, cell in enumerate(column, 1):
        try:
            number = math.nan if cell in (None, "") else float(cell)
        except (TypeError, ValueError, OverflowError):
            number = math.inf
        if math.isinf(number):
            read = quoted(str(cell)[:40])
            raise ValueError(f"{name}: read {read} in row {row}, expected a finite number")
        numbers.append(number)
    return numbers
