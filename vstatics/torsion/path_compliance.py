"""How far links turn under a torque while others are held: the compliance of what is between.

On the way of the power every elastic device has its part, wherever it stands in it: shafts,
the mounting of a casing that takes a reaction, shafts side by side.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import linalg

from vstatics.numerics.motions import free_motions
from vstatics.torsion.coordinates import rows
from vstatics.torsion.system import TorsionalSystem


def path_compliance(
    system: TorsionalSystem, near: Sequence[int], speeds: Sequence[float], far: Sequence[int]
) -> float | None:
    """The compliance from some links to others that are held, on the reference shaft.

    Elastic torques M that balance a torque of 1 there have the least ``sum E M^2``, which is
    the compliance (Castigliano). In a chain it is the sum of the reduced compliances.

    Parameters
    ----------
    near : sequence of int
        Indices of links that turn as one, the first with the torque.
    speeds : sequence of float
        Theirs by that of the reference shaft. [-]
    far : sequence of int
        Indices of links that are held.

    Returns
    -------
    float or None
        [rad/(N*m)]; none where nothing resists.

    Examples
    --------
    Two shafts with a gear pair of ratio -2 between them, on the first: ``E_1 + 4 E_2``.

    >>> from vstatics import Mechanism, Spring, Transmission
    >>> from vstatics.torsion.system import torsional_system
    >>> shafts = [Spring({1: 1, 2: -1}, compliance=0.1), Spring({3: 1, 4: -1}, compliance=0.2)]
    >>> case = Transmission(4, [], [Mechanism(2, 3, 0, -2.0)], [], springs=shafts)
    >>> round(path_compliance(torsional_system(case, case.gears[0]), [0], [1.0], [3]), 6)
    0.9
    """
    held = [{link: 1.0} for link in far]
    together = [
        {near[0]: speed, link: -speeds[0]} for link, speed in zip(near[1:], speeds[1:], strict=True)
    ]
    fixed = [*(device.twist for device in system.rigid), *held, *together]
    elastic = [device.twist for device in system.elastic]
    links = len(system.names)
    if free_motions([*fixed, *elastic], links)[near[0]].any():
        return None
    free = free_motions(fixed, links)
    acting = free[near[0]] / speeds[0]
    if not acting.any():
        return 0.0
    roots = np.sqrt([device.stiffness or 0.0 for device in system.elastic])
    twists = np.asarray(roots)[:, None] * (rows(elastic, system) @ free)
    weighted, *_ = linalg.lstsq(twists.T, acting)
    return float(weighted @ weighted)
