"""Force of a hydropneumatic strut, with gas above the piston and in a counter chamber below.

Source: Tsitovich, Algin, Vehicle dynamics, Minsk, 1981, (4.12) to (4.18).
"""

from __future__ import annotations

import math
from typing import Any

from vstatics.core.named_tuple import NamedTuple


class Strut(NamedTuple):
    """State of the gas in a strut at rest; in each chamber ``p V^exponent`` is constant.

    Parameters
    ----------
    pressure, counter_pressure : float
        Pressure in the main chamber and in the counter chamber at rest. [Pa]
    area, counter_area : float
        Area of the piston towards each chamber. [m^2]
    length, counter_length : float
        Volume of each chamber at rest divided by its area. [m]
    exponent : float
        Polytropic exponent. [-]
    at : float
        Extension from rest at which the stiffness for linear calculations is taken. [m]

    Examples
    --------
    >>> strut = Strut(3e6, 0.02, 0.1, 1.0)
    >>> strut.slope(0.0), strut.slope(0.1)
    (600000.0, 150000.0)
    """

    pressure: float
    area: float
    length: float
    exponent: float
    counter_pressure: float = 0.0
    counter_area: float = 0.0
    counter_length: float | None = None
    at: float = 0.0

    @property
    def chambers(self) -> list[tuple[float, float]]:
        """Force [N] and length [m] of chambers at rest; negative for the counter chamber."""
        counter = self.counter_pressure * self.counter_area
        below = [(-counter, -(self.counter_length or 0.0))] if counter else []
        return [(self.pressure * self.area, self.length), *below]

    @property
    def reach(self) -> tuple[float, float]:
        """Smallest and largest possible extension from rest [m]."""
        return -self.length, -self.chambers[1][1] if len(self.chambers) > 1 else math.inf

    def slope(self, longer: float) -> float:
        """Return the stiffness [N/m] at an extension from rest [m]; NaN outside `reach`.

        The stiffness overflows to infinity for extreme dimensions.
        """
        import numpy as np  # costs start-up time

        power = -self.exponent - 1
        with np.errstate(all="ignore"):
            slopes = (
                self.exponent * force / length * np.exp(power * np.log1p(longer / length))
                for force, length in self.chambers
            )
            return float(sum(slopes))


class StrutCurve(NamedTuple):
    """Restoring force of a strut over the extension z from rest: ``P(0) - P(z)``, (4.16).

    Examples
    --------
    >>> curve = StrutCurve(Strut(3e6, 0.02, 0.1, 1.0))
    >>> [round(float(curve.at(z)), 6) for z in (-0.05, 0.0, 0.1)]
    [-60000.0, 0.0, 30000.0]
    >>> round(curve.energy(0.1), 6), round(curve.twist_at(30000.0), 9), curve.twist_at(60000.0)
    (1841.116917, 0.1, None)
    """

    strut: Strut
    corners: tuple[float, ...] = ()
    """Extensions at which the slope jumps, as in `TwistCurve`: empty for a strut."""
    bends: bool = True

    @property
    def steepest(self) -> float:
        """Slope at rest [N/m]. In a `TwistCurve` the same property is the largest slope."""
        return self.strut.slope(0.0)

    def piece(self, number: int) -> tuple[float, float]:  # noqa: ARG002 - interface of TwistCurve
        """Return zeros, because no piece of the curve is straight."""
        return 0.0, 0.0

    def at(self, twist: Any) -> Any:
        """Return the restoring force [N] at one or more extensions [m]; NaN out of reach."""
        import numpy as np  # costs start-up time

        n = self.strut.exponent
        with np.errstate(all="ignore"):
            return sum(
                -force * np.expm1(-n * np.log1p(twist / length))
                for force, length in self.strut.chambers
            )

    def energy(self, twist: float) -> float:
        """Return the integral of the restoring force from 0 to the extension `twist` [J]."""
        import numpy as np  # costs start-up time

        stored, n = 0.0, self.strut.exponent
        with np.errstate(all="ignore"):
            for force, length in self.strut.chambers:
                grown = np.log1p(twist / length)
                pushed = grown if n == 1 else np.expm1((1 - n) * grown) / (1 - n)
                stored += force * float(twist - length * pushed)
        return stored

    def twist_at(self, force: float) -> float | None:
        """Find the extension [m] at a restoring force [N] by bisection; None if never reached."""
        low, high = self.strut.reach
        if math.isinf(high):
            if force >= self.strut.chambers[0][0]:
                return None
            high = self.strut.length
            while self.at(high) < force:
                high *= 2
        while low < (middle := (low + high) / 2) < high:
            low, high = (middle, high) if self.at(middle) < force else (low, middle)
        return middle

    def slope_at(self, force: float) -> float:
        """Return the slope at a force [N/m]; 0 if the force is never reached."""
        twist = self.twist_at(force)
        return 0.0 if twist is None else self.strut.slope(twist)
