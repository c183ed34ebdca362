"""Sign of the difference of two numbers immediately after an instant.

Two numbers that are equal at the instant are compared at up to three later times. The interval to
the first is short, because the motion is extrapolated with an error of fifth order. The first
difference above rounding decides, so the result is the sign of the first derivative that is not
zero. If no difference decides, both numbers count as equal: a formula is continuous there, so the
run goes on until the difference exceeds rounding.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.margins import Awaited, LargeSizes
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.programme import Look
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.known import DISTANCES
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.sight import Compared, compared, fixed, place_seen
from vstatics.simulation.tolerances import EQUAL_SIDES, EXACT_SIDES, MET, ROUNDED_INPUT, SOON


class SeenInstant(NamedTuple):
    """Values of all quantities that formulas can read at an instant."""

    time: float
    """The instant. [s]"""
    values: Sequence[float]


class Judge:
    """Judge of comparisons: decides which of two numbers is larger immediately after an instant.

    Parameters
    ----------
    equations : Equations
    time : float
        The instant. [s]
    state : ndarray
        State of the equations at the instant.
    scales : LargeSizes
        Speed and torque that count as large, as scales of rounding errors.
    values : ndarray
        Scale of the rounding errors of each control state and temperature.
    """

    def __init__(
        self, equations: Equations, time: float, state: Floats, scales: LargeSizes, values: Floats
    ) -> None:
        self.equations = equations
        self.now = SeenInstant(time, equations.changes.seen_at(time, state))
        self._scales, self._values = scales, values
        self._reached = time, state
        self._later: list[SeenInstant] = []
        self._sizes: dict[Look, float] = {}
        self._known: dict[Formula, Awaited] = {}

    @property
    def ahead(self) -> SeenInstant:
        """Values of all quantities that formulas can read, at the first later time."""
        return self._after(0)

    def _after(self, number: int) -> SeenInstant:
        while len(self._later) <= number:
            equations = self.equations
            end = self.now.time + equations.within * DISTANCES[len(self._later)]
            time, state = self._reached
            self._reached = end, equations.moved(time, state, end - time)
            self._later.append(SeenInstant(end, equations.changes.seen_at(*self._reached)))
        return self._later[number]

    def awaited(self, comparison: Formula) -> Awaited:
        """Return the sign of the difference in a comparison of a step condition."""
        if comparison not in self._known:
            self._known[comparison] = self.judged(compared(self.equations.system, comparison))
        return self._known[comparison]

    def judged(self, pair: Compared) -> Awaited:
        """Decide which of two numbers is larger immediately after the instant."""
        now = math.nextafter(self.now.time, math.inf), self.now.values  # after a jump at now
        (first, second), (later, other) = pair.at(*now), pair.at(*self.ahead)
        apart, then = first - second, later - other
        if math.isinf(apart):  # at a pole, the values a little later decide
            first, second, apart = later, other, then
        change = abs(then - apart)
        size = max(abs(first), abs(second), SOON * change, self._size(pair))
        is_equal = abs(apart) <= max(EQUAL_SIDES * size, MET * change)
        moves = abs(apart) <= EQUAL_SIDES * size
        side = self._next_side(pair, then, size) if moves else _side(apart)
        return Awaited(pair, side, size, is_equal, change)

    def _next_side(self, pair: Compared, then: float, size: float) -> str:
        for number in range(len(DISTANCES)):
            if number:
                first, second = pair.at(*self._after(number))
                then, size = first - second, max(abs(first), abs(second), self._size(pair))
            if not abs(then) <= EXACT_SIDES * size:
                return _side(then)
        return "0"

    def nearest(self, group: Sequence[Compared]) -> list[tuple[int, Awaited]]:
        """Return comparisons of a number with its nearest neighbours in an ascending group.

        Returns
        -------
        list of (int, Awaited)
            Index in the group and comparison, for the last number below and the next two numbers,
            if they exist.
        """
        judged = [*enumerate(map(self.judged, group))]
        above = next((n for n, awaited in judged if awaited.side != "+"), len(judged))
        return judged[max(0, above - 1) : above + 2 if above < len(judged) else None]

    def _size(self, pair: Compared) -> float:
        """Return the scale of the inputs of two numbers, in the unit of their difference.

        The rounding error of the difference is proportional to this scale.
        """
        return self._sensed(pair.first) + self._sensed(pair.second)

    def _sensed(self, look: Look) -> float:
        """Return the change of a formula by rounding of its inputs, divided by `EXACT_SIDES`."""
        if look not in self._sizes:
            time, values = self.ahead
            seen, base, sum_of_changes = [*values], look.at(time, values), 0.0
            for place in {*look.places}:
                step = ROUNDED_INPUT * self._large(place, values[place])
                changes = []
                for moved in (values[place] - step, values[place] + step):
                    seen[place] = moved
                    changes.append(abs(look.at(time, seen) - base))
                seen[place] = values[place]
                sum_of_changes += max(
                    (change for change in changes if change < math.inf), default=0.0
                )
            self._sizes[look] = sum_of_changes / EXACT_SIDES
        return self._sizes[look]

    def _large(self, place: int, value: float) -> float:
        layout = self.equations.layout
        if place < layout.ports:
            large = self._scales.speed
        elif place < layout.seen_angles:
            stiffness = self.equations.system.springs[place - layout.ports].stiffness
            large = self._scales.torque / stiffness if stiffness else 0.0
        elif place < layout.seen_values:
            large = 0.0
        elif place < layout.seen_shares:
            large = float(self._values[place - layout.seen_values])
        elif place < layout.seen_derived:
            large = 1.0
        else:
            large = self._scales.torque
        return max(large, abs(value))


def _side(apart: float) -> str:
    if math.isnan(apart):
        return "?"
    return "-+"[bool(apart > 0)] if apart else "0"


def end_of_slide(system: MotionSystem, share: int) -> Awaited:
    """Return a comparison whose margin ends where the share of a jump is 1 or -1."""
    pair = Compared(place_seen(system.layout.seen_shares + share), fixed(0.0))
    return Awaited(pair, "0", 1 / EQUAL_SIDES, is_equal=True, change=0.0)
