"""The ratios of converters along a run: of their speeds, and of their powers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from vstatics.core.model.converters import Converter
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.tolerances import STANDING


def turbine(converter: str) -> str:
    """The name of the row of torques that the turbine gives to its link."""
    return f"{converter}.turbine"


def speed_ratios(converters: Sequence[Converter], speeds: Floats) -> Floats:
    """``i = w_T/w_P``, shape (converters, times); NaN with the pump at rest.

    Parameters
    ----------
    speeds : ndarray, shape (links, times)
        [rad/s]
    """
    pumps = speeds[[one.pump - 1 for one in converters]]
    turbines = speeds[[one.turbine - 1 for one in converters]]
    return turbines / turning(pumps, speeds)


def turning(some: Floats, speeds: Floats) -> Floats:
    """Speeds by which something is divided: NaN at rest, but for rounding, beside the fastest."""
    return np.where(np.abs(some) > STANDING * np.abs(speeds).max(axis=0), some, np.nan)


def efficiencies(converters: Sequence[Converter], ratios: Floats, given: Floats) -> Floats:
    """Power that leaves each by that which enters, shape (converters, times).

    ``K i`` (Tarasik, figure 7), where the turbine drives its inverse, and 0 where power enters
    at both ends.

    Parameters
    ----------
    ratios : ndarray, shape (converters, times)
        As `speed_ratios` gives them.
    given : ndarray, shape (converters, times)
        Power by the pump. [W]

    Examples
    --------
    >>> one = Converter("TC", 1, 2, ((0.0, 2.0, 2e-3), (1.0, 1.0, 0.0), (1.5, 1.0, -1e-3)))
    >>> efficiencies([one], np.array([[0.5, 1.0, 1.25, -0.1]]), np.array([[9.0, 0.0, -9.0, 9.0]]))
    array([[0.75, 1.  , 0.8 , 0.  ]])
    """
    made = np.array(
        [
            ratio * np.interp(ratio, *np.array(one.points).T[:2])
            for one, ratio in zip(converters, ratios, strict=True)
        ]
    )
    back = (given < 0) & (made > 0)
    of_either: Floats = np.divide(1.0, made, out=made.copy(), where=back)
    return np.maximum(of_either, 0.0)
