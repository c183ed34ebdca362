"""The course of a simulation as tables: events, energy, peaks, speeds that are reached.

Devices without heat, loss or torque are left out, as JSON has them all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from vstatics.simulation.record.motion import Motion
from vstatics.simulation.tolerances import CLOSED_BALANCE
from vstatics.tables.grid import Column, Grid, Row, exact, grid_of, text


def motion_grids(motion: Motion) -> Iterator[Grid]:
    """All tables that have something to say."""
    if motion.stopped is not None:
        why = [[motion.stopped.message]]
        yield grid_of("Stopped before its end", ["why"], why, key="stopped")
    yield _events(motion)
    yield _energy(motion)
    rows = [
        (name, peak.torque, exact(peak.time, digits=6))
        for name, peak in motion.peaks.items()
        if peak.torque
    ]
    if rows:
        yield grid_of("Largest torques", ["device", "torque [N*m]", "time [s]"], rows, key="peaks")
    if motion.reached:
        yield _targets(motion)


def _events(motion: Motion) -> Grid:
    with_energy = any(event.event == "impact" for event in motion.events)
    rows: list[Row] = []
    for event in motion.events:
        cells: Row = [exact(event.time, digits=9), event.element, event.event]
        cells.append(exact(event.energy if event.event == "impact" else None))
        rows.append(cells[: 3 + with_energy])
    columns = [Column("time [s]"), text("element"), text("event"), Column("energy [J]")]
    title = "Events" if rows else "Events: none"
    return Grid(title, columns[: 3 + with_energy], rows, key="events")


def _energy(motion: Motion) -> Grid:
    """Where the work went; parts of a sum below it."""
    energy = motion.energy
    per_area = energy.heat_per_area
    rows: list[Row] = []
    levels: list[int] = []

    def add(name: str, value: float, level: int = 1) -> None:
        cells: Row = [name, exact(value)]
        if per_area:
            cells.append(exact(per_area.get(name) if level > 1 else None))
        rows.append(cells)
        levels.append(level)

    def add_parts(name: str, parts: Mapping[str, float]) -> None:
        add(name, sum(parts.values()))
        for part, value in parts.items():
            if value:
                add(part, value, 2)

    add("work", energy.work)
    add_parts("heat", energy.heat)
    add_parts("losses", energy.losses)
    for name in ("kinetic", "elastic", "impact"):
        add(name, getattr(energy, name))
    add("balance", energy.balance)
    if abs(energy.balance) < CLOSED_BALANCE:  # of which no digit is certain
        rows[-1][1] = exact(0.0)._replace(value=energy.balance)
    columns = [text(""), Column("energy [J]")] + [Column("per area [J/m^2]")] * bool(per_area)
    return Grid("Energy", columns, rows, levels, key="energy")


def _targets(motion: Motion) -> Grid:
    rows = (
        (one.link, one.speed, exact(one.time, digits=6), one.angle, one.distance)
        for one in motion.reached
    )
    road = "distance [m]"
    headings = "link", "speed [rad/s]", "time [s]", "angle [rad]", road
    return grid_of("Speeds reached", headings, rows, key="targets", optional=[road])
