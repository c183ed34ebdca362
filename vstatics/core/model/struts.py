"""A hydropneumatic strut: gas above a piston, and below it where there is a counter chamber.

Source: Tsitovich, Algin, Vehicle dynamics, Minsk, 1981, (4.12) to (4.18).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple


class Strut(NamedTuple):
    """The gas of a strut at rest; that of a chamber keeps ``p V^exponent``.

    Parameters
    ----------
    pressure, counter_pressure : float
        [Pa]
    area, counter_area : float
        Of the piston towards each chamber. [m^2]
    length, counter_length : float
        Of each chamber, its volume by its area. [m]
    exponent : float
        Of the polytropic change. [-]
    at : float
        How much longer the strut is where its slope is its stiffness. [m]

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
        """Force of each chamber at rest, and its length; a counter chamber below 0 [N, m]."""
        counter = self.counter_pressure * self.counter_area
        below = [(-counter, -(self.counter_length or 0.0))] if counter else []
        return [(self.pressure * self.area, self.length), *below]

    @property
    def reach(self) -> tuple[float, float]:
        """Between which lengths beyond that at rest it is [m]."""
        return -self.length, -self.chambers[1][1] if len(self.chambers) > 1 else math.inf

    def slope(self, longer: float) -> float:
        """Its stiffness [N/m] where it is so much longer than at rest [m]; no number out of reach.

        Of numbers that no strut has it may be infinite.
        """
        import numpy as np  # costs start-up time

        power = -self.exponent - 1
        with np.errstate(all="ignore"):
            slopes = (
                self.exponent * force / length * np.exp(power * np.log1p(longer / length))
                for force, length in self.chambers
            )
            return float(sum(slopes))

    def completed(self) -> Strut:
        """The same with floats."""
        given = self._asdict().items()
        return self._replace(**{name: float(one) for name, one in given if one is not None})


class StrutCurve(NamedTuple):
    """What brings a strut back to rest, over how much longer it is: ``P(0) - P(z)``, (4.16).

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
    """It bends nowhere at once."""
    bends: bool = True

    @property
    def steepest(self) -> float:
        """What stands for its slope: that at rest [N/m]."""
        return self.strut.slope(0.0)

    def piece(self, number: int) -> tuple[float, float]:  # noqa: ARG002 - as of other springs
        """What of it is straight: nothing."""
        return 0.0, 0.0

    def at(self, twist: Any) -> Any:
        """The force [N] at one or at many twists [m]; no number out of reach."""
        import numpy as np  # costs start-up time

        n = self.strut.exponent
        with np.errstate(all="ignore"):
            return sum(
                -force * np.expm1(-n * np.log1p(twist / length))
                for force, length in self.strut.chambers
            )

    def energy(self, twist: float) -> float:
        """The integral of the force from a twist of 0 on [J]."""
        import numpy as np  # costs start-up time

        stored, n = 0.0, self.strut.exponent
        with np.errstate(all="ignore"):
            for force, length in self.strut.chambers:
                grown = np.log1p(twist / length)
                pushed = grown if n == 1 else np.expm1((1 - n) * grown) / (1 - n)
                stored += force * float(twist - length * pushed)
        return stored

    def twist_at(self, force: float) -> float | None:
        """The twist at which it has a force [m], by halving; None: it never has."""
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
        """The slope where it has a force [N/m]; 0 where it never has it."""
        twist = self.twist_at(force)
        return 0.0 if twist is None else self.strut.slope(twist)
