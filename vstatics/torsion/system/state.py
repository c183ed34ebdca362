"""The gears of a case that can vibrate, and why others can't."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.open_converters import without_lambda
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.freewheels import with_engaged
from vstatics.core.statics.solve import solve
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.torsion.system.gear_system import TorsionalSystem, torsional_system
from vstatics.torsion.system.slopes import spring_slopes


def vibrating(case: Transmission, gear: Gear) -> TorsionalSystem | str:
    """The torsional system of a gear, or why it has none.

    Freewheels hold where they do at mean speeds. Vibration knows no input, so the input may be
    held, as long as anything can move. Springs with points have the slopes of `spring_slopes`.

    Raises
    ------
    CaseError
        If such a slope is not known, or a converter has no lambda.

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
    slopes = {one.name: one.slope for one in spring_slopes(case, gear)}
    if case.freewheels:
        results = solve(case.replace(gears=[gear]))
        if results.conflict[0]:
            return f"{CONFLICT.english}: {CONFLICT.meaning}"
        held = [number for number in case.freewheels if results.holds[0, number - 1]]
        gear = with_engaged(gear, held)
    system = torsional_system(case, gear, slopes)
    if system.free().shape[1]:
        return system
    names = [device.name for device in system.rigid]
    let = "lets" if len(names) == 1 else "let"
    return (
        f"{TIED_UP.english}: {spoken(names)} {let} nothing move; release one of the engaged "
        "elements, or give a device a stiffness"
    )


def asked_gears(case: Transmission, gears: Sequence[int | str] | None) -> list[Gear]:
    """Gears by their numbers from 1 or their names; all when none is given.

    Raises
    ------
    ValueError
        If there is no such gear.
    """
    return [case.gears[case.gear_number(one) - 1] for one in gears or ()] or [*case.gears]
