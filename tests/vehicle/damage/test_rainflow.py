"""Rainflow counting against the example of the standard, another way to count, and its own sums."""

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np
import pytest

from tests.chance import each_seed, generator
from vstatics.vehicle.damage.rainflow import LoadCycle, extremes, rainflow

EXAMPLE = [-2.0, 1, -3, 5, -1, 3, -4, 4, -2]
"""ASTM E1049-85, 5.4.4, figure 6."""


def by_range_and_mean(cycles: Iterable[LoadCycle]) -> dict[tuple[float, float], float]:
    sums: dict[tuple[float, float], float] = {}
    for cycle in cycles:
        key = round(cycle.range, 9), round(cycle.mean, 9)
        sums[key] = sums.get(key, 0.0) + cycle.counted
    return sums


def four_points(values: Sequence[float]) -> list[LoadCycle]:
    """Where two of four points lie between the others they are a cycle; what is left are halves.

    The way of Amzallag and others (1994): another one than that of the standard.
    """
    left, cycles = [*values], []
    at = 0
    while at + 3 < len(left):
        a, b, c, d = left[at : at + 4]
        if min(a, d) <= min(b, c) and max(b, c) <= max(a, d):
            cycles.append(LoadCycle(abs(b - c), (b + c) / 2, 1.0))
            del left[at + 1 : at + 3]
            at = max(at - 2, 0)
        else:
            at += 1
    pairs = pairwise(left)
    return [*cycles, *(LoadCycle(abs(a - b), (a + b) / 2, 0.5) for a, b in pairs)]


def test_the_example_of_the_standard() -> None:
    """The standard prints ranges and counts; means are those of the pairs that it forms."""
    ranges = [(cycle.range, cycle.counted) for cycle in rainflow(np.array(EXAMPLE))]
    counted = {r: sum(n for other, n in ranges if other == r) for r, _ in ranges}
    assert counted == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}


@each_seed(60, 2000)
@pytest.mark.parametrize("whole", [True, False])
def test_random_records_as_by_four_points(seed: int, whole: bool) -> None:
    """Whole numbers have many ranges that are equal; points between extremes do not count."""
    chance = generator(seed)
    values = chance.normal(size=int(chance.integers(0, 80))) * 4
    values = np.round(values) if whole else values
    turning = extremes(values).tolist()
    counted = rainflow(values)
    halves = np.arange(0, len(values) - 0.5, 0.5)
    between = np.interp(halves, np.arange(len(values)), values) if len(values) else values
    assert rainflow(np.repeat(between, 3)) == counted
    assert by_range_and_mean(counted) == by_range_and_mean(four_points(turning))
    assert sum(2 * one.counted for one in counted) == max(len(turning) - 1, 0)
    ways = sum(2 * one.range * one.counted for one in counted)
    assert ways == pytest.approx(np.abs(np.diff(values)).sum())
