"""Life of rolling bearings over a duty cycle, by ISO 281 and Miner's rule."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.case.bearing import Bearing
from vstatics.vehicle.life.member_rows import MemberRows, equivalent
from vstatics.vehicle.life.strength import life_of

RATED_REVOLUTIONS = 1e6
"""Revolutions that 90 % of bearings endure at their dynamic load rating. [-]"""


class BearingLife(NamedTuple):
    """Damage and life L10 of a bearing over a duty cycle."""

    damage: float
    """Damage by one duty cycle; at a total of 1, 10 % of bearings have failed. [-]"""
    revolutions: float
    equivalent_load: float
    """``(sum n P^p/sum n)^(1/p)``: loads P, revolutions n, life exponent p; NaN without n. [N]"""
    repeats: float | None
    """Number of duty cycles to a damage of 1, None without damage. [-]"""
    hours: float | None
    """Life L10, None without damage. [h]"""


def bearing_lives(case: Transmission, rows: MemberRows) -> dict[str, BearingLife]:
    """Return the life of each bearing of a case.

    Under the load P, 90 % of bearings endure ``L10 = (dynamic/P)^exponent`` million revolutions.
    The damage at an operating point is its revolutions divided by L10.

    Examples
    --------
    A thousand revolutions at the load rating, 10 N per N*m of a torque of 100 N*m:

    >>> from vstatics import Bearing, Gear, Mechanism
    >>> bearings = {"b": Bearing("1", 10.0, 1000.0)}
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear()], bearings=bearings)
    >>> moving = {"1": (np.array([100.0]), np.array([2 * np.pi]))}
    >>> rows = MemberRows.of(case, moving, np.array([1000.0]), 0.0, np.zeros((1, 3)))
    >>> life = bearing_lives(case, rows)["b"]
    >>> round(life.damage, 12), round(life.equivalent_load, 9)
    (0.001, 1000.0)
    """
    return {name: _life(bearing, rows) for name, bearing in Bearing.of(case).items()}


def _life(bearing: Bearing, rows: MemberRows) -> BearingLife:
    if isinstance(bearing.on, str):
        turns = rows.row(bearing.on, turning=True).turns
    else:
        turns = rows.turns_between(*bearing.on)
    torques = rows.row(bearing.torque_owner or "").torques
    total, p = float(turns.sum()), bearing.exponent
    if (np.isnan(torques) & (turns > 0)).any():
        return BearingLife(math.nan, total, math.nan, None, None)
    loads = np.abs(np.nan_to_num(torques)) * bearing.load_per_torque
    with np.errstate(over="ignore"):
        damage = float(((loads / bearing.dynamic) ** p) @ turns) / RATED_REVOLUTIONS
    load = equivalent(loads, turns, p)
    return BearingLife(damage, total, load, *life_of(damage, 1.0, rows.duration))


def bearing_grid(lives: Mapping[str, BearingLife]) -> Grid:
    """Return a table of lives, with a row for each bearing."""
    rows = [(name, *life) for name, life in lives.items()]
    headings = ("bearing", "damage", "turns", "equivalent load, N", "repeats", "L10, h")
    return grid_of("Life of bearings", headings, rows, key="duty bearings")
