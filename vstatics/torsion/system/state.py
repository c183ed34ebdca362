"""Gears of a case that can vibrate, and reasons why other gears cannot."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.open_converters import without_lambda
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.solve import solve
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.torsion.system.gear_system import TorsionalSystem, torsional_system
from vstatics.torsion.system.slopes import spring_slopes


def vibrating(case: Transmission, gear: Gear) -> TorsionalSystem | str:
    """Return the torsional system of a gear, or the reason why the gear cannot vibrate.

    Freewheels are locked if they are locked at mean speeds. Free vibration needs no input, so the
    input can be at rest if another link can move. Nonlinear springs have the stiffnesses of
    `spring_slopes`.

    Raises
    ------
    CaseError
        If the torque of a nonlinear spring is indeterminate, or a converter has no lambda.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> brake, pair = ShiftElement(2, name="B"), Mechanism(1, 2, 0, -2.0, name="pair")
    >>> case = Transmission(2, [brake], [pair], [Gear([1])])
    >>> vibrating(case, case.gears[0]).partition(";")[0]
    'tied up: B and pair let nothing move'
    """
    if faults := list(without_lambda(case)):
        raise CaseError(faults)
    slopes = {spring.name: spring.slope for spring in spring_slopes(case, gear)}
    if case.freewheels:
        results = solve(case.replace(gears=[gear]))
        if results.conflict[0]:
            return f"{CONFLICT.english}: {CONFLICT.meaning}"
        gear = results.with_freewheels_engaged.gears[0]
    system = torsional_system(case, gear, slopes)
    if system.free().shape[1]:
        return system
    names = [device.name for device in system.rigid]
    let = "lets" if len(names) == 1 else "let"
    return (
        f"{TIED_UP.english}: {spoken(names)} {let} nothing move; release one of the engaged "
        "shift elements, or give a component a stiffness"
    )


def asked_gears(case: Transmission, gears: Sequence[int | str] | None) -> list[Gear]:
    """Return the gears with given numbers (from 1) or names, by default all gears.

    Raises
    ------
    ValueError
        If a gear does not exist.
    """
    return [case.gears[case.gear_number(gear) - 1] for gear in gears or ()] or [*case.gears]
