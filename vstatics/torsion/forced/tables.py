"""Tables of forced vibration: largest values for readers, or values at all speeds for programs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Complex, Floats, first_largest
from vstatics.core.numerics.tolerances import ROUNDED_NUMBER
from vstatics.core.tables.grid import Cell, Grid, Values, exact, grid_of
from vstatics.torsion.forced.harmonic_torques import GearResponse

_TITLES = ("amplitudes of links [rad]", "torques of components [N*m]")


def largest_grids(gears: Sequence[GearResponse]) -> Iterator[Grid]:
    """Yield tables of resonances, largest amplitudes and largest torques.

    Examples
    --------
    >>> gear = GearResponse("1", np.array([600.0]))
    >>> [grid.title for grid in largest_grids([gear])]
    ['Resonances: none at these speeds']
    """
    yield from _resonances(gears)
    for gear in gears:
        for title, by_name in _quantities(gear):
            orders = [f"{response.order:g}" for response in gear.orders]
            columns = [part for order in orders for part in (f"order {order}", f"{order} at [rpm]")]
            rows: list[Values] = []
            for name in by_name[0] if by_name else ():
                cells = [_largest(gear.speeds, values[name]) for values in by_name]
                rows.append((name, *(cell for pair in cells for cell in pair)))
            if rows:
                yield grid_of(f"Gear {gear.name}: largest {title}", ["name", *columns], rows)


def speed_grids(gears: Sequence[GearResponse]) -> Iterator[Grid]:
    """Yield tables for each order, with a row for each speed and a column for each name."""
    yield from _resonances(gears)
    for gear in gears:
        for title, by_name in _quantities(gear):
            for order, values in zip(gear.orders, by_name, strict=True):
                sizes = np.abs(np.array([gear.speeds, *values.values()]))
                name = f"Gear {gear.name}, order {order.order:g}: {title}"
                grid = grid_of(name, ["speed [rpm]", *values], sizes.T.tolist())
                yield grid._replace(group=title.partition(" [")[0])


_ROW_HEADINGS = ("gear", "order", "mode", "speed", "row", "value")


def row_grids(gears: Sequence[GearResponse]) -> Iterator[Grid]:
    """Yield a single table for CSV, with a row for each value, where `speed` is in rpm.

    Examples
    --------
    >>> from vstatics.torsion.forced.harmonic_torques import Resonance
    >>> gear = GearResponse("1", np.array([600.0]), resonances=[Resonance(2.0, 1, 610.0, 0.5)])
    >>> [(grid.key, grid.data) for grid in row_grids([gear])]
    [('resonance', [['1', 2.0, 1, None, None, 610.0]])]
    """
    resonances = [
        (gear.name, resonance.order, resonance.mode, "", "", resonance.speed)
        for gear in gears
        for resonance in gear.resonances
    ]
    yield grid_of("resonance", _ROW_HEADINGS, resonances, key="resonance")
    for gear in gears:
        for order in gear.orders:
            for key, by_name in (("amplitude", order.amplitudes), ("torque", order.torques)):
                yield _rows(key, gear, order.order, by_name)
        for key, sums in zip(("amplitude", "torque"), gear.sum or (), strict=False):
            for part in ("largest", "rms"):
                by_name = {name: getattr(total, part) for name, total in sums.items()}
                yield _rows(f"{key} {part}", gear, "", by_name)


def _rows(
    key: str, gear: GearResponse, order: float | str, by_name: Mapping[str, Floats | Complex]
) -> Grid:
    rows = [
        (gear.name, order, "", speed, name, size)
        for name, values in by_name.items()
        for speed, size in zip(gear.speeds.tolist(), np.abs(values).tolist(), strict=True)
    ]
    return grid_of(key, _ROW_HEADINGS, rows, key=key)


def _quantities(
    gear: GearResponse,
) -> Iterator[tuple[str, Sequence[Mapping[str, Complex]]]]:
    yield _TITLES[0], [order.amplitudes for order in gear.orders]
    yield _TITLES[1], [order.torques for order in gear.orders]


def _largest(speeds: Floats, values: Floats | Complex) -> tuple[Cell, Cell]:
    sizes = np.abs(values)
    at = int(first_largest(sizes))
    size = float(sizes[at])
    return exact(size, 4), exact(float(speeds[at]) if size > ROUNDED_NUMBER else math.nan, 1)


def _resonances(gears: Sequence[GearResponse]) -> Iterator[Grid]:
    """Yield the table of resonances, and notes on gears without a response."""
    rows = [
        (
            gear.name,
            Cell(f"{resonance.order:g}", resonance.order, kind=float),  # short, as in 2 or 4.5
            resonance.mode,
            exact(resonance.speed, 1),
            resonance.participation,
        )
        for gear in gears
        for resonance in gear.resonances
    ]
    headings = "gear", "order", "mode", "speed [rpm]", "participation"
    title = "Resonances" if rows else "Resonances: none at these speeds"
    yield grid_of(title, headings, rows, key="resonances")
    notes = [(gear.name, gear.error) for gear in gears if gear.error]
    if notes:
        yield grid_of("Notes", ["gear", "note"], notes, key="notes")


def sum_grids(gears: Sequence[GearResponse]) -> Iterator[Grid]:
    """Yield tables with the largest values over the speeds of the sums of all orders."""
    for gear in gears:
        headings = "name", "largest over a cycle", "at [rpm]", "RMS", "at [rpm]"
        for title, by_name in zip(_TITLES, gear.sum or (), strict=False):
            rows = [
                (name, *_largest(gear.speeds, total.largest), *_largest(gear.speeds, total.rms))
                for name, total in by_name.items()
            ]
            if rows:
                grid = grid_of(f"Gear {gear.name}, all orders: {title}", headings, rows)
                yield grid._replace(group=f"all orders, {title.partition(' of ')[0]}")
