"""Free motions of a torsional system, split into rigid, massless and other motions.

The split depends on the coefficients of constraints, twists and bodies alone, not on the size of
stiffnesses or inertias. A soft support is thus not mistaken for a rigid motion.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.motions import Form
from vstatics.torsion.system.gear_system import TorsionalSystem
from vstatics.torsion.tolerances import UNMOVED

MANY = 300
"""Number of links above which it is faster to calculate only the lowest modes."""


class Coordinates(NamedTuple):
    """Basis of the possible motions of links; each motion is a column of link angles."""

    free: Floats
    """All motions that the constraints allow, shape (links, ...)."""
    bound: Floats
    """Motions in which links that only dampers resist follow the others, shape (links, n)."""
    massless: Floats
    """Motions without inertia but with elastic twist, shape (links, m)."""
    rigid: Floats
    """Motions with inertia but without elastic twist, shape (links, r)."""
    drifting: Floats
    """Motions that only dampers and converters resist, shape (links, d)."""
    undetermined: Booleans
    """Flags of links that take part in a motion with neither inertia nor resistance."""

    @property
    def modes(self) -> int:
        """Number of modes, without rigid modes."""
        return len(self.bound.T) - len(self.massless.T) - len(self.rigid.T)

    def has_many_more(self, count: int) -> bool:
        """Return whether the `count` lowest modes are calculated faster than all modes."""
        return len(self.free) > MANY and count < self.modes // 2

    @property
    def heavy(self) -> Floats:
        """Motions with inertia; with `massless` they are a basis of `bound`, (links, n - m)."""
        if not self.massless.size:
            return self.bound
        from scipy import linalg  # slow import, seldom needed

        part, *_ = linalg.lstsq(self.bound, self.massless)
        return np.delete(self.bound, _pivots(part), axis=1)


def coordinates(system: TorsionalSystem) -> Coordinates:
    """Split the motions that the constraints of a system allow.

    Motions that neither inertia nor a component resists are held at 0 and take part in no mode.
    Links that only dampers resist have no mode either; they follow the other links.

    Examples
    --------
    Two masses with a massless link between them, free to rotate together:

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> springs = [Spring({1: 1, 2: -1}, stiffness=9.0), Spring({2: 1, 3: -1}, stiffness=9.0)]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 1.0, 3: 2.0})
    >>> split = coordinates(torsional_system(case, case.gears[0]))
    >>> split.heavy.shape, split.massless.T, split.rigid.T
    ((3, 2), array([[0., 1., 0.]]), array([[1., 1., 1.]]))
    """
    elastic = system.elastic_twists
    bodies = system.heavy
    loose = system.free(*elastic, *bodies, *(damper.twist for damper in system.dampers))
    held = [{link: 1.0} for link in _pivots(loose)]
    drifting = system.free(*held, *elastic, *bodies)
    bound = [*held, *({link: 1.0} for link in _pivots(drifting))]
    every, massless, rigid = (system.free(*bound, *forms) for forms in ((), bodies, elastic))
    if drifting.size:  # the torques of all dampers on a drifting link add up to 0
        resisted = drifting.T @ system.slip_resistance
        followed = drifting @ np.linalg.pinv(resisted @ drifting) @ resisted
        every, massless, rigid = (each - followed @ each for each in (every, massless, rigid))
    undetermined = np.any(loose != 0, axis=1)
    return Coordinates(system.free(*held), every, massless, rigid, drifting, undetermined)


def _pivots(motions: Floats) -> list[int]:
    """Return the indices of as many rows as there are motions, which determine the motions."""
    if not motions.size:
        return []
    from scipy import linalg

    _, _, order = linalg.qr(motions.T, mode="economic", pivoting=True)
    return order[: motions.shape[1]].tolist()  # type: ignore[no-any-return]


Values = TypeVar("Values", bound=np.ndarray[Any, np.dtype[Any]])
"""Real or complex amplitudes."""


def form_values(form: Form, shapes: Values) -> Values:
    """Return values of a linear form of link angles, shape (modes,), for shapes (links, modes)."""
    total = np.zeros(shapes.shape[1:], shapes.dtype)
    for link, part in form.items():
        total += part * shapes[link]
    return total  # type: ignore[return-value] # of the dtype of the shapes


def without_rounding(left: Floats, right: Floats) -> Floats:
    """Return a product of matrices, with 0 instead of results that are only rounding errors."""
    product = left @ right
    return np.where(np.abs(product) > UNMOVED * (np.abs(left) @ np.abs(right)), product, 0.0)
