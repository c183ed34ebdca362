"""The ports of gears as a table: speed, torque and power of each link with power from outside."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.physical import gear_scales
from vstatics.core.statics.ports import GearPorts, Port, ports
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import GearState
from vstatics.core.tables.answer import Sometimes, told
from vstatics.core.tables.grid import Cell, Grid, exact, grid_of, word
from vstatics.core.tables.quantities import UNITS, headed

MEASURES = (("speed", "rpm"), ("torque", "Nm"), ("power", "kW"))
"""What is told of a port, and its unit with a load."""


class NamedPort(NamedTuple):
    """A port of a gear; with a load also in its units."""

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
    """What is lost in meshes, variators, converters and drag, where there are such, and in all."""

    in_: str
    power: float
    power_kW: Sometimes[float] = None  # noqa: N815


@told("gear", "ports", "lost")
class PortTable(NamedTuple):
    """The ports of a gear with their names, and what makes relative numbers physical ones."""

    gear: str
    rows: Sequence[tuple[str, Port]]
    """Names of the links with their ports."""
    losses: Sequence[tuple[str, float]]
    """What power is lost in: as `LostPower` has it. [-]"""
    scales: dict[str, float]
    """Its own of `gear_scales`."""
    input_torque: float
    """What relative torques are relative to: 1, or 0 where the load gives none."""

    @property
    def ports(self) -> list[NamedPort]:
        """The ports, as they are answered."""
        return [
            NamedPort(
                name,
                *(port.way or None, port.is_output, port.speed),
                *map(self.relative, (port.torque, port.power)),
                *self._with_units((port.speed, port.torque, port.power)),
            )
            for name, port in self.rows
        ]

    @property
    def lost(self) -> list[LostPower]:
        """The losses, as they are answered."""
        return [
            LostPower(name, self.relative(lost), self._with_units((0, 0, lost))[-1])
            for name, lost in self.losses
        ]

    def relative(self, number: float) -> float:
        """A torque or power relative to the input's [-]; NaN beside none."""
        return number if self.input_torque else math.nan

    def _with_units(self, values: Sequence[float]) -> list[float | None]:
        """Numbers of `MEASURES` in their units; None where no load tells them."""
        pairs = zip(values, [self.scales[unit] for _, unit in MEASURES], strict=True)
        return [None if math.isnan(scale) else value * scale for value, scale in pairs]


def port_tables(results: Results) -> list[PortTable]:
    """The ports of each gear of one case."""
    by_gear = gear_scales(results.case)
    return [port_table(results.gear_at(n), own) for n, own in enumerate(by_gear)]


def port_table(state: GearState, by_unit: dict[str, float]) -> PortTable:
    """The ports of a gear, with its own of `gear_scales`."""
    case, found = state.case, ports(state)
    rows = [(case.link_name(port.link), port) for port in found.ports]
    losses, name = list(_losses(case, found)), state.gear.name
    return PortTable(name, rows, losses, by_unit, case.input_torque(state.gear))


def _losses(case: Transmission, of_gear: GearPorts) -> Iterator[tuple[str, float]]:
    """By what it is lost in; then all together, if that is more than one."""
    lost = {f"{kind}s": loss for kind, loss in of_gear.by_kind.items()}
    if not all(one.kind for one in case.mechanisms) or not lost:
        lost = {"meshes": of_gear.meshes, **lost}
    if case.has_drag:
        lost["drag"] = of_gear.drag
    yield from lost.items()
    if len(lost) > 1:
        together = "meshes and drag" if lost.keys() == {"meshes", "drag"} else "all together"
        yield together, math.fsum(lost.values())


def ports_grid(gears: Sequence[PortTable], *, named: bool = True) -> Grid:
    """The ports of some gears, and what each loses.

    Parameters
    ----------
    named : bool, optional
        Whether a column has the names of the gears; without it the table is of one gear.

    Returns
    -------
    Grid
        In rpm, N*m and kW where all these gears have a load, else relative to the input [-].

    Examples
    --------
    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98)
    >>> case = Transmission(2, [], [pair], [Gear()], load=Load(speed=2000, torque=100))
    >>> grid = ports_grid(port_tables(solve(case)), named=False)
    >>> [column.heading for column in grid.columns]
    ['port', 'speed, rpm', 'torque, N*m', 'power, kW', 'way']
    >>> grid.texts
    [['1', '2000.0', '100.0', '20.944', 'in'], ['2', '-500.0', '-392.0', '20.525', 'out'], \
['lost: meshes', '', '', '.419', '']]
    """
    physical = {
        unit for _, unit in MEASURES if not any(math.isnan(one.scales[unit]) for one in gears)
    }
    measures = (headed(name, unit if unit in physical else "") for name, unit in MEASURES)
    headings = [*["gear"] * named, "port", *measures, "way"]
    rows = ([*[gear.gear] * named, *row] for gear in gears for row in _rows(gear, physical))
    return grid_of("Ports", headings, rows, key="ports")


def _rows(gear: PortTable, physical: set[str]) -> Iterator[list[Cell | str]]:
    def cell(value: float, what: str, unit: str) -> Cell:
        scale, decimals = 1.0 if unit == "rpm" else gear.relative(1.0), 3
        if unit in physical:
            scale, decimals = gear.scales[unit], UNITS[unit].decimals
        largest = max(abs(getattr(port, what) * scale) for _, port in gear.rows)
        return exact(value * scale, decimals, beside=largest)

    for name, port in gear.rows:
        numbers = (cell(getattr(port, what), what, unit) for what, unit in MEASURES)
        yield [name, *numbers, word(port.way)]
    for name, lost in gear.losses:
        yield [word(f"lost: {name}"), "", "", cell(lost, "power", "kW"), ""]
