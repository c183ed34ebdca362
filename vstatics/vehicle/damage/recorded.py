"""A record of torques in CSV -> what it does to the devices of a case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.errors import Problem, ReadError, quoted
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.records import RecordedColumns, read_record
from vstatics.core.tables.names import written
from vstatics.vehicle.damage.devices import DeviceDamage, damages


class RecordedDamage(NamedTuple):
    """What a record does, and what is doubtful about it."""

    damage: Mapping[str, DeviceDamage]
    warnings: list[Problem]


def recorded_damage(case: Transmission, data: bytes, file: str) -> RecordedDamage:
    """What a record does to the devices that have a fatigue strength.

    Parameters
    ----------
    case : Transmission
    data : bytes
        CSV with columns `torques[DEVICE]`, names in quotes as of `vstatics simulate`, or as they
        are.
    file : str
        Its name, for messages.

    Raises
    ------
    ReadError
        If it has no such column, or none that changes, or a cell is no number.
    """
    names = case.devices
    headings = {name: f"torques[{written(names.index(name), names)}]" for name in case.fatigue}
    plain = {name: f"torques[{name}]" for name in case.fatigue}
    wanted = [*headings.values(), *plain.values()]
    record = read_record(data, file, dict.fromkeys(wanted, "si_torque"))
    both = [(name, way[name]) for name in case.fatigue for way in (plain, headings)]
    found = {name: head for name, head in both if head in record.columns}
    torques = {name: record.columns[head] for name, head in found.items()}
    problems = list(_lacking(record, headings, found))
    made = damages(case, torques)
    if not any(one.cycles for one in made.values()):
        raise ReadError(problems or [record.problem("E884", _EVEN)])
    for name, one in made.items():
        if not math.isfinite(one.damage):
            message = f"torques of {quoted(name)} are so large that there is no damage"
            raise ReadError([record.problem("E885", message)])
    return RecordedDamage(made, problems)


_EVEN = "no torque of a device with `fatigue` changes, expected a record with extremes"


def _lacking(
    record: RecordedColumns, wanted: Mapping[str, str], found: Mapping[str, str]
) -> Iterator[Problem]:
    """What is missing: an error where there is nothing at all."""
    for name, heading in wanted.items():
        if name not in found:
            yield record.lacks("W880" if found else "E883", heading)
