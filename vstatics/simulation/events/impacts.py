"""What joins at once: speeds after an impact.

Mechanisms, closed dogs and freewheels at their stop take impulses, friction does not: ``M (w+ - w)
= -C p`` and ``C' w+ = 0``, so half of ``p C' w`` is lost. A freewheel takes an impulse one way
only.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.events.instants import Instant
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.structure import null, solved
from vstatics.simulation.system.variators import variator_rows
from vstatics.simulation.tolerances import LIGHT_MOTION, STANDING


class Impact(NamedTuple):
    """Speeds after an impact, and what it takes."""

    speeds: Floats
    """Of links. [rad/s]"""
    energies: tuple[float, ...]
    """Lost, by each contact that joins. [J]"""
    work: float
    """Of the impulses on links whose speeds are given. [J]"""


def impact(
    system: MotionSystem, at: Instant, rigid: Sequence[int], joining: Sequence[int]
) -> Impact:
    """The impact when contacts join; speeds that are given stay.

    Parameters
    ----------
    system : MotionSystem
    at : Instant
        Before.
    rigid : sequence of int
        Indices of all contacts that hold anything, those that join among them.
    joining : sequence of int
    """
    speeds = at.speeds
    wheels = [index for index, one in enumerate(system.contacts) if one.one_way]
    held = [system.contacts[index].row for index in rigid]
    given = [one.row for one in system.contacts if one.is_given]
    given += variator_rows(system, at.time)
    small = STANDING * max(1.0, largest(speeds))
    best: Impact | None = None
    for count in range(len(wheels), -1, -1):
        for stopped in combinations(wheels, count):
            rows = [mesh.row for mesh in system.meshes] + held
            rows += [system.contacts[index].row for index in stopped]
            after, impulses = _projected(system, speeds, system.rows(rows), given)
            first = len(rows) - len(stopped)
            work = -float(impulses[len(rows) :] @ (system.rows(given) @ speeds))
            impulses = impulses[: len(rows)]
            pushed = (impulses[first:] <= STANDING * largest(impulses)).all()
            free = [index for index in wheels if index not in stopped]
            overrun = all(system.contacts[index].row @ after >= -small for index in free)
            if best is None or (pushed and overrun):
                before = speeds, after, work
                energies = _energies(system, before, impulses, rigid, joining)
                best = Impact(after, energies, work)
            if pushed and overrun:
                return best
    assert best is not None  # noqa: S101 - there is one choice at least
    return best


def _projected(
    system: MotionSystem, speeds: Floats, rows: Floats, given: Sequence[Floats]
) -> tuple[Floats, Floats]:
    """Speeds that rows leave, nearest by kinetic energy, and the impulses of the rows.

    Those of links whose speeds are given stay; their impulses are the last.
    """
    mass = system.mass
    every = np.vstack([rows, system.rows(given)])
    free = null(every)
    kept = solved(every, np.append(np.zeros(len(rows)), system.rows(given) @ speeds))
    reduced = free.T @ mass @ free
    motions = np.linalg.lstsq(reduced, free.T @ mass @ (speeds - kept), rcond=LIGHT_MOTION)[0]
    after: Floats = kept + free @ motions
    return after, solved(every.T, mass @ (speeds - after))


def _energies(
    system: MotionSystem,
    change: tuple[Floats, Floats, float],
    impulses: Floats,
    rigid: Sequence[int],
    joining: Sequence[int],
) -> tuple[float, ...]:
    """What each of the contacts that join takes, by its impulse and its slip before."""
    before, after, work = change
    energy = kinetic_energy(system, before) - kinetic_energy(system, after) + work
    first = len(system.meshes)
    shares = [
        0.5 * float(impulses[first + place] * (system.contacts[index].row @ before))
        for place, index in enumerate(rigid)
        if index in joining
    ]
    rest = (energy - sum(shares)) / len(shares)
    return tuple(share + rest for share in shares)


def kinetic_energy(system: MotionSystem, speeds: Floats) -> float:
    """Of all bodies [J]."""
    return float(system.inertias @ (system.heavy @ speeds) ** 2) / 2
