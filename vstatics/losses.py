"""Losses of a gear: signs of the power flow, torques with losses, efficiency.

With losses the internal ratio u of a mechanism becomes ``u * efficiency**x`` in the
torque system; x is +1 where power enters by the first link, seen from the third, and
-1 where it leaves by it (closed form of the published test: docs/method.md).
All arrays have the variants as their last axis.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

import numpy as np

from vstatics import elimination, matrix
from vstatics.model import HOUSING, Gear, Transmission
from vstatics.results import Booleans, Floats, Integers

TIE = 1e-9
"""Speeds, or torques on a link, that differ by less than this part are the same."""
SEARCHED = 12
"""Up to so many mechanisms all sets of signs are tried."""
ROUNDS = 200
"""So often the signs follow the flow, where there are too many sets to try them all."""


class Flow(NamedTuple):
    """A gear without losses: what decides where power enters each mechanism."""

    case: Transmission
    gear: Gear
    ratios: Floats
    efficiencies: Floats
    speeds: Floats
    """(links, variants)."""
    motion: Floats
    """(mechanisms, variants): speed of the first link against the third, 0 if a tie."""
    torques: Floats
    """(devices + 1, variants)."""
    holding: Floats
    """(links, variants)."""

    def part(self, chosen: Integers) -> Flow:
        """The flow of some variants; one may be chosen more than once."""
        arrays = [value[:, chosen] for value in self[2:]]
        return Flow(self.case, self.gear, *arrays)

    @property
    def direction(self) -> int:
        """+1, or -1 when coasting: all flows turn."""
        return -1 if self.case.coast else 1


class Lossy(NamedTuple):
    """A gear with losses under one set of signs for each variant."""

    signs: Floats
    torques: Floats
    holding: Floats
    flow: Floats
    """(mechanisms, variants): sign of the power by the first link, +1, 0, -1 or NaN."""
    losses: Floats
    efficiency: Floats
    balance: Floats
    admissible: Booleans


class Outcome(NamedTuple):
    """What the search for admissible signs ended with."""

    lossy: Lossy
    idle: Booleans
    locked: Booleans
    undecided: Booleans
    turned: Booleans
    choices: Integers


def motion(flow_speeds: Floats, case: Transmission, difference: Floats) -> Floats:
    """Speed of each first link against the third, 0 where it is a tie.

    Parameters
    ----------
    flow_speeds : ndarray, shape (links, variants)
    difference : ndarray, shape (mechanisms, variants)
        ``w_first - w_third`` as solved; it may exist where the speeds do not.
    """
    still = np.zeros((1, flow_speeds.shape[1]))
    speeds = np.concatenate([still, np.abs(flow_speeds)])
    first = speeds[[mechanism.first for mechanism in case.mechanisms]]
    third = speeds[[mechanism.third for mechanism in case.mechanisms]]
    tie = np.abs(difference) <= TIE * np.fmax(first, third)
    return np.where(tie, 0.0, difference)


def loaded(flow: Flow, ratios: Floats, torques: Floats, holding: Floats) -> Floats:
    """Torque on the first link of each mechanism, 0 where it is a tie.

    It is a tie when on each of its links the mechanism's torque is nothing beside the
    other torques there: so a stage of a large ratio is measured by its own links.
    """
    case, gear = flow.case, flow.gear
    elements = len(case.shift_elements)
    columns = matrix.columns(case, list(ratios))
    acting: list[list[tuple[int, Floats]]] = [[] for _ in range(case.links + 1)]
    for device, column in enumerate(columns):
        for link, (value, _) in column.items():
            acting[link].append((device, np.abs(value * torques[device])))
    acting[case.gear_output(gear)].append((-1, np.abs(torques[-1])))
    for link, torque in matrix.external_torques(case, gear).items():
        acting[link].append((-1, np.full(torques.shape[1], abs(torque))))
    for link in matrix.held_links(case, gear):
        acting[link].append((-1, np.abs(holding[link - 1])))
    found = torques[elements:-1].copy()
    for number, mechanism in enumerate(case.mechanisms):
        tie = np.ones(torques.shape[1], dtype=np.bool_)
        for link in mechanism.links:
            if link != HOUSING:
                own = [size for device, size in acting[link] if device == elements + number]
                rest = [size for device, size in acting[link] if device != elements + number]
                largest = np.fmax.reduce(rest) if rest else np.zeros(torques.shape[1])
                tie &= own[0] <= TIE * largest
        found[number, tie] = 0.0
    return found


def powers(flow: Flow, torques: Floats, holding: Floats) -> Floats:
    """Power that enters by each port: shape (links, variants); 0 where there is none."""
    case, gear = flow.case, flow.gear
    external = np.zeros_like(flow.speeds)
    for link, torque in matrix.external_torques(case, gear).items():
        external[link - 1] = torque
    for link in matrix.held_links(case, gear):
        external[link - 1] = holding[link - 1]
    external[case.gear_output(gear) - 1] -= torques[-1]
    return _power(external, flow.speeds)


def _power(torque: Floats, speed: Floats) -> Floats:
    """Torque times speed, 0 where one of them is 0 even if the other does not exist."""
    power: Floats = np.where((torque == 0) | (speed == 0), 0.0, torque * speed)
    return power


def _efficiency(flow: Flow, torques: Floats, entering: Floats) -> Floats:
    """Efficiency by the ports, which the flow without losses divides in two.

    With one input and one output it is ``Mx_lossy/Mx``, or its inverse when coasting.
    Otherwise power out by power in, each port on the side of its flow without losses;
    a port without any takes the side of its flow with losses.
    """
    if not flow.gear.speeds and not flow.gear.torques:
        return (torques[-1] / flow.torques[-1]) ** flow.direction
    ideal = powers(flow, flow.torques, flow.holding)
    side = np.where(ideal == 0, entering, ideal) * flow.direction
    received = np.sum(np.where(side > 0, entering, 0.0), axis=0)
    given = -np.sum(np.where(side < 0, entering, 0.0), axis=0)
    unknown = np.isnan(side).any(axis=0)
    efficiency: Floats = np.where(unknown, np.nan, given / received)
    return efficiency


def attempt(flow: Flow, signs: Floats) -> Lossy:
    """Torques with losses under given signs, and whether the signs agree with the flow.

    A set of signs is admissible when the loss of every mechanism is not negative, which
    is the same as: its sign is that of its flow, or its flow is 0; and when the
    efficiency is above 0 (where there is one without losses).
    """
    ratios = flow.ratios * flow.efficiencies**signs
    torques, holding = solve_torques(flow.case, flow.gear, ratios)
    power = _power(loaded(flow, ratios, torques, holding), flow.motion)
    losses = power * (1 - flow.efficiencies**signs)
    entering = powers(flow, torques, holding)
    efficiency = _efficiency(flow, torques, entering)
    agrees = (power * signs * flow.direction >= 0) | (flow.efficiencies == 1)
    return Lossy(
        signs=signs,
        torques=torques,
        holding=holding,
        flow=np.sign(power * flow.direction),
        losses=losses,
        efficiency=efficiency,
        balance=np.sum(entering, axis=0) - np.sum(losses, axis=0),
        admissible=agrees.all(axis=0) & ((efficiency > 0) | ~_passes_power(flow)),
    )


def _passes_power(flow: Flow) -> Booleans:
    """Whether the gear has an efficiency without losses, which is then 1."""
    entering = powers(flow, flow.torques, flow.holding)
    return np.isfinite(_efficiency(flow, flow.torques, entering))


def solve_torques(case: Transmission, gear: Gear, ratios: Floats) -> tuple[Floats, Floats]:
    """Torques of a gear when the internal ratios of the torques are `ratios`.

    Parameters
    ----------
    ratios : ndarray, shape (mechanisms, variants)

    Returns
    -------
    torques : ndarray, shape (devices + 1, variants)
        On the first link of each device, 0 on an element that is not engaged; then the
        output torque. NaN where there is no single value.
    holding : ndarray, shape (links, variants)
        External torque on each link with a given speed, NaN on the others.
    """
    columns = matrix.columns(case, list(ratios))
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    variants = ratios.shape[1]
    rows = matrix.torque_rows(case, gear, columns)
    solution = elimination.solve(rows, len(devices) + 1 + len(held), variants=variants)
    torques = np.where(solution.consistent, 0.0, np.nan) * np.ones((len(columns) + 1, 1))
    torques[[*devices, len(columns)]] = solution.values[: len(devices) + 1]
    holding = np.full((case.links, variants), np.nan)
    holding[[link - 1 for link in held]] = solution.values[len(devices) + 1 :]
    return torques, holding


class _Start(NamedTuple):
    """The signs that the flow without losses gives, (mechanisms, variants) each."""

    signs: Floats
    unloaded: Booleans
    still: Booleans

    def part(self, chosen: Integers) -> _Start:
        return _Start(self.signs[:, chosen], self.unloaded[:, chosen], self.still[:, chosen])


def _start(flow: Flow) -> _Start:
    """Signs by the closed form ``x = sign(M (w_first - w_third))``, ties by convention.

    NaN where torque or motion is not determined.
    """
    torque = loaded(flow, flow.ratios, flow.torques, flow.holding)
    unloaded, still = torque == 0, flow.motion == 0
    signs = np.sign(_power(torque, flow.motion)) * flow.direction
    if flow.case.idle == "published":
        signs = np.where(still, np.sign(flow.ratios), signs)
        signs = np.where(unloaded, 1.0, signs)
    else:
        signs = np.where(still | unloaded, 0.0, signs)
    return _Start(signs, unloaded, still)


def search(flow: Flow, balanced: Booleans) -> Outcome:
    """Find the signs that agree with the flow they lead to, variant by variant.

    The signs without losses are tried first, then all sets of signs.

    Parameters
    ----------
    balanced : ndarray, shape (variants,)
        Where torques without losses exist.
    """
    start = _start(flow)
    unknown = np.isnan(start.signs) & (flow.efficiencies < 1)
    known = balanced & ~unknown.any(axis=0)
    variants = known.size
    lossy = _nothing(flow, start.signs)
    locked, undecided = np.zeros((2, variants), dtype=np.bool_)
    choices = np.zeros(variants, dtype=np.int64)
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
    sets = np.array(list(product((1.0, -1.0), repeat=free.size))).T.reshape(free.size, -1)
    all_of_them = np.zeros(sets.shape[1], dtype=np.int64)
    signs = start.signs[:, all_of_them]
    signs[free] = sets
    lossy = attempt(flow.part(all_of_them), signs)
    found = np.nonzero(lossy.admissible)[0]
    if not found.size:
        return None, 0
    flows = {tuple(column) for column in (lossy.signs * lossy.flow**2)[:, found].T}
    best = found[np.argmax(np.nan_to_num(lossy.efficiency[found], nan=-np.inf))]
    idle = start.unloaded & (lossy.flow[:, [best]] == 0)
    one = _nothing(flow, start.signs)
    _put(one, np.array([0]), lossy, np.array([best]))
    return one._replace(signs=np.where(idle, start.signs, one.signs)), len(flows)


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


def signs_matter(flow: Flow, outcome: Outcome) -> list[int]:
    """Mechanisms idle by coincidence: their sign changes torque or efficiency of the gear.

    One variant only. Where engaged elements hold a mechanism as one piece nothing
    depends on its sign; in a balanced differential, say, it does.
    """
    found = []
    for number in np.nonzero(outcome.idle[:, 0] & (flow.efficiencies[:, 0] < 1))[0]:
        signs = outcome.lossy.signs[:, [0, 0]]
        signs[number] = 1.0, -1.0
        both = attempt(flow.part(np.array([0, 0])), signs)
        for one, other in (both.efficiency, both.torques[-1]):
            if abs(one - other) > TIE * abs(one) and number not in found:
                found.append(int(number))
    return found
