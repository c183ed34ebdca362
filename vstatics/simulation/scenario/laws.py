"""Quantities over time, speed or angle: points, formulas, and laws of a load."""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.rolling_radius import LoadedWheel

Over = Literal["time", "speed", "angle"]
"""Abscissa of points: time [s], speed [rad/s] or angle [rad]."""


class Points(NamedTuple):
    """Linear interpolation between points, constant before the first and after the last point.

    Where an abscissa repeats, the value jumps to the later value.

    Parameters
    ----------
    x, y : sequence of float
        Abscissas [s, rad/s or rad], which do not decrease, and values [N*m or Pa] of the same
        number, at least one.
    over : {"time", "speed", "angle"}

    Examples
    --------
    >>> ramp = Points((0.0, 2.0, 2.0), (10.0, 30.0, 0.0))
    >>> ramp.at(1.0), ramp.at(2.0), ramp.at(-1.0)
    (20.0, 0.0, 10.0)
    """

    x: tuple[float, ...]
    y: tuple[float, ...]
    over: Over = "time"

    def at(self, x: float) -> float:
        """Return the value at an abscissa."""
        value, slope = self.piece(self.piece_at(x))
        return value + slope * x

    def along(self, x: Floats) -> Floats:
        """Return the values at an array of abscissas.

        >>> Points((0.0, 2.0, 2.0), (10.0, 30.0, 0.0)).along(np.array([1.0, 2.0, -1.0])).tolist()
        [20.0, 0.0, 10.0]
        """
        pieces, values = np.searchsorted(self.x, x, "right"), np.empty(len(x))
        for number in set(pieces.tolist()):  # few pieces, because the steps of a run end at corners
            value, slope = self.piece(number)
            inside = pieces == number
            values[inside] = value + slope * x[inside]
        return values

    def piece_at(self, x: float) -> int:
        """Return the number of the piece at an abscissa; piece 0 ends at `x[0]`."""
        return bisect_right(self.x, x)

    def piece(self, number: int) -> tuple[float, float]:
        """Return the straight line of a piece: value at abscissa 0 and slope."""
        if number == 0:
            return self.y[0], 0.0
        if number == len(self.x):
            return self.y[number - 1], 0.0
        left, right = self.x[number - 1 : number + 1]
        below, above = self.y[number - 1 : number + 1]
        if below == above:
            return below, 0.0
        slope = (above - below) / (right - left)
        return below - slope * left, slope


@refusing()
def constant(value: float) -> Points:
    """Return a law with a constant value.

    Parameters
    ----------
    value : float

    Returns
    -------
    Points
        Law with this value at every time.

    Raises
    ------
    CaseError
        If a scenario with the law is simulated, and the value is not a finite number.

    Examples
    --------
    >>> constant(40.0).y
    (40.0,)
    """
    return Points((0.0,), (float(value),))


def bends(curve: Curve, until: float) -> tuple[float, ...]:
    """Return the times up to `until` at which a curve bends or jumps [s].

    >>> bends(Points((0.0, 2.0), (10.0, 30.0)), 3.0), bends(Formula("min(t, 1)"), 3.0)
    ((0.0, 2.0), (1.0,))
    """
    if isinstance(curve, Formula):
        return *curve.breaks, *curve.crossings(until)
    return curve.x if curve.over == "time" else ()


class Resistance(NamedTuple):
    """Dry friction of a load, which opposes the speed and can hold the link at rest.

    Examples
    --------
    A wheel of 2 kg*m^2 comes to rest after 5 s and stays at rest:

    >>> from vstatics import Transmission
    >>> from vstatics.simulation import Scenario, Start, simulate
    >>> case = Transmission(1, [], [], [], inertias={1: 2.0})
    >>> scenario = Scenario(case, 9.0, Start(speeds={1: 10.0}), torques=[(1, Resistance(4.0))])
    >>> round(float(simulate(scenario).speeds[-1, 0]), 9)
    0.0
    """

    torque: float
    """Friction torque. [N*m]"""


SpeedPoints: TypeAlias = tuple[tuple[float, float], ...]
"""Points (vehicle speed [m/s], value), with ascending speeds from 0; constant outside."""


