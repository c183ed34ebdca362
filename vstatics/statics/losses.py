"""Losses of a gear under given signs of the power flow: torques, efficiency, balance.

With losses the internal ratio u of a mechanism becomes ``u * efficiency**x`` in the
torque system; x is +1 where power enters by the first link, seen from the third, and
-1 where it leaves by it (closed form of the published test: docs/method.md). Some
mechanisms, worm gears say, have another efficiency for x = -1.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.model.transmission import HOUSING, Gear, Transmission
from vstatics.numerics.traced import Number, rest
from vstatics.statics import matrix
from vstatics.statics.drag import Drag
from vstatics.statics.speeds import TIE
from vstatics.statics.torques import Torques, solve_torques

Signs = tuple[float, ...]
"""By mechanism: the exponent x of its efficiency, +1, -1 or 0; NaN where it is open."""

Acting = tuple[int, Number]
"""What acts on a link (a device, or -1 from outside), and the size of its torque."""


class Efficiency(NamedTuple):
    """The efficiency of a mechanism for each direction of power."""

    forward: Number
    """From the first link to the second."""
    back: Number
    """0: power can't flow back."""

    @property
    def lossless(self) -> bool:
        """Whether the direction does not matter."""
        return bool(self.forward == 1 and self.back == 1)

    @property
    def lossy(self) -> bool:
        """Whether there are losses in one of the directions."""
        return bool(self.forward < 1 or self.back < 1)


def both_ways(case: Transmission, efficiencies: Sequence[Number]) -> list[Efficiency]:
    """The efficiencies of the mechanisms, where a case may give others for the way back."""
    backs = (mechanism.back_efficiency for mechanism in case.mechanisms)
    return [
        Efficiency(forward, forward if back is None else back)
        for forward, back in zip(efficiencies, backs, strict=True)
    ]


class Flow(NamedTuple):
    """A gear with ideal mechanisms: what decides where power enters each of them."""

    case: Transmission
    gear: Gear
    ratios: Sequence[Number]
    efficiencies: Sequence[Efficiency]
    speeds: Sequence[Number]
    """By link."""
    motion: Sequence[Number]
    """By mechanism: speed of the first link against the third, 0 if a tie."""
    torques: Torques
    """Without drag."""
    drag: Drag
    driving: Torques
    """With drag, which alone is what loads some mechanisms; else the same."""

    @property
    def direction(self) -> int:
        """+1, or -1 when coasting: all flows turn."""
        return -1 if self.case.coast else 1


class Lossy(NamedTuple):
    """A gear with losses under one set of signs."""

    signs: Signs
    torques: Sequence[Number]
    """By device, then the output torque. [-]"""
    holding: dict[int, Number]
    """By link. [-]"""
    flow: Signs
    """By mechanism: sign of the power by the first link, +1, 0, -1 or NaN."""
    losses: Sequence[Number]
    """By mechanism, power. [-]"""
    efficiency: Number
    """[-]"""
    drag_losses: Number
    """Power that drag takes in all. [-]"""
    balance: Number
    """External power less all losses. [-]"""
    admissible: bool
    """The signs agree with the flow."""


def sign(number: Number) -> float:
    """+1, -1 or 0, or NaN."""
    if number > 0:
        return 1.0
    if number < 0:
        return -1.0
    return 0.0 if number == 0 else math.nan


def loaded(flow: Flow, ratios: Sequence[Number], torques: Torques) -> list[Number]:
    """Torque on the first link of each mechanism, 0 where it is a tie.

    It is a tie when on each of its links the mechanism's torque is nothing beside the
    other torques there: so a stage of a large ratio is measured by its own links.
    """
    case = flow.case
    elements = len(case.shift_elements)
    acting = _acting(flow, ratios, torques)
    return [
        0.0 if _is_nothing(acting, device, mechanism.links) else torques.first[device]
        for device, mechanism in enumerate(case.mechanisms, elements)
    ]


def is_nothing(flow: Flow, ratios: Sequence[Number], torques: Torques, number: int) -> bool:
    """Whether the torque of a shift element, by its number, is a tie; see `loaded`."""
    element = flow.case.shift_elements[number - 1]
    acting = _acting(flow, ratios, torques)
    return _is_nothing(acting, number - 1, (element.first, element.second))


def _is_nothing(acting: Sequence[Sequence[Acting]], device: int, links: Sequence[int]) -> bool:
    """Whether a device's torque is nothing beside another one, on each of its links."""

    def on(link: int) -> bool:
        own = next(torque for by, torque in acting[link] if by == device)
        others = [torque for by, torque in acting[link] if by != device]
        return bool(own == 0 or any(own <= TIE * torque for torque in others))

    return all(on(link) for link in links if link != HOUSING)


def _acting(flow: Flow, ratios: Sequence[Number], torques: Torques) -> list[list[Acting]]:
    """What acts on each link."""
    case, gear = flow.case, flow.gear
    acting: list[list[Acting]] = [[] for _ in range(case.links + 1)]
    coefficients: list[tuple[Sequence[int], Sequence[Number]]] = [
        ((element.first, element.second), (1.0, -1.0)) for element in case.shift_elements
    ]
    coefficients += [
        (mechanism.links, (1.0, -ratio, ratio - 1))
        for mechanism, ratio in zip(case.mechanisms, ratios, strict=True)
    ]
    for device, (links, shares) in enumerate(coefficients):
        for link, share in zip(links, shares, strict=True):
            acting[link].append((device, abs(share * torques.first[device])))
    acting[case.gear_output(gear)].append((-1, abs(torques.first[-1])))
    for link, torque in matrix.external_torques(case, gear).items():
        acting[link].append((-1, abs(torque)))
    for link, torque in (*torques.holding.items(), *flow.drag.links.items()):
        acting[link].append((-1, abs(torque)))
    return acting


