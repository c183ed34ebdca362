"""Tables as CSV: what stands in a cell, so that a spreadsheet takes no text for a formula."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.tables.grid import Grid

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
FORMULA = re.compile(r"'*[=+\-@\t\r]")
"""How a text begins that a spreadsheet calculates; with apostrophes before, so that the one
that is put there can be told from those of the text."""


def guarded(text: str) -> str:
    """A text that no spreadsheet calculates: an apostrophe stands before what begins a formula.

    Examples
    --------
    >>> [guarded(text) for text in ("=1+1", "@now", "-3.5", "-gear", "low")]
    ["'=1+1", "'@now", '-3.5', "'-gear", 'low']
    """
    return f"'{text}" if FORMULA.match(text) and not NUMBER.fullmatch(text) else text


def unguarded(text: str) -> str:
    """The text that `guarded` was given; another one as it is.

    >>> [unguarded(text) for text in ("'=1+1", "=1+1", "'low'", "''=1")]
    ['=1+1', '=1+1', "'low'", "'=1"]
    """
    return text[1:] if text[:1] == "'" and FORMULA.match(text) else text


def lines(rows: Iterable[Iterable[str]], *, raw: bool = False) -> str:
    """Rows of texts as lines of CSV.

    Parameters
    ----------
    raw : bool
        Whether texts stay as they are, also where a spreadsheet calculates them.
    """
    written = io.StringIO()
    kept = rows if raw else (map(guarded, row) for row in rows)
    csv.writer(written, lineterminator="\n").writerows(kept)
    return written.getvalue()


def write(
    cases: Iterable[tuple[str, Sequence[Grid]]], *, several: bool, raw: bool = False
) -> Iterator[str]:
    """The tables of cases, piece by piece: numbers in full, one table below the other.

    Each row begins with the name of its table, among several with the file of its case
    before. A row of headings stands where these change.

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
            headings = ["case"] * several + ["table", *(one.heading for one in grid.columns)]
            if headings != before:
                rows.append(headings)
            before = headings
            front = [file] * several + [grid.key or grid.title]
            for row in grid.data:
                plain = (int(one) if isinstance(one, bool) else one for one in row)
                rows.append([*front, *("" if one is None else str(one) for one in plain)])
        yield lines(rows, raw=raw)
