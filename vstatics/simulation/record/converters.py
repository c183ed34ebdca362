"""Speed ratio and efficiency of torque converters during a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.model.converters import Converter
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.tolerances import STANDING


def turbine(converter: str) -> str:
    """Return the row name of the torque that a converter gives to its turbine link."""
    return f"{converter}.turbine"


def speed_ratios(converters: Sequence[Converter], speeds: Floats) -> Floats:
    """Return turbine speed over pump speed, shape (converters, times); NaN if the pump is at rest.

    Parameters
    ----------
    speeds : ndarray, shape (links, times)
        Speeds of all links. [rad/s]
    """
    pumps = speeds[[converter.pump - 1 for converter in converters]]
    turbines = speeds[[converter.turbine - 1 for converter in converters]]
    return turbines / turning(pumps, speeds)


def turning(divisors: Floats, speeds: Floats) -> Floats:
    """Return speeds as divisors, with NaN instead of 0.

    A speed counts as 0 if it is rounding noise relative to the fastest link.
    """
    return np.where(np.abs(divisors) > STANDING * np.abs(speeds).max(axis=0), divisors, np.nan)


def efficiencies(converters: Sequence[Converter], ratios: Floats, given: Floats) -> Floats:
    """Return output power divided by input power, shape (converters, times).

    With torque ratio K and speed ratio i, the efficiency is ``K i`` (Tarasik, figure 7). It is the
    inverse while the turbine drives, and 0 while power enters at both sides.

    Parameters
    ----------
    ratios : ndarray, shape (converters, times)
        Speed ratios, from `speed_ratios`. [-]
    given : ndarray, shape (converters, times)
        Power at the pump. [W]

    Examples
    --------
    >>> tc = Converter("TC", 1, 2, ((0.0, 2.0, 2e-3), (1.0, 1.0, 0.0), (1.5, 1.0, -1e-3)))
    >>> efficiencies([tc], np.array([[0.5, 1.0, 1.25, -0.1]]), np.array([[9.0, 0.0, -9.0, 9.0]]))
    array([[0.75, 1.  , 0.8 , 0.  ]])
    """
    products = np.array(
        [
            ratio * np.interp(ratio, *np.array(converter.points).T[:2])
            for converter, ratio in zip(converters, ratios, strict=True)
        ]
    )
    driven_back = (given < 0) & (products > 0)
    efficiency: Floats = np.divide(1.0, products, out=products.copy(), where=driven_back)
    return np.maximum(efficiency, 0.0)
