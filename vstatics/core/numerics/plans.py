"""A calculation for many variants: planned once, run again on all that are like the first.

A plan is made from the calculation for one variant (`Plan`). It is run on all variants;
those that fail a guard get a plan that one of them makes, and so on. The few that are left,
and special cases that can stand for no other, are calculated by themselves. So every variant
gets the numbers that it would get alone: to the last bit by plans of one sign, to rounding
by plans of any sign, which may take the pivots in another order.

There are two sorts. A plan of one sign takes magnitudes: signs cost no step, and all of its
variants have those of the one that made it. A plan of any sign costs up to twice the steps
and serves all variants of its structure.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.memory import Rows
from vstatics.core.numerics.replay import Replay, replay
from vstatics.core.numerics.signed import Signed, Truth
from vstatics.core.numerics.tape import Residual, Tape, Untraceable
from vstatics.core.numerics.tolerances import LEAST_INPUT
from vstatics.core.numerics.traced import Magnitude, Number, Traced

FEW_VARIANTS = 4
"""So many variants are not worth a plan; more of them, when plans were made in vain."""
WORTH = 12
"""A plan costs about as much as so many variants that are calculated by themselves."""
STEPS_LIKE_ONE_VARIANT = 250
"""So many steps of a plan on few variants cost about as much as one variant by itself."""
LEAST_SHARE = 1 / 64
"""A plan may serve so many again, even if it did not when it was last run."""
MOST_PLANS = 256
"""Plans of one calculation; variants that fit none of them are calculated by themselves."""
TRIALS = 6
"""After so many plans in turn that were not worth making all that are left go alone."""
WIDENING = (1.05, 1.25, 2.0)
"""The bounds of a plan of one sign are so much wider than the numbers it is made for; more for
later plans, so that numbers that wander do not need a new one again and again."""
SERVED_PART = 0.5
"""A plan of one sign is run where it serves more than this part, if others serve any sign, ..."""
SAMPLE_VARIANTS = 64
"""... which so many variants tell, ..."""
SAMPLED = 8
"""... one call in so many."""


class Plans:
    """All plans of a calculation; it makes them as variants come that need them."""

    def __init__(self, function: Function) -> None:
        self.function = function
        self.plans: Sequence[Plan] = ()
        """Those of one sign first, as they take fewer steps; then those that served most."""
        self.calls = 0
        self.alone = 0
        """Variants that were calculated by themselves so far."""
        self.special = 0
        """Those among them of which no plan could be made."""
        self.few = FEW_VARIANTS

    def run(self, inputs: Inputs, rows: Rows) -> None:
        """Calculate all variants, into a row for each result."""
        total = inputs.values.shape[1]
        mine = [plan for plan in self.plans if not plan.signed or total > 1]
        if total == 1 and any(plan.run_one(inputs, rows) for plan in mine):
            return
        self.calls += 1
        left = np.arange(total)
        for plan in mine:
            plan.served = 0
            if left.size and self._promises(plan, inputs, rows, left):
                left = self._run(plan, inputs, rows, left)
        left = self._with_new_plans(inputs, rows, left)
        self._alone(inputs, rows, left)
        # a new one, as another thread may be at the old one
        self.plans = sorted(self.plans, key=lambda plan: (plan.signed, -plan.served))

    def _with_new_plans(self, inputs: Inputs, rows: Rows, left: Integers) -> Integers:
        """Make plans for variants that are left as long as that is worth it; who is left then."""
        trials, total = TRIALS, inputs.values.shape[1]
        while trials and len(self.plans) < MOST_PLANS and self._worth(left.size, inputs):
            place = (TRIALS - trials) * left.size // TRIALS  # neighbours are special together
            before, variant = left, left[place]
            with contextlib.suppress(Untraceable):
                alike = before.size == total and not any(plan.signed for plan in self.plans)
                plan = self._new(prepared(inputs.values[:, left]), place, alike=alike)
                left = self._run(plan, inputs, rows, left)
            served = before.size - left.size
            if variant in left:  # it does not even stand for itself
                self._alone(inputs, rows, np.array([variant]))
                self.special += 1
                left = left[left != variant]
            elif served > FEW_VARIANTS or before.size <= FEW_VARIANTS:
                self.plans = (*self.plans, plan)
            if served <= FEW_VARIANTS < total:
                self.few += FEW_VARIANTS
            trials = TRIALS if served >= WORTH else trials - 1
        return left

    def _new(self, inputs: Inputs, place: int, *, alike: bool) -> Plan:
        """The plan of a variant: of its sign, where that may serve all or there is but one."""
        alike &= all(low >= 0 or high <= 0 for low, high in inputs.ranges)
        if inputs.values.shape[1] > 1 and not alike:
            with contextlib.suppress(Untraceable):
                again = any(plan.signed for plan in self.plans)
                return plan_of_any_sign(self.function, inputs, place, again=again)
        widening = WIDENING[min(len(self.plans), len(WIDENING) - 1)]
        return plan_of_one_sign(self.function, inputs, place, widening)

    def _worth(self, left: int, inputs: Inputs) -> bool:
        """Whether a plan is worth making: for many now, or for few that come often."""
        often = (
            left == inputs.values.shape[1] and self.alone > FEW_VARIANTS and self.special < TRIALS
        )
        return left > self.few or (left > 0 and often)

    def _promises(self, plan: Plan, inputs: Inputs, rows: Rows, left: Integers) -> bool:
        """Whether a plan is worth running on those that are left."""
        if not max(plan.share, LEAST_SHARE) * left.size * STEPS_LIKE_ONE_VARIANT > plan.steps:
            return False
        if plan.signed or plan.share > SERVED_PART or not self.plans[-1].signed:
            return True
        if self.calls % SAMPLED:
            return False
        some = prepared(inputs.values[:, left[:: left.size // SAMPLE_VARIANTS + 1]])
        passed = plan.suits(some)
        if passed.mean() > SERVED_PART:
            passed &= plan.run(some, rows.alike(int(passed.size), plan.replay.layout))
        return bool(passed.mean() > SERVED_PART)

    def _run(self, plan: Plan, inputs: Inputs, rows: Rows, chosen: Integers) -> Integers:
        """Run a plan on those of the chosen variants that suit; give back the others."""
        everybody = chosen.size == inputs.values.shape[1]
        part = inputs if everybody else prepared(inputs.values[:, chosen])
        passed = plan.suits(part)
        count = int(np.count_nonzero(passed))
        if everybody and 2 * count > chosen.size:  # most of them, straight to their place
            passed &= plan.run(inputs, rows)
        elif count:
            suited = chosen[passed]
            layout = plan.replay.layout
            own = rows.alike(count, layout)
            stands = plan.run(prepared(part.values[:, passed]), own)
            rows.put(suited[stands], own, stands, layout)
            passed[passed] = stands
        left = chosen[~passed]
        plan.served = chosen.size - left.size
        plan.share = plan.served / chosen.size
        return left

    def _alone(self, inputs: Inputs, rows: Rows, chosen: Integers) -> None:
        """Calculate each of the chosen variants by itself."""
        self.alone += chosen.size
        for variant in chosen.tolist():
            rows.put_variant(variant, self.function(inputs.values[:, variant].tolist()))


SPREAD = 64.0
"""The bounds of a plan of one sign reach no further than this factor from the variant that made
it."""
SIGNED_WIDENING = (1.005, 2.0)
"""The bounds of a plan of any sign are so much wider than the numbers that it is made for: less
for the first one and numbers of one sign, so that efficiencies stay below 1."""


Function = Callable[[Sequence[Number]], Sequence[Number | Residual | Truth]]
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
