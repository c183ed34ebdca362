"""The values of a document -> the arguments of `Transmission`."""

from __future__ import annotations

from typing import Any

from vstatics.errors import Path
from vstatics.model.transmission import HOUSING, Gear, Load, Mechanism, ShiftElement
from vstatics.readers.named.relative import resolve
from vstatics.readers.named.walk import Walk


def arguments(values: dict[str, Any], walk: Walk) -> dict[str, Any]:
    """The arguments of `Transmission`."""
    resolve(values, walk.spots)
    _output(values, walk)
    return values | {
        "shift_elements": [
            _element(name, **record) for name, record in values.get("shift_elements", ())
        ],
        "mechanisms": [
            Mechanism(**record, name=name) for name, record in values.get("mechanisms", ())
        ],
        "gears": [_gear(name, record) for name, record in values["gears"]],
        "load": _load(values),
        "link_names": walk.references.link_names,
    }


def _output(values: dict[str, Any], walk: Walk) -> None:
    """Refuse the housing as output; to the model its number would say that none is given."""
    if values.get("output") == HOUSING:
        walk.spots.tell(("output",), "read the housing, expected the link that drives the load")


def _element(name: str, links: tuple[int, int], **other: Any) -> ShiftElement:
    return ShiftElement(*links, name, **other)


def _gear(name: str, record: dict[str, Any]) -> Gear:
    return Gear(**(record | {"name": name, "load": _load(record)}))


def _load(record: dict[str, Any]) -> Load | None:
    given = record.get("load")
    return Load(**given) if given else None


def untold(unreadable: list[Path]) -> list[Path]:
    """Where the model's complaints would be about stand-ins.

    Links are counted against the devices, so these count too.
    """
    devices = {("shift_elements",), ("mechanisms",)}
    return [*unreadable, ("links",)] if devices.intersection(unreadable) else unreadable
