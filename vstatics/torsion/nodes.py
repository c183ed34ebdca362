"""Nodes of a mode: where what vibrates stands still."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from vstatics.numerics.arrays import Floats
from vstatics.numerics.tolerances import TIE
from vstatics.torsion.coordinates import Coordinates
from vstatics.torsion.system import TorsionalSystem


def count_nodes(system: TorsionalSystem, split: Coordinates, shapes: Floats) -> NDArray[np.intp]:
    """How many places stand still in each mode.

    An elastic device has a node in it where all terms of its twist pull the same way: of a
    shaft, where its ends turn against each other. A link that an elastic device joins and that
    could move is one by itself where it stands; what is rigidly joined to it is the same one.

    Parameters
    ----------
    shapes : ndarray, shape (links, modes)
        The largest amplitude of each is about 1.
    """
    nodes = np.zeros(shapes.shape[1], np.intp)
    stands = np.abs(shapes) <= TIE
    moving = np.where(stands, 0.0, shapes)
    for device in system.elastic:
        terms = np.array([part * moving[link] for link, part in device.twist.items()])
        same = np.all(terms >= 0, axis=0) | np.all(terms <= 0, axis=0)
        nodes += same & (np.count_nonzero(terms, axis=0) > 1)
    joined = sorted({link for device in system.elastic for link in device.twist})
    movable = [link for link in joined if stands[link].any() and split.free[link].any()]
    for link in {split.free[link].tobytes(): link for link in reversed(movable)}.values():
        nodes += stands[link]
    return nodes
