"""Groups of planets on one carrier as the sets that a search for boxes knows them by."""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.core.explain.bodies import OwnLinks
from vstatics.core.model.parts import Mechanism

GROUP = "planet_group"
"""The kind of an element whose wheels may be told in pairs of one's own choice."""


def case_mechanisms(own: OwnLinks) -> list[Mechanism]:
    """The mechanisms of a case, those of a group of planets by the wheel that suits best.

    Of a group with three wheels two pairs tell the speeds, and any wheel may be in both. It is that
    with which the ratios are farthest from 1: two rings beside a sun are a pair each with the sun,
    and not one of the rings.

    Examples
    --------
    >>> from vstatics import example
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> own = on_own_links(example("mercedes-7g"))
    >>> [round(one.ratio, 3) for one in own.case.mechanisms[:2]]
    [-2.048, -0.782]
    >>> [round(one.ratio, 3) for one in case_mechanisms(own)[:2]]
    [-2.048, 2.619]
    """
    found: list[Mechanism] = []
    at = 0
    for part in own.parts:
        pairs = own.case.mechanisms[at : at + len(part.lowered)]
        at += len(pairs)
        is_group = part.element is not None and part.element.kind == GROUP
        found += _by_best_wheel(pairs) if is_group and len(pairs) > 1 else pairs
    return found


def _by_best_wheel(pairs: Sequence[Mechanism]) -> Sequence[Mechanism]:
    """All wheels in pairs with one of them; as they are if they are on several carriers."""
    speeds = {pairs[0].first: 1.0}  # against the carrier
    for _ in pairs:
        for one in pairs:
            if one.first in speeds:
                speeds[one.second] = speeds[one.first] / one.ratio
            elif one.second in speeds:
                speeds[one.first] = speeds[one.second] * one.ratio
    if len(speeds) != len(pairs) + 1 or len({one.third for one in pairs}) > 1:
        return pairs

    def distance(wheel: int) -> float:
        ratios = (speeds[wheel] / other for link, other in speeds.items() if link != wheel)
        return min(abs(math.log(abs(ratio))) for ratio in ratios)

    best = max(speeds, key=distance)
    others = [link for link in speeds if link != best]
    return [
        one._replace(first=best, second=link, ratio=speeds[best] / speeds[link])
        for one, link in zip(pairs, others, strict=True)
    ]
