"""Gear with a single input u as a first-order system ``x' = A x + b u``, with angles ``C x + h u``.

The input u is a torque on a link or the angle of the link. The coordinates are natural modes, rigid
motions and damped massless motions, which creep. Massless motions without damping are in elastic
equilibrium, so that they follow the input immediately: ``h u``. A link with a given motion also
moves rigidly connected links and undamped massless links immediately; it acts on masses through
springs and dampers only. The states are shifted so that the rate of the input does not appear.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import linalg

from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.system.coordinates import coordinates, without_rounding
from vstatics.torsion.system.gear_system import TorsionalDevice, TorsionalSystem
from vstatics.torsion.vibration.eigen_pairs import massless_parts, resisting_rows, rigid_basis
from vstatics.torsion.vibration.natural import NaturalModes, natural_modes, weighted_twists


@dataclass(frozen=True)
class FirstOrder:
    """First-order system of an excited gear; see the module.

    The states are modal coordinates times natural frequencies, coordinates of massless motions, and
    speeds of modes and of rigid motions, in this order.

    Attributes
    ----------
    matrix : ndarray, shape (states, states)
        Matrix A.
    input : ndarray, shape (states,)
        Vector b.
    angles : ndarray, shape (links, states)
        Matrix C: angles of links, without the contribution of rigid motions.
    drift : ndarray, shape (links, states)
        Speeds of links in rigid motions.
    at_once, drift_at_once : ndarray, shape (links,)
        Direct effect of the input on angles of links (vector h), and on speeds in rigid motions.
    """

    matrix: Floats
    input: Floats
    angles: Floats
    drift: Floats
    at_once: Floats
    drift_at_once: Floats


@dataclass(frozen=True)
class ExcitedGear:
    """Gear with a torque on a link, or a given motion of a link, as its input."""

    free: TorsionalSystem
    at: int
    """Index of the excited link."""
    by_motion: bool = False

    @cached_property
    def system(self) -> TorsionalSystem:
        """Torsional system; a link with a given motion is held."""
        if not self.by_motion:
            return self.free
        held = TorsionalDevice("", {self.at: 1.0})
        return self.free._replace(devices=(*self.free.devices, held))

    @cached_property
    def natural(self) -> NaturalModes:
        """Natural modes of the system."""
        return natural_modes(self.system, coordinates(self.system))

    @cached_property
    def lossy(self) -> bool:
        """True if any component has a loss factor."""
        return any(device.damping.loss_factor for device in self.system.elastic)

    @cached_property
    def links(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Matrices for link angles: inertia, stiffness, damping, loss factor times stiffness."""
        system = self.free
        return system.matrices(system.twists, system.speeds, np.eye(len(system.names)))

    @cached_property
    def unit(self) -> Floats:
        """Angles of links per rad of the excited link, shape (links,); 0 if a torque excites it."""
        free = coordinates(self.free).free
        row = free[self.at]
        return free @ (row / (row @ row)) if self.by_motion else np.zeros(len(free))

    def answers(self, forms: Floats, omega: float) -> Complex:
        """Return the complex frequency response of linear forms of link angles, shape (forms,).

        Parameters
        ----------
        forms : ndarray, shape (forms, links)
            Coefficients of the angles of links.
        omega : float
            Frequency of the input. [rad/s]

        Raises
        ------
        LinAlgError
            At the frequency of an undamped mode.
        """
        mass, stiffness, resistance, hysteresis = self._by_basis
        resisted = omega * resistance + np.sign(omega) * hysteresis
        dynamic = stiffness - omega**2 * mass + 1j * resisted
        right = -dynamic[:-1, -1]
        if not self.by_motion:
            right = right + self._basis[self.at, :-1]
        response = np.append(np.linalg.solve(dynamic[:-1, :-1], right), 1.0)
        return np.asarray(without_rounding(forms, self._basis) @ response, np.complex128)

    @cached_property
    def _basis(self) -> Floats:
        """Coordinates of the gear as columns of link angles, shape (links, coordinates).

        They are modes, rigid motions, massless motions, and finally the motion `unit`.
        """
        split = coordinates(self.system)
        parts = [self.natural.shapes, rigid_basis(self.system, split), split.massless]
        return np.column_stack([*parts, split.drifting, self.unit])

    @cached_property
    def _by_basis(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Matrices of `links`, for the coordinates of `_basis`."""
        twists = without_rounding(self.free.twists, self._basis)
        return self.free.matrices(twists, self.free.speeds @ self._basis, self._basis)

    @cached_property
    def first_order(self) -> FirstOrder:
        """First-order system; loss factors become equivalent viscous damping of modes."""
        split = coordinates(self.system)
        mass, stiffness, _, _ = self.links
        viscous, _ = self.system.dampings
        rows = resisting_rows(self.system, viscous)
        slow, quiet = massless_parts(split, rows, weighted_twists(self.system))
        slow = np.hstack([slow, split.drifting])
        massive = np.hstack([self.natural.shapes, rigid_basis(self.system, split)])
        at_once = self.unit - massive @ (massive.T @ (mass @ self.unit))
        force = np.zeros(len(mass))
        force[self.at] = not self.by_motion
        if quiet.shape[1]:
            right = quiet.T @ (force - stiffness @ at_once)
            at_once = at_once + quiet @ np.linalg.solve(quiet.T @ stiffness @ quiet, right)
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
        """Return A, b and c of ``x' = A x + b u + c u'``, before a shift of states removes c."""
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
            for array in (matrix, by_input, by_rate):
                array[speed] -= coupled @ array[creep]
        return matrix, by_input, by_rate
