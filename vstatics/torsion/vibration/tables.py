"""Tables of natural modes, and of corrections from a measured mode."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from vstatics.core.tables.grid import Cell, Grid, Values, exact, grid_of, whole
from vstatics.core.tables.numbers import certain, fixed
from vstatics.torsion.tolerances import LEAST_SHOWN_PART
from vstatics.torsion.vibration.decays import Decay
from vstatics.torsion.vibration.gear_modes import GearModes, Mode
from vstatics.torsion.vibration.measured import Damped, Identified


def modes_grids(gears: Sequence[GearModes]) -> Iterator[Grid]:
    """Yield tables of frequencies of all gears, then of shapes, torques and energy of each gear.

    Examples
    --------
    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.vibration.gear_modes import modes
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
    >>> tables = list(modes_grids(modes(case)))
    >>> [table.title for table in tables[:3]]
    ['Rigid modes', 'Natural frequencies', 'Largest shares of energy']
    >>> tables[1].texts
    [['1', '1', '10.000', '1.592', '0.000', '1.592', '1']]
    >>> [table.title for table in tables[3:]]
    ['Gear 1: amplitudes of links', ..., 'Gear 1: shares of elastic energy']
    """
    yield from overview_grids(gears)
    eigenvalues = [(gear.name, s.real, s.imag) for gear in gears for s in gear.damped]
    if eigenvalues:
        yield grid_of(
            "Eigenvalues of damped vibration",
            ("gear", "real [1/s]", "imaginary [rad/s]"),
            eigenvalues,
            key="damped",
        )
    for gear in gears:
        if gear.modes:
            yield _by_mode(gear, "link", "amplitudes of links", lambda mode: mode.shape, _part)
            torques = "torques of components at these amplitudes [N*m/rad]"
            yield _by_mode(gear, "torque of", torques, lambda mode: mode.torques)
            yield _by_mode(gear, "link", "shares of kinetic energy", lambda m: m.kinetic, _part)
            yield _by_mode(
                gear, "component", "shares of elastic energy", lambda m: m.elastic, _part
            )


def overview_grids(gears: Sequence[GearModes]) -> Iterator[Grid]:
    """Yield tables of the frequencies of all gears, and of the largest energy shares."""
    rigid = (
        (gear.name, whole(math.nan if gear.error else gear.rigid_modes), gear.error)
        for gear in gears
    )
    yield grid_of(
        "Rigid modes", ("gear", "rigid modes", "note"), rigid, key="rigid", optional=["note"]
    )
    if any(gear.modes for gear in gears):
        frequencies = []
        for gear in gears:
            for number, mode in enumerate(gear.modes, 1):
                numbers = mode.omega, mode.frequency, mode.damping_ratio, mode.damped_frequency
                frequencies.append((gear.name, number, *numbers, mode.nodes))
        yield grid_of("Natural frequencies", ["gear", *_HEADINGS], frequencies, key="frequencies")
        energies = (
            (gear.name, number, *_largest(mode.elastic), *_largest(mode.kinetic))
            for gear in gears
            for number, mode in enumerate(gear.modes, 1)
        )
        yield grid_of(
            "Largest shares of energy",
            ("gear", "mode", "component", "share", "link", "share"),
            energies,
            key="energy",
        )


_HEADINGS = ("mode", "omega [rad/s]", "frequency [Hz]", "damping [-]", "damped [Hz]", "nodes")


def _largest(shares: Mapping[str, float]) -> tuple[str, float | None]:
    name = max(shares, key=lambda name: certain(shares[name]), default="")
    return name, shares.get(name)


def _by_mode(
    gear: GearModes,
    heading: str,
    what: str,
    values: Callable[[Mode], Mapping[str, float]],
    cell: Callable[[float], Cell] = exact,
) -> Grid:
    """Return a table with a row for each link or component and a column for each mode."""
    by_mode = [values(mode) for mode in gear.modes]
    headings = [f"{number}: {mode.omega:.4g}" for number, mode in enumerate(gear.modes, 1)]
    rows: list[Values] = [
        (name, *(cell(of_mode[name]) for of_mode in by_mode)) for name in by_mode[0]
    ]
    grid = grid_of(f"Gear {gear.name}: {what}", [heading, *headings], rows)
    return grid._replace(group=what.partition(" at ")[0])


def _part(value: float) -> Cell:
    """Return the cell of a share or relative amplitude, 0.000 if negligible."""
    cell = exact(value)
    return cell._replace(text=fixed(value)) if abs(value) < LEAST_SHOWN_PART else cell


_DAMPING = "damping [N*m*s/rad]"


def identified_grids(omega: float, identified: Identified) -> Iterator[Grid]:
    """Yield a table of compliances, and dampings if any, for a measured frequency [rad/s].

    Examples
    --------
    >>> [grid] = identified_grids(20.0, Identified(22.0, {"shaft": 0.0121}, {"shaft": 3.5}))
    >>> grid.title, grid.texts
    ('Calculated 22 rad/s, measured 20: all compliances by 1.21', [['shaft', '0.01210', '3.500']])
    """
    rows = (
        (name, value, identified.dampings.get(name))
        for name, value in identified.compliances.items()
    )
    headings = "component", "compliance [rad/(N*m)]", _DAMPING
    title = f"Calculated {identified.omega:.5g} rad/s, measured {omega:.5g}: "
    title += f"all compliances by {(identified.omega / omega) ** 2:.5g}"
    yield grid_of(title, headings, rows, key="identified", optional=[_DAMPING])


def decay_grid(vibration: Decay) -> Grid:
    """Return a table of the inner extremes of a record, as in (П2.1)."""
    headings = "extreme", "mean line", "amplitude"
    rows = zip(
        range(2, len(vibration.amplitudes) + 2),
        vibration.mean_line,
        vibration.amplitudes,
        strict=True,
    )
    return grid_of(
        f"Recorded {vibration.omega:.5g} rad/s, decrement {vibration.decrement:.5g}",
        headings,
        rows,
        key="record",
    )


def damped_grids(decrements: Mapping[str, float], damped: Damped) -> Iterator[Grid]:
    """Yield a table of the dampings of components, with the decrement of the mode.

    Examples
    --------
    >>> damped = Damped(10.0, {"shaft": 0.5}, 0.03, {"shaft": 0.75})
    >>> [grid] = damped_grids({"shaft": 0.04}, damped)
    >>> grid.title, grid.texts
    ('Dampings at 10 rad/s', [['shaft', '0.04000', '0.750', '0.500'], ['mode', '0.03000', '', '']])
    """
    rows: list[Values] = [
        (name, value, damped.shares[name], damped.dampings[name])
        for name, value in decrements.items()
    ]
    rows.append(("mode", damped.decrement, "", ""))
    yield grid_of(
        f"Dampings at {damped.omega:.5g} rad/s",
        ["component", "decrement", "share of elastic energy", _DAMPING],
        rows,
        key="dampings",
    )
    if damped.notes:
        yield grid_of("Messages", [""], ([note] for note in damped.notes), key="messages")
