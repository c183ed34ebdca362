"""Dry friction of springs under a harmonic torque, as an equivalent damper.

The friction M of a spring, whose twist has the amplitude A at the frequency w, dissipates as much
as the damper ``4 M/(pi A w)``. The torque of this damper has the amplitude ``4 M/pi`` for any A, in
phase with the rate of twist. Under a smaller torque the spring is stuck: it does not twist.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import (
    ACCEPTED_FRICTION,
    NO_FRICTION,
    SETTLED_FRICTION,
    SINGULAR,
)

_MOST_FRICTION_SWEEPS = 40
"""Largest number of passes that update the torque of each spring in turn."""
_MOST_FRICTION_STEPS = 60
"""Largest number of Newton steps for frequencies at which the passes do not converge."""
_MOST_NEWTON_HALVINGS = 12
"""Largest number of times that a Newton step is halved."""
_RATE_SCALES = (1.0, 0.1, 10.0, 0.01, 100.0)
"""Scales of the rate of twist in Newton's method, tried in turn. [-]"""


def sliding_torque(spring: Spring) -> float:
    """Return the amplitude of the friction torque of a sliding spring [N*m]."""
    return 4 / math.pi * spring.friction


class DryFriction(NamedTuple):
    """Springs with dry friction in a gear."""

    names: tuple[str, ...]
    rows: Floats
    """Matrix from angles of links to twists of the springs, shape (springs, links)."""
    limits: Floats
    """Amplitude ``4 M/pi`` of the friction torque of each spring during sliding. [N*m]"""

    @classmethod
    def of(cls, case: Transmission, system: TorsionalSystem) -> DryFriction:
        """Return the springs with dry friction of a case."""
        twists = {device.name: device.twist for device in (*system.devices, *system.dampers)}
        springs = [spring for spring in case.springs if spring.friction and spring.name in twists]
        names = tuple(spring.name for spring in springs)
        limits = np.array([*map(sliding_torque, springs)])
        return cls(names, system.rows([twists[name] for name in names]), limits)

    def torques(
        self, amplitudes: Complex, by_torque: Sequence[Complex], omegas: Floats
    ) -> dict[str, Complex]:
        """Return the friction torque of each spring, complex, shape (frequencies,) [N*m].

        Parameters
        ----------
        amplitudes : ndarray, shape (links, frequencies)
            Amplitudes of the links without friction. [rad]
        by_torque : sequence of ndarray, shape (links, frequencies)
            For each spring, amplitudes of the links under 1 N*m that twists it. [rad]
        omegas : ndarray, shape (frequencies,)
            Angular frequencies; at 0 there is no friction. [rad/s]
        """
        if not self.names:
            return {}
        free = (self.rows @ amplitudes).T
        receptance = np.stack([(self.rows @ columns).T for columns in by_torque], axis=2)
        # At a negative frequency the rate of twist has the opposite phase.
        sign = np.where(omegas < 0, -1.0, 1.0)[:, None]
        torques = sign * friction_torques(free, sign[:, None] * receptance, self.limits)
        torques[omegas == 0] = 0.0
        return dict(zip(self.names, torques.T, strict=True))


def friction_torques(free: Complex, receptance: Complex, limits: Floats) -> Complex:
    """Return the torques of dry friction at given frequencies.

    Each torque resists the resulting twist ``free - receptance @ torques``.

    Parameters
    ----------
    free : ndarray, shape (frequencies, springs)
        Twists without friction. [rad]
    receptance : ndarray, shape (frequencies, springs, springs)
        Twist of each spring per unit torque on each spring. [rad/(N*m)]
    limits : ndarray, shape (springs,)
        Amplitude of the torque of each spring while it slides. [N*m]

    Returns
    -------
    ndarray, shape (frequencies, springs)
        Complex torques; NaN where no solution was found. [N*m]

    Examples
    --------
    A spring of 100 N*m/rad with a limit of 3 N*m slides under 5 N*m with 4/100 rad, and is stuck
    under 2 N*m:

    >>> torques = friction_torques(
    ...     np.array([[0.05], [0.02]], complex), np.full((2, 1, 1), 0.01 + 0j), np.array([3.0])
    ... )
    >>> (np.abs(np.array([[0.05], [0.02]]) - 0.01 * torques)).round(12).tolist()
    [[0.04], [0.0]]
    """
    torques = np.zeros_like(free)
    diagonal = np.diagonal(receptance, axis1=1, axis2=2)
    unsettled = np.arange(len(free))
    for _ in range(_MOST_FRICTION_SWEEPS):
        before = torques[unsettled]
        for spring, limit in enumerate(limits):
            others = (receptance[unsettled, spring] * torques[unsettled]).sum(axis=1)
            alone = diagonal[unsettled, spring]
            left = free[unsettled, spring] - others + alone * torques[unsettled, spring]
            torques[unsettled, spring] = _torque_alone(left, alone, float(limit))
        change = np.abs(torques[unsettled] - before) > SETTLED_FRICTION * limits
        unsettled = unsettled[change.any(axis=1)]
        if not len(unsettled):
            return torques
    last = torques[unsettled]
    for origin, factor in product((1.0, 0.0), _RATE_SCALES):
        start = origin * last
        parts = free[unsettled], receptance[unsettled]
        torques[unsettled] = _newton(*parts, limits, start, factor)
        left_open = np.isnan(torques[unsettled]).any(axis=1)
        if not left_open.any():
            break
        unsettled, last = unsettled[left_open], last[left_open]
    return torques


