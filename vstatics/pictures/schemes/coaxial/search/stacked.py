"""Arrangement of any train with crossings: each link is one horizontal line.

The search falls back to this arrangement if no better arrangement is found soon. In each step, the
remaining component with the fewest crossings and the fewest new lines is added.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.search.set_moves import without_ended
from vstatics.pictures.schemes.coaxial.search.state import OrderStep, SectionState, links_of
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain

STACKED_CROSSING = 10
"""Cost of a crossing, relative to the cost of a new line. [-]"""


class _Stacked(NamedTuple):
    """Component that can be added next, with the cost."""

    cost: int
    steps: tuple[OrderStep, ...]
    state: SectionState


def stacked(train: CoaxialTrain) -> list[OrderStep]:
    """Return the components of a train from left to right, as steps of a search.

    Examples
    --------
    >>> from vstatics.pictures.schemes.coaxial.train import Planes
    >>> train = CoaxialTrain([Planes(3, [(1, 2)])], [(1, 3)], [2], 1, 3)
    >>> [step.kind for step in stacked(train)]
    ['pair', 'top', 'set']
    """
    state, steps = SectionState((8 * train.start,), (), 0), list[OrderStep]()
    while state.done != train.all_bits:
        ways = _ways(train, state)
        best = min(ways, key=lambda way: way.cost + len(way.state.below + way.state.above))
        steps += best.steps
        state = best.state
    return steps


def _ways(train: CoaxialTrain, state: SectionState) -> Iterator[_Stacked]:
    kinds = (
        (train.carrier_bits, _set),
        (train.pair_bits, _pair),
        (train.top_bits, _top),
    )
    for bits, way in kinds:
        for number, bit in enumerate(bits):
            if not state.done & bit:
                yield way(train, number, state)


def _top(train: CoaxialTrain, number: int, state: SectionState) -> _Stacked:
    below, above, done = state
    bar, bars = 8 * train.tops[number], below + above
    crossed = bars[::-1].index(bar) if bar in bars else 0
    above = above if bar in bars else (*above, bar)
    step = OrderStep("top", number, [(below, above)])
    after = without_ended(train, SectionState(below, above, done | train.top_bits[number]))
    return _Stacked(STACKED_CROSSING * crossed, (step,), after)


def _pair(train: CoaxialTrain, number: int, state: SectionState) -> _Stacked:
    below, above, done = state
    first_bar, second_bar = (8 * link for link in train.pairs[number])
    bars = below + above
    if first_bar not in bars and second_bar in bars:
        first_bar, second_bar = second_bar, first_bar
    if first_bar not in bars:
        above = (first_bar, *above)
    crossed = 0
    if second_bar in bars:
        places = [
            [n for n, bar in enumerate(bars) if bar == bar_] for bar_ in (first_bar, second_bar)
        ]
        crossed = min(abs(a - b) for a in places[0] for b in places[1]) - 1
    elif first_bar in below:
        place = below.index(first_bar) + 1
        below = (*below[:place], second_bar, *below[place:])
    else:
        place = above.index(first_bar)
        above = (*above[:place], second_bar, *above[place:])
    step = OrderStep("pair", number, [(below, above)])
    after = without_ended(train, SectionState(below, above, done | train.pair_bits[number]))
    return _Stacked(STACKED_CROSSING * crossed, (step,), after)


def _set(train: CoaxialTrain, number: int, state: SectionState) -> _Stacked:
    """Return the step of a gear set whose gears and carrier may cross lines."""
    below, above, done = state
    carrier, wheels = train.sets[number]
    crossed, walls = 0, list[OrderStep]()
    for sun, ring in wheels:
        for link, is_sun in ((sun, True), (ring, False)):
            bar, row, others = 8 * link, *((below, above[::-1]) if is_sun else (above[::-1], below))
            if not link or bar in row:
                crossed += row[::-1].index(bar) if link else 0
                continue
            row = (*row, bar)
            below, above = (row, above) if is_sun else (below, row[::-1])
            if bar in others:  # the line is on the other side of the row of planets
                crossed += others[::-1].index(bar)
                walls.append(OrderStep("wall", link, [(below, above)]))
    bits = sum(bit for both in train.wheel_bits[number] for bit in both)
    done |= train.carrier_bits[number] | bits
    bar, low, high = 8 * carrier, below, above
    is_there = carrier in links_of(below + above)
    is_low = bar in below
    if is_there:
        crossed += below[::-1].index(bar) if is_low else above.index(bar)
    elif train.masks[carrier] & ~done:
        low = (*below, bar)
    here = below, above
    step = OrderStep(
        "set",
        number,
        [here, *(here for _ in wheels), (low, high)],
        left=(is_there and is_low, is_there and not is_low),
        right=(low != below, False),
    )
    after = without_ended(train, SectionState(low, high, done))
    return _Stacked(STACKED_CROSSING * crossed, (*walls, step), after)
