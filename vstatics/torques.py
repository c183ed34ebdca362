"""Torques of a gear: the equilibrium of its links, with ratios given for it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics import elimination, matrix
from vstatics.arrays import Booleans, Floats
from vstatics.model import Gear, Transmission


class Torques(NamedTuple):
    """The torques of a gear; the variants are the last axis. NaN: no single value."""

    first: Floats
    """(devices + 1, variants): on the first link of each device, 0 on an element that is
    not engaged; then the output torque. [-]"""
    holding: Floats
    """(links, variants): external torque that holds a given speed, NaN on other links. [-]"""
    consistent: Booleans
    """(variants,): there is an equilibrium."""


def solve_torques(case: Transmission, gear: Gear, ratios: Floats) -> Torques:
    """Solve the torque system of a gear.

    Parameters
    ----------
    ratios : ndarray, shape (mechanisms, variants)
        Internal ratios, with or without losses. [-]
    """
    columns = matrix.columns(case, ratios)
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    variants = ratios.shape[1]
    rows = matrix.torque_rows(case, gear, columns)
    solution = elimination.solve(rows, len(devices) + 1 + len(held), variants=variants)
    first = np.zeros((len(columns) + 1, variants))
    first[[*devices, len(columns)]] = solution.values[: len(devices) + 1]
    first[:, ~solution.consistent] = np.nan
    holding = np.full((case.links, variants), np.nan)
    holding[[link - 1 for link in held]] = solution.values[len(devices) + 1 :]
    return Torques(first, holding, solution.consistent)
