"""Search for the time at which a margin becomes negative within a time step."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache, reduce
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.parts import Law
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.margins import FOLLOWING, LargeSizes, Margins, Watch
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.system.matrices import SIGNS
from vstatics.simulation.tolerances import (
    AHEAD,
    ALONG_TANGENT,
    EQUAL_SIDES,
    EXACT_SIDES,
    LARGEST_NUMBER,
    NO_MARGIN,
    NOT_ZERO,
    ROOT_PART,
    ROOT_TIME,
    SAME_INSTANT,
)

_NODES = 0.5 - 0.5 * np.cos(np.pi * np.arange(9) / 8)
_TO_POWERS = np.asarray(np.linalg.inv(np.vander(_NODES)), float)
"""Matrix from values at nine Chebyshev nodes of an interval to coefficients, highest power first.
"""
_LOW = 0.1
"""Height below which a minimum is examined closely, since it could be negative.

The height is relative to the fall of the margin along its tangent in an interval of the search.
"""
_MOST_NARROWINGS = 100
"""Largest number of searches for earlier events in a step.

A margin of infinite slope can have an earlier event each time.
"""
_IN_GAP = 4
"""Number of intervals in a gap between two instants in the search for minima."""
_PLACES = 65
"""Number of points at which a polynomial is evaluated to find its minimum between two instants."""
_NEAR = np.append(2.0 ** np.arange(-32, 0), 1.0)
"""Fractions of an interval at which a margin that begins at 0 is evaluated."""

_CONSTANT = 1e-4
"""Largest change of a constant margin, relative to the violation that counts as rounding."""


@lru_cache(maxsize=8)
def _in_gaps(nodes: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Return a matrix from values at nodes to values and slopes at points, and their spacings.

    There are four equidistant points in each gap between nodes, the first at the lower node, and a
    point at the last node. Polynomials interpolate between the nodes.
    """
    at = np.array(nodes)
    inner = at[:-1, None] + np.diff(at)[:, None] * np.arange(_IN_GAP) / _IN_GAP
    places = np.append(inner, 1.0)
    powers = np.vander(places, len(at))
    slopes = np.pad(powers[:, 1:] * np.arange(len(at) - 1, 0, -1), ((0, 0), (0, 1)))
    matrix = np.linalg.solve(np.vander(at).T, np.vstack([powers, slopes]).T)
    return np.asarray(matrix, float), np.diff(places)


def _lowest(nodes: tuple[float, ...], values: Floats, gap: int) -> float:
    """Return the abscissa at which an interpolating polynomial is lowest between two nodes.

    >>> round(_lowest((0.0, 0.3, 0.6, 1.0), (np.array([0.0, 0.3, 0.6, 1.0]) - 0.41)**2, 1), 9)
    0.41
    """
    places = np.linspace(nodes[gap], nodes[gap + 1], _PLACES)
    near = np.polyval(np.linalg.solve(np.vander(nodes), values), places)
    lowest = min(max(int(near.argmin()), 1), _PLACES - 2)
    before, at, after = near[lowest - 1 : lowest + 2].tolist()
    bend = before - 2 * at + after
    moved = 0.5 * (before - after) / bend if bend > 0 else 0.0
    return float(places[lowest] + moved * (places[1] - places[0]))


def minima(step: TimeStep, values: Floats) -> Iterator[tuple[int, int, float]]:
    """Yield minima of functions of time between two instants that could be negative.

    The search uses polynomials that interpolate the values in each part of the step.

    Parameters
    ----------
    step : TimeStep
    values : ndarray, shape (functions, 1 + instants)
        Values at the start and at the instants of the step.

    Yields
    ------
    number : int
        Index of the next instant in `step.times`; in ascending order.
    row : int
        Row of `values`.
    time : float
        Time of the minimum. [s]
    """
    count = len(step.nodes)
    nodes = (0.0, *step.nodes.tolist())
    inner = values[:, 1:].reshape(len(values), -1, count)
    by_parts = np.concatenate([values[:, :-1:count, None], inner], axis=-1)
    for number, row in _low_gaps(by_parts, nodes):
        part, gap = divmod(number, count)
        place = _lowest(nodes, by_parts[row, part], gap)
        begin = step.times[part * count - 1] if part else step.start
        yield number, row, float(begin + (step.times[part * count + count - 1] - begin) * place)


def _low_gaps(by_parts: Floats, nodes: tuple[float, ...]) -> list[tuple[int, int]]:
    """Return gaps with low minima, sorted: number of the gap and row of `by_parts`."""
    matrix, widths = _in_gaps(nodes)
    both, count = by_parts @ matrix, matrix.shape[1] // 2
    values, slopes = both[..., :count], both[..., count:]
    turns = np.nonzero((slopes[..., :-1] <= 0) & (slopes[..., 1:] >= 0))
    rows, parts, places = turns
    if not len(rows):
        return []
    falls, rises = -slopes[turns] * widths[places], slopes[..., 1:][turns] * widths[places]
    halves = 2 * np.maximum(falls + rises, NOT_ZERO)
    # Minima of two parabolas with both slopes, through the first or the last value.
    lowest = np.minimum(
        values[turns] - falls**2 / halves, values[..., 1:][turns] - rises**2 / halves
    )
    low = lowest < _LOW * np.maximum(falls, rises)
    if not low.any():
        return []
    gaps = parts * (len(nodes) - 1) + places // _IN_GAP
    return sorted({*zip(gaps[low].tolist(), rows[low].tolist(), strict=True)})


