"""A torque converter at a working point: torques of pump and turbine, and their slopes.

With ``M_P = lambda w_P |w_P|``, ``M_T = K M_P``, both by ``i = w_T/w_P``, and ``f = K lambda``, ``w
= |w_P|``, primes for d/di:

    dM_P/dw_P = A1 = w (2 lambda - i lambda'),  dM_P/dw_T = A2 = w lambda',
    dM_T/dw_P = A3 = w (2 f - i f'),            dM_T/dw_T = A4 = w f'

(Tsitovich, Algin, Vehicle dynamics, 1981, (1.44), (1.46)). At a corner of the points the slope
above it holds.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.tables.answer import told


@told(
    *("speed_ratio", "pump_speed", "pump_torque", "turbine_torque"),
    *("A1", "A2", "A3", "A4"),
)
class WorkingConverter(NamedTuple):
    """A converter about its working point."""

    name: str
    pump: int
    turbine: int
    """Indices of its links."""
    speed_ratio: float
    """Of the turbine by the pump. [-]"""
    pump_speed: float
    """[rad/s]"""
    pump_torque: float
    """That the pump takes. [N*m]"""
    turbine_torque: float
    """That the turbine gives. [N*m]"""
    A1: float
    """Slope of the pump's torque by the pump's speed. [N*m*s/rad]"""
    A2: float
    """Of the pump's by the turbine's."""
    A3: float
    """Of the turbine's by the pump's."""
    A4: float
    """Of the turbine's by the turbine's."""


class Characteristic(NamedTuple):
    """Torque ratio and lambda at a speed ratio, with their slopes over it."""

    torque_ratio: float
    factor: float
    """Lambda. [N*m*s^2]"""
    by_ratio: tuple[float, float] = (0.0, 0.0)


def characteristic(points: Sequence[tuple[float, ...]], ratio: float) -> Characteristic:
    """By points ``i, K, lambda``: straight between, constant outside.

    Examples
    --------
    >>> characteristic([(0, 2.5, 3.0), (0.5, 1.5, 4.0), (1, 1, 0)], 0.5)
    Characteristic(torque_ratio=1.5, factor=4.0, by_ratio=(-1.0, -8.0))
    """
    above = bisect_right([point[0] for point in points], ratio)
    if above in (0, len(points)):
        _, torque_ratio, factor = points[max(above - 1, 0)]
        return Characteristic(torque_ratio, factor)
    (i0, k0, l0), (i1, k1, l1) = points[above - 1 : above + 1]
    slopes = (k1 - k0) / (i1 - i0), (l1 - l0) / (i1 - i0)
    part = ratio - i0
    return Characteristic(k0 + slopes[0] * part, l0 + slopes[1] * part, slopes)


def working_converter(
    name: str,
    links: tuple[int, int],
    points: Sequence[tuple[float, ...]],
    ratio: float,
    speed: float,
) -> WorkingConverter:
    """A converter at a speed ratio and a speed of its pump [rad/s].

    Examples
    --------
    >>> points = [(0, 2.5, 0.003), (0.5, 1.5, 0.0032), (0.9, 1, 0.0015), (1, 1, 0)]
    >>> [round(one, 9) for one in working_converter("TC", (0, 1), points, 0.7, 200.0)[5:]]
    [94.0, 117.5, 1.535, -0.85, 2.33, -1.65]
    """
    found, size = characteristic(points, ratio), abs(speed)
    of_pump, bend = found.factor, found.by_ratio[1]
    of_turbine = found.torque_ratio * of_pump
    bend_of_turbine = found.by_ratio[0] * of_pump + found.torque_ratio * bend
    return WorkingConverter(
        name,
        *links,
        ratio,
        speed,
        of_pump * speed * size,
        of_turbine * speed * size,
        size * (2 * of_pump - ratio * bend),
        size * bend,
        size * (2 * of_turbine - ratio * bend_of_turbine),
        size * bend_of_turbine,
    )
