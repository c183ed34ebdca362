"""Boxes with wanted numbers and steps of gears, against all choices of gears on a grid of ratios.

What the grid has must be found, with as many gears, single shifts where it has them, and no larger
sum of squares (a fit does not see on which side of a wanted forward ratio a gear shifts singly);
what is found must be so by the null space of the equations (`tests.oracle.test_boxes.ratio`), with
each element in a gear.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise, product
from typing import NamedTuple

import numpy as np
import pytest

from tests.chance import count, seeded
from tests.oracle.boxes import HELD, Frame, Space, all_frames
from tests.oracle.test_boxes import Pairs, ratio
from tests.synthesis.boxes.batches.test_cut import asked
from tests.synthesis.oracle.test_found_boxes import ports_of
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox, WantedSequence
from vstatics.synthesis.boxes.figures.measured import measured

pytestmark = pytest.mark.slow  # they compile
BOUNDS = (1.4, 5.0)
ANY = (1.0, 1e6)
WIDTH = 0.05
ROUNDED = 1 + 1e-8


class Choice(NamedTuple):
    """What is told of a choice of gears: the greatest is the best."""

    gears: int
    single: bool
    nearness: float
    """Minus the sum of squares."""


class Told(NamedTuple):
    """A gear of a box."""

    engaged: frozenset[tuple[int, int]]
    ratio: float


def is_wanted(ratios: Sequence[float], wanted: WantedSequence, slack: float) -> bool:
    """Whether descending ratios are such a sequence, but for rounding."""
    if not wanted.least <= len(ratios) <= wanted.most:
        return False
    steps = [one / other for one, other in pairwise(ratios)]
    ranges = [(ratios[0] / ratios[-1], wanted.spread), *((step, wanted.steps) for step in steps)]
    inside = all(low / slack <= value <= high * slack for value, (low, high) in ranges)
    falls = all(below * slack >= above for below, above in pairwise(steps))
    return min(steps) > 1 and inside and (falls or not wanted.falling)


def squares(ratios: Sequence[float], wanted: WantedSequence) -> float:
    """Of ln(what is/geometric mean)/half-width of the spread and each step that has a range."""

    def error(value: float, low: float, high: float) -> float:
        half = max(math.log(high / low) / 2, 1e-5)
        return 0.0 if (low, high) == ANY else math.log(value / math.sqrt(low * high)) / half

    steps = (error(one / other, *wanted.steps) for one, other in pairwise(ratios))
    return error(ratios[0] / ratios[-1], *wanted.spread) ** 2 + sum(one**2 for one in steps)


def shifts_singly(gears: Sequence[Told]) -> bool:
    """Whether one element goes and one comes between neighbours, forward and backward."""
    for sign in (1, -1):
        own = sorted(
            (one for one in gears if one.ratio * sign > 0), key=lambda one: -abs(one.ratio)
        )
        if any(len(one.engaged ^ other.engaged) > 2 for one, other in pairwise(own)):
            return False
    return True


def choices(
    gears: Sequence[Told], wanted: WantedSequence, targets: Sequence[float]
) -> Iterator[Choice]:
    """Each choice in which every element is in a gear."""
    every = frozenset().union(*(one.engaged for one in gears))
    ways = [
        [
            one
            for one in gears
            if one.ratio * target > 0 and abs(math.log(one.ratio / target)) < WIDTH
        ]
        for target in targets
    ]
    forward = sorted((one for one in gears if one.ratio > 0), key=lambda one: -one.ratio)
    for size in range(wanted.least, wanted.most + 1):
        for some in combinations(forward, size):
            ratios = [one.ratio for one in some]
            if not is_wanted(ratios, wanted, 1.0):
                continue
            for others in product(*ways):
                told = [*some, *others]
                values = [one.ratio for one in told]  # each gear has a ratio of its own
                if len({round(one, 9) for one in values}) < len(values):
                    continue
                if frozenset().union(*(one.engaged for one in told)) == every:
                    off = (
                        math.log(o.ratio / t) / WIDTH for o, t in zip(others, targets, strict=True)
                    )
                    total = squares(ratios, wanted) + sum(one**2 for one in off)
                    in_place = [o._replace(ratio=t) for o, t in zip(others, targets, strict=True)]
                    yield Choice(size, shifts_singly([*some, *in_place]), -total)


def on_grid(
    frame: Frame, elements: Pairs, search: BoxSearch, wanted: WantedSequence, singly: bool
) -> Choice | None:
    """The best that the elements have anywhere on a grid; none if they never have any."""
    some = list(combinations(elements, search.engaged))
    best = None
    places = np.geomspace(*BOUNDS, {1: 60, 2: 12, 3: 6}[search.sets])
    for sizes in product(places[1:-1], repeat=search.sets):
        signed = [p if one else -p for p, one in zip(sizes, frame.meshed, strict=True)]
        values = [Told(frozenset(one), ratio(frame, one, signed)) for one in some]
        gears = [one for one in values if not math.isnan(one.ratio)]
        if frozenset().union(*(one.engaged for one in gears)) == frozenset(elements):
            for choice in choices(gears, wanted, search.targets):
                if (choice.single or not singly) and (best is None or choice > best):
                    best = choice
    return best


def told_of(search: BoxSearch, box: FoundBox) -> Choice:
    """What a found box is, its gears as they are told."""
    found = measured(search, box, 0.98)
    named = found.elements
    gears = [
        Told(frozenset(map(named.__getitem__, gear.engaged)), gear.target)  # type: ignore[arg-type]
        for gear in found.gears
    ]
    ratios = [gear.ratio for gear in found.gears if gear.target not in search.targets]
    assert is_wanted(ratios, search.sequence, ROUNDED)  # type: ignore[arg-type]
    assert found.figures.single == shifts_singly(gears)
    off = [
        math.log(gear.ratio / gear.target) / WIDTH
        for gear in found.gears
        if gear.target in search.targets
    ]
    assert len(off) == len(search.targets)
    assert max(map(abs, off), default=0) < ROUNDED
    total = squares(ratios, search.sequence) + sum(one**2 for one in off)  # type: ignore[arg-type]
    return Choice(len(ratios), found.figures.single, -total)


ASKED = {
    "plain": WantedSequence(2, 4, (1.5, 6.0), (1.2, 2.5)),
    "falling": WantedSequence(3, 4, (1.5, 6.0), (1.2, 2.5), falling=True),
    "as many": WantedSequence(3, 3, (2.0, 4.0), (1.3, 2.0)),
    "two": WantedSequence(2, 2, (1.5, 2.0), (1.5, 2.0)),
    "no steps": WantedSequence(3, 4, (3.0, 5.0), ANY),
    "no spread": WantedSequence(3, 4, ANY, (1.3, 1.7)),
    "steps from 1": WantedSequence(3, 4, (1.8, 5.0), (1.0, 1.6), falling=True),
}
SPACES = {
    "one set": Space(1, 3, 2, (), own_input=True),
    "one set, both": Space(1, 5, 3, (), own_input=True, own_output=True),
    "shaft of one set": Space(1, 4, 2, (), shafts=1),
    "one engaged": Space(2, 4, 1, ()),
    "reverse": Space(2, 4, 2, (-2.2,), own_input=True, tolerance=WIDTH),
    "forward": Space(2, 4, 2, (1.0,), meshed=1, own_input=True, tolerance=WIDTH),
    "meshed": Space(2, 4, 2, (), meshed=1, own_input=True),
    "held": Space(2, 4, 2, (), fixed=1),
    "own output": Space(2, 4, 2, (), own_output=True),
    "shaft": Space(2, 5, 3, (), shafts=1),
}


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("singly", [False, True])
def test_sequences_on_a_grid_are_found(space: str, singly: bool) -> None:
    chance = seeded(32 + len(space))
    own = SPACES[space]
    frames = all_frames(own)
    on_grid_found = 0
    for name in chance.sample(list(ASKED), count(3, 7)):
        wanted = ASKED[name]
        search = asked(own)._replace(sequence=wanted, singly=singly)
        for frame in chance.sample(frames, min(len(frames), 3)):
            ports = ports_of(search, frame)
            found = {frozenset(one.elements): one for one in ports.boxes(frame.input, frame.output)}
            assert not ports.given_up
            told = {
                key: told_of(search, found[key])
                for key in chance.sample([*found], min(len(found), 8))
            }
            assert all(one.single for one in told.values()) or not singly
            every = [frozenset(one) for one in combinations(frame.possible, own.elements)]
            for elements in [*chance.sample(every, min(len(every), 8)), *told]:
                best = on_grid(frame, sorted(elements), search, wanted, singly)
                if best is not None and not own.shafts:
                    on_grid_found += 1
                    assert elements in found, (name, frame, sorted(elements), best)
                    if elements in told:
                        assert told[elements][:2] >= best[:2]
                        in_between = best.single and max(own.targets, default=0) > 0
                        if told[elements][:2] == best[:2] and not in_between:
                            assert told[elements].nearness >= best.nearness - 1e-6
    assert on_grid_found or own.shafts or own.engaged == 1 or singly


def test_three_sets_with_a_gear_that_passes_through_infinity() -> None:
    """Two of the ratios of the first box have a pole within the bounds."""
    wanted = WantedSequence(5, 7, (5.0, 8.0), (1.2, 1.8))
    search = BoxSearch(3, 5, 2, (), BOUNDS, sequence=wanted)
    frame = Frame((0, 1, 2, 0, 3, 4, 2, 3, 5), (False,) * 3, HELD, 3, 0)
    ports = ports_of(search, frame)
    found = {frozenset(one.elements): one for one in ports.boxes(frame.input, frame.output)}
    assert not ports.given_up
    chance = seeded(3)
    pole = frozenset({(1, HELD), (2, HELD), (0, 5), (1, 4), (4, 5)})
    for elements in [pole, *chance.sample(sorted(found, key=sorted), count(5, 30))]:
        told = told_of(search, found[elements])
        best = on_grid(frame, sorted(elements), search, wanted, singly=False)
        assert best is None or told[:2] >= best[:2]
    others = [frozenset(one) for one in combinations(frame.possible, 5)]
    for elements in chance.sample(others, count(8, 60)):
        best = on_grid(frame, sorted(elements), search, wanted, singly=False)
        assert best is None or elements in found
