"""The tables of a clutch that is dumped."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from vstatics.tables.grid import Column, Grid, Row, exact, text
from vstatics.torsion.dump import DumpCase, DumpTorque
from vstatics.torsion.dump_given import Dump

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


def grids(given: Dump, made: DumpTorque) -> Iterator[Grid]:
    """The largest torques, and what is to be known of them.

    Units are those of what is given: it may be in relative ones.
    """
    torques = {
        "largest torque": made.max_torque,
        "largest torque, simplified": made.max_torque_simplified,
        "at the input shaft": made.input_shaft_torque,
        "at the input shaft, simplified": made.input_shaft_torque_simplified,
        "the clutch breaks away at": given.clutch_limit,
        "the wheels break away at": given.grip_limit,
    }
    rows: list[Row] = [["case", made.case, ""]]
    rows += [[name, exact(torque), "as M_C0"] for name, torque in torques.items()]
    rows.append(["the clutch grabs below a speed of", exact(given.boundary_speed), "as omega1"])
    rows.append(["dynamic factor", exact(made.dynamic_factor), "-"])
    if made.engagement is not None:
        name = f"dynamic factor, engaged at a rate of {made.engagement.rate:g}"
        rows.append([name, exact(made.engagement.factor), "-"])
    title = f"Clutch dump: {HAPPENS[made.case]}"
    yield Grid(title, [text(""), Column("value"), text("unit")], rows, key="dump")
    if made.messages:
        yield Grid("Messages", [text("")], [[str(one)] for one in made.messages], key="messages")
