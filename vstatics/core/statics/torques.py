"""Torques of a gear from the equilibrium of links, and drag of links and shift elements.

`solve_torques` solves the equilibrium equations of `matrix.torque_rows`; torques that are not
unique are NaN. Drag follows from the speeds and acts as an external torque.

Drag opposes motion, so it takes power. A link is braked against its rotation. A disengaged shift
element brakes its links against each other, with equal and opposite torques. Torques are relative
to the input torque, which acts against the speed when coasting. Relative drag torques then have the
opposite sign, and the power lost to drag is negative, like all losses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from vstatics.core.model.empty import EMPTY
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import HOUSING, Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.traced import Number, absolute, is_nan, sign
from vstatics.core.start import NamedTuple
from vstatics.core.statics import matrix
from vstatics.core.statics.matrix import Column
from vstatics.core.statics.speeds import is_tie


class Drag(NamedTuple):
    """Drag of a gear, which depends only on speeds."""

    links: Mapping[int, Number] = EMPTY
    """External torque by which drag brakes each link, by link number. [-]"""
    elements: Mapping[int, Number] = EMPTY
    """Drag torque on the first link of each disengaged shift element, by index. [-]"""
    external: Mapping[int, Number] = EMPTY
    """Sum of drag torques on each link, also from shift elements, by link number. [-]"""
    losses: Sequence[Number] = ()
    """Power lost to drag at each link and in each shift element. [-]"""
    gear: Mapping[int, Number] = EMPTY
    """Torque on the input link (by number) equivalent to `Gear.loss`. [-]"""
    gear_loss: Number = 0.0
    """Power loss measured for the whole gear (`Gear.loss`). [-]"""

    @property
    def all_losses(self) -> list[Number]:
        """Power lost to drag, and to `Gear.loss` [-]."""
        return [*self.losses, self.gear_loss] if self.gear else [*self.losses]


NO_DRAG = Drag()


class Torques(NamedTuple):
    """Torques of a gear; NaN if not unique."""

    on_first_link: list[Number]
    """Torque that the first link gives to each device, then the output torque. [-]

    The value of a disengaged shift element is its drag torque.
    """
    holding: dict[int, Number]
    """External torque that holds a prescribed speed, by link number. [-]"""
    consistent: bool
    """True if there is an equilibrium."""
    certain: bool = True
    """True if the equations keep correct digits in spite of rounding."""
    of_columns: list[Number] | None = None
    """`factors`, if they differ from `on_first_link`."""

    @property
    def factors(self) -> list[Number]:
        """Factor by which the matrix column of each device is multiplied in the equilibrium [-].

        The factor is the torque on the first link, but for a variator minus the torque on the
        second.
        """
        return self.on_first_link if self.of_columns is None else self.of_columns


def solve_torques(
    case: Transmission,
    gear: Gear,
    columns: Sequence[Column],
    drag: Drag = NO_DRAG,
    external: Mapping[int, Number] | None = None,
) -> Torques:
    """Solve the torque system of a gear.

    Parameters
    ----------
    columns : sequence of Column
        Columns of the structural-distribution matrix, with or without losses.
    drag : Drag
        Known drag torques.
    external : mapping of int to Number, optional
        Result of `matrix.external_torques`, if already known. [-]
    """
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    rows = matrix.torque_rows(case, gear, columns, drag.external, external)
    solution, certain = elimination.solve_with_certainty(rows, len(devices) + 1 + len(held))
    on_first_link: list[Number] = [0.0 if solution.consistent else math.nan] * (len(columns) + 1)
    for device, torque in zip([*devices, len(columns)], solution.values, strict=False):
        on_first_link[device] = torque
    if solution.consistent:
        for device, torque in drag.elements.items():
            on_first_link[device] = torque
    holding = dict(zip(held, solution.values[len(devices) + 1 :], strict=True))
    factors = None
    for device, mechanism in enumerate(case.mechanisms, len(case.shift_elements)):
        if mechanism.kind == "variator":
            factors = factors or list(on_first_link)
            on_first_link[device] = times(
                factors[device], matrix.value(columns[device][mechanism.first])
            )
    return Torques(on_first_link, holding, solution.consistent, certain, factors)


def times(first: Number, second: Number) -> Number:
    """Return a product, which is 0 if either factor is 0, even for 0 times NaN."""
    return 0.0 if first == 0 or second == 0 else first * second


Shares = Mapping[int, Number]
"""Coefficients of a weighted sum of device torques, by index of the device. [-]"""


def solve_sums(
    case: Transmission, gear: Gear, columns: Sequence[Column], sums: Sequence[Shares], drag: Drag
) -> list[Number]:
    """Return weighted sums of device torques, which can be unique even if the torques are not.

    Parameters
    ----------
    columns, drag
        See `solve_torques`.
    sums : sequence of mapping
        For each sum, weights of `Torques.factors`, by device index. [-]

    Returns
    -------
    list of Number
        Value of each sum, NaN if not unique. [-]

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
    sums_of_unknowns = [
        {unknowns[device]: share for device, share in sum_.items() if device in unknowns}
        for sum_ in sums
    ]
    return elimination.solve(rows, size, sums_of_unknowns).values[size:]


