"""Values and slopes, over time, of capacities and other curves."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.laws import Curve, Points
from vstatics.simulation.scenario.programme import Programme, friction_at
from vstatics.simulation.system.matrices import Contact, Elastic

Slopes = TypeVar("Slopes", float, Floats)
Torque = Callable[[float, float, float], float]
"""Torque as a function of time [s], speed [rad/s] and angle [rad]."""
TorqueAlong = Callable[[Floats, Floats, Floats], Floats]
"""Torques as a function of arrays of times, speeds and angles."""


def one_by_one(torque: Torque) -> TorqueAlong:
    """Return a torque as a function of arrays, evaluated instant by instant."""

    def along(times: Floats, rates: Floats, angles: Floats) -> Floats:
        known = (values.tolist() for values in (times, rates, angles))
        return np.array([torque(*at) for at in zip(*known, strict=True)])

    return along


def capacity_at(
    contact: Contact, time: float, slip: float = 0.0, seen: Sequence[float] = ()
) -> float:
    """Return the kinetic capacity of a contact at a time and slip [N*m]."""
    value = programme_at(contact.programme, time, seen)
    return value if contact.friction is None else value * friction_at(contact.friction, slip)


def programme_at(programme: Programme, time: float, seen: Sequence[float] = ()) -> float:
    """Return the capacity at a time [N*m]; `seen` are the quantities that formulas read."""
    if programme.look is not None:
        return programme.seen_at(time, seen)
    at = programme.curve.at(time)
    if at == 0 or programme.factor == 0:
        return 0.0
    return at * programme.factor


def is_limited(device: Contact | Elastic, time: float) -> bool:
    """Return whether the torque of a contact or spring has a limit at a time [s]."""
    programme = device.programme
    return programme.look is not None or math.isfinite(programme_at(programme, time))


def programme_along(programme: Programme, times: Floats, seen: Floats | None = None) -> Floats:
    """Return the capacities at several times [N*m]; `seen` has a row for each quantity."""
    if programme.look is not None and seen is not None:
        return programme.seen_along(times, seen)
    return programme.factor * curve_along(programme.curve, times)


def curve_along(curve: Curve, times: Floats) -> Floats:
    """Return the values of a curve at several times."""
    if isinstance(curve, Points):
        return np.full(len(times), curve.y[0]) if len(set(curve.y)) == 1 else curve.along(times)
    return curve.along(times, 0.0, 0.0)


def slope_of(
    function: Torque, time: float, step: float, rate: float = 0.0, angle: float = 0.0
) -> float:
    """Return the derivative of a torque with respect to time, at a constant rate."""
    return slope_ahead(lambda after: function(time + after, rate, angle + after * rate), step)


def slope_ahead(function: Callable[[float], Slopes], step: float) -> Slopes:
    """Return the derivative of a function at 0, from its values within a step.

    >>> slope_ahead(lambda x: x**2, 1.0), slope_ahead(lambda x: 1 + x, 2.0)
    (0.0, 1.0)
    """
    now, middle, later = map(function, (0.0, step / 2, step))
    return (4 * middle - 3 * now - later) / step
