"""The torques that are shown of devices, and what is open of them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.equations import Equations
from vstatics.simulation.margins import Margins
from vstatics.statics.result_arrays import Message


def device_torques(equations: Equations, margins: Margins, times: Floats, states: Floats) -> Floats:
    """Torques of all devices at several times, shape (devices, times) [N*m]."""
    rates = equations.rates_at(times, states)
    ports = equations.torques_at(times, states, rates)
    held = margins.split(times, equations.structure.torques @ ports)
    system, layout = equations.system, equations.layout
    count = len(system.case.devices)
    made = np.zeros((count + len(system.converters), len(times)))
    row_of = {
        one.of: row
        for row, one in enumerate(equations.structure.multipliers)
        if one.kind == "contact"
    }
    for index, contact in enumerate(system.contacts):
        device = contact.while_open if contact.element is None else contact.element
        if device is not None:
            row = row_of.get(index)
            made[device] += ports[layout.contacts + index] if row is None else held[row]
    for index, mesh in enumerate(system.meshes):
        made[mesh.device] = held[index]
    for index, spring in enumerate(system.springs):
        made[spring.device] = ports[layout.springs + index]
    made[count:] = ports[layout.pumps : layout.pumps + len(system.converters)]
    return made


def shared_torques(pieces: Iterable[tuple[Equations, Margins]]) -> list[Message]:
    """What shares a torque that nothing determines, each set of elements once."""
    found = []
    seen: set[tuple[int, ...]] = set()
    for equations, margins in pieces:
        if not margins.shared:
            continue
        structure, contacts = equations.structure, equations.system.contacts
        sharing = tuple(
            one.of
            for row, one in enumerate(structure.multipliers)
            if one.kind == "contact"
            and contacts[one.of].element is not None
            and np.abs(structure.redundant[row]).max() > 1e-6
        )
        if len(sharing) < 2 or sharing in seen:
            continue
        seen.add(sharing)
        names = ", ".join(contacts[index].name for index in sharing)
        text = (
            f"{names} hold together more than is needed (first at {equations.time:.6g} s): how "
            "they share the torque is open, shown is the split of least norm"
        )
        found.append(Message("note", text))
    return found
