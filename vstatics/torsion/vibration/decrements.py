"""Dampings from logarithmic decrements, compliances from a measured frequency.

The decrement of a mode is that of its devices by their shares of the elastic energy, which are
those of `modes`; in a chain of springs with no inertia between them, ``E_i/E``.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendices 1.3 and 2; numbers of
equations are those of the book.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

ByDevice = Mapping[str, float]
"""A number of each elastic device, by its name."""


def corrected(compliances: ByDevice, calculated: float, measured: float) -> dict[str, float]:
    """Compliances with which a frequency is what was measured, (П2.2).

    Parameters
    ----------
    compliances : mapping
        [rad/(N*m)]
    calculated, measured : float
        Angular frequency of one mode. [rad/s]

    Examples
    --------
    >>> corrected({"shaft": 0.01}, 22.0, 20.0)
    {'shaft': 0.0121...}
    """
    ratio = calculated / measured
    factor = ratio * ratio
    return {name: compliance * factor for name, compliance in compliances.items()}


def dampings(decrements: ByDevice, compliances: ByDevice, omega: float) -> dict[str, float]:
    """Dampings that give devices their decrements at one angular frequency, (П1.19).

    Measured decrements change little with frequency; it is ``damping * omega`` that is the
    property of a device, so a damping holds near this frequency only.

    Parameters
    ----------
    decrements : mapping
        Of the devices that have one. [-]
    compliances : mapping
        Of all these devices. [rad/(N*m)]
    omega : float
        [rad/s]

    Returns
    -------
    dict
        [N*m*s/rad]

    Examples
    --------
    The transmission of a ВАЗ-2101 in gear III, table П2.1: 1.28 N*m*s.

    >>> round(dampings({"all": 1.06}, {"all": 0.0096}, 27.4)["all"], 2)
    1.28
    """
    return {
        name: decrement / (math.pi * compliances[name] * omega)
        for name, decrement in decrements.items()
    }


def decrements(dampings: ByDevice, compliances: ByDevice, omega: float) -> dict[str, float]:
    """The decrements of devices at an angular frequency: `dampings` the other way.

    >>> decrements(dampings({"shaft": 0.03}, {"shaft": 1e-3}, 80.0), {"shaft": 1e-3}, 80.0)
    {'shaft': 0.03}
    """
    return {name: math.pi * compliances[name] * omega * one for name, one in dampings.items()}


def decrement(decrements: ByDevice, shares: ByDevice) -> float:
    """The decrement of a mode, (П1.20), (П1.21).

    Parameters
    ----------
    decrements : mapping
        Of the devices that have one. [-]
    shares : mapping
        Of all these devices, in the elastic energy of the mode. [-]

    Examples
    --------
    >>> decrement({"shaft": 0.5, "damper": 0.25}, {"shaft": 0.25, "damper": 0.5, "tyre": 0.25})
    0.25
    """
    return math.fsum(one * shares[name] for name, one in decrements.items())


def divided(total: float, shares: ByDevice, ratios: ByDevice) -> dict[str, float]:
    """The decrements of devices that stand in given ratios and give a mode its own.

    Lines 2 to 4 of table П1.4, from (П1.20).

    Parameters
    ----------
    total : float
        Decrement of the mode. [-]
    shares : mapping
        Of the devices in its elastic energy. [-]
    ratios : mapping
        Decrements of the devices to one another. [-]

    Examples
    --------
    >>> divided(0.75, {"shafts": 0.5, "axle": 0.5}, {"shafts": 1, "axle": 5})
    {'shafts': 0.25, 'axle': 1.25}
    """
    first = total / decrement(ratios, shares)
    return {name: first * ratio for name, ratio in ratios.items()}


def moved(damping: float, compliance: float, to: float) -> float:
    """A damping beside one compliance as one beside another in series with it, (П1.27).

    What it takes from the same swing of the torque stays the same. So a part of a shaft gets
    the damping of the whole one, or a chain that of its parts, of which one takes the sum.

    Parameters
    ----------
    damping : float
        [N*m*s/rad]
    compliance, to : float
        What it stands beside, and is to stand beside. [rad/(N*m)]

    Examples
    --------
    >>> moved(2.0, 0.01, 0.02)
    0.5
    """
    return damping * (compliance / to) ** 2


def dry_friction(friction: float, stop: float, compliance: float) -> float:
    """Damping by angular frequency of a clutch damper with dry friction, (П1.26).

    It takes as much from a cycle as dry friction does, in one that just reaches the stop.

    Parameters
    ----------
    friction, stop : float
        Torques of the friction and of the stop. [N*m]
    compliance : float
        Of the damper. [rad/(N*m)]

    Returns
    -------
    float
        ``damping * omega``. [N*m/rad]

    Examples
    --------
    >>> round(dry_friction(14, 100, 758e-6), 1)
    235.2
    """
    return 4 * friction / (math.pi * stop * compliance)
