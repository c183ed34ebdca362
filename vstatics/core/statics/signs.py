"""Search for the directions of power through mechanisms that agree with the resulting torques.

The sign x of a mechanism is +1 if power enters by its first link, and -1 if power leaves there.
Without losses, ``x = sign(M (w_f - w_h))``, equation (5) of docs/method.md. If torques with losses
contradict these signs, other signs are searched for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import reduce
from itertools import product
from operator import or_

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
from vstatics.core.start import NamedTuple
from vstatics.core.statics import matrix
from vstatics.core.statics.efficiency import Signs, is_possible
from vstatics.core.statics.ideal import IdealGear, mechanism_torques
from vstatics.core.statics.losses import LossyTorques, no_solution, power_ratio, torques_for_signs
from vstatics.core.statics.power import power
from vstatics.core.statics.torques import Torques

SEARCHED = 12
"""Largest number of mechanisms for which all combinations of signs are tried."""
SIGN_ROUNDS = 200
"""Largest number of iterations for gears with more than `SEARCHED` mechanisms."""


class SignSearch(NamedTuple):
    """Result of the search for signs that agree with the power flow.

    Fields are named as in `Results`.
    """

    lossy: LossyTorques
    idle: list[bool]
    """Flags of mechanisms without power."""
    dragged: bool
    locked: bool
    undecided: bool
    turned: list[Condition]
    choices: int


def find_signs(ideal: IdealGear, *, moving: bool) -> SignSearch:
    """Find the signs that agree with the resulting power flow.

    The signs without losses are tried first, then all combinations of signs. If no signs are
    admissible, both steps are repeated for power that can enter at the output to overcome drag.

    Parameters
    ----------
    moving : bool
        True if speeds and torques without losses exist.
    """
    start = ideal_signs(ideal, moving=moving)
    admissible = Admissible(no_solution(ideal, start.signs))
    if moving and _indeterminate(ideal, start):
        admissible = Admissible(_common_values(ideal, start))
    elif moving:
        admissible = _admissible(ideal, start)
        if admissible.lossy is None and not admissible.cut_short and ideal.drag.external:
            ideal = ideal._replace(overcome=True)
            admissible = _overcome(ideal, start)
    lossy = admissible.lossy or no_solution(ideal, start.signs)
    dragged = lossy.admissible is True and _is_dragged(ideal, lossy)
    if dragged:
        lossy = lossy._replace(efficiency=math.nan)
    elif lossy.admissible is True:
        lossy = lossy._replace(efficiency=power_ratio(ideal, lossy))
    idle = start.idle
    # The sign of a mechanism without power is only a convention, so losses cannot reverse it.
    # Comparing objects first avoids recording a product for signs that did not change.
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
    locked = admissible.lossy is None and not admissible.cut_short
    return SignSearch(
        lossy, idle, dragged, locked, admissible.cut_short, turned, admissible.choices
    )


class IdealSigns(NamedTuple):
    """Signs of power without losses, and the reasons why mechanisms have no power."""

    signs: Signs
    """Sign of the power of each mechanism: +1, -1 or 0; NaN if indeterminate."""
    unloaded: Sequence[bool]
    """Flags of mechanisms without torque."""
    still: Sequence[bool]
    """Flags of mechanisms that are locked up."""

    @property
    def idle(self) -> list[bool]:
        """Flags of mechanisms that transmit no power, so that their sign is a convention."""
        return [a or b for a, b in zip(self.unloaded, self.still, strict=True)]


def ideal_signs(ideal: IdealGear, *, moving: bool) -> IdealSigns:
    """Return the signs of power without losses, by convention for mechanisms without power.

    Parameters
    ----------
    moving : bool
        True if speeds and torques without losses exist.
    """
    if not moving:
        nowhere = [False] * len(ideal.variant.ratios)
        return IdealSigns((math.nan,) * len(nowhere), nowhere, nowhere)
    torques = mechanism_torques(ideal, ideal.variant.columns, ideal.torques_with_drag)
    relative_speeds = ideal.speeds.relative_speeds
    unloaded = [bool(torque == 0) for torque in torques]
    still = [bool(speed == 0) for speed in relative_speeds]
    signs = [
        _sign_of_idle(ideal, place, is_unloaded=unloaded[place])
        if unloaded[place] or still[place]
        else sign(power(torques[place], relative_speeds[place])) * ideal.direction
        for place in range(len(torques))
    ]
    return IdealSigns(tuple(signs), unloaded, still)


def _sign_of_idle(ideal: IdealGear, place: int, *, is_unloaded: bool) -> Number:
    if ideal.case.idle == "exact":
        return 0.0
    published = 1.0 if is_unloaded else sign(ideal.variant.ratios[place])
    return 0.0 if ideal.variant.efficiencies[place].back == 0 and published < 0 else published


class Admissible(NamedTuple):
    """Most efficient of the combinations of signs that agree with the resulting power flow."""

    lossy: LossyTorques | None = None
    """Torques for the signs; None if the gear is self-locking or the search ended early."""
    choices: int = 0
    """Number of admissible combinations of signs."""
    cut_short: bool = False


def _admissible(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """Return the signs without losses if admissible, else the best admissible signs."""
    first = _follow_unloaded(ideal, start)
    if first.admissible:
        return Admissible(first._replace(admissible=True), 1)
    return Admissible() if _always_gains(ideal, first) else _search(ideal, start)


def _always_gains(ideal: IdealGear, lossy: LossyTorques) -> bool:
    """Return whether a converter would produce power for all signs.

    The external torque on the pump determines the torque of a converter if nothing else acts there.
    """
    case, gear = ideal.case, ideal.gear
    loaded = matrix.loaded_devices(case, gear)
    acted = [link for device in loaded for link in ideal.variant.columns[device]]
    acted += [case.gear_output(gear), *matrix.held_links(case, gear)]
    return not ideal.allows_driving and any(
        mechanism.kind == "converter"
        and acted.count(mechanism.first) == 1
        and bool(loss * ideal.direction < 0)
        for mechanism, loss in zip(case.mechanisms, lossy.losses, strict=True)
    )


def _follow_unloaded(ideal: IdealGear, start: IdealSigns) -> LossyTorques:
    """Return the torques for the signs without losses.

    If a mechanism carries torque only because of losses, its sign follows from the torques with
    losses.
    """
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
    """Return the signs, replaced by `directions` that are not 0 where `allowed` is true."""
    return tuple(
        direction if may and abs(direction) == 1 else x
        for x, direction, may in zip(signs, directions, allowed, strict=True)
    )


def _search(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """Try all combinations of signs, or iterate if there are too many mechanisms."""
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
    if reduce(or_, (lossy.admissible for lossy in tried), nothing):
        return _best(ideal, tried, start)
    if not free and any(x for x, still in zip(start.signs, start.still, strict=True) if still):
        # No mechanism with losses has internal motion, so friction cannot lock the gear. The only
        # contradiction comes from the signs assumed for locked-up mechanisms, which therefore count
        # as lossless.
        signs = tuple(
            0.0 if still else x for x, still in zip(start.signs, start.still, strict=True)
        )
        return _search(ideal, start._replace(signs=signs))
    return Admissible()


def _every_set(ideal: IdealGear, start: IdealSigns, free: Sequence[int]) -> Iterator[LossyTorques]:
    """Yield the torques for all possible combinations of signs of the `free` mechanisms.

    In calculations with fractions, floats first rule out combinations that certainly fail.
    """
    rough = _in_floats(ideal)
    for signs_of_free in product((1.0, -1.0), repeat=len(free)):
        signs: list[Number] = list(start.signs)
        for place, x in zip(free, signs_of_free, strict=True):
            signs[place] = x
        possible = is_possible(ideal.variant.efficiencies, tuple(signs))
        if possible and not (rough and _is_refused(rough, tuple(signs))):
            yield torques_for_signs(ideal, tuple(signs))


def _in_floats(ideal: IdealGear) -> IdealGear | None:
    if not any(map(is_exact, ideal.variant.ratios)):
        return None
    from vstatics.core.numerics.exact import rounded  # fractions cost start-up time

    in_floats: IdealGear = rounded(ideal)
    return in_floats


def _is_refused(rough: IdealGear, signs: Signs) -> bool:
    """Return whether signs contradict the power flow by more than rounding can explain."""
    lossy = torques_for_signs(rough, signs)
    known = not any(map(is_nan, lossy.torques.on_first_link))
    return known and lossy.torques.certain and not lossy.admissible


def _best(ideal: IdealGear, tried: Sequence[LossyTorques], start: IdealSigns) -> Admissible:
    """Return the admissible signs that give the largest efficiency.

    Unloaded mechanisms that also have no power with losses keep their conventional sign.
    """
    possible = [lossy for lossy in tried if lossy.admissible is not False]
    flows: dict[tuple[float, ...], Condition] = {}
    for lossy in possible:
        flow = tuple(map(_flow, lossy.signs, lossy.directions))
        flows[flow] = flows.get(flow, False) | lossy.admissible
    choices = counted(flows.values())
    best = reduce(_better, possible)
    if best.admissible is not True:  # the best signs can differ between variants
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
    """Return the sign x, or 0 without power, to count different flows; traced signs count as 1."""
    return (1.0 if is_traced(x) else plain(x)) * (1.0 if is_traced(turns) else plain(turns) ** 2)


def _better(first: LossyTorques, second: LossyTorques) -> LossyTorques:
    """Return the result with the larger efficiency.

    For traced numbers the comparison is recorded, so that each variant has its own result.
    """
    if first.admissible is True and second.admissible is True:
        better = second.efficiency > first.efficiency or not first.efficiency < math.inf
        return second if better else first
    larger = opposite(first.admissible) | (second.efficiency > first.efficiency)
    better_one = second.admissible & larger
    return first._replace(
        signs=tuple(
            chosen(better_one, y, x) for x, y in zip(first.signs, second.signs, strict=True)
        ),
        efficiency=chosen(better_one, second.efficiency, first.efficiency),
        admissible=first.admissible | second.admissible,
    )


def _follow(ideal: IdealGear, start: IdealSigns, moving: Sequence[bool]) -> Admissible:
    """Replace the signs by the resulting directions of power until both agree.

    If the iteration runs in a cycle, only the sign of the mechanism that gains most power is
    reversed.
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
    """Return the signs with +1 for self-locking mechanisms, which cannot be back-driven."""
    return tuple(
        1.0 if efficiency.back == 0 and x < 0 else _decided(x)
        for x, efficiency in zip(signs, ideal.variant.efficiencies, strict=True)
    )


