"""Boxes with wanted numbers and steps of gears, against all choices of gears on a grid of ratios.

What the grid has must be found, with as many gears; what is found must be so by the null space of
the equations (`tests.oracle.test_boxes.ratio`), with each element in a gear.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise, product

import numpy as np
import pytest

from tests.oracle.boxes import Frame, Space, all_frames
from tests.oracle.test_boxes import Pairs, ratio
from tests.oracle.test_found_boxes import asked, ports_of
from vstatics.synthesis.boxes.box import WantedSequence

pytestmark = pytest.mark.slow  # they compile
BOUNDS = (1.4, 5.0)
WIDTH = 0.1
"""Of the ratio of a gear that is wanted besides: so wide that some point of a grid has it. [-]"""
Named = tuple[frozenset[tuple[int, int]], float]
"""The engaged elements of a gear, its ratio."""


def is_wanted(ratios: Sequence[float], wanted: WantedSequence, slack: float) -> bool:
    """Whether descending ratios are such a sequence, but for rounding."""
    if not wanted.least <= len(ratios) <= wanted.most:
        return False
    steps = [one / other for one, other in pairwise(ratios)]
    ranges = [(ratios[0] / ratios[-1], wanted.spread), *((step, wanted.steps) for step in steps)]
    inside = all(low / slack <= value <= high * slack for value, (low, high) in ranges)
    falls = all(below * slack >= above for below, above in pairwise(steps))
    return inside and (falls or not wanted.falling)


def choices(gears: Sequence[Named], wanted: WantedSequence, target: float | None) -> Iterator[int]:
    """So many forward gears has each choice in which every element is in a gear."""
    every = frozenset().union(*(one for one, _ in gears))
    besides: list[Named | None] = [None]
    if target is not None:
        besides = [one for one in gears if one[1] < 0 and abs(math.log(one[1] / target)) < WIDTH]
    forward = sorted((one for one in gears if one[1] > 0), key=lambda one: -one[1])
    for size in range(wanted.least, wanted.most + 1):
        for some in combinations(forward, size):
            if is_wanted([one for _, one in some], wanted, 1.0):
                for other in besides:
                    told = [*some, *([] if other is None else [other])]
                    if frozenset().union(*(one for one, _ in told)) == every:
                        yield size


def on_grid(
    frame: Frame, elements: Pairs, engaged: int, wanted: WantedSequence, target: float | None
) -> int:
    """The most gears that the elements have anywhere on a grid; 0 if they never do."""
    some = list(combinations(elements, engaged))
    best = 0
    places = np.geomspace(*BOUNDS, 12 if len(frame.meshed) > 1 else 60)
    for sizes in product(places[1:-1], repeat=len(frame.meshed)):
        signed = [p if one else -p for p, one in zip(sizes, frame.meshed, strict=True)]
        values = [(frozenset(one), ratio(frame, one, signed)) for one in some]
        gears = [one for one in values if not math.isnan(one[1])]
        if frozenset().union(*(one for one, _ in gears)) == frozenset(elements):
            best = max([best, *choices(gears, wanted, target)])
    return best


def has_backward(frame: Frame, elements: Pairs, engaged: int) -> bool:
    """Whether elements have a gear backward and two forward at some ratios: few have."""
    signed = [2.6 if one else -2.6 for one in frame.meshed]
    ratios = {round(ratio(frame, one, signed), 6) for one in combinations(elements, engaged)}
    return any(one < 0 for one in ratios) and sum(one > 0 for one in ratios) >= 2


SPACES = [
    Space(1, 3, 2, (), BOUNDS, own_input=True),
    Space(2, 4, 2, (-2.2,), BOUNDS, own_input=True, tolerance=WIDTH),
    Space(2, 4, 2, (), BOUNDS, meshed=1, own_input=True),
]


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("falling", [False, True])
def test_sequences_on_a_grid_are_found(space: Space, falling: bool) -> None:
    target = next(iter(space.targets), None)
    random = np.random.default_rng(32)
    wanted = WantedSequence(2, 4, (1.5, 6.0), (1.2, 2.5), falling)
    search = asked(space)._replace(sequence=wanted)
    frames, some_found, grid_has = all_frames(space), 0, 0
    for _ in range(6):
        frame = frames[random.integers(len(frames))]
        boxes = ports_of(search, frame).boxes(frame.input, frame.output)
        found = {frozenset(one.elements): one for one in boxes}
        some_found += len(found) > 0
        every = [*combinations(frame.possible, space.elements)]
        if target is not None:
            every = [one for one in every if has_backward(frame, one, space.engaged)]
        for at in random.permutation(len(every))[:15]:
            most = on_grid(frame, every[at], space.engaged, wanted, target)
            box = found.get(frozenset(every[at]))
            count = 0 if box is None else len(box.gears) - len(search.targets)
            assert count >= most
            grid_has += most > 0
        for box in list(found.values())[:40]:
            gears = [[box.elements[one] for one in gear] for gear in box.gears]
            values = [ratio(frame, one, box.ratios) for one in gears]
            besides = len(search.targets)
            assert is_wanted(values[besides:], wanted, 1 + 1e-9)
            assert all(
                abs(math.log(one / t)) < WIDTH + 1e-8
                for one, t in zip(values, search.targets, strict=False)
            )
            assert {one for gear in gears for one in gear} == {*box.elements}
    assert some_found
    assert grid_has
