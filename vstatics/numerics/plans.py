"""A calculation for many variants: planned once, run again on whole arrays.

A plan is made from the calculation for one variant (see `plan`). It is run on all variants;
those that fail a guard get a plan that one of them makes, and so on. The few that are left,
and special cases that can stand for no other, are calculated by themselves. So every variant
gets the numbers that it would get alone: to the last bit by plans of one sign, to rounding
by plans of any sign, which may take the pivots in another order.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence

import numpy as np

from vstatics.numerics.arrays import Integers
from vstatics.numerics.memory import Rows
from vstatics.numerics.plan import (
    Function,
    Inputs,
    Plan,
    plan_of_any_sign,
    plan_of_one_sign,
    prepared,
)
from vstatics.numerics.tape import Untraceable

FEW = 4
"""So many variants are not worth a plan; more of them, when plans were made in vain."""
WORTH = 12
"""A plan costs about as much as so many variants that are calculated by themselves."""
STEPS = 250
"""So many steps of a plan on few variants cost about as much as one variant by itself."""
LEAST_SHARE = 1 / 64
"""A plan may serve so many again, even if it did not when it was last run."""
MOST = 256
"""Plans of one calculation; variants that fit none of them are calculated by themselves."""
TRIALS = 6
"""After so many plans in turn that were not worth making all that are left go alone."""
WIDENING = (1.05, 1.25, 2.0)
"""The bounds of a plan of one sign are so much wider than the numbers it is made for; more for
later plans, so that numbers that wander do not need a new one again and again."""
HALF = 0.5
"""A plan of one sign is run where it serves more than this part, if others serve any sign, ..."""
SAMPLE = 64
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
        self.few = FEW

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
        while trials and len(self.plans) < MOST and self._worth(left.size, inputs):
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
            elif served > FEW or before.size <= FEW:
                self.plans = (*self.plans, plan)
            if served <= FEW < total:
                self.few += FEW
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
        often = left == inputs.values.shape[1] and self.alone > FEW and self.special < TRIALS
        return left > self.few or (left > 0 and often)

    def _promises(self, plan: Plan, inputs: Inputs, rows: Rows, left: Integers) -> bool:
        """Whether a plan is worth running on those that are left."""
        if not max(plan.share, LEAST_SHARE) * left.size * STEPS > plan.steps:
            return False
        if plan.signed or plan.share > HALF or not self.plans[-1].signed:
            return True
        if self.calls % SAMPLED:
            return False
        some = prepared(inputs.values[:, left[:: left.size // SAMPLE + 1]])
        passed = plan.suits(some)
        if passed.mean() > HALF:
            passed &= plan.run(some, rows.alike(int(passed.size), plan.replay.layout))
        return bool(passed.mean() > HALF)

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
            results = self.function(inputs.values[:, variant].tolist())
            for row, value in enumerate(results):
                rows.vary(row)[variant] = value
