"""Signs of the power flow: those without losses, then such as agree with their own torques.

``x = sign(M (w_f - w_h))``: equation (5) of docs/method.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import product
from operator import or_
from typing import NamedTuple

from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual, Untraceable
from vstatics.core.numerics.tolerances import NO_POWER, TIE
from vstatics.core.numerics.traced import (
    Number,
    absolute,
    chosen,
    counted,
    is_exact,
    is_nan,
    is_traced,
    opposite,
    plain,
    sign,
)
from vstatics.core.statics.efficiency import Signs, is_possible
from vstatics.core.statics.ideal import IdealGear, mechanism_torques
from vstatics.core.statics.losses import LossyTorques, no_solution, power_ratio, torques_for_signs
from vstatics.core.statics.matrix import external_torques
from vstatics.core.statics.power import power
from vstatics.core.statics.torques import Torques

SEARCHED = 12
"""Up to so many mechanisms all sets of signs are tried."""
SIGN_ROUNDS = 200
"""So often the signs follow the flow, where there are too many sets to try them all."""


class SignSearch(NamedTuple):
    """What the search for admissible signs ended with; names as in `Results`."""

    lossy: LossyTorques
    idle: list[bool]
    """By mechanism, like `turned`."""
    dragged: bool
    locked: bool
    undecided: bool
    turned: list[Condition]
    choices: int


class Admissible(NamedTuple):
    """Admissible signs of the largest efficiency."""

    lossy: LossyTorques | None = None
    """None: there are none, and friction locks the gear; or the search was cut short."""
    choices: int = 0
    """How many sets of signs are admissible."""
    cut_short: bool = False


def find_signs(ideal: IdealGear, *, moving: bool) -> SignSearch:
    """Find the signs that agree with the flow they lead to.

    The signs without losses are tried first, then all sets of signs, then both where the output
    may overcome drag.

    Parameters
    ----------
    moving : bool
        Whether speeds, and torques without losses, exist.
    """
    start = ideal_signs(ideal, moving=moving)
    found = Admissible(no_solution(ideal, start.signs))
    if moving and _open(ideal, start):
        found = Admissible(_common(ideal, start))
    elif moving:
        found = _admissible(ideal, start)
        if found.lossy is None and not found.cut_short and ideal.drag.losses:
            ideal = ideal._replace(overcome=True)
            found = _overcome(ideal, start)
    lossy = found.lossy or no_solution(ideal, start.signs)
    dragged = lossy.admissible is True and _is_dragged(ideal, lossy)
    if dragged:
        lossy = lossy._replace(efficiency=math.nan)
    elif lossy.admissible is True:
        lossy = lossy._replace(efficiency=power_ratio(ideal, lossy))
    idle = start.idle
    # of an idle one the sign is a convention; one object stands for what no search has changed
    turned = [
        lossy.admissible is True
        and not is_idle
        and x is not before
        and efficiency.lossy
        and x * before < 0
        for is_idle, x, before, efficiency in zip(
            idle, lossy.signs, start.signs, ideal.variant.efficiencies, strict=True
        )
    ]
    locked = found.lossy is None and not found.cut_short
    return SignSearch(lossy, idle, dragged, locked, found.cut_short, turned, found.choices)


def _admissible(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """The signs without losses if they agree with their flow, else the best that do."""
    first = _follow_unloaded(ideal, start)
    if first.admissible:
        return Admissible(first._replace(admissible=True), 1)
    return _search(ideal, start)


def _overcome(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """Signs of a gear whose drag the output may overcome; none if friction alone locks it."""
    bare = ideal.without_drag._replace(overcome=False)
    alone = _admissible(bare, ideal_signs(bare, moving=True))
    return _admissible(ideal, start) if alone.lossy else alone


def _is_dragged(ideal: IdealGear, lossy: LossyTorques) -> bool:
    """Whether power enters at the output to overcome drag, and none leaves at the input."""
    if not ideal.drag.losses or not (ideal.overcome or is_nan(lossy.efficiency)):
        return False
    case, gear, direction = ideal.case, ideal.gear, ideal.direction
    at_input = external_torques(case, gear)[case.gear_input(gear)]
    output_speed = ideal.speeds.links[case.gear_output(gear) - 1]
    entering = -power(lossy.torques.on_first_link[-1], output_speed)
    taken = lossy.drag_losses * direction
    return at_input * direction >= 0 and bool(entering * direction > NO_POWER * taken)


def _open(ideal: IdealGear, start: IdealSigns) -> list[int]:
    """Mechanisms with losses whose direction of power statics leaves open."""
    return [
        place
        for place, x in enumerate(start.signs)
        if is_nan(x) and ideal.variant.efficiencies[place].lossy
    ]


def _follow_unloaded(ideal: IdealGear, start: IdealSigns) -> LossyTorques:
    """The signs without losses; unloaded mechanisms take the sign of their flow with losses."""
    signs = start.signs
    lossy = torques_for_signs(ideal, signs)
    for _ in signs:
        followed = _turned(signs, lossy.directions, start.unloaded)
        if followed == signs:
            break
        signs = followed
        lossy = torques_for_signs(ideal, signs)
    return lossy


def _turned(signs: Signs, directions: Signs, allowed: Sequence[bool]) -> Signs:
    """The signs with those of the flow where that is allowed and there is any."""
    return tuple(
        direction if may and abs(direction) == 1 else x
        for x, direction, may in zip(signs, directions, allowed, strict=True)
    )


def _search(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """Try all sets of signs of the mechanisms that move, or follow the flow if there are many."""
    moving = [
        not still and efficiency.lossy
        for still, efficiency in zip(start.still, ideal.variant.efficiencies, strict=True)
    ]
    free = [place for place, moves in enumerate(moving) if moves]
    if len(free) > SEARCHED:
        free = [place for place in free if not start.unloaded[place]]
    if len(free) > SEARCHED:
        return _follow(ideal, start, moving)
    tried = list(_every_set(ideal, start, free))
    nothing: Condition = False
    if reduce(or_, (one.admissible for one in tried), nothing):
        return _best(ideal, tried, start)
    if not free and any(x for x, still in zip(start.signs, start.still, strict=True) if still):
        # nothing moves that could lock: the convention for idle mechanisms does not suit
        signs = tuple(
            0.0 if still else x for x, still in zip(start.signs, start.still, strict=True)
        )
        return _search(ideal, start._replace(signs=signs))
    return Admissible()


def _best(ideal: IdealGear, tried: Sequence[LossyTorques], start: IdealSigns) -> Admissible:
    """The admissible signs of the largest efficiency; those that turn nothing are as they were."""
    possible = [one for one in tried if one.admissible is not False]
    flows: dict[tuple[float, ...], Condition] = {}
    for one in possible:
        flow = tuple(map(_flow, one.signs, one.directions))
        flows[flow] = flows.get(flow, False) | one.admissible
    choices = counted(flows.values())
    best = reduce(_better, possible)
    if best.admissible is not True:  # one set of signs or another, by variant
        best = torques_for_signs(ideal, best.signs)
        if not best.admissible:
            raise Untraceable
    signs = tuple(
        before if unloaded and turns == 0 else x
        for x, before, unloaded, turns in zip(
            best.signs, start.signs, start.unloaded, best.directions, strict=True
        )
    )
    return Admissible(best._replace(signs=signs, admissible=True), choices)


def _flow(x: Number, turns: Number) -> float:
    """What tells a flow from others: its sign, 0 where nothing flows, or what all of them have."""
    return (1.0 if is_traced(x) else plain(x)) * (1.0 if is_traced(turns) else plain(turns) ** 2)


def _better(one: LossyTorques, other: LossyTorques) -> LossyTorques:
    """The one with the larger efficiency, in each variant in which both are admissible."""
    if one.admissible is True and other.admissible is True:
        better = other.efficiency > one.efficiency or not one.efficiency < math.inf
        return other if better else one
    larger = opposite(one.admissible) | (other.efficiency > one.efficiency)
    better_one = other.admissible & larger
    return one._replace(
        signs=tuple(chosen(better_one, y, x) for x, y in zip(one.signs, other.signs, strict=True)),
        efficiency=chosen(better_one, other.efficiency, one.efficiency),
        admissible=one.admissible | other.admissible,
    )


def _every_set(ideal: IdealGear, start: IdealSigns, free: Sequence[int]) -> Iterator[LossyTorques]:
    """The torques for all possible sets of signs of the `free` mechanisms.

    Of those in fractions, which take long, not such as floats refuse for certain.
    """
    rough = _in_floats(ideal)
    for own in product((1.0, -1.0), repeat=len(free)):
        signs: list[Number] = list(start.signs)
        for place, x in zip(free, own, strict=True):
            signs[place] = x
        possible = is_possible(ideal.variant.efficiencies, tuple(signs))
        if possible and not (rough and _is_refused(rough, tuple(signs))):
            yield torques_for_signs(ideal, tuple(signs))


def _in_floats(ideal: IdealGear) -> IdealGear | None:
    """A gear that is calculated in fractions, rounded; nothing for another one."""
    if not any(map(is_exact, ideal.variant.ratios)):
        return None
    from vstatics.core.numerics.exact import rounded  # fractions cost start-up time

    made: IdealGear = rounded(ideal)
    return made


def _is_refused(rough: IdealGear, signs: Signs) -> bool:
    """Whether signs do not agree with their flow, and rounding leaves no doubt of it."""
    lossy = torques_for_signs(rough, signs)
    known = not any(map(is_nan, lossy.torques.on_first_link))
    return known and lossy.torques.certain and not lossy.admissible


def _common(ideal: IdealGear, start: IdealSigns) -> LossyTorques:
    """What all sets of signs lead to, where statics leaves the flow through mechanisms open.

    So a redundant part of a train does not hide what is determined in the rest of it.
    """
    none = no_solution(ideal, start.signs)
    open_ = _open(ideal, start)
    if len(open_) > SEARCHED:
        return none
    tried = list(_every_set(ideal, start, open_))
    if not tried or any(one.efficiency <= 0 for one in tried):
        return none
    torques = [one.torques for one in tried]
    return LossyTorques(
        signs=tuple(map(_same_sign, zip(*(one.signs for one in tried), strict=True))),
        torques=Torques(
            list(map(_same, zip(*(one.on_first_link for one in torques), strict=True))),
            {link: _same([one.holding[link] for one in torques]) for link in none.torques.holding},
            consistent=True,
            of_columns=list(map(_same, zip(*(one.factors for one in torques), strict=True))),
        ),
        directions=tuple(map(_same_sign, zip(*(one.directions for one in tried), strict=True))),
        losses=list(map(_same, zip(*(one.losses for one in tried), strict=True))),
        efficiency=_same([power_ratio(ideal, one) for one in tried]),
        drag_losses=tried[0].drag_losses,
        balance=_same([one.balance for one in tried]),
        admissible=False,
    )


def _same(values: Sequence[Number | Residual]) -> Number:
    """The number that all of some are, to rounding; else NaN."""
    numbers = [value for value in values if not isinstance(value, Residual)]
    if len(numbers) < len(values):
        raise Untraceable
    first = numbers[0]
    size = absolute(first)
    most = size if size > 1 else 1.0  # the input is 1
    agree = all(absolute(number - first) <= TIE * most for number in numbers)
    return first if agree else math.nan


def _same_sign(values: Sequence[Number]) -> float:
    """The sign that all of some are; else NaN."""
    own = [_decided(value) for value in values]
    return own[0] if len(set(own)) == 1 else math.nan


def _decided(x: Number) -> float:
    """A sign, that of the first variant for all."""
    if is_traced(x):
        return 1.0 if x > 0 else -1.0
    return plain(x)


def _follow(ideal: IdealGear, start: IdealSigns, moving: Sequence[bool]) -> Admissible:
    """Let the signs follow the flow until they agree.

    Where that runs in a circle only the sign that loses most is turned.
    """
    signs = _possible(ideal, start.signs)
    seen: set[Signs] = set()
    for _ in range(SIGN_ROUNDS):
        lossy = torques_for_signs(ideal, signs)
        if lossy.admissible:
            return Admissible(lossy, 1)
        turned = _possible(ideal, _turned(signs, lossy.directions, moving))
        if turned == signs:
            break
        if turned in seen:
            turned = _worst_turned(ideal, signs, turned, lossy)
        if turned in seen:
            break
        seen.add(turned)
        signs = turned
    return Admissible(cut_short=True)


def _possible(ideal: IdealGear, signs: Signs) -> Signs:
    """The signs, but that no self-locking mechanism is driven back."""
    return tuple(
        1.0 if efficiency.back == 0 and x < 0 else _decided(x)
        for x, efficiency in zip(signs, ideal.variant.efficiencies, strict=True)
    )


def _worst_turned(ideal: IdealGear, signs: Signs, turned: Signs, lossy: LossyTorques) -> Signs:
    """Of the signs that should turn, only the one whose mechanism gains most."""
    gains = [
        -loss * ideal.direction if x != y else -math.inf
        for x, y, loss in zip(signs, turned, lossy.losses, strict=True)
    ]
    worst = max(range(len(gains)), key=gains.__getitem__)
    return tuple(-x if place == worst else x for place, x in enumerate(signs))


class IdealSigns(NamedTuple):
    """By mechanism: the sign that the flow without losses gives, and why it may give none."""

    signs: Signs
    """+1, -1 or 0; NaN where torque or motion is not determined."""
    unloaded: Sequence[bool]
    """It carries no torque."""
    still: Sequence[bool]
    """It turns as one piece."""

    @property
    def idle(self) -> list[bool]:
        """Whether there is no flow that could give a sign."""
        return [a or b for a, b in zip(self.unloaded, self.still, strict=True)]


def ideal_signs(ideal: IdealGear, *, moving: bool) -> IdealSigns:
    """Signs by the closed form, equation (5); ties by convention.

    Parameters
    ----------
    moving : bool
        Whether speeds, and torques without losses, exist.
    """
    if not moving:
        none = [False] * len(ideal.variant.ratios)
        return IdealSigns((math.nan,) * len(none), none, none)
    torques = mechanism_torques(ideal, ideal.variant.columns, ideal.torques_with_drag)
    relative_speeds = ideal.speeds.relative_speeds
    unloaded = [bool(torque == 0) for torque in torques]
    still = [bool(speed == 0) for speed in relative_speeds]
    signs = [
        _of_idle(ideal, place, is_unloaded=unloaded[place])
        if unloaded[place] or still[place]
        else sign(power(torques[place], relative_speeds[place])) * ideal.direction
        for place in range(len(torques))
    ]
    return IdealSigns(tuple(signs), unloaded, still)


def _of_idle(ideal: IdealGear, place: int, *, is_unloaded: bool) -> Number:
    """The sign of an idle mechanism by the convention of the case."""
    if ideal.case.idle == "exact":
        return 0.0
    published = 1.0 if is_unloaded else sign(ideal.variant.ratios[place])
    return 0.0 if ideal.variant.efficiencies[place].back == 0 and published < 0 else published
