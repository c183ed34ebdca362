"""Tables of clutch dumps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from vstatics.core.tables.grid import Grid, Values, grid_of
from vstatics.torsion.clutch.dumped import DumpCase, DumpTorque

if TYPE_CHECKING:  # a file of numbers needs no scipy, but gear_dump does
    from vstatics.torsion.clutch.gear_dump import GearDump

HAPPENS: Mapping[DumpCase, str] = {
    "A1": "the clutch slips, the wheels are clamped",
    "A2": "the clutch slips, the tyres grip",
    "A3": "the clutch slips, the wheels break away",
    "B1": "the clutch grabs, the wheels are clamped",
    "B2": "the clutch grabs, the tyres grip",
    "B3": "the clutch grabs, the wheels break away",
    "V1": "the clutch grabs and breaks away, the tyres grip",
    "V2": "the clutch grabs and breaks away, then the wheels",
    "V3": "the clutch grabs, the wheels break away, then the clutch",
}
"""Course of events in each case of a dump, as the title of a table."""


def grids(result: DumpTorque) -> Iterator[Grid]:
    """Yield a table of the largest torques, and a table of messages if any.

    Torques and speeds are in the units of `M_C0` and `omega1`, which can be relative units.
    """
    torques = {
        "largest torque": result.max_torque,
        "largest torque, simplified": result.max_torque_simplified,
        "at the input shaft": result.input_shaft_torque,
        "at the input shaft, simplified": result.input_shaft_torque_simplified,
        "the clutch breaks away at": result.clutch_breaks_at,
        "the wheels break away at": result.tyres_break_at,
    }
    rows = [
        ("case", result.case, ""),
        *((name, torque, "as M_C0") for name, torque in torques.items()),
        ("the clutch grabs below a speed of", result.grabs_below, "as omega1"),
        ("dynamic factor", result.dynamic_factor, "-"),
        ("dynamic factor of the least", result.dynamic_factor_of_least, "-"),
        ("grip ratio", result.grip_ratio, "-"),
    ]
    if result.engagement is not None:
        name = f"dynamic factor, engaged at a rate of {result.engagement.rate:g}"
        rows.append((name, result.engagement.factor, "-"))
    yield grid_of(f"Clutch dump: {HAPPENS[result.case]}", ["", "value", "unit"], rows, key="dump")
    if result.messages:
        messages = ([str(message)] for message in result.messages)
        yield grid_of("Messages", [""], messages, key="messages")


_UNITS_OF_GIVEN = {
    **dict.fromkeys(("J1", "J2", "J3", "J4", "J5"), "kg*m^2"),
    "E": "rad/(N*m)",
    "M_C0": "N*m",
    "M_phi": "N*m",
    "omega1": "rad/s",
}

_LABELS = {
    "max_torque": "largest torque [N*m]",
    "max_torque_simplified": "largest torque, simplified [N*m]",
    "input_shaft_torque": "at the input shaft [N*m]",
    "input_shaft_torque_simplified": "at the input shaft, simplified [N*m]",
    "clutch_breaks_at": "the clutch breaks away at [N*m]",
    "tyres_break_at": "the wheels break away at [N*m]",
    "grabs_below": "the clutch grabs below a speed of [rad/s]",
    "dynamic_factor": "dynamic factor",
    "dynamic_factor_of_least": "dynamic factor of the least",
    "grip_ratio": "grip ratio",
}


def gear_grids(gear: GearDump) -> Iterator[Grid]:
    """Yield the tables of `grids` and of reduced values, or the reason why they are missing."""
    if gear.made is not None:
        yield from grids(gear.made)
    yield from _reduced([gear])
    yield from _failed([gear])


def gears_grids(gears: Sequence[GearDump]) -> Iterator[Grid]:
    """Yield tables of largest torques, reduced values and messages, with a column for each gear.

    Examples
    --------
    >>> from vstatics.torsion.clutch.dumped import dump
    >>> from vstatics.torsion.clutch.gear_dump import GearDump
    >>> from vstatics.torsion.clutch.given import Dump
    >>> given = Dump(1.913, 0.0619, 0.0239, 0.091, 5.68, 429e-5, 532, 335, 156)
    >>> for grid in gears_grids([GearDump("1", "propshaft", given, dump(given))]):
    ...     print(grid.title, grid.texts[0][:2])
    Clutch dump, on propshaft ['case', 'A3']
    Reduced to propshaft ['J1 [kg*m^2]', '1.913']
    """
    results = [(gear.name, gear.made) for gear in gears if gear.made is not None]
    rows: list[Values] = [("case", *(torque.case for _, torque in results))]
    rows += [
        (label, *(getattr(torque, name) for _, torque in results))
        for name, label in _LABELS.items()
    ]
    if any(torque.engagement for _, torque in results):
        engagements = [torque.engagement for _, torque in results]
        factors = [engagement.factor if engagement else None for engagement in engagements]
        rows.append(("dynamic factor, engaged at the rate", *factors))
    names = (name for name, _ in results)
    yield grid_of(f"Clutch dump, on {gears[0].to}", ["gear", *names], rows, key="dump")
    yield from _reduced(gears)
    messages = [(name, str(message)) for name, torque in results for message in torque.messages]
    if messages:
        yield grid_of("Messages", ["gear", ""], messages, key="messages")
    yield from _failed(gears)


def _reduced(gears: Sequence[GearDump]) -> Iterator[Grid]:
    given = [(gear.name, gear.given) for gear in gears if gear.given is not None]
    if given:
        rows = (
            (f"{name} [{unit}]", *(getattr(dump, name) for _, dump in given))
            for name, unit in _UNITS_OF_GIVEN.items()
        )
        yield grid_of(
            f"Reduced to {gears[0].to}", ["gear", *(name for name, _ in given)], rows, key="reduced"
        )


def _failed(gears: Sequence[GearDump]) -> Iterator[Grid]:
    failed = [(gear.name, gear.error) for gear in gears if gear.error]
    if failed:
        yield grid_of("No such torque", ["gear", "why"], failed, key="errors")
