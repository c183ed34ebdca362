"""Corrections of the elastic components of a gear from a measured frequency and decrement.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendices 1.3 and 2; equation
numbers are from the book.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, listed, quoted, spoken
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest
from vstatics.core.tables.answer import json_keys
from vstatics.torsion.system.gear_system import TorsionalDevice
from vstatics.torsion.system.state import vibrating
from vstatics.torsion.vibration import decrements as formulas
from vstatics.torsion.vibration.decrements import ByDevice
from vstatics.torsion.vibration.gear_modes import Mode, modes


class Identified(NamedTuple):
    """Elastic components of a gear, corrected by the measured frequency of a mode."""

    omega: float
    """Angular frequency of the mode before the correction. [rad/s]"""
    compliances: ByDevice
    """Corrected compliance of the twist of each component. [rad/(N*m)]"""
    dampings: ByDevice
    """Damping of the twist of each component; empty if no decrement was measured. [N*m*s/rad]"""


@json_keys("omega", "dampings", "decrement", "shares", messages="notes")
class Damped(NamedTuple):
    """Dampings of elastic components of a gear, calculated from their decrements."""

    omega: float
    """Angular frequency at which the dampings are valid. [rad/s]"""
    dampings: ByDevice
    """Damping of the twist of each component with a decrement. [N*m*s/rad]"""
    decrement: float
    """Resulting decrement of the mode. [-]"""
    shares: ByDevice
    """Shares of the components with a decrement in the elastic energy of the mode. [-]"""
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
    """Correct all compliances of a gear by the measured frequency of a mode, (П2.2).

    All compliances change by the same factor, so shapes and energy shares remain. With a measured
    decrement, each component gets the damping that gives it this decrement, (П1.19); the mode then
    has the same decrement.

    Parameters
    ----------
    case : Transmission
    gear : int or str
        Number from 1, or name.
    omega : float
        Measured angular frequency. [rad/s]
    decrement : float, optional
        Measured logarithmic decrement. [-]
    mode : int
        Number of the mode, from 1, by ascending frequency and without rigid modes.
    coast : bool, optional
        True if power enters at the output, which determines the holding freewheels. By default as
        in the case.

    Returns
    -------
    Identified
        Compliances [rad/(N*m)], dampings [N*m*s/rad], and the calculated frequency [rad/s].

    Raises
    ------
    ValueError
        If the gear or the mode does not exist, or a number is out of range.
    CaseError
        If the gear has no modes.

    Examples
    --------
    A ВАЗ-2101 in gear III, table П2.1: 32.1 rad/s calculated; 0.0096 rad/(N*m) and 1.28 N*m*s
    from the measurement.

    >>> from vstatics import Spring, Transmission
    >>> case = Transmission(
    ...     2, [], [], [], inertias={1: 0.1465, 2: 2.6},
    ...     springs=[Spring({1: 1, 2: -1}, compliance=0.00699, name="all")],
    ... )
    >>> gear = identify(case, 1, 27.4, 1.06)
    >>> round(gear.omega, 1), round(gear.compliances["all"], 4), round(gear.dampings["all"], 2)
    (32.1, 0.0096, 1.28)
    """
    _check_number("omega", omega, above_0=True)
    if decrement is not None:
        _check_number("decrement", decrement)
    elastic, calculated = _devices_and_mode(case, gear, mode, coast=coast)
    compliances = formulas.corrected(_compliances(elastic), calculated.omega, omega)
    _check_results(compliances, above_0=True)
    decrements = {} if decrement is None else dict.fromkeys(compliances, decrement)
    return Identified(calculated.omega, compliances, _dampings(decrements, compliances, omega))


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
    """Calculate the damping of elastic components and of a mode from logarithmic decrements.

    A component with the compliance E has the damping ``decrement/(pi E omega)``, equation (П1.19)
    of Tsitovich and Algin, 1981. The decrement of the mode is the sum of the decrements of the
    components, weighted by their shares in the elastic energy, (П1.20), (П1.21).

    Parameters
    ----------
    case : Transmission
    gear : int or str
        Number from 1, or name.
    decrements : mapping
        Decrements by name of the elastic component. [-]
    omega : float, optional
        Angular frequency at which the dampings are valid, by default the mode's. [rad/s]
    mode : int
        Number of the mode, from 1, by ascending frequency and without rigid modes.
    coast : bool, optional
        True if power enters at the output, which determines the holding freewheels. By default as
        in the case.

    Returns
    -------
    Damped
        Dampings of the components [N*m*s/rad], and the decrement of the mode [-].

    Raises
    ------
    ValueError
        If the gear, the mode or a component does not exist, or a number is out of range.
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
    >>> mode = damping(case, 1, {"damper": 0.2, "shaft": 0.04}, omega=10)
    >>> {name: round(c, 4) for name, c in mode.dampings.items()}, round(mode.decrement, 4)
    ({'damper': 0.6366, 'shaft': 0.0424}, 0.08)
    """
    if not decrements:
        raise ValueError("read no decrement, expected at least one")
    if omega is not None:
        _check_number("omega", omega, above_0=True)
    elastic, mode_of_gear = _devices_and_mode(case, gear, mode, coast=coast)
    name = case.gears[case.gear_number(gear) - 1].name
    compliances = _compliances(elastic)
    for device, value in decrements.items():
        if device not in compliances:
            raise ValueError(_message_of_missing_device(case, name, device, [*compliances]))
        _check_number(f"decrement of {device}", value)
    omega_of_dampings = mode_of_gear.omega if omega is None else omega
    return Damped(
        omega_of_dampings,
        _dampings(decrements, compliances, omega_of_dampings),
        formulas.decrement(decrements, mode_of_gear.elastic),
        {device: mode_of_gear.elastic[device] for device in decrements},
        list(_notes_on_other_devices(elastic, decrements, mode_of_gear)),
    )


def _check_number(what: str, number: float, *, above_0: bool = False) -> None:
    """Raise ValueError for a number that no measurement gives, such as a negative frequency."""
    if not _is_measured(number, above_0=above_0):
        least = "above 0" if above_0 else "of 0 or more"
        raise ValueError(f"{what}: read {number:g}, expected a number {least}")


def _is_measured(number: float, *, above_0: bool) -> bool:
    return 0 < number < math.inf or (number == 0 and not above_0)


def _devices_and_mode(
    case: Transmission, gear: int | str, number: int, *, coast: bool | None
) -> tuple[list[TorsionalDevice], Mode]:
    case = case.with_coast(coast)
    number_of_gear = case.gear_number(gear)
    if number < 1:
        raise ValueError(f"mode: read {number}, expected a number from 1")
    [of_gear] = modes(case, [gear], count=number)
    if of_gear.error:
        raise CaseError("E515", of_gear.error, ("gears", number_of_gear))
    if not of_gear.modes:
        raise CaseError(
            "E516",
            "nothing elastic connects the inertias, so the gear has no mode",
            ("gears", number_of_gear),
        )
    if number > len(of_gear.modes):
        raise ValueError(f"no mode {number} in gear {of_gear.name}; it has {len(of_gear.modes)}")
    system = vibrating(case, case.gears[number_of_gear - 1])
    assert not isinstance(system, str)  # noqa: S101 - it has modes
    return system.elastic, of_gear.modes[number - 1]


def _compliances(elastic: Sequence[TorsionalDevice]) -> dict[str, float]:
    return {device.name: 1 / (device.stiffness or math.inf) for device in elastic}


def _check_results(results: ByDevice, *, above_0: bool = False) -> None:
    for name, value in results.items():
        if not _is_measured(value, above_0=above_0):
            raise ValueError(f"numbers so large or so small give no value of {quoted(name)}")


def _dampings(decrements: ByDevice, compliances: ByDevice, omega: float) -> dict[str, float]:
    try:
        values = formulas.dampings(decrements, compliances, omega)
    except ZeroDivisionError:
        values = dict.fromkeys(decrements, math.inf)
    _check_results(values)
    return values


def _message_of_missing_device(
    case: Transmission, gear: str, asked: str, elastic: Sequence[str]
) -> str:
    known = f"; elastic are {listed([*map(quoted, elastic)], 12)}"
    if asked in case.devices:
        return f"{quoted(asked)} is not elastic in gear {gear}{known}"
    return f"no elastic component {quoted(asked)}{nearest(asked, elastic) or known}"


def _notes_on_other_devices(
    elastic: Sequence[TorsionalDevice], given: Mapping[str, float], mode: Mode
) -> Iterator[str]:
    """Yield a note on the decrement that the dampings of other components add."""
    decrements: dict[str, float] = {}
    for device in elastic:
        if device.damping and device.name not in given:
            viscous = device.damping.viscous * mode.omega / (device.stiffness or math.inf)
            decrements[device.name] = math.pi * (viscous + device.damping.loss_factor)
    if decrements:
        added = formulas.decrement(decrements, mode.elastic)
        yield f"by its damping in the case {spoken(decrements)} adds {added:.4g} to the decrement"
