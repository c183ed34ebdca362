"""Steps between the gears of two written results, as the design table has them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from vstatics.core.comparison.numbers import Difference, is_same
from vstatics.core.model.transmission import Transmission
from vstatics.core.summary.design_table import ranges_of
from vstatics.core.tables.written_results import Figure, WrittenResult

Steps = dict[tuple[str, str], Figure]
"""By the lower gear and the next."""


def steps_of(result: WrittenResult, gears: Sequence[str], case: Transmission | None) -> Steps:
    """The steps of a result.

    Parameters
    ----------
    result : WrittenResult
    gears : sequence of str
        Names of its gears, as many as it has.
    case : Transmission or None
        Tells which gears can be compared; without it those of one direction can.

    Examples
    --------
    >>> made = WrittenResult({"ratio": [[Figure(-2.0), Figure(3.0), Figure(1.5)]]}, None, False)
    >>> steps_of(made, ["R", "1", "2"], None)
    {('1', '2'): Figure(value=2.0, slack=0.0)}
    """
    [ratios] = result.tables.get("ratio") or [[]]
    if len(ratios) != len(gears):
        return {}
    kinds: Sequence[object] = [""] * len(ratios)
    if case and len(case.gears) == len(ratios):
        kinds = [
            (case.gear_input(gear), case.gear_output(gear)) if gear.kind == "gear" else None
            for gear in case.gears
        ]
    return {
        (gears[one], gears[other]): _step(ratios[one], ratios[other])
        for indices in ranges_of([one.value for one in ratios], kinds, gears)
        for one, other in pairwise(indices)
    }


def _step(one: Figure, other: Figure) -> Figure:
    if not (one.value and other.value):
        return Figure(math.nan)
    step = one.value / other.value
    return Figure(step, abs(step) * (one.slack / abs(one.value) + other.slack / abs(other.value)))


def step_differences(
    actual: Steps, expected: Steps, ratios: Collection[str], atol: float, rtol: float
) -> Iterator[Difference]:
    """Steps that differ, of gears whose ratios do: `row` is the next gear.

    So no step tells apart results whose tables agree.

    Parameters
    ----------
    ratios : collection of str
        The gears whose ratios differ.
    """
    none = Figure(float("nan"))
    for pair in [*expected, *(pair for pair in actual if pair not in expected)]:
        one, other = actual.get(pair, none), expected.get(pair, none)
        if {*pair} & {*ratios} and not is_same(one, other, atol, rtol):
            yield Difference("step", pair[1], pair[0], one.value, other.value)
