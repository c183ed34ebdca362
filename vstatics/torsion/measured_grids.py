"""What follows from a mode that was measured, as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from vstatics.tables.grid import Column, Grid, Row, exact, text
from vstatics.torsion.measured import Damped, Identified

_DAMPING = "damping [N*m*s/rad]"


def identified_grids(omega: float, made: Identified) -> Iterator[Grid]:
    """Compliances, and dampings if there are any, for a measured frequency [rad/s].

    Examples
    --------
    >>> [grid] = identified_grids(20.0, Identified(22.0, {"shaft": 0.0121}, {"shaft": 3.5}))
    >>> grid.title, grid.texts
    ('Calculated 22 rad/s, measured 20: all compliances by 1.21', [['shaft', '.01210', '3.500']])
    """
    columns = [text("device"), Column("compliance [rad/(N*m)]")]
    columns += [Column(_DAMPING)] * bool(made.dampings)
    rows: list[Row] = [
        [name, exact(one), *(exact(by[name]) for by in (made.dampings,) if by)]
        for name, one in made.compliances.items()
    ]
    title = f"Calculated {made.omega:.5g} rad/s, measured {omega:.5g}: "
    title += f"all compliances by {(made.omega / omega) ** 2:.5g}"
    yield Grid(title, columns, rows, key="identified")


def damped_grids(decrements: Mapping[str, float], made: Damped) -> Iterator[Grid]:
    """Dampings of devices, and the decrement of the mode.

    Examples
    --------
    >>> made = Damped(10.0, {"shaft": 0.5}, 0.03, {"shaft": 0.75})
    >>> [grid] = damped_grids({"shaft": 0.04}, made)
    >>> grid.title, grid.texts
    ('Dampings at 10 rad/s', [['shaft', '.04000', '.750', '.500'], ['mode', '.03000', '', '']])
    """
    rows: list[Row] = [
        [name, exact(one), exact(made.shares[name]), exact(made.dampings[name])]
        for name, one in decrements.items()
    ]
    rows.append(["mode", exact(made.decrement), "", ""])
    headings = ["decrement", "share of elastic energy", _DAMPING]
    columns = [text("device"), *map(Column, headings)]
    yield Grid(f"Dampings at {made.omega:.5g} rad/s", columns, rows, key="dampings")
    if made.notes:
        yield Grid("Messages", [text("")], [[one] for one in made.notes], key="messages")
