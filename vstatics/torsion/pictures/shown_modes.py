"""Natural modes for pictures, and texts about gears without modes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from vstatics.core.errors import CaseError, listed
from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.pictures.drawing.style import Style

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


def modes_of(results: Results, gears: Sequence[int] = ()) -> list[GearModes]:
    """Calculate the natural modes of gears with given numbers (from 1), or of all gears.

    Raises
    ------
    CaseError
        If scipy is not installed, or none of these gears has a mode.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> modes_of(solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], inertias={1: 1})))
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: gear 1 has no natural frequency: nothing is elastic; ...
    """
    require("torsion", "a picture of natural modes")
    from vstatics.torsion.vibration.gear_modes import modes

    modes_by_gear = modes(results.case, gear_names(results.case, gears) or None)
    if not any(gear.modes for gear in modes_by_gear):
        names = listed([gear.name for gear in modes_by_gear])
        subject = f"gear {names} has" if len(modes_by_gear) == 1 else f"gears {names} have"
        reasons = (text for gear in modes_by_gear for text in (gear.error, *gear.warnings) if text)
        raise CaseError("E412", ": ".join([f"{subject} no natural frequency", *[*reasons][:1]]))
    return modes_by_gear


def gear_names(case: Transmission, numbers: Sequence[int]) -> list[str]:
    """Return the names of gears with given numbers (from 1).

    The number of a gear can be the name of another gear, so calculations get names.
    """
    return [case.gears[number - 1].name for number in numbers]


def why_none(gear: GearModes, style: Style) -> str:
    """Return the text that replaces the modes of a gear without any."""
    for status in (TIED_UP, CONFLICT):
        if gear.error.startswith(status.english):
            return style.text(status.english)
    return gear.error or style.text("no natural frequency")
