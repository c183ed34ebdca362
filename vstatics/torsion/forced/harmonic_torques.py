"""Forced vibration: amplitudes of links and torques of devices under harmonic torques."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Complex, Floats
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.tables.answer import Failure, Sometimes, told
from vstatics.torsion.forced.cycle import Sum, summed
from vstatics.torsion.system.converters import WorkingConverter
from vstatics.torsion.system.coordinates import Coordinates, coordinates, form_values
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import asked_gears, vibrating
from vstatics.torsion.system.working_points import Ratios, WorkingGear, working_gear
from vstatics.torsion.tolerances import LEAST_PARTICIPATION
from vstatics.torsion.vibration.natural import NaturalModes, natural_modes
from vstatics.torsion.vibration.torques import balance, own_torques, with_rigid

ENTRIES = 1_000_000
"""Of the matrices that are solved at once."""


class Harmonic(NamedTuple):
    """A part of the torque that excites.

    Attributes
    ----------
    order : float
        Its frequency by that of a revolution of the link that it acts on. [-]
    amplitude : float
        [N*m]
    phase : float
        [rad]

    Examples
    --------
    The firing order of four cylinders:

    >>> Harmonic(order=2.0, amplitude=150.0)
    Harmonic(order=2.0, amplitude=150.0, phase=0.0)
    """

    order: float
    amplitude: float = 1.0
    phase: float = 0.0


class OrderResponse(NamedTuple):
    """The response to one order; arrays of shape (speeds,), complex, NaN where there is none.

    Attributes
    ----------
    order : float
    amplitudes : mapping
        Of the case's own links. [rad]
    torques : mapping
        On the first links of devices, by the rows of `torques` in results. [N*m]
    """

    order: float
    amplitudes: Mapping[str, Complex]
    torques: Mapping[str, Complex]


class Resonance(NamedTuple):
    """A speed at which an order meets a natural frequency that it can excite."""

    order: float
    mode: int
    """Its number from 1, as in `modes`."""
    speed: float
    """[rpm]"""
    participation: float
    """Amplitude of the link that is excited, by the largest of the mode. [-]"""
    damped: bool = True
    """Whether anything takes energy from the mode; if not, there is no bound at this speed."""


class SummedResponse(NamedTuple):
    """All orders together, by the names of `OrderResponse`."""

    amplitudes: Mapping[str, Sum]
    torques: Mapping[str, Sum]


@told("name", "speeds", "orders", "sum", "resonances", "converters", "error")
class GearResponse(NamedTuple):
    """The response of a gear."""

    name: str
    speeds: Floats
    """Those that were asked for, and between them resonances of modes that are damped. [rpm]"""
    orders: Sequence[OrderResponse] = ()
    resonances: Sequence[Resonance] = ()
    error: Failure = ""
    sum: Sometimes[SummedResponse] = None
    """If it was asked for."""
    converters: Sometimes[Mapping[str, WorkingConverter]] = None
    """About their working points."""

    def with_sum(self) -> GearResponse:
        """The same with all orders together."""
        orders = [one.order for one in self.orders]

        def total(by_order: Sequence[Mapping[str, Complex]]) -> dict[str, Sum]:
            sums = summed(orders, [np.array([*one.values()]) for one in by_order])
            return dict(zip(by_order[0], map(Sum, *sums), strict=True))

        parts = [one.amplitudes for one in self.orders], [one.torques for one in self.orders]
        return self._replace(sum=SummedResponse(*map(total, parts))) if orders else self


@refusing()
def response(  # noqa: PLR0913 - all but the first by name
    case: Transmission,
    at: int | str,
    harmonics: Sequence[Harmonic],
    speeds: Sequence[float] | Floats,
    gears: Sequence[int | str] | None = None,
    *,
    speed_ratios: Ratios = MappingProxyType({}),
) -> list[GearResponse]:
    """The forced vibration of the gears of a case.

    ``(K + i omega D - omega^2 M) q = Q``; a loss factor adds ``i loss_factor K``, at any
    frequency.

    Parameters
    ----------
    case : Transmission
    at : int or str
        Number or name of the link on which the torque acts.
    harmonics : sequence of Harmonic
    speeds : array_like
        Of the link `at`; resonances between them of modes that are damped are added. [rpm]
    gears : sequence of int or str, optional
        Numbers from 1 or names; all gears when not given.
    speed_ratios : mapping of str to float, optional
        Of converters, in place of those of the gears. [-]

    Returns
    -------
    list of GearResponse
        Of each order complex amplitudes of links [rad] and torques of devices [N*m]; resonances.

    Raises
    ------
    ValueError
        If there is no such link, gear or converter.
    CaseError
        If the link moves straight.

    Examples
    --------
    A mass of 2 kg*m^2 on 200 N*m/rad at omega = 8 rad/s: ``1/|200 - 2*64|`` rad.

    >>> from vstatics import Spring, Transmission
    >>> spring = Spring({1: 1}, stiffness=200.0, name="mount")
    >>> case = Transmission(1, [], [], [], springs=[spring], inertias={1: 2.0})
    >>> [gear] = response(case, 1, [Harmonic(2.0)], [4.0 / RAD_PER_RPM])
    >>> abs(gear.orders[0].amplitudes["1"]).round(6), gear.resonances
    (array([0.013889]), [])
    """
    asked = asked_gears(case, gears)
    if (number := case.link_number(at)) in case.masses:
        message = f"link {at} moves straight, so it has no revolutions: expected a link that turns"
        raise CaseError("E547", message, ("masses", number))
    link, given = number - 1, np.asarray(speeds, dtype=np.float64)
    working = [working_gear(case, gear, speed_ratios) for gear in asked]
    return [_gear_response(one, link, harmonics, given) for one in working]


def _gear_response(
    working: WorkingGear, at: int, harmonics: Sequence[Harmonic], speeds: Floats
) -> GearResponse:
    case, gear, converters, *_ = working
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearResponse(gear.name, speeds, error=system)
    system, split = system._replace(converters=converters), coordinates(system)
    if error := not_excitable(system, split, at):
        return GearResponse(gear.name, speeds, error=error)
    natural = natural_modes(system, split)
    undamped = _are_undamped(system, natural)
    largest = np.abs(natural.shapes[: system.case_links]).max(axis=0)
    parts = np.abs(natural.shapes[at]) / np.where(largest, largest, 1.0)
    resonances = [
        one._replace(damped=not undamped[one.mode - 1])
        for one in _resonances(natural.omegas, parts, harmonics, speeds)
    ]
    speeds = _with_peaks(speeds, [one.speed for one in resonances if one.damped])
    found = []
    for one in harmonics:
        with np.errstate(over="ignore", invalid="ignore"):  # of absurd speeds: there is no value
            excited = one.order * RAD_PER_RPM * speeds
            amplitudes = _amplitudes(system, split, at, excited, natural.omegas[undamped])
            amplitudes *= one.amplitude * np.exp(1j * one.phase)
            by_device = _torques(system, at, excited, amplitudes, one)
            named = own_torques(case, system, by_device, amplitudes * excited**2)
        amplitudes[split.undetermined] = np.nan
        links = dict(zip(system.names[: system.case_links], amplitudes, strict=False))
        found.append(OrderResponse(one.order, links, named))
    by_name = {one.name: one for one in converters}
    return GearResponse(gear.name, speeds, found, resonances, converters=by_name)


def not_excitable(system: TorsionalSystem, split: Coordinates, at: int) -> str:
    """Why nothing can excite a link, by its index, if so."""
    excitable = ~split.undetermined & split.free.any(axis=1)
    if excitable[at]:
        return ""
    why = "has no inertia and no resistance" if split.undetermined[at] else "stands still"
    others = [name for name, can in zip(system.names, excitable, strict=True) if can]
    other = f"expected another, such as {', '.join(others[:3])}"
    return f"link {system.names[at]} {why}: {other}"


def _are_undamped(system: TorsionalSystem, natural: NaturalModes) -> Booleans:
    """Of each mode, whether nothing takes energy from it."""
    resisted = np.zeros(natural.omegas.shape)
    stored = np.zeros(natural.omegas.shape)
    for device in system.elastic:
        energy = device.rate * form_values(device.twist, natural.shapes) ** 2
        stored += energy
        resisted += energy * bool(device.damping)
    resisted += natural.omegas * ((system.damper_rows @ natural.shapes) ** 2).sum(axis=0)
    for link in np.flatnonzero(system.converter_resistance.any(axis=0)):
        size = np.abs(system.converter_resistance[:, link]).max()
        resisted += size * natural.omegas * natural.shapes[link] ** 2
    return resisted <= NO_POWER * stored


def _resonances(
    omegas: Floats, parts: Floats, harmonics: Sequence[Harmonic], speeds: Floats
) -> list[Resonance]:
    """Where natural frequencies that are excited are met within the range of speeds."""
    low, high = speeds.min(initial=math.inf), speeds.max(initial=-math.inf)
    met = [
        Resonance(one.order, mode, omega / one.order / RAD_PER_RPM, part)
        for one in harmonics
        for mode, (omega, part) in enumerate(zip(omegas.tolist(), parts.tolist(), strict=True), 1)
        if part > LEAST_PARTICIPATION
    ]
    return [one for one in met if low * (1 - NO_POWER) <= one.speed <= high * (1 + NO_POWER)]


def _with_peaks(speeds: Floats, peaks: Sequence[float]) -> Floats:
    """Speeds in their order, and each peak between two of them."""
    places: list[int] = []
    met: list[float] = []
    for speed in set(peaks):
        if not (np.abs(speeds - speed) <= NO_POWER * speed).any():
            between = np.flatnonzero((speeds[:-1] < speed) != (speeds[1:] < speed)).tolist()
            places += between
            met += [speed] * len(between)
    rises = np.sign(np.diff(speeds))[places]
    order = np.lexsort((np.array(met) * rises, np.array(places)))
    return np.insert(speeds, np.array(places, int)[order] + 1, np.array(met)[order])


def _amplitudes(
    system: TorsionalSystem, split: Coordinates, at: int, excited: Floats, undamped: Floats
) -> Complex:
    """Of all links under 1 N*m, of shape (links, speeds) [rad].

    There is none where an undamped mode is hit, or all turn as one at a speed of 0.
    """
    hit = np.any(np.abs(excited[:, None] - undamped) <= NO_POWER * undamped, axis=1)
    hit |= (excited == 0) & (split.rigid.shape[1] > 0)
    asked = np.flatnonzero(~hit)
    matrices = _matrices(system, split.free)
    found = np.full((len(system.names), len(excited)), np.nan, complex)
    pieces = math.ceil(len(asked) * split.free.shape[1] ** 2 / ENTRIES)
    for part in np.array_split(asked, max(1, pieces)):
        found[:, part] = split.free @ _solved(matrices, split.free[at], excited[part]).T
    return found


def _solved(
    matrices: tuple[Floats, Floats, Floats, Floats], forces: Floats, omegas: Floats
) -> Complex:
    """Amplitudes of free motions, of shape (speeds, motions)."""
    mass, stiffness, resistance, hysteresis = matrices
    omega = omegas[:, None, None]
    dynamic = stiffness + 1j * (omega * resistance + np.sign(omega) * hysteresis) - omega**2 * mass
    sizes = np.diag(stiffness) + omegas[:, None] ** 2 * np.diag(mass)
    scale = 1 / np.sqrt(np.where(sizes, sizes, 1.0))
    scaled = dynamic * scale[:, :, None] * scale[:, None, :]
    forced = (forces * scale)[:, :, None].astype(complex)
    try:
        solved: Complex = np.linalg.solve(scaled, forced)
    except np.linalg.LinAlgError:  # one of them is singular
        if len(omegas) == 1:
            return np.full(scale.shape, np.nan, complex)
        each = [_solved(matrices, forces, omegas[[n]]) for n in range(len(omegas))]
        return np.concatenate(each)
    return solved[:, :, 0] * scale


def _matrices(system: TorsionalSystem, free: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """M, K, D and the part of K that is lost by loss factors, by free motions."""
    bodies, twists = system.speeds @ free, system.twists @ free
    rates = system.rates
    viscous = np.array([device.damping.viscous for device in system.elastic])
    lost = rates * np.array([device.damping.loss_factor for device in system.elastic])
    stiffness, resistance, hysteresis = (
        twists.T @ (by_device[:, None] * twists) for by_device in (rates, viscous, lost)
    )
    resistance += free.T @ system.slip_resistance @ free
    mass = bodies.T @ (system.inertias[:, None] * bodies)
    return mass, stiffness, resistance, hysteresis


def _torques(
    system: TorsionalSystem, at: int, excited: Floats, amplitudes: Complex, given: Harmonic
) -> dict[str, Complex]:
    """On the first links of devices, of shape (speeds,) each [N*m]."""
    acting = np.asarray(system.link_inertias)[:, None] * amplitudes * excited**2
    acting[at] += given.amplitude * np.exp(1j * given.phase)
    elastic: dict[str, Complex] = {}
    for device in system.elastic:
        own, rate = device.damping, device.rate
        resisted = excited * own.viscous + np.sign(excited) * rate * own.loss_factor
        elastic[device.name] = (rate + 1j * resisted) * form_values(device.twist, amplitudes)
    slipping = 1j * excited * (system.slip_resistance @ amplitudes)
    found = with_rigid(system, balance(system), acting - slipping, elastic)
    found |= {
        damper.name: 1j * excited * damper.damping.viscous * form_values(damper.twist, amplitudes)
        for damper in system.dampers
    }
    return found | {
        one.name: _pump_torque(one, 1j * excited * amplitudes) for one in system.converters
    }


def _pump_torque(converter: WorkingConverter, speeds: Complex) -> Complex:
    """What the pump takes beyond its torque at the working point [N*m]."""
    torque: Complex = (
        converter.A1 * speeds[converter.pump] + converter.A2 * speeds[converter.turbine]
    )
    return torque
