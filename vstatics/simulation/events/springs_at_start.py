"""Springs before a run: how they are damped, how they are loaded."""

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
from vstatics.simulation.events.selection import ModeSelection
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
    """The system with loss factors as viscous damping at its lowest natural frequency.

    A loss factor tells a damping torque for a vibration of one frequency only: ``eta k/omega``
    takes as much of it. That is the lowest one while everything sticks that does at the start.
    """
    names = [spring.name for spring in system.springs if spring.loss_factor]
    if not names:
        return system, ()
    frequency = _lowest_frequency(system, speeds)
    if not frequency:
        text = "nothing swings at the start, so loss factors damp nothing"
        return system, (Message("W601", text),)
    springs = tuple(
        spring._replace(viscous=spring.viscous + spring.loss_factor * spring.stiffness / frequency)
        for spring in system.springs
    )
    text = (
        f"loss factors and damping ratios are taken as viscous damping at the lowest natural "
        f"frequency at the start, {frequency / (2 * math.pi):.4g} Hz"
    )
    return with_settings(replace(system, springs=springs), system.settings), (
        Message("N601", text),
    )


def _lowest_frequency(system: MotionSystem, speeds: Floats) -> float:
    """The lowest natural frequency while everything sticks that has no slip [rad/s]; 0: none."""
    scale = max(1.0, largest(speeds))
    rows = [mesh.row for mesh in system.meshes]
    for contact in system.contacts:
        held = contact.one_way or contact.programme.look is not None
        closed = held or programme_at(contact.programme, 0.0) > 0
        if closed and abs(float(contact.row @ speeds)) <= STANDING * scale:
            rows.append(contact.row)
    free = null(system.rows(rows))
    seen = seen_at(system, start_instant(system, speeds, np.zeros(len(system.springs))))
    bent = [
        one
        for one in system.springs
        if programme_at(one.programme, 0.0, seen) > 0 and not one.is_damper
    ]
    if not bent or not free.shape[1]:
        return 0.0
    forms = np.array([one.row for one in bent]) @ free
    stiffness = (forms.T * [one.curve.slope_at(one.curve.at(0.0)) for one in bent]) @ forms
    mass = free.T @ system.mass @ free
    sizes, axes = np.linalg.eigh(mass)
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
    """Twists of the springs with which nothing swings under the torques of t = 0 [rad].

    They carry what they would if they were rigid, within their limits.

    Raises
    ------
    NoChoice
    CaseError
    """
    seen = seen_at(system, start_instant(system, speeds, np.zeros(len(system.springs))))
    limits = [programme_at(one.programme, 0.0, seen) for one in system.springs]
    bent = [n for n, limit in enumerate(limits) if limit > 0 and not system.springs[n].is_damper]
    held = _held_torques(system, speeds, bent)
    twists = np.zeros(len(system.springs))
    for index in bent:
        spring, limit = system.springs[index], limits[index]
        torque = max(-limit, min(limit, held.get(index, 0.0)))
        twist = spring.curve.twist_at(torque)
        if twist is None:
            message = f"{spring.name} carries {torque:g} N*m, which it never has"
            raise CaseError("E694", f"{message}: leave out `settled`", ("start", "settled"))
        twists[index] = twist
    return twists


def _held_torques(system: MotionSystem, speeds: Floats, bent: Sequence[int]) -> dict[int, float]:
    """Torques of some springs if they were rigid, and no dry friction beside them [N*m]."""
    stiff = Programme(constant(math.inf), is_dog=True)
    others = [one for one in system.contacts if one.beside is None]
    rigid = [Contact(system.springs[n].name, system.springs[n].row, stiff) for n in bent]
    limp = [
        one if one.is_damper else one._replace(curve=straight_curve(0.0), viscous=0.0)
        for one in system.springs
    ]
    other = replace(system, contacts=(*others, *rigid), springs=tuple(limp))
    other = with_settings(other, system.settings)
    at = start_instant(other, speeds, np.zeros(len(limp)))
    scales = LargeSizes(max(1.0, largest(speeds)), 1.0)
    selected = ModeSelection(other).select(at, None, scales)
    equations = selected.margins.equations
    rates, torques = equations.acting(0.0, selected.state)
    columns = (one[:, None] for one in (selected.state, rates, torques))
    held = selected.margins.split(np.zeros(1), *columns)[:, 0]
    return {
        bent[one.of - len(others)]: float(torque)
        for one, torque in zip(equations.structure.multipliers, held.tolist(), strict=True)
        if one.kind == "contact" and one.of >= len(others)
    }
