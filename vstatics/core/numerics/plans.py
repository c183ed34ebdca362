"""Plans: calculations recorded for one variant and repeated for similar variants.

A plan is the recorded arithmetic of one variant, which is repeated on arrays of all variants.
Guards in the plan are conditions under which the arithmetic applies to a variant. If variants fail
a guard, a further plan is recorded for one of these variants, and so on. The few remaining
variants, and special cases that cannot represent others, are calculated individually. All results
equal individual calculations: to the last bit with plans of fixed sign, within rounding with plans
of any sign, which can choose another order of pivots.

A plan of fixed sign calculates only magnitudes. It serves variants whose numbers have the same
signs as in the recorded variant. A plan of any sign takes up to twice as many operations, but
serves all variants of a structure. Such a plan is repeated with decimals of many digits for
variants that only the rounding of floats excludes.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.memory import Rows
from vstatics.core.numerics.replay import Replay, replay
from vstatics.core.numerics.signed import Signed, Truth
from vstatics.core.numerics.tape import Residual, Tape, Untraceable
from vstatics.core.numerics.tolerances import DECIMAL_DIGITS, DECIMAL_ZERO, LEAST_INPUT
from vstatics.core.numerics.traced import Magnitude, Number, Traced
from vstatics.core.start import NamedTuple

FEW_VARIANTS = 4
"""Number of variants up to which all are calculated individually, without a plan.

`Plans.few` starts with this number, and grows by it after each plan that serves no more variants.
"""
OFTEN = 2
"""Number of individually calculated variants after which even a single variant gets a plan.

Recording a plan of fixed sign takes as much time as three or four variants.
"""
WORTH = 12
"""Cost of recording a plan, as a number of individually calculated variants."""
STEPS_LIKE_ONE_VARIANT = 250
"""Number of steps of a plan that cost as much as an individually calculated variant."""
LEAST_SERVED = 1 / 64
"""Lower limit of the expected fraction of variants that a plan serves in the next run."""
MOST_PLANS = 256
"""Largest number of plans of a calculation. Further variants are calculated individually."""
TRIALS = 6
"""Number of successive plans with fewer than `WORTH` variants after which recording ends."""
WIDENING = (1.05, 1.25, 2.0)
"""Factors by which the input bounds of plans of fixed sign exceed the recorded inputs.

