"""Losses of a gear under given signs of the power flow: torques, efficiency, balance.

The torque system is solved with ``u * efficiency**x`` in place of u; the power lost in a
mechanism is ``M' (w_f - w_h) (1 - efficiency**x)``, equation (2) of docs/method.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number, absolute, chosen, is_nan, residual, sign
from vstatics.core.statics.efficiency import Signs, is_possible, lossy_ratios, passed
from vstatics.core.statics.ideal import IdealGear, converter_slip, mechanism_torques, no_torques
from vstatics.core.statics.matrix import Column, columns
from vstatics.core.statics.power import entering_powers, power
from vstatics.core.statics.torques import Torques, solve_torques


class LossyTorques(NamedTuple):
    """Torques of a gear with losses under one set of signs, and what follows from them."""

    signs: Signs
    torques: Torques
    directions: Signs
    """By mechanism: sign of the power by the first link, +1, 0, -1 or NaN."""
    losses: Sequence[Number]
    """By mechanism, power. [-]"""
    efficiency: Number
    """[-]"""
    drag_losses: Number
    """Power that drag takes in all. [-]"""
    balance: Number | Residual
    """External power less all losses. [-]"""
    admissible: Condition
    """The signs agree with the directions of power."""


def torques_for_signs(ideal: IdealGear, signs: Signs) -> LossyTorques:
    """Torques with losses under given signs, and whether the signs agree with the flow.

    Power that flows back through a self-locking mechanism is never admissible.
    """
    if not is_possible(ideal.variant.efficiencies, signs):
        return no_solution(ideal, signs)
    ratios = lossy_ratios(ideal.variant.ratios, ideal.variant.efficiencies, signs)
    lossy_columns = columns(ideal.case, ratios)
    torques = solve_torques(ideal.case, ideal.gear, lossy_columns, ideal.drag)
    return check_signs(ideal, signs, lossy_columns, torques)


def check_signs(
    ideal: IdealGear, signs: Signs, lossy_columns: Sequence[Column], torques: Torques
) -> LossyTorques:
    """What torques with losses mean: losses, efficiency, and whether the signs agree.

    A set of signs is admissible when the sign of every mechanism with losses is that of its
    flow, or one of the two is 0; and when the efficiency is above 0 (where there is one
    without losses, and drag is not overcome from the output).
    """
    on_first_link = mechanism_torques(ideal, lossy_columns, torques)
    by_first_link = list(map(power, on_first_link, ideal.speeds.relative_speeds))
    losses = list(_losses(by_first_link, ideal, signs))
    entering = _entering(ideal, torques)
    efficiency = _efficiency(ideal, torques, entering)
    way = ideal.direction
    directions = tuple(sign(entered) * way for entered in by_first_link)
    agrees: Condition = True
    for x, direction, own in zip(signs, directions, ideal.variant.efficiencies, strict=True):
        if not (x == 0 or own.lossless):
            agrees = agrees & (x * direction >= 0)
    for one, loss in zip(ideal.case.mechanisms, losses, strict=True):
        if one.kind == "converter":
            agrees = agrees & (loss * way >= 0)
    passes = ideal.overcome or (efficiency > 0) & (efficiency < math.inf)
    if passes is False:  # of one variant; those of a plan all pass power, or none of them does
        passes = not _passes_power(ideal)
    return LossyTorques(
        signs=signs,
        torques=torques,
        directions=directions,
        losses=losses,
        efficiency=efficiency,
        drag_losses=sum(ideal.drag.losses, 0.0),
        balance=residual([*entering, *(-loss for loss in (*losses, *ideal.drag.losses))]),
        admissible=agrees & passes,
    )


def no_solution(ideal: IdealGear, signs: Signs) -> LossyTorques:
    """No lossy torques at all."""
    nan = math.nan
    return LossyTorques(
        signs=signs,
        torques=no_torques(ideal.torques),
        directions=(nan,) * len(signs),
        losses=[nan] * len(signs),
        efficiency=nan,
        drag_losses=nan,
        balance=nan,
        admissible=False,
    )


def _losses(by_first_link: Sequence[Number], ideal: IdealGear, signs: Signs) -> Iterator[Number]:
    """Power lost in each mechanism, from the power by its first link: equation (2)."""
    variant = ideal.variant
    mechanisms = variant.case.mechanisms
    for place, (entering, x) in enumerate(zip(by_first_link, signs, strict=True)):
        if mechanisms[place].kind == "converter":
            yield power(entering, converter_slip(variant, place))
        else:
            yield power(entering, 1 - passed(variant.efficiencies[place], x))


def _entering(ideal: IdealGear, torques: Torques) -> list[Number]:
    return entering_powers(ideal.case, ideal.gear, ideal.speeds.links, torques)


def _efficiency(ideal: IdealGear, torques: Torques, entering: Sequence[Number]) -> Number:
    """Efficiency by which sets of signs are compared: the flow without losses divides the ports.

    With one input and one output it is ``Mx_lossy/Mx``, or its inverse when coasting.
    Otherwise power out by power in, each port on the side of its flow without losses;
    a port without any counts on neither.
    """
    if not ideal.gear.speeds and not ideal.gear.torques and not ideal.case.has_converter:
        lossy, lossless = torques.on_first_link[-1], ideal.torques.on_first_link[-1]
        one, other = (lossy, lossless) if ideal.direction > 0 else (lossless, lossy)
        return math.nan if other == 0 else one / other
    received: Number = 0.0
    given: Number = 0.0
    for flow, actual in zip(_entering(ideal, ideal.torques), entering, strict=True):
        if is_nan(flow):
            return math.nan
        side = flow * ideal.direction
        received = received + chosen(side > 0, actual, 0.0)
        given = given - chosen(side < 0, actual, 0.0)
    return math.nan if received == 0 else given / received


def power_ratio(ideal: IdealGear, lossy: LossyTorques) -> Number:
    """Efficiency as it is told: of several ports the power that leaves by that which enters.

    Each port is on the side of its own flow with losses; signs are chosen by `_efficiency`.
    """
    if not ideal.gear.speeds and not ideal.gear.torques:
        return lossy.efficiency
    received: Number = 0.0
    given: Number = 0.0
    for entering in _entering(ideal, lossy.torques):
        if is_nan(entering):
            return math.nan
        flow = entering * ideal.direction
        received = received + chosen(flow > 0, flow, 0.0)
        given = given + chosen(flow < 0, -flow, 0.0)
    return math.nan if received == 0 else given / received


def _passes_power(ideal: IdealGear) -> bool:
    """Whether the gear has an efficiency without losses, 1 but for converters; 0 if one stalls."""
    entering = _entering(ideal, ideal.torques)
    return bool(0 < absolute(_efficiency(ideal, ideal.torques, entering)) < math.inf)
