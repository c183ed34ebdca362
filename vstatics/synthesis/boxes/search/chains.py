"""Assignment of combinations (engaged shift elements) to consecutive gears, with single shifts.

In a single shift, one element is exchanged. The search proceeds from gear to gear and records the
elements used so far, because every shift element of the gearbox must be used.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Integers
from vstatics.synthesis.boxes.search.engaged import Combinations, integers
from vstatics.synthesis.compiled import compiled_part, shared


@shared
class ChainRoom(NamedTuple):
    """Work arrays for the assignment of combinations to consecutive gears."""

    used: Integers
    """Shift elements of each combination, as bits of their positions in the element set, shape
    (combinations,).
    """
    order: Integers
    """Order in which targets are assigned. Targets joined by single shifts are consecutive."""
    is_shift: Booleans
    """True if a single shift must lead to a position of `order`; False at the end."""
    is_near: Booleans
    """True if two combinations differ by at most a single element, shape (combinations,
    combinations).
    """
    met: Integers
    """Number of the latest search that reached each state, shape (targets + 1, combinations or 1,
    2**size). A state is the number of assigned gears, the last combination (if a single shift
    follows), and the used elements as bits.
    """
    came: Integers
    """Predecessor and combination of each state, encoded as an integer."""
    searches: Integers
    """Number of searches, shape (1,)."""
    gears: Integers
    """Index of the combination assigned to each target, shape (targets,)."""


def chain_room(table: Combinations, targets: int, shifts: Integers) -> ChainRoom:
    """Return work arrays for a number of targets and the required single shifts (`neighbours`)."""
    size, places = len(table.starts) - 1, table.places
    order: list[int] = []
    is_shift: list[bool] = []
    for before, after in shifts.tolist():
        if not order or order[-1] != before:
            order, is_shift = [*order, before], [*is_shift, False]
        order, is_shift = [*order, after], [*is_shift, True]
    alone = [target for target in range(targets) if target not in order]
    held = (places[:, :, None] == np.arange(size)).any(axis=1)
    shared = held.astype(np.int64) @ held.T.astype(np.int64)
    shape = targets + 1, len(places) if is_shift else 1, 2**size
    return ChainRoom(
        used=held.astype(np.int64) @ (1 << np.arange(size)),
        order=np.array([*order, *alone], np.int64),
        is_shift=np.array([*is_shift, *[False] * len(alone), False], np.bool_),
        is_near=shared >= places.shape[1] - 1,
        met=integers(*shape),
        came=integers(*shape),
        searches=integers(1),
        gears=integers(targets),
    )


@compiled_part
def chained(ratio_of: Integers, chosen: Integers, room: ChainRoom) -> bool:
    """Assign a combination to each target so that all elements are used and shifts are single.

    Parameters
    ----------
    ratio_of : array, shape (combinations of a set,)
        Index of the ratio of each combination; negative if the combination has no ratio.
    chosen : array, shape (targets,)
        Index of the ratio that meets each target.
    room : ChainRoom
        Work arrays; `gears` receives the combination of each target.

    Returns
    -------
    bool
        Whether such an assignment exists.
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
                for combination in range(len(ratio_of)):
                    if ratio_of[combination] == ratio and (
                        not is_shift or room.is_near[last, combination]
                    ):
                        after = state | room.used[combination]
                        slot = combination if room.is_shift[turn + 1] else 0
                        if room.met[turn + 1, slot, after] != now:
                            room.met[turn + 1, slot, after] = now
                            before = last * states + state
                            room.came[turn + 1, slot, after] = before * len(ratio_of) + combination
    if room.met[count, 0, states - 1] != now:
        return False
    slot, state = 0, states - 1
    for turn in range(count, 0, -1):
        came = room.came[turn, slot, state]
        room.gears[room.order[turn - 1]] = came % len(ratio_of)
        slot, state = divmod(came // len(ratio_of), states)
    return True
