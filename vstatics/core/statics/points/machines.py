"""Electric machines: efficiency over speed and torque, power of the battery."""

from __future__ import annotations

import numpy as np

from vstatics.core.model.parts import Law
from vstatics.core.numerics.arrays import Floats


def machine_efficiency(law: Law, speed: Floats, torque: Floats) -> Floats:
    """Return the efficiency of a machine by a map or a formula.

    Parameters
    ----------
    law : Law
        Law over speed and torque. A formula, and a map with torques below 0, has the torque with
        its sign along the speed: below 0 the machine generates. [-]
    speed : ndarray
        Magnitude of the speed. [rad/s]
    torque : ndarray
        Torque along the speed. [N*m]

    Examples
    --------
    >>> from vstatics.core.model.laws import MapLaw
    >>> by_sign = MapLaw([-10, 0, 10], [[0, 0.8, 0.7, 0.9], [50, 0.8, 0.7, 0.9]])
    >>> machine_efficiency(by_sign, np.array([20.0, 20.0]), np.array([10.0, -5.0])).tolist()
    [0.9, 0.75]
    """
    return law.at(*law.sizes_of(speed, machine_torque(law, torque)))


def machine_torque(law: Law, torque: Floats) -> Floats:
    """Return the torque at which the law of a machine is read [N*m]: signed, or its magnitude."""
    return torque if law.text or law.columns[0] < 0 else np.abs(torque)  # type: ignore[attr-defined] # a map


def efficiency_at(given: float, speed: Floats, torque: Floats, power: Floats) -> Floats:
    """Return the efficiency of a machine; NaN where a formula gives none though power flows."""
    if not isinstance(given, Law):
        return np.full(power.shape, given)
    values = machine_efficiency(given, speed, torque)
    return np.where(power == 0, 1.0, np.where((values > 0) & (values <= 1), values, np.nan))


def battery_power(power: Floats, efficiency: Floats | float) -> Floats:
    """Return the charging power of a battery for the power given to a machine.

    >>> battery_power(np.array([2.0, -2.0]), 0.8).tolist()
    [1.6, -2.5]
    """
    return np.where(power > 0, power * efficiency, power / efficiency)
