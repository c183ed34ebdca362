"""Random vibration of the gears of a case: standard deviations, crossing rates and life."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.fields import Carried
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.answer import Failure, Sometimes, json_keys
from vstatics.torsion.forced.harmonic_torques import not_excitable
from vstatics.torsion.random.excited import ExcitedGear
from vstatics.torsion.random.spectra import Spectrum
from vstatics.torsion.random.variances import FormVariances, form_variances
from vstatics.torsion.system.converters import WorkingConverter
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalDevice
from vstatics.torsion.system.state import asked_gears, vibrating
from vstatics.torsion.system.working_points import Ratios, WorkingGear, working_gear
from vstatics.torsion.vibration.damped import damped_modes

Excitation = Literal["torque", "motion"]
"""Excitation that a spectrum describes: torque on a link, or angle of the link."""


class RandomDevice(NamedTuple):
    """Random vibration of an elastic component; NaN for quantities without a variance."""

    twist_rms: float
    """Standard deviation of the twist. [rad]"""
    twist_rate_rms: float
    """Standard deviation of the rate of twist. [rad/s]"""
    torque_rms: float
    """Standard deviation of the torque of spring and damper. [N*m]"""
    crossings: float
    """Rate of upward crossings of the mean. [1/s]"""
    life: Sometimes[float] = None
    """Life of a component with a fatigue strength; infinite if unlimited. [s]"""


class RandomLink(NamedTuple):
    """Random vibration of a link; NaN for quantities without a variance."""

    rms: float
    """Standard deviation of the angle. [rad]"""
    velocity_rms: float
    """Standard deviation of the velocity. [rad/s]"""
    acceleration_rms: float
    """Standard deviation of the acceleration. [rad/s^2]"""


class RandomSpectrum(NamedTuple):
    """Spectra of the excitation and of twists, over frequency."""

    omega: Floats
    """Frequencies. [rad/s]"""
    input: Floats
    """Spectrum of the torque or angle that excites. [(N*m)^2*s/rad or rad^2*s/rad]"""
    devices: Mapping[str, Floats]
    """Spectra of the twists of components, by name. [rad^2*s/rad]"""


@json_keys("name", "devices", "links", "half_widths", "spectrum", "converters", "error")
class GearRandom(NamedTuple):
    """Random vibration of a gear."""

    name: str
    devices: Mapping[str, RandomDevice] = EMPTY
    links: Mapping[str, RandomLink] = EMPTY
    half_widths: Sequence[float] = ()
    """Half width, at half of the squared amplitude, of the resonance peak of each mode. [rad/s]

    This is ``-Re s`` of the eigenvalue s of the mode.
    """
    spectrum: Sometimes[RandomSpectrum] = None
    error: Failure = ""
    converters: Sometimes[Mapping[str, WorkingConverter]] = None
    """Converters by name, linearised at operating points."""


@refusing()
def random_vibration(  # noqa: PLR0913 - all but the first by name
    case: Transmission,
    at: int | str,
    spectrum: Spectrum,
    gears: Sequence[int | str] | None = None,
    *,
    by: Excitation = "torque",
    omegas: Sequence[float] | Floats | None = None,
    speed_ratios: Ratios = EMPTY,
) -> list[GearRandom]:
    """Calculate the random vibration of the gears of a case.

    Parameters
    ----------
    case : Transmission
    at : int or str
        Number or name of the excited link.
    spectrum : Spectrum
        Two-sided spectrum of the torque [N*m] or of the angle [rad] of the link.
    gears : sequence of int or str, optional
        Numbers (from 1) or names of gears. By default all gears.
    by : {"torque", "motion"}
        Quantity that the spectrum describes.
    omegas : array_like, optional
        Frequencies at which spectra are returned. [rad/s]
    speed_ratios : mapping of str to float, optional
        Speed ratios by name of the converter, instead of the ratios in the gear. [-]

    Returns
    -------
    list of GearRandom
        For each gear: standard deviations of torques [N*m], twists [rad] and motions of links, and
        life of components [s].

    Raises
    ------
    ValueError
        If a link, gear or converter does not exist.
    CaseError
        If a converter has no operating point, or if the spectrum is not valid.

    Examples
    --------
    Under a white torque of spectrum S, the twist of a spring k with the damping c, which supports a
    mass, has the variance ``pi S/(k c)``:

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.random.spectra import White
    >>> mount = Spring({1: 1}, stiffness=200.0, damping=3.0, name="mount")
    >>> case = Transmission(1, [], [], [], springs=[mount], inertias={1: 2.0})
    >>> [gear] = random_vibration(case, 1, White(1.0))
    >>> round(gear.devices["mount"].twist_rms ** 2 * 600 / math.pi, 9)
    1.0
    """
    if problems := list(spectrum.problems()):
        raise CaseError(problems)
    link = case.link_number(at) - 1
    working = [working_gear(case, gear, speed_ratios) for gear in asked_gears(case, gears)]
    grid = None if omegas is None else np.asarray(omegas, float)
    return [_gear_random(gear, link, by, spectrum, grid) for gear in working]


def _gear_random(
    working: WorkingGear, at: int, by: Excitation, spectrum: Spectrum, omegas: Floats | None
) -> GearRandom:
    case, gear, converters, *_ = working
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearRandom(gear.name, error=system)
    system = system._replace(converters=converters)
    if error := not_excitable(system, coordinates(system), at):
        return GearRandom(gear.name, error=error)
    excited = ExcitedGear(system, at, by == "motion")
    of_links = np.eye(len(system.names))[: system.case_links]
    with np.errstate(all="ignore"):  # undefined values become NaN
        variances = form_variances(excited, spectrum, np.vstack([system.twists, of_links]))
        devices = _devices(system.elastic, variances, of_stress(case.fatigue))
        undetermined = coordinates(excited.free).undetermined[: excited.free.case_links]
        parts = np.array(variances[:3])[:, len(devices) :]
        parts[:, undetermined] = np.nan
        links = {
            name: RandomLink(*np.sqrt(part).tolist())
            for name, part in zip(system.names, parts.T, strict=False)
        }
        spectra = None if omegas is None else _spectrum(excited, spectrum, omegas)
    by_name = {converter.name: converter for converter in converters}
    widths = _half_widths(excited)
    return GearRandom(gear.name, devices, links, widths, spectra, converters=by_name)


def of_stress(strengths: Mapping[str, Carried]) -> dict[str, Carried]:
    """Return the fatigue strengths of whole components, not of their members."""
    return {name: given for name, given in strengths.items() if hasattr(given, "endurance")}


def _devices(
    elastic: Sequence[TorsionalDevice], variances: FormVariances, strengths: Mapping[str, Carried]
) -> dict[str, RandomDevice]:
    devices = {}
    for number, device in enumerate(elastic):
        twist, rate = (math.sqrt(part[number]) for part in variances[:2])
        k, c = device.rate, device.damping.viscous
        lost = k * device.damping.loss_factor
        # The torque is |k + i (lost + c omega)| times the twist, which is uncorrelated with its
        # rate.
        torque = math.hypot(k * twist, lost * twist, c * rate if c else 0.0)
        if c and lost and variances.between is not None:
            torque = math.sqrt(torque**2 + 2 * c * lost * float(variances.between[number]))
        crossings = rate / twist / (2 * math.pi) if twist else math.nan
        strength = strengths.get(device.name)
        # The annex `vehicle` calculates life under the torque of the spring.
        life = higher("torque_life")(strength, k * twist, crossings) if strength else None
        devices[device.name] = RandomDevice(twist, rate, torque, crossings, life)
    return devices


def _half_widths(excited: ExcitedGear) -> list[float]:
    system, split = excited.system, coordinates(excited.system)
    if not system.resists and not any(device.damping for device in system.elastic):
        return [0.0] * len(excited.natural.omegas)
    slowest = -damped_modes(system, split, excited.natural).of_modes[:, 0].real
    return [float(width) + 0.0 for width in slowest]  # + 0.0 avoids -0.0


def _spectrum(excited: ExcitedGear, spectrum: Spectrum, omegas: Floats) -> RandomSpectrum:
    of_input = np.asarray(spectrum.at(omegas))
    answers = np.array([_squares(excited, omega) for omega in omegas.tolist()])
    names = [device.name for device in excited.free.elastic]
    spectra = (of_input[:, None] * answers).T
    return RandomSpectrum(omegas, of_input, dict(zip(names, spectra, strict=True)))


def _squares(excited: ExcitedGear, omega: float) -> Floats:
    """Return the squared frequency response of each twist, NaN at an undamped resonance."""
    twists = excited.free.twists
    try:
        squares = np.abs(excited.answers(twists, omega)) ** 2
    except np.linalg.LinAlgError:
        return np.full(len(twists), np.nan)
    return squares