def _decided(x: Number) -> float:
    """Return a sign as a float. A traced sign has the value of the first variant."""
    if is_traced(x):
        return 1.0 if x > 0 else -1.0
    return plain(x)


def _worst_turned(ideal: IdealGear, signs: Signs, turned: Signs, lossy: LossyTorques) -> Signs:
    """Return the signs, reversed only for the mechanism that gains most power."""
    gains = [
        -loss * ideal.direction if x != y else -math.inf
        for x, y, loss in zip(signs, turned, lossy.losses, strict=True)
    ]
    worst = max(range(len(gains)), key=gains.__getitem__)
    return tuple(-x if place == worst else x for place, x in enumerate(signs))


def _overcome(ideal: IdealGear, start: IdealSigns) -> Admissible:
    """Return the signs of a gear if power can enter at the output to overcome drag.

    Without drag the gear must also have admissible signs. Otherwise friction in meshes locks it.
    """
    bare = ideal.without_drag
    without_drag = _admissible(bare, ideal_signs(bare, moving=True))
    return _admissible(ideal, start) if without_drag.lossy else without_drag


def _is_dragged(ideal: IdealGear, lossy: LossyTorques) -> bool:
    """Return whether power enters at the output to overcome drag, and none leaves at the input."""
    if not ideal.drag.external or not (ideal.overcome or is_nan(lossy.efficiency)):
        return False
    case, gear, direction = ideal.case, ideal.gear, ideal.direction
    at_input = ideal.external[case.gear_input(gear)]
    output_speed = ideal.speeds.links[case.gear_output(gear) - 1]
    entering = -power(lossy.torques.on_first_link[-1], output_speed)
    taken = (lossy.drag_losses + lossy.gear_losses) * direction
    return at_input * direction >= 0 and bool(entering * direction > NO_POWER * taken)


