"""Signs of the power flow: the closed form, and the search where losses turn a flow.

Source of the closed form and its proof: docs/method.md. All arrays have the variants
as their last axis.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np

from vstatics.arrays import Booleans, Floats, Integers
from vstatics.losses import Flow, Lossy, attempt, loaded, power
from vstatics.speeds import TIE

SEARCHED = 12
"""Up to so many mechanisms all sets of signs are tried."""
ROUNDS = 200
"""So often the signs follow the flow, where there are too many sets to try them all."""


class Outcome(NamedTuple):
    """What the search for admissible signs ended with; names as in `Results`."""

    lossy: Lossy
    idle: Booleans
    """(mechanisms, variants), like `turned`; the others are (variants,)."""
    locked: Booleans
    undecided: Booleans
    turned: Booleans
    choices: Integers


class _Start(NamedTuple):
    """The signs that the flow without losses gives, (mechanisms, variants) each."""

    signs: Floats
    unloaded: Booleans
    still: Booleans

    def part(self, chosen: Integers) -> _Start:
        return _Start(self.signs[:, chosen], self.unloaded[:, chosen], self.still[:, chosen])


def _start(flow: Flow, moving: Booleans) -> _Start:
    """Signs by the closed form ``x = sign(M (w_first - w_third))``, ties by convention.

    NaN where torque or motion is not determined.
    """
    torque = loaded(flow, flow.ratios, flow.torques, flow.holding)
    unloaded, still = (torque == 0) & moving, (flow.motion == 0) & moving
    signs = np.sign(power(torque, flow.motion)) * flow.direction
    if flow.case.idle == "published":
        signs = np.where(still, np.sign(flow.ratios), signs)
        signs = np.where(unloaded, 1.0, signs)
    else:
        signs = np.where(still | unloaded, 0.0, signs)
    signs[:, ~moving] = np.nan
    return _Start(signs, unloaded, still)


def search(flow: Flow, moving: Booleans) -> Outcome:
    """Find the signs that agree with the flow they lead to, variant by variant.

    The signs without losses are tried first, then all sets of signs.

    Parameters
    ----------
    moving : ndarray, shape (variants,)
        Where speeds, and torques without losses, exist.
    """
    start = _start(flow, moving)
    unknown = np.isnan(start.signs) & (flow.efficiencies < 1)
    known = moving & ~unknown.any(axis=0)
    variants = known.size
    lossy = _nothing(flow, start.signs)
    locked, undecided = np.zeros((2, variants), dtype=np.bool_)
    choices = np.zeros(variants, dtype=np.int64)
    for variant in np.nonzero(moving & ~known)[0]:
        here = np.array([variant])
        _put(lossy, here, _guess(flow.part(here), start.part(here)), np.array([0]))
    chosen = np.nonzero(known)[0]
    if chosen.size:
        first = _follow_unloaded(flow.part(chosen), start.part(chosen))
        _put(lossy, chosen[first.admissible], first, np.nonzero(first.admissible)[0])
        choices[chosen[first.admissible]] = 1
        for variant in chosen[~first.admissible]:
            here = np.array([variant])
            found, count = _search_one(flow.part(here), start.part(here))
            choices[variant] = count
            undecided[variant] = found is None and count < 0
            locked[variant] = found is None and count == 0
            if found is not None:
                _put(lossy, here, found, np.array([0]))
    np.maximum(choices, 0, out=choices)
    idle = start.unloaded | start.still
    turned = lossy.admissible & ~idle & (lossy.signs != start.signs) & (flow.efficiencies < 1)
    return Outcome(lossy, idle, locked, undecided, turned, choices)


def _nothing(flow: Flow, signs: Floats) -> Lossy:
    """No lossy torques at all; the signs without losses."""
    variants = signs.shape[1]
    nan = np.full(variants, np.nan)
    return Lossy(
        signs=signs.copy(),
        torques=np.full_like(flow.torques, np.nan),
        holding=np.full_like(flow.holding, np.nan),
        flow=np.full_like(signs, np.nan),
        losses=np.full_like(signs, np.nan),
        efficiency=nan.copy(),
        balance=nan.copy(),
        admissible=np.zeros(variants, dtype=np.bool_),
    )


def _put(into: Lossy, variants: Integers, found: Lossy, chosen: Integers) -> None:
    """Copy some variants of what was found to their place."""
    for target, value in zip(into, found, strict=True):
        target[..., variants] = value[..., chosen]


def _follow_unloaded(flow: Flow, start: _Start) -> Lossy:
    """The signs without losses; unloaded mechanisms take the sign of their lossy flow."""
    signs = start.signs
    lossy = attempt(flow, signs)
    for _ in flow.case.mechanisms:
        turns = start.unloaded & (np.abs(lossy.flow) == 1) & (lossy.flow != signs)
        if not turns.any():
            break
        signs = np.where(turns, lossy.flow, signs)
        lossy = attempt(flow, signs)
    return lossy


def _search_one(flow: Flow, start: _Start) -> tuple[Lossy | None, int]:
    """Admissible signs of the largest efficiency for one variant, and how many there are.

    The count is -1 where the search was cut short.
    """
    moving = ~start.still[:, 0] & (flow.efficiencies[:, 0] < 1)
    free = np.nonzero(moving)[0]
    if free.size > SEARCHED:
        free = np.nonzero(moving & ~start.unloaded[:, 0])[0]
    if free.size > SEARCHED:
        return _follow(flow, start, moving)
    lossy = _attempt_all(flow, start, free)
    found = np.nonzero(lossy.admissible)[0]
    if not found.size:
        if not free.size and start.signs[start.still].any():
            # nothing moves that could lock: the convention for idle mechanisms does not suit
            return _search_one(flow, start._replace(signs=np.where(start.still, 0.0, start.signs)))
        return None, 0
    flows = {tuple(column) for column in (lossy.signs * lossy.flow**2)[:, found].T}
    best = found[np.argmax(np.nan_to_num(lossy.efficiency[found], nan=-np.inf))]
    idle = start.unloaded & (lossy.flow[:, [best]] == 0)
    one = _nothing(flow, start.signs)
    _put(one, np.array([0]), lossy, np.array([best]))
    return one._replace(signs=np.where(idle, start.signs, one.signs)), len(flows)


def _attempt_all(flow: Flow, start: _Start, free: Integers) -> Lossy:
    """All sets of signs of the `free` mechanisms of one variant, as variants."""
    sets = np.array(list(product((1.0, -1.0), repeat=free.size))).T.reshape(free.size, 2**free.size)
    many = np.zeros(sets.shape[1], dtype=np.int64)
    signs = start.signs[:, many]
    signs[free] = sets
    return attempt(flow.part(many), signs)


def _guess(flow: Flow, start: _Start) -> Lossy:
    """What every guess leads to, where statics leaves the flow through mechanisms open.

    So a redundant part of a train does not hide what is determined in the rest of it.
    """
    open_ = np.nonzero(np.isnan(start.signs[:, 0]) & (flow.efficiencies[:, 0] < 1))[0]
    one = _nothing(flow, start.signs)
    if open_.size > SEARCHED:
        return one
    lossy = _attempt_all(flow, start, open_)
    if not (lossy.efficiency <= 0).any():
        for into, values in zip(one[:-1], lossy[:-1], strict=True):
            first = values[..., :1]
            agree = np.abs(values - first) <= TIE * np.fmax(np.abs(first), 1.0)  # the input is 1
            into[...] = np.where(agree.all(axis=-1, keepdims=True), first, np.nan)
    return one


def _follow(flow: Flow, start: _Start, moving: Booleans) -> tuple[Lossy | None, int]:
    """Let the signs follow the flow until they agree.

    Where that runs in a circle only the sign that loses most is turned.
    """
    signs = start.signs
    seen: set[bytes] = set()
    for _ in range(ROUNDS):
        lossy = attempt(flow, signs)
        if lossy.admissible[0]:
            return lossy, 1
        turns = moving[:, None] & (np.abs(lossy.flow) == 1) & (lossy.flow != signs)
        if not turns.any():
            break
        turned = np.where(turns, lossy.flow, signs)
        if turned.tobytes() in seen:
            gains = np.where(turns, -lossy.losses * flow.direction, -np.inf)
            worst = np.argmax(gains)
            turned = signs.copy()
            turned[worst] = -turned[worst]
        if turned.tobytes() in seen:
            break
        seen.add(turned.tobytes())
        signs = turned
    return None, -1
