"""What depends on time, on a speed or on an angle: points, formulas, and laws of a load."""

from __future__ import annotations

from bisect import bisect_right
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.rolling_radius import LoadedWheel

Over = Literal["time", "speed", "angle"]
"""What stands along the abscissa: s, rad/s, rad."""


class Points(NamedTuple):
    """Straight between points, constant before the first and after the last.

    Where an abscissa repeats, the later value holds from there.

    Parameters
    ----------
    x, y : sequence of float
        As many of each, one at least; `x` does not decrease. [s, rad/s or rad; N*m or Pa]
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
        """The value at an abscissa."""
        value, slope = self.piece(self.piece_at(x))
        return value + slope * x

    def piece_at(self, x: float) -> int:
        """The number of the piece that holds from an abscissa on; piece 0 ends at `x[0]`."""
        return bisect_right(self.x, x)

    def piece(self, number: int) -> tuple[float, float]:
        """Value at 0 and slope of the straight line of a piece."""
        if number in (0, len(self.x)):
            return self.y[min(number, len(self.x) - 1)], 0.0
        left, right = self.x[number - 1 : number + 1]
        below, above = self.y[number - 1 : number + 1]
        if below == above:
            return below, 0.0
        slope = (above - below) / (right - left)
        return below - slope * left, slope


@refusing()
def constant(value: float) -> Points:
    """A value that never changes.

    Parameters
    ----------
    value : float

    Returns
    -------
    Points
        A law with this value at any time.

    Raises
    ------
    CaseError
        When a scenario with it is simulated, of a value that is no number.

    Examples
    --------
    >>> constant(40.0).y
    (40.0,)
    """
    return Points((0.0,), (float(value),))


def bends(curve: Curve, until: float) -> tuple[float, ...]:
    """Times up to one at which a curve may bend or jump [s].

    >>> bends(Points((0.0, 2.0), (10.0, 30.0)), 3.0), bends(Formula("min(t, 1)"), 3.0)
    ((0.0, 2.0), (1.0,))
    """
    if isinstance(curve, Formula):
        return *curve.breaks, *curve.crossings(until)
    return curve.x if curve.over == "time" else ()


class Resistance(NamedTuple):
    """Dry friction of a load: it acts against the speed, and holds at rest up to its torque.

    Examples
    --------
    A wheel of 2 kg*m^2 comes to rest after 5 s, and stays there:

    >>> from vstatics import Transmission
    >>> from vstatics.simulation import Scenario, Start, simulate
    >>> case = Transmission(1, [], [], [], inertias={1: 2.0})
    >>> scenario = Scenario(case, 9.0, Start(speeds={1: 10.0}), torques=[(1, Resistance(4.0))])
    >>> round(float(simulate(scenario).speeds[-1, 0]), 9)
    0.0
    """

    torque: float
    """[N*m]"""


SpeedPoints: TypeAlias = tuple[tuple[float, float], ...]
"""Speeds of 0 or more that rise, each with a number; constant outside."""


class WheelRadius(NamedTuple):
    """The radius on which a wheel rolls, which falls with the torque that the road takes."""

    free: float
    """Without torque. [m]"""
    by_torque: float = 0.0
    """What it loses by a torque. [m/(N*m)]"""


class Road(NamedTuple):
    """What a road does to a vehicle, on a link that turns as its wheels.

    Examples
    --------
    >>> Road(mass=1200, radius=0.3, rolling=0.012, slope=0.05).wheel is None
    True
    """

    mass: float
    """[kg]"""
    radius: float
    """Of the wheels, without torque. [m]"""
    rolling: float | SpeedPoints = 0.0
    """Coefficient of the rolling resistance; or points, from the speed of the vehicle. [m/s, -]"""
    drag_area: float = 0.0
    """Coefficient of air drag by frontal area. [m^2]"""
    slope: float = 0.0
    """Sine of the angle of ascent. [-]"""
    by_torque: float = 0.0
    """What the radius loses by a torque, as of `LoadedWheel`. [m/(N*m)]"""

    @property
    def wheel(self) -> LoadedWheel | None:
        """The wheel, if its radius changes."""
        if not self.by_torque or not self.radius:
            return None
        weight = self.mass * GRAVITY
        points = self.rolling if isinstance(self.rolling, tuple) else ((0.0, self.rolling),)
        forces = tuple((speed, weight * part) for speed, part in points)
        air = AIR * self.drag_area / 2
        return LoadedWheel(self.radius, self.by_torque, weight * self.slope, forces, air)

    def turning(self, velocity: float) -> float:
        """The speed of the wheels at a velocity of the vehicle [rad/s].

        >>> Road(1000.0, 0.5).turning(10.0)
        20.0
        """
        return (
            float(self.wheel.turning(velocity)) if self.wheel else velocity / (self.radius or 1.0)
        )

    @property
    def weight_torque(self) -> float:
        """Of its weight at the rim of the wheels [N*m]."""
        return self.radius * self.mass * GRAVITY

    @property
    def rolling_torque(self) -> float:
        """Dry friction: it acts against the speed, and holds at rest up to this [N*m]."""
        at_rest = self.rolling[0][1] if isinstance(self.rolling, tuple) else self.rolling
        return self.weight_torque * at_rest / (float(self.wheel.load(0.0)) if self.wheel else 1.0)

    @property
    def rolling_growth(self) -> Points | None:
        """The torque by which rolling resistance is another one in motion than at rest.

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
        x = (*(-one for one in speeds[back]), *speeds)
        y = (*torques[back], *(0.0 - one for one in torques))
        return Points(x, y, "speed")

    @property
    def climbing_torque(self) -> float:
        """Of the ascent [N*m]."""
        return self.weight_torque * self.slope

    def torque(self, speed: Any) -> Any:
        """At a speed of the wheels or an array of them, without dry friction [N*m].

        By ascent and air; where the radius changes also by which rolling resistance is another one
        in motion than at rest.

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
"""A number over time, or over the speed or the angle of the link itself."""
TorqueLaw: TypeAlias = Points | Formula | Resistance | Road
