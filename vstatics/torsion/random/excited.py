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

from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.system.coordinates import coordinates
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.tolerances import UNMOVED
from vstatics.torsion.vibration.eigen_pairs import massless_parts, resisting_rows, rigid_basis
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
        return self._matrices(self.free.twists, self.free.speeds, np.eye(len(self.free.names)))

    def _matrices(
        self, twists: Floats, speeds: Floats, angles: Floats
    ) -> tuple[Floats, Floats, Floats, Floats]:
        """M, K, D and what is lost of K, by motions with these twists, speeds and angles."""
        system = self.free
        dampings = [one.damping for one in system.elastic]
        viscous = np.array([one.viscous for one in dampings])
        lost = system.rates * np.array([one.loss_factor for one in dampings])
        stiffness, resistance, hysteresis = (
            twists.T @ (sizes[:, None] * twists) for sizes in (system.rates, viscous, lost)
        )
        resistance = resistance + angles.T @ system.slip_resistance @ angles
        return speeds.T @ (system.inertias[:, None] * speeds), stiffness, resistance, hysteresis

    @cached_property
    def unit(self) -> Floats:
        """A motion of the links by 1 of the input: none by a torque."""
        free = coordinates(self.free).free
        moved = free[self.at]
        return free @ (moved / (moved @ moved)) if self.by_motion else np.zeros(len(free))

    def answers(self, forms: Floats, omega: float) -> Complex:
        """What forms of the angles of links are by the input at a frequency [rad/s].

        Raises
        ------
        LinAlgError
            Where an undamped mode is hit.
        """
        mass, stiffness, resistance, hysteresis = self._by_basis
        resisted = omega * resistance + np.sign(omega) * hysteresis
        dynamic: Complex = stiffness - omega**2 * mass + 1j * resisted
        right = -dynamic[:-1, -1]
        if not self.by_motion:
            right = right + self._basis[self.at, :-1]
        moved = np.append(np.linalg.solve(dynamic[:-1, :-1], right), 1.0)
        return np.asarray(without_rounding(forms, self._basis) @ moved, np.complex128)

    @cached_property
    def _basis(self) -> Floats:
        """Modes, rigid and massless motions, last the motion by 1 of the input."""
        split = coordinates(self.system)
        parts = [self.natural.shapes, rigid_basis(self.system, split), split.massless]
        return np.column_stack([*parts, self.unit])

    @cached_property
    def _by_basis(self) -> tuple[Floats, Floats, Floats, Floats]:
        """The matrices of `links` by these."""
        twists = without_rounding(self.free.twists, self._basis)
        return self._matrices(twists, self.free.speeds @ self._basis, self._basis)

    @cached_property
    def first_order(self) -> FirstOrder:
        """The first order system; loss factors damp each mode as viscous damping at its omega."""
        split = coordinates(self.system)
        mass, stiffness, _, _ = self.links
        viscous = [
            one._replace(damping=one.damping._replace(loss_factor=0.0))
            for one in self.system.devices
        ]
        rows = resisting_rows(self.system._replace(devices=tuple(viscous)))
        slow, quiet = massless_parts(split, rows, weighted_twists(self.system))
        massive = np.hstack([self.natural.shapes, rigid_basis(self.system, split)])
        at_once = self.unit - massive @ (massive.T @ (mass @ self.unit))
        force = np.zeros(len(mass))
        force[self.at] = not self.by_motion
        if quiet.shape[1]:
            right = quiet.T @ (force - stiffness @ at_once)
            at_once = at_once + quiet @ np.linalg.solve(quiet.T @ stiffness @ quiet, right)
        return self._first_order(massive, slow, force, at_once)

    def _first_order(
        self, massive: Floats, slow: Floats, force: Floats, at_once: Floats
    ) -> FirstOrder:
        omegas, light = self.natural.omegas, slow.shape[1]
        modes, heavy = len(omegas), massive.shape[1]
        matrix, by_input, by_rate = self._rates(massive, slow, force, at_once)
        angles, drift = np.zeros((len(massive), len(matrix))), np.zeros((len(massive), len(matrix)))
        angles[:, :modes], angles[:, modes : modes + light] = massive[:, :modes] / omegas, slow
        drift[:, len(matrix) - heavy + modes :] = massive[:, modes:]
        return FirstOrder(
            matrix,
            by_input + matrix @ by_rate,
            angles,
            drift,
            at_once + angles @ by_rate,
            drift @ by_rate,
        )

    def _rates(
        self, massive: Floats, slow: Floats, force: Floats, at_once: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Rates of states by states, by the input, by its rate."""
        _, stiffness, resistance, hysteresis = self.links
        omegas, light, heavy = self.natural.omegas, slow.shape[1], massive.shape[1]
        modes, size = len(omegas), len(omegas) + light + heavy
        angle, creep = slice(modes), slice(modes, modes + light)
        speed, swing = slice(modes + light, size), slice(modes + light, 2 * modes + light)
        matrix, by_input, by_rate = np.zeros((size, size)), np.zeros(size), np.zeros(size)
        matrix[angle, swing], matrix[swing, angle] = np.diag(omegas), -np.diag(omegas)
        matrix[speed, speed] = -massive.T @ resistance @ massive
        roots = massive[:, :modes] / np.sqrt(omegas)
        matrix[swing, swing] -= roots.T @ hysteresis @ roots
        by_input[speed] = massive.T @ (force - stiffness @ at_once)
        by_rate[speed] = -massive.T @ resistance @ at_once
        if light:
            rates = linalg.solve(slow.T @ resistance @ slow, slow.T)
            matrix[creep, creep] = -rates @ stiffness @ slow
            matrix[creep, speed] = -rates @ resistance @ massive
            by_input[creep] = rates @ (force - stiffness @ at_once)
            by_rate[creep] = -rates @ resistance @ at_once
            coupled = massive.T @ resistance @ slow
            for made in (matrix, by_input, by_rate):
                made[speed] -= coupled @ made[creep]
        return matrix, by_input, by_rate


def without_rounding(left: Floats, right: Floats) -> Floats:
    """A product of matrices, 0 where it is rounding."""
    made = left @ right
    return np.where(np.abs(made) > UNMOVED * (np.abs(left) @ np.abs(right)), made, 0.0)
