"""Where in a step a margin ends."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.events.margins import LargeSizes, Margins, Watch
from vstatics.simulation.events.pieces import TimeStep
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.system.curves import programme_at
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import Contact

_NO_MARGIN = 1e-10
"""A margin is below 0 by more than this part of what is large."""

_NODES = 0.5 - 0.5 * np.cos(np.pi * np.arange(9) / 8)
_TO_POWERS = np.asarray(np.linalg.inv(np.vander(_NODES)), float)
"""Values at nine parts of an interval -> powers of the part, the highest first."""
_NEAR: Floats = np.append(2.0 ** np.arange(-32, 0), 1.0)
"""Parts of an interval at whose beginning a margin may be 0."""

Sample = Callable[[TimeStep, Floats, Floats, Equations, Margins], None]
"""Takes instants of a step and their states."""


class MarginEnd(NamedTuple):
    """Where margins end."""

    time: float
    state: Floats
    watches: tuple[Watch, ...]


class NoCapacity(Exception):  # noqa: N818 - it never leaves the room
    """A control that gives no capacity at an instant."""

    def __init__(self, message: str, contact: Contact) -> None:
        super().__init__(message)
        self.contact = contact


class Finder:
    """Finds the events of a piece.

    Parameters
    ----------
    equations, margins
        Of the piece.
    scales : LargeSizes
    sample : callable
        Is told of all instants that are looked at before an event.
    """

    def __init__(
        self,
        equations: Equations,
        margins: Margins,
        scales: LargeSizes,
        sample: Sample,
    ) -> None:
        self.equations, self.margins = equations, margins
        self.sample = sample
        self.noise = _NO_MARGIN * margins.units(scales)
        self.by_formula = [
            contact
            for contact in equations.system.contacts
            if isinstance(contact.programme.curve, Formula)
        ]

    def event_in(self, step: TimeStep) -> MarginEnd | None:
        """The first event in a step."""
        self._check_capacities(step)
        times, states = step.times, step.states
        if not self.margins.watches:
            self._tell(step, times, states)
            return None
        margins = self.margins.along(times, states)
        ends = np.flatnonzero((margins < -self.noise[:, None]).any(axis=0))
        if not len(ends):
            self._tell(step, times, states)
            return None
        first = int(ends[0])
        self._tell(step, times[:first], states[:, :first])
        under = float(times[first]), margins[:, first]
        if first:
            return self._located(step, (float(times[first - 1]), margins[:, first - 1]), under)
        return self._located(step, (step.start, self.margins.at(step.start, step.first)), under)

    def _check_capacities(self, step: TimeStep) -> None:
        """Refuse a capacity by a formula that is no capacity."""
        for contact in self.by_formula:
            pack = contact.friction
            capacity = programme_at(contact.programme, step.end)
            capacity /= pack.per_pressure if pack else 1.0
            most = contact.programme.largest
            if not capacity >= 0 or (most is not None and capacity > most * (1 + 1e-9)):
                expected = "0 or more" if most is None else f"0 to {most:g}"
                unit = "Pa" if pack else "N*m"
                raise NoCapacity(
                    f"at {step.end:.6g} s the control of {contact.name} gives {capacity:g} {unit}, "
                    f"expected {expected}",
                    contact,
                )

    def _tell(self, step: TimeStep, times: Floats, states: Floats) -> None:
        self.sample(step, times, states, self.equations, self.margins)

    def _located(
        self, step: TimeStep, above: tuple[float, Floats], under: tuple[float, Floats]
    ) -> MarginEnd:
        """The first place in an interval at which a margin is 0."""
        places = []
        for index in map(int, np.flatnonzero(under[1] < -self.noise)):
            if above[1][index] > 0:
                place = self._root(step, index, above[0], under[0])
            else:
                place = self._after_rise(step, index, above[0], under[0])
            places.append((place, index))
        time, index = min(places)
        state = step.exact(time)
        if time > step.start:
            time, state = self._refined(step, time, state, index)
        close = 1e-11 * self.equations.system.scenario.duration
        watches = [self.margins.watches[other] for at, other in places if at <= time + close]
        return MarginEnd(float(time), state, tuple(watches) or (self.margins.watches[index],))

    def _after_rise(self, step: TimeStep, index: int, first: float, last: float) -> float:
        """Where a margin is 0 again that is 0 at first; the first time if it does not rise."""
        times = first + (last - first) * _NEAR
        margins = self.margins.along(times, step.between(times))[index]
        above = np.flatnonzero(margins > 0)
        if not len(above):
            return first
        rises = int(above[0])
        falls = next(number for number in range(rises + 1, len(times)) if margins[number] <= 0)
        return self._root(step, index, float(times[falls - 1]), float(times[falls]))

    def _root(self, step: TimeStep, index: int, first: float, last: float) -> float:
        """Where a margin is 0 between two times."""
        from scipy.optimize import brentq

        def margin(time: float) -> float:
            return float(self.margins.at(time, step.between(np.array([time]))[:, 0])[index])

        times = first + (last - first) * _NODES
        values = self.margins.along(times, step.between(times))[index]
        if values[0] <= 0:
            return first
        if values[-1] >= 0:
            return last
        if self.margins.watches[index].kind != "split":  # smooth: by a polynomial
            powers: list[float] = (_TO_POWERS @ values).tolist()

            def near(part: float) -> float:
                return reduce(lambda total, power: total * part + power, powers)

            if near(0.0) > 0 > near(1.0):
                return first + (last - first) * float(brentq(near, 0.0, 1.0, xtol=1e-14))
        return float(brentq(margin, first, last, xtol=1e-15 * max(1.0, last), rtol=1e-15))

    def _refined(
        self, step: TimeStep, time: float, state: Floats, index: int
    ) -> tuple[float, Floats]:
        """The place by the state as it is at the end of a step, not between."""
        length = step.end - step.start
        near = 1e-7 * length
        for _ in range(2):
            now = float(self.margins.at(time, state)[index])
            ahead = state + near * self.equations.derivative(time, state)
            slope = (float(self.margins.at(time + near, ahead)[index]) - now) / near
            better = time - now / slope if slope < 0 else time
            if abs(better - time) < 1e-15 * max(1.0, time):
                break
            if not step.start < better <= step.end or abs(better - time) > 0.1 * length:
                break
            time, state = better, step.exact(better)
        return time, state
