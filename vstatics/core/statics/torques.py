"""Torques of a gear: the equilibrium of its links.

`solve_torques` solves the equilibrium of `matrix.torque_rows`; torques that are not unique are NaN.
Drag is an external torque, see `drag`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.traced import Number
from vstatics.core.statics import matrix
from vstatics.core.statics.drag import NO_DRAG, Drag
from vstatics.core.statics.matrix import Column


def times(first: Number, second: Number) -> Number:
    """Return a product, 0 if a factor is 0, even if the other factor is NaN."""
    return 0.0 if first == 0 or second == 0 else first * second


Shares = Mapping[int, Number]
"""Coefficient of each device's torque in a sum, by index of the device."""


class Torques(NamedTuple):
    """Torques of a gear; NaN if not unique."""

    on_first_link: list[Number]
    """Torque that the first link gives to each device, then the output torque. [-]

    A shift element that is not engaged has the torque of its drag.
    """
    holding: dict[int, Number]
    """External torque that holds a given speed, by link number. [-]"""
    consistent: bool
    """True if there is an equilibrium."""
    certain: bool = True
    """True if the pivots of the equations keep correct digits after rounding."""
    of_columns: list[Number] | None = None
    """Factors of the columns, see `factors`, if they differ from `on_first_link`."""

    @property
    def factors(self) -> list[Number]:
        """Factor of each device's column [-].

        The factor is the torque on the first link; for a variator it is minus the torque on the
        second link.
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
        `matrix.external_torques` of the gear, if they are calculated already. [-]
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


def port_torques(
    case: Transmission, gear: Gear, holding: Mapping[int, Number], output_torque: Number
) -> dict[int, Number]:
    """Return the total external torque on each link, by link number [-].

    Torques of the load and torques that hold a given speed are included.
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
    """Return `port_torques` from the known external torques of a gear and its output link [-]."""
    acting: dict[int, Number] = {**external, **holding}
    acting[output] = acting[output] - output_torque if output in acting else -output_torque
    return acting


def solve_sums(
    case: Transmission, gear: Gear, columns: Sequence[Column], sums: Sequence[Shares], drag: Drag
) -> list[Number]:
    """Return sums of torques of devices, which can be unique even if the torques are not.

    Parameters
    ----------
    columns, drag
        See `solve_torques`.
    sums : sequence of mapping
        Shares of the torques on the first links of devices, for each sum. [-]

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
