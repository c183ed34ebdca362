"""Table of the ports of gears: speed, torque and power of links with an external torque."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.statics.physical import gear_scales
from vstatics.core.statics.ports import Port, ports
from vstatics.core.statics.power import loss_name, slip_name
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import GearState
from vstatics.core.tables.answer import Sometimes, json_keys
from vstatics.core.tables.grid import Cell, Grid, exact, grid_of, word
from vstatics.core.tables.quantities import UNITS, headed

MEASURES = (("speed", "rpm"), ("torque", "Nm"), ("power", "kW"))
"""Quantities of a port, and their physical units."""


class NamedPort(NamedTuple):
    """Port of a gear, with quantities in physical units if there is an operating point."""

    link: str
    way: str | None
    output: bool
    speed: float
    torque: float
    power: float
    speed_rpm: Sometimes[float] = None
    torque_Nm: Sometimes[float] = None  # noqa: N815
    power_kW: Sometimes[float] = None  # noqa: N815


class LostPower(NamedTuple):
    """Power lost in meshes, variators or converters, by drag or slip, in a gear, or in total."""

    in_: str
    power: float
    power_kW: Sometimes[float] = None  # noqa: N815


@json_keys("gear", "ports", "lost")
class PortTable(NamedTuple):
    """Ports and losses of a gear, with names and the factors to physical units."""

    gear: str
    rows: Sequence[tuple[str, Port]]
    """Name of the link, and port."""
    losses: Sequence[tuple[str, float]]
    """Name of each loss, as in `LostPower`, and its relative power. [-]"""
    scales: dict[str, float]
    """Factors to physical units by unit, from `gear_scales`."""
    input_torque: float
    """Relative input torque: 1, or 0 if the input torque is 0. [-]"""

    @property
    def ports(self) -> list[NamedPort]:
        """Ports as records for output."""
        return [
            NamedPort(
                name,
                port.way or None,
                port.is_output,
                port.speed,
                self.relative(port.torque),
                self.relative(port.power),
                *self._with_units((port.speed, port.torque, port.power)),
            )
            for name, port in self.rows
        ]

    @property
    def lost(self) -> list[LostPower]:
        """Losses as records for output."""
        return [
            LostPower(name, self.relative(lost), self._with_units((0, 0, lost))[-1])
            for name, lost in self.losses
        ]

    @property
    def has_more_than_ratios(self) -> bool:
        """True unless ratio and efficiency determine all numbers.

        Ratio and efficiency suffice without an operating point, further ports and several losses.
        """
        known = not all(map(math.isnan, self.scales.values()))
        return known or len(self.rows) > 2 or len(self.losses) > 1

    def relative(self, number: float) -> float:
        """Return a relative torque or power [-]; NaN if the input torque is 0."""
        return number if self.input_torque else math.nan

    def _with_units(self, values: Sequence[float]) -> list[float | None]:
        """Return the quantities of `MEASURES` in physical units; None if unknown."""
        pairs = zip(values, [self.scales[unit] for _, unit in MEASURES], strict=True)
        return [None if math.isnan(scale) else value * scale for value, scale in pairs]


def port_tables(results: Results) -> list[PortTable]:
    """Return the ports of all gears of a case."""
    by_gear = gear_scales(results.case)
    return [port_table(results.gear_at(n), scales) for n, scales in enumerate(by_gear)]


def port_table(state: GearState, by_unit: dict[str, float]) -> PortTable:
    """Return the ports of a gear; `by_unit` are its factors from `gear_scales`."""
    case, of_gear = state.case, ports(state)
    rows = [(case.link_name(port.link), port) for port in of_gear.ports]
    losses = {f"{kind}s": loss for kind, loss in of_gear.by_kind.items()}
    if not all(mechanism.kind for mechanism in case.mechanisms) or not losses:
        losses = {"meshes": of_gear.meshes, **losses}
    if case.has_drag:
        losses["drag"] = of_gear.drag
    losses |= {slip_name(case.shift_elements[n - 1]): lost for n, lost in of_gear.slips.items()}
    if state.gear.loss_torques:
        losses[loss_name(state.gear)] = of_gear.gear
    if len(losses) > 1:
        total = "meshes and drag" if losses.keys() == {"meshes", "drag"} else "all together"
        losses[total] = math.fsum(losses.values())
    return PortTable(
        state.gear.name, rows, [*losses.items()], by_unit, case.input_torque(state.gear)
    )


def ports_grid(gears: Sequence[PortTable], *, named: bool = True) -> Grid:
    """Return the table of the ports and losses of gears.

    Parameters
    ----------
    gears : sequence of PortTable
    named : bool, optional
        True if the first column contains the names of the gears.

    Returns
    -------
    Grid
        Values in rpm, N*m and kW if all gears have an operating point, else relative to the
        input [-].

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98)
    >>> case = Transmission(2, [], [pair], [Gear()], load=Load(speed=2000, torque=100))
    >>> grid = ports_grid(port_tables(solve(case)), named=False)
    >>> [column.heading for column in grid.columns]
    ['port', 'speed, rpm', 'torque, N*m', 'power, kW', 'direction']
    >>> grid.texts
    [['1', '2000.0', '100.0', '20.944', 'in'], ['2', '-500.0', '-392.0', '20.525', 'out'], \
['lost: meshes', '', '', '0.419', '']]
    """
    physical = {
        unit for _, unit in MEASURES if not any(math.isnan(gear.scales[unit]) for gear in gears)
    }
    measures = (headed(name, unit if unit in physical else "") for name, unit in MEASURES)
    headings = [*["gear"] * named, "port", *measures, "direction"]
    rows = ([*[gear.gear] * named, *row] for gear in gears for row in _rows(gear, physical))
    return grid_of("Ports", headings, rows, key="ports")


def _rows(gear: PortTable, physical: set[str]) -> Iterator[list[Cell | str]]:
    def cell(value: float, what: str, unit: str) -> Cell:
        scale, decimals = 1.0 if unit == "rpm" else gear.relative(1.0), 3
        if unit in physical:
            scale, decimals = gear.scales[unit], UNITS[unit].decimals
        largest = max(abs(getattr(port, what) * scale) for _, port in gear.rows)
        return exact(value * scale, decimals, largest=largest)

    for name, port in gear.rows:
        numbers = (cell(getattr(port, what), what, unit) for what, unit in MEASURES)
        yield [name, *numbers, word(port.way)]
    for name, lost in gear.losses:
        yield [word(f"lost: {name}"), "", "", cell(lost, "power", "kW"), ""]
