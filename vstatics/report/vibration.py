"""The natural modes of a case that vibrates, for its page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.elements.drawing import drawing_of
from vstatics.errors import CaseError
from vstatics.extras import require
from vstatics.model.transmission import Mechanism, ShiftElement, Transmission
from vstatics.report.drawn import Drawn, picture_of
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from vstatics.torsion.gear_modes import GearModes


class Vibration(NamedTuple):
    """What the page shows of the natural modes of a case."""

    gears: Sequence[GearModes] = ()
    shapes: Sequence[Drawn] = ()
    """Of each gear; nothing where there are no pictures."""
    campbell: Sequence[Drawn] = ()
    """The same."""
    without: str = ""
    """Why all this is left out, else nothing."""


def vibrates(case: Transmission) -> bool:
    """Whether anything has an inertia, and anything is elastic.

    >>> from vstatics import Spring
    >>> spring = Spring({1: 1, 2: -1}, stiffness=100.0)
    >>> case = Transmission(2, [], [], [], springs=[spring])
    >>> vibrates(case), vibrates(case.replace(inertias={1: 0.5}))
    (False, True)
    """
    drawing = drawing_of(case)
    elements = drawing.elements if drawing is not None else ()
    heavy = any(case.inertias.values()) or any(one.planet_masses for one in elements)
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    return heavy and (bool(case.springs) or any(one.stiffness is not None for one in parts))


def vibration(results: Results, *, has_pictures: bool) -> Vibration | None:
    """The natural modes of a case; nothing if it does not vibrate.

    Parameters
    ----------
    has_pictures : bool
        Whether anything can be drawn.
    """
    case = results.case
    if not vibrates(case):
        return None
    try:
        require("torsion", "the section on vibration")
    except CaseError as error:
        return Vibration(without=str(error))
    from vstatics.torsion.gear_modes import modes

    found = modes(case)
    if not has_pictures or not any(gear.modes for gear in found):
        return Vibration(found)
    shapes, campbell = (
        [picture_of(results, kind, number) for number in range(1, len(found) + 1)]
        for kind in ("modes", "campbell")
    )
    return Vibration(found, shapes, campbell)
