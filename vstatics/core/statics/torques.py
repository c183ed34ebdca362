"""Torques of a gear: the equilibrium of its links, drag of links and open elements.

It opposes motion, so it takes power. A link is braked against its rotation; an open
element brakes its links against each other, with equal and opposite torques. Torques
are in units of the input torque, which is below 0 when coasting; so there drag has the
other sign, and what it takes is below 0, like all losses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.traced import Number, absolute, is_nan, sign
from vstatics.core.statics import matrix
from vstatics.core.statics.matrix import Column
from vstatics.core.statics.speeds import is_tie

NOTHING: Mapping[int, Number] = MappingProxyType({})


class Drag(NamedTuple):
    """The drag of a gear, known from its speeds."""

    links: Mapping[int, Number] = NOTHING
    """Link -> external torque of its own drag. [-]"""
    elements: Mapping[int, Number] = NOTHING
    """Index of an open element -> torque on its first link. [-]"""
    external: Mapping[int, Number] = NOTHING
    """Link -> external torque of all drag, that of open elements too. [-]"""
    losses: Sequence[Number] = ()
    """Power that each of them takes. [-]"""


NO_DRAG = Drag()


def drag_torques(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> Drag:
    """The drag of a gear at its speeds; none where a speed is 0 or not determined.

    Parameters
    ----------
    gear : Gear
        With the freewheels that hold among the engaged elements.
    speeds, slips : sequence of Number
        By link, by shift element. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear(drag={2: 0.1})])
    >>> drag_torques(case, case.gears[0], [1.0, -0.25], [])[2:]
    ({2: 0.1}, [0.025])
    """
    torques, of_links = _open(case, gear), case.gear_drag(gear)
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


def _open(case: Transmission, gear: Gear) -> dict[int, float]:
    """Number -> drag of each open element that has any."""
    return {
        number: matrix.given_torque(case, gear, torque)
        for number, torque in case.gear_open_drag(gear).items()
        if torque and number not in gear.engaged
    }


def unknown_drag(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> list[str]:
    """Return the names of links and open shift elements whose drag has no speed; of one case.

    A law that is 0 at rest stands as an `OfLoad` of 0, so such a number counts as well.
    """

    def unknown(drags: Mapping[int, float], values: Sequence[Number]) -> list[int]:
        dragging = (number for number, drag in drags.items() if drag or isinstance(drag, OfLoad))
        return [number for number in dragging if not _is(values, number)]

    links = unknown(case.gear_drag(gear), speeds)
    elements = unknown(case.gear_open_drag(gear), slips)
    return [
        *map(case.link_name, links),
        *(case.shift_elements[n - 1].name for n in elements if n not in gear.engaged),
    ]


def _is(values: Sequence[Number], number: int) -> bool:
    """Whether a value exists."""
    return values[number - 1] == values[number - 1]


def _direction(speed: Number) -> Number:
    """+1 forward, -1 backward; 0 where it stands, or where that is not determined."""
    return 0.0 if is_nan(speed) else sign(speed)


def without_load(case: Transmission) -> list[str]:
    """Names of what has a drag with a unit that no torque of a load relates to the input's.

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


def times(one: Number, other: Number) -> Number:
    """A product, 0 where one of the two is 0, even if the other does not exist."""
    return 0.0 if one == 0 or other == 0 else one * other


Shares = Mapping[int, Number]
"""Index of a device -> its share in a sum."""


class Torques(NamedTuple):
    """The torques of a gear. NaN: no single value."""

    on_first_link: list[Number]
    """By device: on its first link, that of drag alone on an element that is not engaged;
    then the output torque. [-]"""
    holding: dict[int, Number]
    """Link -> external torque that holds its given speed. [-]"""
    consistent: bool
    """There is an equilibrium."""
    certain: bool = True
    """Rounding leaves digits of what they are made from."""
    of_columns: list[Number] | None = None
    """See `factors`, where these are others."""

    @property
    def factors(self) -> list[Number]:
        """By device [-]: what its column is multiplied with.

        That is the torque on its first link, but of a variator minus that on its second link.
        """
        return self.on_first_link if self.of_columns is None else self.of_columns


def solve_torques(
    case: Transmission, gear: Gear, columns: Sequence[Column], drag: Drag = NO_DRAG
) -> Torques:
    """Solve the torque system of a gear.

    Parameters
    ----------
    columns : sequence of Column
        Of the structural-distribution matrix, with or without losses.
    drag : Drag
        What drags, and with which torques.
    """
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    rows = matrix.torque_rows(case, gear, columns, drag.external)
    solution, certain = elimination.solve_told(rows, len(devices) + 1 + len(held))
    on_first_link: list[Number] = [0.0 if solution.consistent else math.nan] * (len(columns) + 1)
    for device, torque in zip([*devices, len(columns)], solution.values, strict=False):
        on_first_link[device] = torque
    if solution.consistent:
        for device, torque in drag.elements.items():
            on_first_link[device] = torque
    holding = dict(zip(held, solution.values[len(devices) + 1 :], strict=True))
    factors = None
    for device, one in enumerate(case.mechanisms, len(case.shift_elements)):
        if one.kind == "variator":
            factors = factors or list(on_first_link)
            on_first_link[device] = times(factors[device], matrix.value(columns[device][one.first]))
    return Torques(on_first_link, holding, solution.consistent, certain, factors)


def solve_sums(
    case: Transmission, gear: Gear, columns: Sequence[Column], sums: Sequence[Shares], drag: Drag
) -> list[Number]:
    """Sums of torques of devices, which may be determined where the torques are not.

    Parameters
    ----------
    columns, drag
        See `solve_torques`.
    sums : sequence of mapping
        For each sum, the share of the torques on the first links of some devices. [-]

    Returns
    -------
    list of Number
        NaN where there is no single value. [-]

    Examples
    --------
    Two clutches share a torque; only their sum is known.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> case = Transmission(2, [ShiftElement(1, 2), ShiftElement(1, 2)], [], [Gear([1, 2])])
    >>> columns = matrix.columns(case, [])
    >>> solve_sums(case, case.gears[0], columns, [{0: 1.0}, {0: 1.0, 1: 1.0}], NO_DRAG)
    [nan, 1.0]
    """
    unknowns = {device: n for n, device in enumerate(matrix.loaded_devices(case, gear))}
    rows = matrix.torque_rows(case, gear, columns, drag.external)
    size = len(unknowns) + 1 + len(matrix.held_links(case, gear))
    asked = [
        {unknowns[device]: share for device, share in one.items() if device in unknowns}
        for one in sums
    ]
    return elimination.solve(rows, size, asked).values[size:]
