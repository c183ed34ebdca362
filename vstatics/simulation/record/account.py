"""Energy balance of a run: work, heat, losses, and stored energy."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.impacts import kinetic_energy
from vstatics.simulation.events.instants import Instant
from vstatics.simulation.record.motion import Energy
from vstatics.simulation.record.row_names import friction_areas
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.system.equations import Equations


def element_heat(equations: Equations, states: Floats) -> Floats:
    """Return the heat of each shift element [J], shape (shift elements, states).

    Each column of `states`, shape (size, states), is a state.
    """
    system, works = equations.system, states[equations.works]
    heat = np.zeros((len(system.case.shift_elements), states.shape[1]))
    for index, contact in enumerate(system.contacts):
        if contact.element is not None:
            heat[contact.element] += works[equations.layout.contacts + index]
    for index, spring in enumerate(system.springs):
        if spring.element is not None:
            heat[spring.element] += states[equations.slipped][index]
    return heat


def energy_account(
    start: Instant,
    end: float,
    equations: Equations,
    state: Floats,
    impacts: tuple[float, float],
) -> Energy:
    """Return the energy balance of a run [J].

    Parameters
    ----------
    start : Instant
    end : float
        End of the run. [s]
    equations : Equations
        Equations at the end.
    state : ndarray
        State at the end.
    impacts : tuple of float
        Energy lost in impacts, and work of impacts at links with given speeds. [J]
    """
    system = equations.system
    heat, losses = (
        {name: float(energy) for name, energy in energies.items()}
        for energies in heat_and_losses(equations, state)
    )
    works, layout = state[equations.works], equations.layout
    impact, impact_work = impacts
    work = float(works[: layout.outside].sum()) + impact_work
    work -= sum(
        float(works[layout.contacts + index])
        for index, contact in enumerate(system.contacts)
        if contact.switch
    )
    kinetic = kinetic_energy(system, equations.speeds(end, state)) - kinetic_energy(
        system, start.speeds
    )
    twists = state[equations.twists]
    elastic = system.elastic_energy(twists) - system.elastic_energy(start.twists)
    balance = work - sum(heat.values()) - sum(losses.values()) - kinetic - elastic - impact
    areas = friction_areas(system.case)
    per_area = {name: heat[name] / area for name, area in areas.items() if name in heat}
    return Energy(work, heat, per_area, losses, kinetic, elastic, impact, balance)


def heat_and_losses(
    equations: Equations, state: Floats
) -> tuple[dict[str, Floats], dict[str, Floats]]:
    """Return heat and losses [J] by name, in a single or several states; equal names are summed."""
    system, layout = equations.system, equations.layout
    works = state[equations.works]
    heat: dict[str, Floats] = {}
    losses: dict[str, Floats] = {}
    for index, contact in enumerate(system.contacts):
        if contact.switch or contact.is_variator:
            continue
        is_loss = contact.overrun_drag or (contact.is_drag and contact.beside is None)
        energies = losses if is_loss else heat
        _add(energies, contact.name, works[layout.contacts + index])
    for index, spring in enumerate(system.springs):
        if spring.viscous:
            _add(losses, spring.name, state[equations.damped][index])
        curve = spring.programme.curve
        if not isinstance(curve, Points) or {*curve.y} != {math.inf}:  # the spring can slip
            _add(heat, spring.name, state[equations.slipped][index])
    for index, converter in enumerate(system.converters):
        taken = works[layout.pumps + index] + works[layout.turbines + index]
        _add(losses, converter.name, taken)
    for index, variator in enumerate(system.variators):
        taken = works[layout.contacts + variator.contact] + works[layout.variators + index]
        _add(losses, variator.name, taken)
    for name, energy in _of_meshes(equations, state):
        _add(losses, name, energy)
    return heat, losses


def _of_meshes(equations: Equations, state: Floats) -> Iterator[tuple[str, Floats]]:
    """Yield losses with the names of their mechanisms; a varying efficiency adds a second loss."""
    system, works = equations.system, state[equations.works]
    for index, mesh in enumerate(system.meshes):
        if not mesh.lossless:
            yield mesh.name, state[equations.meshed][index]
    for port, index in enumerate(system.varying, equations.layout.losses):
        yield system.meshes[index].name, works[port]


def _add(energies: dict[str, Floats], name: str, energy: Floats) -> None:
    energies[name] = energies[name] + energy if name in energies else energy
