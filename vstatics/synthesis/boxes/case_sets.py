"""Conversion of planet groups on a common carrier to planetary gear sets, for the search."""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.core.explain.bodies import OwnLinks
from vstatics.core.model.parts import Mechanism

GROUP = "planet_group"
"""Kind of a gear set of a case that consists of planets with any central gears."""


def case_mechanisms(lowered: OwnLinks) -> list[Mechanism]:
    """Return the mechanisms of a case, with planet groups split into pairs of central gears.

    In a group with three central gears, two pairs determine the speeds, and any of the gears can be
    in both pairs. The gear whose ratios to the others are farthest from 1 is chosen. Two ring gears
    and a sun gear therefore give two pairs with the sun.

    Examples
    --------
    >>> from vstatics import example
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> lowered = on_own_links(example("mercedes-7g"))
    >>> [round(mechanism.ratio, 3) for mechanism in lowered.case.mechanisms[:2]]
    [-2.048, -0.782]
    >>> [round(mechanism.ratio, 3) for mechanism in case_mechanisms(lowered)[:2]]
    [-2.048, 2.619]
    """
    mechanisms: list[Mechanism] = []
    at = 0
    for part in lowered.parts:
        pairs = lowered.case.mechanisms[at : at + len(part.lowered)]
        at += len(pairs)
        is_group = part.element is not None and part.element.kind == GROUP
        mechanisms += _by_best_wheel(pairs) if is_group and len(pairs) > 1 else pairs
    return mechanisms


def _by_best_wheel(pairs: Sequence[Mechanism]) -> Sequence[Mechanism]:
    """Pair the best central gear of a group with each other gear, if on a single carrier."""
    speeds = {pairs[0].first: 1.0}  # relative to the carrier
    for _ in pairs:
        for pair in pairs:
            if pair.first in speeds:
                speeds[pair.second] = speeds[pair.first] / pair.ratio
            elif pair.second in speeds:
                speeds[pair.first] = speeds[pair.second] * pair.ratio
    if len(speeds) != len(pairs) + 1 or len({pair.third for pair in pairs}) > 1:
        return pairs

    def distance(wheel: int) -> float:
        ratios = (speeds[wheel] / other for link, other in speeds.items() if link != wheel)
        return min(abs(math.log(abs(ratio))) for ratio in ratios)

    best = max(speeds, key=distance)
    others = [link for link in speeds if link != best]
    return [
        pair._replace(first=best, second=link, ratio=speeds[best] / speeds[link])
        for pair, link in zip(pairs, others, strict=True)
    ]
