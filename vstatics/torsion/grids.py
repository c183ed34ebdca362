"""Modes as tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from vstatics.tables.grid import Cell, Column, Grid, Row, exact, text, whole
from vstatics.tables.numbers import fixed
from vstatics.torsion.gear_modes import GearModes, Mode

SMALL = 0.0005
"""Parts of 1 that are below are not told apart from 0, but with all digits in JSON and CSV."""


def modes_grids(gears: Sequence[GearModes]) -> Iterator[Grid]:
    """Frequencies of all gears, then shapes, torques and shares of energy of each.

    Examples
    --------
    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.gear_modes import modes
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> tables = list(modes_grids(modes(case)))
    >>> tables[0].texts
    [['1', '1', '10.000', '1.592', '.000', '1.592', '1', 'shaft 100%; 2 50%']]
    >>> [table.title for table in tables[1:]]
    ['Gear 1: amplitudes of links', ..., 'Gear 1: shares of elastic energy']
    """
    yield _frequencies(gears)
    yield from _damped(gears)
    for gear in gears:
        if gear.modes:
            of = f"Gear {gear.name}"
            title = f"{of}: amplitudes of links"
            yield _by_mode(gear, title, "link", lambda mode: mode.shape, _part)
            title = f"{of}: torques of devices at these amplitudes [N*m/rad]"
            yield _by_mode(gear, title, "torque of", lambda mode: mode.torques)
            title = f"{of}: shares of kinetic energy"
            yield _by_mode(gear, title, "link", lambda mode: mode.kinetic, _part)
            title = f"{of}: shares of elastic energy"
            yield _by_mode(gear, title, "device", lambda mode: mode.elastic, _part)


def _damped(gears: Sequence[GearModes]) -> Iterator[Grid]:
    """The eigenvalues of damped gears."""
    rows: list[Row] = [
        [gear.name, exact(one.real), exact(one.imag)] for gear in gears for one in gear.damped
    ]
    if rows:
        columns = [text("gear"), Column("real [1/s]"), Column("imaginary [rad/s]")]
        yield Grid("Eigenvalues of damped vibration", columns, rows, key="damped")


_HEADINGS = ("mode", "omega [rad/s]", "frequency [Hz]", "damping ratio", "damped [Hz]", "nodes")


def _frequencies(gears: Sequence[GearModes]) -> Grid:
    rows: list[Row] = []
    for gear in gears:
        note = gear.error or f"{gear.rigid_modes} rigid"
        rows += [[gear.name, *[Cell("")] * len(_HEADINGS), note]] if not gear.modes else []
        for number, mode in enumerate(gear.modes, 1):
            numbers = mode.omega, mode.frequency, mode.damping_ratio, mode.damped_frequency
            cells = [whole(number), *map(exact, numbers), whole(mode.nodes)]
            rows.append([gear.name, *cells, _most(mode)])
    columns = [text("gear"), *map(Column, _HEADINGS), text("most of its energy")]
    return Grid("Natural frequencies", columns, rows, key="frequencies")


def _most(mode: Mode) -> str:
    """Where most of the elastic and of the kinetic energy is."""
    return "; ".join(_largest(shares) for shares in (mode.elastic, mode.kinetic) if shares)


def _largest(shares: Mapping[str, float]) -> str:
    name = max(shares, key=lambda one: shares[one])
    return f"{name} {shares[name]:.0%}"


def _by_mode(
    gear: GearModes,
    title: str,
    heading: str,
    values: Callable[[Mode], Mapping[str, float]],
    cell: Callable[[float], Cell] = exact,
) -> Grid:
    """A row for each link or device, a column for each mode."""
    by_mode = [values(mode) for mode in gear.modes]
    headings = [f"{number}: {mode.omega:.4g}" for number, mode in enumerate(gear.modes, 1)]
    rows: list[Row] = [[name, *(cell(one[name]) for one in by_mode)] for name in by_mode[0]]
    return Grid(title, [text(heading), *map(Column, headings)], rows)


def _part(value: float) -> Cell:
    """A part of 1: what is small beside it is .000."""
    cell = exact(value)
    return cell._replace(text=fixed(value)) if abs(value) < SMALL else cell
