"""Torque converter at an operating point: torques of pump and turbine, and their derivatives.

The torques are ``M_P = lambda w_P |w_P|`` and ``M_T = K M_P``, where the coefficient lambda and the
torque ratio K are functions of the speed ratio ``i = w_T/w_P``. With ``f = K lambda``, ``w =
|w_P|`` and primes for d/di the derivatives are

    dM_P/dw_P = A1 = w (2 lambda - i lambda'),  dM_P/dw_T = A2 = w lambda',
    dM_T/dw_P = A3 = w (2 f - i f'),            dM_T/dw_T = A4 = w f'

(Tsitovich, Algin, Vehicle dynamics, 1981, (1.44), (1.46)). The derivatives at a point of the
characteristic are those above the point.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.tables.answer import json_keys


@json_keys(
    *("speed_ratio", "pump_speed", "pump_torque", "turbine_torque"),
    *("A1", "A2", "A3", "A4"),
)
class WorkingConverter(NamedTuple):
    """Torque converter linearised at an operating point."""

    name: str
    pump: int
    turbine: int
    """Index of the link of the turbine; `pump` is the index of the link of the pump."""
    speed_ratio: float
    """Turbine speed divided by pump speed. [-]"""
    pump_speed: float
    """Speed of the pump. [rad/s]"""
    pump_torque: float
    """Torque that the pump takes. [N*m]"""
    turbine_torque: float
    """Torque that the turbine gives. [N*m]"""
    A1: float
    """Derivative of the pump torque with respect to the pump speed. [N*m*s/rad]"""
    A2: float
    """Derivative of the pump torque with respect to the turbine speed. [N*m*s/rad]"""
    A3: float
    """Derivative of the turbine torque with respect to the pump speed. [N*m*s/rad]"""
    A4: float
    """Derivative of the turbine torque with respect to the turbine speed. [N*m*s/rad]"""


class Characteristic(NamedTuple):
    """Torque ratio and lambda at a speed ratio, with their derivatives (`by_ratio`)."""

    torque_ratio: float
    factor: float
    """Lambda: pump torque divided by the square of the pump speed. [N*m*s^2]"""
    by_ratio: tuple[float, float] = (0.0, 0.0)


def characteristic(points: Sequence[tuple[float, ...]], ratio: float) -> Characteristic:
    """Interpolate points ``(i, K, lambda)`` linearly, constant outside.

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
    """Linearise a converter at a speed ratio and a pump speed [rad/s].

    Examples
    --------
    >>> points = [(0, 2.5, 0.003), (0.5, 1.5, 0.0032), (0.9, 1, 0.0015), (1, 1, 0)]
    >>> [round(x, 9) for x in working_converter("TC", (0, 1), points, 0.7, 200.0)[5:]]
    [94.0, 117.5, 1.535, -0.85, 2.33, -1.65]
    """
    values, size = characteristic(points, ratio), abs(speed)
    of_pump, slope_of_pump = values.factor, values.by_ratio[1]
    of_turbine = values.torque_ratio * of_pump
    slope_of_turbine = values.by_ratio[0] * of_pump + values.torque_ratio * slope_of_pump
    return WorkingConverter(
        name,
        *links,
        ratio,
        speed,
        of_pump * speed * size,
        of_turbine * speed * size,
        size * (2 * of_pump - ratio * slope_of_pump),
        size * slope_of_pump,
        size * (2 * of_turbine - ratio * slope_of_turbine),
        size * slope_of_turbine,
    )
