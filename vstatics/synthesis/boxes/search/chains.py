"""A combination of elements for each gear, so that all are used, and one changes at a time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Integers
from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.engaged import Combinations


class ChainRoom(NamedTuple):
    """Room for combinations of gears one after the other."""

    used: Integers
    """The places that each combination of a set uses, as bits, shape (combinations,)."""
    order: Integers
    """Targets, those between which one element is to change one behind the other."""
    is_shift: Booleans
    """Whether one element is to change before each in this order, and behind the last."""
    is_near: Booleans
    """Whether one element changes between two combinations, or none, shape (combinations, 2)."""
    met: Integers
    """The search in which a combination was met, and what had been used: after so many gears, by
    the combination if one element is to change next, by what is used; shape (targets + 1,
    combinations or 1, 2**size)."""
    came: Integers
    """From where it was met, as one number."""
    searches: Integers
    """How many there were, shape (1,)."""
    gears: Integers
    """The combination of each target, shape (targets,)."""


def chain_room(table: Combinations, targets: int, shifts: Integers) -> ChainRoom:
    """Room for so many targets; shifts are those of `neighbours`."""
    size, places = len(table.starts) - 1, table.places
    order: list[int] = []
    is_shift: list[bool] = []
    for before, after in shifts.tolist():
        if not order or order[-1] != before:
            order, is_shift = [*order, before], [*is_shift, False]
        order, is_shift = [*order, after], [*is_shift, True]
    alone = [target for target in range(targets) if target not in order]
    held = (places[:, :, None] == np.arange(size)).any(axis=1)
    kept = held.astype(np.int64) @ held.T.astype(np.int64)
    shape = targets + 1, len(places) if is_shift else 1, 2**size
    return ChainRoom(
        used=held.astype(np.int64) @ (1 << np.arange(size)),
        order=np.array([*order, *alone], np.int64),
        is_shift=np.array([*is_shift, *[False] * len(alone), False], np.bool_),
        is_near=kept >= places.shape[1] - 1,
        met=np.zeros(shape, np.int64),
        came=np.zeros(shape, np.int64),
        searches=np.zeros(1, np.int64),
        gears=np.zeros(targets, np.int64),
    )


@compiled
def chained(ratio_of: Integers, chosen: Integers, room: ChainRoom) -> bool:
    """Whether combinations of the chosen ratios use all elements, and change as they are to.

    Parameters
    ----------
    ratio_of : array, shape (combinations of a set,)
        The ratio of each, below 0 of none.
    chosen : array, shape (targets,)
        The ratio of each target.
    room : ChainRoom
        `gears` takes the combination of each target.
    """
    room.searches[0] += 1
    now, count, states = room.searches[0], len(chosen), room.met.shape[2]
    room.met[0, 0, 0] = now
    for turn in range(count):
        ratio, is_shift = chosen[room.order[turn]], room.is_shift[turn]
        for last in range(room.met.shape[1] if is_shift else 1):
            for state in range(states):
                if room.met[turn, last, state] != now:
                    continue
                for one in range(len(ratio_of)):
                    if ratio_of[one] == ratio and (not is_shift or room.is_near[last, one]):
                        after = state | room.used[one]
                        own = one if room.is_shift[turn + 1] else 0
                        if room.met[turn + 1, own, after] != now:
                            room.met[turn + 1, own, after] = now
                            before = last * states + state
                            room.came[turn + 1, own, after] = before * len(ratio_of) + one
    if room.met[count, 0, states - 1] != now:
        return False
    own, state = 0, states - 1
    for turn in range(count, 0, -1):
        came = room.came[turn, own, state]
        room.gears[room.order[turn - 1]] = came % len(ratio_of)
        own, state = divmod(came // len(ratio_of), states)
    return True
