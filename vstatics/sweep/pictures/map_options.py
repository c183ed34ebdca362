"""Options that only maps have: contour levels, best gear, operating points, full-load curves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.extras import higher

MOST_MAP_LEVELS = 100
"""Largest number of contour levels that a user can request."""


class OperatingPoint(NamedTuple):
    """Operating point of a duty cycle, to be drawn on a map."""

    gear: str
    speed: float
    """Input speed. [rad/s]"""
    torque: float
    """Input torque. [N*m]"""


def operating_points(data: bytes, file: str) -> list[OperatingPoint]:
    """Read the operating points of a duty cycle in CSV.

    Raises
    ------
    ReadError
        If the file is in error.
    """
    return [OperatingPoint(*point) for point in higher("duty_points")(data, file)]


FullLoad = Sequence[tuple[float, float]]
"""Points of a full-load curve, each with speed [rad/s] and torque [N*m]."""


class MapOptions(NamedTuple):
    """Options that only maps have."""

    levels: int | Sequence[float] | None = None
    """Approximate number of contour levels, or the levels in ascending order.

    With None, the levels are chosen automatically.
    """
    best_gear: bool = False
    """True to draw the regions of the gear with the largest value."""
    points: Sequence[OperatingPoint] = ()
    limits: Sequence[FullLoad] = ()


def checked_levels(levels: int | Sequence[float] | None) -> int | Sequence[float] | None:
    """Check and return a number of contour levels, or the contour levels.

    Raises
    ------
    ValueError
        If the number is out of range, or the levels are not finite and ascending.
    """
    most = MOST_MAP_LEVELS
    if levels is None:
        return None
    if isinstance(levels, int):
        is_valid = 0 < levels <= most
    else:
        is_finite = 0 < len(levels) <= most and all(map(math.isfinite, levels))
        is_valid = is_finite and list(levels) == sorted({*levels})
    if is_valid:
        return levels
    raise ValueError(
        f"read {levels}, expected 1 to {most}, or at most {most} levels in ascending order"
    )
