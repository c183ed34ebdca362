"""What formulas see of a box in motion: where each of their words stands among what is seen.

All that is seen stands in one row: the rates of ports, twists, angles, values (states and
temperatures), then what follows from torques (`derived`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.programme import Look, Programme
from vstatics.simulation.system.matrices import MotionSystem


def place_of(system: MotionSystem, seen: Seen) -> int:
    """Where something stands among all that is seen."""
    layout, names = system.layout, system.names
    twists = layout.ports
    angles = twists + len(system.springs)
    values = angles + len(layout.angles)
    match seen.word:
        case "speed":
            return layout.sensors + layout.sensed.index(names.index(seen.of))
        case "slip":
            return _slip(system, seen.of)
        case "twist":
            return twists + [one.name for one in system.springs].index(seen.of)
        case "angle":
            return angles + layout.angles.index(names.index(seen.of))
        case "value" | "temperature":
            return values + layout.values.index(seen)
        case _:
            return values + len(layout.values) + layout.derived.index(seen)


def _slip(system: MotionSystem, name: str) -> int:
    """The port of a shift element."""
    [number] = (n for n, one in enumerate(system.case.shift_elements) if one.name == name)
    for index, contact in enumerate(system.contacts):
        if contact.element == number:
            return system.layout.contacts + index
    [index] = (n for n, one in enumerate(system.springs) if one.element == number)
    return system.layout.springs + index


def looking(system: MotionSystem, formula: Formula, rate: int = 0, angle: int = -1) -> Look:
    """A formula as a function of the time and all that is seen.

    Parameters
    ----------
    rate : int
        The port of its own link.
    angle : int
        The place of its own angle among those that are followed; -1: it has none.
    """
    function = formula.function
    places = [place_of(system, one) for one in formula.seen]
    turned = system.layout.ports + len(system.springs) + angle if angle >= 0 else -1

    def value(time: float, seen: Sequence[float]) -> float:
        own = seen[turned] if turned >= 0 else 0.0
        return function(time, seen[rate], own, *[seen[place] for place in places])

    return value


def with_settings(system: MotionSystem, settings: Mapping[str, float]) -> MotionSystem:
    """The system with numbers for what its formulas call so.

    Controls look at it from then on.
    """
    contacts = tuple(
        one._replace(programme=_seeing(system, one.programme, settings)) for one in system.contacts
    )
    springs = tuple(
        one._replace(programme=_seeing(system, one.programme, settings)) for one in system.springs
    )
    outside = tuple(
        one._replace(law=one.law.knowing(settings)) if isinstance(one.law, Formula) else one
        for one in system.outside
    )
    return replace(system, contacts=contacts, springs=springs, outside=outside, settings=settings)


def _seeing(system: MotionSystem, programme: Programme, settings: Mapping[str, float]) -> Programme:
    if not isinstance(programme.curve, Formula):
        return programme
    curve = programme.curve.knowing(settings)
    look = looking(system, curve) if curve.seen else None
    return programme._replace(curve=curve, look=look)
