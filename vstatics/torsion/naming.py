"""Torques by the names that results have: of shift elements, mechanisms or members, springs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from vstatics.model.transmission import Transmission
from vstatics.statics.matrix import column
from vstatics.torsion.coordinates import Values


def own_torques(
    case: Transmission, by_device: Mapping[str, Values], nothing: Any
) -> dict[str, Values]:
    """Torques of devices by the rows of `torques` in results; an open element has 0.

    Parameters
    ----------
    by_device : mapping
        On the first link of each engaged element, mechanism and spring, by its name. [N*m]
    nothing : ndarray
        That of an open element: zeros.
    """
    named = {one.name: by_device.get(one.name, nothing) for one in case.shift_elements}
    springs = {spring.name: by_device[spring.name] for spring in case.springs}
    if case.drawing is None:
        return named | {one.name: by_device[one.name] for one in case.mechanisms} | springs
    for device in case.own_devices:
        for member in device.members:
            parts = [
                column(case.mechanisms[index].ratio)[place] * by_device[case.mechanisms[index].name]
                for index, place in member.places
            ]
            named[f"{device.name}.{member.name}"] = np.sum(parts, axis=0)
    return named | springs