def _indeterminate(ideal: IdealGear, start: IdealSigns) -> list[int]:
    """Return the mechanisms with losses whose direction of power is indeterminate."""
    return [
        place
        for place, x in enumerate(start.signs)
        if is_nan(x) and ideal.variant.efficiencies[place].lossy
    ]


def _common_values(ideal: IdealGear, start: IdealSigns) -> LossyTorques:
    """Return the values that are equal for all combinations of indeterminate signs, else NaN.

    Redundant constraints in one train then do not hide the determinate values of other trains.
    """
    none = no_solution(ideal, start.signs)
    open_ = _indeterminate(ideal, start)
    if len(open_) > SEARCHED:
        return none
    tried = list(_every_set(ideal, start, open_))
    if not tried or any(lossy.efficiency <= 0 for lossy in tried):
        return none
    torques = [lossy.torques for lossy in tried]
    return LossyTorques(
        signs=tuple(_common(_common_sign, (lossy.signs for lossy in tried))),
        torques=Torques(
            _common(_common_number, (lossy.on_first_link for lossy in torques)),
            {
                link: _common_number([lossy.holding[link] for lossy in torques])
                for link in none.torques.holding
            },
            consistent=True,
            of_columns=_common(_common_number, (lossy.factors for lossy in torques)),
        ),
        directions=tuple(_common(_common_sign, (lossy.directions for lossy in tried))),
        losses=_common(_common_number, (lossy.losses for lossy in tried)),
        slip_losses=_common(_common_number, (lossy.slip_losses for lossy in tried)),
        efficiency=_common_number([power_ratio(ideal, lossy) for lossy in tried]),
        drag_losses=tried[0].drag_losses,
        gear_losses=tried[0].gear_losses,
        balance=_common_number([lossy.balance for lossy in tried]),
        admissible=False,
    )


def _common(
    value_of: Callable[[Sequence[Number]], Number], rows: Iterable[Sequence[Number]]
) -> list[Number]:
    return [value_of(column) for column in zip(*rows, strict=True)]


def _common_number(values: Sequence[Number | Residual]) -> Number:
    numbers = [value for value in values if not isinstance(value, Residual)]
    if len(numbers) < len(values):
        raise Untraceable
    first = numbers[0]
    size = absolute(first)
    most = size if size > 1 else 1.0  # the input torque and power are 1
    agree = all(absolute(number - first) <= TIE * most for number in numbers)
    return first if agree else math.nan


def _common_sign(values: Sequence[Number]) -> float:
    signs = [_decided(value) for value in values]
    return signs[0] if len(set(signs)) == 1 else math.nan
