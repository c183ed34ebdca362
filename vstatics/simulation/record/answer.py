"""JSON document of `vstatics simulate`: the results of a run."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple, TypeAlias

from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import Flat, Provided, Sometimes, document
from vstatics.simulation.record.motion import Energy, Event, Motion, Peak, Reached

Rows: TypeAlias = Sometimes[Mapping[str, Floats]]
"""Table of a run: values over time, by name of the row. Absent unless requested."""


class AskedAnswer(NamedTuple):
    """Requested additional tables of a run, by name."""

    accelerations: Rows = None
    jerks: Rows = None
    powers: Rows = None
    heat: Rows = None
    slip_power: Rows = None
    heat_per_area: Rows = None
    slip_power_per_area: Rows = None
    temperatures: Rows = None
    states: Rows = None
    vehicle_speed: Rows = None
    vehicle_acceleration: Rows = None
    vehicle_jerk: Rows = None
    ratio: Rows = None
    efficiency: Rows = None
    reduced_inertia: Sometimes[Sequence[float]] = None


@document("vstatics-simulation")
class MotionAnswer(NamedTuple):
    """Times, columns, events, energies and largest torques of a run."""

    case: str
    time: Floats
    speeds: Mapping[str, Floats]
    slips: Mapping[str, Floats]
    torques: Mapping[str, Floats]
    asked: Flat[AskedAnswer]
    events: Sequence[Event]
    energy: Energy
    peaks: Mapping[str, Peak]
    dynamic_factors: Sometimes[Mapping[str, float | None]]
    """Largest torques divided by static torques, if the scenario has `static`."""
    damage: Sometimes[Annotated[object, Provided("Damages")]]
    """Fatigue damage by component name, if requested."""
    targets: Sometimes[Sequence[Reached]]
    """Time and distance at target speeds, if the scenario has `targets`."""
    messages: Sequence[Message]
    stopped: str | None


def motion_answer(
    motion: Motion, case: str, *, targets: bool = False, damage: bool = False
) -> MotionAnswer:
    """Return the JSON document of a motion.

    Parameters
    ----------
    motion : Motion
    case : str
        Name of the case.
    targets : bool
        Include the target speeds.
    damage : bool
        Include the fatigue damage of components.
    """
    # A table of a single quantity has one row, whose name is empty.
    asked: dict[str, Any] = {
        table: rows[""].tolist() if "" in rows else rows for table, rows in motion.asked.items()
    }
    return MotionAnswer(
        case,
        motion.time,
        dict(zip(motion.links, motion.speeds.T, strict=True)),
        dict(zip(motion.elements, motion.slips.T, strict=True)),
        dict(zip(motion.devices, motion.torques.T, strict=True)),
        AskedAnswer(**asked),
        motion.events,
        motion.energy,
        motion.peaks,
        motion.dynamic_factors or None,
        motion.damage if damage else None,
        motion.reached if targets else None,
        motion.messages,
        motion.stopped.told if motion.stopped else None,
    )


def lay_out(document: Mapping[str, Any]) -> str:
    """Return a document as JSON, with each list of numbers on its own line.

    >>> print(lay_out({"time": [0.0, 1.0], "speeds": {"in": [3.0, None]}, "events": []}))
    {
     "time": [0.0, 1.0],
     "speeds": {
      "in": [3.0, null]
     },
     "events": []
    }
    """
    encoder = json.JSONEncoder(ensure_ascii=False, allow_nan=False)
    return _laid_out(document, encoder.encode, "\n")


def _laid_out(value: Any, encode: Callable[[Any], str], end: str) -> str:
    """Return JSON text in which mappings, and lists of mappings, extend over several lines."""
    inner = end + " "
    if isinstance(value, Mapping) and value:
        items = (f"{encode(key)}: {_laid_out(item, encode, inner)}" for key, item in value.items())
        return "{" + inner + f",{inner}".join(items) + end + "}"
    if isinstance(value, list) and value and isinstance(value[0], Mapping):
        return "[" + inner + f",{inner}".join(map(encode, value)) + end + "]"
    return encode(value)
