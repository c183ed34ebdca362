"""Drag as a case gives it, for all gears or with a unit -> relative drag of each gear."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.errors import Path, Problem
from vstatics.readers.named.scalars import NewtonMetres
from vstatics.readers.named.spots import Spots

Given = dict[int, tuple[float, Path]]
"""By link or shift element: the torque, and the path where it stands."""


def resolve(values: dict[str, Any], spots: Spots) -> None:
    """Put the drag of a case into its gears, relative to the input torque of each.

    Parameters
    ----------
    values : dict
        Of a document; its `drag` is taken out, and drag of shift elements with a unit.
    spots : Spots
        Is told where a unit stands without a load.
    """
    links = dict(_given(values.pop("drag", {}), ("drag",)))
    elements = dict(_elements(values))
    torque = values.get("load", {}).get("torque")
    for number, (_, record) in enumerate(values["gears"], 1):
        own = record.get("load", {}).get("torque", torque)
        for key, common in (("drag", links), ("open_drag", elements)):
            path = ("gears", number, key)
            given = {**common, **dict(_given(record.pop(key, {}), path))}
            if given:
                record[key] = dict(_relative(given, own, spots))


def _given(drag: Mapping[int, float], path: Path) -> Iterator[tuple[int, tuple[float, Path]]]:
    for place, torque in drag.items():
        yield place, (torque, (*path, place))


def _elements(values: dict[str, Any]) -> Iterator[tuple[int, tuple[float, Path]]]:
    """Drag of shift elements that has a unit, taken out of their records."""
    for number, (_, record) in enumerate(values.get("shift_elements", ()), 1):
        if isinstance(record.get("drag"), NewtonMetres):
            yield number, (record.pop("drag"), ("shift_elements", number, "drag"))


def _relative(
    given: Given, input_torque: float | None, spots: Spots
) -> Iterator[tuple[int, float]]:
    for place, (torque, path) in given.items():
        if not isinstance(torque, NewtonMetres):
            yield place, torque
        elif input_torque:
            yield place, torque / abs(input_torque)
        elif path not in spots.unreadable:
            message = (
                f"read {torque:g} N*m, but there is no input torque to relate it to; expected a "
                "number relative to the input torque, or `load: {torque: ... N*m}` in the case"
            )
            spots.found.problems.append(spots.locate(Problem(message, path)))
            spots.unreadable.append(path)
