"""The tables of a clutch that is dumped."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from vstatics.core.tables.grid import Grid, Values, grid_of
from vstatics.torsion.clutch.dumped import DumpCase, DumpTorque

if TYPE_CHECKING:  # it needs scipy, which a file of numbers does not
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


def grids(made: DumpTorque) -> Iterator[Grid]:
    """The largest torques, and what is to be known of them.

    Units are those of what is given: it may be in relative ones.
    """
    torques = {
        "largest torque": made.max_torque,
        "largest torque, simplified": made.max_torque_simplified,
        "at the input shaft": made.input_shaft_torque,
        "at the input shaft, simplified": made.input_shaft_torque_simplified,
        "the clutch breaks away at": made.clutch_breaks_at,
        "the wheels break away at": made.tyres_break_at,
    }
    rows = [
        ("case", made.case, ""),
        *((name, torque, "as M_C0") for name, torque in torques.items()),
        ("the clutch grabs below a speed of", made.grabs_below, "as omega1"),
        ("dynamic factor", made.dynamic_factor, "-"),
        ("dynamic factor of the least", made.dynamic_factor_of_least, "-"),
        ("grip ratio", made.grip_ratio, "-"),
    ]
    if made.engagement is not None:
        name = f"dynamic factor, engaged at a rate of {made.engagement.rate:g}"
        rows.append((name, made.engagement.factor, "-"))
    yield grid_of(f"Clutch dump: {HAPPENS[made.case]}", ["", "value", "unit"], rows, key="dump")
    if made.messages:
        yield grid_of("Messages", [""], ([str(one)] for one in made.messages), key="messages")


_UNITS = {
    **dict.fromkeys(("J1", "J2", "J3", "J4", "J5"), "kg*m^2"),
    "E": "rad/(N*m)",
    "M_C0": "N*m",
    "M_phi": "N*m",
    "omega1": "rad/s",
}


_TORQUES = {
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
    """As `grids`, then what was reduced; of a gear that failed, why."""
    if gear.made is not None:
        yield from grids(gear.made)
    yield from _reduced([gear])
    yield from _failed([gear])


def gears_grids(gears: Sequence[GearDump]) -> Iterator[Grid]:
    """The largest torques by gears, what was reduced, what is to be known.

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
    made = [(gear.name, gear.made) for gear in gears if gear.made is not None]
    rows: list[Values] = [("case", *(one.case for _, one in made))]
    rows += [(told, *(getattr(one, name) for _, one in made)) for name, told in _TORQUES.items()]
    if any(one.engagement for _, one in made):
        factors = [one.engagement.factor if one.engagement else None for _, one in made]
        rows.append(("dynamic factor, engaged at the rate", *factors))
    names = (name for name, _ in made)
    yield grid_of(f"Clutch dump, on {gears[0].to}", ["gear", *names], rows, key="dump")
    yield from _reduced(gears)
    messages = [(name, str(message)) for name, one in made for message in one.messages]
    if messages:
        yield grid_of("Messages", ["gear", ""], messages, key="messages")
    yield from _failed(gears)


def _reduced(gears: Sequence[GearDump]) -> Iterator[Grid]:
    """What was reduced, a column for each gear."""
    given = [(gear.name, gear.given) for gear in gears if gear.given is not None]
    if given:
        rows = (
            (f"{name} [{unit}]", *(getattr(one, name) for _, one in given))
            for name, unit in _UNITS.items()
        )
        headings = ["gear", *(name for name, _ in given)]
        yield grid_of(f"Reduced to {gears[0].to}", headings, rows, key="reduced")


def _failed(gears: Sequence[GearDump]) -> Iterator[Grid]:
    failed = [(gear.name, gear.error) for gear in gears if gear.error]
    if failed:
        yield grid_of("No such torque", ["gear", "why"], failed, key="errors")
