"""Gear-set ratios with which an element set has all gears, by branch and bound; compiled.

Each cell of gear-set ratios is reduced by all targets, then halved. If several gear ratios can meet
a target, the search branches: the target is assigned to one of them, or not. When each target has
one gear ratio, the gear-set ratios are fitted from the middle of the cell.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.search.cells import (
    RatioCells,
    cells_room,
    double,
    halve,
    is_left,
    longest,
    spread_in,
)
from vstatics.synthesis.boxes.search.chains import ChainRoom, chain_room, chained
from vstatics.synthesis.boxes.search.engaged import Combinations, integers
from vstatics.synthesis.boxes.search.joining import NO_END
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room, matched
from vstatics.synthesis.boxes.search.set_ratios import Asked, FitRoom, fit_room, fitted_within
from vstatics.synthesis.compiled import compiled_part, fill, put, shared

SPREADS = np.array([0.5, 0.2, 0.06, 0.02, 0.006, 0.002])
"""Variations of ln(i) in a cell below which fits of the chosen gears are tried, in turn. [-]

After the last fit the cell is abandoned. A gearbox is therefore missed only if ln(i) varies by less
than the last number over its permitted gear-set ratios.
"""
MOST_CELLS = 200_000
"""Number of cells of gear-set ratios after which an element set is given up."""
EACH, NONE = -1, -2
"""Results of `_open_target`: each target has its own gear ratio, or some target lacks a ratio.
"""
MORE_FITS = 50
"""Number of fits after a first solution, to find a better solution."""


@shared
class CellRoom(NamedTuple):
    """Work arrays for cells of gear-set ratios and for fits."""

    cells: RatioCells
    match: MatchRoom
    """Assignment of a gear ratio to each target."""
    chains: ChainRoom
    """Assignment of combinations of shift elements to targets."""
    ratio_of: Integers
    """Index of the gear ratio of each combination of an element set; negative without a ratio,
    shape (combinations of a set,).
    """
    better: Asked
    """Requirements, with the ranges of gear ratios that a better solution must have."""
    steps: Integers
    """Number of examined cells, and the limit, shape (2,)."""
    given_up: Booleans
    """True if cells that could contain a solution were not examined, shape (1,)."""
    fit: FitRoom
    best_logs: Floats
    """Logarithms of ring teeth divided by sun teeth of the best fit, shape (sets,). [-]"""
    best_gears: Integers
    """Combination of shift elements for each target of the best fit, shape (targets,)."""
    best: Floats
    """Sum of squares of ln(i/target)/width of the best fit (infinite without a fit), and largest
    |ln(i/target)|, shape (2,). [-]
    """


def cell_room(table: Combinations, asked: Asked, sets: int, shifts: Integers) -> CellRoom:
    """Return work arrays for solving an element set. `shifts` are pairs from `neighbours`."""
    ratios, targets = len(table.places), len(asked.targets)
    return CellRoom(
        cells=cells_room(ratios, asked, sets),
        match=match_room(targets),
        chains=chain_room(table, targets, shifts),
        ratio_of=integers(ratios),
        better=asked._replace(least=np.zeros(targets), most=np.zeros(targets)),
        steps=np.array([0, NO_END]),
        given_up=np.zeros(1, np.bool_),
        fit=fit_room(targets, sets),
        best_logs=np.zeros(sets),
        best_gears=integers(targets),
        best=np.zeros(2),
    )


@compiled_part
def solved(parts: Floats, reach: Integers, asked: Asked, room: CellRoom) -> float:
    """Find gear-set ratios that meet all targets, with the smallest sum of squared errors.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different gear ratios at the corners of the bounds.
    reach : array, shape (ratios,)
        Targets that each gear ratio reaches, as bits.
    asked : Asked
    room : CellRoom
        Work arrays; `ratio_of` contains the gear ratio of each combination. `best_logs` and
        `best_gears` receive the fit, `given_up` whether a fit can exist that was not found.

    Returns
    -------
    float
        Smallest sum of squares of ln(i/target)/width; infinity without a solution. [-]
    """
    cells = room.cells
    _begin(reach, asked, room)
    fits = 0
    top = 1
    end = min(room.steps[1], room.steps[0] + MOST_CELLS)
    while top > 0 and room.steps[0] < end and fits < MORE_FITS:
        top -= 1
        room.steps[0] += 1
        target = NONE
        if is_left(parts, room.better, cells, room.match, top):
            target = _open_target(len(parts), room, top)
        if target == NONE:
            continue
        number = longest(cells, top)
        spread = 0.0 if number < 0 else spread_in(cells, top)
        if target == EACH:
            stage = before = cells.stages[top]
            while stage < len(SPREADS) and spread <= SPREADS[stage]:
                stage += 1
            cells.stages[top] = stage
            is_due = bool(stage > before)
            is_met = is_due and _fit(parts, asked, room, top)
            fits += is_due and room.best[0] < math.inf
            if is_met or number < 0 or cells.stages[top] == len(SPREADS):
                continue
        if target != EACH and spread <= SPREADS[0]:
            _give(target, cells, top)
        else:
            halve(cells, top, number)
        top += 2
    room.given_up[0] = top > 0 and room.best[0] == math.inf
    return float(room.best[0])


@compiled_part
def _begin(reach: Integers, asked: Asked, room: CellRoom) -> None:
    fill(room.best, math.inf)
    put(asked.least, room.better.least)
    put(asked.most, room.better.most)
    cells = room.cells
    cells.reach[0] = 0
    put(reach, cells.reach[0])
    cells.low[0] = asked.low
    cells.high[0] = asked.high
    cells.stages[0] = 0
    cells.known[0] = False


@compiled_part
def _open_target(ratios: int, room: CellRoom, top: int) -> int:
    """Return the undecided target with the fewest gear ratios, or `EACH` or `NONE`.

    The result is `NONE` if not every target can have its own gear ratio, or if no suitable
    combinations of shift elements exist for the chosen gears.
    """
    scarcest, least = EACH, ratios + 1
    reach, chosen = room.cells.reach[top], room.match.chosen
    for target in range(len(chosen)):
        count = 0
        for ratio in range(ratios):
            if (reach[ratio] >> target) & 1:
                count += 1
                chosen[target] = ratio
        if count == 0:
            return NONE
        if 1 < count < least:
            scarcest, least = target, count
    if scarcest == EACH:
        return EACH if _has_elements(room, top) else NONE
    return scarcest if matched(reach, ratios, room.match) else NONE


@compiled_part
def _give(target: int, cells: RatioCells, top: int) -> None:
    """Split a cell into two cases: the first gear ratio that can meet a target does or does not.

    In the upper copy of the cell, the gear ratio meets only this target; in the lower copy, it
    cannot meet it.
    """
    double(cells, top)
    bit = 1 << target
    is_given = False
    for ratio in range(cells.reach.shape[1]):
        if cells.reach[top, ratio] & bit:
            if is_given:
                cells.reach[top + 1, ratio] ^= bit
            else:
                cells.reach[top, ratio] ^= bit
                cells.reach[top + 1, ratio] = bit
                is_given = True


@compiled_part
def _has_elements(room: CellRoom, top: int) -> bool:
    if not room.cells.known[top]:
        if not chained(room.ratio_of, room.match.chosen, room.chains):
            return False
        room.cells.known[top] = True
    return True


@compiled_part
def _fit(parts: Floats, asked: Asked, room: CellRoom, top: int) -> bool:
    """Fit the chosen gear ratios and record the best fit; return whether all targets are met."""
    cells, chosen = room.cells, room.match.chosen
    for number in range(cells.low.shape[1]):
        room.fit.logs[number] = 0.5 * math.log(cells.low[top, number] * cells.high[top, number])
    total = fitted_within(parts, chosen, asked, room.fit)
    if total < room.best[0]:
        room.best[0] = total
        room.best[1] = 0.0
        for target in range(len(chosen)):
            size = abs(room.fit.errors[target]) * asked.widths[target]
            room.best[1] = max(room.best[1], size)
        put(room.fit.logs, room.best_logs)
        chained(room.ratio_of, chosen, room.chains)
        put(room.chains.gears, room.best_gears)
        nearer = min(math.sqrt(total), 1.0)
        for target in range(len(chosen)):  # a better solution must be within these ranges
            part = math.exp(nearer * asked.widths[target])
            first_end, second_end = asked.targets[target] / part, asked.targets[target] * part
            room.better.least[target] = max(asked.least[target], min(first_end, second_end))
            room.better.most[target] = min(asked.most[target], max(first_end, second_end))
    return total < math.inf
