"""Speeds after an impact, when contacts close at a slip and join links at once.

Mechanisms, closed dog clutches and locked freewheels take impulses, friction does not. With mass
matrix M, constraint rows C', impulses p, and speeds w before and w+ after: ``M (w+ - w) = -C p``
and ``C' w+ = 0``, so half of ``p' C' w`` is lost. A freewheel takes an impulse in one direction
only.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.events.instants import Instant
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.structure import null, solved
from vstatics.simulation.system.variators import variator_rows
from vstatics.simulation.tolerances import LIGHT_MOTION, STANDING


class Impact(NamedTuple):
    """Result of an impact."""

    speeds: Floats
    """Speeds of all links after the impact. [rad/s]"""
    energies: tuple[float, ...]
    """Energy lost in each joining contact. [J]"""
    work: float
    """Work of the drives that maintain the given speeds of links. [J]"""


def impact(
    system: MotionSystem, at: Instant, rigid: Sequence[int], joining: Sequence[int]
) -> Impact:
    """Calculate the speeds and energies of an impact; links with given speeds keep them.

    Parameters
    ----------
    system : MotionSystem
    at : Instant
        Instant before the impact.
    rigid : sequence of int
        Indices of all contacts that stick rigidly, including the closing contacts.
    joining : sequence of int
        Indices of the closing contacts.
    """
    speeds = at.speeds
    wheels = [index for index, contact in enumerate(system.contacts) if contact.one_way]
    held = [system.contacts[index].row for index in rigid]
    given = [contact.row for contact in system.contacts if contact.is_given]
    given += variator_rows(system, at.time)
    small = STANDING * max(1.0, largest(speeds))
    best: tuple[Floats, Floats, float] | None = None
    counts = range(len(wheels), -1, -1)
    for stopped in chain.from_iterable(combinations(wheels, count) for count in counts):
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
            best = after, impulses, work
        if pushed and overrun:
            break
    assert best is not None  # noqa: S101 - there is one choice at least
    after, impulses, work = best
    # A closing contact loses half of its impulse times its slip before the impact.
    energy = kinetic_energy(system, speeds) - kinetic_energy(system, after) + work
    shares = [
        0.5 * float(impulses[len(system.meshes) + place] * (system.contacts[index].row @ speeds))
        for place, index in enumerate(rigid)
        if index in joining
    ]
    correction = (energy - sum(shares)) / len(shares)
    return Impact(after, tuple(share + correction for share in shares), work)


def _projected(
    system: MotionSystem, speeds: Floats, rows: Floats, given: Sequence[Floats]
) -> tuple[Floats, Floats]:
    mass = system.mass
    every = np.vstack([rows, system.rows(given)])
    free = null(every)
    particular = solved(every, np.append(np.zeros(len(rows)), system.rows(given) @ speeds))
    reduced = free.T @ mass @ free
    motions = np.linalg.lstsq(reduced, free.T @ mass @ (speeds - particular), rcond=LIGHT_MOTION)[0]
    after = particular + free @ motions
    return after, solved(every.T, mass @ (speeds - after))


def kinetic_energy(system: MotionSystem, speeds: Floats) -> float:
    """Return the kinetic energy of all bodies [J]."""
    return float(system.inertias @ (system.heavy @ speeds) ** 2) / 2