Later plans, and plans recorded for a single variant, have wider bounds, so that slowly changing
inputs do not need a new plan in each run.
"""
SERVED_PART = 0.5
"""Fraction of variants that a plan of fixed sign must serve if a plan of any sign exists."""
SAMPLE_VARIANTS = 64
"""Number of variants in a sample, from which the served fraction is estimated."""
SAMPLED = 8
"""Number of runs between two such estimates."""


class Plans:
    """Plans of a calculation, recorded when needed."""

    def __init__(self, function: Function, complete: Completion | None = None) -> None:
        self.function = function
        self.complete = complete
        """Function that completes results calculated with decimals; None if only floats apply."""
        self.plans: Sequence[Plan] = ()
        """Recorded plans: first plans of fixed sign, which take fewer steps, then by number of
        variants.
        """
        self.calls = 0
        self.alone = 0
        """Number of variants that were calculated individually."""
        self.special = 0
        """Number of variants for which no plan could be recorded, or not with the right result."""
        self.few = FEW_VARIANTS
        self.of_single: Sequence[Plan] = ()
        """Plans of fixed sign for individual variants, repeated without arrays."""
        self.wait = self.waiting = FEW_VARIANTS
        """Number of individual variants from one recorded plan to the next, and those left."""

    def run(self, inputs: Inputs, rows: Rows) -> None:
        """Calculate all variants, and write each result to a row of `rows`."""
        total = inputs.values.shape[1]
        usable = [plan for plan in self.plans if not plan.signed or total > 1]
        self.calls += 1
        left = np.arange(total)
        for plan in usable:
            plan.served = 0
            if left.size and self._promises(plan, inputs, rows, left):
                left = self._run(plan, inputs, rows, left)
        left = self._with_new_plans(inputs, rows, left)
        self._alone(inputs, rows, left)
        # This is a new list, because another thread can be using the old list.
        self.plans = sorted(self.plans, key=lambda plan: (plan.signed, -plan.served))

    def run_one(self, numbers: Sequence[float], results: int) -> Sequence[float]:
        """Return the results of a single variant; `results` is their number."""
        for plan in self.plans:
            if not plan.signed and (calculated := plan.run_one(numbers)):
                return calculated
        rows = np.empty((results, 1))
        self.run(prepared(np.array(numbers)[:, np.newaxis]), Rows([*rows]))
        of_all: list[float] = rows[:, 0].tolist()
        return of_all

    def _with_new_plans(self, inputs: Inputs, rows: Rows, left: Integers) -> Integers:
        """Record plans while this saves time; return the variants that remain without a plan."""
        trials, total = TRIALS, inputs.values.shape[1]
        while trials and len(self.plans) < MOST_PLANS and self._worth(left.size, inputs):
            # special cases are often neighbours, so variants are taken from the whole range
            place = (TRIALS - trials) * left.size // TRIALS
            before, variant = left, left[place]
            with contextlib.suppress(Untraceable):
                alike = before.size == total and not any(plan.signed for plan in self.plans)
                plan = self._new(prepared(inputs.values[:, left]), place, alike=alike)
                left = self._run(plan, inputs, rows, left)
            served = before.size - left.size
            # the plan does not even serve the variant for which it was recorded
            if variant in left:
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
        """Return a plan recorded for the variant with the index `place`.

        The plan is of fixed sign for a single variant, or if `alike` is True and no input changes
        sign. Otherwise it is of any sign, if possible.
        """
        alike &= all(low >= 0 or high <= 0 for low, high in inputs.ranges)
        if inputs.values.shape[1] > 1 and not alike:
            with contextlib.suppress(Untraceable):
                again = any(plan.signed for plan in self.plans)
                return plan_of_any_sign(self.function, inputs, place, again=again)
        further = len(self.plans) + (inputs.values.shape[1] == 1)
        widening = WIDENING[min(further, len(WIDENING) - 1)]
        return plan_of_one_sign(self.function, inputs, place, widening)

    def _worth(self, left: int, inputs: Inputs) -> bool:
        total = inputs.values.shape[1]
        often = left == total and self.alone >= OFTEN and self.special < TRIALS
        # A single variant with an input of 0 has no plan, but later variants can have plans.
        often &= total > 1 or bool(inputs.values.all())
        return left > self.few or (left > 0 and often)

    def _promises(self, plan: Plan, inputs: Inputs, rows: Rows, left: Integers) -> bool:
        """Return whether a plan is likely to serve enough of the remaining variants."""
        if not max(plan.share, LEAST_SERVED) * left.size * STEPS_LIKE_ONE_VARIANT > plan.steps:
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
        """Run a plan on the suitable variants among `chosen`, and return the remaining variants."""
        if inputs.values.shape[1] == 1 and not plan.signed:
            results = plan.run_one(inputs.values[:, 0].tolist())
            rows.put_variant(0, results or ())
            plan.served = int(results is not None)
            return chosen[plan.served :]
        everybody = chosen.size == inputs.values.shape[1]
        part = inputs if everybody else prepared(inputs.values[:, chosen])
        passed = plan.suits(part)
        count = int(np.count_nonzero(passed))
        # If most variants are suitable, the plan writes results directly to their final position.
        if everybody and 2 * count > chosen.size:
            passed &= plan.run(inputs, rows)
        elif count:
            suited = chosen[passed]
            layout = plan.replay.layout
            suited_rows = rows.alike(count, layout)
            stands = plan.run(prepared(part.values[:, passed]), suited_rows)
            rows.put(suited[stands], suited_rows, stands, layout)
            passed[passed] = stands
        left = chosen[~passed]
        plan.served = chosen.size - left.size
        if count:
            plan.share = plan.served / chosen.size
        return left

    def _alone(self, inputs: Inputs, rows: Rows, chosen: Integers) -> None:
        self.alone += chosen.size
        for variant in chosen.tolist():
            numbers = inputs.values[:, variant].tolist()
            rows.put_variant(variant, self._in_decimals(numbers) or self._of_single(numbers))

    def _of_single(self, numbers: Sequence[float]) -> Sequence[Any]:
        """Return the results of a variant; record a plan after enough variants without a plan."""
        for plan in self.of_single:
            if results := plan.run_one(numbers):
                return results
        self.waiting -= 1
        if self.waiting < 0 and len(self.of_single) < MOST_PLANS:
            self.wait += FEW_VARIANTS
            self.waiting = self.wait
            with contextlib.suppress(Untraceable):
                single = prepared(np.array(numbers)[:, np.newaxis])
                plan = plan_of_one_sign(self.function, single, 0, WIDENING[-1])
                if results := plan.run_one(numbers):
                    self.of_single = (plan, *self.of_single)
                    return results
        return self.function(numbers)

    def _in_decimals(self, numbers: Sequence[float]) -> list[float] | None:
        """Return the results of a variant that only the rounding of floats excludes, else None."""
        if self.complete is None:
            return None
        for plan in self.plans:
            if plan.signed and (results := plan.run_in_decimals(numbers)):
                self.complete(numbers, results)
                return results
        return None


SPREAD = 64.0
"""Largest quotient of an input bound of a plan of fixed sign and the recorded input."""
SIGNED_WIDENING = (1.005, 2.0)
"""Factors by which the input bounds of plans of any sign exceed the recorded inputs.

