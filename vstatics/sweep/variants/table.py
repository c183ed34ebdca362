"""Table of variants in CSV, read to a `VariantTable`."""

from __future__ import annotations

import hashlib
import io
import math
from collections.abc import Iterator, Sequence
from itertools import chain, islice
from typing import IO, NamedTuple

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, of_file
from vstatics.core.jobs.spool import Spool
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.csv_rows import (
    Decimals,
    expect_cells,
    has_cells,
    headings_of,
    placed_cells,
    separator_of,
)
from vstatics.core.readers.named.headings import (
    MOST_TITLE_LINES,
    is_comment,
    is_row_of_numbers,
    with_unit,
    without_sign,
)
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.core.readers.signs import with_plain_blanks
from vstatics.core.readers.sweep_tables import NUMBER, STATUS
from vstatics.core.suggestions import nearest
from vstatics.core.tables.csv import unguarded
from vstatics.core.tables.written_results import GEAR
from vstatics.sweep.variants.numbered import VariantTable
from vstatics.sweep.variants.path_numbers import CasePath
from vstatics.sweep.variants.subject import VariedSubject, target_of
from vstatics.sweep.variants.targets import Varied, refusal, shown
from vstatics.sweep.variants.variation import read_value

_OF_PANDAS = "__index_level_0__"
"""Name of the column in which pandas stores row numbers in Parquet."""
_NO_OTHERS = (
    "; leave out columns that are not numbers of the case: only `variant`, a first column "
    "without a name, and the columns of a sweep from `status` on are skipped"
)

LONGEST_HEADING = 500
"""Largest number of letters accepted in a heading; names of numbers are shorter."""
_PIECE = 4 * 2**20
_LONGEST = 16 * 2**20
_IN_MEMORY = 2**17
_BOM = b"\xef\xbb\xbf"


class _Columns(NamedTuple):
    """Columns of a table of variants, as declared by the headings."""

    file: str
    line: int
    """Number of the line with the headings."""
    separator: str
    decimals: Decimals
    names: list[str]
    targets: list[Varied]
    chosen: list[int]
    """Index in the table of the column of each varied number."""


def read_table(opened: IO[bytes], file: str, subject: VariedSubject) -> VariantTable:
    """Read a table of variants in CSV, with names such as `D1.ratio` in the first line.

    Columns can have any order. A column `variant`, or a first column without a name, is ignored. In
    a table written by a sweep, all columns from `status` on are ignored. The separator is a comma
    or a semicolon. With a semicolon, a comma within a number is a decimal comma (see `Decimals`).
    An apostrophe in front, which prevents a spreadsheet from calculating a cell, is ignored. The
    encoding is UTF-8.

    Parameters
    ----------
    opened : binary file
        Stream, read once, in pieces.
    file : str
        Name of the file, for messages.
    subject : Transmission or VariedScenario

    Returns
    -------
    VariantTable
        A large table is kept in a temporary file, which `VariantTable.close` removes.

    Raises
    ------
    ReadError
        With all problems of the header, or of the first piece with problems.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> text = b"variant,D1.efficiency,D1.ratio\\n0,0.96,-2.5\\n1,0.97,-96/39\\n"
    >>> table = read_table(io.BytesIO(text), "own.csv", case)
    >>> [target.name for target in table.targets], table.block(0, 2)[0]
    (['D1.efficiency', 'D1.ratio'], array([ 0.96, -2.5 ]))
    """
    pieces = _pieces(opened, file)
    columns, first = _headings(next(pieces, b"").removeprefix(_BOM), file, subject)
    digest = hashlib.sha256()
    parts: list[Floats] = []
    spool: Spool | None = None
    try:
        for rows in _rows(first, pieces, columns):
            digest.update(rows.data)
            parts.append(rows)
            if spool is None and sum(part.size for part in parts) > _IN_MEMORY:
                spool = Spool(len(columns.targets))
            if spool is not None:
                for part in parts:
                    spool.write(part)
                parts.clear()
    except BaseException:
        if spool is not None:
            spool.close()
        raise
    if spool is None and not parts:
        message = "the table has no variant, expected a line of numbers below the names"
        raise ReadError([of_file("E713", file, message)])
    return VariantTable(columns.targets, spool or np.concatenate(parts), digest.hexdigest())


