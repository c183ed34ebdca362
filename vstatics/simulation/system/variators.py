"""Variators with a moving speed ratio: ``w_second = x(t) w_first``, torques (x m eta^-s, -m).

Here m is the torque of the second link, and the sign s is the direction of power. The constraint
row has the constant ratio `reference`: ``x0 w_first - w_second``. Two ports describe the motion of
the ratio. The speed of the row is ``(x0 - x) w_first``. Like a driver, it has the derivative

    u = -x' w_first - (x - x0) a_first,

and the first link gives ``tau = (x eta^-s - x0) m`` in addition to the torque m of the row. Both u
and tau depend on the torques of all ports, which depend on u and tau: a linear system, solved at
each instant.
"""

from __future__ import annotations

import math

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.parts import Law
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import MotionSystem, efficiency_at
from vstatics.simulation.tolerances import MOVING_LINK, SAME_TORQUE

_MOST_ROUNDS = 100
"""Largest number of iterations if an efficiency depends on the torque."""


class VariatorTorques:
    """Torques of the ports of moving variators between two events.

    Parameters
    ----------
    equations : KnownMotion

    Raises
    ------
    CaseError
        If the speed of the first link does not follow from links with inertia.
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system, layout, structure = equations.system, equations.layout, equations.structure
        self.variators = system.variators
        contacts = [variator.contact for variator in self.variators]
        self.rows = [structure.contact_rows[index] for index in contacts]
        """Row of each variator in `MotionStructure.torques`."""
        self.changes = [layout.contacts + index for index in contacts]
        self.extras = [layout.variators + number for number in range(len(contacts))]
        self.places = [*self.changes, *self.extras]
        first = [variator.first for variator in self.variators]
        self.references = np.array([variator.reference for variator in self.variators])
        self.lacks = False
        """True if no torques agreed with their efficiencies in the last evaluation."""
        self.is_lawful = any(
            isinstance(number, Law)
            for variator in self.variators
            for number in (variator.efficiency, variator.back)
        )
        self.accelerations = structure.free[first] @ structure.accelerations
        """Matrix from torques of ports to accelerations of first links."""
        for variator in self.variators:
            if equations.light and np.abs(structure.light[variator.first]).max() > MOVING_LINK:
                name = system.names[variator.first]
                raise CaseError(
                    "E699",
                    f"link {name} has no inertia, but {variator.name} moves it as its "
                    "ratio changes: give it an inertia",
                    ("case", "inertias", name),
                )

    def fill(self, time: float, rates: Floats, torques: Floats) -> None:
        """Fill in the torques of the ports of variators.

        Parameters
        ----------
        time : float
            Time. [s]
        rates, torques : ndarray, shape (ports,)
            Rates and torques of ports; `torques` is changed in place.
        """
        ports = self.equations.ports
        time = min(max(time, ports.after), ports.until)
        torques[self.places] = 0.0
        speeds, count = rates[self.extras], len(self.variators)
        ratios = np.array([variator.ratio.at(time) for variator in self.variators])
        moved = np.array([variator.change.at(time) for variator in self.variators])
        apart = ratios - self.references
        by_torques = self.equations.structure.torques[self.rows]
        held = by_torques @ torques
        least = SAME_TORQUE * (np.abs(by_torques) @ np.abs(torques))
        by_port, changes = by_torques[:, self.places], self.accelerations[:, self.places]
        driven = -moved * speeds - apart * (self.accelerations @ torques)
        carried, factors = held, np.ones(count)
        # a second variator can reverse the power flow, which changes the efficiency
        for _ in range(_MOST_ROUNDS if self.is_lawful else 2 + count):
            factors = self._factors(carried * ratios * factors, speeds)
            taken = ratios * factors - self.references
            matrix = np.eye(2 * count)
            matrix[:count] += apart[:, None] * changes
            matrix[count:] -= taken[:, None] * by_port
            solution = np.linalg.solve(matrix, np.concatenate([driven, taken * held]))
            before, carried = carried, held + by_port @ solution
            agree = np.sign(before) == np.sign(carried)
            if self.is_lawful:
                agree = np.abs(carried - before) <= least
            if agree.all():
                break
        else:
            if self.is_lawful:
                solution = np.full(2 * count, np.nan)
        torques[self.places] = solution
        self.lacks = self.is_lawful and not np.isfinite(solution).all()

    def _factors(self, torques: Floats, speeds: Floats) -> Floats:
        """Return ``eta^-s`` of each variator for the torque and speed of the first link."""
        factors = np.ones(len(torques))
        for n, (variator, torque, speed) in enumerate(
            zip(self.variators, torques.tolist(), speeds.tolist(), strict=True)
        ):
            if torque * speed:
                drives = torque * speed > 0
                number = variator.efficiency if drives else variator.back
                value = efficiency_at(number, speed, torque)
                value = value if 0 < value <= 1 else math.nan
                factors[n] = 1 / value if drives else value
        return factors


def variator_rows(system: MotionSystem, time: float) -> list[Floats]:
    """Return the constraint rows of variators with the ratios at a time [s]."""
    rows = []
    for variator in system.variators:
        row = system.contacts[variator.contact].row.copy()
        row[variator.first] += variator.ratio.at(time) - variator.reference
        rows.append(row)
    return rows
