"""Tables of a summary, for text, HTML and other formats."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.statics.results import Results
from vstatics.core.statics.status import DRAGGED, LOCKED, NEUTRAL, OUTPUT_STANDS
from vstatics.core.summary import Summary
from vstatics.core.summary.extremes import LOSSY_TORQUES, PLANETS, SLIPS, TORQUES, Largest, quantity
from vstatics.core.tables.grid import NO, YES, Cell, Column, Grid, Row, exact, grid_of, word
from vstatics.core.tables.ports import PortTable, port_tables, ports_grid
from vstatics.core.tables.quantities import UNITS, Quantity, headed

INERTIA, ACCELERATION = "inertia, kg*m^2", "acceleration, rad/s^2"
SHOWN_STATES = {
    **{status.name: status.english for status in (NEUTRAL, LOCKED, DRAGGED)},
    OUTPUT_STANDS.name: "output at rest",
}
"""Words for states of gears, if they differ from the names in data."""
WITH_LOAD = " with load"
"""Suffix of the keys of tables in rpm, N*m or kW, in contrast to relative numbers."""


class Marks(NamedTuple):
    """Characters that mark the state of a shift element in a gear."""

    engaged: str = YES
    holds: str = YES
    open: str = NO
    slips: str = "~"


def summary_grids(summary: Summary, ports: Sequence[PortTable] | None = None) -> Iterator[Grid]:
    """Yield all tables of a summary that are not empty.

    If unused combinations were requested but none exists, their table has no rows.

    Parameters
    ----------
    ports : sequence of PortTable, optional
        Ports of the gears; None to calculate them.
    """
    lines = summary.design.gears
    headings = "gear", "ratio", "next", "step", "efficiency", "state"
    rows = ((*line[:-1], state(line.state)) for line in lines)
    tables = (
        grid_of("Gears", headings, rows, key="gears", optional=["state"]),
        _spread(summary),
        _transitions(summary),
        _slip_powers(summary),
        ports_grid(port_tables(summary.results) if ports is None else ports),
        *(
            table(summary, loaded=loaded)
            for loaded in (False, True)
            for table in (_planets, _elements)
        ),
        *_margins(summary),
        _needed(summary),
        *(summary.cycle.grids() if summary.cycle else ()),
        _inertias(summary),
        *(summary.vehicle.grids() if summary.vehicle else ()),
        *_sensitivities(summary),
    )
    yield from (grid for grid in tables if grid.rows)
    if summary.combinations is not None:
        yield other_combinations(summary)


def state(name: str) -> Cell:
    """Return the cell for the state of a gear; its value is the name of the state in data.

    >>> state("open").text, state("open").datum, state("tied up").text
    ('neutral', 'open', 'tied up')
    """
    return word(SHOWN_STATES.get(name, name))._replace(written_as=name)


def element_signs(results: Results, index: int, marks: Marks) -> Iterator[Cell]:
    """Yield a cell for each shift element: engaged, slipping, holding or disengaged."""
    gear = results.case.gears[index]
    for element, holds in enumerate(results.holds[index].tolist(), 1):
        if element in gear.joining:
            yield Cell(marks.engaged, 1.0, "engaged", "green", bool)
        elif element in gear.slipping:
            yield Cell(marks.slips, 1.0, "slips", "yellow", bool)
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
        (shift.start, shift.end, shift.skipped, word(shift.word), shift.released, shift.engaged)
        for shift in summary.transitions
    ]
    headings = "from", "to", "skips", "kind", "off-going", "oncoming"
    return grid_of("Transitions", headings, rows, key="transitions")


def _slip_powers(summary: Summary) -> Grid:
    shifts = [shift for shift in summary.transitions if not shift.skipped]
    loaded = any(math.isfinite(power) for shift in shifts for power in shift.slip_power_kW.values())
    rows = [
        (
            shift.start,
            shift.end,
            name,
            word("up" if name in shift.engaged else "down"),
            exact(power, 3),
        )
        for shift in shifts
        for name, power in (shift.slip_power_kW if loaded else shift.slip_power).items()
        if power > 0
    ]
    headings = "from", "to", "shift element", "shift", headed("power", "kW" if loaded else "")
    title = "Slip power of oncoming shift elements"
    return grid_of(title, headings, rows, key="slip power")


def _planets(summary: Summary, *, loaded: bool) -> Grid:
    shown = quantity(PLANETS, loaded=loaded)
    headings = "planet", headed("speed", shown.unit), "gear"
    lines = summary.largest.get(shown.name, ())
    devices = summary.results.case.own_devices
    planets = [planet for device in devices for planet in device.planets]
    without_teeth = {planet.name for planet in planets if math.isnan(planet.speed)}
    # Mechanisms without planets, such as gear pairs, have no planet speed, so their rows are
    # omitted.
    known = (line for line in lines if line.row in without_teeth or not math.isnan(line.value))
    rows = [[line.row, *_cells(shown, line)] for line in known]
    parts = ["Largest planet speeds relative to the carrier"]
    parts += [UNITS[shown.unit].text] if loaded else _relative(summary, [PLANETS])
    return grid_of(", ".join(parts), headings, rows, key="planets" + WITH_LOAD * loaded)


def _elements(summary: Summary, *, loaded: bool) -> Grid:
    """Return the table of largest slips and torques of shift elements."""
    named = {SLIPS: "slip", TORQUES: "torque", LOSSY_TORQUES: "with losses"}
    shown = [(quantity(key, loaded=loaded), name) for key, name in named.items()]
    shown = [(item, name) for item, name in shown if summary.largest.get(item.name)]
    headings = [heading for item, name in shown for heading in (headed(name, item.unit), "gear")]
    columns = [[(item, line) for line in summary.largest[item.name]] for item, _ in shown]
    rows = [
        [pairs[0][1].row, *(cell for pair in pairs for cell in _cells(*pair))]
        for pairs in zip(*columns, strict=True)
    ]
    units = dict.fromkeys(UNITS[item.unit].text for item, _ in shown if item.unit)
    relative = [] if loaded else _relative(summary, named)
    title = ", ".join(["Largest slip and torque of shift elements", *units, *relative])
    key = "shift elements" + WITH_LOAD * loaded
    return grid_of(title, ["shift element", *headings], rows, key=key)


def _relative(summary: Summary, names: Iterable[str]) -> list[str]:
    """Return a suffix for the title of a relative table, if there is also a table with units."""
    has_units = any(summary.largest.get(quantity(name, loaded=True).name) for name in names)
    return ["input = 1"] * has_units


def _cells(shown: Quantity, line: Largest) -> Row:
    return [exact(line.value, shown.decimals), line.gear]


def _sensitivities(summary: Summary) -> Iterator[Grid]:
    mechanisms = summary.results.case.mechanisms
    names = [mechanism.name for mechanism in mechanisms]
    title = "Sensitivity (u/i) di/du of the ratio to basic ratios"
    if any(mechanism.kind for mechanism in mechanisms):
        title = "Sensitivity (u/i) di/du to basic and speed ratios"
    by_name = zip(names, summary.sensitivities.T.tolist(), strict=True)
    yield _by_gear(summary, title, "sensitivity", "mechanism", by_name)
    title = "Sensitivity (n/ETA) dETA/dn of the efficiency ETA"
    by_name = zip(names, summary.efficiency_sensitivities.T.tolist(), strict=True)
    yield _by_gear(summary, title, "efficiency sensitivity", "mechanism", by_name)


def _by_gear(
    summary: Summary,
    title: str,
    key: str,
    heading: str,
    rows: Iterable[tuple[str, Sequence[float]]],
) -> Grid:
    gears = summary.results.case.gears
    columns = (Column(gear.name, over="gear") for gear in gears)
    return grid_of(title, (heading, *columns), ((name, *values) for name, values in rows), key=key)


def other_combinations(summary: Summary) -> Grid:
    """Return the table of combinations of shift elements that the case does not use."""
    others = summary.combinations or ()
    title = "Other combinations of shift elements"
    if not others:
        return Grid(f"{title}: none", (), (), key="combinations")
    rows = [
        (
            combination.ratio,
            combination.efficiency,
            combination.gear,
            combination.engaged,
            combination.holding,
        )
        for combination in others
    ]
    headings = "ratio", "efficiency", "same as", "engaged", "holding"
    return grid_of(title, headings, rows, key="combinations", optional=["holding"])


def _margins(summary: Summary) -> Iterator[Grid]:
    load = summary.results.case.load
    torque = None if load is None else load.torque_size
    unit, size = ("Nm", abs(torque)) if torque else ("", 1.0)
    decimals = UNITS[unit].decimals if unit else 3
    rows = [
        (margin.element, exact(margin.capacity * size, decimals), margin.least, margin.gear)
        for margin in summary.margins
    ]
    headings = "shift element", headed("torque capacity", unit), "least margin", "gear"
    yield grid_of("Least margin, torque capacity divided by torque", headings, rows, key="margins")
    by_element = [(margin.element, margin.by_gear) for margin in summary.margins]
    yield _by_gear(summary, "Margins by gear", "margins by gear", "shift element", by_element)


def _needed(summary: Summary) -> Grid:
    loaded = any(math.isfinite(element.capacity_Nm) for element in summary.needed)
    unit, decimals = ("Nm", UNITS["Nm"].decimals) if loaded else ("", 3)
    rows = [
        (
            element.element,
            exact(element.capacity_Nm if loaded else element.capacity, decimals),
            element.gear,
        )
        for element in summary.needed
    ]
    headings = "shift element", headed("torque capacity", unit), "gear"
    return grid_of(
        "Required torque capacity, with the reserve", headings, rows, key="needed capacity"
    )


def _inertias(summary: Summary) -> Grid:
    title = "Inertia at the input, acceleration of the input"
    headings = ["gear", INERTIA, ACCELERATION]
    return grid_of(title, headings, summary.inertias, key="inertia", optional=[ACCELERATION])
