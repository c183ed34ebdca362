"""Electric machines: efficiency over speed and torque, power of the battery."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.model.parts import Law
from vstatics.core.numerics.arrays import Booleans, Floats


def machine_efficiency(law: Law, speed: Floats, torque: Floats) -> Floats:
    """Return the efficiency of a machine from a map or formula.

    Parameters
    ----------
    law : Law
        Efficiency over speed and torque. A formula, or a map that contains torques below 0, is
        evaluated at the signed torque, which is below 0 for a generator. Other maps are evaluated
        at the magnitude. [-]
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
    return law.at(*_sizes(law, speed, torque))


def outside_map(law: Law, speed: Floats, torque: Floats, power: Floats) -> Booleans:
    """Return True where power [W] flows at a speed and torque outside the efficiency map."""
    outside: Booleans = law.is_outside(*_sizes(law, speed, torque)) & (power != 0)
    return outside


def _sizes(law: Law, speed: Floats, torque: Floats) -> Sequence[Floats]:
    signed = law.text or law.columns[0] < 0  # type: ignore[attr-defined] # a map
    return law.sizes_of(speed, torque if signed else np.abs(torque))


def efficiency_at(given: float, speed: Floats, torque: Floats, power: Floats) -> Floats:
    """Return the efficiency of a machine [-]; NaN if power flows but the formula is not valid."""
    if not isinstance(given, Law):
        return np.full(power.shape, given)
    values = machine_efficiency(given, speed, torque)
    return np.where(power == 0, 1.0, np.where((values > 0) & (values <= 1), values, np.nan))


def battery_power(power: Floats, efficiency: Floats | float) -> Floats:
    """Return the charging power of a battery from the shaft power that drives the machine [W].

    >>> battery_power(np.array([2.0, -2.0]), 0.8).tolist()
    [1.6, -2.5]
    """
    return np.where(power > 0, power * efficiency, power / efficiency)
