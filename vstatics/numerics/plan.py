"""A plan: a calculation noted for one variant, to be run again on all that are like it.

There are two sorts. A plan of one sign takes magnitudes: signs cost no step, and all of its
variants have those of the one that made it. A plan of any sign costs up to twice the steps
and serves all variants of its structure.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.numerics.memory import Rows
from vstatics.numerics.replay import Replay, replay
from vstatics.numerics.signed import Signed, Truth
from vstatics.numerics.tape import Rest, Tape
from vstatics.numerics.traced import Magnitude, Number, Traced

SPREAD = 64.0
"""The bounds of a plan of one sign reach no further than this factor from the variant that made
it."""
SIGNED_WIDENING = (1.005, 2.0)
"""The bounds of a plan of any sign are so much wider than the numbers that it is made for: less
for the first one and numbers of one sign, so that efficiencies stay below 1."""

LEAST_INPUT = 1e-20
"""A plan of any sign is for no smaller magnitudes, nor for larger ones than its inverse."""

Function = Callable[[Sequence[Number]], Sequence[Number | Rest | Truth]]
"""The calculation for one variant: its numbers -> its results."""


class Range(NamedTuple):
    """Bounds of an input."""

    low: float
    high: float


class Inputs(NamedTuple):
    """The numbers that vary, (inputs, variants), and what plans need to know of them."""

    values: Floats
    magnitudes: Floats
    ranges: Sequence[Range]


def prepared(values: Floats) -> Inputs:
    """Inputs of shape (inputs, variants) for plans."""
    if values.shape[1] == 1:
        lows = highs = values[:, 0]
    else:
        lows, highs = values.min(axis=1, initial=np.inf), values.max(axis=1, initial=-np.inf)
    return Inputs(values, np.abs(values), list(map(Range, lows.tolist(), highs.tolist())))


class Plan:
    """The replay of a calculation, the ranges of the inputs that it is good for, its worth."""

    def __init__(self, ranges: Sequence[Range], replay: Replay, *, signed: bool) -> None:
        self.ranges = ranges
        self.replay = replay
        self.signed = signed
        """It is of any sign."""
        self.served = 0
        """Variants, when it was last run."""
        self.share = 1.0
        """The part of those that it was run on."""

    @property
    def steps(self) -> int:
        """How many steps it takes."""
        return len(self.replay.steps)

    def numbers(self, inputs: Inputs) -> Floats:
        """The inputs as they stand on its tape."""
        return inputs.values if self.signed else inputs.magnitudes

    def suits(self, inputs: Inputs) -> Booleans:
        """Which variants lie in the ranges."""
        inside = np.ones(inputs.values.shape[1], dtype=np.bool_)
        for own, (low, high) in zip(inputs.ranges, self.ranges, strict=True):
            if own.high < low or own.low > high:
                return ~inside
        for place, (own, (low, high)) in enumerate(zip(inputs.ranges, self.ranges, strict=True)):
            if not low <= own.low <= own.high <= high:
                values = inputs.values[place]
                inside &= (values >= low) & (values <= high)
            if low < 0 < high:
                inside &= inputs.magnitudes[place] > LEAST_INPUT
        return inside

    def run(self, inputs: Inputs, rows: Rows) -> Booleans:
        """Write the results of all variants; mark those that pass the guards."""
        passed = np.ones(inputs.values.shape[1], dtype=np.bool_)
        self.replay.run(self.numbers(inputs), rows, passed)
        return passed

    def run_one(self, inputs: Inputs, rows: Rows) -> bool:
        """Write the results of a single variant, if it is one of those that the plan is for."""
        for own, (low, high) in zip(inputs.ranges, self.ranges, strict=True):
            if not low <= own.low <= high:
                return False
        with contextlib.suppress(ZeroDivisionError):  # after an underflow
            return self.replay.run_one(self.numbers(inputs)[:, 0].tolist(), rows)
        return False


def plan_of_one_sign(function: Function, inputs: Inputs, place: int, widening: float) -> Plan:
    """The plan that one variant makes, for inputs like the others'; all of its sign.

    Raises
    ------
    Untraceable
        If it is a special case.
    """
    firsts = inputs.values[:, place].tolist()
    ranges = [
        _bounds(value, values, own, widening)
        for value, values, own in zip(firsts, inputs.values, inputs.ranges, strict=True)
    ]
    tape = Tape(len(firsts))
    traced = []
    for slot, (value, bounds) in enumerate(zip(firsts, ranges, strict=True)):
        magnitude = Magnitude(slot, abs(value), *sorted(map(abs, bounds)))
        traced.append(Traced(tape, 1 if value > 0 else -1, magnitude))
    return Plan(ranges, replay(tape, function(traced)), signed=False)


def plan_of_any_sign(function: Function, inputs: Inputs, place: int, *, again: bool) -> Plan:
    """The plan that one variant makes, for inputs of any size and sign.

    Raises
    ------
    Untraceable
        If it is a special case.
    """
    firsts = inputs.values[:, place].tolist()
    ranges = [_wide(own, again=again) for own in inputs.ranges]
    tape = Tape(len(firsts))
    numbers = [
        Signed(tape, slot, value, *bounds)
        for slot, (value, bounds) in enumerate(zip(firsts, ranges, strict=True))
    ]
    return Plan(ranges, replay(tape, function(numbers)), signed=True)


def _wide(own: Range, *, again: bool) -> Range:
    """Bounds of numbers, and some room."""
    low, high = own
    more = SIGNED_WIDENING[again or low < 0 < high]
    less, most = 1 / more, 1 / LEAST_INPUT
    low = max(low * more, -most) if low < 0 else max(low * less, LEAST_INPUT)
    high = min(high * more, most) if high > 0 else min(high * less, -LEAST_INPUT)
    return Range(low, high)


def _bounds(value: float, values: Floats, own: Range, widening: float) -> Range:
    """Bounds for numbers that are not too far from one of them, on its side of 0."""
    if own.low < 0 < own.high:
        values = values[(values > 0) == (value > 0)]
        own = Range(float(values.min()), float(values.max()))
    size, (low, high) = abs(value), sorted(map(abs, own))
    low, high = max(low / widening, size / SPREAD), min(high * widening, size * SPREAD)
    return Range(low, high) if value > 0 else Range(-high, -low)
