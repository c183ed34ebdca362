"""State of a search: bars (lines of links) at a position along the axis, and drawn components.

A bar is identified by eight times the number of its link plus the number of its part. Parts of a
link with different numbers must still be connected further to the right.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Bars = tuple[int, ...]
"""Bars (lines of links) from the axis outwards, each as 8 times its link plus the number of its
part.
"""
SET, PAIR, TOP, WALL = 3, 2, 1, 1
"""Lengths of components along the axis, which multiply the cost of bars. [-]"""
FOLD, TURN, CROSSING, EXCHANGE = 8, 2, 400, 10
"""Costs of a wall, an additional bar of a link, a crossing, and two exchanged gear sets. [-]"""


class SectionState(NamedTuple):
    """Bars at a position along the axis, and the bits of the components to the left of it."""

    below: Bars
    above: Bars
    done: int


class OrderStep(NamedTuple):
    """Step of the search: a component at a position along the axis."""

    kind: str
    """Kind of component: ``top`` (at the housing), ``pair`` (between two links), ``wall`` (vertical
    line of a link) or ``set`` (gear set).
    """
    number: int
    """Index of the top, pair or set in the train; for a wall, the number of the link."""
    bars: Sequence[tuple[Bars, Bars]]
    """Bars below and above at the component; for a set, at left arm, each plane, and right arm."""
    place: int = -1
    """Index, from the axis, of the lower of the two adjacent bars that the component connects.

    -1 if the component connects the nearest bars of its links.
    """
    is_turned: bool = False
    """True for a gear set whose planes are drawn in reverse order."""
    left: tuple[bool, bool] = (False, False)
    """Flags: the left arm of the carrier meets the last bar below, and the first bar above."""
    right: tuple[bool, bool] = (False, False)
    """Flags: the right arm of the carrier meets the last bar below, and the first bar above."""
    before: tuple[Bars, Bars] | None = None
    """Bars to the left of the component, if the component begins new bars."""


class Move(NamedTuple):
    """Step of the search, with the next state, and the cost without the length of bars."""

    state: SectionState
    length: int
    cost: int
    step: OrderStep


def links_of(bars: Bars) -> set[int]:
    """Return the numbers of the links to which the bars belong."""
    return {bar >> 3 for bar in bars}


def fresh(link: int, bars: Bars) -> int | None:
    """Return the number of a new bar of a link, unless the link already has two parts."""
    parts = {bar for bar in bars if bar >> 3 == link}
    if len(parts) > 1:
        return None
    return 8 * link + (8 * link in parts)
