"""Random vibration of the gears of a case, by names: deviations, crossings, life."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.extras import higher
from vstatics.core.model.fields import Carried
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.answer import Failure, Sometimes, told
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


class RandomDevice(NamedTuple):
    """An elastic device; NaN of what has no variance."""

    twist_rms: float
    """[rad]"""
    twist_rate_rms: float
    """[rad/s]"""
    torque_rms: float
    """Of spring and damper. [N*m]"""
    crossings: float
    """Of the mean, upward. [1/s]"""
    life: Sometimes[float] = None
    """With a fatigue strength, under the torque of the spring; infinite: for ever. [s]"""


class RandomLink(NamedTuple):
    """A link; NaN of what has no variance."""

    rms: float
    """[rad]"""
    velocity_rms: float
    """[rad/s]"""
    acceleration_rms: float
    """[rad/s^2]"""


class RandomSpectrum(NamedTuple):
    """Spectra over omega."""

    omega: Floats
    """[rad/s]"""
    input: Floats
    devices: Mapping[str, Floats]
    """Of twists. [rad^2*s/rad]"""


@told("name", "devices", "links", "half_widths", "spectrum", "converters", "error")
class GearRandom(NamedTuple):
    """The random vibration of a gear."""

    name: str
    devices: Mapping[str, RandomDevice] = MappingProxyType({})
    links: Mapping[str, RandomLink] = MappingProxyType({})
    half_widths: Sequence[float] = ()
    """Of each mode, half the width of its peak of ``|H|^2`` at half its height, ``-Re s``. [1/s]"""
    spectrum: Sometimes[RandomSpectrum] = None
    error: Failure = ""
    converters: Sometimes[Mapping[str, WorkingConverter]] = None
    """About their working points."""


@refusing()
def random_vibration(  # noqa: PLR0913 - all but the first by name
    case: Transmission,
    at: int | str,
    spectrum: Spectrum,
    gears: Sequence[int | str] | None = None,
    *,
    by: Excitation = "torque",
    omegas: Sequence[float] | Floats | None = None,
    speed_ratios: Ratios = MappingProxyType({}),
) -> list[GearRandom]:
    """The random vibration of the gears of a case.

    Parameters
    ----------
    case : Transmission
    at : int or str
        Number or name of the link that is excited.
    spectrum : Spectrum
        Of its torque [N*m], or of its angle [rad].
    gears : sequence of int or str, optional
        Numbers from 1 or names; all gears when not given.
    by : {"torque", "motion"}
        What the spectrum is of.
    omegas : array_like, optional
        Where spectra are asked for. [rad/s]
    speed_ratios : mapping of str to float, optional
        Of converters, in place of those of the gears. [-]

    Returns
    -------
    list of GearRandom
        Standard deviations of torques [N*m], twists [rad] and others, the life of devices.

    Raises
    ------
    ValueError
        If there is no such link, gear or converter.
    CaseError
        If a converter has no working point, or the spectrum is none.

    Examples
    --------
    White torque S on a mass J on a spring: the variance of the twist is ``pi S/(k c)``.

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
    asked = [working_gear(case, gear, speed_ratios) for gear in asked_gears(case, gears)]
    grid = None if omegas is None else np.asarray(omegas, float)
    return [_gear_random(one, link, by, spectrum, grid) for one in asked]


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
    own = np.eye(len(system.names))[: system.case_links]
    with np.errstate(all="ignore"):  # what is no number is told as none
        found = form_variances(excited, spectrum, np.vstack([system.twists, own]))
        devices = _devices(system.elastic, found, case.fatigue)
        links = _links(system.names, excited, found, len(devices))
        made = None if omegas is None else _spectrum(excited, spectrum, omegas)
    by_name = {one.name: one for one in converters}
    widths = _half_widths(excited)
    return GearRandom(gear.name, devices, links, widths, made, converters=by_name)


def _devices(
    elastic: Sequence[TorsionalDevice], found: FormVariances, strengths: Mapping[str, Carried]
) -> dict[str, RandomDevice]:
    made = {}
    for number, one in enumerate(elastic):
        twist, rate = (math.sqrt(part[number]) for part in found[:2])
        viscous, lost = one.damping.viscous, one.rate * one.damping.loss_factor
        # twist and rate are not correlated; |k + i lost + i viscous omega|^2 by its parts
        torque = math.hypot(one.rate * twist, lost * twist, viscous * rate if viscous else 0.0)
        if viscous and lost and found.between is not None:
            torque = math.sqrt(torque**2 + 2 * viscous * lost * float(found.between[number]))
        crossings = rate / twist / (2 * math.pi) if twist else math.nan
        strength = strengths.get(one.name)
        life = _life(strength, one.rate * twist, crossings) if strength else None
        made[one.name] = RandomDevice(twist, rate, torque, crossings, life)
    return made


def _life(strength: Carried, deviation: float, crossings: float) -> float:
    """Return the life under the torque of a spring [s], which another annex calculates."""
    life: float = higher("torque_life")(strength, deviation, crossings)
    return life


def _links(
    names: Sequence[str], excited: ExcitedGear, found: FormVariances, first: int
) -> dict[str, RandomLink]:
    own = excited.free.case_links
    loose = coordinates(excited.free).undetermined[:own]
    parts = np.array(found[:3])[:, first:]
    parts[:, loose] = np.nan
    return {
        name: RandomLink(*np.sqrt(part).tolist())
        for name, part in zip(names, parts.T, strict=False)
    }


def _half_widths(excited: ExcitedGear) -> list[float]:
    system, split = excited.system, coordinates(excited.system)
    if not system.resists and not any(device.damping for device in system.elastic):
        return [0.0] * len(excited.natural.omegas)
    slowest = -damped_modes(system, split, excited.natural).of_modes[:, 0].real
    return [float(one) + 0.0 for one in slowest]


def _spectrum(excited: ExcitedGear, spectrum: Spectrum, omegas: Floats) -> RandomSpectrum:
    of_input = np.asarray(spectrum.at(omegas))
    answers = np.array([_squares(excited, omega) for omega in omegas.tolist()])
    names = [one.name for one in excited.free.elastic]
    spectra = (of_input[:, None] * answers).T
    return RandomSpectrum(omegas, of_input, dict(zip(names, spectra, strict=True)))


def _squares(excited: ExcitedGear, omega: float) -> Floats:
    """Of what each twist has of the input at a frequency; NaN where an undamped mode is hit."""
    twists = excited.free.twists
    try:
        squares: Floats = np.abs(excited.answers(twists, omega)) ** 2
    except np.linalg.LinAlgError:
        return np.full(len(twists), np.nan)
    return squares
