"""Results as a notebook shows them: the table of the gears."""

from __future__ import annotations

from html import escape

from vstatics.statics.results import Results
from vstatics.summary.pretty import gears_grid
from vstatics.tables.html import table


def html(results: Results) -> str:
    """The gears of one case as a table; arrays of variants as a line.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> html(solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()]))).count("<tr>")
    2
    """
    if results.ratio.ndim != 1:
        return f"<code>{escape(repr(results))}</code>"
    return table(gears_grid(results))
