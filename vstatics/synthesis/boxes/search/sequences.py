"""Ratios of sets with which a set of elements has a sequence of gears with wanted steps, compiled.

Nobody knows the ratios beforehand, only how many gears there are, how far they spread, how large
the steps between neighbours are. The bounds are halved again and again: a cell is left where no
sequence is long enough, by the ends of all ratios at its corners; in the middle of the others the
longest sequence is found.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.search.engaged import Combinations, all_used
from vstatics.synthesis.boxes.search.joining import NO_END
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room, matched
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.set_ratios import Asked

NARROW = 1.01
"""A cell is not halved along a ratio whose bounds are so near. [-]"""
MOST_LOOKS = 2000
"""So many gears of sequences are looked at in a cell, before it is halved. [-]"""
MOST_CELLS = 20_000
"""With more cells a set of elements is given up."""


class Sequence(NamedTuple):
    """Which forward gears a box is to have; logarithms of quotients of ratios."""

    least: int
    """So many gears at least."""
    most: int
    spread_low: float
    """Of the first over the last ratio. [-]"""
    spread_high: float
    step_low: float
    """Of each ratio over the next one. [-]"""
    step_high: float
    falling: bool
    """Whether no step is larger than the one below it."""


class SequenceRoom(NamedTuple):
    """Room for cells, kept one on the other, and for sequences."""

    wanted: Sequence
    ratio_of: Integers
    """The ratio of each combination of a set, below 0 of none, shape (combinations of a set,)."""
    used: Integers
    """The places of elements that it uses, as bits, shape (combinations of a set,)."""

    steps: Integers
    """How many cells were looked at, and how many may be; shape (2,)."""
    parts: Floats
    """Numerators and denominators, shape (cells, ratios, 2, corners)."""
    low: Floats
    """Bounds of ring teeth/sun teeth, shape (cells, sets). [-]"""
    high: Floats
    ends: Floats
    """Between which ln(i) of each ratio is in a cell, none where it is never forward; shape
    (ratios, 2). [-]"""
    lasts: Floats
    """Between which ln(i) of each gear of a sequence is, shape (gears, 2). [-]"""
    reach: Integers
    """Targets that each ratio reaches, as bits, shape (ratios,)."""
    match: MatchRoom
    free: Booleans
    """Whether a ratio is none of a target's, shape (ratios,)."""
    order: Integers
    """Ratios, those with the largest first, shape (ratios,)."""
    logs: Floats
    """ln(i) of each ratio in the middle of a cell [-]; NaN of one backward, shape (ratios,)."""
    ratios: Floats
    """Each ratio there, shape (ratios,). [-]"""
    chosen: Integers
    """Ratios of the targets, then of a sequence, shape (gears,)."""
    places: Integers
    """The place in the order of each gear of a sequence, shape (gears,)."""
    came: Integers
    """Scratch of `all_used`, shape (gears + 1, 2**size)."""
    gears: Integers
    """The combinations of the gears that are chosen, shape (gears,)."""
    best_gears: Integers
    """Those of the targets, then of the longest sequence, shape (gears,)."""
    best_logs: Floats
    """Logarithms of ring teeth/sun teeth there, shape (sets,). [-]"""


def sequence_room(table: Combinations, asked: Asked, wanted: Sequence, sets: int) -> SequenceRoom:
    """Room for sequences of a set of elements."""
    ratios, size = len(table.places), len(table.starts) - 1
    targets = len(asked.targets)
    gears = targets + wanted.most
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW))
    deep = 2 + sets * math.ceil(max(halvings, 0)) if wanted.most else 1
    return SequenceRoom(
        wanted=wanted,
        ratio_of=np.zeros(ratios, np.int64),
        used=np.zeros(ratios, np.int64),
        steps=np.array([0, NO_END]),
        parts=np.zeros((deep, ratios, 2, 2**sets)),
        low=np.zeros((deep, sets)),
        high=np.zeros((deep, sets)),
        ends=np.zeros((ratios, 2)),
        lasts=np.zeros((gears + 1, 2)),
        reach=np.zeros(ratios, np.int64),
        match=match_room(targets),
        free=np.zeros(ratios, np.bool_),
        order=np.zeros(ratios, np.int64),
        logs=np.zeros(ratios),
        ratios=np.zeros(ratios),
        chosen=np.zeros(gears, np.int64),
        places=np.zeros(gears, np.int64),
        came=np.zeros((gears + 1, 2**size), np.int64),
        gears=np.zeros(gears, np.int64),
        best_gears=np.zeros(gears, np.int64),
        best_logs=np.zeros(sets),
    )


