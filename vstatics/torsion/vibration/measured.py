"""What follows for the elastic devices of a gear from what is measured of one of its modes.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendices 1.3 and 2; numbers of
equations are those of the book.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, listed, quoted, spoken
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest
from vstatics.core.tables.answer import told
from vstatics.torsion.system.gear_system import TorsionalDevice
from vstatics.torsion.system.state import vibrating
from vstatics.torsion.vibration import decrements as formulas
from vstatics.torsion.vibration.decrements import ByDevice
from vstatics.torsion.vibration.gear_modes import Mode, modes


class Identified(NamedTuple):
    """The elastic devices of a gear with which a mode has the frequency that was measured."""

    omega: float
    """Of the mode, as calculated before. [rad/s]"""
    compliances: ByDevice
    """Of each device, in its own twist. [rad/(N*m)]"""
    dampings: ByDevice
    """Likewise; none where no decrement is given. [N*m*s/rad]"""


@told("omega", "dampings", "decrement", "shares", messages="notes")
class Damped(NamedTuple):
    """The dampings of elastic devices in a gear by their decrements."""

    omega: float
    """At which they hold. [rad/s]"""
    dampings: ByDevice
    """Of each device that has a decrement, in its own twist. [N*m*s/rad]"""
    decrement: float
    """Of the mode, from these. [-]"""
    shares: ByDevice
    """Of the same devices, in the elastic energy of the mode. [-]"""
    notes: Sequence[str] = ()


@refusing()
def identify(  # noqa: PLR0913
    case: Transmission,
    gear: int | str,
    omega: float,
    decrement: float | None = None,
    mode: int = 1,
    *,
    coast: bool | None = None,
) -> Identified:
    """Correct all compliances of a gear by the frequency of a mode that was measured, (П2.2).

    All by one factor, so shapes and shares of energy stay. With its decrement each device gets
    the damping that gives it this decrement, (П1.19); then the mode has it.

    Parameters
    ----------
    case : Transmission
    gear : int or str
        Number from 1, or name.
    omega : float
        Measured. [rad/s]
    decrement : float, optional
        Measured. [-]
    mode : int
        Of those that are not rigid, by ascending frequency, from 1.
    coast : bool, optional
        As of `modes`.

    Returns
    -------
    Identified
        Compliances [rad/(N*m)], dampings [N*m*s/rad], the frequency by calculation [rad/s].

    Raises
    ------
    ValueError
        If there is no such gear or mode, or of a number that can't be.
    CaseError
        If the gear has no modes.

    Examples
    --------
    A ВАЗ-2101 in gear III, table П2.1: 32.1 rad/s by calculation, .0096 rad/(N*m) and 1.28
    N*m*s from what was measured.

    >>> from vstatics import Spring, Transmission
    >>> case = Transmission(
    ...     2, [], [], [], inertias={1: 0.1465, 2: 2.6},
    ...     springs=[Spring({1: 1, 2: -1}, compliance=0.00699, name="all")],
    ... )
    >>> made = identify(case, 1, 27.4, 1.06)
    >>> round(made.omega, 1), round(made.compliances["all"], 4), round(made.dampings["all"], 2)
    (32.1, 0.0096, 1.28)
    """
    _check("omega", omega, above_0=True)
    if decrement is not None:
        _check("decrement", decrement)
    elastic, found = _of_mode(case, gear, mode, coast=coast)
    compliances = formulas.corrected(_compliances(elastic), found.omega, omega)
    _check_made(compliances, above_0=True)
    decrements = {} if decrement is None else dict.fromkeys(compliances, decrement)
    return Identified(found.omega, compliances, _dampings(decrements, compliances, omega))


@refusing()
def damping(  # noqa: PLR0913
    case: Transmission,
    gear: int | str,
    decrements: Mapping[str, float],
    omega: float | None = None,
    mode: int = 1,
    *,
    coast: bool | None = None,
) -> Damped:
    """The dampings that give elastic devices their decrements, and the decrement of a mode.

    A damping is ``decrement/(pi E omega)``, (П1.19); the decrement of the mode is the sum of
    these by shares of the elastic energy, (П1.20), (П1.21).

    Parameters
    ----------
    case : Transmission
    gear : int or str
        Number from 1, or name.
    decrements : mapping
        Of elastic devices, by their names. [-]
    omega : float, optional
        At which the dampings hold; that of the mode when not given. [rad/s]
    mode : int
        Of those that are not rigid, by ascending frequency, from 1.
    coast : bool, optional
        As of `modes`.

    Returns
    -------
    Damped
        Dampings of devices [N*m*s/rad], the decrement of the mode [-].

    Raises
    ------
    ValueError
        If there is no such gear, mode or elastic device, or of a number that can't be.
    CaseError
        If the gear has no modes.

    Examples
    --------
    >>> from vstatics import Spring, Transmission
    >>> shafts = [
    ...     Spring({1: 1, 2: -1}, compliance=0.01, name="damper"),
    ...     Spring({2: 1, 3: -1}, compliance=0.03, name="shaft"),
    ... ]
    >>> case = Transmission(3, [], [], [], inertias={1: 0.1, 3: 8.0}, springs=shafts)
    >>> made = damping(case, 1, {"damper": 0.2, "shaft": 0.04}, omega=10)
    >>> {name: round(one, 4) for name, one in made.dampings.items()}, round(made.decrement, 4)
    ({'damper': 0.6366, 'shaft': 0.0424}, 0.08)
    """
    if not decrements:
        raise ValueError("there is no decrement, expected one at least")
    if omega is not None:
        _check("omega", omega, above_0=True)
    elastic, found = _of_mode(case, gear, mode, coast=coast)
    name = case.gears[case.gear_number(gear) - 1].name
    compliances = _compliances(elastic)
    for device, one in decrements.items():
        if device not in compliances:
            raise ValueError(_not_elastic(case, name, device, [*compliances]))
        _check(f"decrement of {device}", one)
    at = found.omega if omega is None else omega
    return Damped(
        at,
        _dampings(decrements, compliances, at),
        formulas.decrement(decrements, found.elastic),
        {device: found.elastic[device] for device in decrements},
        list(_others(elastic, decrements, found)),
    )


def _of_mode(
    case: Transmission, gear: int | str, number: int, *, coast: bool | None
) -> tuple[list[TorsionalDevice], Mode]:
    """The elastic devices of a gear, and one of its modes."""
    case = case.with_coast(coast)
    at = case.gear_number(gear)
    if number < 1:
        raise ValueError(f"mode: read {number}, expected a number from 1")
    [found] = modes(case, [gear], count=number)
    if found.error:
        raise CaseError("E515", found.error, ("gears", at))
    if not found.modes:
        message = "nothing elastic joins inertias, so there is no mode"
        raise CaseError("E516", message, ("gears", at))
    if number > len(found.modes):
        raise ValueError(f"no mode {number} in gear {found.name}; it has {len(found.modes)}")
    system = vibrating(case, case.gears[at - 1])
    assert not isinstance(system, str)  # noqa: S101 - it has modes
    return system.elastic, found.modes[number - 1]


def _compliances(elastic: Sequence[TorsionalDevice]) -> dict[str, float]:
    return {device.name: 1 / (device.stiffness or math.inf) for device in elastic}


def _not_elastic(case: Transmission, gear: str, asked: str, elastic: Sequence[str]) -> str:
    """Why a device has no decrement in a gear."""
    known = f"; elastic are {listed([*map(quoted, elastic)], 12)}"
    if asked in case.devices:
        return f"{quoted(asked)} is not elastic in gear {gear}{known}"
    return f"no elastic device {quoted(asked)}{nearest(asked, elastic) or known}"


def _others(
    elastic: Sequence[TorsionalDevice], given: Mapping[str, float], mode: Mode
) -> Iterator[str]:
    """What the case's own dampings of further devices add."""
    own: dict[str, float] = {}
    for device in elastic:
        if device.damping and device.name not in given:
            viscous = device.damping.viscous * mode.omega / (device.stiffness or math.inf)
            own[device.name] = math.pi * (viscous + device.damping.loss_factor)
    if own:
        added = formulas.decrement(own, mode.elastic)
        yield f"by its damping in the case {spoken(own)} adds {added:.4g} to the decrement"


def _check(what: str, number: float, *, above_0: bool = False) -> None:
    """Refuse a number that is no measured one."""
    if not _is_measured(number, above_0=above_0):
        least = "above 0" if above_0 else "of 0 or more"
        raise ValueError(f"{what}: read {number:g}, expected a number {least}")


def _is_measured(number: float, *, above_0: bool) -> bool:
    return 0 < number < math.inf or (number == 0 and not above_0)


def _dampings(decrements: ByDevice, compliances: ByDevice, omega: float) -> dict[str, float]:
    try:
        made = formulas.dampings(decrements, compliances, omega)
    except ZeroDivisionError:
        made = dict.fromkeys(decrements, math.inf)
    _check_made(made)
    return made


def _check_made(made: ByDevice, *, above_0: bool = False) -> None:
    """Refuse results that no case could have."""
    for name, one in made.items():
        if not _is_measured(one, above_0=above_0):
            raise ValueError(f"numbers so large or so small give no value of {quoted(name)}")
