"""Torque and revolutions of links, members, planets and shift elements in a duty cycle."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, rounding_as_zero
from vstatics.vehicle.case.members import Members


def equivalent(loads: Floats, turns: Floats, exponent: float) -> float:
    """Return ``(sum P^p n/sum n)^(1/p)`` of loads P, revolutions n and the exponent p.

    The result is NaN without revolutions.

    >>> round(equivalent(np.array([3.0, 5.0]), np.array([2.0, 2.0]), 2.0) ** 2, 9)
    17.0
    """
    largest, total = float(np.nanmax(loads, initial=0.0)), float(turns.sum())
    if not total:
        return math.nan
    with np.errstate(all="ignore"):
        parts = loads / largest if largest else loads
        mean = float(parts**exponent @ turns / total)
    return float(largest * mean ** (1 / exponent))


class MemberRow(NamedTuple):
    """Torques and revolutions of a member at all points with motion, shape (points,)."""

    torques: Floats
    """Torques, NaN for a planet. [N*m]"""
    turns: Floats
    """Revolutions at each point, 0 or more; revolutions per second if points have shares. [-]"""

    @property
    def has_torque(self) -> bool:
        """True if any torque is not 0."""
        return bool(np.nan_to_num(self.torques).any())


class MemberRows(NamedTuple):
    """Torques and revolutions of all members at the operating points of a duty cycle."""

    rows: Mapping[str, MemberRow]
    weights: Floats
    """Durations [s], or shares of time [-], of the points with motion."""
    standing: float
    """Duration [s] or share of time [-] at standstill."""
    members: Members
    speeds: Floats
    """Speeds of links, beginning with the housing, shape (points, links). [rad/s]"""

    @classmethod
    def of(
        cls,
        case: Transmission,
        members: Mapping[str, tuple[Floats, Floats]],
        weights: Floats,
        standing: float,
        speeds: Floats,
    ) -> MemberRows:
        """Return the rows of members, from their torques [N*m] and speeds [rad/s] by name."""
        rows = {
            name: MemberRow(torques, np.nan_to_num(np.abs(speed)) * weights / (2 * math.pi))
            for name, (torques, speed) in members.items()
        }
        return cls(rows, weights, standing, Members.of(case), speeds)

    @property
    def duration(self) -> float:
        """Duration of the duty cycle [s]; 1 if points have shares."""
        return float(self.weights.sum()) + self.standing

    def row(self, name: str, *, turning: bool = False) -> MemberRow:
        """Return torques and revolutions by a name of `Members.resolved`; NaN and 0 if unknown."""
        resolved = self.members.resolved(name, turning=turning)
        nothing = MemberRow(np.full(len(self.weights), math.nan), np.zeros(len(self.weights)))
        return self.rows.get(resolved, nothing)

    def contacts(self, name: str) -> float:
        """Return the number of contacts of a tooth of a member in a turn."""
        return float(self.members.contacts.get(self.members.resolved(name), 1))

    def turns_between(self, first: str, second: str) -> Floats:
        """Return the revolutions of a link relative to a second link at each point."""
        places = [["housing", *self.members.links].index(name) for name in (first, second)]
        both = self.speeds[:, places].T
        relative: Floats = rounding_as_zero(np.array([*both, both[0] - both[1]]))[-1]
        return np.nan_to_num(np.abs(relative)) * self.weights / (2 * math.pi)
