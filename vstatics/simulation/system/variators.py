"""Variators with a moving speed ratio: ``w_second = x(t) w_first``, torques (x m eta^-s, -m).

The constraint row has the constant ratio `reference`, ``x0 w_first - w_second``. Two ports describe
the motion of the ratio. The speed of the row is ``(x0 - x) w_first``, as of a driver with the
derivative

    u = -x' w_first - (x - x0) a_first,

and the first link gives ``tau = (x eta^-s - x0) m`` in addition to the m of the row. Both depend on
the torques, which depend on both: a linear system, solved at each instant.
"""

from __future__ import annotations

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import MOVING_LINK


class VariatorTorques:
    """Torques of the ports of variators between two events.

    Parameters
    ----------
    equations : KnownMotion

    Raises
    ------
    CaseError
        If the first link has no inertia and is not moved by a link with inertia.
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system, layout, structure = equations.system, equations.layout, equations.structure
        self.variators = system.variators
        contacts = [variator.contact for variator in self.variators]
        self.rows = [structure.contact_rows[index] for index in contacts]
        """Rows of the multipliers of variators."""
        self.changes = [layout.contacts + index for index in contacts]
        self.extras = [layout.variators + number for number in range(len(contacts))]
        self.places = [*self.changes, *self.extras]
        first = [variator.first for variator in self.variators]
        self.references = np.array([variator.reference for variator in self.variators])
        self.efficiencies = np.array([variator.efficiency for variator in self.variators])
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
            The instant. [s]
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
        by_port, changes = by_torques[:, self.places], self.accelerations[:, self.places]
        driven = -moved * speeds - apart * (self.accelerations @ torques)
        carried = held
        for _ in range(2 + count):  # the power flow of a variator can reverse through another
            factors = self.efficiencies ** -np.sign(carried * ratios * speeds)
            taken = ratios * factors - self.references
            matrix = np.eye(2 * count)
            matrix[:count] += apart[:, None] * changes
            matrix[count:] -= taken[:, None] * by_port
            solution = np.linalg.solve(matrix, np.concatenate([driven, taken * held]))
            before, carried = carried, held + by_port @ solution
            if (np.sign(before) == np.sign(carried)).all():
                break
        torques[self.places] = solution


def variator_rows(system: MotionSystem, time: float) -> list[Floats]:
    """Return constraint rows with the current ratios, shape (variators, links)."""
    rows = []
    for variator in system.variators:
        row = system.contacts[variator.contact].row.copy()
        row[variator.first] += variator.ratio.at(time) - variator.reference
        rows.append(row)
    return rows
