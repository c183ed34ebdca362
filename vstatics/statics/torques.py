"""Torques of a gear: the equilibrium of its links, with ratios given for it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics import elimination
from vstatics.numerics.traced import Number
from vstatics.statics import matrix
from vstatics.statics.drag import NO_DRAG, Drag
from vstatics.statics.matrix import Column

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
    solution = elimination.solve(rows, len(devices) + 1 + len(held))
    on_first_link: list[Number] = [0.0 if solution.consistent else math.nan] * (len(columns) + 1)
    for device, torque in zip([*devices, len(columns)], solution.values, strict=False):
        on_first_link[device] = torque
    if solution.consistent:
        for device, torque in drag.elements.items():
            on_first_link[device] = torque
    holding = dict(zip(held, solution.values[len(devices) + 1 :], strict=True))
    return Torques(on_first_link, holding, solution.consistent)


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

    >>> from vstatics.model.transmission import Mechanism, ShiftElement
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