def _pieces(opened: IO[bytes], file: str) -> Iterator[bytes]:
    unfinished = b""
    line = 1
    while data := opened.read(_PIECE):
        end = data.rfind(b"\n") + 1
        if end:
            yield unfinished + data[:end]
            line += data.count(b"\n")
            unfinished = data[end:]
        else:
            unfinished += data
        if len(unfinished) > _LONGEST:
            message = f"the line is longer than {_LONGEST} bytes; is the file a table of numbers?"
            raise refusal(message, Place(file, line, 1))
    if unfinished:
        yield unfinished


def _headings(piece: bytes, file: str, subject: VariedSubject) -> tuple[_Columns, bytes]:
    """Return the columns that the line of headings declares, and the bytes below this line.

    Titles and comments above the headings are skipped.

    Raises
    ------
    ReadError
        If no line consists of headings; about the line above the numbers with most headings.
    """
    refused: dict[int, ReadError] = {}
    for line, number, below in islice(_filled_lines(piece, file), MOST_TITLE_LINES):
        if refused and is_row_of_numbers(line):
            break
        for head in dict.fromkeys([line, without_sign(line)]):
            try:
                return _header(head, Place(file, number, 1, line), subject), below
            except ReadError as error:
                known = len(placed_cells(head, separator_of(head))) - len(error.problems)
                refused.setdefault(known, error)
    raise refused[max(refused)]


def _filled_lines(piece: bytes, file: str) -> Iterator[tuple[str, int, bytes]]:
    """Yield each line that is not empty (else the last), its number, and the bytes below."""
    start = number = 0
    is_empty = True
    while start < len(piece) or is_empty:
        end = piece.find(b"\n", start) % (len(piece) + 1)
        start, number, line = end + 1, number + 1, _text(piece[start:end], file, number + 1)
        if has_cells(line) or (is_empty and start >= len(piece)):
            is_empty = False
            yield line, number, piece[start:]


def _header(line: str, start: Place, subject: VariedSubject) -> _Columns:
    if not line.strip():
        raise refusal("read an empty line, expected names such as D1.ratio", start)
    separator = separator_of(line)
    cells = placed_cells(line, separator)
    cells = cells[: len(headings_of([text for text, _ in cells]))]
    placed = [(unguarded(name), start._replace(column=column)) for name, column in cells]
    names = [name for name, _ in placed]
    chosen_targets = targets_of(placed, subject)
    return _Columns(start.file, start.line, separator, Decimals(separator), names, *chosen_targets)


def targets_of(
    cells: Sequence[tuple[str, Place]], subject: VariedSubject
) -> tuple[list[Varied], list[int]]:
    """Return the varied numbers that headings name, and the indices of the columns.

    Row numbers of a spreadsheet or of pandas are ignored. In a table written by a sweep, all
    columns from `status` on are ignored.

    Raises
    ------
    ReadError
        With all problems and their places.
    """
    names = [name for name, _ in cells]
    is_own = {NUMBER, STATUS} <= {*names}
    targets: list[Varied] = []
    chosen: list[int] = []
    problems: list[Problem] = []
    if is_own and GEAR in names:
        message = "a sweep with `--by gear` repeats each variant, expected a sweep without it"
        problems.append(Problem("E717", message, place=cells[names.index(GEAR)][1]))
    for index, (name, place) in enumerate(cells[: names.index(STATUS) if is_own else None]):
        if len(problems) >= MOST_PROBLEMS:
            break
        if name in (NUMBER, _OF_PANDAS) or (not name and not index):
            continue
        try:
            varied = _varied(name, subject, place)
        except ReadError as error:
            problems += _hinted(error.problems, name)
            continue
        if any(varied.numbers & earlier.numbers for earlier in targets):
            message = f"{varied.name} already has a column, expected each number once"
            problems.append(Problem("E714", message, place=place))
        targets.append(varied)
        chosen.append(index)
    if not (targets or problems):
        message = "no column is a number of the case, expected names such as D1.ratio"
        problems.append(Problem("E715", message, place=cells[0][1]))
    if problems:
        raise ReadError(problems)
    return targets, chosen


def _hinted(problems: Sequence[Problem], name: str) -> list[Problem]:
    hint = nearest(name[:LONGEST_HEADING], [NUMBER])
    hint += _NO_OTHERS if "." not in name and not hint else ""
    return [problem._replace(message=problem.message + hint) for problem in problems]


