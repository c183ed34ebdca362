"""Speeds and torques of a gear without losses, which determine the directions of power."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.model.parts import Mechanism
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics.tolerances import TIE, UNCERTAIN
from vstatics.core.numerics.traced import Number, absolute, is_nan, is_nothing_beside
from vstatics.core.start import NamedTuple
from vstatics.core.statics import matrix
from vstatics.core.statics.matrix import Column, Variant
from vstatics.core.statics.speeds import Speeds
from vstatics.core.statics.torques import NO_DRAG, Drag, Torques, drag_torques, solve_torques, times

OUTSIDE = -1
"""Number that stands for an external torque in lists of component indices."""


class IdealGear(NamedTuple):
    """Speeds and torques of a gear without losses."""

    variant: Variant
    gear: Gear
    """Gear in which holding freewheels are listed as engaged."""
    direction: int
    """-1 when coasting, where all power flows backward, else +1."""
    external: Mapping[int, float]
    """Known external torques by link, from `matrix.external_torques`. [-]"""
    speeds: Speeds
    torques: Torques
    """Torques without drag."""
    drag: Drag
    torques_with_drag: Torques
    """Torques with drag, which is all that some mechanisms carry; `torques` if there is no drag."""
    overcome: bool = False
    """True if power can enter at the output to overcome drag that exceeds the input power."""
    allows_driving: bool = False
    """True if converters and slipping shift elements can produce power, without drag."""

    @property
    def case(self) -> Transmission:
        """Transmission to which the gear belongs."""
        return self.variant.case

    @property
    def without_drag(self) -> IdealGear:
        """The gear with all drag left out."""
        return self._replace(
            drag=NO_DRAG, torques_with_drag=self.torques, overcome=False, allows_driving=True
        )


def ideal_gear(variant: Variant, gear: Gear, speeds: Speeds) -> IdealGear:
    """Return the speeds and torques of a gear without losses."""
    case, columns = variant.case, variant.columns
    direction, external = direction_of(case, gear), matrix.external_torques(case, gear)
    torques = solve_torques(case, gear, columns, external=external)
    if any(is_nan(variant.ratios[place]) for place, _ in _converters(variant)):
        torques = no_torques(torques)
    drag = drag_torques(case, gear, speeds.links, speeds.slips)
    with_drag = torques
    if drag is not NO_DRAG:
        with_drag = solve_torques(case, gear, columns, drag, external)
    return IdealGear(variant, gear, direction, external, speeds, torques, drag, with_drag)


def direction_of(case: Transmission, gear: Gear) -> int:
    """Return +1, or -1 when a gear is coasting."""
    return -1 if case.coasts(gear) else 1


def gaining(variant: Variant, direction: int, speeds: Speeds, torques: Torques) -> list[str]:
    """Return the names of converters whose output power would exceed their input power.

    Such a state is impossible. A converter whose speed ratio is unknown (NaN) counts as well.
    """
    return [
        mechanism.name
        for place, mechanism in _converters(variant)
        if _gains(variant, place, speeds, torques, direction)
    ]


def _converters(variant: Variant) -> Iterator[tuple[int, Mechanism]]:
    for place, mechanism in enumerate(variant.case.mechanisms):
        if mechanism.kind == "converter":
            yield place, mechanism


def _gains(variant: Variant, place: int, speeds: Speeds, torques: Torques, direction: int) -> bool:
    if is_nan(variant.ratios[place]):
        return True
    entering = times(
        torques.on_first_link[len(variant.case.shift_elements) + place],
        speeds.relative_speeds[place],
    )
    return bool(times(entering, converter_slip(variant, place)) * direction < 0)


def slip_losses(ideal: IdealGear, columns: Sequence[Column], torques: Torques) -> list[Number]:
    """Return the power that each shift element loses by its prescribed slip [-]; 0 without slip."""
    slips, gear = ideal.speeds.slips, ideal.gear
    if not gear.slip:
        return [0.0] * len(slips)
    by_link = _torques_by_link(ideal, columns, torques)
    return [
        0.0
        if number not in gear.slip
        or _is_nothing(by_link, number - 1, ideal.case.shift_elements[number - 1].links)
        else times(torques.on_first_link[number - 1], slip)
        for number, slip in enumerate(slips, 1)
    ]


def driving(ideal: IdealGear, columns: Sequence[Column], torques: Torques) -> list[int]:
    """Return the numbers of slipping shift elements that would produce power."""
    losses = () if ideal.gear.slip_drives else slip_losses(ideal, columns, torques)
    return [n for n, loss in enumerate(losses, 1) if bool(loss * ideal.direction < 0)]


def converter_slip(variant: Variant, place: int) -> Number:
    """Return the fraction of the pump's power that a converter loses [-].

    The fraction is ``1 - K i``, with the torque ratio K and the speed ratio i.
    """
    ratio = variant.ratios[place]
    torque_ratio: Number = matrix.torque_ratio_of(variant.case.mechanisms[place], ratio)
    return 1 - torque_ratio * ratio


def no_torques(torques: Torques) -> Torques:
    """Return torques that are all NaN, for a gear without an equilibrium."""
    nan = math.nan
    return Torques(
        [nan] * len(torques.on_first_link), dict.fromkeys(torques.holding, nan), consistent=False
    )


def mechanism_torques(
    ideal: IdealGear, columns: Sequence[Column], torques: Torques
) -> list[Number]:
    """Return the torque on the first link of each mechanism [-]; 0 if negligible.

    A torque is negligible if on every link of the mechanism another torque is much larger. Torques
    on other links are not compared, because a ratio can make them larger.
    """
    case = ideal.case
    elements = len(case.shift_elements)
    by_link = _torques_by_link(ideal, columns, torques)
    return [
        0.0 if _is_nothing(by_link, device, mechanism.links) else torques.on_first_link[device]
        for device, mechanism in enumerate(case.mechanisms, elements)
    ]


def is_nothing(ideal: IdealGear, columns: Sequence[Column], torques: Torques, number: int) -> bool:
    """Return whether the torque of a shift element is negligible, as in `mechanism_torques`."""
    element = ideal.case.shift_elements[number - 1]
    by_link = _torques_by_link(ideal, columns, torques)
    return _is_nothing(by_link, number - 1, element.links)


_OnLink = tuple[int, Number]
"""Index of a component or `OUTSIDE`, and magnitude of its torque on a link."""


def _is_nothing(by_link: Sequence[Sequence[_OnLink]], device: int, links: Sequence[int]) -> bool:
    def on(link: int) -> bool:
        on_device = next(torque for other, torque in by_link[link] if other == device)
        return bool(on_device == 0) or any(
            is_nothing_beside(on_device, torque, TIE)
            for other, torque in by_link[link]
            if other != device
        )

    return all(on(link) for link in links if link != HOUSING)


def _torques_by_link(
    ideal: IdealGear, columns: Sequence[Column], torques: Torques
) -> list[list[_OnLink]]:
    case, gear = ideal.case, ideal.gear
    by_link: list[list[_OnLink]] = [[] for _ in range(case.links + 1)]
    for device, (column, factor) in enumerate(zip(columns, torques.factors, strict=False)):
        for link, share in column.items():
            by_link[link].append((device, absolute(matrix.value(share) * factor)))
    by_link[case.gear_output(gear)].append((OUTSIDE, absolute(torques.on_first_link[-1])))
    for given in (ideal.external, torques.holding, ideal.drag.links):
        for link, torque in given.items():
            by_link[link].append((OUTSIDE, absolute(torque)))
    return by_link


def is_uncertain(gear: Gear, output_speed: float, output_torque: float) -> bool:
    """Return whether output torque times output speed differs from 1 because of rounding.

    By equation (1) of docs/method.md, ``Mx * w_output = 1`` in a gear without losses and without
    further given speeds or torques.
    """
    if gear.speeds or gear.torques or gear.slipping:
        return False
    return abs(output_torque * output_speed - 1) > UNCERTAIN
