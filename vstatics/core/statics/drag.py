"""Drag of a gear: torques of links and open shift elements against their motion.

Drag is known from the speeds and acts as an external torque. It opposes motion, so it takes power.
A link is braked against its rotation; an open shift element brakes its links against each other,
with equal and opposite torques. Torques are in units of the input torque, which is negative when
coasting. There drag has the other sign, and the power that it takes is negative, like all losses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics.traced import Number, absolute, is_nan, sign
from vstatics.core.statics import matrix
from vstatics.core.statics.speeds import is_tie

NOTHING: Mapping[int, Number] = MappingProxyType({})
"""Empty mapping of torques."""


class Drag(NamedTuple):
    """Drag of a gear, known from the speeds."""

    links: Mapping[int, Number] = NOTHING
    """External torque of each link's own drag, by link number. [-]"""
    elements: Mapping[int, Number] = NOTHING
    """Torque on the first link of each open shift element that drags, by index. [-]"""
    external: Mapping[int, Number] = NOTHING
    """External torque of all drag by link number, including open shift elements. [-]"""
    losses: Sequence[Number] = ()
    """Power that each link and each shift element loses to drag. [-]"""


NO_DRAG = Drag()


def drag_torques(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> Drag:
    """Return the drag of a gear; no drag at speeds that are 0 or indeterminate.

    Parameters
    ----------
    gear : Gear
        The gear with the freewheels that hold among the engaged shift elements.
    speeds, slips : sequence of Number
        Speed of each link, slip of each shift element. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear(drag={2: 0.1})])
    >>> drag_torques(case, case.gears[0], [1.0, -0.25], [])[2:]
    ({2: 0.1}, [0.025])
    """
    torques, of_links = _drag_of_open_elements(case, gear), case.gear_drag(gear)
    if not of_links and not torques:
        return NO_DRAG
    direction = -1 if case.coasts(gear) else 1
    links: dict[int, Number] = {}
    elements: dict[int, Number] = {}
    external: dict[int, Number] = {}
    losses: list[Number] = []
    for link, given in of_links.items():
        speed, torque = speeds[link - 1], matrix.given_torque(case, gear, given)
        against = torque * direction * _direction(speed)
        if against:
            links[link] = -against
            external[link] = -against
            losses.append(absolute(speed) * (torque * direction))
    by_link = [0.0, *map(absolute, speeds)]
    for number, torque in torques.items():
        element, slip = case.shift_elements[number - 1], slips[number - 1]
        against = torque * direction * _direction(slip)
        if against and not is_tie(absolute(slip), by_link[element.first], by_link[element.second]):
            elements[number - 1] = against
            for link, pull in ((element.first, -against), (element.second, against)):
                if link != HOUSING:
                    external[link] = external.get(link, 0.0) + pull
            losses.append(absolute(slip) * (torque * direction))
    return Drag(links, elements, external, losses)


def _drag_of_open_elements(case: Transmission, gear: Gear) -> dict[int, float]:
    return {
        number: matrix.given_torque(case, gear, torque)
        for number, torque in case.gear_open_drag(gear).items()
        if torque and number not in gear.engaged
    }


def unknown_drag(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> list[str]:
    """Return the names of links and open shift elements with drag but an indeterminate speed.

    A law of drag that is 0 at rest is replaced by an `OfLoad` of 0, which therefore counts as drag.
    """

    def unknown(drags: Mapping[int, float], values: Sequence[Number]) -> list[int]:
        with_drag = (number for number, drag in drags.items() if drag or isinstance(drag, OfLoad))
        return [number for number in with_drag if is_nan(values[number - 1])]

    links = unknown(case.gear_drag(gear), speeds)
    elements = unknown(case.gear_open_drag(gear), slips)
    return [
        *map(case.link_name, links),
        *(case.shift_elements[n - 1].name for n in elements if n not in gear.engaged),
    ]


def _direction(speed: Number) -> Number:
    """Return +1 forward, -1 backward; 0 if at rest or indeterminate."""
    return 0.0 if is_nan(speed) else sign(speed)


def without_load(case: Transmission) -> list[str]:
    """Return the names of links and shift elements with drag in N*m but without an input torque.

    Torques are calculated relative to the input torque, so this drag needs an operating point.

    Examples
    --------
    >>> from vstatics.core.model.parts import OfLoad
    >>> from vstatics.core.model.transmission import Mechanism
    >>> gear = Gear(drag={2: OfLoad(3.0, math.inf)})
    >>> without_load(Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [gear], link_names=["a", "b"]))
    ['b']
    """
    names = {}
    for gear in case.gears:
        for link, torque in case.gear_drag(gear).items():
            names[case.link_name(link)] = torque
        for number, torque in case.gear_open_drag(gear).items():
            names[case.shift_elements[number - 1].name] = torque
    return [
        name
        for name, torque in names.items()
        if isinstance(torque, OfLoad) and math.isinf(torque.whole) and torque.given
    ]
