"""Torques of mechanisms whose efficiency depends on speed, torque or both.

The constraint of such a mechanism contains the factor ``f0 = eta^x`` of a constant efficiency. With
the factor f of the present efficiency, a port adds the torque ``(f - f0) m`` along the friction
row. The torque m on the first link depends on the torques of the ports, and f depends on m. The
search for this fixed point begins at the last solution.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from vstatics.core.model.parts import Law
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.simulation.system.fixed_point import FixedPoints, Vector
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import SIGNS, RigidMechanism, efficiency_at
from vstatics.simulation.system.structure import mesh_factor
from vstatics.simulation.tolerances import LEAST_EFFICIENCY, SAME_TORQUE

_MOST_LOSS_ROUNDS = 12
"""Largest number of iterations for several instants at once, before each is solved alone."""


class LosingMesh:
    """Mechanism with an efficiency over speed or torque, for fixed signs of speed and torque.

    Parameters
    ----------
    mesh : RigidMechanism
    state : str
        State as in `MeshStates`.
    """

    def __init__(self, mesh: RigidMechanism, state: str) -> None:
        assert mesh.laws is not None  # noqa: S101 - only such mechanisms have ports
        self.mesh = mesh
        self.moves = state not in ("", "stick")
        self.drives = self.moves and state[0] == state[1]
        is_back = not self.drives and mesh.laws[1] is not mesh.laws[0]
        self.key = "back_efficiency" if is_back else "efficiency"
        """Key of the efficiency in the case."""
        self.law = mesh.laws[0 if self.drives else 1]
        self.way = -SIGNS[state[0]] if self.moves else 0.0
        """Sign of the rate of the port."""
        self.sign = SIGNS[state[1]] if self.moves else 0.0
        self.given = mesh_factor(mesh.efficiency, mesh.back, state)
        """Factor f0 in the constraint of the mechanism."""

    def torque(self, speed: float, on_first: float, *, is_trial: bool = False) -> float:
        """Return the port torque [N*m]; an impossible efficiency is clipped.

        In a trial, a torque of the wrong sign has the efficiency of a torque of 0.
        """
        if not self.moves:
            return 0.0
        if is_trial:
            value = self.efficiency(speed, on_first)
        else:
            value = self._continued(self.way * speed, self.sign * on_first)
        if not 0 < value <= 1 and self.sign * on_first < 0:
            return 0.0
        value = max(LEAST_EFFICIENCY, min(value, 1.0))  # also replaces NaN
        return ((value if self.drives else 1 / value) - self.given) * on_first

    def torques(self, speeds: Floats, on_first: Floats) -> Floats:
        """Return the port torques at several instants, NaN for impossible efficiencies."""
        if not (self.moves and isinstance(self.law, Law)):
            return np.array([self.torque(0.0, torque) for torque in on_first.tolist()])
        sizes = np.array(self.law.sizes_of(self.way * speeds, self.sign * on_first))
        values = self.law.at(*sizes if self.law.text else np.abs(sizes))
        beyond = sizes.min(axis=0) < 0
        if beyond.any():
            if not self.law.text:
                reflected = 2 * self.law.at(*np.maximum(sizes, 0.0)) - values
                values = np.where(beyond, reflected, values)
            values = np.where(beyond, np.clip(values, LEAST_EFFICIENCY, 1.0), values)
        values = np.where((values > 0) & (values <= 1), values, np.nan)
        return ((values if self.drives else 1 / values) - self.given) * on_first

    def _continued(self, speed: float, torque: float) -> float:
        """Return the efficiency, continued without a corner to a speed or torque below 0.

        Below 0 the flow of power reverses, and the polynomials of a time step cannot fit a corner.
        """
        if isinstance(self.law, Law) and self.law.text:
            return self.law.at(*self.law.sizes_of(speed, torque))
        value = efficiency_at(self.law, speed, torque)
        if speed >= 0 <= torque:
            return value
        return 2 * efficiency_at(self.law, max(speed, 0.0), max(torque, 0.0)) - value

    def efficiency(self, speed: float, on_first: float) -> float:
        """Return the efficiency; a torque of the wrong sign, as in trials, counts as 0."""
        return efficiency_at(self.law, speed, max(self.sign * on_first, 0.0))


class VaryingLosses:
    """Torques of the ports of mechanisms with varying efficiency, between two events.

    Parameters
    ----------
    equations : KnownMotion
    before : sequence of float
        Torques on the first links before the first event, empty at the start. [N*m]
    """

    def __init__(self, equations: KnownMotion, before: Vector) -> None:
        system, states = equations.system, equations.states.meshes
        self.meshes = [LosingMesh(system.meshes[index], states[index]) for index in system.varying]
        self.places = slice(equations.layout.losses, equations.layout.ports)
        self.by_torques = equations.structure.torques[list(system.varying)]
        self.sizes = np.abs(self.by_torques)
        self.by_losses = self.by_torques[:, self.places].tolist()
        self.latest: Vector = [*before] or [0.0] * len(self.meshes)
        """Torques on the first links in the last solution. [N*m]"""
        self.has_formulas = any(isinstance(mesh.law, Law) and mesh.law.text for mesh in self.meshes)
        self.latest_of_all = np.zeros((0, 0))
        self.fixed_points = FixedPoints(len(self.meshes))
        self.failed: tuple[LosingMesh, str] | None = None
        """Mechanism without a solution in the last evaluation, and the reason."""

    def fill(self, rates: Floats, torques: Floats, others: Callable[[], None] | None) -> None:
        """Fill in the torques of the ports, NaN if the efficiencies do not agree with them.

        Parameters
        ----------
        rates, torques : ndarray, shape (ports,)
            Rates and torques of ports; `torques` is changed in place.
        others : callable, optional
            Function that fills in other torques that depend on these torques.
        """
        torques[self.places] = 0.0
        speeds = rates[self.places].tolist()
        if others:
            others()
        held: list[float] = (self.by_torques @ torques).tolist()
        least = (SAME_TORQUE * (self.sizes @ np.abs(torques))).tolist()
        losses: list[float] = []

        def on_first(assumed: Vector, *, is_trial: bool) -> Vector:
            losses[:] = [
                mesh.torque(speed, torque, is_trial=is_trial)
                for mesh, speed, torque in zip(self.meshes, speeds, assumed, strict=True)
            ]
            if others:
                torques[self.places] = losses
                others()
                after: list[float] = (self.by_torques @ torques).tolist()
                return after
            return [
                torque + sum([factor * loss for factor, loss in zip(row, losses, strict=True)])
                for torque, row in zip(held, self.by_losses, strict=True)
            ]

        # From a distant start, the iteration can end at impossible efficiencies. Below a torque of
        # 0, a formula can be so steep that a state with the wrong flow of power has no torque.
        for begin, is_trial in ((self.latest, False), (held, False), (held, True)):
            carried = partial(on_first, is_trial=is_trial)
            agreed = self.fixed_points.near(begin, carried, least)
            self.failed = self._failure(speeds, agreed, least)
            if not self.failed:
                break
            self.fixed_points = FixedPoints(len(self.meshes))
        if agreed is None or self.failed:
            torques[self.places] = np.nan
        else:
            self.latest, torques[self.places] = agreed, losses

    def fill_all(self, rates: Floats, torques: Floats) -> Booleans:
        """Fill in torques that do not influence other torques, at several instants.

        Returns
        -------
        ndarray, shape (times,)
            True for instants that remain without a solution.
        """
        speeds, slopes = rates[self.places], np.array(self.fixed_points.slopes)
        torques[self.places] = 0.0
        held, least = self.by_torques @ torques, SAME_TORQUE * (self.sizes @ np.abs(torques))
        by_losses = np.array(self.by_losses)
        near = self.latest_of_all
        on_first = near if near.shape == held.shape and np.isfinite(near).all() else held
        for _ in range(_MOST_LOSS_ROUNDS):
            losses = np.array(
                [
                    mesh.torques(*sizes)
                    for mesh, *sizes in zip(self.meshes, speeds, on_first, strict=True)
                ]
            )
            left = held + by_losses @ losses - on_first
            missing: Booleans = ~(np.abs(left) <= least).all(axis=0)
            if not missing.any():
                break
            on_first = on_first + slopes @ left
        torques[self.places], self.latest_of_all = losses, on_first
        return missing

    def _failure(
        self, speeds: Vector, agreed: Vector | None, least: Vector
    ) -> tuple[LosingMesh, str] | None:
        """Return a mechanism whose efficiency does not agree with its torque, and the reason.

        Torques of the wrong sign, which occur only in trials, do not count.
        """
        if agreed is not None:
            pairs = zip(self.meshes, agreed, least, strict=True)
            if not self.has_formulas or any(mesh.sign * m < -limit for mesh, m, limit in pairs):
                return None
        at = self.latest if agreed is None else agreed
        mesh, message = self.meshes[0], "no torque on {} agrees with its efficiency"
        for candidate, speed, torque in zip(self.meshes, speeds, at, strict=True):
            value = candidate.efficiency(speed, torque) if candidate.moves else 1.0
            if not 0 < value <= 1:
                mesh, agreed = candidate, None
                message += (
                    f": at {abs(speed):.6g} rad/s and {max(0.0, candidate.sign * torque):.6g} N*m "
                    f"it is {value:.6g}, expected above 0 and at most 1"
                )
                break
        if agreed is not None:
            return None
        return mesh, message.format(mesh.mesh.name)
