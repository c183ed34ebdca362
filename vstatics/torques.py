"""Torques of a gear: the equilibrium of its links, with ratios given for it."""

from __future__ import annotations

import numpy as np

from vstatics import elimination, matrix
from vstatics.arrays import Floats
from vstatics.model import Gear, Transmission


def solve_torques(case: Transmission, gear: Gear, ratios: Floats) -> tuple[Floats, Floats]:
    """Torques of a gear when the internal ratios of the torques are `ratios`.

    Parameters
    ----------
    ratios : ndarray, shape (mechanisms, variants)

    Returns
    -------
    torques : ndarray, shape (devices + 1, variants)
        On the first link of each device, 0 on an element that is not engaged; then the
        output torque. NaN where there is no single value.
    holding : ndarray, shape (links, variants)
        External torque on each link with a given speed, NaN on the others.
    """
    columns = matrix.columns(case, ratios)
    devices = matrix.loaded_devices(case, gear)
    held = matrix.held_links(case, gear)
    variants = ratios.shape[1]
    rows = matrix.torque_rows(case, gear, columns)
    solution = elimination.solve(rows, len(devices) + 1 + len(held), variants=variants)
    torques = np.where(solution.consistent, 0.0, np.nan) * np.ones((len(columns) + 1, 1))
    torques[[*devices, len(columns)]] = solution.values[: len(devices) + 1]
    holding = np.full((case.links, variants), np.nan)
    holding[[link - 1 for link in held]] = solution.values[len(devices) + 1 :]
    return torques, holding
