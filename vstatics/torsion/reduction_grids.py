"""Reduced inertias and compliances as tables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vstatics.tables.grid import Column, Grid, Row, exact, text
from vstatics.torsion.reduction import Amounts, GearReduction


def reduction_grids(to: str, gears: Sequence[GearReduction]) -> Iterator[Grid]:
    """A row for each link or device, a column for each gear.

    Examples
    --------
    >>> one = GearReduction("1", {"a": 0.5}, {"s": 0.04}, {"a": 2.0}, {"a": ["b", "c"]}, {})
    >>> [grid.key for grid in reduction_grids("a", [one])]
    ['inertias', 'compliances', 'ratios', 'notes']
    """
    tables = (
        (f"Inertias reduced to {to} [kg*m^2]", "link", [one.inertias for one in gears]),
        (f"Compliances reduced to {to} [rad/(N*m)]", "device", [one.compliances for one in gears]),
        (f"Ratios w_{to}/w_link", "link", [one.ratios for one in gears]),
    )
    for title, heading, by_gear in tables:
        yield _by_gear(title, heading, gears, by_gear)
    notes: list[Row] = [
        [gear.name, first, f"rigidly joined: {', '.join(others)}"]
        for gear in gears
        for first, others in gear.merged.items()
    ]
    notes += [[gear.name, link, note] for gear in gears for link, note in gear.notes.items()]
    notes += [[gear.name, "", gear.error] for gear in gears if gear.error]
    if notes:
        yield Grid("Notes", [text("gear"), text("link"), text("note")], notes, key="notes")


def _by_gear(
    title: str, heading: str, gears: Sequence[GearReduction], by_gear: Sequence[Amounts]
) -> Grid:
    names = dict.fromkeys(name for amounts in by_gear for name in amounts)
    rows: list[Row] = [
        [name, *(exact(amounts.get(name), 4) for amounts in by_gear)] for name in names
    ]
    columns = [text(heading), *(Column(gear.name) for gear in gears)]
    return Grid(title, columns, rows, key=title.split(maxsplit=1)[0].lower())
