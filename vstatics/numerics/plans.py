"""A calculation for many variants: planned once, run again on whole arrays.

A plan is made from the calculation for one variant (see `tape`). It is run on all
variants; those that fail a guard get a plan that one of them makes, and so on. The few
that are left, and special cases that can stand for no other, are calculated by
themselves. So every variant gets the numbers that it would get alone.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.memory import Rows
from vstatics.numerics.replay import Replay, replay
from vstatics.numerics.tape import Tape, Untraceable
from vstatics.numerics.traced import Magnitude, Number, Rest, Traced

FEW = 4
"""So many variants are not worth a plan."""
WORTH = 12
"""A plan costs about as much as so many variants that are calculated by themselves."""
MOST = 256
"""Plans of one calculation; variants that fit none of them are calculated by themselves."""
TRIALS = 6
"""After so many plans in turn that were not worth making all that are left go alone."""
WIDENING = (1.05, 1.25, 2.0)
"""The bounds of a plan are so much wider than the numbers it is made for; more for later
plans, so that numbers that wander do not need a new one again and again."""
SPREAD = 64.0
"""The bounds of a plan reach no further than this factor from the variant that made it."""

Function = Callable[[Sequence[Number]], Sequence[Number | Rest]]
"""The calculation for one variant: its numbers -> its results."""


class Range(NamedTuple):
    """Bounds of an input; both have its sign."""

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


class Plan(NamedTuple):
    """The replay of a calculation, and the ranges of the inputs that it is good for."""

    ranges: Sequence[Range]
    replay: Replay

    def suits(self, inputs: Inputs) -> Booleans:
        """Which variants lie in the ranges."""
        inside = np.ones(inputs.values.shape[1], dtype=np.bool_)
        for own, (low, high) in zip(inputs.ranges, self.ranges, strict=True):
            if own.high < low or own.low > high:
                return ~inside
        for values, own, (low, high) in zip(inputs.values, inputs.ranges, self.ranges, strict=True):
            if not low <= own.low <= own.high <= high:
                inside &= (values >= low) & (values <= high)
        return inside

    def run(self, inputs: Inputs, rows: Rows) -> Booleans:
        """Write the results of all variants; mark those that pass the guards."""
        passed = np.ones(inputs.values.shape[1], dtype=np.bool_)
        self.replay.run(inputs.magnitudes, rows, passed)
        return passed

    def run_one(self, inputs: Inputs, rows: Rows) -> bool:
        """Write the results of a single variant, if it is one of those that the plan is for."""
        for own, (low, high) in zip(inputs.ranges, self.ranges, strict=True):
            if not low <= own.low <= high:
                return False
        with contextlib.suppress(ZeroDivisionError):  # after an underflow
            return self.replay.run_one(inputs.magnitudes[:, 0].tolist(), rows)
        return False


def _plan(function: Function, inputs: Inputs, place: int, widening: float) -> Plan:
    """The plan that one variant makes, for inputs like the others'.

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
    return Plan(ranges, replay(tape, function(traced)))


def _bounds(value: float, values: Floats, own: Range, widening: float) -> Range:
    """Bounds for numbers that are not too far from one of them, on its side of 0."""
    if own.low < 0 < own.high:
        values = values[(values > 0) == (value > 0)]
        own = Range(float(values.min()), float(values.max()))
    size, (low, high) = abs(value), sorted(map(abs, own))
    low, high = max(low / widening, size / SPREAD), min(high * widening, size * SPREAD)
    return Range(low, high) if value > 0 else Range(-high, -low)


class Plans:
    """All plans of a calculation; it makes them as variants come that need them."""

    def __init__(self, function: Function) -> None:
        self.function = function
        self.plans: Sequence[Plan] = ()
        """Those first that served the last variants."""
        self.alone = 0
        """Variants that were calculated by themselves so far."""
        self.special = 0
        """Those among them of which no plan could be made."""

    def run(self, inputs: Inputs, rows: Rows) -> None:
        """Calculate all variants, into a row for each result."""
        if inputs.values.shape[1] == 1 and any(one.run_one(inputs, rows) for one in self.plans):
            return
        left = np.arange(inputs.values.shape[1])
        useful: list[Plan] = []
        useless: list[Plan] = []
        for plan in self.plans:
            kept = self._run(plan, inputs, rows, left) if left.size else left
            (useful if kept.size < left.size else useless).append(plan)
            left = kept
        trials = TRIALS
        while trials and len(useful) + len(useless) < MOST and self._worth(left.size):
            place = (TRIALS - trials) * left.size // TRIALS  # neighbours are special together
            widening = WIDENING[min(len(useful) + len(useless), len(WIDENING) - 1)]
            before, variant = left, left[place]
            with contextlib.suppress(Untraceable):
                plan = _plan(self.function, prepared(inputs.values[:, left]), place, widening)
                left = self._run(plan, inputs, rows, left)
            served = before.size - left.size
            if variant in left:  # it does not even stand for itself
                self._alone(inputs, rows, np.array([variant]))
                self.special += 1
                left = left[left != variant]
            elif served > FEW or before.size <= FEW:
                useful.append(plan)
            trials = TRIALS if served >= WORTH else trials - 1
        self._alone(inputs, rows, left)
        self.plans = (*useful, *useless)

    def _worth(self, variants: int) -> bool:
        """Whether a plan is worth making: for many now, or for few that come often."""
        return variants > FEW or (variants > 0 and self.alone > FEW and self.special < TRIALS)

    def _run(self, plan: Plan, inputs: Inputs, rows: Rows, chosen: Integers) -> Integers:
        """Run a plan on those of the chosen variants that suit; give back the others."""
        everybody = chosen.size == inputs.values.shape[1]
        part = inputs if everybody else prepared(inputs.values[:, chosen])
        passed = plan.suits(part)
        count = np.count_nonzero(passed)
        if everybody and 2 * count > chosen.size:  # most of them, straight to their place
            passed &= plan.run(inputs, rows)
        elif count:
            suited = chosen[passed]
            own = Rows([np.empty(count, dtype=row.dtype) for row in rows.arrays])
            stands = plan.run(prepared(part.values[:, passed]), own)
            for row, values in enumerate(own.arrays):
                rows.vary(row)[suited[stands]] = values[stands]
            passed[passed] = stands
        return chosen[~passed]

    def _alone(self, inputs: Inputs, rows: Rows, chosen: Integers) -> None:
        """Calculate each of the chosen variants by itself."""
        self.alone += chosen.size
        for variant in chosen.tolist():
            results = self.function(inputs.values[:, variant].tolist())
            for row, value in enumerate(results):
                rows.vary(row)[variant] = value
