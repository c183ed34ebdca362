"""Damage of components of a case under a CSV record of their torques."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.core.errors import Problem, ReadError, quoted
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.records import read_record
from vstatics.core.tables.names import written
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.devices import DeviceDamage, damages


class RecordedDamage(NamedTuple):
    """Damage of components under a record, by name, with warnings."""

    damage: Mapping[str, DeviceDamage]
    warnings: list[Problem]


def recorded_damage(case: Transmission, data: bytes, file: str) -> RecordedDamage:
    """Calculate the damage of components with a fatigue strength under a record of torques.

    Parameters
    ----------
    case : Transmission
    data : bytes
        CSV with columns `torques[COMPONENT]`; names are without quotes, or in quotes as `vstatics
        simulate` writes them.
    file : str
        Name of the file, for messages.

    Raises
    ------
    ReadError
        If no such column exists, if no torque changes, if a cell is not a number, or if a damage
        overflows.
    """
    names, strengths = case.devices, Fatigue.of(case)
    headings = {name: f"torques[{written(names.index(name), names)}]" for name in strengths}
    plain = {name: f"torques[{name}]" for name in strengths}
    wanted = [*headings.values(), *plain.values()]
    record = read_record(data, file, dict.fromkeys(wanted, "si_torque"))
    both = [(name, way[name]) for name in strengths for way in (plain, headings)]
    present = {name: head for name, head in both if head in record.columns}
    torques = {name: record.columns[head] for name, head in present.items()}
    # a missing column is an error only if all are missing
    id_ = "W880" if present else "E883"
    problems = [record.lacks(id_, headings[name]) for name in headings if name not in present]
    damage = damages(case, torques)
    if not any(result.cycles for result in damage.values()):
        raise ReadError(problems or [record.problem("E884", _EVEN)])
    for name, result in damage.items():
        if not math.isfinite(result.damage):
            message = f"torques of {quoted(name)} are too large for a damage; check their unit"
            raise ReadError([record.problem("E885", message)])
    return RecordedDamage(damage, problems)


_EVEN = "no torque of a component with `fatigue` changes, expected a torque that varies"
