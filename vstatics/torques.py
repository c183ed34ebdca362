"""Torques of a gear: the equilibrium of its links, with ratios given for it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics import elimination, entries, matrix
from vstatics.drag import NO_DRAG, Drag
from vstatics.model import Gear, Transmission
from vstatics.traced import Number


class Torques(NamedTuple):
    """The torques of a gear. NaN: no single value."""

    first: list[Number]
    """By device: on its first link, that of drag alone on an element that is not engaged;
    then the output torque. [-]"""
    holding: dict[int, Number]
    """Link -> external torque that holds its given speed. [-]"""
    consistent: bool
    """There is an equilibrium."""


def solve_torques(
    case: Transmission, gear: Gear, ratios: Sequence[Number], drag: Drag = NO_DRAG
) -> Torques:
    """Solve the torque system of a gear.

    Parameters
    ----------
    ratios : sequence of Number
        Ratio of each mechanism, with or without losses. [-]
    drag : Drag
        What drags, and with which torques.
    """
    arithmetic = entries.of(ratios)
    columns = matrix.columns(case, ratios, arithmetic)
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    rows = matrix.torque_rows(case, gear, columns, arithmetic, drag.external)
    solution = elimination.solve(rows, len(devices) + 1 + len(held), arithmetic=arithmetic)
    first = [0.0 if solution.consistent else math.nan] * (len(columns) + 1)
    for device, torque in zip([*devices, len(columns)], solution.values, strict=False):
        first[device] = torque
    if solution.consistent:
        for device, torque in drag.elements.items():
            first[device] = torque
    holding = dict(zip(held, solution.values[len(devices) + 1 :], strict=True))
    return Torques(first, holding, solution.consistent)
