"""Reduction of a gearbox with two degrees of freedom to a mass at input and output.

Source: V. P. Tarasik, Planetary gearbox simulation (in Russian), 2018; (1) to (11).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import plural
from vstatics.core.model.transmission import Gear
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.structure import null
from vstatics.simulation.tolerances import NO_COEFFICIENT


class TwoMasses(NamedTuple):
    """Masses at the input and output of a gearbox, and the clutch that can join them."""

    speeds: Floats
    """Speeds of links per unit speed of input and of output, shape (links, 2)."""
    slip: float
    """Slip of the clutch per unit of w_f = w_in - u w_out, equation (13); 0 without a clutch."""
    ratio: float
    """Ratio u while the clutch sticks."""
    efficiency: float
    """Efficiency eta while the clutch sticks."""
    turning: Floats
    """Speeds of bodies lumped at the input per unit speed of both ends, shape (bodies, 2)."""
    inertias: Floats
    """Inertias of bodies lumped at the input. [kg*m^2]"""
    output_inertia: float
    """Inertia J_out. [kg*m^2]"""

    def input_inertia(self, speed_in: float, speed_out: float) -> float:
        """Return J_in by (3), (5) and (11) [kg*m^2]: ``sum J w^2/w_in^2`` of the lumped bodies.

        It is infinite if the input is at rest.
        """
        speeds = self.turning @ np.array([speed_in, speed_out])
        energy = float(self.inertias @ speeds**2)
        if speed_in == 0:
            return np.inf
        return energy / speed_in**2


class NotTwoError(ValueError):
    """Error: the gearbox cannot be reduced to two masses."""


def two_masses(
    system: MotionSystem, ends: tuple[int, int], held: Sequence[int], clutch: int | None
) -> TwoMasses:
    """Reduce a gearbox to two masses while some contacts stick and a clutch joins the ends.

    Parameters
    ----------
    system : MotionSystem
    ends : (int, int)
        Indices of the input and the output link.
    held : sequence of int
        Indices of the contacts that stick, except the clutch.
    clutch : int, optional
        Index of the clutch; None if input and output are not joined.

    Raises
    ------
    NotTwoError
        If the gearbox cannot be reduced to two masses.
    """
    rows = [mesh.row for mesh in system.meshes] + [system.contacts[n].row for n in held]
    free = null(system.rows(rows))
    names = " and ".join(system.contacts[n].name for n in held) or "nothing"
    if free.shape[1] != 2:
        count = free.shape[1]
        degrees = plural("degree", count)
        raise NotTwoError(f"with {names} held the box has {count} {degrees} of freedom, not 2")
    seen = free[list(ends)]
    if abs(np.linalg.det(seen)) < NO_COEFFICIENT:
        raise NotTwoError(f"with {names} held input and output do not turn apart")
    speeds: Floats = free @ np.linalg.inv(seen)
    speeds[np.abs(speeds) < NO_COEFFICIENT * np.abs(speeds).max()] = 0.0
    slip, ratio, efficiency = 0.0, 1.0, 1.0
    if clutch is not None:
        contact = system.contacts[clutch]
        slip_in, slip_out = map(float, contact.row @ speeds)
        if abs(slip_in) < NO_COEFFICIENT or abs(slip_out) < NO_COEFFICIENT:
            raise NotTwoError(f"{contact.name} does not join input and output")
        slip, ratio = slip_in, -slip_out / slip_in
        efficiency = _efficiency(system, ends, (*held, clutch))
    bodies: Floats = system.heavy @ speeds
    on_output = np.abs(bodies[:, 0]) < NO_COEFFICIENT * np.abs(bodies).max(axis=1)
    output = float(system.inertias[on_output] @ bodies[on_output, 1] ** 2)
    if not output:
        raise NotTwoError("nothing heavy turns with the output alone")
    turning, inertias = bodies[~on_output], system.inertias[~on_output]
    return TwoMasses(speeds, slip, ratio, efficiency, turning, inertias, output)


def _efficiency(system: MotionSystem, ends: tuple[int, int], engaged: Sequence[int]) -> float:
    if all(mesh.lossless for mesh in system.meshes):
        return 1.0
    from vstatics.core.statics.solve import solve

    numbers = [element + 1 for n in engaged if (element := system.contacts[n].element) is not None]
    gear = Gear(numbers, input=ends[0] + 1, output=ends[1] + 1)
    results = solve(replace(system.case, gears=[gear], coast=None))
    return float(results.efficiency[0])
