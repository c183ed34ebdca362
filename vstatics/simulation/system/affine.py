"""Linear equations of motion as matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.known import KnownMotion


class Map(NamedTuple):
    """Linear function of the vectors x, c and dc/dt of `Affine`: three matrices."""

    by_state: Floats
    by_given: Floats
    by_slope: Floats

    def plus(self, other: Map) -> Map:
        """Return the sum of two maps."""
        return Map(*(mine + theirs for mine, theirs in zip(self, other, strict=True)))

    def times(self, matrix: Floats) -> Map:
        """Return the product of a matrix and the map."""
        return Map(*(matrix @ part for part in self))


class Affine:
    """Matrices of equations whose torques are linear in rates, twists and angles.

    ``dx/dt = A x + B c + D dc/dt`` for x = [q, e, phi, v]. The vector c contains the terms of port
    torques, and of rates of values, that depend on time alone. Rates of ports and speeds of motions
    without inertia are linear functions of x, c and dc/dt, too.

    Parameters
    ----------
    equations : KnownMotion
    by_rate : ndarray, shape (ports,), optional
        Derivatives of torques with respect to the rates of their ports, if laws are linearised.
        [N*m*s/rad]
    by_state : ndarray, shape (ports + values, size), optional
        Derivatives of torques, and of rates of values, with respect to the state.
    """

    def __init__(
        self,
        equations: KnownMotion,
        by_rate: Floats | None = None,
        by_state: Floats | None = None,
    ) -> None:
        self.equations = equations
        self.by_rate = equations.ports.by_rate if by_rate is None else by_rate
        structure, ports, layout = equations.structure, equations.ports, equations.layout
        size, count = equations.works.start, layout.ports + len(layout.values)
        if by_state is None:
            by_state = np.zeros((count, size))
        identity = np.eye(layout.ports, count)
        moved = np.zeros((equations.motions, size))
        moved[:, : equations.motions] = np.eye(equations.motions)
        still = np.zeros((equations.motions, count))
        motions = Map(moved, still, still)
        elastic = by_state[: layout.ports].copy()
        elastic[layout.spring_ports, equations.twists] += np.diag(ports.elastic)
        for port, place, slope in ports.by_angle:
            elastic[port, equations.angles.start + place] += slope
        given = Map(elastic, identity, np.zeros((layout.ports, count)))
        rates = motions.times(structure.rates)
        if equations.light:
            self.light = self._light(rates, given)
            rates = rates.plus(self.light.times(structure.light_rates))
        self.rates = rates
        torques = given.plus(rates.times(np.diag(self.by_rate)))
        parts = [torques.times(structure.accelerations)]
        if equations.springs:
            parts.append(self._twisting(torques, rates))
        if layout.angles:
            turning = motions.times(equations.angle_rows)
            if equations.light:
                rows = structure.light[list(layout.angles)]
                turning = turning.plus(self.light.times(rows))
            parts.append(turning)
        given_rates = np.eye(len(layout.values), count, k=layout.ports)
        parts.append(Map(by_state[layout.ports :], given_rates, np.zeros_like(given_rates)))
        self.change = Map(*(np.vstack(rows) for rows in zip(*parts, strict=True)))
        has_slopes = bool(equations.light) or self.change.by_slope.any()
        self.within = equations.within if has_slopes else None
        """Interval for derivatives of c; None if they have no effect. [s]"""

    def _light(self, rates: Map, given: Map) -> Map:
        """Return the speeds of motions without inertia as a map, from the balance of torques."""
        equations = self.equations
        structure, ports = equations.structure, equations.ports
        balance = equations.by_torque.T @ structure.balances
        damped = np.diag(self.by_rate)
        by_speeds = [balance @ damped @ structure.light_rates]
        balances = [given.plus(rates.times(damped)).times(balance)]
        if equations.by_slope.shape[1]:
            steep = equations.by_slope.T @ structure.balances
            elastic = ports.all_elastic
            by_speeds.append(steep @ (elastic[:, None] * structure.light_rates))
            slopes = rates.times(np.diag(elastic))
            identity = np.eye(*slopes.by_slope.shape)
            balances.append(slopes._replace(by_slope=slopes.by_slope + identity).times(steep))
        matrix = np.vstack(by_speeds)
        stacked = Map(*(np.vstack(part) for part in zip(*balances, strict=True)))
        return Map(*(-np.linalg.solve(matrix, part) for part in stacked))

    def _twisting(self, torques: Map, rates: Map) -> Map:
        equations = self.equations
        ports, at = equations.ports, equations.layout.spring_ports
        grown = [part[at].copy() for part in rates]
        stiffness = ports.stiffness
        for index in np.flatnonzero(equations.creeps):
            viscous = equations.viscous[index]
            for part, torque in zip(grown, torques, strict=True):
                part[index] = torque[at][index] / viscous
            grown[0][index, equations.twists.start + index] -= stiffness[index] / viscous
        for index in np.flatnonzero(equations.limited):
            for part in grown:
                part[index] = 0.0
            grown[2][index, at.start + index] = 1 / stiffness[index]
        return Map(*grown)

    def light_at(self, times: Floats, states: Floats) -> Floats:
        """Return the speeds of motions without inertia at several times, shape (motions, times)."""
        given, slopes = self.given_at(times)
        speeds = self.light.by_state @ states[: self.equations.works.start]
        return speeds + self.light.by_given @ given + self.light.by_slope @ slopes

    def given_at(self, times: Floats) -> tuple[Floats, Floats]:
        """Return c and dc/dt at several times; dc/dt is calculated only if needed."""
        more = np.zeros((len(self.equations.layout.values), len(times)))
        given, slopes = self.equations.ports.given_at(times, self.within)
        return np.vstack([given, more]), np.vstack([slopes, more])
