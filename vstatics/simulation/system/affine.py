"""Equations of motion whose torques are straight in rates, twists and angles, as maps.

``dx/dt = A x + B c + D dc/dt`` for x = [q, e, phi] and the torques c of ports that are given by the
time alone; rates of ports and speeds of motions without inertia are maps of the same kind.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.simulation.system.curves import curve_along, slope_of
from vstatics.simulation.system.ports import PortLayout, Ports
from vstatics.simulation.system.structure import MotionStructure


class Map(NamedTuple):
    """What follows from x, from c and from dc/dt."""

    by_state: Floats
    by_given: Floats
    by_slope: Floats

    def plus(self, other: Map) -> Map:
        """The sum of two."""
        return Map(*(one + two for one, two in zip(self, other, strict=True)))

    def times(self, matrix: Floats) -> Map:
        """A matrix applied to it."""
        return Map(*(matrix @ one for one in self))


class StraightEquations(Protocol):
    """What maps are made of: `Equations`, which knows this module."""

    structure: MotionStructure
    ports: Ports
    layout: PortLayout
    motions: int
    springs: int
    light: int
    twists: slice
    angles: slice
    works: slice
    spring_ports: slice
    viscous: Floats
    creeps: Booleans
    limited: Booleans
    angle_rows: Floats
    by_torque: Floats
    by_slope: Floats
    within: float


class Affine:
    """Maps of equations.

    Parameters
    ----------
    equations : Equations
    by_rate : ndarray, shape (ports,), optional
        Slopes of torques by their rates, where other than those that are straight.
        [N*m*s/rad]
    """

    def __init__(self, equations: StraightEquations, by_rate: Floats | None = None) -> None:
        self.equations = equations
        self.by_rate: Floats = equations.ports.by_rate if by_rate is None else by_rate
        structure, ports, layout = equations.structure, equations.ports, equations.layout
        size, count = equations.works.start, layout.ports
        identity = np.eye(count)
        moved = np.zeros((equations.motions, size))
        moved[:, : equations.motions] = np.eye(equations.motions)
        still = np.zeros((equations.motions, count))
        motions = Map(moved, still, still)
        elastic = np.zeros((count, size))
        elastic[equations.spring_ports, equations.twists] = np.diag(ports.elastic)
        for port, place, slope in ports.by_angle:
            elastic[port, equations.angles.start + place] += slope
        given = Map(elastic, identity, np.zeros((count, count)))
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
        self.change = Map(*(np.vstack(one) for one in zip(*parts, strict=True)))

    def _light(self, rates: Map, given: Map) -> Map:
        """Speeds of the motions without inertia, from what balances along them."""
        equations = self.equations
        structure, ports = equations.structure, equations.ports
        balance = equations.by_torque.T @ structure.balances
        damped = np.diag(self.by_rate)
        by_speeds = [balance @ damped @ structure.light_rates]
        rest = [given.plus(rates.times(damped)).times(balance)]
        if equations.by_slope.shape[1]:
            steep = equations.by_slope.T @ structure.balances
            elastic = np.zeros(equations.layout.ports)
            elastic[equations.spring_ports] = ports.elastic
            by_speeds.append(steep @ (elastic[:, None] * structure.light_rates))
            slopes = rates.times(np.diag(elastic))
            identity = np.eye(equations.layout.ports)
            rest.append(slopes._replace(by_slope=slopes.by_slope + identity).times(steep))
        matrix = np.vstack(by_speeds)
        stacked = Map(*(np.vstack(one) for one in zip(*rest, strict=True)))
        return Map(*(-np.linalg.solve(matrix, one) for one in stacked))

    def _twisting(self, torques: Map, rates: Map) -> Map:
        """How twists grow."""
        equations = self.equations
        ports, at = equations.ports, equations.spring_ports
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
        """Speeds of the motions without inertia at several times, shape (motions, times)."""
        given, slopes = self.given_at(times)
        made: Floats = self.light.by_state @ states[: self.equations.works.start]
        return made + self.light.by_given @ given + self.light.by_slope @ slopes

    def given_at(self, times: Floats) -> tuple[Floats, Floats]:
        """Torques that are given by the time alone, and their slopes, shape (ports, times)."""
        ports, within = self.equations.ports, self.equations.within
        times = ports.inside(times)
        given: Floats = ports.c0[:, None] + ports.c1[:, None] * times
        slopes = np.repeat(ports.c1[:, None], len(times), axis=1)
        for port, formula, factor in ports.timed:
            given[port] = factor * curve_along(formula, times)
            if self.senses_slopes:
                made = [slope_of(formula, time, within) for time in times.tolist()]
                slopes[port] = factor * np.array(made)
        return given, slopes

    def straight_at(self, times: Floats) -> tuple[Floats, Floats]:
        """The same without those by a formula, but with their slopes."""
        given, slopes = self.given_at(times)
        for port, _, _ in self.equations.ports.timed:
            given[port] = 0.0
        return given, slopes

    @property
    def senses_slopes(self) -> bool:
        """Whether anything follows from slopes of torques."""
        return bool(self.equations.light) or bool(self.change.by_slope.any())
