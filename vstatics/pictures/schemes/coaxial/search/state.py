"""Bars at a place along the axis, and the component there.

A bar has the number eight times its link plus the part of the link. Separate parts of a link must
be connected further to the right.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Bars = tuple[int, ...]
"""Numbers of the bars from the axis outward: eight times the link plus the number of its part."""
SET, PAIR, TOP, WALL = 3, 2, 1, 1
"""Lengths of components along the axis, for the cost of bars."""
FOLD, TURN, CROSSING, EXCHANGE = 8, 2, 400, 10
"""Costs of a wall, of an additional bar of a link, of a crossing, and of two exchanged sets."""


class SectionState(NamedTuple):
    """Bars at a place along the axis, and the components to the left of it, as bits."""

    below: Bars
    above: Bars
    done: int


class SweepStep(NamedTuple):
    """Component at a place along the axis."""

    kind: str
    """Kind of component: ``top``, ``pair``, ``wall`` or ``set``."""
    number: int
    """Number of the top, pair or set; for a wall, of its link."""
    bars: Sequence[tuple[Bars, Bars]]
    """Bars at the component; for a set, at the left arm, at each plane and at the right arm."""
    place: int = -1
    """Index, from the axis, of the lower of the two adjacent bars that the component connects.

    -1 means that it connects the nearest bars of its links.
    """
    is_turned: bool = False
    """True for a gear set whose planes are drawn in reverse order."""
    left: tuple[bool, bool] = (False, False)
    """True where the left arm of a carrier meets the last bar below, and the first bar above."""
    right: tuple[bool, bool] = (False, False)
    """True where the right arm of a carrier meets the last bar below, and the first bar above."""
    before: tuple[Bars, Bars] | None = None
    """Bars to the left of the component, if it begins new bars."""


class Move(NamedTuple):
    """Step of the search with the state after it, and the cost of the step without bars."""

    state: SectionState
    length: int
    cost: int
    step: SweepStep


def links_of(bars: Bars) -> set[int]:
    """Return the links that have one or more of the bars."""
    return {bar >> 3 for bar in bars}


def fresh(link: int, bars: Bars) -> int | None:
    """Return a new part of a link, or `None` for a link with two parts."""
    parts = {bar for bar in bars if bar >> 3 == link}
    if len(parts) > 1:
        return None
    return 8 * link + (8 * link in parts)
