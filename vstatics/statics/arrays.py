"""The arrays of `Results`: what their last axis stands for, and the type of their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple

import numpy as np

from vstatics.model.transmission import Transmission

Rows = Literal["links", "planets", "elements", "devices", "mechanisms", "torques", "meshes", "one"]
"""What the rows of an array or a table stand for.

`elements` are shift elements; `devices` mechanisms and drawn elements as the case names
them; `mechanisms` those that the solver knows; `torques` shift elements, mechanisms or
members of drawn elements, springs, and the output; `meshes` those of a case that is drawn, with
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
    return all_row_names(case)[rows]


def all_row_names(case: Transmission) -> dict[Rows, list[str]]:
    """The names of the rows of each kind."""
    elements = [element.name for element in case.shift_elements]
    mechanisms = [mechanism.name for mechanism in case.mechanisms]
    devices = planets = members = mechanisms
    meshes: list[str] = []
    if case.drawing is not None:
        own = case.own_devices
        devices = [device.name for device in own]
        planets = [planet.name for device in own for planet in device.planets]
        members = [f"{one.name}.{member.name}" for one in own for member in one.members]
        meshes = [mechanisms[index] for one in own for index, _ in one.meshes_by_index]
    return {
        "links": list(case.link_names[: case.own_links]),
        "planets": planets,
        "elements": elements,
        "devices": devices,
        "mechanisms": mechanisms,
        "torques": [*elements, *members, *(spring.name for spring in case.springs), OUTPUT],
        "meshes": meshes,
        "one": [],
    }


def row_counts(case: Transmission) -> dict[str, int | None]:
    """How many values a gear has in each array of `Results`; None for one of the gear itself."""
    names = all_row_names(case)
    return {
        name: None if array.rows == "one" else len(names[array.rows])
        for name, array in ARRAYS.items()
    }
