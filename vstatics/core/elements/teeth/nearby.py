"""Search for tooth numbers near the present tooth numbers of a gear set.

The teeth of a central gear cannot change alone, because the gear would no longer be coaxial with
the others. The search therefore combines moves of two kinds. A planet rim changes together with the
gears in mesh: with one tooth more on the planet, the sun loses one and the ring gains one. Or the
axis of a planet is shifted, so that all gears around the planet change. Modules do not change.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.element import CentralWheel
from vstatics.core.elements.group import PlanetGroup
from vstatics.core.elements.teeth.conditions import SHIFT
from vstatics.core.elements.teeth.layout import Key, Teeth, ratio_pairs
from vstatics.core.numerics.arrays import Floats, Integers

TEETH_PER_RATIO = 100
"""Weight of a relative change of ratio. A change of 1 % counts as much as one tooth."""

FARTHEST_RATIO = 0.3
"""Largest change of a ratio in the search, as the natural logarithm of the quotient of ratios."""

REACH = {1: 14, 2: 14, 3: 6, 4: 4, 5: 3, 6: 3}
"""Largest sum of the magnitudes of steps, by the number of independent moves.

The limits result in at most about 400 candidates, which take a few milliseconds.
"""

WIDER = 2
"""Factor by which `REACH` is enlarged in a wide search."""

FAR_MOVES = 14
"""Largest number of moves that are combined.

With more moves only single steps are tried, because there would be too many candidates.
"""

FEW_WHEELS = 5
"""Largest number of gears for which a suggestion lists all teeth.

