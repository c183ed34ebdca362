"""The arrays of `Results`: what their last axis stands for, and the type of their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple, get_args

import numpy as np

from vstatics.model.transmission import Transmission

Rows = Literal["links", "planets", "elements", "devices", "mechanisms", "torques", "meshes", "one"]
"""What the rows of an array or a table stand for.

`elements` are shift elements; `devices` mechanisms and drawn elements as the case names
them; `mechanisms` those that the solver knows; `torques` shift elements, mechanisms or
members of drawn elements, and the output; `meshes` those of a case that is drawn, with
planets as links; `one`: a value of the gear itself.
"""


class GearArray(NamedTuple):
    """An array of `Results`."""

    rows: Rows
    dtype: type = np.float64


ARRAYS: Mapping[str, GearArray] = {
    "speeds": GearArray("links"),
    "planet_speeds": GearArray("planets"),
    "slip_speeds": GearArray("elements"),
    "ratio": GearArray("one"),
    "torques": GearArray("torques"),
    "holding_torques": GearArray("links"),
    "lossy_torques": GearArray("torques"),
    "lossy_holding_torques": GearArray("links"),
    "efficiency": GearArray("one"),
    "power_sign": GearArray("mechanisms"),
    "idle": GearArray("devices", np.bool_),
    "losses": GearArray("devices"),
    "power_balance": GearArray("one"),
    "drag_losses": GearArray("one"),
    "consistent": GearArray("one", np.bool_),
    "locked": GearArray("one", np.bool_),
    "undecided": GearArray("one", np.bool_),
    "turned": GearArray("mechanisms", np.bool_),
    "choices": GearArray("one", np.int16),
    "tied_up": GearArray("one", np.bool_),
    "missing": GearArray("one", np.int16),
    "excess": GearArray("one", np.int16),
    "balanced": GearArray("one", np.bool_),
    "holds": GearArray("elements", np.bool_),
    "conflict": GearArray("one", np.bool_),
    "mesh_torques": GearArray("meshes"),
    "lossy_mesh_torques": GearArray("meshes"),
    "mesh_losses": GearArray("meshes"),
}
"""By name, in the order of the fields of `Results`."""

OUTPUT = "Mx"
"""The name of the row of the output torque."""


def row_names(case: Transmission, rows: Rows) -> list[str]:
    """The names of the rows of an array; none for a value of the gear itself.

    >>> from vstatics.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> row_names(case, "torques"), row_names(case, "one")
    (['D1', 'Mx'], [])
    """
    if rows == "links":
        return list(case.link_names[: case.own_links])
    if rows == "one":
        return []
    elements = [element.name for element in case.shift_elements]
    mechanisms = [mechanism.name for mechanism in case.mechanisms]
    if case.drawing is None:  # as it most often is
        own = planets = members = mechanisms
        meshes: list[str] = []
    else:
        devices = case.own_devices
        own = [device.name for device in devices]
        planets = [planet.name for device in devices for planet in device.planets]
        members = [f"{one.name}.{member.name}" for one in devices for member in one.members]
        meshes = [mechanisms[index] for one in devices for index, _ in one.meshes_by_index]
    if rows == "torques":
        return [*elements, *members, OUTPUT]
    return {
        "planets": planets,
        "elements": elements,
        "devices": own,
        "mechanisms": mechanisms,
        "meshes": meshes,
    }[rows]


def row_counts(case: Transmission) -> dict[Rows, int]:
    """How many rows of each kind a case has; none of `one`."""
    return {rows: len(row_names(case, rows)) for rows in get_args(Rows) if rows != "one"}
