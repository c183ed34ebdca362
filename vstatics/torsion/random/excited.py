"""A gear with one input as a first order system: ``x' = A x + b u``, angles ``C x + h u``.

Coordinates are natural modes, rigid motions, and massless ones that creep; of those that follow in
elastic balance the input moves some at once, ``h u``. A link that is moved takes with it, at once,
what is rigid and what is massless and undamped, and no mass: by springs and dampers alone it acts
on these. Rates of the input stand nowhere: ``x`` has moved by their part.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import linalg

from vstatics.numerics.arrays import Complex, Floats
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.vibration.eigen_pairs import (
    massless_parts,
    pencil_of,
    resisting_rows,
    rigid_basis,
)
from vstatics.torsion.vibration.natural import NaturalModes, natural_modes, weighted_twists


@dataclass(frozen=True)
class FirstOrder:
    """The system of states.

    Attributes
    ----------
    matrix : ndarray, shape (states, states)
        Massive coordinates by their frequencies, massless ones, speeds of massive ones.
    input : ndarray, shape (states,)
    angles : ndarray, shape (links, states)
        Of links without what rigid motions add.
    drift : ndarray, shape (links, states)
        Speeds of links in rigid motions.
    at_once, drift_at_once : ndarray, shape (links,)
        Angles of links, and speeds in rigid motions, by the input itself.
    """

    matrix: Floats
    input: Floats
    angles: Floats
    drift: Floats
    at_once: Floats
    drift_at_once: Floats


@dataclass(frozen=True)
class ExcitedGear:
    """A gear with a torque on a link, by its index, or with its motion given."""

    free: TorsionalSystem
    at: int
    by_motion: bool = False

    @cached_property
    def system(self) -> TorsionalSystem:
        """The system, the link held if its motion is given."""
        if not self.by_motion:
            return self.free
        held = TorsionalDevice("", {self.at: 1.0})
        return self.free._replace(devices=(*self.free.devices, held))

    @cached_property
    def natural(self) -> NaturalModes:
        """Its natural modes."""
        return natural_modes(self.system, coordinates(self.system))

    @cached_property
    def lossy(self) -> bool:
        """Whether there are loss factors."""
        return any(one.damping.loss_factor for one in self.system.elastic)

    @cached_property
    def links(self) -> tuple[Floats, Floats, Floats, Floats]:
        """M, K, D and what is lost of K, by links."""
        system = self.free
        dampings = [one.damping for one in system.elastic]
        viscous = np.array([one.viscous for one in dampings])
        lost = system.rates * np.array([one.loss_factor for one in dampings])
        stiffness, resistance, hysteresis = (
            system.twists.T @ (sizes[:, None] * system.twists)
            for sizes in (system.rates, viscous, lost)
        )
        mass = system.speeds.T @ (system.inertias[:, None] * system.speeds)
        return mass, stiffness, resistance + system.slip_resistance, hysteresis

    @cached_property
    def unit(self) -> Floats:
        """A motion of the links by 1 of the input: none by a torque."""
        free = coordinates(self.free).free
        moved = free[self.at]
        return free @ (moved / (moved @ moved)) if self.by_motion else np.zeros(len(free))

    def transfer(self, omega: float) -> Complex:
        """Angles of links by the input at a frequency [rad/s]."""
        mass, stiffness, resistance, hysteresis = self.links
        resisted = omega * resistance + np.sign(omega) * hysteresis
        dynamic: Complex = stiffness - omega**2 * mass + 1j * resisted
        free = self._free
        right = -dynamic @ self.unit
        right[self.at] += 0.0 if self.by_motion else 1.0
        moved = free @ np.linalg.solve(free.T @ dynamic @ free, free.T @ right)
        return np.asarray(self.unit + moved, np.complex128)

    @cached_property
    def _free(self) -> Floats:
        return coordinates(self.system).free

    @cached_property
    def first_order(self) -> FirstOrder:
        """The first order system; a loss factor is viscous damping that is equal at each mode."""
        system, split = self.system, coordinates(self.system)
        mass, stiffness, resistance, _ = self.links
        omegas, rigid = self.natural.omegas, rigid_basis(system, split)
        slow, quiet = massless_parts(split, resisting_rows(system), weighted_twists(system))
        massive = np.hstack([self.natural.shapes, rigid])
        if self.lossy:
            pencil, shapes = pencil_of(system, split, self.natural), self.natural.shapes
            equal = pencil.resistance_of_all(omegas) - pencil.viscous
            back = np.linalg.pinv(np.hstack([shapes, slow]))
            kept = np.r_[0 : len(omegas), pencil.massive : len(equal)]
            resistance = resistance + back.T @ equal[np.ix_(kept, kept)] @ back
        at_once = self.unit - massive @ (massive.T @ (mass @ self.unit))
        force = np.zeros(len(mass))
        force[self.at] = not self.by_motion
        if quiet.shape[1]:
            right = quiet.T @ (force - stiffness @ at_once)
            at_once = at_once + quiet @ np.linalg.solve(quiet.T @ stiffness @ quiet, right)
        return _first_order(_Basis(massive, slow, omegas), stiffness, resistance, force, at_once)


@dataclass(frozen=True)
class _Basis:
    massive: Floats
    slow: Floats
    omegas: Floats


def _first_order(
    basis: _Basis, stiffness: Floats, resistance: Floats, force: Floats, at_once: Floats
) -> FirstOrder:
    massive, slow, omegas = basis.massive, basis.slow, basis.omegas
    modes, heavy, light = len(omegas), massive.shape[1], slow.shape[1]
    size = modes + light + heavy
    angle, creep, speed = slice(modes), slice(modes, modes + light), slice(modes + light, size)
    direct, rates = massive.T @ (force - stiffness @ at_once), -massive.T @ (resistance @ at_once)
    matrix, by_input, by_rate = np.zeros((size, size)), np.zeros(size), np.zeros(size)
    matrix[angle, speed] = np.eye(heavy)[:modes] * omegas[:, None]
    matrix[speed, angle] = -np.eye(heavy)[:, :modes] * omegas
    resisted = massive.T @ resistance @ massive
    matrix[speed, speed] = -resisted
    by_input[speed], by_rate[speed] = direct, rates
    if light:
        inverse = linalg.inv(slow.T @ resistance @ slow)
        matrix[creep, creep] = -inverse @ slow.T @ stiffness @ slow
        matrix[creep, speed] = -inverse @ slow.T @ resistance @ massive
        by_input[creep] = inverse @ slow.T @ (force - stiffness @ at_once)
        by_rate[creep] = -inverse @ slow.T @ (resistance @ at_once)
        coupled = massive.T @ resistance @ slow
        for made in (matrix, by_input, by_rate):
            made[speed] -= coupled @ made[creep]
    angles, drift = np.zeros((len(massive), size)), np.zeros((len(massive), size))
    angles[:, angle], angles[:, creep] = massive[:, :modes] / omegas, slow
    drift[:, modes + light + modes :] = massive[:, modes:]
    return FirstOrder(
        matrix,
        by_input + matrix @ by_rate,
        angles,
        drift,
        at_once + angles @ by_rate,
        drift @ by_rate,
    )
