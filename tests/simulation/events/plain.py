"""A gear with inertia on input and output alone, in closed form: written without the engine.

Speeds are ``w = s v`` with one number s, so between two changes of sign its acceleration a is
constant: ``J v a = T - sum M_k column_k(x) - sum F_e column_e``, with the signs x of all mechanisms
that lose anything, each fitting its flow ``M_k (w_f - w_h)``. All sets of signs are tried. At rest
it stands if some ``M_k`` within the cones of all mechanisms balance the torques.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np
from scipy.linalg import null_space
from scipy.optimize import linprog

from tests.simulation.reference import element_column, mechanism_column, mechanism_columns
from vstatics import Gear, Mechanism, Transmission
from vstatics.core.numerics.arrays import Floats


class PlainGear:
    """A gear of one degree of freedom under constant torques.

    Parameters
    ----------
    case : Transmission
        With inertias.
    gear : Gear
    torques : mapping of int to float
        On links. [N*m]
    """

    def __init__(self, case: Transmission, gear: Gear, torques: dict[int, float]) -> None:
        self.case, self.input = case, case.gear_input(gear)
        self.elements = [
            element_column(case.shift_elements[number - 1], case.links) for number in gear.engaged
        ]
        rows = mechanism_columns(case)
        [shape] = null_space(np.array([*rows, *self.elements])).T
        self.shape: Floats = shape / shape[self.input - 1]
        """Speeds of links by that of the input."""
        self.load = np.array([torques.get(link, 0.0) for link in range(1, case.links + 1)])
        self.momentum = np.array([case.inertias.get(n, 0.0) for n in range(1, case.links + 1)])
        self.momentum *= self.shape

    def inner(self, mechanism: Mechanism) -> float:
        """Speed of the first link against the third, by that of the input."""
        first, third = (
            self.shape[link - 1] if link else 0.0 for link in (mechanism.first, mechanism.third)
        )
        return float(first - third)

    def loses(self, mechanism: Mechanism) -> bool:
        """Whether it turns in itself, and not without a loss."""
        still = 1e-9 * np.abs(self.shape).max()
        return mechanism.efficiency != 1 and abs(self.inner(mechanism)) > still

    def accelerations(self, direction: float) -> Iterator[float]:
        """Of the input, by each set of signs that fits."""
        own = self.case.mechanisms
        lossy = [one for one in own if self.loses(one)]
        for signs in product((1, -1), repeat=len(lossy)):
            by_name = {one.name: sign for one, sign in zip(lossy, signs, strict=True)}
            columns = [
                mechanism_column(one, self.case.links, by_name.get(one.name, 0)) for one in own
            ]
            matrix = np.column_stack([self.momentum, *columns, *self.elements])
            if np.linalg.matrix_rank(matrix) < len(matrix):
                continue
            found = np.linalg.solve(matrix, self.load)
            carried = dict(zip([one.name for one in own], found[1:].tolist(), strict=False))
            flows = [carried[one.name] * self.inner(one) * by_name[one.name] for one in lossy]
            if min(flows, default=0.0) * direction >= -1e-9 * np.abs(self.load).max():
                yield float(found[0])

    def stands(self) -> bool:
        """Whether friction can hold it at rest."""
        for signs in product((1, -1), repeat=len(self.case.mechanisms)):
            cones = [
                sign * mechanism_column(one, self.case.links, exponent)
                for one, sign in zip(self.case.mechanisms, signs, strict=True)
                for exponent in ((1, -1) if self.loses(one) else (0, 0))
            ]
            matrix = np.column_stack([*cones, *self.elements])
            bounds = [(0, None)] * len(cones) + [(None, None)] * len(self.elements)
            found = linprog(np.zeros(len(bounds)), A_eq=matrix, b_eq=self.load, bounds=bounds)
            if found.success:
                return True
        return False

    def ends(self, speed: float, duration: float) -> Iterator[float]:
        """Speeds of the input that it may have after a time."""
        if not speed:
            if self.stands():
                yield 0.0
                return
            for direction in (1, -1):
                for rate in self.accelerations(direction):
                    if rate * direction > 0:
                        yield rate * duration
            return
        for rate in self.accelerations(np.sign(speed)):
            if speed * (speed + rate * duration) >= 0:
                yield speed + rate * duration
            else:
                yield from self.ends(0.0, duration + speed / rate)
