"""The values of a document -> the arguments of `Transmission`, relative numbers by gear.

Speeds are related to the input speed of the load, torques and drag to its torque.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vstatics.errors import Path
from vstatics.model.converters import converters_of
from vstatics.model.keys import CASE
from vstatics.model.part_checks import of_drag
from vstatics.model.parts import HOUSING, Gear, Law, Load, OfLoad, ShiftElement, SpeedOf
from vstatics.model.shape import UNITS
from vstatics.readers.named.nodes import Spots
from vstatics.readers.named.units import WithUnit
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
    masses = ("springs", "inertias", "masses")
    given = any(values.get(key) or (key,) in walk.spots.unreadable for key in masses)
    if given and not parts["gears"]:
        parts["gears"] = [Gear()]  # so that drag of the case has a place
    load = values.get("load", Load())
    common = Common(
        load, values.get("drag", {}), bool(values.get("inertias") or values.get("masses"))
    )
    elements, gears = in_gears(parts["shift_elements"], parts["gears"], common, walk.spots)
    return {
        **{key: values[key] for key in _OWN if key in values},
        **parts,
        "converters": converters_of(values.get("converters", {})),
        "shift_elements": elements,
        "gears": [gear._replace(load=_or_none(gear.load)) for gear in gears],
        "load": _or_none(load),
        "link_names": walk.references.link_names,
    }


def _or_none(load: Load | None) -> Load | None:
    """A load that says nothing is none."""
    return None if load == Load() else load


def read_with_stand_ins(unreadable: list[Path]) -> list[Path]:
    """Where the model's complaints would be about stand-ins.

    Links are counted against the devices, so these count too.
    """
    devices = {("shift_elements",), ("mechanisms",), ("springs",)}
    return [*unreadable, ("links",)] if devices.intersection(unreadable) else unreadable


class _Located(NamedTuple):
    """A number, and the path where it stands."""

    number: float
    path: Path


_ByPart = dict[int, _Located]
"""By link or shift element."""


class Common(NamedTuple):
    """What a case gives for all gears."""

    load: Load
    drag: Mapping[int, float]
    """Of links."""
    moves: bool = False
    """Whether it has inertias: then capacities and drag with a unit need no load."""


def in_gears(
    elements: list[ShiftElement], gears: list[Gear], common: Common, spots: Spots
) -> tuple[list[ShiftElement], list[Gear]]:
    """Shift elements and gears with relative numbers only, and what holds for all in each gear.

    Drag of shift elements with a unit goes into the gears. Their capacities are related to
    the load of the case, as an element carries the same in all gears.

    Parameters
    ----------
    elements, gears
        Of a document, with their numbers as they are written.
    spots : Spots
        Is told where a unit stands without a load, and drag of a case that can't be.
    """
    of_links = dict(_of_links(_located(common.drag, ("drag",)), spots))
    of_elements = dict(_of_elements(elements, spots))
    return (
        [_element(element, n, common, spots) for n, element in enumerate(elements, 1)],
        [_gear(gear, n, common, (of_links, of_elements), spots) for n, gear in enumerate(gears, 1)],
    )


def _located(numbers: Mapping[int, float], path: Path) -> _ByPart:
    return {part: _Located(number, (*path, part)) for part, number in numbers.items()}


def _of_links(drag: _ByPart, spots: Spots) -> Iterator[tuple[int, _Located]]:
    """Drag for all gears; what can't be is told here once, and not again by each gear."""
    for link, (torque, path) in drag.items():
        if link == HOUSING:
            spots.tell(path, "the housing does not turn, expected a link")
        elif _is_drag(torque, None, path, spots):
            yield link, _Located(torque, path)


def _of_elements(elements: list[ShiftElement], spots: Spots) -> Iterator[tuple[int, _Located]]:
    """Drag of shift elements that has a unit."""
    for number, element in enumerate(elements, 1):
        drag, path = element.drag, ("shift_elements", number, "drag")
        if isinstance(drag, WithUnit) and _is_drag(drag, element, path, spots):
            yield number, _Located(drag, path)


def _is_drag(torque: float, element: ShiftElement | None, path: Path, spots: Spots) -> bool:
    """Whether a torque is one of drag; else it is told."""
    problems = list(of_drag(torque, element, path))
    for problem in problems:
        spots.tell(path, problem.message)
    return not problems


def _whole(common: Common) -> float:
    """What capacities are related to: infinite where only their own unit counts."""
    return common.load.torque_size or (math.inf if common.moves else 0.0)


def _element(element: ShiftElement, number: int, common: Common, spots: Spots) -> ShiftElement:
    """An element without drag that has a unit, and with a relative capacity."""
    drag = 0.0 if isinstance(element.drag, WithUnit) else element.drag
    capacity, path = element.capacity, ("shift_elements", number, "capacity")
    if isinstance(capacity, WithUnit):
        if capacity > 0:
            given = {number: _Located(capacity, path)}
            capacity = _related(given, _whole(common), spots).get(number)
        else:
            spots.tell(path, f"read {capacity:g}, expected a torque above 0")
            capacity = None
    return element._replace(drag=drag, capacity=capacity)


def _gear(
    gear: Gear, number: int, common: Common, by_part: tuple[_ByPart, _ByPart], spots: Spots
) -> Gear:
    load = (gear.load or Load()).or_else(common.load)
    torque, (of_links, of_elements) = load.torque_size, by_part
    drags = torque or _whole(common)

    def related(
        key: str, numbers: Mapping[int, float], whole: float, of_all: _ByPart
    ) -> dict[int, float]:
        return _related({**of_all, **_located(numbers, ("gears", number, key))}, whole, spots)

    by_links = {link: one for link, one in gear.speeds.items() if isinstance(one, SpeedOf)}
    numbers = {link: one for link, one in gear.speeds.items() if not isinstance(one, SpeedOf)}
    speeds = related("speeds", numbers, load.speed or 0.0, {}) | by_links
    return gear._replace(
        speeds={link: speeds[link] for link in gear.speeds if link in speeds},
        torques=related("torques", gear.torques, torque, {}),  # the case gives it its sign
        drag=related("drag", gear.drag, drags, of_links),
        open_drag=related("open_drag", gear.open_drag, drags, of_elements),
    )


def _related(numbers: _ByPart, whole: float, spots: Spots) -> dict[int, float]:
    """Numbers as parts of the input's, which is 0 where none is known.

    Those that cannot be related are told.
    """
    made: dict[int, float] = {}
    no_load = any(path[-1] == "load" for path in spots.unreadable)
    for part, (number, path) in numbers.items():
        if isinstance(number, Law) and not whole and path[0] == "drag":
            if path not in spots.unreadable:
                message = "it depends on speed, in N*m, expected a `load` with speed and torque"
                spots.tell(path, message)
        elif not isinstance(number, WithUnit):
            made[part] = number
        elif path[-2] in ("drag", "open_drag") and not _is_drag(number, None, path, spots):
            continue
        elif whole:
            made[part] = OfLoad(float(number), whole)
        elif path not in spots.unreadable and not no_load:
            quantity, unit = number.quantity, UNITS[number.quantity]
            spots.tell(
                path,
                f"read {number:g}, but there is no input {quantity} to relate it to; "
                f"expected a number relative to the input {quantity}, or "
                f"`load: {{{quantity}: ... {unit}}}` in the case",
            )
    return made
