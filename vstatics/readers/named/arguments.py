"""The values of a document -> the arguments of `Transmission`."""

from __future__ import annotations

from typing import Any

from vstatics.errors import Path
from vstatics.model.keys import CASE
from vstatics.model.parts import HOUSING, Gear, Load
from vstatics.readers.named.relative import Common, relative
from vstatics.readers.named.walk import Walk

_OWN = tuple(key.name for key in CASE.keys if key.name != "drag")
"""Keys that are attributes of a case; its drag becomes that of its gears."""


def arguments(values: dict[str, Any], walk: Walk) -> dict[str, Any]:
    """The arguments of `Transmission`."""
    if values.get("output") == HOUSING:  # to the model this would say that none is given
        walk.spots.tell(("output",), "read the housing, expected the link that drives the load")
    parts = {
        part: [item._replace(name=name) for name, item in values.get(part, {}).items()]
        for part in ("shift_elements", "mechanisms", "springs", "gears")
    }
    masses = ("springs", "inertias")
    given = any(values.get(key) or (key,) in walk.spots.unreadable for key in masses)
    if given and not parts["gears"]:
        parts["gears"] = [Gear()]  # so that drag of the case has a place
    load = values.get("load", Load())
    moves = bool(values.get("inertias"))
    common = Common(load, values["coast"], values.get("drag", {}), moves)
    elements, gears = relative(parts["shift_elements"], parts["gears"], common, walk.spots)
    return {
        **{key: values[key] for key in _OWN if key in values},
        **parts,
        "shift_elements": elements,
        "gears": [gear._replace(load=_or_none(gear.load)) for gear in gears],
        "load": _or_none(load),
        "link_names": walk.references.link_names,
    }


def _or_none(load: Load | None) -> Load | None:
    """A load that says nothing is none."""
    return None if load == Load() else load


def untold(unreadable: list[Path]) -> list[Path]:
    """Where the model's complaints would be about stand-ins.

    Links are counted against the devices, so these count too.
    """
    devices = {("shift_elements",), ("mechanisms",), ("springs",)}
    return [*unreadable, ("links",)] if devices.intersection(unreadable) else unreadable
