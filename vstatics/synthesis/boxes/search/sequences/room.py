"""Requirements on a sequence of gears, as logarithms, and work arrays of its search."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.box import LARGEST_BOX_RATIO, WantedSequence
from vstatics.synthesis.boxes.search.chains import ChainRoom, chain_room
from vstatics.synthesis.boxes.search.engaged import Combinations, integers
from vstatics.synthesis.boxes.search.joining import NO_END
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room
from vstatics.synthesis.boxes.search.set_ratios import Asked, FitRoom, fit_room
from vstatics.synthesis.compiled import shared
from vstatics.synthesis.tolerances import SAME_FITTED_RATIO, TARGET_MARGIN

NARROW_SEQUENCE_CELL = 1.01
"""Quotient of upper and lower bound of a gear-set ratio; the search halves no narrower cell. [-]"""


@shared
class Sequence(NamedTuple):
    """Number and spacing of the forward gears that a gearbox must have."""

    least: int
    """Smallest number of gears."""
    most: int
    """Largest number of gears."""
    spread: tuple[float, float]
    """Range of the logarithm of the ratio spread, ln(first ratio/last ratio). [-]"""
    steps: tuple[float, float]
    """Range of the logarithm of step ratios, ln(ratio/next ratio); the lower end separates the
    gears. [-]
    """
    falling: bool
    """True if step ratios must not increase from gear to gear."""
    singly: bool
    """True if neighbouring gears must differ by exchange of a single shift element."""


def sequence_of(wanted: WantedSequence | None, *, singly: bool) -> Sequence:
    """Return the gears wanted in addition to the targets; no gears without a request.

    Examples
    --------
    An end that no gearbox can reach becomes infinite:

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
    no_end = high >= LARGEST_BOX_RATIO**2
    return math.log(low) - TARGET_MARGIN, math.inf if no_end else math.log(high) + TARGET_MARGIN


@shared
class ChoiceRoom(NamedTuple):
    """Work arrays for choices of gear ratios, first for the targets, then for the sequence."""

    reach: Integers
    """Targets that each gear ratio reaches, as bits, shape (ratios,)."""
    ends: Floats
    """Range of ln(i) of each gear ratio, (inf, -inf) for a reverse ratio, shape (ratios, 2). [-]"""
    steps: Floats
    """Range of ln(i/j) of each pair of gear ratios, shape (ratios, ratios, 2). [-]"""
    order: Integers
    """Indices of the gear ratios from the largest to the smallest, shape (ratios,)."""
    places: Integers
    """Position in `order` of the ratio of each gear, then a spare, shape (gears + 1,); -1 at first.
    """
    chosen: Integers
    """Index of the ratio of each gear, shape (gears,)."""
    free: Booleans
    """True if a gear ratio is not assigned to a gear, shape (ratios,)."""
    looks: Integers
    """Number of trial assignments of gear ratios to gears until now, shape (1,)."""


@shared
class SequenceRoom(NamedTuple):
    """Work arrays for a stack of cells of gear-set ratios, and for sequences of gears."""

    wanted: Sequence
    ratio_of: Integers
    """Index of the gear ratio of each combination of an element set; negative without a ratio,
    shape (combinations of a set,).
    """
    chains: ChainRoom
    """Work arrays for assigning combinations of shift elements to gears."""
    match: MatchRoom
    steps: Integers
    """Number of examined cells, and the limit, shape (2,)."""
    parts: Floats
    """Numerators and denominators of the gear ratios at the corners of the cells, shape (cells,
    ratios, 2, corners). [-]
    """
    low: Floats
    """Lower bounds of ring teeth divided by sun teeth, shape (cells, sets). [-]"""
    high: Floats
    """Upper bounds of ring teeth divided by sun teeth, shape (cells, sets). [-]"""
    cell: ChoiceRoom
    """Work arrays for the choices of gears that are possible in a cell."""
    point: ChoiceRoom
    """Work arrays for the choices of gears at a point."""
    sums: Floats
    """Bernstein coefficients of a step ratio in a cell, shape (2, 3**sets)."""
    logs: Floats
    """ln(i) of each gear ratio at the point, -inf for a reverse ratio, shape (ratios,). [-]"""
    fit: FitRoom
    rows: Floats
    """Middle and half-width of each error, both ends of the range in half-widths, and 1 if the
    error counts, shape (errors, 5). [-]
    """
    gear_logs: Floats
    """ln(i) of each gear of a fit, or the slope, shape (gears,). [-]"""
    best: Integers
    """Number of gears of the best sequence, and 1 for single shifts, shape (2,)."""
    is_single_left: Booleans
    """True if only an equally long sequence with single shifts is still sought, shape (1,)."""
    squares: Floats
    """Sum of the squared errors of the best sequence, shape (1,). [-]"""
    best_chosen: Integers
    """Indices of the gear ratios of the best choice: targets, then the sequence, shape (gears,)."""
    best_gears: Integers
    """Combination of shift elements in each gear of the best choice, shape (gears,)."""
    best_logs: Floats
    """Logarithms of ring teeth divided by sun teeth of the best choice, shape (sets,). [-]"""


def sequence_room(table: Combinations, asked: Asked, wanted: Sequence, sets: int) -> SequenceRoom:
    """Return work arrays for finding sequences with an element set."""
    ratios, targets = len(table.places), len(asked.targets)
    gears = targets + wanted.most
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW_SEQUENCE_CELL))
    deep = 2 + sets * math.ceil(max(halvings, 0)) if wanted.most else 1
    rows = targets + 2 * wanted.most  # targets, steps, spread, and pairs of steps that must fall
    return SequenceRoom(
        wanted=wanted,
        ratio_of=integers(ratios),
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
        best=integers(2),
        is_single_left=np.zeros(1, np.bool_),
        squares=np.zeros(1),
        best_chosen=integers(gears),
        best_gears=integers(gears),
        best_logs=np.zeros(sets),
    )


def _choice_room(ratios: int, gears: int) -> ChoiceRoom:
    return ChoiceRoom(
        reach=integers(ratios),
        ends=np.zeros((ratios, 2)),
        steps=np.zeros((ratios, ratios, 2)),
        order=np.arange(ratios),
        places=integers(gears + 1),
        chosen=integers(gears),
        free=np.zeros(ratios, np.bool_),
        looks=integers(1),
    )
