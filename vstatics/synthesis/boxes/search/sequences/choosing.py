"""Choice of a gear ratio for each target and for each gear of a sequence.

In a cell of gear-set ratios, the gear ratios and step ratios are known as ranges. At a point they
are known exactly, and so are the choices.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.synthesis.boxes.search.chains import chained
from vstatics.synthesis.boxes.search.sequences.room import ChoiceRoom, Sequence, SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.compiled import compiled_part


class Goal(NamedTuple):
    """Sizes of a search for choices of gear ratios, and the limit of the effort."""

    targets: int
    """Number of targets; the first gears of a choice meet the targets."""
    ratios: int
    """Number of gear ratios to choose from."""
    fewest: int
    """Smallest number of gears in the sequence."""
    looks: int
    """Largest number of trial assignments of gear ratios to gears before the search is aborted."""


@compiled_part
def begin_choices(room: ChoiceRoom) -> None:
    """Reset the work arrays before the first choice."""
    for ratio in range(len(room.free)):
        room.free[ratio] = True
    room.places[0] = -1
    room.looks[0] = 0


@compiled_part
def next_choice(wanted: Sequence, goal: Goal, depth: int, room: ChoiceRoom) -> int:
    """Find the next choice that the ranges allow. Each choice is found once.

    Parameters
    ----------
    wanted : Sequence
    goal : Goal
    depth : int
        0 for the first choice, then the previous return value.
    room : ChoiceRoom

    Returns
    -------
    int
        Number of chosen gears, including the targets; 0 after the last choice, -1 after too many
        trial assignments.
    """
    while depth >= 0:
        if depth == goal.targets + wanted.most:  # the sequence has its largest number of gears
            depth -= 1
        place = room.places[depth]
        if place >= 0:
            room.free[room.order[place]] = True
        place += 1
        while place < goal.ratios and not _may_be(wanted, goal, depth, room.order[place], room):
            place += 1
        if place == goal.ratios:
            depth -= 1
            continue
        room.looks[0] += 1
        if room.looks[0] > goal.looks:
            return -1
        ratio = room.order[place]
        room.places[depth] = place
        room.chosen[depth] = ratio
        room.free[ratio] = False
        depth += 1
        room.places[depth] = -1
        if depth - goal.targets >= max(goal.fewest, 2):
            first = room.chosen[goal.targets]
            if room.steps[first, ratio, 1] >= wanted.spread[0]:
                return depth
    return 0


@compiled_part
def _may_be(wanted: Sequence, goal: Goal, depth: int, ratio: int, room: ChoiceRoom) -> bool:
    if not room.free[ratio]:
        return False
    if depth < goal.targets:
        return bool((room.reach[ratio] >> depth) & 1)
    if depth == goal.targets:
        return bool(room.ends[ratio, 0] <= room.ends[ratio, 1])
    first, last = room.chosen[goal.targets], room.chosen[depth - 1]
    low, high = room.steps[last, ratio, 0], room.steps[last, ratio, 1]
    largest = wanted.steps[1]
    if wanted.falling:
        if depth > goal.targets + 1:
            largest = min(largest, room.steps[room.chosen[depth - 2], last, 1])
        further = min(largest, high)
    else:
        further = largest
    if high < wanted.steps[0] or low > largest or room.steps[first, ratio, 0] > wanted.spread[1]:
        return False
    gears = goal.targets + wanted.most - depth - 1  # largest number of gears that can still follow
    return bool(gears == 0 or room.steps[first, ratio, 1] + gears * further >= wanted.spread[0])


@compiled_part
def set_elements(asked: Asked, length: int, singly: int, room: SequenceRoom) -> bool:
    """Assign combinations to the chosen gears so that all shift elements are used.

    Parameters
    ----------
    asked : Asked
    length : int
        Number of gears chosen at the current point, including the targets.
    singly : int
        1 if neighbouring gears must also differ by exchange of one shift element.
    room : SequenceRoom
        Work arrays; `chains` receives the combination of each gear.

    Returns
    -------
    bool
        Whether such an assignment exists.
    """
    chains, targets, turn = room.chains, asked.targets, 0
    for sign in (1, -1):
        start, after, last = turn, math.inf, -1
        while True:  # gears of the same direction, from the largest ratio to the smallest
            best, largest = -1, -math.inf
            for gear in range(length):
                if gear < len(targets):
                    log = math.log(abs(targets[gear]))
                    is_such = targets[gear] * sign > 0
                else:
                    log, is_such = room.logs[room.point.chosen[gear]], sign > 0
                is_later = log < after or (log == after and gear > last)
                if is_such and is_later and log > largest:
                    best, largest = gear, log
            if best < 0:
                break
            chains.order[turn] = best
            chains.is_shift[turn] = singly > 0 and turn > start
            turn += 1
            after, last = largest, best
    chains.is_shift[turn] = False
    return bool(turn == length and chained(room.ratio_of, room.point.chosen[:length], chains))


@compiled_part
def may_use_all(targets: int, length: int, singly: int, room: SequenceRoom) -> bool:
    """Return False if the gears chosen in a cell cannot use all shift elements.

    If there are targets, the order of the gears is not yet known, so that single shifts are not
    checked.
    """
    chains = room.chains
    for gear in range(length):
        chains.order[gear] = gear
        chains.is_shift[gear] = singly > 0 and targets == 0 and gear > 0
    chains.is_shift[length] = False
    return bool(chained(room.ratio_of, room.cell.chosen[:length], chains))
