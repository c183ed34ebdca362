"""A system without one of its elastic devices, as its secular equation has it."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.numerics.motions import Form, free_motions
from vstatics.torsion.coordinates import Coordinates
from vstatics.torsion.normed import NormedTwists, normed_twists, triangular
from vstatics.torsion.secular import Poles
from vstatics.torsion.system import TorsionalSystem


class WithoutDevice(NamedTuple):
    """What the frequencies of a system with the device follow from.

    Attributes
    ----------
    poles : Poles
        The modes without the device.
    slack : float
        Compliance behind that of the device: of links without inertia, which give way in
        balance of the other devices. [rad/(N*m)]
    """

    poles: Poles
    slack: float


def without(
    system: TorsionalSystem, split: Coordinates, stiffnesses: Floats, device: int
) -> WithoutDevice | None:
    """The system without a device; None where the device carries no torque in any mode.

    Parameters
    ----------
    system : TorsionalSystem
    split : Coordinates
        Of the system with the device.
    stiffnesses : ndarray, shape (devices,)
        Of all elastic devices. [N*m/rad]
    device : int
        Its place among them.

    Examples
    --------
    A mass of 2 on a spring of 8, a shaft from there to a link without inertia, and from there
    a second shaft of 5 to a mass of 1: without the first shaft the second one is behind it.

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.coordinates import coordinates
    >>> from vstatics.torsion.system import torsional_system
    >>> twists = {1: 1}, {1: 1, 2: -1}, {2: 1, 3: -1}
    >>> springs = [Spring(twist, stiffness=c) for twist, c in zip(twists, (8, 3, 5))]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 2.0, 3: 1.0})
    >>> system = torsional_system(case, case.gears[0])
    >>> poles, slack = without(system, coordinates(system), np.array([8.0, 3.0, 5.0]), 1)
    >>> poles.squares.round(9), poles.weights.round(9), round(slack, 9)
    (array([0., 4.]), array([1. , 0.5]), 0.2)
    """
    alone = _held_alone(system, device)
    if alone == "massless":
        return None
    own = normed_twists(system, split, np.array([body.inertia for body in system.bodies]))
    others = NormedTwists(*(np.delete(part, device, axis=0) for part in own))
    [rows] = triangular(others, np.delete(stiffnesses, device)[None])
    count = own.massless.shape[1]
    of_massless, aside = rows[:count, :count], rows[:count, count:]
    against = np.linalg.solve(of_massless.T, own.massless[device])
    twists = own.heavy[device] - against @ aside
    _, sizes, vectors = np.linalg.svd(rows[count:, count:] if count else rows)
    squares = np.zeros(len(vectors))
    squares[: len(sizes)] = sizes**2
    if alone == "heavy":
        squares[-1] = 0.0
    weights = (vectors @ twists) ** 2
    return WithoutDevice(Poles(squares[::-1], weights[::-1]), float(against @ against))


def _held_alone(system: TorsionalSystem, device: int) -> Literal["", "heavy", "massless"]:
    """Whether a device resists a motion that no other resists, and whether that has inertia."""
    links = len(system.names)
    rigid = [one.twist for one in system.rigid]
    elastic = [one.twist for one in system.elastic]
    others = [*elastic[:device], *elastic[device + 1 :]]
    bodies = [body.form for body in system.bodies if body.inertia > 0]

    def is_held(*forms: Form) -> bool:
        free = [free_motions([*rigid, *some, *forms], links) for some in (others, elastic)]
        return bool(free[0].shape[1] > free[1].shape[1])

    return "massless" if is_held(*bodies) else "heavy" if is_held() else ""
