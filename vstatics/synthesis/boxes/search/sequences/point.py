"""Gear ratios at a point of the gear-set ratios, and the best known choice of gears."""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.sequences.choosing import set_elements
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked, weigh, weighed
from vstatics.synthesis.compiled import compiled_part, put


@compiled_part
def is_best(room: SequenceRoom) -> bool:
    """Return whether the best known choice needs no further search."""
    if room.is_single_left[0]:
        return bool(room.best[1] > 0)
    return bool(room.best[0] == room.wanted.most)


@compiled_part
def fewest(room: SequenceRoom) -> int:
    """Return the smallest number of gears of a choice that would be better."""
    longer = 0 if room.is_single_left[0] else 1
    return int(max(room.wanted.least, room.best[0] + longer))


@compiled_part
def is_singly(room: SequenceRoom) -> int:
    """Return 1 if a better choice must have single shifts between neighbouring gears, else 0."""
    return 1 if room.wanted.singly or room.is_single_left[0] else 0


@compiled_part
def find_logs(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """Calculate ln(i) of all forward gear ratios at the current point."""
    weigh(room.fit.logs, asked, room.fit)
    for ratio in range(len(parts)):
        _ratio_at(parts, ratio, room)


@compiled_part
def _ratio_at(parts: Floats, ratio: int, room: SequenceRoom) -> float:
    """Return a gear ratio at the current point, and store the logarithm."""
    above, below = weighed(parts[ratio], room.fit.corner_weights)
    value = above / below
    room.logs[ratio] = math.log(value) if 0 < value < math.inf else -math.inf
    return float(value)


@compiled_part
def find_point(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """Calculate all gear ratios and step ratios at the current point, and sort the gear ratios."""
    point, logs, count = room.point, room.logs, len(parts)
    weigh(room.fit.logs, asked, room.fit)
    for ratio in range(count):
        value = _ratio_at(parts, ratio, room)
        point.reach[ratio] = 0
        for target in range(len(asked.targets)):
            if asked.least[target] <= value <= asked.most[target]:
                point.reach[ratio] |= 1 << target
        point.ends[ratio, 0] = point.ends[ratio, 1] = logs[ratio]
        if logs[ratio] == -math.inf:
            point.ends[ratio, 0] = math.inf
        place = ratio
        while place > 0 and logs[point.order[place - 1]] < logs[ratio]:
            point.order[place] = point.order[place - 1]
            place -= 1
        point.order[place] = ratio
    for upper in range(count):
        for lower in range(count):
            is_step = min(logs[upper], logs[lower]) > -math.inf
            step = logs[upper] - logs[lower]
            point.steps[upper, lower, 0] = step if is_step else math.inf
            point.steps[upper, lower, 1] = step if is_step else -math.inf


@compiled_part
def note(length: int, asked: Asked, singly: int, squares: float, room: SequenceRoom) -> bool:
    """Record a choice at the current point as the best, if shift elements for all gears exist."""
    gears = length - len(asked.targets)
    is_single = set_elements(asked, length, 1, room)
    if not is_single and (singly > 0 or not set_elements(asked, length, 0, room)):
        return False
    room.best[0] = gears
    room.best[1] = 1 if is_single else 0
    room.squares[0] = squares
    put(room.point.chosen[:length], room.best_chosen)
    put(room.chains.gears[:length], room.best_gears)
    put(room.fit.logs, room.best_logs)
    return True
