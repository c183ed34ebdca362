"""Tables as CSV, in which spreadsheets do not mistake texts for formulas."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.tables.grid import Grid

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
FORMULA = re.compile(r"'*[=+\-@\t\r]")
"""Pattern of the start of a text that a spreadsheet would evaluate as a formula.

Leading apostrophes are included, so that `unguarded` removes only an added apostrophe.
"""


def guarded(text: str) -> str:
    """Return a text, with an apostrophe in front if a spreadsheet would evaluate the text.

    Examples
    --------
    >>> [guarded(text) for text in ("=1+1", "@now", "-3.5", "-gear", "low")]
    ["'=1+1", "'@now", '-3.5', "'-gear", 'low']
    """
    return f"'{text}" if FORMULA.match(text) and not NUMBER.fullmatch(text) else text


def unguarded(text: str) -> str:
    """Return a text without the apostrophe that `guarded` added.

    >>> [unguarded(text) for text in ("'=1+1", "=1+1", "'low'", "''=1")]
    ['=1+1', '=1+1', "'low'", "'=1"]
    """
    return text[1:] if text[:1] == "'" and FORMULA.match(text) else text


def lines(rows: Iterable[Iterable[str]], *, raw: bool = False) -> str:
    """Return rows of texts as lines of CSV.

    Parameters
    ----------
    rows : iterable of iterable of str
    raw : bool
        True to omit the apostrophes of `guarded`.
    """
    written = io.StringIO()
    texts = rows if raw else (map(guarded, row) for row in rows)
    csv.writer(written, lineterminator="\n").writerows(texts)
    return written.getvalue()


def write(
    cases: Iterable[tuple[str, Sequence[Grid]]], *, several: bool, raw: bool = False
) -> Iterator[str]:
    """Yield the CSV text of each case: all tables in sequence, with all digits.

    Each row begins with the file of the case (if `several`) and the name of its table. A row of
    headings is written whenever the headings change.

    Parameters
    ----------
    cases : iterable of (str, sequence of Grid)
        Files of the cases, with their tables.
    several : bool
        True if the first column is the file of the case.
    raw : bool
        See `lines`.

    Examples
    --------
    >>> from vstatics.core.tables.grid import Column, exact
    >>> gears = Grid("Gears", [Column("gear", is_number=False), Column("ratio")],
    ...              [["1", exact(10 / 3)], ["-R", exact(None)]])
    >>> print("".join(write([("box.yaml", [gears])], several=False)), end="")
    table,gear,ratio
    Gears,1,3.3333333333333335
    Gears,'-R,
    """
    before: list[str] = []
    for file, grids in cases:
        rows = []
        for grid in grids:
            headings = ["case"] * several + ["table", *(column.heading for column in grid.columns)]
            if headings != before:
                rows.append(headings)
            before = headings
            front = [file] * several + [grid.key or grid.title]
            for row in grid.data:
                plain = (int(datum) if isinstance(datum, bool) else datum for datum in row)
                rows.append([*front, *("" if datum is None else str(datum) for datum in plain)])
        yield lines(rows, raw=raw)
