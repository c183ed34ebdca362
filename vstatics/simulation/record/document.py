"""The course of a simulation as plain data for JSON."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from vstatics.numerics.arrays import Floats
from vstatics.simulation.record.motion import Motion

FORMAT = "vstatics-simulation"
VERSION = 1


def motion_document(motion: Motion, case: str, *, targets: bool = False) -> dict[str, Any]:
    """Times, speeds, slips, torques, events, energy, peaks.

    Parameters
    ----------
    motion : Motion
    case : str
        Its name.
    targets : bool
        Whether speeds were asked for that links reach.
    """
    energy = motion.energy._asdict()
    if not motion.energy.heat_per_area:
        del energy["heat_per_area"]
    return {
        "format": FORMAT,
        "version": VERSION,
        "case": case,
        "time": motion.time.tolist(),
        "speeds": _by_name(motion.links, motion.speeds),
        "slips": _by_name(motion.elements, motion.slips),
        "torques": _by_name(motion.devices, motion.torques),
        "events": [event._asdict() for event in motion.events],
        "energy": energy,
        "peaks": {name: peak._asdict() for name, peak in motion.peaks.items()},
        **({"targets": [one._asdict() for one in motion.reached]} if targets else {}),
        "messages": [str(message) for message in motion.messages],
        "stopped": motion.stopped.message if motion.stopped else None,
    }


def lay_out(document: Mapping[str, Any]) -> str:
    """JSON with a line for each list of numbers.

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
    """Mappings on several lines, as are lists of them; anything else on one."""
    inner = end + " "
    if isinstance(value, Mapping) and value:
        items = (f"{encode(key)}: {_laid_out(one, encode, inner)}" for key, one in value.items())
        return "{" + inner + f",{inner}".join(items) + end + "}"
    if isinstance(value, list) and value and isinstance(value[0], Mapping):
        return "[" + inner + f",{inner}".join(map(encode, value)) + end + "]"
    return encode(value)


def _by_name(names: Sequence[str], values: Floats) -> dict[str, Any]:
    return {name: values[:, index].tolist() for index, name in enumerate(names)}
