"""Load duration distributions: revolutions, contacts and time of members by torque class."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.tables.answer import json_keys
from vstatics.core.tables.grid import Grid, Values, grid_of
from vstatics.vehicle.life.member_rows import MemberRow, MemberRows
from vstatics.vehicle.tolerances import SAME_TORQUE_CLASS


@json_keys(
    from_="from_",
    to="to",
    revolutions="revolutions",
    contacts="contacts",
    time="time",
    speed="speed",
)
class LoadClass(NamedTuple):
    """Class of torques of the same sign, with magnitudes above `from_` and up to `to`."""

    from_: float
    """Bound nearer to 0, which does not belong to the class. [N*m]"""
    to: float
    """Bound farther from 0, which belongs to the class; NaN above the last upper bound. [N*m]"""
    revolutions: float
    contacts: float
    """Number of contacts of a tooth: revolutions times contacts in a turn. [-]"""
    time: float
    """Duration [s], or share of time [-]."""
    speed: float
    """Mean speed; NaN for an empty class. [rpm]"""


class IdleTime(NamedTuple):
    """Revolutions without torque, and their duration [s] or share of time [-]."""

    revolutions: float
    time: float


class MemberSpectrum(NamedTuple):
    """Load duration distribution of a member."""

    classes: Sequence[LoadClass]
    """Classes of torques above 0, then of torques below 0, both by ascending magnitude."""
    idle: IdleTime


Classes = int | Sequence[float]
"""Number of classes of equal width, or their upper bounds. [N*m]"""


def spectra(rows: MemberRows, classes: Classes) -> dict[str, MemberSpectrum]:
    """Return the load duration distribution of each member that has a torque.

    Parameters
    ----------
    rows : MemberRows
    classes : int or sequence of float
        Number of classes of equal width up to the largest torque of each member, or upper bounds
        with another class above the last bound. [N*m]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear()])
    >>> torques, speeds = np.array([10.0, 20.0, 0.0]), np.full(3, 2 * math.pi)
    >>> rows = MemberRows.of(case, {"1": (torques, speeds)}, np.ones(3), 4.0, np.zeros((3, 3)))
    >>> spectrum = spectra(rows, 2)["1"]
    >>> [tuple(each) for each in spectrum.classes], tuple(spectrum.idle)
    ([(0.0, 10.0, 1.0, 1.0, 1.0, 60.0), (10.0, 20.0, 1.0, 1.0, 1.0, 60.0)], (1.0, 5.0))
    """
    return {
        name: _spectrum(row, rows, classes, rows.contacts(name))
        for name, row in rows.rows.items()
        if row.has_torque
    }


def _spectrum(row: MemberRow, rows: MemberRows, classes: Classes, flanks: float) -> MemberSpectrum:
    torques = np.nan_to_num(row.torques)
    sizes = np.abs(torques)
    if isinstance(classes, int):
        edges = float(sizes.max()) * np.arange(classes + 1) / classes
    else:
        edges = np.array([0.0, *classes, math.inf])
    upper = edges[1:] * (1 + SAME_TORQUE_CLASS)
    place = np.minimum(np.searchsorted(upper, sizes), len(upper) - 1)
    counted = []
    for sign in (1, -1):
        own = sign * torques > 0
        for number in range(len(upper)) if own.any() else ():
            among = own & (place == number)
            ends = sign * float(edges[number]) + 0.0, sign * float(edges[number + 1])
            counted.append(_class(ends, among, row, rows.weights, flanks))
    idle = row.torques == 0
    time = float(rows.weights[idle].sum()) + rows.standing
    return MemberSpectrum(counted, IdleTime(float(row.turns[idle].sum()), time))


def _class(
    ends: tuple[float, float], among: Booleans, row: MemberRow, weights: Floats, flanks: float
) -> LoadClass:
    turns, time = float(row.turns[among].sum()), float(weights[among].sum())
    speed = 60 * turns / time if time else math.nan
    to = ends[1] if math.isfinite(ends[1]) else math.nan
    return LoadClass(ends[0], to, turns, turns * flanks, time, speed)


def spectrum_grid(spectra: Mapping[str, MemberSpectrum], *, are_shares: bool) -> Grid:
    """Return a table with a row for each class of each member, and for its time without torque."""
    rows = (row for name, spectrum in spectra.items() for row in _rows(name, spectrum))
    turns, time = ("turns a second", "share") if are_shares else ("turns", "time, s")
    headings = ("member", "above, N*m", "up to, N*m", turns, "contacts", time, "speed, rpm")
    return grid_of("Load spectrum", headings, rows, key="duty spectrum")


def _rows(name: str, spectrum: MemberSpectrum) -> Iterator[Values]:
    for each in spectrum.classes:
        yield name, each.from_, each.to, each.revolutions, each.contacts, each.time, each.speed
    idle = spectrum.idle
    if idle.time:
        yield name, 0.0, 0.0, idle.revolutions, math.nan, idle.time, math.nan
