"""What is wanted of a sequence of gears, in logarithms, and room to look for one."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.box import LARGEST_RATIO, WantedSequence
from vstatics.synthesis.boxes.search.chains import ChainRoom, chain_room
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.joining import NO_END
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room
from vstatics.synthesis.boxes.search.set_ratios import Asked, FitRoom, fit_room
from vstatics.synthesis.tolerances import SAME_FITTED_RATIO, TARGET_MARGIN

NARROW = 1.01
"""A cell is not halved along a ratio whose bounds are so near. [-]"""


class Sequence(NamedTuple):
    """Which forward gears a box is to have; logarithms of quotients of ratios."""

    least: int
    """So many gears at least."""
    most: int
    spread: tuple[float, float]
    """Of the first over the last ratio. [-]"""
    steps: tuple[float, float]
    """Of each ratio over the next one; gears differ. [-]"""
    falling: bool
    """Whether no step is larger than the one below it."""
    singly: bool
    """Whether one element is to change between neighbours."""


def sequence_of(wanted: WantedSequence | None, *, singly: bool) -> Sequence:
    """The gears besides the targets, none where there is nothing wanted.

    Examples
    --------
    An end that no box reaches is none:

    >>> wanted = WantedSequence(3, 4, (2.0, 4.0), (1.0, 1e6))
    >>> sequence_of(wanted, singly=False).steps
    (1e-06, inf)
    """
    if wanted is None:
        return Sequence(0, 0, (0.0, 0.0), (0.0, 0.0), falling=False, singly=False)
    spread, (low, high) = _ends(wanted.spread), _ends(wanted.steps)
    steps = max(low, SAME_FITTED_RATIO), high
    return Sequence(wanted.least, wanted.most, spread, steps, wanted.falling, singly)


def _ends(given: tuple[float, float]) -> tuple[float, float]:
    low, high = given
    no_end = high >= LARGEST_RATIO**2
    return math.log(low) - TARGET_MARGIN, math.inf if no_end else math.log(high) + TARGET_MARGIN


class ChoiceRoom(NamedTuple):
    """Room for choices of ratios, in a cell or at a point: of the targets, then of a sequence."""

    reach: Integers
    """Targets that each ratio reaches, as bits, shape (ratios,)."""
    ends: Floats
    """Between which ln(i) of each ratio is, the first above the other where it is never forward;
    shape (ratios, 2). [-]"""
    steps: Floats
    """Between which ln(i/j) of two ratios is, shape (ratios, ratios, 2). [-]"""
    order: Integers
    """Ratios, those with the largest first, shape (ratios,)."""
    places: Integers
    """The place in the order of each gear, below 0 at first, shape (gears,)."""
    chosen: Integers
    """The ratio of each gear, shape (gears,)."""
    free: Booleans
    """Whether a ratio is of no gear, shape (ratios,)."""
    looks: Integers
    """So many gears were looked at, shape (1,)."""


class SequenceRoom(NamedTuple):
    """Room for cells, kept one on the other, and for sequences."""

    wanted: Sequence
    ratio_of: Integers
    """The ratio of each combination of a set, below 0 of none, shape (combinations of a set,)."""
    chains: ChainRoom
    """A combination of elements for each gear."""
    match: MatchRoom
    steps: Integers
    """How many cells were looked at, and how many may be; shape (2,)."""
    parts: Floats
    """Numerators and denominators, shape (cells, ratios, 2, corners)."""
    low: Floats
    """Bounds of ring teeth/sun teeth, shape (cells, sets). [-]"""
    high: Floats
    cell: ChoiceRoom
    point: ChoiceRoom
    sums: Floats
    """Coefficients of a quotient in a cell, shape (2, 3**sets)."""
    logs: Floats
    """ln(i) of each ratio at the point, -inf of one backward, shape (ratios,). [-]"""
    fit: FitRoom
    rows: Floats
    """Of each error of a fit the middle, half the width, in terms of that both ends, and whether it
    counts; shape (errors, 5)."""
    gear_logs: Floats
    """ln(i) of each gear in a fit, or its slope, shape (gears,)."""
    best: Integers
    """Gears of the sequence that is told, whether they shift singly, shape (2,)."""
    is_single_left: Booleans
    """Whether no longer one is looked for, only one that shifts singly, shape (1,)."""
    squares: Floats
    """Its sum of squares, shape (1,). [-]"""
    best_chosen: Integers
    """Ratios of the targets, then of the sequence, shape (gears,)."""
    best_gears: Integers
    """Their combinations of elements, shape (gears,)."""
    best_logs: Floats
    """Logarithms of ring teeth/sun teeth there, shape (sets,). [-]"""


def sequence_room(table: Combinations, asked: Asked, wanted: Sequence, sets: int) -> SequenceRoom:
    """Room for sequences of a set of elements."""
    ratios, targets = len(table.places), len(asked.targets)
    gears = targets + wanted.most
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW))
    deep = 2 + sets * math.ceil(max(halvings, 0)) if wanted.most else 1
    rows = targets + 2 * wanted.most  # targets, steps, spread, falls
    return SequenceRoom(
        wanted=wanted,
        ratio_of=np.zeros(ratios, np.int64),
        chains=chain_room(table, gears, np.array([[0, 1]][: wanted.most], np.int64).reshape(-1, 2)),
        match=match_room(targets),
        steps=np.array([0, NO_END]),
        parts=np.zeros((deep, ratios, 2, 2**sets)),
        low=np.zeros((deep, sets)),
        high=np.zeros((deep, sets)),
        cell=_choice_room(ratios, gears),
        point=_choice_room(ratios, gears),
        sums=np.zeros((2, 3**sets)),
        logs=np.zeros(ratios),
        fit=fit_room(rows, sets),
        rows=np.zeros((rows, 5)),
        gear_logs=np.zeros(gears),
        best=np.zeros(2, np.int64),
        is_single_left=np.zeros(1, np.bool_),
        squares=np.zeros(1),
        best_chosen=np.zeros(gears, np.int64),
        best_gears=np.zeros(gears, np.int64),
        best_logs=np.zeros(sets),
    )


def _choice_room(ratios: int, gears: int) -> ChoiceRoom:
    return ChoiceRoom(
        reach=np.zeros(ratios, np.int64),
        ends=np.zeros((ratios, 2)),
        steps=np.zeros((ratios, ratios, 2)),
        order=np.arange(ratios),
        places=np.zeros(gears + 1, np.int64),
        chosen=np.zeros(gears, np.int64),
        free=np.zeros(ratios, np.bool_),
        looks=np.zeros(1, np.int64),
    )
