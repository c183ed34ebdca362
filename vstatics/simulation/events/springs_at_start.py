"""Springs at the start: their equivalent viscous damping, and their twists at rest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.springs import straight_curve
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.core.statics.result_arrays import Message
from vstatics.simulation.events.instants import seen_at, start_instant
from vstatics.simulation.events.margins import LargeSizes
from vstatics.simulation.events.selection import ModesAsked, ModeSelection
from vstatics.simulation.scenario.laws import constant
from vstatics.simulation.scenario.programme import Programme
from vstatics.simulation.system.curves import programme_at
from vstatics.simulation.system.matrices import Contact, MotionSystem
from vstatics.simulation.system.sight import with_settings
from vstatics.simulation.system.structure import null
from vstatics.simulation.tolerances import DEPENDENT, LIGHT_MOTION, RIGID_SQUARE, STANDING


def with_viscous_damping(
    system: MotionSystem, speeds: Floats
) -> tuple[MotionSystem, tuple[Message, ...]]:
    """Return the system with loss factors replaced by equivalent viscous damping.

    A loss factor eta of a stiffness k is equivalent to viscous damping ``eta k/omega`` at a single
    frequency omega. This is the lowest natural frequency while shift elements without slip stick.
    """
    if not any(spring.loss_factor for spring in system.springs):
        return system, ()
    frequency = _lowest_frequency(system, speeds)
    if not frequency:
        return system, (
            Message("W601", "nothing vibrates at the start, so loss factors have no effect"),
        )
    springs = tuple(
        spring._replace(viscous=spring.viscous + spring.loss_factor * spring.stiffness / frequency)
        for spring in system.springs
    )
    return with_settings(replace(system, springs=springs), system.settings), (
        Message(
            "N601",
            "loss factors and damping ratios are taken as viscous damping at the lowest "
            f"natural frequency at the start, {frequency / (2 * math.pi):.4g} Hz",
        ),
    )


def _lowest_frequency(system: MotionSystem, speeds: Floats) -> float:
    """Return the lowest natural frequency while shift elements without slip stick [rad/s], or 0.

    The frequency belongs to the engaged gear. Drag, loads and dry friction of springs therefore do
    not hold any link here, although they stick at rest.
    """
    scale = max(1.0, largest(speeds))
    rows = [mesh.row for mesh in system.meshes]
    for contact in system.contacts:
        held = contact.one_way or contact.programme.look is not None
        closed = held or programme_at(contact.programme, 0.0) > 0
        in_gear = closed and contact.element is not None
        if in_gear and abs(float(contact.row @ speeds)) <= STANDING * scale:
            rows.append(contact.row)
    free = null(system.rows(rows))
    bent = [system.springs[index] for index in _carried_limits(system, speeds)]
    if not bent or not free.shape[1]:
        return 0.0
    forms = np.array([spring.row for spring in bent]) @ free
    stiffness = (forms.T * [spring.curve.slope_at(spring.curve.at(0.0)) for spring in bent]) @ forms
    sizes, axes = np.linalg.eigh(free.T @ system.mass @ free)
    heavy = sizes > LIGHT_MOTION * sizes[-1]
    light = axes[:, ~heavy]
    if light.shape[1]:
        inner = np.linalg.pinv(light.T @ stiffness @ light, rcond=DEPENDENT)
        stiffness = stiffness - stiffness @ light @ inner @ light.T @ stiffness
    scaled = axes[:, heavy] / np.sqrt(sizes[heavy])
    squares = np.linalg.eigvalsh(scaled.T @ stiffness @ scaled)
    above = squares[squares > RIGID_SQUARE * squares[-1]] if len(squares) else squares
    return math.sqrt(float(above[0])) if len(above) and above[0] > 0 else 0.0


def settled_twists(system: MotionSystem, speeds: Floats) -> Floats:
    """Return the twists of springs that carry the torques of t = 0 at rest [rad].

    The torques are the torques of rigid connections that replace the springs, clipped to the torque
    limits of the springs.

    Raises
    ------
    NoChoice
    CaseError
    """
    limits = _carried_limits(system, speeds)
    held = _held_torques(system, speeds, [*limits])
    twists = np.zeros(len(system.springs))
    for index, limit in limits.items():
        spring, torque = system.springs[index], max(-limit, min(limit, held.get(index, 0.0)))
        twist = spring.curve.twist_at(torque)
        if twist is None:
            raise CaseError(
                "E694",
                f"{spring.name} has a torque of {torque:g} N*m at the start, which its points "
                "never reach: leave out `settled`",
                ("start", "settled"),
            )
        twists[index] = twist
    return twists


def _carried_limits(system: MotionSystem, speeds: Floats) -> dict[int, float]:
    """Return the torque limits of springs that carry torque at the start [N*m], by index."""
    seen = seen_at(system, start_instant(system, speeds, np.zeros(len(system.springs))))
    limits = [programme_at(spring.programme, 0.0, seen) for spring in system.springs]
    return {
        index: limit
        for index, limit in enumerate(limits)
        if limit > 0 and not system.springs[index].is_damper
    }


def _held_torques(system: MotionSystem, speeds: Floats, bent: Sequence[int]) -> dict[int, float]:
    """Return the torques [N*m] of rigid connections that replace springs, by spring index."""
    stiff = Programme(constant(math.inf), is_dog=True)
    others = [contact for contact in system.contacts if contact.beside is None]
    rigid = [Contact(system.springs[n].name, system.springs[n].row, stiff) for n in bent]
    limp = [
        spring if spring.is_damper else spring._replace(curve=straight_curve(0.0), viscous=0.0)
        for spring in system.springs
    ]
    other = replace(system, contacts=(*others, *rigid), springs=tuple(limp))
    other = with_settings(other, system.settings)
    at = start_instant(other, speeds, np.zeros(len(limp)))
    scales = LargeSizes(max(1.0, largest(speeds)), 1.0)
    selected = ModeSelection(other).select(ModesAsked(at, None, scales))
    equations = selected.equations
    rates, torques = equations.acting(0.0, selected.state)
    columns = (vector[:, None] for vector in (selected.state, rates, torques))
    held = selected.margins.split(np.zeros(1), *columns)[:, 0]
    return {
        bent[index - len(others)]: float(held[row])
        for index, row in equations.structure.contact_rows.items()
        if index >= len(others)
    }