@compiled
def sequence_found(parts: Floats, asked: Asked, room: SequenceRoom) -> tuple[int, bool]:
    """The gears of the longest sequence that is found; whether there may be a longer one.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different ratios at the corners of the bounds.
    asked : Asked
        Its targets are gears besides.
    room : SequenceRoom
        `ratio_of` and `used` tell whose ratios they are; `best_gears` and `best_logs`
        take what is found.
    """
    wanted, count, best = room.wanted, len(parts), 0
    for ratio in range(count):
        put(parts[ratio, 0], room.parts[0, ratio, 0])
        put(parts[ratio, 1], room.parts[0, ratio, 1])
    room.low[0] = asked.low
    room.high[0] = asked.high
    top, is_open = 1, False
    end = min(room.steps[1], room.steps[0] + MOST_CELLS)
    while top > 0 and room.steps[0] < end and best < wanted.most:
        top -= 1
        room.steps[0] += 1
        cell = room.parts[top]
        for ratio in range(count):
            room.reach[ratio] = reached(cell[ratio, 0], cell[ratio, 1], asked.least, asked.most)
        if not matched(room.reach, count, room.match):
            continue
        _find_ends(cell, count, room)
        if not _may_be(count, len(asked.targets), room, best):
            continue
        found = _in_the_middle(count, top, asked, room, best)
        if found > best:
            best = found
            for number in range(len(room.best_logs)):
                middle = room.low[top, number] * room.high[top, number]
                room.best_logs[number] = 0.5 * math.log(middle)
            if not _may_be(count, len(asked.targets), room, best):
                continue
        number = _widest(room, top)
        if number < 0:
            is_open = True
            continue
        _halve(room, count, top, number)
        top += 2
    return best, bool((is_open or top > 0) and best < wanted.most)


@compiled
def _find_ends(cell: Floats, count: int, room: SequenceRoom) -> None:
    """Between which ln(i) of each ratio is in a cell; the first end above the other of none."""
    for ratio in range(count):
        low, high = -math.inf, math.inf
        if has_one_sign(cell[ratio, 1]):
            least, most = extremes(cell[ratio, 0], cell[ratio, 1])
            low = math.log(least) if least > 0 else -math.inf
            high = math.log(most) if most > 0 else -math.inf
            if most <= 0:
                low = math.inf
        elif has_one_sign(cell[ratio, 0]):
            least, most = extremes(cell[ratio, 1], cell[ratio, 0])
            high = -math.log(least) if least > 0 else math.inf
            low = -math.log(most) if most > 0 else math.inf
            if most <= 0:
                high = -math.inf
        room.ends[ratio, 0] = low
        room.ends[ratio, 1] = high


@compiled
def _may_be(count: int, targets: int, room: SequenceRoom, best: int) -> bool:
    """Whether a sequence with more gears than the best may be in a cell, by the ends of ratios.

    Of long searches that is taken for granted. Elements that the targets' gears use are not told
    here: any ratio may be one of theirs.
    """
    wanted, depth, looked = room.wanted, 0, 0
    fewest = max(wanted.least, best + 1)
    room.free[:] = True
    room.places[0] = -1
    while depth >= 0:
        ratio = room.places[depth]
        if ratio >= 0:
            room.free[ratio] = True
        ratio += 1
        while ratio < count and not _follows(room, depth, ratio):
            ratio += 1
        if ratio == count:
            depth -= 1
            continue
        looked += 1
        if looked > MOST_LOOKS:
            return True
        room.places[depth] = ratio
        room.free[ratio] = False
        length = depth + 1
        if length >= fewest and _covers(targets, length, room):
            first = room.places[0]
            if room.ends[first, 1] - room.lasts[depth, 0] >= wanted.spread_low:
                return True
        if length < wanted.most:
            depth += 1
            room.places[depth] = -1
    return False


@compiled
def _follows(room: SequenceRoom, depth: int, ratio: int) -> bool:
    """Whether a ratio may be the next of a sequence; between which its logarithm is then."""
    if not room.free[ratio]:
        return False
    wanted = room.wanted
    low, high = room.ends[ratio]
    if depth > 0:
        low = max(low, room.lasts[depth - 1, 0] - wanted.step_high)
        high = min(high, room.lasts[depth - 1, 1] - wanted.step_low)
        low = max(low, room.ends[room.places[0], 0] - wanted.spread_high)
    room.lasts[depth, 0] = low
    room.lasts[depth, 1] = high
    return bool(low <= high and high > -math.inf and low < math.inf)


@compiled
def _covers(targets: int, length: int, room: SequenceRoom) -> bool:
    """Whether the combinations of a sequence, and some for the targets, use all elements."""
    room.chosen[targets : targets + length] = room.places[:length]
    every = room.came.shape[1] - 1
    room.came[0] = -1
    room.came[0, 0] = 0
    for gear in range(targets + length):
        before, after = room.came[gear % 2], room.came[(gear + 1) % 2]
        after[:] = -1
        if gear < targets:
            put(before, after)
        for state in range(every + 1):
            if before[state] >= 0:
                for subset in range(len(room.ratio_of)):
                    ratio = room.ratio_of[subset]
                    if ratio >= 0 and (gear < targets or ratio == room.chosen[gear]):
                        after[state | room.used[subset]] = 0
    return bool(room.came[(targets + length) % 2, every] >= 0)


