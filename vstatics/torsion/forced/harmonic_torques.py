"""Forced vibration: amplitudes of links and torques of components under harmonic torques."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Complex, Floats
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.tables.answer import Failure, Sometimes, json_keys
from vstatics.torsion.forced.cycle import Sum, summed
from vstatics.torsion.forced.dry_friction import DryFriction
from vstatics.torsion.system.converters import WorkingConverter
from vstatics.torsion.system.coordinates import Coordinates, coordinates, form_values
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.system.state import asked_gears, vibrating
from vstatics.torsion.system.working_points import Ratios, WorkingGear, working_gear
from vstatics.torsion.tolerances import LEAST_PARTICIPATION
from vstatics.torsion.vibration.natural import NaturalModes, natural_modes
from vstatics.torsion.vibration.torques import balance, own_torques, with_rigid

MOST_ENTRIES = 1_000_000
"""Largest number of matrix entries in a batch of linear systems, which limits the memory."""


class Harmonic(NamedTuple):
    """Harmonic of the exciting torque.

    Attributes
    ----------
    order : float
        Number of periods per revolution of the excited link. [-]
    amplitude : float
        Amplitude of the torque. [N*m]
    phase : float
        Phase of the torque. [rad]
    by_link : mapping of str to complex
        Complex torques by name of the link, instead of `amplitude` and `phase`. The empty name is
        the excited link of the response. [N*m]

    Examples
    --------
    Firing order of a four-cylinder engine:

    >>> Harmonic(order=2.0, amplitude=150.0).phase
    0.0
    """

    order: float
    amplitude: float = 1.0
    phase: float = 0.0
    by_link: Mapping[str, complex] = EMPTY

    def torques(self, case: Transmission, at: int) -> dict[int, complex]:
        """Return the complex torques [N*m] by link number (from 0); `at` is the excited link.

        Raises
        ------
        CaseError
            If a link of `by_link` does not exist, or moves along a line.
        """
        if not self.by_link:
            return {at: self.amplitude * np.exp(1j * self.phase)}
        torques: dict[int, complex] = {}
        for name, torque in self.by_link.items():
            try:
                link = _rotating(case, name) if name else at
            except ValueError as error:
                raise CaseError("E505", f"link of a harmonic torque: {error}") from None
            torques[link] = torques.get(link, 0.0) + torque
        return torques


class OrderResponse(NamedTuple):
    """Response to an order: complex arrays of shape (speeds,), with NaN for undefined values.

    Attributes
    ----------
    order : float
    amplitudes : mapping
        Amplitudes by name of the link. [rad]
    torques : mapping
        Torques on the first link, by name of the component. [N*m]
    """

    order: float
    amplitudes: Mapping[str, Complex]
    torques: Mapping[str, Complex]


class Resonance(NamedTuple):
    """Speed at which the frequency of an order equals the natural frequency of a mode."""

    order: float
    mode: int
    """Number of the mode among `modes`, from 1."""
    speed: float
    """Speed of the excited link. [rpm]"""
    participation: float
    """Largest amplitude of excited links in the mode, relative to the largest of all links. [-]"""
    damped: bool = True
    """True if the mode is damped; the response of an undamped mode is unbounded."""


class SummedResponse(NamedTuple):
    """Sums of all orders, by names of links and components as in `OrderResponse`."""

    amplitudes: Mapping[str, Sum]
    torques: Mapping[str, Sum]


@json_keys("name", "speeds", "orders", "sum", "resonances", "converters", "error")
class GearResponse(NamedTuple):
    """Response of a gear to all orders."""

    name: str
    speeds: Floats
    """Requested speeds, and resonances of damped modes between them. [rpm]"""
    orders: Sequence[OrderResponse] = ()
    resonances: Sequence[Resonance] = ()
    error: Failure = ""
    sum: Sometimes[SummedResponse] = None
    """Sum of all orders, if requested."""
    converters: Sometimes[Mapping[str, WorkingConverter]] = None
    """Converters by name, linearised at operating points."""

    def with_sum(self) -> GearResponse:
        """Return the response with the sum of all orders added."""
        orders = [response.order for response in self.orders]

        def total(by_order: Sequence[Mapping[str, Complex]]) -> dict[str, Sum]:
            sums = summed(orders, [np.array([*by_name.values()]) for by_name in by_order])
            return dict(zip(by_order[0], map(Sum, *sums), strict=True))

        parts = [r.amplitudes for r in self.orders], [r.torques for r in self.orders]
        return self._replace(sum=SummedResponse(*map(total, parts))) if orders else self


@refusing()
def response(  # noqa: PLR0913 - all but the first by name
    case: Transmission,
    at: int | str,
    harmonics: Sequence[Harmonic],
    speeds: Sequence[float] | Floats,
    gears: Sequence[int | str] | None = None,
    *,
    speed_ratios: Ratios = EMPTY,
) -> list[GearResponse]:
    """Calculate the forced vibration of the gears of a case.

    The equation is ``(K + i omega D + i sgn(omega) H - omega^2 M) q = Q``, with stiffness K,
    viscous damping D, hysteretic damping H (loss factor times stiffness, at any frequency), inertia
    M, the amplitudes q and the exciting torque Q. The dry friction M of a spring is the damper
    ``4 M/(pi A omega)`` at the amplitude A of its twist, for each order alone; a smaller torque
    does not move the spring.

    Parameters
    ----------
    case : Transmission
    at : int or str
        Number or name of the link on which the torque acts.
    harmonics : sequence of Harmonic
    speeds : array_like
        Speeds of the link `at`. Resonances of damped modes between these speeds are added. [rpm]
    gears : sequence of int or str, optional
        Numbers (from 1) or names of gears. By default all gears.
    speed_ratios : mapping of str to float, optional
        Speed ratios by name of the converter, instead of the ratios in the gear. [-]

    Returns
    -------
    list of GearResponse
        For each gear: complex amplitudes of links [rad] and torques of components [N*m] for each
        order, and resonances.

    Raises
    ------
    ValueError
        If a link, gear or converter does not exist.
    CaseError
        If an excited link does not rotate but moves along a line.

    Examples
    --------
    A mass of 2 kg*m^2 on 200 N*m/rad has the amplitude ``1/|200 - 2*64|`` rad at omega = 8 rad/s:

    >>> from vstatics import Spring, Transmission
    >>> spring = Spring({1: 1}, stiffness=200.0, name="mount")
    >>> case = Transmission(1, [], [], [], springs=[spring], inertias={1: 2.0})
    >>> [gear] = response(case, 1, [Harmonic(2.0)], [4.0 / RAD_PER_RPM])
    >>> abs(gear.orders[0].amplitudes["1"]).round(6), gear.resonances
    (array([0.013889]), [])
    """
    chosen = asked_gears(case, gears)
    link, given = _rotating(case, at), np.asarray(speeds, dtype=np.float64)
    working = [working_gear(case, gear, speed_ratios) for gear in chosen]
    return [_gear_response(gear, link, harmonics, given) for gear in working]


def _rotating(case: Transmission, link: int | str) -> int:
    """Return the number (from 0) of a link that rotates.

    Raises
    ------
    ValueError
        If the link does not exist.
    CaseError
        If the link moves along a line.
    """
    if (number := case.link_number(link)) in case.masses:
        raise CaseError(
            "E547",
            f"link {link} moves straight, so it has no revolutions: expected a link that rotates",
            ("masses", number),
        )
    return number - 1


def _gear_response(
    working: WorkingGear, at: int, harmonics: Sequence[Harmonic], speeds: Floats
) -> GearResponse:
    case, gear, converters, *_ = working
    system = vibrating(case, gear)
    if isinstance(system, str):
        return GearResponse(gear.name, speeds, error=system)
    system, split = system._replace(converters=converters), coordinates(system)
    exciting = [harmonic.torques(case, at) for harmonic in harmonics]
    for link in dict.fromkeys(chain(*exciting)):
        if error := not_excitable(system, split, link):
            return GearResponse(gear.name, speeds, error=error)
    natural = natural_modes(system, split)
    undamped = _are_undamped(system, natural)
    largest = np.abs(natural.shapes[: system.case_links]).max(axis=0)
    parts = np.abs(natural.shapes) / np.where(largest, largest, 1.0)
    low = speeds.min(initial=math.inf) * (1 - NO_POWER)
    high = speeds.max(initial=-math.inf) * (1 + NO_POWER)
    resonances = [
        Resonance(harmonic.order, mode, speed, part, not undamped[mode - 1])
        for harmonic, torques in zip(harmonics, exciting, strict=True)
        for mode, (omega, part) in enumerate(
            zip(natural.omegas.tolist(), parts[[*torques]].max(axis=0).tolist(), strict=True), 1
        )
        if part > LEAST_PARTICIPATION
        and low <= (speed := omega / harmonic.order / RAD_PER_RPM) <= high
    ]
    speeds = _with_peaks(speeds, [resonance.speed for resonance in resonances if resonance.damped])
    orders = []
    friction = DryFriction.of(case, system)
    for harmonic, torques in zip(harmonics, exciting, strict=True):
        with np.errstate(over="ignore", invalid="ignore"):  # speeds out of range give NaN
            omegas = harmonic.order * RAD_PER_RPM * speeds
            moved = partial(_amplitudes, system, split, omegas, natural.omegas[undamped])
            by_link = [torque * moved(split.free[link]) for link, torque in torques.items()]
            amplitudes: Complex = np.sum(by_link, axis=0)
            by_torque = [moved(row @ split.free) for row in friction.rows]
            resisting = friction.torques(amplitudes, by_torque, omegas)
            for name, columns in zip(friction.names, by_torque, strict=True):
                amplitudes -= columns * resisting[name]
            by_device = _torques(system, torques, omegas, amplitudes, resisting)
            named = own_torques(case, system, by_device, amplitudes * omegas**2)
        amplitudes[split.undetermined] = np.nan
        links = dict(zip(system.names[: system.case_links], amplitudes, strict=False))
        orders.append(OrderResponse(harmonic.order, links, named))
    by_name = {converter.name: converter for converter in converters}
    return GearResponse(gear.name, speeds, orders, resonances, converters=by_name)


def not_excitable(system: TorsionalSystem, split: Coordinates, at: int) -> str:
    """Return the reason why link number `at` (from 0) cannot be excited, or an empty text."""
    excitable = ~split.undetermined & split.free.any(axis=1)
    if excitable[at]:
        return ""
    why = "has no inertia and no resistance" if split.undetermined[at] else "stands still"
    others = [name for name, can in zip(system.names, excitable, strict=True) if can]
    other = f"expected another, such as {', '.join(others[:3]) or 'one with an inertia'}"
    return f"link {system.names[at]} {why}: {other}"


def _are_undamped(system: TorsionalSystem, natural: NaturalModes) -> Booleans:
    """Return a flag for each mode: True if it dissipates no energy."""
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


def _with_peaks(speeds: Floats, peaks: Sequence[float]) -> Floats:
    """Insert each peak between the neighbouring speeds that enclose it, rising or falling [rpm]."""
    places: list[int] = []
    inserted: list[float] = []
    for speed in set(peaks):
        if not (np.abs(speeds - speed) <= NO_POWER * speed).any():
            between = np.flatnonzero((speeds[:-1] < speed) != (speeds[1:] < speed)).tolist()
            places += between
            inserted += [speed] * len(between)
    rises = np.sign(np.diff(speeds))[places]
    order = np.lexsort((np.array(inserted) * rises, np.array(places)))
    return np.insert(speeds, np.array(places, int)[order] + 1, np.array(inserted)[order])


def _amplitudes(
    system: TorsionalSystem, split: Coordinates, omegas: Floats, undamped: Floats, forces: Floats
) -> Complex:
    """Return the amplitudes of links under generalised forces, shape (links, speeds) [rad].

    Amplitudes are NaN at the frequency of an undamped mode. They are NaN at frequency 0, too, if a
    motion without twist is possible.
    """
    unbounded = np.any(np.abs(omegas[:, None] - undamped) <= NO_POWER * undamped, axis=1)
    unbounded |= (omegas == 0) & (split.rigid.shape[1] > 0)
    bounded = np.flatnonzero(~unbounded)
    free = split.free
    matrices = system.matrices(system.twists @ free, system.speeds @ free, free)
    amplitudes = np.full((len(system.names), len(omegas)), np.nan, complex)
    batches = math.ceil(len(bounded) * free.shape[1] ** 2 / MOST_ENTRIES)
    for batch in np.array_split(bounded, max(1, batches)):
        amplitudes[:, batch] = free @ _solved(matrices, forces, omegas[batch]).T
    return amplitudes


def _solved(
    matrices: tuple[Floats, Floats, Floats, Floats], forces: Floats, omegas: Floats
) -> Complex:
    """Return the amplitudes of the free coordinates, shape (speeds, coordinates)."""
    mass, stiffness, resistance, hysteresis = matrices
    omega = omegas[:, None, None]
    dynamic = stiffness + 1j * (omega * resistance + np.sign(omega) * hysteresis) - omega**2 * mass
    sizes = np.diag(stiffness) + omegas[:, None] ** 2 * np.diag(mass)
    scale = 1 / np.sqrt(np.where(sizes, sizes, 1.0))
    scaled = dynamic * scale[:, :, None] * scale[:, None, :]
    forced = (forces * scale)[:, :, None].astype(complex)
    try:
        solved: Complex = np.linalg.solve(scaled, forced)
    except np.linalg.LinAlgError:  # a matrix in the batch is singular
        if len(omegas) == 1:
            return np.full(scale.shape, np.nan, complex)
        each = [_solved(matrices, forces, omegas[[n]]) for n in range(len(omegas))]
        return np.concatenate(each)
    return solved[:, :, 0] * scale


def _torques(
    system: TorsionalSystem,
    exciting: Mapping[int, complex],
    omegas: Floats,
    amplitudes: Complex,
    friction: Mapping[str, Complex],
) -> dict[str, Complex]:
    """Return the torques on first links of components by name, each of shape (speeds,) [N*m].

    Parameters
    ----------
    exciting : mapping of int to complex
        Torques by index of the excited link. [N*m]
    friction : mapping of str to ndarray
        Torques of dry friction, by the names of springs. [N*m]
    """
    acting = np.asarray(system.link_inertias)[:, None] * amplitudes * omegas**2
    for link, torque in exciting.items():
        acting[link] += torque
    elastic: dict[str, Complex] = {}
    for device in system.elastic:
        damping, rate = device.damping, device.rate
        resisted = omegas * damping.viscous + np.sign(omegas) * rate * damping.loss_factor
        elastic[device.name] = (rate + 1j * resisted) * form_values(device.twist, amplitudes)
        elastic[device.name] += friction.get(device.name, 0.0)
    slipping = 1j * omegas * (system.slip_resistance @ amplitudes)
    for damper in system.dampers:
        for link, part in damper.twist.items():
            slipping[link] += part * friction.get(damper.name, 0.0)
    torques = with_rigid(system, balance(system), acting - slipping, elastic)
    torques |= {
        damper.name: 1j * omegas * damper.damping.viscous * form_values(damper.twist, amplitudes)
        + friction.get(damper.name, 0.0)
        for damper in system.dampers
    }
    speeds = 1j * omegas * amplitudes
    return torques | {
        converter.name: converter.A1 * speeds[converter.pump]
        + converter.A2 * speeds[converter.turbine]
        for converter in system.converters
    }
