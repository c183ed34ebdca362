"""What the ratios are at a point of the bounds, and the best choice that is known so far."""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.search.sequences.choosing import set_elements
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked, weigh, weighed


@compiled
def is_best(room: SequenceRoom) -> bool:
    """Whether nothing can be better than what there is, as far as is looked for now."""
    if room.is_single_left[0]:
        return bool(room.best[1] > 0)
    return bool(room.best[0] == room.wanted.most)


@compiled
def fewest(room: SequenceRoom) -> int:
    """So many gears has what is better, at least."""
    longer = 0 if room.is_single_left[0] else 1
    return int(max(room.wanted.least, room.best[0] + longer))


@compiled
def is_singly(room: SequenceRoom) -> int:
    """Whether something is better only if it shifts singly."""
    return 1 if room.wanted.singly or room.is_single_left[0] else 0


@compiled
def find_logs(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """ln(i) of all forward ratios at the logarithms of the fit."""
    weigh(room.fit.logs, asked, room.fit)
    for ratio in range(len(parts)):
        _ratio_at(parts, ratio, room)


@compiled
def _ratio_at(parts: Floats, ratio: int, room: SequenceRoom) -> float:
    """A ratio at the weights of the corners; ln(i) of it is kept."""
    above, below = weighed(parts[ratio], room.fit.own)
    value = above / below
    room.logs[ratio] = math.log(value) if 0 < value < math.inf else -math.inf
    return float(value)


@compiled
def find_point(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """All ratios, and the steps between them, at the logarithms of the fit."""
    own, logs, count = room.point, room.logs, len(parts)
    weigh(room.fit.logs, asked, room.fit)
    for ratio in range(count):
        value = _ratio_at(parts, ratio, room)
        own.reach[ratio] = 0
        for target in range(len(asked.targets)):
            if asked.least[target] <= value <= asked.most[target]:
                own.reach[ratio] |= 1 << target
        own.ends[ratio, 0] = own.ends[ratio, 1] = logs[ratio]
        if logs[ratio] == -math.inf:
            own.ends[ratio, 0] = math.inf
        place = ratio
        while place > 0 and logs[own.order[place - 1]] < logs[ratio]:
            own.order[place] = own.order[place - 1]
            place -= 1
        own.order[place] = ratio
    for one in range(count):
        for other in range(count):
            is_step = min(logs[one], logs[other]) > -math.inf
            step = logs[one] - logs[other]
            own.steps[one, other, 0] = step if is_step else math.inf
            own.steps[one, other, 1] = step if is_step else -math.inf


@compiled
def note(length: int, asked: Asked, singly: int, squares: float, room: SequenceRoom) -> bool:
    """Note a choice at the point, if elements can be engaged for it, maybe only singly."""
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
