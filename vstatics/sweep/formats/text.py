r"""Rows of a sweep as CSV and JSON lines, with twelve significant digits.

For speed, a block of rows is formatted by a single `%`, whose format is the format of a row,
repeated. It already contains the status, missing numbers, and numbers that are equal in all rows.
"""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables import csv
from vstatics.sweep.chunk import STATUS, Chunk
from vstatics.sweep.formats import Format
from vstatics.sweep.results.columns import output_headings

ROWS_AT_ONCE = 512
"""Number of rows that are formatted together. The fewer rows, the more columns are constant."""
NUMBER = "%.12g"


def head(form: Format, headings: Sequence[str], *, raw: bool = False) -> bytes:
    r"""Return the line of headings of a CSV file; empty for JSON lines.

    Parameters
    ----------
    form : {"csv", "jsonl"}
    headings : sequence of str
    raw : bool
        Whether to omit the apostrophe that keeps spreadsheets from reading a heading as a formula.

    >>> head("csv", ["variant", "D1.ratio", "status", "-ratio[1]", "speeds[C1,1]"])
    b'variant,D1.ratio,status,\'-ratio[1],"speeds[C1,1]"\n'
    """
    if form == "jsonl":
        return b""
    return csv.lines([headings], raw=raw).encode()


def rows(form: Format, chunk: Chunk) -> bytes:
    """Format the rows of a chunk as text.

    Parameters
    ----------
    form : {"csv", "jsonl"}
    chunk : Chunk

    Returns
    -------
    bytes
        One line for each row, in UTF-8.
    """
    row = _Row(form, chunk.names, chunk.headings, chunk.gears)
    parts = []
    for start in range(0, len(chunk.variants), ROWS_AT_ONCE):
        part = slice(start, start + ROWS_AT_ONCE)
        codes = chunk.status[part].tolist()
        gears = chunk.of_gear[part].tolist() if chunk.gears else [0] * len(codes)
        variants = chunk.variants[part]
        values = len(chunk.names)
        numbers = np.empty((len(variants), 1 + values + len(chunk.headings)))
        numbers[:, 0] = variants
        numbers[:, 1 : 1 + values] = chunk.values[part]
        numbers[:, 1 + values :] = chunk.columns[part]
        parts.append(_formatted(row, numbers, list(zip(codes, gears, strict=True))))
    return "".join(parts).encode()


WordCodes = tuple[int, int]
"""Index of the status in `STATUS`, and index of the gear."""


def _formatted(row: _Row, numbers: Floats, words: list[WordCodes]) -> str:
    """Return rows as text. The number in a constant column is formatted only once."""
    alike = (numbers == numbers[0]).all(axis=0)
    row.begin(numbers[0], alike.tolist())
    varied = numbers[:, ~alike]
    exists = np.isfinite(varied)
    if not exists.all():
        patterns = map(row.pattern, words, map(bytes, exists))
        return "".join(patterns) % tuple(varied[exists].tolist())
    several = any(codes != words[0] for codes in words)
    pattern = "".join(map(row.pattern, words)) if several else row.pattern(words[0]) * len(words)
    return pattern % tuple(varied.ravel().tolist())


def _quoted(form: Format, name: str) -> str:
    """Return the name of a gear as a cell, with `%` doubled for use in a %-format."""
    if form == "csv":
        return csv.lines([[name]]).rstrip("\n").replace("%", "%%")
    return json.dumps(name, ensure_ascii=False).replace("%", "%%")


class _Row:
    """Format of a row, including the columns that are constant in a block of rows."""

    def __init__(
        self, form: Format, names: Sequence[str], headings: Sequence[str], gears: Sequence[str]
    ) -> None:
        by_gear = bool(gears)
        self.gears = [_quoted(form, gear) for gear in gears]
        if form == "csv":
            self.keys = ["", *"," * (len(names) + 1 + by_gear + len(headings))]
            self.end, self.null, self.quote = "\n", "", ""
        else:
            keys = output_headings(names, headings, by_gear=by_gear)
            texts = [json.dumps(key, ensure_ascii=False).replace("%", "%%") for key in keys]
            self.keys = [f"{', ' if number else '{'}{key}: " for number, key in enumerate(texts)]
            self.end, self.null, self.quote = "}\n", "null", '"'
        self.place = 1 + len(names)  # index of the column `status`
        self.cells: list[str] = []
        self.varied: list[int] = []
        self.patterns: dict[tuple[WordCodes, bytes], str] = {}

    def begin(self, first: Floats, alike: Sequence[bool]) -> None:
        """Begin a block of rows. Columns marked in `alike` have the values of the first row."""
        self.cells = ["%d", *[NUMBER] * (len(first) - 1)]
        self.varied = [column for column, same in enumerate(alike) if not same]
        for column, same in enumerate(alike):
            if same:
                known = bool(np.isfinite(first[column]))
                self.cells[column] = self.cells[column] % first[column] if known else self.null
        self.patterns.clear()

    def pattern(self, words: WordCodes, exists: bytes = b"") -> str:
        """Return the %-format of a row. `exists` marks the numbers that are not missing."""
        status, gear = words
        pattern = self.patterns.get((words, exists))
        if pattern is None:
            cells = self.cells.copy()
            for column, mark in zip(self.varied, exists, strict=False):
                if not mark:
                    cells[column] = self.null
            status_cell = [f"{self.quote}{STATUS[status]}{self.quote}"]
            cells[self.place : self.place] = status_cell + (
                [self.gears[gear]] if self.gears else []
            )
            pairs = zip(self.keys, cells, strict=True)
            pattern = "".join(key + cell for key, cell in pairs) + self.end
            self.patterns[words, exists] = pattern
        return pattern
