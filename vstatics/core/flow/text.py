"""Power flow of gears as text."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from operator import attrgetter

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.flow.tables import power_grid, remarks
from vstatics.core.tables.grid import Cell, Column, Grid
from vstatics.core.tables.numbers import fixed
from vstatics.core.tables.ports import ports_grid
from vstatics.core.tables.quantities import UNITS
from vstatics.core.tables.text import lines
from vstatics.core.texts import tr

FLOW_TEXT_WIDTH = 79
"""Width of the text, in characters."""
NAME, NUMBER, SHARE = 27, 8, 6
"""Widths of the columns, in characters. A longer name has its own line."""
HEADINGS = {"with losses": "lossy", "loss, kW": "kW", "share, %": "share"}
"""Short headings that replace the headings of tables."""
DECIMALS = {"kW": UNITS["kW"].decimals, "loss": 4, "loss, kW": UNITS["kW"].decimals}
"""Number of decimals of columns, if not 3."""


def text(flow: GearFlow, digits: int | None = None) -> str:
    """Return the power flow of a gear as a table of 79 columns.

    Parameters
    ----------
    digits : int, optional
        Number of decimals of every number. More than four make the columns wider.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [flow] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> print(text(flow), end="")
    gear 1                         ideal    lossy     loss  share
    links
      1                            1.000    1.000
      2                            1.000    0.980
    mechanisms
      pair                         1.000    1.000   0.0200 100.0%
        first: 1                   1.000    1.000
        second: 2                 -1.000   -0.980
        teeth                      1.000    1.000
    ports
      port           speed  torque    power  direction
      1              1.000   1.000    1.000  in
      2             -0.250  -3.920    0.980  out
      lost: meshes                  0.02000
    in 1.000 - out 0.980 - lost 0.020 = 0.000
    recirculating power: none
    """
    return "".join(f"{line.rstrip()}\n" for line in _lines(flow, digits))


def _lines(flow: GearFlow, digits: int | None) -> Iterator[str]:
    if flow.ideal is None:
        why = tr("{Why}, so there is no power to show", Why=tr(flow.note))
        yield f"{tr('gear {gear}', gear=flow.gear)}: {why}"
        return
    spoken = power_grid(flow).changed(attrgetter("spoken"))
    grid = _narrow(spoken, tr("gear {gear}", gear=flow.gear), digits)
    wider = max(digits or 0, 4) - 4
    widths = [NAME, *[NUMBER + wider] * (len(grid.columns) - 2), SHARE + wider]
    yield from lines(grid, widths=widths, gap=" ")
    ports = ports_grid([flow.ports], named=False)._replace(title="ports")
    yield from lines(ports.with_digits(digits), indent="  ")
    for remark in remarks(flow, digits):
        yield from textwrap.wrap(
            remark,
            FLOW_TEXT_WIDTH,
            subsequent_indent=" " * (4 if remark.startswith(" ") else 2),
            break_long_words=False,
            break_on_hyphens=False,
        )


def _narrow(grid: Grid, heading: str, digits: int | None) -> Grid:
    """Return the table with short headings, shorter numbers, and marks after the names."""
    names = [column.heading for column in grid.columns[1:] if column.is_number]
    columns = [
        Column(heading, is_number=False),
        *(Column(HEADINGS.get(name, name)) for name in names),
    ]
    rows = [
        [
            " ".join(cell.text for cell in (row[0], *row[1 + len(names) :])).rstrip(),
            *(_field(*pair, digits) for pair in zip(names, row[1:], strict=False)),
        ]
        for row in grid.cells
    ]
    return grid._replace(title="", columns=columns, rows=rows)


def _field(name: str, cell: Cell, digits: int | None) -> str:
    """Return the text of a number. An indeterminate number is a field of asterisks."""
    if cell.value is None:
        return ""
    if name == "share, %":
        return f"{cell.value:.{1 if digits is None else digits}f}%"
    return fixed(cell.value, NUMBER, DECIMALS.get(name, 3) if digits is None else digits)
