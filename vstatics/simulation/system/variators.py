"""Variators whose speed ratio moves: ``w_second = x(t) w_first``, with torques (x m eta^-s, -m).

Its row holds for the ratio `reference`, ``x0 w_first - w_second``; that it moves is told by two
ports. The row's speed is ``(x0 - x) w_first``, as of a driver whose change with time is

    u = -x' w_first - (x - x0) a_first,

and the first link gives ``tau = (x eta^-s - x0) m`` besides the m of the row. Both follow from the
torques, which follow from both: a linear system, solved at each instant.
"""

from __future__ import annotations

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.known import KnownMotion
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import MOVING_LINK


class VariatorTorques:
    """What the ports of variators have, while equations hold.

    Parameters
    ----------
    equations : KnownMotion

    Raises
    ------
    CaseError
        Of a first link without inertia that nothing with inertia moves.
    """

    def __init__(self, equations: KnownMotion) -> None:
        self.equations = equations
        system, layout, structure = equations.system, equations.layout, equations.structure
        self.variators = system.variators
        contacts = [one.contact for one in self.variators]
        held = [one.of if one.kind == "contact" else -1 for one in structure.multipliers]
        self.rows = [held.index(index) for index in contacts]
        """Of their multipliers."""
        self.changes = [layout.contacts + index for index in contacts]
        self.extras = [layout.variators + number for number in range(len(contacts))]
        self.places = [*self.changes, *self.extras]
        first = [one.first for one in self.variators]
        self.references = np.array([one.reference for one in self.variators])
        self.efficiencies = np.array([one.efficiency for one in self.variators])
        self.accelerations: Floats = structure.free[first] @ structure.accelerations
        """Of first links, by the torques of ports."""
        for one in self.variators:
            if equations.light and np.abs(structure.light[one.first]).max() > MOVING_LINK:
                name = system.names[one.first]
                message = (
                    f"link {name} has no inertia, but {one.name} moves it as its ratio changes"
                )
                raise CaseError(
                    "E699", f"{message}: give it an inertia", ("case", "inertias", name)
                )

    def fill(self, time: float, rates: Floats, torques: Floats) -> None:
        """Give the ports of variators what they have at a time.

        Parameters
        ----------
        time : float
            [s]
        rates, torques : ndarray, shape (ports,)
            Torques are changed.
        """
        ports = self.equations.ports
        time = min(max(time, ports.after), ports.until)
        torques[self.places] = 0.0
        speeds, count = rates[self.extras], len(self.variators)
        ratios = np.array([one.ratio.at(time) for one in self.variators])
        moved = np.array([one.change.at(time) for one in self.variators])
        apart = ratios - self.references
        by_torques = self.equations.structure.torques[self.rows]
        held = by_torques @ torques
        own, changes = by_torques[:, self.places], self.accelerations[:, self.places]
        driven = -moved * speeds - apart * (self.accelerations @ torques)
        carried = held
        for _ in range(2 + count):  # as the flow of power through one may turn by that of another
            factors = self.efficiencies ** -np.sign(carried * ratios * speeds)
            taken = ratios * factors - self.references
            matrix = np.eye(2 * count)
            matrix[:count] += apart[:, None] * changes
            matrix[count:] -= taken[:, None] * own
            found = np.linalg.solve(matrix, np.concatenate([driven, taken * held]))
            before, carried = carried, held + own @ found
            if (np.sign(before) == np.sign(carried)).all():
                break
        torques[self.places] = found


def variator_rows(system: MotionSystem, time: float) -> list[Floats]:
    """Rows of speeds that are 0 by the ratios at a time."""
    made = []
    for one in system.variators:
        row = system.contacts[one.contact].row.copy()
        row[one.first] += one.ratio.at(time) - one.reference
        made.append(row)
    return made