def _torque_alone(left: Complex, alone: Complex, limit: float) -> Complex:
    """Return the torque of a spring from its twist `left` without torque and receptance `alone`."""
    stuck = np.abs(left) <= limit * np.abs(alone)
    resisted, size = limit * alone.imag, np.abs(left) ** 2 - (limit * np.abs(alone)) ** 2
    with np.errstate(all="ignore"):
        amplitude = resisted + np.sqrt(resisted**2 + np.where(stuck, 0.0, size))
        phase = left / (amplitude + 1j * limit * alone)
        sliding = 1j * limit * phase / np.abs(phase)
        holding = np.where(alone == 0, 0.0, left / alone)
    torque: Complex = np.where(stuck, holding, sliding)
    return torque


def _newton(
    free: Complex, receptance: Complex, limits: Floats, torques: Complex, factor: float
) -> Complex:
    """Return the torques by a semismooth Newton method, NaN where it does not converge.

    A complex torque T is in a disc whose radius is its limit: inside if the spring is stuck, on the
    edge if it slides. In both states T is the point of the disc nearest to T plus the scaled rate
    of twist.
    """
    count = len(limits)
    sizes = np.abs(np.diagonal(receptance, axis1=1, axis2=2))
    scale = factor / np.where(sizes, sizes, 1.0)
    turned = -1j * scale[:, :, None] * receptance + np.eye(count)
    slopes = np.block([[turned.real, -turned.imag], [turned.imag, turned.real]])
    constant = 1j * scale * free

    def gap(at: Complex) -> tuple[Complex, Complex]:
        wanted = constant + (turned @ at[:, :, None])[:, :, 0]
        near = np.minimum(1.0, limits / np.maximum(np.abs(wanted), NO_FRICTION))
        return at - wanted * near, wanted

    for _ in range(_MOST_FRICTION_STEPS):
        error, wanted = gap(torques)
        size = np.abs(error / limits).max(axis=1)
        unsettled = size > SETTLED_FRICTION
        if not unsettled.any():
            return torques
        length = np.maximum(np.abs(wanted), NO_FRICTION)
        slides, unit = length > limits, wanted / length
        part = np.where(slides, limits / length, 1.0)
        along = np.concatenate([unit.real, unit.imag], axis=1) * np.tile(slides, 2)
        parts = np.tile(part, 2)
        pairs = np.tile(np.eye(count), (2, 2))
        disc = parts[:, :, None] * (np.eye(2 * count) - along[:, :, None] * along[:, None] * pairs)
        jacobian = np.eye(2 * count) - disc @ slopes
        given = np.concatenate([error.real, error.imag], axis=1)
        regular = jacobian + SINGULAR * np.eye(2 * count)
        change = np.linalg.solve(regular, given[:, :, None])[:, :, 0]
        step = change[:, :count] + 1j * change[:, count:]
        share = np.ones(len(torques))
        for _ in range(_MOST_NEWTON_HALVINGS):
            shorter = np.abs(gap(torques - share[:, None] * step)[0] / limits).max(axis=1)
            share = np.where(shorter < size, share, share / 2)
        torques = torques - (share * unsettled)[:, None] * step
    return np.where((size > ACCEPTED_FRICTION)[:, None], np.nan, torques)
