"""The tables of a summary, each cell as text: what every format for people shows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.statics.results import Results
from vstatics.core.statics.status import NEUTRAL
from vstatics.core.summary import Summary
from vstatics.core.summary.extremes import LOSSY_TORQUES, PLANETS, SLIPS, TORQUES, Largest, quantity
from vstatics.core.tables.grid import NO, YES, Cell, Column, Grid, Row, exact, grid_of, word
from vstatics.core.tables.ports import PortTable, port_tables, ports_grid
from vstatics.core.tables.quantities import UNITS, Quantity, headed

INERTIA, ACCELERATION = "inertia, kg*m^2", "acceleration, rad/s^2"
WITH_LOAD = " with load"
"""Ends the key of a table in units."""


class Marks(NamedTuple):
    """Signs for what a shift element does in a gear."""

    engaged: str = YES
    holds: str = YES
    open: str = NO


def summary_grids(summary: Summary, ports: Sequence[PortTable] | None = None) -> Iterator[Grid]:
    """All tables of a summary; those that would be empty are left out.

    What was asked for and gave nothing stays, without rows and columns.

    Parameters
    ----------
    ports : sequence of PortTable, optional
        Of its gears, where they are known already.
    """
    tables = (
        _design(summary),
        _spread(summary),
        _transitions(summary),
        _slip_powers(summary),
        ports_grid(port_tables(summary.results) if ports is None else ports),
        *_largest(summary),
        *_margins(summary),
        _needed(summary),
        *(summary.cycle.grids() if summary.cycle else ()),
        _inertias(summary),
        *(summary.vehicle.grids() if summary.vehicle else ()),
        _sensitivities(summary),
        _efficiency_sensitivities(summary),
    )
    yield from (grid for grid in tables if grid.rows)
    if summary.combinations is not None:
        yield other_combinations(summary)


def _design(summary: Summary) -> Grid:
    lines = summary.design.gears
    headings = "gear", "ratio", "next", "step", "efficiency", "state"
    rows = ((*line[:-1], state(line.state)) for line in lines)
    return grid_of("Gears", headings, rows, key="gears", optional=["state"])


def state(name: str) -> Cell:
    """Why a gear lacks something; what data call `open` is neutral to readers.

    >>> state("open").text, state("open").datum, state("tied up").text
    ('neutral', 'open', 'tied up')
    """
    if name == NEUTRAL.name:
        return word(NEUTRAL.english)._replace(written_as=name)
    return word(name)


def element_signs(results: Results, index: int, marks: Marks) -> Iterator[Cell]:
    """Of each shift element: whether it is engaged in the gear of an index, or holds."""
    engaged = results.case.gears[index].engaged
    for element, holds in enumerate(results.holds[index].tolist(), 1):
        if element in engaged:
            yield Cell(marks.engaged, 1.0, "engaged", "green", bool)
        elif holds:
            yield Cell(marks.holds, 1.0, "freewheel that holds", "cyan", bool)
        else:
            yield Cell(marks.open, 0.0, "no", "dim", bool)


def _spread(summary: Summary) -> Grid:
    forward = summary.design.forward
    if len(forward) < 2:
        return Grid("Spread", (), ())
    row = forward[0], forward[-1], summary.design.spread
    return grid_of("Spread", ["from", "to", "spread"], [row], key="spread")


def _transitions(summary: Summary) -> Grid:
    rows = [
        (one.start, one.end, one.skipped, word(one.word), one.released, one.engaged)
        for one in summary.transitions
    ]
    headings = "from", "to", "skips", "kind", "released", "engaged"
    return grid_of("Transitions", headings, rows, key="transitions")


def _slip_powers(summary: Summary) -> Grid:
    """Of the shifts that skip no gear, and of elements that have any."""
    shifts = [one for one in summary.transitions if not one.skipped]
    loaded = any(math.isfinite(power) for one in shifts for power in one.slip_power_kW.values())
    rows = [
        (one.start, one.end, name, word("up" if name in one.engaged else "down"), exact(power, 3))
        for one in shifts
        for name, power in (one.slip_power_kW if loaded else one.slip_power).items()
        if power > 0
    ]
    headings = "from", "to", "element", "shift", headed("power", "kW" if loaded else "")
    title = "Slip power where an element closes: its torque after, its slip before"
    return grid_of(title, headings, rows, key="slip power")


def _largest(summary: Summary) -> Iterator[Grid]:
    for loaded in (False, True):
        yield _planets(summary, loaded=loaded)
        yield _elements(summary, loaded=loaded)


def _planets(summary: Summary, *, loaded: bool) -> Grid:
    shown = quantity(PLANETS, loaded=loaded)
    headings = "planet", headed("speed", shown.unit), "gear"
    lines = summary.largest.get(shown.key, ())  # those of gear pairs, say, are none
    devices = summary.results.case.own_devices
    planets = [planet for device in devices for planet in device.planets]
    without_teeth = {one.name for one in planets if math.isnan(one.speed)}
    told = (one for one in lines if one.row in without_teeth or not math.isnan(one.value))
    rows = [[one.row, *_cells(shown, one)] for one in told]
    title = "Largest speeds of planets against their carriers"
    return grid_of(title, headings, rows, key="planets" + WITH_LOAD * loaded)


def _elements(summary: Summary, *, loaded: bool) -> Grid:
    """Slip and torques of shift elements side by side."""
    named = {SLIPS: "slip", TORQUES: "torque", LOSSY_TORQUES: "with losses"}
    shown = [(quantity(key, loaded=loaded), name) for key, name in named.items()]
    shown = [(one, name) for one, name in shown if summary.largest.get(one.key)]
    headings = [heading for one, name in shown for heading in (headed(name, one.unit), "gear")]
    found = [[(one, line) for line in summary.largest[one.key]] for one, _ in shown]
    rows = [
        [pairs[0][1].row, *(cell for pair in pairs for cell in _cells(*pair))]
        for pairs in zip(*found, strict=True)
    ]
    title = "Largest slip when open, largest torque when engaged"
    key = "shift elements" + WITH_LOAD * loaded
    return grid_of(title, ["element", *headings], rows, key=key)


def _cells(shown: Quantity, line: Largest) -> Row:
    return [exact(line.value, shown.decimals), line.gear]


def _sensitivities(summary: Summary) -> Grid:
    mechanisms = summary.results.case.mechanisms
    names = [one.name for one in mechanisms]
    by_name = zip(names, summary.sensitivities.T.tolist(), strict=True)
    title = "Sensitivity (u/i) di/du of the ratio i of each gear to each internal ratio u"
    if any(one.kind for one in mechanisms):
        title = (
            "Sensitivity (u/i) di/du of the ratio i of each gear to each internal ratio u, of "
            "variators and converters to their speed ratio"
        )
    return _by_gear(summary, title, "sensitivity", "mechanism", by_name)


def _efficiency_sensitivities(summary: Summary) -> Grid:
    names = [mechanism.name for mechanism in summary.results.case.mechanisms]
    by_name = zip(names, summary.efficiency_sensitivities.T.tolist(), strict=True)
    title = "Sensitivity (n/ETA) dETA/dn of efficiencies ETA to each efficiency n"
    return _by_gear(summary, title, "efficiency sensitivity", "mechanism", by_name)


def _by_gear(
    summary: Summary,
    title: str,
    key: str,
    heading: str,
    rows: Iterable[tuple[str, Sequence[float]]],
) -> Grid:
    """A row for each name with a number for each gear."""
    gears = summary.results.case.gears
    columns = (Column(gear.name, over="gear") for gear in gears)
    return grid_of(title, (heading, *columns), ((name, *values) for name, values in rows), key=key)


def other_combinations(summary: Summary) -> Grid:
    """Combinations of shift elements that are no gear yet."""
    others = summary.combinations or ()
    title = "Other combinations of shift elements"
    if not others:
        return Grid(f"{title}: none", (), (), key="combinations")
    rows = [(one.ratio, one.efficiency, one.gear, one.engaged, one.holding) for one in others]
    headings = "ratio", "efficiency", "same as", "engaged", "holding"
    return grid_of(title, headings, rows, key="combinations", optional=["holding"])


def _margins(summary: Summary) -> Iterator[Grid]:
    """The least margins, then those of all gears."""
    load = summary.results.case.load
    torque = None if load is None else load.torque_size
    unit, size = ("Nm", abs(torque)) if torque else ("", 1.0)
    decimals = UNITS[unit].decimals if unit else 3
    rows = [
        (one.element, exact(one.capacity * size, decimals), one.least, one.gear)
        for one in summary.margins
    ]
    headings = "element", headed("capacity", unit), "least", "gear"
    yield grid_of("Least margin, capacity by torque", headings, rows, key="margins")
    by_element = [(one.element, one.by_gear) for one in summary.margins]
    yield _by_gear(summary, "Margins by gear", "margins by gear", "element", by_element)


def _needed(summary: Summary) -> Grid:
    loaded = any(math.isfinite(one.capacity_Nm) for one in summary.needed)
    unit, decimals = ("Nm", UNITS["Nm"].decimals) if loaded else ("", 3)
    rows = [
        (one.element, exact(one.capacity_Nm if loaded else one.capacity, decimals), one.gear)
        for one in summary.needed
    ]
    headings = "element", headed("capacity", unit), "gear"
    return grid_of("Needed capacity, with the reserve", headings, rows, key="needed capacity")


def _inertias(summary: Summary) -> Grid:
    """Accelerations only where a load gives one."""
    title = "Inertia at the input, acceleration of the input"
    headings = ["gear", INERTIA, ACCELERATION]
    return grid_of(title, headings, summary.inertias, key="inertia", optional=[ACCELERATION])
