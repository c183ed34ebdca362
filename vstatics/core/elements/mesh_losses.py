"""Efficiency of single meshes, from the case or calculated from teeth and friction.

Friction losses follow from Ohlendorf's loss factor H (Niemann, Winter, Maschinenelemente II). The
pairs of teeth in contact are assumed to share the load equally. The efficiency of a mesh is ``eta =
1 - pi mu (1/z1 +- 1/z2) H`` with ``H = 1 - e1 - e2 + e1^2 + e2^2``. Here mu is the coefficient of
friction, z1 and z2 are the numbers of teeth, and e1 and e2 the contact ratios at the tips. The
minus applies to an internal mesh. Standard teeth without profile shift are assumed: a pressure
angle of 20 degrees, an addendum of one module, and a tip diameter of z - 2 modules for a ring of z
teeth. The formula is exact if e1 and e2 are at most 1. For most rings the contact ratio is a little
larger, which makes the result conservative.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from vstatics.core.elements.element import MeshEfficiency

PRESSURE_ANGLE = math.radians(20)
"""Pressure angle of standard teeth. [rad]"""
LEAST_RING = 34
"""Smallest number of teeth of a ring whose tip circle is larger than the base circle."""


class MeshLosses(NamedTuple):
    """Losses of the meshes of a gear set."""

    numbers: MeshEfficiency
    """Efficiencies used for meshes whose efficiency is not calculated from friction. [-]"""
    friction: float | None = None
    """Coefficient of friction of the teeth [-]; None for efficiencies from `numbers` only."""
    given: frozenset[str] = frozenset()
    """Meshes whose efficiency in `numbers` takes precedence over friction."""

    def efficiency(self, mesh: str, teeth: float | None, others: float | None) -> float:
        """Return the efficiency of a mesh: ``external``, ``internal`` or ``bevel`` [-].

        `teeth` and `others` are the tooth numbers of both gears; in an internal mesh `others` is
        the ring.

        Examples
        --------
        >>> losses = MeshLosses(MeshEfficiency(), 0.06)
        >>> round(losses.efficiency("external", 20, 40), 6), losses.efficiency("bevel", 20, 40)
        (0.990036, 0.97)
        """
        given: float = getattr(self.numbers, mesh)
        if self.friction is None or mesh == "bevel" or mesh in self.given or not (teeth and others):
            return given
        return mesh_efficiency(float(teeth), float(others), self.friction, mesh == "internal")


def mesh_losses(case: Mapping[str, float], element: Mapping[str, float]) -> MeshLosses:
    """Return the mesh losses of a gear set from its `mesh_efficiency` and that of the case.

    Friction of a gear set takes precedence over efficiencies of the case.

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
    """Return the efficiency of a mesh of standard teeth [-]. `others` can be the teeth of a ring.

    Examples
    --------
    >>> round(mesh_efficiency(24, 60, 0.06, True), 6)
    0.995094
    """
    e1, e2 = tip_contact(teeth), tip_contact(others, is_ring=is_internal)
    sliding = 1 / teeth + (-1 / others if is_internal else 1 / others)
    return 1 - math.pi * friction * sliding * (1 - e1 - e2 + e1**2 + e2**2)


def tip_contact(teeth: float, *, is_ring: bool = False) -> float:
    """Return the contact ratio from the pitch point to the tip of a gear [-].

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
