"""File of variants in any format that a sweep writes, read to a `VariantTable`."""

from __future__ import annotations

import io
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, of_file
from vstatics.core.jobs.input_files import TABLE_BYTES, opened, read_stream, unreadable
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import sweep_tables
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.sweep.options import PlacedFile
from vstatics.sweep.variants.numbered import VariantTable
from vstatics.sweep.variants.subject import VariedSubject
from vstatics.sweep.variants.table import finite, read_table, targets_of
from vstatics.sweep.variants.targets import shown

_OTHERS = (b"PK", b"PAR1", b'{"', b"[{")
"""First bytes of formats other than CSV: workbook and NPZ, Parquet, JSON lines, JSON."""
_LONGEST = 2**16


def load_table(path: str, subject: VariedSubject) -> VariantTable:
    """Read a table of variants from a file: CSV, Parquet, a workbook, NPZ, JSON lines or JSON.

    Columns are treated as in `table.read_table`.

    Raises
    ------
    ReadError
        With every problem and its place.
    """
    try:
        with _opened(path) as stream:
            if not stream.peek(4).startswith(_OTHERS):
                return read_table(stream, path, subject)
            columns = sweep_tables.columns(_rest_of(stream, path), path)
    except OSError as error:
        raise ReadError([unreadable(path, error)]) from None
    place = Place(path, 1, 1)
    if not columns:
        message = "the table is empty, expected names and numbers below them"
        raise ReadError([of_file("E713", path, message)])
    targets, chosen = targets_of([(name, place) for name in columns], subject)
    names = list(columns)
    rows = np.column_stack([_numbers(names[n], columns[names[n]], place) for n in chosen])
    if not len(rows):
        message = "the table has no variant, expected a row of numbers below the names"
        raise ReadError([of_file("E713", path, message)])
    return VariantTable(targets, rows)


def headings(path: str) -> str:
    """Return the headings of a file of variants as a text, separated by commas.

    Raises
    ------
    OSError
    ReadError
        If the file cannot be read.
    """
    with _opened(path) as stream:
        if not stream.peek(4).startswith(_OTHERS):
            return stream.readline(_LONGEST).decode(errors="replace")
        return ",".join(sweep_tables.columns(_rest_of(stream, path), path))


def _opened(path: str) -> io.BufferedReader:
    """Open the file of an option. A file named in a sweep file must be a regular file."""
    return io.BufferedReader(opened(path, regular=isinstance(path, PlacedFile)))  # type: ignore[arg-type]


def _rest_of(stream: io.BufferedReader, path: str) -> bytes:
    return read_stream(stream, TABLE_BYTES, path)


def _numbers(name: str, column: Sequence[Any] | Floats, place: Place) -> Floats:
    is_numeric = isinstance(column, np.ndarray) and column.dtype.kind in "iuf"
    if is_numeric or {*map(type, column)} <= {int, float}:
        with suppress(OverflowError):  # an integer that is too large is refused below
            numbers = np.array(column, dtype=np.float64)
            if np.isfinite(numbers).all():
                return numbers
    read, problems = np.empty(len(column)), []
    for row, cell in enumerate(column):
        try:
            read[row] = finite("" if cell is None else str(cell))
        except ValueError as error:
            message = f"{name}: read {shown('' if cell is None else str(cell))} in row {row + 1}"
            problems.append(Problem("E718", f"{message}, {error}", place=place))
            if len(problems) >= MOST_PROBLEMS:
                break
    if problems:
        raise ReadError(problems)
    return read
