"""Speeds as rows: what links, shift elements and mechanisms see of the speeds of all links."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from vstatics.model.parts import HOUSING
from vstatics.numerics.arrays import Floats


def unit(index: int, links: int) -> Floats:
    """The speed of a link, by its index."""
    return combination([(index + 1, 1.0)], links)


def combination(parts: Iterable[tuple[int, float]], links: int) -> Floats:
    """Links by their numbers, each with its coefficient; the housing stands still.

    Examples
    --------
    >>> combination([(1, 1.0), (0, 2.0), (3, -3.0)], 3)
    array([ 1.,  0., -3.])
    """
    row = np.zeros(links)
    for link, part in parts:
        if link != HOUSING:
            row[link - 1] += part
    return row


def between(first: int, second: int, links: int) -> Floats:
    """First link against second, by their numbers.

    Examples
    --------
    >>> between(2, 0, 3)
    array([0., 1., 0.])
    """
    return combination([(first, 1.0), (second, -1.0)], links)