def powers(flow: Flow, torques: Torques) -> list[Number]:
    """Power that enters by each port: the links on which external torques act."""
    case, gear = flow.case, flow.gear
    external: dict[int, Number] = {**matrix.external_torques(case, gear), **torques.holding}
    output = case.gear_output(gear)
    external[output] = external.get(output, 0.0) - torques.first[-1]
    return [power(torque, flow.speeds[link - 1]) for link, torque in external.items()]


def power(torque: Number, speed: Number) -> Number:
    """Torque times speed, or power times a share.

    It is 0 where one of them is 0, even if the other does not exist.
    """
    return 0.0 if torque == 0 or speed == 0 else torque * speed


def _efficiency(flow: Flow, output_torque: Number, entering: Sequence[Number]) -> Number:
    """Efficiency by the ports, which the flow without losses divides in two.

    With one input and one output it is ``Mx_lossy/Mx``, or its inverse when coasting.
    Otherwise power out by power in, each port on the side of its flow without losses;
    a port without any counts on neither.
    """
    if not flow.gear.speeds and not flow.gear.torques:
        ideal = flow.torques.first[-1]
        one, other = (output_torque, ideal) if flow.direction > 0 else (ideal, output_torque)
        return math.nan if other == 0 else one / other
    received: Number = 0.0
    given: Number = 0.0
    for ideal, actual in zip(powers(flow, flow.torques), entering, strict=True):
        side = sign(ideal) * flow.direction
        if math.isnan(side):
            return math.nan
        if side > 0:
            received = received + actual
        elif side < 0:
            given = given - actual
    return math.nan if received == 0 else given / received


def with_loss(ratio: Number, efficiency: Efficiency, exponent: float) -> Number:
    """``ratio * efficiency**exponent``; NaN where power can't flow back."""
    if exponent == 0:
        return ratio
    if math.isnan(exponent):
        return ratio if efficiency.lossless else math.nan
    if exponent > 0:
        return ratio if efficiency.forward == 1 else ratio * efficiency.forward
    if efficiency.back == 0:
        return math.nan
    return ratio if efficiency.back == 1 else ratio / efficiency.back


def is_possible(flow: Flow, signs: Signs) -> bool:
    """Whether power flows back through no mechanism that is self-locking."""
    return not any(
        x < 0 and bool(efficiency.back == 0)
        for x, efficiency in zip(signs, flow.efficiencies, strict=True)
    )


def nothing(flow: Flow, signs: Signs) -> Lossy:
    """No lossy torques at all."""
    nan = math.nan
    return Lossy(
        signs=signs,
        torques=[nan] * len(flow.torques.first),
        holding=dict.fromkeys(flow.torques.holding, nan),
        flow=(nan,) * len(signs),
        losses=[nan] * len(signs),
        efficiency=nan,
        drag_losses=nan,
        balance=nan,
        admissible=False,
    )


def _losses(by_first: Sequence[Number], flow: Flow, signs: Signs) -> Iterator[Number]:
    """Power lost in each mechanism, from the power by its first link."""
    for entering, efficiency, exponent in zip(by_first, flow.efficiencies, signs, strict=True):
        yield power(entering, 1 - with_loss(1.0, efficiency, exponent))


def attempt(flow: Flow, signs: Signs) -> Lossy:
    """Torques with losses under given signs, and whether the signs agree with the flow.

    A set of signs is admissible when the loss of every mechanism is not negative, which
    is the same as: its sign is that of its flow, or its flow is 0; and when the
    efficiency is above 0 (where there is one without losses). Power that flows back through
    a self-locking mechanism is never admissible.
    """
    if not is_possible(flow, signs):
        return nothing(flow, signs)
    ratios = list(map(with_loss, flow.ratios, flow.efficiencies, signs))
    return judge(flow, signs, ratios, solve_torques(flow.case, flow.gear, ratios, flow.drag))


def judge(flow: Flow, signs: Signs, ratios: Sequence[Number], torques: Torques) -> Lossy:
    """What torques with losses mean: losses, efficiency, and whether the signs agree."""
    by_first = list(map(power, loaded(flow, ratios, torques), flow.motion))
    losses = list(_losses(by_first, flow, signs))
    entering = powers(flow, torques)
    share = _efficiency(flow, torques.first[-1], entering)
    turned = tuple(sign(entered) * flow.direction for entered in by_first)
    agrees = all(
        given * found >= 0 or efficiency.lossless
        for given, found, efficiency in zip(signs, turned, flow.efficiencies, strict=True)
    )
    passes = 0 < share < math.inf or not _passes_power(flow)
    return Lossy(
        signs=signs,
        torques=torques.first,
        holding=torques.holding,
        flow=turned,
        losses=losses,
        efficiency=share,
        drag_losses=sum(flow.drag.losses, 0.0),
        balance=rest([*entering, *(-loss for loss in (*losses, *flow.drag.losses))]),
        admissible=agrees and passes,
    )


def _passes_power(flow: Flow) -> bool:
    """Whether the gear has an efficiency without losses, which is then 1."""
    entering = powers(flow, flow.torques)
    return bool(abs(_efficiency(flow, flow.torques.first[-1], entering)) < math.inf)
