"""The free motions of a torsional system, and how they are split: rigid, massless, the rest.

All of it follows from linear forms alone, of rigid devices, twists and bodies, and not from how
stiff or heavy anything is: so a soft support is not taken for a rigid motion.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.motions import Form
from vstatics.torsion.system.gear_system import TorsionalSystem

MANY = 300
"""Links from which on all modes at once take longer than the lowest few."""


class Coordinates(NamedTuple):
    """Motions of all links, by columns."""

    free: Floats
    """Shape (links, n): all of them."""
    massless: Floats
    """Shape (links, m): those without inertia, which elastic devices resist."""
    rigid: Floats
    """Shape (links, r): those that twist nothing, and have inertia."""
    undetermined: Booleans
    """Of each link: whether it takes part in a motion with neither inertia nor resistance."""

    @property
    def modes(self) -> int:
        """How many modes there are that are not rigid."""
        return len(self.free.T) - len(self.massless.T) - len(self.rigid.T)

    def has_many_more(self, count: int) -> bool:
        """Whether the lowest so many modes are found sooner by themselves than with all."""
        return len(self.free) > MANY and count < self.modes // 2

    @property
    def heavy(self) -> Floats:
        """Shape (links, n - m): motions that with the massless ones make up all."""
        count = self.massless.shape[1]
        if not count:
            return self.free
        from scipy import linalg  # most systems do without

        part, *_ = linalg.lstsq(self.free, self.massless)
        _, _, order = linalg.qr(part.T, mode="economic", pivoting=True)
        chosen: Floats = self.free[:, np.sort(order[count:])]
        return chosen


def coordinates(system: TorsionalSystem) -> Coordinates:
    """Split the free motions of a system.

    What neither inertia nor a device resists is held: it takes no part in any mode.

    Examples
    --------
    Two masses with a massless link between them, free to turn together:

    >>> from vstatics import Spring, Transmission
    >>> from vstatics.torsion.system.gear_system import torsional_system
    >>> springs = [Spring({1: 1, 2: -1}, stiffness=9.0), Spring({2: 1, 3: -1}, stiffness=9.0)]
    >>> case = Transmission(3, [], [], [], springs=springs, inertias={1: 1.0, 3: 2.0})
    >>> split = coordinates(torsional_system(case, case.gears[0]))
    >>> split.heavy.shape, split.massless.T, split.rigid.T
    ((3, 2), array([[0., 1., 0.]]), array([[1., 1., 1.]]))
    """
    elastic = system.elastic_twists
    bodies = [body.form for body in system.bodies if body.inertia > 0]
    loose = system.free(*elastic, *bodies, *(damper.twist for damper in system.dampers))
    held: list[Form] = [{pinned: 1.0} for pinned in _own_places(loose)]
    return Coordinates(
        free=system.free(*held),
        massless=system.free(*held, *bodies),
        rigid=system.free(*held, *elastic),
        undetermined=np.any(loose != 0, axis=1),
    )


def _own_places(motions: Floats) -> list[int]:
    """Links by which some motions are known: where these are held there is none of them."""
    if not motions.shape[1]:
        return []
    from scipy import linalg

    _, _, order = linalg.qr(motions.T, mode="economic", pivoting=True)
    return [int(link) for link in order[: motions.shape[1]]]


Values = TypeVar("Values", bound=np.ndarray[Any, np.dtype[Any]])
"""Real or complex amplitudes."""


def form_values(form: Form, shapes: Values) -> Values:
    """A form of the angles of links, of shape (modes,) for shapes of (links, modes)."""
    total = np.zeros(shapes.shape[1:], shapes.dtype)
    for link, part in form.items():
        total += part * shapes[link]
    return total  # type: ignore[return-value] # of the same kind
