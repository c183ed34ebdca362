"""Power flow of all gears in a few common tables, for spreadsheets."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.core.flow.power_flow import GearFlow
from vstatics.core.flow.tables import around, doubt, power_grid
from vstatics.core.tables.grid import Cell, Grid, grid_of, text
from vstatics.core.tables.numbers import fixed
from vstatics.core.tables.ports import ports_grid
from vstatics.core.texts import tr


def flow_grids(flows: Sequence[GearFlow]) -> Iterator[Grid]:
    """Yield the tables of power, ports, balances and loops.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> tables = list(flow_grids(flows(solve(Transmission(2, [], [pair], [Gear()])))))
    >>> [table.title for table in tables]
    ['Power', 'Ports', 'Balance']
    >>> tables[0].texts[3][:5]
    ['1', 'mechanisms', 'pair', 'first: 1', '1.000']
    """
    yield _power([(flow.gear, power_grid(flow)) for flow in flows])
    yield ports_grid([flow.ports for flow in flows])
    yield _balance(flows)
    loops = [
        (flow.gear, around(loop), loop.power, loop.note)
        for flow in flows
        for side in filter(None, [flow.shown])
        for loop in side.loops
    ]
    if loops:
        yield grid_of("Recirculating power", ["gear", "loop", "power", "note"], loops)


def _power(by_gear: Sequence[tuple[str, Grid]]) -> Grid:
    """Return a common table of all gears, with columns for section, node and member."""
    columns = {column.heading: column for _, grid in by_gear for column in grid.columns[1:]}
    rows = []
    for gear, grid in by_gear:
        headings = [column.heading for column in grid.columns[1:]]
        section, node = Cell(""), Cell("")
        for (first, *cells), level in zip(grid.cells, grid.levels, strict=True):
            if level == 1:
                section = first
                continue
            node = first if level == 2 else node
            part = Cell("") if level == 2 else first
            part = part if level < 4 else Cell(tr("teeth {mesh}", mesh=first.text))
            known = dict(zip(headings, cells, strict=True))
            rows.append([gear, section, node, part, *(known.get(column, "") for column in columns)])
    front = [text(column) for column in ("gear", "kind", "power through", "part")]
    return Grid("Power", [*front, *columns.values()], rows)


def _balance(flows: Sequence[GearFlow]) -> Grid:
    names = "entering", "leaving", "lost", "balance", "circulating"
    headings = "gear", *names[:-1], "recirculating", "note"
    rows = []
    for flow in flows:
        side = flow.shown
        values = [math.nan if side is None else getattr(side, name) for name in names]
        notes = [flow.note, "" if side is None else doubt(side, fixed)]
        rows.append((flow.gear, *values, "; ".join(filter(None, notes))))
    return grid_of("Balance", headings, rows)