def port_torques(
    case: Transmission, gear: Gear, holding: Mapping[int, Number], output_torque: Number
) -> dict[int, Number]:
    """Return the total external torque on each link, by link number [-].

    The load torque of the output and torques that hold prescribed speeds are included.
    """
    return acting_torques(
        matrix.external_torques(case, gear), case.gear_output(gear), holding, output_torque
    )


def acting_torques(
    external: Mapping[int, Number],
    output: int,
    holding: Mapping[int, Number],
    output_torque: Number,
) -> dict[int, Number]:
    """Return the result of `port_torques` from known external torques and the output link [-]."""
    acting: dict[int, Number] = {**external, **holding}
    acting[output] = acting[output] - output_torque if output in acting else -output_torque
    return acting


def drag_torques(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> Drag:
    """Return the drag of a gear, 0 where the speed is 0 or indeterminate.

    Parameters
    ----------
    gear : Gear
        Gear in which holding freewheels are listed as engaged.
    speeds, slips : sequence of Number
        Speed of each link, slip of each shift element. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear(drag={2: 0.1})])
    >>> drag_torques(case, case.gears[0], [1.0, -0.25], [])[2:4]
    ({2: 0.1}, [0.025])
    """
    of_links = case.gear_drag(gear)
    torques = {
        number: matrix.given_torque(case, gear, torque)
        for number, torque in case.gear_open_drag(gear).items()
        if torque and number not in gear.carrying
    }
    if not of_links and not torques and not gear.loss_torques:
        return NO_DRAG
    direction = -1 if case.coasts(gear) else 1
    links: dict[int, Number] = {}
    elements: dict[int, Number] = {}
    external: dict[int, Number] = {}
    losses: list[Number] = []
    for link, given in of_links.items():
        speed, torque = speeds[link - 1], matrix.given_torque(case, gear, given) * direction
        against = torque * _direction(speed)
        if against:
            links[link] = external[link] = -against
            losses.append(absolute(speed) * torque)
    by_link = [0.0, *map(absolute, speeds)]
    for number, given in torques.items():
        element, slip = case.shift_elements[number - 1], slips[number - 1]
        torque = given * direction
        against = torque * _direction(slip)
        if against and not is_tie(absolute(slip), by_link[element.first], by_link[element.second]):
            elements[number - 1] = against
            for link, pull in ((element.first, -against), (element.second, against)):
                if link != HOUSING:
                    external[link] = external.get(link, 0.0) + pull
            losses.append(absolute(slip) * torque)
    drag = Drag(links, elements, external, losses)
    for link, given in gear.loss_torques.items():
        speed, torque = speeds[link - 1], matrix.given_torque(case, gear, given) * direction
        against = torque * _direction(speed)
        if against:
            external[link] = external.get(link, 0.0) - against
            drag = drag._replace(gear={link: -against}, gear_loss=absolute(speed) * torque)
    return drag


def _direction(speed: Number) -> Number:
    """Return +1 for a positive, -1 for a negative, and 0 for a zero or indeterminate speed."""
    return 0.0 if is_nan(speed) else sign(speed)


def unknown_drag(
    case: Transmission, gear: Gear, speeds: Sequence[Number], slips: Sequence[Number]
) -> list[str]:
    """Return the names of links and disengaged shift elements with drag but unknown speed.

    An `OfLoad` of 0 counts as drag, because it can be the value of a law at rest.
    """

    def unknown(drags: Mapping[int, float], values: Sequence[Number]) -> list[int]:
        with_drag = (number for number, drag in drags.items() if drag or isinstance(drag, OfLoad))
        return [number for number in with_drag if is_nan(values[number - 1])]

    links = unknown(case.gear_drag(gear), speeds)
    elements = unknown(case.gear_open_drag(gear), slips)
    return [
        *map(case.link_name, links),
        *(case.shift_elements[n - 1].name for n in elements if n not in gear.carrying),
    ]


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
