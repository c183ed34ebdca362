"""The torques of a converter by the speeds of its pump and its turbine."""

from __future__ import annotations

from bisect import bisect_right
from typing import Any

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.scenario import Converter


def converter_torques(
    converter: Converter, piece: int, pump: float, turbine: float
) -> tuple[float, float]:
    """Torques that a converter takes from its pump and from its turbine, by their speeds.

    ``M_P = lambda w_P |w_P|`` and ``-K M_P`` (Tsitovich, Algin, (1.38)), with K and lambda by the
    straight line of a piece; none with the pump at rest.
    """
    if pump == 0:
        return 0.0, 0.0
    factor, coefficient = _on_piece(converter, piece, turbine / pump)
    taken = coefficient * pump * abs(pump)
    return taken, -factor * taken


def converter_torques_at(
    converter: Converter, piece: int, pumps: Floats, turbines: Floats
) -> tuple[Floats, Floats]:
    """The same at several instants."""
    turns = pumps != 0
    ratios = np.divide(turbines, pumps, out=np.zeros_like(pumps), where=turns)
    factor, coefficient = _on_piece(converter, piece, ratios)
    taken = np.where(turns, coefficient * pumps * np.abs(pumps), 0.0)
    return taken, -factor * taken


def converter_piece(converter: Converter, ratio: float) -> int:
    """The piece of the points that holds from a ratio of speeds on; piece 0 is before the first."""
    return bisect_right([point[0] for point in converter.points], ratio)


def _on_piece(converter: Converter, piece: int, ratio: Any) -> tuple[Any, Any]:
    """K and lambda."""
    points = converter.points
    if piece in (0, len(points)):
        return points[min(piece, len(points) - 1)][1:]
    (i0, k0, l0), (i1, k1, l1) = points[piece - 1 : piece + 1]
    part = (ratio - i0) / (i1 - i0)
    return k0 + part * (k1 - k0), l0 + part * (l1 - l0)
