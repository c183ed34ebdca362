"""Losses of a gear for assumed directions of power: torques, efficiency, balance of power.

The torque system is solved with ``u * efficiency**x`` instead of the basic ratio u. Seen from the
third link, the sign x is +1 if power enters a mechanism by its first link, and -1 if power leaves
there. The power lost in a mechanism is ``M' (w_f - w_h) (1 - efficiency**x)``, equation (2) of
docs/method.md; M' is the torque on the first link with losses.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number, absolute, chosen, is_nan, residual, sign
from vstatics.core.start import NamedTuple
from vstatics.core.statics.efficiency import Signs, is_possible, lossy_ratios, passed
from vstatics.core.statics.ideal import (
    IdealGear,
    converter_slip,
    mechanism_torques,
    no_torques,
    slip_losses,
)
from vstatics.core.statics.matrix import Column, columns
from vstatics.core.statics.power import power
from vstatics.core.statics.torques import Torques, acting_torques, solve_torques


class LossyTorques(NamedTuple):
    """Torques with losses, power losses and efficiency for assumed signs of power."""

    signs: Signs
    torques: Torques
    directions: Signs
    """Resulting sign of the power that enters each mechanism by its first link: +1, 0, -1 or NaN.
    """
    losses: Sequence[Number]
    """Power lost in each mechanism. [-]"""
    slip_losses: Sequence[Number]
    """Power lost in each slipping shift element. [-]"""
    efficiency: Number
    """Efficiency for comparing signs; `power_ratio` returns the reported efficiency. [-]"""
    drag_losses: Number
    """Total power lost to drag. [-]"""
    gear_losses: Number
    """Power loss measured for the whole gear (`Gear.loss`). [-]"""
    balance: Number | Residual
    """External power minus all losses. [-]"""
    admissible: Condition
    """True if the assumed signs agree with the resulting directions of power."""


def torques_for_signs(ideal: IdealGear, signs: Signs) -> LossyTorques:
    """Return the torques with losses for assumed signs, and whether the signs are admissible.

    Signs are never admissible if power flows back through a self-locking mechanism.
    """
    if not is_possible(ideal.variant.efficiencies, signs):
        return no_solution(ideal, signs)
    ratios = lossy_ratios(ideal.variant.ratios, ideal.variant.efficiencies, signs)
    lossy_columns = columns(ideal.case, ratios)
    torques = solve_torques(ideal.case, ideal.gear, lossy_columns, ideal.drag, ideal.external)
    return check_signs(ideal, signs, lossy_columns, torques)


def check_signs(
    ideal: IdealGear, signs: Signs, lossy_columns: Sequence[Column], torques: Torques
) -> LossyTorques:
    """Return torques, losses, efficiency, and whether the signs are admissible.

    Signs are admissible if the sign of every mechanism with losses equals the direction of its
    power (or either is 0), no converter or slipping shift element produces power, and the
    efficiency is above 0. The efficiency is not checked if power can enter at the output to
    overcome drag, or if the gear without losses transmits no power.
    """
    on_first_link = mechanism_torques(ideal, lossy_columns, torques)
    by_first_link = list(map(power, on_first_link, ideal.speeds.relative_speeds))
    losses = list(_losses(by_first_link, ideal, signs))
    of_slips = slip_losses(ideal, lossy_columns, torques)
    entering = _entering(ideal, torques)
    efficiency = _efficiency(ideal, torques, entering)
    way = ideal.direction
    directions = tuple(sign(entered) * way for entered in by_first_link)
    agrees: Condition = True
    for x, direction, efficiencies in zip(
        signs, directions, ideal.variant.efficiencies, strict=True
    ):
        if not (x == 0 or efficiencies.lossless):
            agrees = agrees & (x * direction >= 0)
    if not ideal.allows_driving:
        mechanisms = zip(ideal.case.mechanisms, losses, strict=True)
        of_converters = [loss for mechanism, loss in mechanisms if mechanism.kind == "converter"]
        slipping = [of_slips[number - 1] for number in ideal.gear.slip]
        slipping *= not ideal.gear.slip_drives
        for loss in (*of_converters, *(loss for loss in slipping if not is_nan(loss))):
            agrees = agrees & (loss * way >= 0)
    passes = ideal.overcome or (efficiency > 0) & (efficiency < math.inf)
    # `passes` is False only for a single variant, or if it is false in all variants. Variants with
    # slip or converters can differ, so power is tested in any case.
    differs = ideal.gear.slip or any(m.kind == "converter" for m in ideal.case.mechanisms)
    if (passes is False or differs) and not _passes_power(ideal):
        passes = True
    return LossyTorques(
        signs=signs,
        torques=torques,
        directions=directions,
        losses=losses,
        slip_losses=of_slips,
        efficiency=efficiency,
        drag_losses=sum(ideal.drag.losses, 0.0),
        gear_losses=ideal.drag.gear_loss,
        balance=residual(
            [*entering, *(-loss for loss in (*losses, *of_slips, *ideal.drag.all_losses))]
        ),
        admissible=agrees & passes,
    )


def no_solution(ideal: IdealGear, signs: Signs) -> LossyTorques:
    """Return torques and losses that are all NaN, with signs that are not admissible."""
    nan = math.nan
    return LossyTorques(
        signs=signs,
        torques=no_torques(ideal.torques),
        directions=(nan,) * len(signs),
        losses=[nan] * len(signs),
        slip_losses=[nan] * len(ideal.case.shift_elements),
        efficiency=nan,
        drag_losses=nan,
        gear_losses=nan,
        balance=nan,
        admissible=False,
    )


def _losses(by_first_link: Sequence[Number], ideal: IdealGear, signs: Signs) -> Iterator[Number]:
    """Yield the power lost in each mechanism by equation (2) [-]."""
    variant = ideal.variant
    mechanisms = variant.case.mechanisms
    for place, (entering, x) in enumerate(zip(by_first_link, signs, strict=True)):
        if mechanisms[place].kind == "converter":
            yield power(entering, converter_slip(variant, place))
        else:
            yield power(entering, 1 - passed(variant.efficiencies[place], x))


def _entering(ideal: IdealGear, torques: Torques) -> list[Number]:
    """Return the power that enters by each link with an external torque [-].

    Unlike in `port_powers`, an external torque on the output link is added to the load torque.
    """
    output, speeds = ideal.case.gear_output(ideal.gear), ideal.speeds.links
    acting = acting_torques(ideal.external, output, torques.holding, torques.on_first_link[-1])
    return [power(torque, speeds[link - 1]) for link, torque in acting.items()]


def _efficiency(ideal: IdealGear, torques: Torques, entering: Sequence[Number]) -> Number:
    """Return the efficiency for comparing combinations of signs [-].

    With one input and one output the efficiency is ``Mx_lossy/Mx``, or its inverse when coasting.
    Otherwise it is the output power divided by the input power. A port is an input or an output
    according to the power flow without losses. A port without power counts as neither.
    """
    if ideal.case.conserves_power(ideal.gear):
        lossy, lossless = torques.on_first_link[-1], ideal.torques.on_first_link[-1]
        numerator, denominator = (lossy, lossless) if ideal.direction > 0 else (lossless, lossy)
        return math.nan if denominator == 0 else numerator / denominator
    return _output_by_input(ideal, _entering(ideal, ideal.torques), entering)


def power_ratio(ideal: IdealGear, lossy: LossyTorques) -> Number:
    """Return the reported efficiency [-]: total output power divided by total input power.

    Unlike in `_efficiency`, a port is an input or an output according to the power flow with
    losses.
    """
    if not ideal.gear.speeds and not ideal.gear.torques:
        return lossy.efficiency
    entering = _entering(ideal, lossy.torques)
    return _output_by_input(ideal, entering, entering)


def _output_by_input(
    ideal: IdealGear, flows: Sequence[Number], entering: Sequence[Number]
) -> Number:
    """Return the output power divided by the input power.

    Parameters
    ----------
    flows, entering : sequence of Number
        Power that enters at each port. The sign of `flows` determines whether a port is an input or
        an output; the powers `entering` are summed. [-]
    """
    received: Number = 0.0
    given: Number = 0.0
    for flow, actual in zip(flows, entering, strict=True):
        if is_nan(flow):
            return math.nan
        side = flow * ideal.direction
        received = received + chosen(side > 0, actual, 0.0)
        given = given - chosen(side < 0, actual, 0.0)
    return math.nan if received == 0 else given / received


def _passes_power(ideal: IdealGear) -> bool:
    """Return whether the gear without losses transmits power.

    Without losses the efficiency is 1, or less with converters and slipping shift elements. It is 0
    if the output is at rest.
    """
    entering = _entering(ideal, ideal.torques)
    return bool(0 < absolute(_efficiency(ideal, ideal.torques, entering)) < math.inf)
