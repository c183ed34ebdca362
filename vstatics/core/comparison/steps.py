"""Comparison of step ratios, which are defined as in the design table."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from vstatics.core.comparison.numbers import Difference, is_same
from vstatics.core.model.transmission import Transmission
from vstatics.core.summary.design_table import ends_of, ranges_of
from vstatics.core.tables.written_results import Figure, WrittenResult

Steps = dict[tuple[str, str], Figure]
"""Step ratios by the names of the lower gear and the next gear."""


def steps_of(result: WrittenResult, gears: Sequence[str], case: Transmission | None) -> Steps:
    """Return the step ratios of a result.

    Parameters
    ----------
    result : WrittenResult
    gears : sequence of str
        Names of all gears of the result.
    case : Transmission or None
        Case, which determines which gears have a step between them. Without a case, all
        neighbouring gears of the same direction have a step.

    Examples
    --------
    >>> result = WrittenResult({"ratio": [[Figure(-2.0), Figure(3.0), Figure(1.5)]]}, None, False)
    >>> steps_of(result, ["R", "1", "2"], None)
    {('1', '2'): Figure(value=2.0, slack=0.0)}
    """
    [ratios] = result.tables.get("ratio") or [[]]
    if len(ratios) != len(gears):
        return {}
    kinds: Sequence[object] = [""] * len(ratios)
    if case and len(case.gears) == len(ratios):
        kinds = ends_of(case)
    return {
        (gears[lower], gears[upper]): _step(ratios[lower], ratios[upper])
        for indices in ranges_of([ratio.value for ratio in ratios], kinds, gears)
        for lower, upper in pairwise(indices)
    }


def _step(lower: Figure, upper: Figure) -> Figure:
    if not (lower.value and upper.value):
        return Figure(math.nan)
    step = lower.value / upper.value
    return Figure(
        step, abs(step) * (lower.slack / abs(lower.value) + upper.slack / abs(upper.value))
    )


def step_differences(
    actual: Steps, expected: Steps, ratios: Collection[str], atol: float, rtol: float
) -> Iterator[Difference]:
    """Yield differences of steps from or to gears whose ratios differ between the results.

    Other steps are not compared, so that results with equal tables never differ. The `row` of a
    difference is the next gear.

    Parameters
    ----------
    actual, expected : Steps
    ratios : collection of str
        Names of the gears whose ratios differ.
    atol, rtol : float
        Absolute and relative tolerance.
    """
    missing = Figure(float("nan"))
    for pair in [*expected, *(pair for pair in actual if pair not in expected)]:
        here, there = actual.get(pair, missing), expected.get(pair, missing)
        if {*pair} & {*ratios} and not is_same(here, there, atol, rtol):
            yield Difference("step", pair[1], pair[0], here.value, there.value)
