"""Arguments of `Transmission` from the values of a document.

Speeds with a unit are divided by the input speed of the operating point, torques and drag with a
unit by the input torque.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from vstatics.core.annexes import KEYS
from vstatics.core.errors import Path
from vstatics.core.model.converters import converters_of
from vstatics.core.model.keys import CASE
from vstatics.core.model.parts import HOUSING, Gear, Law, Load, OfLoad, ShiftElement, SpeedOf
from vstatics.core.model.shape import UNITS
from vstatics.core.readers.named.nodes import Spots
from vstatics.core.readers.named.units import WithUnit
from vstatics.core.readers.named.walk import Walk

_ATTRIBUTES = (*(key.name for key in CASE.keys), *KEYS)
"""Keys that are attributes of a case."""


def arguments(values: dict[str, Any], walk: Walk) -> dict[str, Any]:
    """Return the arguments of `Transmission`."""
    if values.get("output") == HOUSING:  # in the model, output 0 means that the output is missing
        walk.spots.tell(("output",), "read the housing, expected the link that drives the load")
    parts = {
        part: [item._replace(name=name) for name, item in values.get(part, {}).items()]
        for part in ("shift_elements", "mechanisms", "springs", "gears")
    }
    masses = ("springs", "inertias", "masses")
    given = any(values.get(key) or (key,) in walk.spots.unreadable for key in masses)
    if not parts["gears"] and (given or not parts["shift_elements"]):
        parts["gears"] = [Gear()]
    load = values.get("load", Load())
    # In a case with inertias, capacities and drag in N*m need no operating point.
    moves = values.get("inertias") or values.get("masses")
    common = Common(load, load.torque_size or (math.inf if moves else 0.0))
    elements, gears, drag = in_gears(
        parts["shift_elements"], parts["gears"], values.get("drag", {}), common, walk.spots
    )
    return {
        **{key: values[key] for key in _ATTRIBUTES if key in values},
        **parts,
        "converters": converters_of(values.get("converters", {})),
        "shift_elements": elements,
        "gears": [gear._replace(load=_or_none(gear.load)) for gear in gears],
        "drag": drag,
        "load": _or_none(load),
        "link_names": walk.references.link_names,
    }


def _or_none(load: Load | None) -> Load | None:
    """Return a load; None if it has no values."""
    return None if load == Load() else load


_COMPARED: dict[Path, Path] = {
    ("shift_elements",): ("links",),
    ("mechanisms",): ("links",),
    ("springs",): ("links",),
    ("masses",): ("springs",),
    ("output",): ("outputs",),
}
"""Keys whose values the model compares with the value of another key."""
_OF_KIND = ((), ("kind",), ("points",))
"""Ends of the paths of values that determine the kind of a mechanism."""


def read_with_stand_ins(unreadable: list[Path]) -> list[Path]:
    """Return the paths at which stand-ins would cause problems of the model.

    Unreadable `links` of a component are `first` and `second` in the model. The kind of a mechanism
    determines whether gears give its speed ratio.
    """
    ends = (path[:-1] for path in unreadable if path[-1:] == ("links",))
    members = [(*path, member) for path in ends for member in ("first", "second")]
    others = [_COMPARED[path[:1]] for path in unreadable if path[:1] in _COMPARED]
    kinds = [path for path in unreadable if path[:1] == ("mechanisms",) and path[2:3] in _OF_KIND]
    return [*unreadable, *members, *others, *[("gears",)][: len(kinds)]]


_ByPart = dict[int, tuple[float, Path]]
"""Value and path in the document, by number of the link or shift element."""


class Common(NamedTuple):
    """Operating point of the case, to which numbers with a unit are relative."""

    load: Load
    whole: float
    """Input torque [N*m]. Without a load: infinity if no load is needed, else 0 (an error)."""


def in_gears(
    elements: list[ShiftElement],
    gears: list[Gear],
    drag: Mapping[int, float],
    common: Common,
    spots: Spots,
) -> tuple[list[ShiftElement], list[Gear], dict[int, float]]:
    """Return shift elements, gears and drag of the case with numbers relative to the input.

    Capacity and drag of shift elements, and drag of the case, are relative to the operating point
    of the case. The numbers of a gear are relative to the operating point of the gear.

    Parameters
    ----------
    elements, gears, drag
        Parts of the document, with numbers as written.
    common : Common
        Operating point of the case.
    spots : Spots
        Collector of the errors about units without an operating point.
    """
    of_elements: _ByPart = {
        number: (element.drag, ("shift_elements", number, "drag"))
        for number, element in enumerate(elements, 1)
        if isinstance(element.drag, WithUnit)
    }
    of_links = _located(drag, ("drag",))
    for gear in gears:
        load = (gear.load or Load()).or_else(common.load)
        for of_case, of_gear in ((of_links, gear.drag), (of_elements, gear.open_drag)):
            left = {part: drag for part, drag in of_case.items() if part not in of_gear}
            _related(left, load.torque_size or common.whole, spots)
    return (
        [_element(element, n, common, spots) for n, element in enumerate(elements, 1)],
        [_gear(gear, n, common, spots) for n, gear in enumerate(gears, 1)],
        {link: _by_load(torque, common.load) for link, torque in drag.items()},
    )


def _located(numbers: Mapping[int, float], path: Path) -> _ByPart:
    return {part: (number, (*path, part)) for part, number in numbers.items()}


def _by_load(torque: float, load: Load) -> float:
    """Return a torque with a unit relative to the torque of a load; 0 without a load."""
    whole = load.torque_size or math.inf
    return OfLoad(float(torque), whole) if isinstance(torque, WithUnit) else torque


def _element(element: ShiftElement, number: int, common: Common, spots: Spots) -> ShiftElement:
    """Return a shift element with drag and capacity relative to the load of the case."""
    drag = _by_load(element.drag, common.load)
    capacity, path = element.capacity, ("shift_elements", number, "capacity")
    if isinstance(capacity, WithUnit):
        if capacity > 0:
            capacity = _related({number: (capacity, path)}, common.whole, spots).get(number)
        else:
            spots.tell(path, f"read {capacity:g}, expected a torque above 0")
            capacity = None
    return element._replace(drag=drag, capacity=capacity)


def _gear(gear: Gear, number: int, common: Common, spots: Spots) -> Gear:
    load = (gear.load or Load()).or_else(common.load)
    torque = load.torque_size
    drags = torque or common.whole

    def related(key: str, numbers: Mapping[int, float], whole: float) -> dict[int, float]:
        return _related(_located(numbers, ("gears", number, key)), whole, spots)

    by_links = {link: speed for link, speed in gear.speeds.items() if isinstance(speed, SpeedOf)}
    numbers = {link: speed for link, speed in gear.speeds.items() if not isinstance(speed, SpeedOf)}
    speeds = related("speeds", numbers, load.speed or 0.0) | by_links
    return gear._replace(
        speeds={link: speeds[link] for link in gear.speeds if link in speeds},
        slip=related("slip", gear.slip, load.speed or 0.0),
        torques=related("torques", gear.torques, torque),  # `Transmission` adds the sign
        drag=related("drag", gear.drag, drags),
        open_drag=related("open_drag", gear.open_drag, drags),
    )


def _related(numbers: _ByPart, whole: float, spots: Spots) -> dict[int, float]:
    """Return numbers divided by the input speed or torque `whole`, which is 0 if unknown.

    If `whole` is unknown, numbers with a unit are reported and omitted.
    """
    relative = {}
    no_load = any(path[-1] == "load" for path in spots.unreadable)
    for part, (number, path) in numbers.items():
        if isinstance(number, Law) and not whole and path[0] == "drag":
            if path not in spots.unreadable and not no_load:
                spots.tell(
                    path,
                    "a drag that depends on speed is in N*m, expected a `load` with "
                    "speed and torque",
                )
        elif not isinstance(number, WithUnit):
            relative[part] = number
        elif whole:
            relative[part] = OfLoad(float(number), whole)
        elif path not in spots.unreadable and not no_load:
            quantity, unit = number.quantity, UNITS[number.quantity]
            spots.tell(
                path,
                f"read {number:g}, but there is no input {quantity} to relate it to; "
                f"expected a number relative to the input {quantity}, or "
                f"`load: {{{quantity}: ... {unit}}}` in the case",
            )
    return relative
