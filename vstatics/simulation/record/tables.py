"""Tables of a simulation: events, energies, largest torques, and times of target speeds.

Components without heat, loss or torque are left out; the JSON document contains all components.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator

from vstatics.core.tables.grid import Cell, Column, Grid, Row, exact, grid_of, text, word
from vstatics.core.texts import tr
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.tolerances import CLOSED_BALANCE, PRINTED


def motion_grids(motion: Motion) -> Iterator[Grid]:
    """Yield the table of events, then all other tables that are not empty."""
    if motion.stopped is not None:
        why = [[motion.stopped.told]]
        yield grid_of("Stopped before its end", ["why"], why, key="stopped")
    yield _events(motion)
    yield _energy(motion)
    torques = _of_kind(peak.torque for peak in motion.peaks.values())
    rows = [
        (name, torques(peak.torque), exact(peak.time, digits=6), motion.dynamic_factors.get(name))
        for name, peak in motion.peaks.items()
        if _is_printed(torques(peak.torque))
    ]
    if rows:
        yield grid_of(
            "Largest torques",
            ["component", "torque [N*m]", "time [s]", "dynamic factor"],
            rows,
            key="peaks",
            optional=["dynamic factor"],
        )
    if motion.reached:
        targets = (
            (
                reached.link,
                reached.speed,
                exact(reached.time, digits=6),
                reached.angle,
                reached.distance,
            )
            for reached in motion.reached
        )
        headings = "link", "speed [rad/s]", "time [s]", "angle [rad]", "distance [m]"
        optional = ["distance [m]"]
        yield grid_of("Speeds reached", headings, targets, key="targets", optional=optional)


def _of_kind(numbers: Iterable[float]) -> Callable[[float | None], Cell]:
    """Return a cell writer that prints 0 for numbers negligible relative to the largest."""
    least = PRINTED * max((abs(number) for number in numbers if math.isfinite(number)), default=0.0)

    def shown(value: float | None) -> Cell:
        if value is not None and abs(value) < least:
            return exact(0.0)._replace(value=value)
        return exact(value)

    return shown


def _is_printed(cell: Cell) -> bool:
    """Return whether a number has a digit other than 0; rounding noise is printed as 0."""
    return bool(cell.text.strip("0."))


def _energies(motion: Motion) -> Callable[[float | None], Cell]:
    energy = motion.energy
    parts = (*energy.heat.values(), *energy.losses.values())
    return _of_kind((energy.work, energy.kinetic, energy.elastic, energy.impact, *parts))


def _events(motion: Motion) -> Grid:
    with_energy = any(event.event == "impact" for event in motion.events)
    rows: list[Row] = []
    shown = _energies(motion)
    for event in motion.events:
        event_cell = word(event.word or event.event)
        if event.step:
            event_cell = Cell(tr("step {number}", number=event.step))
        cells: Row = [exact(event.time, digits=9), event.element, event_cell]
        cells.append(shown(event.energy if event.event == "impact" else None))
        rows.append(cells[: 3 + with_energy])
    columns = [Column("time [s]"), text("shift element"), text("event"), Column("energy [J]")]
    title = "Events" if rows else "Events: none"
    return Grid(title, columns[: 3 + with_energy], rows, key="events")


def _energy(motion: Motion) -> Grid:
    """Return the table of the energy balance; the items of heat and losses follow their sums."""
    energy = motion.energy
    per_area = energy.heat_per_area
    rows: list[Row] = []
    levels: list[int] = []
    shown, shown_by_area = _energies(motion), _of_kind(per_area.values())

    def add(name: str, value: float, level: int = 1) -> None:
        cells: Row = [word(name) if level == 1 else name, shown(value)]
        if per_area:
            cells.append(shown_by_area(per_area.get(name) if level > 1 else None))
        rows.append(cells)
        levels.append(level)

    add("work", energy.work)
    for name, parts in (("heat", energy.heat), ("losses", energy.losses)):
        add(name, sum(parts.values()))
        for part, value in parts.items():
            if _is_printed(shown(value)):
                add(part, value, 2)
    for name in ("kinetic", "elastic", "impact"):
        add(name, getattr(energy, name))
    add("balance", energy.balance)
    if abs(energy.balance) < CLOSED_BALANCE:  # the balance is rounding noise
        rows[-1][1] = exact(0.0)._replace(value=energy.balance)
    columns = [text(""), Column("energy [J]")] + [Column("per area [J/m^2]")] * bool(per_area)
    return Grid("Energy", columns, rows, levels, key="energy")
