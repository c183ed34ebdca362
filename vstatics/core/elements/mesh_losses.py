"""Efficiency of single meshes: numbers of the case, or from the teeth and their friction.

Ohlendorf's loss factor as in Niemann, Winter, Maschinenelemente II: with equal shares of the load
between the pairs of teeth in contact ``eta = 1 - pi mu (1/z1 +- 1/z2) H`` with ``H = 1 - e1 - e2 +
e1^2 + e2^2``, minus inside a ring; e1, e2 are the parts of the contact ratio at the tips. Standard
teeth without shift: 20 degrees, addendum 1, the tip of a ring at z - 2. The sum is exact while e1
and e2 are no more than 1; the tip of most rings reaches a little further, then it is on the safe
side.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.core.elements.element import MeshEfficiency

PRESSURE_ANGLE = math.radians(20)
"""Of standard teeth. [rad]"""
LEAST_RING = 34
"""Teeth of a ring whose tip lies outside its base circle."""


class MeshLosses(NamedTuple):
    """What meshes of an element lose."""

    numbers: MeshEfficiency
    friction: float | None = None
    """Coefficient of friction of the teeth [-]; None: `numbers` hold."""
    given: frozenset[str] = frozenset()
    """Meshes whose number is given, and holds though there is friction."""

    def efficiency(self, mesh: str, teeth: float | None, others: float | None) -> float:
        """Of a mesh: ``external``, ``internal`` (the other wheel is the ring), ``bevel`` [-].

        Examples
        --------
        >>> losses = MeshLosses(MeshEfficiency(), 0.06)
        >>> round(losses.efficiency("external", 20, 40), 6), losses.efficiency("bevel", 20, 40)
        (0.990036, 0.97)
        """
        own: float = getattr(self.numbers, mesh)
        if self.friction is None or mesh == "bevel" or mesh in self.given or not (teeth and others):
            return own
        return mesh_efficiency(float(teeth), float(others), self.friction, mesh == "internal")


def mesh_losses(case: Mapping[str, float], element: Mapping[str, float]) -> MeshLosses:
    """What the case and an element say; friction of an element goes before numbers of the case.

    Examples
    --------
    >>> mesh_losses({"external": 0.95}, {"friction": 0.06}).given
    frozenset()
    """
    merged = {**case, **element}
    friction = merged.pop("friction", None)
    given = element if "friction" in element else merged
    names = frozenset(given) - {"friction"}
    return MeshLosses(MeshEfficiency(**merged), friction, names)


def mesh_efficiency(
    teeth: float,
    others: float,
    friction: float,
    is_internal: bool,  # noqa: FBT001
) -> float:
    """Efficiency of a mesh of standard teeth, the second wheel a ring if it is internal [-].

    Examples
    --------
    >>> round(mesh_efficiency(24, 60, 0.06, True), 6)
    0.995094
    """
    one, other = tip_contact(teeth), tip_contact(others, is_ring=is_internal)
    sliding = 1 / teeth + (-1 / others if is_internal else 1 / others)
    return 1 - math.pi * friction * sliding * (1 - one - other + one**2 + other**2)


def tip_contact(teeth: float, *, is_ring: bool = False) -> float:
    """The part of the contact ratio at the tip of a wheel: from there to the pitch point [-].

    Examples
    --------
    >>> round(tip_contact(20), 6), round(tip_contact(60, is_ring=True), 6)
    (0.778419, 1.171243)
    """
    pitch, way = teeth / 2, -1 if is_ring else 1
    base = pitch * math.cos(PRESSURE_ANGLE)
    at_tip = math.sqrt((pitch + way) ** 2 - base**2)
    length = way * (at_tip - pitch * math.sin(PRESSURE_ANGLE))
    return length / (math.pi * math.cos(PRESSURE_ANGLE))
