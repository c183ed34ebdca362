"""Signs of the power flow: the closed form, and the search where losses turn a flow.

Source of the closed form and its proof: docs/method.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

from vstatics.numerics.traced import Number
from vstatics.statics.losses import (
    Flow,
    Lossy,
    Signs,
    attempt,
    is_possible,
    loaded,
    nothing,
    power,
    sign,
)
from vstatics.statics.speeds import TIE

SEARCHED = 12
"""Up to so many mechanisms all sets of signs are tried."""
ROUNDS = 200
"""So often the signs follow the flow, where there are too many sets to try them all."""


class Outcome(NamedTuple):
    """What the search for admissible signs ended with; names as in `Results`."""

    lossy: Lossy
    idle: Sequence[bool]
    """By mechanism, like `turned`."""
    locked: bool
    undecided: bool
    turned: Sequence[bool]
    choices: int


class _Start(NamedTuple):
    """By mechanism: the sign that the flow without losses gives, and why it may give none."""

    signs: Signs
    unloaded: Sequence[bool]
    still: Sequence[bool]


def _start(flow: Flow, *, moving: bool) -> _Start:
    """Signs by the closed form ``x = sign(M (w_first - w_third))``, ties by convention.

    NaN where torque or motion is not determined.
    """
    if not moving:
        none = [False] * len(flow.ratios)
        return _Start((math.nan,) * len(none), none, none)
    torques = loaded(flow, flow.ratios, flow.driving)
    unloaded = [bool(torque == 0) for torque in torques]
    still = [bool(motion == 0) for motion in flow.motion]
    signs = []
    for place, ratio in enumerate(flow.ratios):
        if unloaded[place] or still[place]:
            published = 1.0 if unloaded[place] else sign(ratio)
            if published < 0 and flow.efficiencies[place].back == 0:
                published = 0.0
            signs.append(published if flow.case.idle == "published" else 0.0)
        else:
            signs.append(sign(power(torques[place], flow.motion[place])) * flow.direction)
    return _Start(tuple(signs), unloaded, still)


def search(flow: Flow, *, moving: bool) -> Outcome:
    """Find the signs that agree with the flow they lead to.

    The signs without losses are tried first, then all sets of signs.

    Parameters
    ----------
    moving : bool
        Whether speeds, and torques without losses, exist.
    """
    start = _start(flow, moving=moving)
    lossy, choices, undecided, locked = nothing(flow, start.signs), 0, False, False
    if moving and _open(flow, start):
        lossy = _guess(flow, start)
    elif moving:
        first = _follow_unloaded(flow, start)
        found, choices = (first, 1) if first.admissible else _search(flow, start)
        undecided = found is None and choices < 0
        locked = found is None and choices == 0
        lossy = found or lossy
    idle = [a or b for a, b in zip(start.unloaded, start.still, strict=True)]
    turned = [
        lossy.admissible and not idles and x != given and efficiency.lossy
        for idles, x, given, efficiency in zip(
            idle, lossy.signs, start.signs, flow.efficiencies, strict=True
        )
    ]
    return Outcome(lossy, idle, locked, undecided, turned, max(choices, 0))


def _open(flow: Flow, start: _Start) -> list[int]:
    """Mechanisms with losses whose direction of power statics leaves open."""
    return [
        place
        for place, x in enumerate(start.signs)
        if math.isnan(x) and flow.efficiencies[place].lossy
    ]


def _follow_unloaded(flow: Flow, start: _Start) -> Lossy:
    """The signs without losses; unloaded mechanisms take the sign of their lossy flow."""
    signs = start.signs
    lossy = attempt(flow, signs)
    for _ in signs:
        followed = _turned(signs, lossy.flow, start.unloaded)
        if followed == signs:
            break
        signs = followed
        lossy = attempt(flow, signs)
    return lossy


def _turned(signs: Signs, flow: Signs, allowed: Sequence[bool]) -> Signs:
    """The signs with those of the flow where that is allowed and there is any."""
    return tuple(
        found if may and abs(found) == 1 else x
        for x, found, may in zip(signs, flow, allowed, strict=True)
    )


def _search(flow: Flow, start: _Start) -> tuple[Lossy | None, int]:
    """Admissible signs of the largest efficiency, and how many there are.

    The count is -1 where the search was cut short.
    """
    moving = [
        not still and efficiency.lossy
        for still, efficiency in zip(start.still, flow.efficiencies, strict=True)
    ]
    free = [place for place, moves in enumerate(moving) if moves]
    if len(free) > SEARCHED:
        free = [place for place in free if not start.unloaded[place]]
    if len(free) > SEARCHED:
        return _follow(flow, start, moving)
    found = [lossy for lossy in _attempt_all(flow, start, free) if lossy.admissible]
    if not found:
        if not free and any(x for x, still in zip(start.signs, start.still, strict=True) if still):
            # nothing moves that could lock: the convention for idle mechanisms does not suit
            signs = tuple(
                0.0 if still else x for x, still in zip(start.signs, start.still, strict=True)
            )
            return _search(flow, start._replace(signs=signs))
        return None, 0
    flows = {
        tuple(x * turns * turns for x, turns in zip(one.signs, one.flow, strict=True))
        for one in found
    }
    best = found[0]
    for other in found[1:]:
        if other.efficiency > best.efficiency or not best.efficiency < math.inf:
            best = other
    signs = tuple(
        given if unloaded and turns == 0 else x
        for x, given, unloaded, turns in zip(
            best.signs, start.signs, start.unloaded, best.flow, strict=True
        )
    )
    return best._replace(signs=signs), len(flows)


def _attempt_all(flow: Flow, start: _Start, free: Sequence[int]) -> Iterator[Lossy]:
    """All possible sets of signs of the `free` mechanisms."""
    for chosen in product((1.0, -1.0), repeat=len(free)):
        signs = list(start.signs)
        for place, x in zip(free, chosen, strict=True):
            signs[place] = x
        if is_possible(flow, tuple(signs)):
            yield attempt(flow, tuple(signs))


def _guess(flow: Flow, start: _Start) -> Lossy:
    """What every guess leads to, where statics leaves the flow through mechanisms open.

    So a redundant part of a train does not hide what is determined in the rest of it.
    """
    one = nothing(flow, start.signs)
    open_ = _open(flow, start)
    if len(open_) > SEARCHED:
        return one
    guesses = list(_attempt_all(flow, start, open_))
    if not guesses or any(guess.efficiency <= 0 for guess in guesses):
        return one

    def common(values: Sequence[Number]) -> Number:
        first = values[0]
        most = max(abs(first), 1.0) if first == first else 1.0  # noqa: PLR0124 the input is 1
        agree = all(abs(value - first) <= TIE * most for value in values)
        return first if agree else math.nan

    def by_place(rows: Sequence[Sequence[Number]]) -> list[Number]:
        return [common(values) for values in zip(*rows, strict=True)]

    return Lossy(
        signs=tuple(by_place([guess.signs for guess in guesses])),
        torques=by_place([guess.torques for guess in guesses]),
        holding={link: common([guess.holding[link] for guess in guesses]) for link in one.holding},
        flow=tuple(by_place([guess.flow for guess in guesses])),
        losses=by_place([guess.losses for guess in guesses]),
        efficiency=common([guess.efficiency for guess in guesses]),
        drag_losses=guesses[0].drag_losses,
        balance=common([guess.balance for guess in guesses]),
        admissible=False,
    )


def _follow(flow: Flow, start: _Start, moving: Sequence[bool]) -> tuple[Lossy | None, int]:
    """Let the signs follow the flow until they agree.

    Where that runs in a circle only the sign that loses most is turned.
    """
    signs = _possible(flow, start.signs)
    seen: set[Signs] = set()
    for _ in range(ROUNDS):
        lossy = attempt(flow, signs)
        if lossy.admissible:
            return lossy, 1
        turned = _possible(flow, _turned(signs, lossy.flow, moving))
        if turned == signs:
            break
        if turned in seen:
            turned = _worst_turned(flow, signs, turned, lossy)
        if turned in seen:
            break
        seen.add(turned)
        signs = turned
    return None, -1


def _possible(flow: Flow, signs: Signs) -> Signs:
    """The signs, but that no self-locking mechanism is driven back."""
    return tuple(
        1.0 if x < 0 and efficiency.back == 0 else x
        for x, efficiency in zip(signs, flow.efficiencies, strict=True)
    )


def _worst_turned(flow: Flow, signs: Signs, turned: Signs, lossy: Lossy) -> Signs:
    """Of the signs that should turn, only the one whose mechanism gains most."""
    gains = [
        -loss * flow.direction if x != y else -math.inf
        for x, y, loss in zip(signs, turned, lossy.losses, strict=True)
    ]
    worst = max(range(len(gains)), key=gains.__getitem__)
    return tuple(-x if place == worst else x for place, x in enumerate(signs))