The first factor, for the first plan and inputs of a single sign, is small so that efficiencies stay
near or below 1.
"""


Function = Callable[[Sequence[Number]], Sequence[Number | Residual | Truth]]
"""Function that calculates the results of a variant from input numbers."""


Completion = Callable[[Sequence[float], list[float]], None]
"""Function that changes the results of a variant in place; the first argument has the inputs."""


class Range(NamedTuple):
    """Smallest and largest value of an input."""

    low: float
    high: float


class Inputs(NamedTuple):
    """Input numbers of shape (inputs, variants), with their magnitudes and ranges."""

    values: Floats
    magnitudes: Floats
    ranges: Sequence[Range]


def prepared(values: Floats) -> Inputs:
    """Return an array of shape (inputs, variants) as the inputs of plans."""
    if values.shape[1] == 1:
        lows = highs = values[:, 0]
    else:
        lows, highs = values.min(axis=1, initial=np.inf), values.max(axis=1, initial=-np.inf)
    return Inputs(values, np.abs(values), list(map(Range, lows.tolist(), highs.tolist())))


class Plan:
    """Recorded calculation, with ranges of inputs for which it is valid."""

    def __init__(self, ranges: Sequence[Range], replay: Replay, *, signed: bool) -> None:
        self.ranges = ranges
        self.replay = replay
        self.signed = signed
        """True for a plan of any sign, False for a plan of fixed sign."""
        self.served = 0
        """Number of variants served in the last run."""
        self.share = 1.0
        """Fraction of variants served in the last run in which a variant was suitable."""

    @property
    def steps(self) -> int:
        """Number of recorded operations."""
        return len(self.replay.steps)

    def numbers(self, inputs: Inputs) -> Floats:
        """Return the inputs for the plan: with signs for a plan of any sign, else as magnitudes."""
        return inputs.values if self.signed else inputs.magnitudes

    def suits(self, inputs: Inputs) -> Booleans:
        """Return flags of variants whose inputs are within the ranges of the plan."""
        inside = np.ones(inputs.values.shape[1], dtype=np.bool_)
        for given, (low, high) in zip(inputs.ranges, self.ranges, strict=True):
            if given.high < low or given.low > high:
                return ~inside
        for place, (given, (low, high)) in enumerate(zip(inputs.ranges, self.ranges, strict=True)):
            if not low <= given.low <= given.high <= high:
                values = inputs.values[place]
                inside &= (values >= low) & (values <= high)
            if low < 0 < high:
                inside &= inputs.magnitudes[place] > LEAST_INPUT
        return inside

    def run(self, inputs: Inputs, rows: Rows) -> Booleans:
        """Write the results of all variants, and return flags of variants that pass all guards."""
        passed = np.ones(inputs.values.shape[1], dtype=np.bool_)
        self.replay.run(self.numbers(inputs), rows, passed)
        return passed

    def run_one(self, numbers: Sequence[float]) -> list[float] | None:
        """Return the results of a single variant, or None if the plan does not apply."""
        if not self._contains(numbers):
            return None
        try:
            return self.replay.run_one(map(abs, numbers))
        except ZeroDivisionError:  # a divisor can underflow to 0
            return None

    def _contains(self, numbers: Sequence[float]) -> bool:
        for number, (low, high) in zip(numbers, self.ranges, strict=True):
            if not low <= number <= high:
                return False
        return True

    def run_in_decimals(self, numbers: Sequence[float]) -> list[float] | None:
        """Return the correctly rounded results of a variant, or None if a guard fails."""
        if not (self._contains(numbers) and min(map(abs, numbers)) > LEAST_INPUT):
            return None
        from decimal import Context, Decimal, localcontext  # decimals cost start-up time

        with localcontext(Context(DECIMAL_DIGITS, traps=[])):
            results = self._replay_in_decimals.run_one(map(Decimal, numbers))  # type: ignore[arg-type]
        if results:
            shorter = Context(DECIMAL_DIGITS * 3 // 4)
            for row in self.replay.layout.varied:
                number = float(shorter.create_decimal(results[row]))
                results[row] = 0.0 if abs(number) < DECIMAL_ZERO else number
        return results

    @cached_property
    def _replay_in_decimals(self) -> Replay:
        from decimal import Decimal  # decimals cost start-up time

        cells = list(self.replay.after_inputs)
        constants = len(cells) - len(self.replay.layout.constants)
        cells[:constants] = map(Decimal, cells[:constants])  # type: ignore[arg-type]
        return self.replay._replace(after_inputs=cells)


def plan_of_one_sign(function: Function, inputs: Inputs, place: int, widening: float) -> Plan:
    """Return the plan recorded for a variant, valid for inputs with the signs of the variant.

    Raises
    ------
    Untraceable
        If the variant is a special case.
    """
    firsts = inputs.values[:, place].tolist()
    ranges = [
        _bounds(value, values, given, widening)
        for value, values, given in zip(firsts, inputs.values, inputs.ranges, strict=True)
    ]
    tape = Tape(len(firsts))
    traced = []
    for slot, (value, bounds) in enumerate(zip(firsts, ranges, strict=True)):
        magnitude = Magnitude(slot, abs(value), *sorted(map(abs, bounds)))
        traced.append(Traced(tape, 1 if value > 0 else -1, magnitude))
    return Plan(ranges, replay(tape, function(traced)), signed=False)


def plan_of_any_sign(function: Function, inputs: Inputs, place: int, *, again: bool) -> Plan:
    """Return the plan recorded for a variant, valid for inputs of any sign.

    Raises
    ------
    Untraceable
        If the variant is a special case.
    """
    firsts = inputs.values[:, place].tolist()
    ranges = [_wide(given, again=again) for given in inputs.ranges]
    tape = Tape(len(firsts))
    numbers = [
        Signed(tape, slot, value, *bounds)
        for slot, (value, bounds) in enumerate(zip(firsts, ranges, strict=True))
    ]
    return Plan(ranges, replay(tape, function(numbers)), signed=True)


def _wide(given: Range, *, again: bool) -> Range:
    low, high = given
    more = SIGNED_WIDENING[again or low < 0 < high]
    less, most = 1 / more, 1 / LEAST_INPUT
    low = max(low * more, -most) if low < 0 else max(low * less, LEAST_INPUT)
    high = min(high * more, most) if high > 0 else min(high * less, -LEAST_INPUT)
    return Range(low, high)


def _bounds(value: float, values: Floats, given: Range, widening: float) -> Range:
    """Return the input bounds of a plan of fixed sign around an input, limited by `SPREAD`."""
    if given.low < 0 < given.high:
        values = values[(values > 0) == (value > 0)]
        given = Range(float(values.min()), float(values.max()))
    size, (low, high) = abs(value), sorted(map(abs, given))
    low, high = max(low / widening, size / SPREAD), min(high * widening, size * SPREAD)
    return Range(low, high) if value > 0 else Range(-high, -low)