With more gears it lists only changed teeth.
"""


class Space(NamedTuple):
    """Space of the search for teeth.

    Attributes
    ----------
    given : mapping of key to teeth
        Present teeth, from which changes are counted.
    start : mapping of key to teeth
        Similar teeth for which all gears are coaxial.
    moves : sequence of mappings of key to a change of teeth
        Changes that keep all gears coaxial.
    ratios : sequence of mappings of key to exponent
        Each ratio as a product of powers of tooth numbers, without the sign.
    """

    given: Teeth
    start: Teeth
    moves: Sequence[Teeth]
    ratios: Sequence[Teeth]


def nearest(space: Space, *, wide: bool = False) -> Iterator[Teeth]:
    """Return an iterator over tooth numbers near `space.given`, smallest changes first.

    The size of a change is the number of teeth changed, plus the change of each ratio in %.

    Parameters
    ----------
    wide : bool
        True to search further than for a suggestion.

    >>> pair = {"first": 20, "second": 40}
    >>> space = Space(pair, pair, [{"first": 1}, {"second": 1}], [{"first": -1, "second": 1}])
    >>> around = nearest(space)
    >>> next(around), next(around)
    ({'first': 20, 'second': 40}, {'first': 19, 'second': 38})
    """
    keys = [*space.start]
    moves = np.array([[move.get(key, 0) for key in keys] for move in space.moves], dtype=int)
    steps = _steps(len(space.moves), WIDER if wide else 1)
    teeth = np.array([*space.start.values()]) + steps @ moves.reshape(-1, len(keys))
    teeth = teeth[(teeth > 0).all(axis=1)]
    distances = _distances(space, dict(zip(keys, teeth.T, strict=True)), np.zeros(len(teeth)))
    nearest_first = np.argsort(distances, kind="stable")[: int(np.isfinite(distances).sum())]
    return (dict(zip(keys, counts, strict=True)) for counts in teeth[nearest_first].tolist())


def _distances(space: Space, teeth: Mapping[Key, Integers], total: Floats) -> Floats:
    """Return `total` plus the sizes of changes to `teeth`; infinite if a ratio changes too much."""
    apart = {}
    for key, count in space.given.items():
        total += np.abs(teeth[key] - count)
        distinct, places = np.unique(teeth[key], return_inverse=True)
        # NumPy's logarithms depend on the processor, and so would the order of equal changes.
        apart[key] = np.array([*map(math.log, distinct.tolist())])[places] - math.log(count)
    for powers in space.ratios:
        change = np.abs(sum(power * apart[key] for key, power in powers.items() if key in apart))
        total += np.where(change <= FARTHEST_RATIO, TEETH_PER_RATIO * change, np.inf)
    return total


@lru_cache
def _steps(moves: int, times: int) -> Integers:
    """Return all combinations of steps whose magnitudes sum to `REACH` at most.

    The shape is (combinations, moves).
    """
    reach = times * REACH.get(moves, 2 if moves <= FAR_MOVES else 1)
    partial: list[tuple[tuple[int, ...], int]] = [((), reach)]
    for _ in range(moves):
        partial = [
            ((*steps, step), left - abs(step))
            for steps, left in partial
            for step in range(-left, left + 1)
        ]
    return np.array([steps for steps, _ in partial], dtype=int)


def space_of(group: PlanetGroup, given_rims: Sequence[str]) -> Space:
    """Return the search space of a group of planets.

    >>> from fractions import Fraction
    >>> wheels = [CentralWheel("sun", 1, 48, False, "p"), CentralWheel("ring", 2, 97, True, "p")]
    >>> space = space_of(PlanetGroup(3, wheels, {"p": {"p": Fraction(49, 2)}}), [])
    >>> space.start
    {'p': 24, 0: 48, 1: 96}
    >>> space.moves
    [{0: 1, 1: 1}, {'p': 1, 0: -1, 1: 1}]
    """
    start: dict[Key, int] = {}
    moves: list[Teeth] = []
    for rims in group.planets.values():
        spans: dict[str, int] = {}
        for rim, teeth in rims.items():
            around = _around(group, rim)
            if teeth is None:
                for place, wheel in around:
                    start[place] = wheel.teeth
                    moves.append({place: 1})
                continue
            start[rim] = count = math.floor(teeth)
            if around:
                first = around[0][1]
                spans[rim] = first.teeth + (-count if first.internal else count)
            for place, wheel in around:
                start[place] = spans[rim] + (count if wheel.internal else -count)
        steps = _axis_steps(spans)
        axis: dict[Key, int] = {
            place: step for rim, step in steps.items() for place, _ in _around(group, rim)
        }
        moves += [axis] if axis else []
        for rim in (rim for rim, teeth in rims.items() if teeth is not None):
            turned: dict[Key, int] = {rim: 1}
            for place, wheel in _around(group, rim):
                turned[place] = 1 if wheel.internal else -1
            moves.append(turned)
    given: dict[Key, int] = {place: wheel.teeth for place, wheel in enumerate(group.wheels)}
    given |= {rim: int(group.teeth(rim)) for rim in given_rims if rim in group.planet_of}
    ratios = [ratio_powers(group, wheel, last) for wheel, last in ratio_pairs(group)]
    return Space(given, start, moves, ratios)


def _axis_steps(spans: Mapping[str, int]) -> dict[str, int]:
    """Return the number of teeth that the central gears of each rim gain if the axis moves out.

    The numbers for rims of different modules are inversely proportional to the modules.
    """
    if not spans or max(spans.values()) - min(spans.values()) <= SHIFT:
        return dict.fromkeys(spans, 1)
    unit = math.gcd(*spans.values())
    return {
        rim: span // unit for rim, span in spans.items() if max(spans.values()) <= FEW_WHEELS * unit
    }


def _around(group: PlanetGroup, rim: str) -> list[tuple[int, CentralWheel]]:
    return [(place, wheel) for place, wheel in enumerate(group.wheels) if wheel.rim == rim]


def ratio_powers(group: PlanetGroup, first: CentralWheel, last: CentralWheel) -> dict[Key, int]:
    """Return the exponents of tooth numbers in the ratio of two central gears, without the sign."""
    wheels = list(group.wheels)
    powers = Counter[Key]({wheels.index(first): -1, wheels.index(last): 1})
    rims = _rims_between(group, first.rim, last.rim)
    for driver, driven in zip(rims[::2], rims[1::2], strict=True):
        powers[driver] += 1
        powers[driven] -= 1
    return {key: power for key, power in powers.items() if power}


def _rims_between(group: PlanetGroup, first: str, last: str) -> list[str]:
    """Return the rims by which each planet receives and transmits power between two rims."""
    here, rims = group.planet_of[first], [first]
    for pair in group.path(here, group.planet_of[last]):
        near, far = pair if group.planet_of[pair[0]] == here else pair[::-1]
        rims += [near, far]
        here = group.planet_of[far]
    return [*rims, last]