@compiled
def _in_the_middle(count: int, top: int, asked: Asked, room: SequenceRoom, best: int) -> int:
    """The gears of the longest sequence in the middle of a cell, if it is longer than the best."""
    _find_middle(room.parts[top, :count], top, room)
    targets = len(asked.targets)
    found, target = best, 0
    room.chosen[:targets] = -1
    while target >= 0:  # all ways to give ratios to targets
        if target == targets:
            found = _sequence(room, count, targets, found)
            target -= 1
            continue
        ratio = room.chosen[target]
        if ratio >= 0:
            room.free[ratio] = True
        ratio += 1
        low, high = asked.least[target], asked.most[target]
        while ratio < count and not (room.free[ratio] and low <= room.ratios[ratio] <= high):
            ratio += 1
        if ratio == count:
            room.chosen[target] = -1
            target -= 1
        else:
            room.chosen[target] = ratio
            room.free[ratio] = False
            target += 1
    return found


@compiled
def _find_middle(cell: Floats, top: int, room: SequenceRoom) -> None:
    """The ratios in the middle of a cell, in their order."""
    for ratio in range(len(cell)):
        above = below = 0.0
        for corner in range(cell.shape[2]):
            weight = 1.0
            for number in range(room.low.shape[1]):
                low, high = room.low[top, number], room.high[top, number]
                part = (math.sqrt(low * high) - low) / (high - low)
                weight *= part if (corner >> number) & 1 else 1.0 - part
            above += weight * cell[ratio, 0, corner]
            below += weight * cell[ratio, 1, corner]
        room.free[ratio] = True
        room.ratios[ratio] = above / below if below != 0 else math.inf
        room.logs[ratio] = -math.inf
        if 0 < room.ratios[ratio] < math.inf:
            room.logs[ratio] = math.log(room.ratios[ratio])
        place = ratio
        while place > 0 and room.logs[room.order[place - 1]] < room.logs[ratio]:
            room.order[place] = room.order[place - 1]
            place -= 1
        room.order[place] = ratio


@compiled
def _sequence(room: SequenceRoom, count: int, targets: int, best: int) -> int:
    """The gears of the longest sequence of ratios that are none of a target's."""
    wanted, depth = room.wanted, 0
    room.places[0] = -1
    while depth >= 0 and best < wanted.most:
        room.places[depth] += 1
        place = room.places[depth]
        if place >= count or depth + count - place <= best:
            depth -= 1
            continue
        ratio = room.order[place]
        if not room.free[ratio] or room.logs[ratio] == -math.inf:
            continue
        spread = 0.0
        if depth > 0:
            before = room.logs[room.order[room.places[depth - 1]]]
            step = before - room.logs[ratio]
            spread = room.logs[room.order[room.places[0]]] - room.logs[ratio]
            if step < wanted.step_low:
                continue
            most = min(wanted.step_high, wanted.spread_high - spread + step)
            if wanted.falling and depth > 1:
                below = room.logs[room.order[room.places[depth - 2]]] - before
                most = min(most, below)
            if step > most:
                depth -= 1
                continue
        room.chosen[targets + depth] = ratio
        length = depth + 1
        gears = targets + length
        if (
            length > best
            and length >= wanted.least
            and spread >= wanted.spread_low
            and all_used(
                room.ratio_of,
                room.used,
                room.chosen[:gears],
                room.came[: gears + 1],
                room.gears[:gears],
            )
        ):
            best = length
            put(room.gears[:gears], room.best_gears[:gears])
        if length < wanted.most:
            depth += 1
            room.places[depth] = place
    return best


@compiled
def _widest(room: SequenceRoom, top: int) -> int:
    """The set whose bounds are widest in a cell; -1 if all are narrow."""
    found, widest = -1, NARROW
    for number in range(room.low.shape[1]):
        width = room.high[top, number] / room.low[top, number]
        if width > widest:
            found, widest = number, width
    return found


@compiled
def _halve(room: SequenceRoom, count: int, top: int, number: int) -> None:
    """Halve the cell on top, along one ratio: the lower half stays there, the other is next."""
    low, high = room.low[top, number], room.high[top, number]
    middle = math.sqrt(low * high)
    part = (middle - low) / (high - low)
    bit = 1 << number
    for ratio in range(count):
        for half in range(2):
            here = room.parts[top, ratio, half]
            there = room.parts[top + 1, ratio, half]
            for corner in range(len(here)):
                if corner & bit == 0:
                    last = here[corner | bit]
                    value = here[corner] + (last - here[corner]) * part
                    here[corner | bit] = value
                    there[corner] = value
                    there[corner | bit] = last
    put(room.low[top], room.low[top + 1])
    put(room.high[top], room.high[top + 1])
    room.high[top, number] = middle
    room.low[top + 1, number] = middle
