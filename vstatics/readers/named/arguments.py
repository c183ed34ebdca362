"""The values of a document -> the arguments of `Transmission`."""

from __future__ import annotations

from typing import Any

from vstatics.errors import Path
from vstatics.model import Gear, Mechanism, ShiftElement
from vstatics.readers.named.walk import Walk


def arguments(values: dict[str, Any], walk: Walk) -> dict[str, Any]:
    """The arguments of `Transmission`."""
    return values | {
        "shift_elements": [
            ShiftElement(first, second, name)
            for name, (first, second) in values.get("shift_elements", ())
        ],
        "mechanisms": [
            Mechanism(**record, name=name) for name, record in values.get("mechanisms", ())
        ],
        "gears": [Gear(**record, name=name) for name, record in values["gears"]],
        "link_names": walk.references.link_names,
    }


def untold(unreadable: list[Path]) -> list[Path]:
    """Where the model's complaints would be about stand-ins.

    Links are counted against the devices, so these count too.
    """
    devices = {("shift_elements",), ("mechanisms",)}
    return [*unreadable, ("links",)] if devices.intersection(unreadable) else unreadable
