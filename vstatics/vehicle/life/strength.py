"""Life of members under the torques of a duty cycle: tooth contacts, damage by Miner's rule."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.case.fatigue import TorqueStrength
from vstatics.vehicle.life.member_rows import MemberRows
from vstatics.vehicle.tolerances import SAME_TORQUE_CLASS

SECONDS_PER_HOUR = 3600.0


class MemberLife(NamedTuple):
    """Damage and life of a member over a duty cycle."""

    damage: float
    """Damage by one duty cycle, to compare with `sum` of the strength; NaN without a torque. [-]"""
    contacts: float
    """Contacts of a tooth under torque in one duty cycle. [-]"""
    repeats: float | None
    """Number of duty cycles to failure, None without damage. [-]"""
    hours: float | None
    """Life of the member, None without damage. [h]"""


def lives(case: Transmission, rows: MemberRows) -> dict[str, MemberLife]:
    """Return the life of members, by name of their torque strength.

    A point with torque T causes the damage ``contacts/cycles (|T|/torque)^exponent``, or none if
    |T|/torque is below the threshold.

    Examples
    --------
    A thousand revolutions at the torque that is endured for a million contacts:

    >>> from vstatics import Gear, Mechanism, TorqueStrength
    >>> strength = TorqueStrength(50.0, 6.0, 1e6)
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear()], fatigue={"1": strength})
    >>> moving = {"1": (np.array([50.0]), np.array([2 * np.pi]))}
    >>> rows = MemberRows.of(case, moving, np.array([1000.0]), 0.0, np.zeros((1, 3)))
    >>> round(lives(case, rows)["1"].repeats, 9)
    1000.0
    """
    return {name: _life(name, strength, rows) for name, strength in TorqueStrength.of(case).items()}


def _life(name: str, strength: TorqueStrength, rows: MemberRows) -> MemberLife:
    member = strength.on or name
    row = rows.row(member, turning=strength.torque_of is not None)
    torques = rows.row(strength.torque_of or member).torques
    if (np.isnan(torques) & (row.turns > 0)).any():
        return MemberLife(math.nan, math.nan, None, None)
    torques = np.nan_to_num(torques)
    flanks = rows.contacts(member) if strength.contacts is None else strength.contacts
    contacts = np.where(torques != 0, row.turns * flanks, 0.0)
    parts = np.abs(torques) / strength.torque
    with np.errstate(over="ignore"):
        harm = contacts / strength.cycles * parts**strength.exponent
    harm = np.where(parts >= strength.threshold * (1 - SAME_TORQUE_CLASS), harm, 0.0)
    damage = _worse(torques, harm) if strength.flanks == "apart" else float(harm.sum())
    repeats, hours = life_of(damage, strength.sum, rows.duration)
    return MemberLife(damage, float(contacts.sum()), repeats, hours)


def _worse(torques: Floats, harm: Floats) -> float:
    """Return the damage from positive or from negative torques, whichever is larger."""
    return max(float(harm[torques > 0].sum()), float(harm[torques < 0].sum()))


def life_of(damage: float, at_failure: float, duration: float) -> tuple[float | None, float | None]:
    """Return duty cycles and hours up to the damage `at_failure`, None without damage."""
    if not damage > 0:
        return None, None
    repeats = at_failure / damage
    return repeats, repeats * duration / SECONDS_PER_HOUR


def life_grid(lives: Mapping[str, MemberLife]) -> Grid:
    """Return a table of lives, with a row for each member."""
    rows = [(name, *life) for name, life in lives.items()]
    headings = ("member", "damage", "contacts", "repeats", "life, h")
    return grid_of("Life of members", headings, rows, key="duty life")
