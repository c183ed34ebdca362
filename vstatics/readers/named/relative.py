"""Numbers with a unit, or for all gears -> relative numbers of each gear.

Speeds are related to the input speed of the load, torques and drag to its torque.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from vstatics.errors import Path
from vstatics.model.transmission import HOUSING
from vstatics.readers.named.quantities import WithUnit
from vstatics.readers.named.spots import Spots

Given = dict[int, tuple[float, Path]]
"""By link or shift element: the number, and the path where it stands."""


_NO_LESS = "a torque of 0 or more: drag opposes any motion"


class _Whole(NamedTuple):
    """What numbers with a unit are related to."""

    quantity: str
    unit: str
    value: float
    """0 where the load does not tell."""


def resolve(values: dict[str, Any], spots: Spots) -> None:
    """Put what holds for all gears into each, and relate what has a unit to the load.

    Parameters
    ----------
    values : dict
        Of a document; its `drag` is taken out, and drag of shift elements with a unit.
        Their capacities with a unit are related to the load of the case, as an element
        carries the same in all gears.
    spots : Spots
        Is told where a unit stands without a load, and drag of a case that can't be.
    """
    links = dict(_of_case(_given(values.pop("drag", {}), ("drag",)), spots))
    elements = dict(_elements(values, spots))
    _capacities(values, spots)
    for number, (_, record) in enumerate(values["gears"], 1):
        load = {**values.get("load", {}), **record.get("load", {})}
        speed, torque = load.get("speed", 0.0), load.get("torque", 0.0)
        # when coasting, the torque of the load is against its speed
        turned = -torque if values.get("coast") else torque
        for key, common, whole in (
            ("speeds", {}, _Whole("speed", "rpm", speed)),
            ("torques", {}, _Whole("torque", "N*m", turned)),
            ("drag", links, _Whole("torque", "N*m", abs(torque))),
            ("open_drag", elements, _Whole("torque", "N*m", abs(torque))),
        ):
            path = ("gears", number, key)
            given = {**common, **dict(_given(record.pop(key, {}), path))}
            if given:
                record[key] = dict(_relative(given, whole, spots))


def _given(numbers: Mapping[int, float], path: Path) -> Iterator[tuple[int, tuple[float, Path]]]:
    for place, number in numbers.items():
        yield place, (number, (*path, place))


def _of_case(
    drag: Iterator[tuple[int, tuple[float, Path]]], spots: Spots
) -> Iterator[tuple[int, tuple[float, Path]]]:
    """Drag for all gears; what can't be is told here once, and not again by each gear."""
    for link, (torque, path) in drag:
        if link == HOUSING:
            spots.tell(path, "the housing does not turn, expected a link")
        elif torque < 0:
            unit = " N*m" if isinstance(torque, WithUnit) else ""
            spots.tell(path, f"read {torque:g}{unit}, expected {_NO_LESS}")
        else:
            yield link, (torque, path)


def _elements(values: dict[str, Any], spots: Spots) -> Iterator[tuple[int, tuple[float, Path]]]:
    """Drag of shift elements that has a unit, taken out of their records."""
    for number, (_, record) in enumerate(values.get("shift_elements", ()), 1):
        drag, path = record.get("drag"), ("shift_elements", number, "drag")
        if not isinstance(drag, WithUnit):
            continue
        del record["drag"]
        if drag < 0:
            spots.tell(path, f"read {drag:g} N*m, expected {_NO_LESS}")
        elif drag and record.get("kind") == "dog_clutch":
            message = f"read {drag:g} N*m, but a dog clutch does not drag when it is open"
            spots.tell(path, message)
        else:
            yield number, (drag, path)


def _capacities(values: dict[str, Any], spots: Spots) -> None:
    whole = _Whole("torque", "N*m", abs(values.get("load", {}).get("torque", 0.0)))
    for number, (_, record) in enumerate(values.get("shift_elements", ()), 1):
        capacity, path = record.get("capacity"), ("shift_elements", number, "capacity")
        if not isinstance(capacity, WithUnit):
            continue
        del record["capacity"]
        if capacity <= 0:
            spots.tell(path, f"read {capacity:g} N*m, expected a torque above 0")
        else:
            for _, torque in _relative({number: (capacity, path)}, whole, spots):
                record["capacity"] = torque


def _relative(given: Given, whole: _Whole, spots: Spots) -> Iterator[tuple[int, float]]:
    for place, (number, path) in given.items():
        if not isinstance(number, WithUnit):
            yield place, number
        elif number < 0 and path[-2] in ("drag", "open_drag"):
            spots.tell(path, f"read {number:g} {whole.unit}, expected {_NO_LESS}")
        elif whole.value:
            yield place, number / whole.value
        elif path not in spots.unreadable:
            quantity, unit = whole.quantity, whole.unit
            spots.tell(
                path,
                f"read {number:g} {unit}, but there is no input {quantity} to relate it to; "
                f"expected a number relative to the input {quantity}, or "
                f"`load: {{{quantity}: ... {unit}}}` in the case",
            )