class MarginEnd(NamedTuple):
    """Time at which the first margins become negative, with the state and their identities."""

    time: float
    state: Floats
    watches: tuple[Watch, ...]


class Finder:
    """Finder of the first negative margin; valid while the equations of motion remain unchanged.

    Parameters
    ----------
    margins : Margins
        Margins of the equations.
    scales : LargeSizes
    """

    def __init__(self, margins: Margins, scales: LargeSizes) -> None:
        self.equations, self.margins = margins.equations, margins
        self.least = self.noise = NO_MARGIN * margins.units(scales)
        self.enough = -NO_MARGIN * scales.torque
        """Margin `split` that is certainly an event; later margins do not matter. [N*m]"""
        self.following = np.array(
            [watch.kind in FOLLOWING for watch in margins.watches], dtype=bool
        )
        """Flags of margins that can become negative and rise again between two instants."""
        self.follows = bool(self.following.any())
        corners = any(watch.kind == "corner" for watch in margins.watches)
        self.jumps = corners or margins.sees
        """True if torques and their limits can jump, because formulas read the motion."""
        system = self.equations.system
        self.by_formula = [
            (contact.name, contact.programme.given)
            for contact in system.contacts
            if isinstance(contact.programme.given, Formula)
        ]
        self.torques = [
            (port, system.names[load.link])
            for port, load in enumerate(system.outside)
            if isinstance(load.law, Formula)
        ]
        self.drags = [
            (port, contact.name, contact.friction)
            for port, (contact, state) in enumerate(
                zip(system.contacts, self.equations.states.contacts, strict=True),
                self.equations.layout.contacts,
            )
            if state in SIGNS and isinstance(contact.friction, Law) and contact.friction.text
        ]

    def event_in(self, step: TimeStep) -> MarginEnd | None:
        """Return the first event in a step."""
        self._check_capacities(step)
        self._check_torques(step)
        if not self.margins.watches:
            return None
        times = np.concatenate([[step.start], step.times])
        states = np.concatenate([step.first[:, None], step.states], axis=1)
        margins = self.margins.along(times, states, self.enough)
        later = margins[:, 1:]
        if self.follows:
            sizes = np.abs(later).max(axis=1, initial=0.0)
            seen = self.following & np.isfinite(sizes)
            # Numbers count as equal at another event just before they become equal.
            equal = EQUAL_SIDES / EXACT_SIDES * self.least
            begun = np.fmax(np.fmin(-2 * margins[:, 0], equal), step.accuracy * sizes)
            self.noise = np.where(seen, np.maximum(self.least, begun), self.least)
        ends = np.flatnonzero((later < -self.noise[:, None]).any(axis=0))
        first = int(ends[0]) if len(ends) else len(step.times) - 1
        dip = self._dip(step, margins, first)
        if dip is not None:
            first, under = dip
        elif len(ends):
            under = float(times[first + 1]), later[:, first]
        else:
            return None
        above = float(times[first]), margins[:, first]
        return self._located(step, above, under)

    def check_drags(self, time: float, state: Floats) -> None:
        """Raise an error if a formula of drag gives an invalid torque in a state.

        Raises
        ------
        CaseError
        """
        rates = self.equations.rates(time, state)[0].tolist() if self.drags else ()
        for port, name, drag in self.drags:
            if not 0 <= (torque := drag.at(abs(rates[port]))) < math.inf:
                raise CaseError(
                    "E268",
                    f"at {time:.6g} s the drag torque of {name} is {torque:g} N*m, "
                    "expected 0 or more at every speed",
                    ("case",),
                )

    def _dip(
        self, step: TimeStep, margins: Floats, last: int
    ) -> tuple[int, tuple[float, Floats]] | None:
        """Find the first negative minimum of a margin between two instants, up to index `last`.

        Returns the index of the next instant in `step.times`, with time and margins of the minimum.
        The first column of `margins` belongs to the start of the step.
        """
        count = len(step.nodes)  # after the part with `last`, margins can be omitted
        for number, _, time in minima(step, margins[:, : (last // count + 1) * count + 1]):
            if number > last:
                break
            minimum = self._margins_at(step, time)
            if (minimum < -self.noise).any():
                return number, (time, minimum)
        return None

    def _check_capacities(self, step: TimeStep) -> None:
        for name, law in self.by_formula:
            if not abs(value := law.at(step.end)) <= LARGEST_NUMBER:
                raise CaseError(
                    "E609",
                    f"at {step.end:.6g} s the control of {name} gives {value:g}, expected "
                    f"a number up to {LARGEST_NUMBER:g}",
                    ("controls", name),
                )

    def _check_torques(self, step: TimeStep) -> None:
        if not self.torques:
            return
        _, torques = self.equations.acting(step.end, step.last)
        for port, name in self.torques:
            if abs(torques[port]) > LARGEST_NUMBER:
                raise CaseError(
                    "E670",
                    f"at {step.end:.6g} s the torque on {name} is {torques[port]:g} N*m, "
                    f"expected {LARGEST_NUMBER:g} at most",
                    ("torques", name),
                )

    def _located(
        self,
        step: TimeStep,
        above: tuple[float, Floats],
        under: tuple[float, Floats],
        most: int = _MOST_NARROWINGS,
    ) -> MarginEnd:
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
        if most and self.follows and above[0] < time < under[0]:
            there = self.margins.at(time, state)
            if (there < -self.noise)[self.following].any():
                return self._located(step, above, (time, there), most - 1)
        close = SAME_INSTANT * self.equations.system.scenario.span
        watches = [self.margins.watches[other] for at, other in places if at <= time + close]
        return MarginEnd(float(time), state, tuple(watches) or (self.margins.watches[index],))

    def _after_rise(self, step: TimeStep, index: int, first: float, last: float) -> float:
        """Return the next zero of a margin that is also 0 at the start of an interval.

        A margin that never rises usually ends at the start. A margin in `FOLLOWING` ends where it
        is below 0 by more than rounding. So do a margin `split`, which is 0 while a clutch without
        capacity sticks in a loop of other clutches, and a margin that is constant before it falls,
        such as the torque of a freewheel until the corner of a formula.
        """
        times = first + (last - first) * _NEAR
        margins = self.margins.along(times, step.between(times))[index]
        above = np.flatnonzero(margins > 0)
        if not len(above):
            stays = self.following[index] or self.margins.watches[index].kind == "split"
            noise = self.noise[index]
            before = margins[: max(1, int((margins >= -noise).argmin()) - 2)]
            rests = len(before) > 1 and np.ptp(before) <= _CONSTANT * noise
            return self._leaves(step, index, (first, last)) if stays or rests else first
        falls = np.flatnonzero(margins[above[0] :] <= 0)
        if not len(falls):
            return last
        place = int(above[0] + falls[0])
        return self._root(step, index, float(times[place - 1]), float(times[place]))

    def _leaves(self, step: TimeStep, index: int, ends: tuple[float, float]) -> float:
        """Return the time at which a margin falls below 0 by more than rounding, by bisection."""
        first, last = ends
        while first < (middle := first + (last - first) / 2) < last:
            is_below = self._margins_at(step, middle)[index] < -self.noise[index]
            first, last = (first, middle) if is_below else (middle, last)
        return last

    def _margins_at(self, step: TimeStep, time: float) -> Floats:
        return self.margins.at(time, step.between(np.array([time]))[:, 0])

    def _root(self, step: TimeStep, index: int, first: float, last: float) -> float:
        from scipy.optimize import brentq

        times = first + (last - first) * _NODES
        values = self.margins.along(times, step.between(times))[index]
        if values[0] <= 0:  # dense output and states at the instants have different rounding errors
            return self._after_rise(step, index, first, last)
        if values[-1] >= 0:
            return last
        kind = self.margins.watches[index].kind
        jumps = self.jumps and self.margins.is_torque[index]
        if not jumps and kind not in ("split", *FOLLOWING):  # smooth, so a polynomial fits
            powers: list[float] = (_TO_POWERS @ values).tolist()

            def near(part: float) -> float:
                return reduce(lambda total, power: total * part + power, powers)

            if near(0.0) > 0 > near(1.0):
                return first + (last - first) * float(brentq(near, 0.0, 1.0, xtol=ROOT_PART))

        def at(time: float) -> float:
            return float(self._margins_at(step, time)[index])

        # the margins at a time and along many times have different rounding errors, too
        if at(first) <= 0:
            return first
        if at(last) >= 0:
            return last
        return float(brentq(at, first, last, xtol=ROOT_TIME * max(1.0, last), rtol=ROOT_TIME))

    def _refined(
        self, step: TimeStep, time: float, state: Floats, index: int
    ) -> tuple[float, Floats]:
        """Refine the time of a margin's zero by Newton steps, and return it with the state.

        The state is as accurate as at the end of a step.
        """
        length = step.end - step.start
        near = AHEAD * length
        for _ in range(2):
            now = float(self.margins.at(time, state)[index])
            change = self.equations.derivative(time, state)
            ahead = state + near * change
            slope = (float(self.margins.at(time + near, ahead)[index]) - now) / near
            better = time - now / slope if slope < 0 else time
            if abs(better - time) < ROOT_TIME * max(1.0, time):
                break
            if not step.start < better <= step.end or abs(better - time) > 0.1 * length:
                break
            if abs(better - time) <= ALONG_TANGENT * length:
                return better, state + (better - time) * change
            time, state = better, step.exact(better)
        return time, state