def _varied(name: str, subject: VariedSubject, place: Place) -> Varied:
    if len(name) > LONGEST_HEADING:
        message = f"a heading has {len(name)} characters, expected the name of a number"
        raise ReadError("E715", message, place=place)
    try:
        varied = target_of(name, subject, place)
    except ReadError:
        bare, unit = with_unit(name)
        if unit is None or name.endswith("]"):
            raise
        varied = target_of(f"{bare} [{unit}]", subject, place)
    try:
        return varied.in_unit("") if isinstance(varied, CasePath) else varied
    except ValueError as error:
        advice = "; give the unit in brackets in the heading" * (with_unit(name)[1] is None)
        raise refusal(f"{error}{advice}", place) from None


def _rows(first: bytes, pieces: Iterator[bytes], columns: _Columns) -> Iterator[Floats]:
    line = columns.line + 1
    for piece in chain([first], pieces):
        if piece.strip():
            rows = _fast(piece, columns)
            if rows is None:
                rows = _careful(piece, line, columns)
            if len(rows):
                yield rows
        line += piece.count(b"\n")
    if columns.decimals.doubt:
        number, message = columns.decimals.doubt
        raise refusal(message, Place(columns.file, number, 1))


def _fast(piece: bytes, columns: _Columns) -> Floats | None:
    """Return the numbers of a piece of the table.

    Return None if the piece needs the slower reader.
    """
    if columns.separator != ",":
        if b"." in piece or (columns.separator == "\t" and b"," in piece):
            # Points or commas can be separators of thousands: the slower reader decides.
            return None
        columns.decimals.are_commas |= b"," in piece
        piece = piece.replace(b",", b".")
    is_own = STATUS in columns.names  # columns after the numbers contain words
    try:
        rows = np.loadtxt(
            io.BytesIO(piece),
            delimiter=columns.separator,
            comments=None,
            usecols=columns.chosen if is_own else None,
            ndmin=2,
            dtype=np.float64,
        )
    except ValueError:
        return None
    if rows.shape[1] != len(columns.chosen if is_own else columns.names):
        return None
    rows = np.ascontiguousarray(rows if is_own else rows[:, columns.chosen])
    return rows if np.isfinite(rows).all() else None


def _careful(piece: bytes, line: int, columns: _Columns) -> Floats:
    """Read a piece of the table line by line, and report all problems."""
    rows: list[list[float]] = []
    problems: list[Problem] = []
    for number, data in enumerate(piece.split(b"\n"), line):
        try:
            text = _text(data, columns.file, number)
            if has_cells(text) and not is_comment(text):
                rows.append(_row(text, Place(columns.file, number, 1, text), columns))
        except ReadError as error:
            problems += error.problems
        if len(problems) >= MOST_PROBLEMS:
            break
    if problems:
        raise ReadError(problems)
    return np.array(rows).reshape(len(rows), len(columns.targets))


def _row(text: str, place: Place, columns: _Columns) -> list[float]:
    cells = placed_cells(text, columns.separator)
    expected = len(columns.names)
    try:
        expect_cells([text for text, _ in cells], expected, columns.separator)
    except ValueError as error:
        column = cells[expected][1] if len(cells) > expected else len(text) + 1
        raise refusal(str(error), place._replace(column=column)) from None
    row = []
    problems = []
    for index in columns.chosen:
        cell, column = cells[index]
        plain = unguarded(cell)
        try:
            row.append(finite(columns.decimals.with_points(plain, place.line)))
        except ValueError as error:
            message = f"{columns.names[index]}: read {shown(cell)}, {error}"
            problems.append(Problem("E718", message, place=place._replace(column=column)))
    if problems:
        raise ReadError(problems)
    return row


def finite(text: str) -> float:
    """Return a cell as a finite number; raise ValueError for any other text."""
    number = read_value(text)
    if not math.isfinite(number):
        raise ValueError("expected a finite number")
    return number


def _text(data: bytes, file: str, line: int) -> str:
    data = data.removesuffix(b"\r")
    try:
        return with_plain_blanks(data.decode())
    except UnicodeDecodeError as error:
        if b"\0" in data[: error.start]:
            message = "read a zero byte, so this is not a text; save the table as CSV in UTF-8"
            raise refusal(message, Place(file, line, 1)) from None
        column = len(data[: error.start].decode()) + 1
        place = Place(file, line, column, data.decode(errors="replace"))
        raise refusal("the file is not UTF-8; save the table as CSV in UTF-8", place) from None
