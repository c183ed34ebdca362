"""Loss measured for a whole gear, represented by a torque that brakes the input link."""

from __future__ import annotations

import numpy as np

from vstatics.core.model.parts import Law, Size
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.tolerances import SAME_SOLUTION

ROUNDING = 1e-12
"""Relative distance from an interval of the map up to which a solution counts as inside. [-]"""


def brake_torque(loss: Law, speed: Floats, torque: Floats) -> Floats:
    """Return the torque by which a loss brakes the input link, 0 at rest [N*m].

    Parameters
    ----------
    loss : Law
        Map of the loss, with its unit.
    speed, torque : ndarray
        Magnitudes of the speed [rad/s] and the torque [N*m] of the input.

    Examples
    --------
    >>> from vstatics.core.model.laws import MapLaw
    >>> loss = MapLaw([0, 100], [[0, 0, 0], [100, 200, 400]], "W")
    >>> brake_torque(loss, np.array([50.0, 0.0]), np.array([100.0, 100.0])).tolist()
    [4.0, 0.0]
    """
    if _unit(loss) == "N*m":
        values: Floats = loss.at(speed, torque)
        return np.where(speed > 0, values, 0.0)
    watts = power_loss(loss, speed, torque)
    return np.divide(watts, speed, out=np.zeros_like(watts), where=speed > 0)


def _unit(loss: Law) -> str:
    return getattr(loss, "unit", "W")


def power_loss(loss: Law, speed: Size, torque: Size) -> Size:
    """Return a power loss [W] at magnitudes of input speed [rad/s] and input torque [N*m].

    >>> from vstatics.core.model.laws import MapLaw
    >>> power_loss(MapLaw([0, 100], [[0, 0, 0], [100, 2, 4]], "kW"), 50.0, 100.0)
    2000.0
    """
    unit, value = _unit(loss), loss.at(speed, torque)
    return value * (speed if unit == "N*m" else 1000.0 if unit == "kW" else 1.0)


def braked_torques(loss: Law, speed: Floats, passed: Floats) -> tuple[Floats, Integers]:
    """Return input torques T with ``T - brake torque(T) = passed``, and the number of solutions.

    Parameters
    ----------
    loss : Law
        Map of the loss.
    speed : ndarray
        Magnitude of the input speed. [rad/s]
    passed : ndarray
        Input torque minus brake torque, in the direction of the speed. [N*m]

    Examples
    --------
    A brake torque of a tenth of the input torque leaves nine tenths.

    >>> from vstatics.core.model.laws import MapLaw
    >>> loss = MapLaw([0, 1000], [[0, 0, 100], [100, 0, 100]], "N*m")
    >>> braked_torques(loss, np.array([50.0]), np.array([90.0]))
    (array([100.]), array([1]))
    """
    columns = np.array(loss.columns)  # type: ignore[attr-defined] # a map
    ends = np.concatenate([-columns[::-1], columns])
    at_ends = brake_torque(
        loss, np.repeat(speed, len(ends)), np.tile(np.abs(ends), len(speed))
    ).reshape(len(speed), len(ends))
    # The brake torque is linear between the torques of the map and constant outside.
    low = np.concatenate([[-np.inf], ends])
    high = np.concatenate([ends, [np.inf]])
    with np.errstate(invalid="ignore"):
        widths = np.where(np.isfinite(high - low), high - low, 1.0)
    first = np.concatenate([at_ends[:, :1], at_ends], axis=1)
    last = np.concatenate([at_ends, at_ends[:, -1:]], axis=1)
    slopes = np.where(widths > 0, (last - first) / np.where(widths > 0, widths, 1.0), 0.0)
    starts = np.where(np.isfinite(low), low, high)
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = (passed[:, None] + first - slopes * starts) / (1 - slopes)
    room = ROUNDING * (np.abs(roots) + 1)
    is_root = (roots >= low - room) & (roots <= high + room) & (widths > 0)
    least = np.where(is_root, roots, np.inf).min(axis=1)
    most = np.where(is_root, roots, -np.inf).max(axis=1)
    counts = np.where(
        least > most, 0, np.where(most - least > SAME_SOLUTION * (1 + np.abs(most)), 2, 1)
    )
    return np.where(counts == 1, least, np.nan), counts