class WheelRadius(NamedTuple):
    """Rolling radius of a wheel, which decreases with the torque of the road."""

    free: float
    """Radius without torque. [m]"""
    by_torque: float = 0.0
    """Decrease of the radius per unit of torque. [m/(N*m)]"""


class Road(NamedTuple):
    """Driving resistances of a vehicle, acting on a link that rotates with the wheels.

    Examples
    --------
    >>> Road(mass=1200, radius=0.3, rolling=0.012, slope=0.05).wheel is None
    True
    """

    mass: float
    """Mass of the vehicle. [kg]"""
    radius: float
    """Radius of the wheels without torque. [m]"""
    rolling: float | SpeedPoints = 0.0
    """Coefficient of rolling resistance [-], or points (vehicle speed [m/s], coefficient)."""
    drag_area: float = 0.0
    """Product of frontal area and drag coefficient. [m^2]"""
    slope: float = 0.0
    """Sine of the angle of ascent. [-]"""
    by_torque: float = 0.0
    """Decrease of the radius per unit of torque. [m/(N*m)]"""

    @property
    def wheel(self) -> LoadedWheel | None:
        """Wheel with a variable radius, None if the radius is constant."""
        if not self.by_torque or not self.radius:
            return None
        weight = self.mass * GRAVITY
        points = self.rolling if isinstance(self.rolling, tuple) else ((0.0, self.rolling),)
        forces = tuple((speed, weight * coefficient) for speed, coefficient in points)
        air = AIR * self.drag_area / 2
        return LoadedWheel(self.radius, self.by_torque, weight * self.slope, forces, air)

    def turning(self, velocity: float) -> float:
        """Convert a vehicle speed [m/s] to the speed of the wheels [rad/s].

        >>> Road(1000.0, 0.5).turning(10.0)
        20.0
        """
        return (
            float(self.wheel.turning(velocity)) if self.wheel else velocity / (self.radius or 1.0)
        )

    @property
    def weight_torque(self) -> float:
        """Weight of the vehicle times radius of the wheels [N*m]."""
        return self.radius * self.mass * GRAVITY

    @property
    def rolling_torque(self) -> float:
        """Torque of rolling resistance at speed 0, which holds the vehicle at rest [N*m]."""
        at_rest = self.rolling[0][1] if isinstance(self.rolling, tuple) else self.rolling
        return self.weight_torque * at_rest / (float(self.wheel.load(0.0)) if self.wheel else 1.0)

    @property
    def rolling_growth(self) -> Points | None:
        """External torque of rolling resistance beyond its value at rest, over the wheel speed.

        None if the rolling resistance is constant, or if the radius is variable.

        Examples
        --------
        >>> Road(1000 / GRAVITY, 0.5, rolling=((0.0, 0.01), (20.0, 0.03))).rolling_growth
        Points(x=(-40.0, 0.0, 40.0), y=(10.0, 0.0, -10.0), over='speed')
        """
        if self.by_torque or not isinstance(self.rolling, tuple):
            return None
        speeds = [speed / self.radius for speed, _ in self.rolling]
        torques = [self.weight_torque * part - self.rolling_torque for _, part in self.rolling]
        back = slice(None, 0 if speeds[0] == 0 else None, -1)
        x = (*(-speed for speed in speeds[back]), *speeds)
        return Points(x, (*torques[back], *(0.0 - torque for torque in torques)), "speed")

    @property
    def climbing_torque(self) -> float:
        """Torque that the ascent needs [N*m]."""
        return self.weight_torque * self.slope

    def torque(self, speed: Any) -> Any:
        """Return the external torque at wheel speeds [rad/s], without dry friction [N*m].

        This is the torque of ascent and air drag. With a variable radius it includes the rolling
        resistance beyond its value at rest.

        Examples
        --------
        >>> Road(1000.0, 0.5, drag_area=0.8, slope=0.1).torque(10.0)
        -496.5
        """
        if self.wheel:
            return self.wheel.torque(speed) + np.sign(speed) * self.rolling_torque
        air = self.radius**3 * AIR * self.drag_area / 2
        return -self.climbing_torque - air * speed * abs(speed)


Curve: TypeAlias = Points | Formula
"""Number over time, or over the speed or angle of a link."""
TorqueLaw: TypeAlias = Points | Formula | Resistance | Road
