"""A gear with ideal mechanisms: what decides where power enters each of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics.tolerances import TIE
from vstatics.core.numerics.traced import Number, absolute, is_nothing_beside
from vstatics.core.statics import matrix
from vstatics.core.statics.matrix import Column, Variant
from vstatics.core.statics.speeds import Speeds
from vstatics.core.statics.torques import NO_DRAG, Drag, Torques, drag_torques, solve_torques, times

OUTSIDE = -1
"""Stands for an external torque, where a device has its index."""


class IdealGear(NamedTuple):
    """Speeds and torques of a gear without losses."""

    variant: Variant
    gear: Gear
    """With the freewheels that hold among the engaged elements."""
    speeds: Speeds
    torques: Torques
    """Without drag."""
    drag: Drag
    torques_with_drag: Torques
    """Drag alone loads some mechanisms; the same where nothing drags."""
    overcome: bool = False
    """Whether drag may take more than the input gives, so that the output gives the rest."""

    @property
    def case(self) -> Transmission:
        """The transmission."""
        return self.variant.case

    @property
    def direction(self) -> int:
        """+1, or -1 when coasting: all flows turn."""
        return -1 if self.case.coasts(self.gear) else 1

    @property
    def without_drag(self) -> IdealGear:
        """The same gear where nothing drags."""
        return self._replace(drag=NO_DRAG, torques_with_drag=self.torques)


def ideal_gear(variant: Variant, gear: Gear, speeds: Speeds) -> IdealGear:
    """Torques without losses, for the elements that are engaged and their speeds."""
    case, columns = variant.case, variant.columns
    torques = solve_torques(case, gear, columns)
    if gaining(variant, gear, speeds, torques):
        torques = no_torques(torques)
    drag = drag_torques(case, gear, speeds.links, speeds.slips)
    with_drag = torques if drag is NO_DRAG else solve_torques(case, gear, columns, drag)
    return IdealGear(variant, gear, speeds, torques, drag, with_drag)


def gaining(variant: Variant, gear: Gear, speeds: Speeds, torques: Torques) -> list[str]:
    """Names of converters that would gain power, as none does."""
    mechanisms = enumerate(variant.case.mechanisms)
    way = -1 if variant.case.coasts(gear) else 1
    return [one.name for n, one in mechanisms if _gains(variant, n, speeds, torques, way)]


def _gains(variant: Variant, place: int, speeds: Speeds, torques: Torques, way: int) -> bool:
    """Whether a mechanism is a converter, and would gain power; `way` is -1 when coasting."""
    if variant.case.mechanisms[place].kind != "converter":
        return False
    entering = times(
        torques.on_first_link[len(variant.case.shift_elements) + place],
        speeds.relative_speeds[place],
    )
    return bool(times(entering, converter_slip(variant, place)) * way < 0)


def converter_slip(variant: Variant, place: int) -> Number:
    """``1 - K i``: the part of its power that a converter loses [-]."""
    ratio = variant.ratios[place]
    torque_ratio: Number = matrix.torque_ratio_of(variant.case.mechanisms[place], ratio)
    return 1 - torque_ratio * ratio


def no_torques(torques: Torques) -> Torques:
    """Those of a gear that has none."""
    nan = math.nan
    return Torques(
        [nan] * len(torques.on_first_link), dict.fromkeys(torques.holding, nan), consistent=False
    )


def mechanism_torques(
    ideal: IdealGear, columns: Sequence[Column], torques: Torques
) -> list[Number]:
    """Torque on the first link of each mechanism, 0 where it is a tie.

    It is a tie when on each of its links the mechanism's torque is nothing beside the
    other torques there: so a stage of a large ratio is measured by its own links.
    """
    case = ideal.case
    elements = len(case.shift_elements)
    by_link = _torques_by_link(ideal, columns, torques)
    return [
        0.0 if _is_nothing(by_link, device, mechanism.links) else torques.on_first_link[device]
        for device, mechanism in enumerate(case.mechanisms, elements)
    ]


def is_nothing(ideal: IdealGear, columns: Sequence[Column], torques: Torques, number: int) -> bool:
    """Whether the torque of a shift element, by its number, is a tie: see `mechanism_torques`."""
    element = ideal.case.shift_elements[number - 1]
    by_link = _torques_by_link(ideal, columns, torques)
    return _is_nothing(by_link, number - 1, (element.first, element.second))


_OnLink = tuple[int, Number]
"""The index of a device, or `OUTSIDE`, and the size of its torque on a link."""


def _is_nothing(by_link: Sequence[Sequence[_OnLink]], device: int, links: Sequence[int]) -> bool:
    """Whether a device's torque is nothing beside another one, on each of its links."""

    def on(link: int) -> bool:
        own = next(torque for other, torque in by_link[link] if other == device)
        others = [torque for other, torque in by_link[link] if other != device]
        return bool(own == 0 or any(is_nothing_beside(own, torque, TIE) for torque in others))

    return all(on(link) for link in links if link != HOUSING)


def _torques_by_link(
    ideal: IdealGear, columns: Sequence[Column], torques: Torques
) -> list[list[_OnLink]]:
    """All torques on each link, the housing first."""
    case, gear = ideal.case, ideal.gear
    by_link: list[list[_OnLink]] = [[] for _ in range(case.links + 1)]
    for device, (column, factor) in enumerate(zip(columns, torques.factors, strict=False)):
        for link, share in matrix.values_of(column).items():
            by_link[link].append((device, absolute(share * factor)))
    by_link[case.gear_output(gear)].append((OUTSIDE, absolute(torques.on_first_link[-1])))
    external = matrix.external_torques(case, gear)
    for link, torque in (*external.items(), *torques.holding.items(), *ideal.drag.links.items()):
        by_link[link].append((OUTSIDE, absolute(torque)))
    return by_link
