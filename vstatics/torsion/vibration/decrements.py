"""Dampings from logarithmic decrements, and compliances from a measured frequency.

The decrement of a mode is the sum of the decrements of components, each weighted by the share of
the component in the elastic energy of the mode. In a chain of springs of compliance E_i, without
inertia between them, the share is ``E_i/sum E``.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendices 1.3 and 2; equation
numbers are from the book.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

ByDevice = Mapping[str, float]
"""Values by name of the elastic component."""


def corrected(compliances: ByDevice, calculated: float, measured: float) -> dict[str, float]:
    """Scale all compliances so that a calculated frequency becomes the measured frequency, (П2.2).

    Parameters
    ----------
    compliances : mapping
        Compliances with which the frequency was calculated. [rad/(N*m)]
    calculated, measured : float
        Angular frequency of a mode. [rad/s]

    Examples
    --------
    >>> corrected({"shaft": 0.01}, 22.0, 20.0)
    {'shaft': 0.0121...}
    """
    ratio = calculated / measured
    factor = ratio * ratio
    return {name: compliance * factor for name, compliance in compliances.items()}


def dampings(decrements: ByDevice, compliances: ByDevice, omega: float) -> dict[str, float]:
    """Return the dampings of components from their decrements at a frequency, (П1.19).

    Measured decrements change little with frequency, so ``damping * omega`` is a property of a
    component, and a damping is valid only near this frequency.

    Parameters
    ----------
    decrements : mapping
        Decrements of components. [-]
    compliances : mapping
        Compliances of these components, or more. [rad/(N*m)]
    omega : float
        Angular frequency. [rad/s]

    Returns
    -------
    dict
        Dampings of the components. [N*m*s/rad]

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
    """Return the decrements of components from their dampings: the inverse of `dampings`.

    >>> decrements(dampings({"shaft": 0.03}, {"shaft": 1e-3}, 80.0), {"shaft": 1e-3}, 80.0)
    {'shaft': 0.03}
    """
    return {
        name: math.pi * compliances[name] * omega * damping for name, damping in dampings.items()
    }


def decrement(decrements: ByDevice, shares: ByDevice) -> float:
    """Return the decrement of a mode from the decrements of components, (П1.20), (П1.21).

    Parameters
    ----------
    decrements : mapping
        Decrements of components. [-]
    shares : mapping
        Shares of these components, or more, in the elastic energy of the mode. [-]

    Examples
    --------
    >>> decrement({"shaft": 0.5, "damper": 0.25}, {"shaft": 0.25, "damper": 0.5, "tyre": 0.25})
    0.25
    """
    return math.fsum(value * shares[name] for name, value in decrements.items())
