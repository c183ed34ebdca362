"""The bars at a place along the axis, and what stands there.

A bar is eight times its link, and the number of the part of the link that it belongs to: parts that
are not joined yet must be, further right.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

Bars = tuple[int, ...]
SET, PAIR, TOP, WALL = 3, 2, 1, 1
"""Lengths along the axis, for the cost of bars."""
FOLD, TURN, CROSSING, EXCHANGE = 8, 2, 400, 10
"""What cost a wall of a link, a further bar of it, a crossing, two sets in another order."""


class SectionState(NamedTuple):
    """The bars at one place along the axis, and what is drawn to the left of it."""

    below: Bars
    above: Bars
    done: int


class SweepStep(NamedTuple):
    """Something that stands at a place along the axis."""

    kind: str
    """``top``, ``pair``, ``wall`` or ``set``."""
    number: int
    """Of the top, the pair or the set; the link of a wall."""
    bars: Sequence[tuple[Bars, Bars]]
    """Bars there; of a set at its left arm, at its planes, at its right arm."""
    place: int = -1
    """Of two neighbours that are joined the lower one's, from the axis; -1 for the nearest."""
    is_turned: bool = False
    """A set whose planes are drawn from right to left."""
    left: tuple[bool, bool] = (False, False)
    """Whether the arm of a carrier is joined to the last bar below, to the first above."""
    right: tuple[bool, bool] = (False, False)
    before: tuple[Bars, Bars] | None = None
    """Bars to the left of it, where it begins some."""


class Move(NamedTuple):
    """A step, what comes behind it, and its cost but for the bars."""

    state: SectionState
    length: int
    cost: int
    step: SweepStep


def links_of(bars: Bars) -> set[int]:
    """The links that have bars."""
    return {bar >> 3 for bar in bars}


def in_two_parts(bars: Bars) -> set[int]:
    """Return the links with bars of two parts.

    >>> in_two_parts((8, 16, 9, 8))
    {1}
    """
    return {one >> 3 for one, other in pairwise(sorted({*bars})) if one >> 3 == other >> 3}


def fresh(link: int, bars: Bars) -> int | None:
    """A new part of a link; None if it has two already."""
    own = {bar for bar in bars if bar >> 3 == link}
    if len(own) > 1:
        return None
    return 8 * link + (8 * link in own)
