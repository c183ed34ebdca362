"""Duty cycle by points: gear, speed and torque of the input, with times or shares.

Results are the energies of ports and losses, and the loads of links, members and clutches.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, not_allowed
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.carried import overloads_at_points
from vstatics.core.statics.diagnosis import outside_message
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import json_keys
from vstatics.core.tables.grid import Grid, grid_of, word
from vstatics.vehicle.damage.devices import DeviceDamage, damages
from vstatics.vehicle.damage.tables import damage_grid
from vstatics.vehicle.duty import Cycle
from vstatics.vehicle.operation.point_loads import DutyPoints, PointLoads

EXPONENT = 3.0
"""Exponent of equivalent torques, near that of tooth roots and roller bearings (10/3). [-]"""

LARGEST_DUTY = 1e30
"""Largest number of a point in SI units, which keeps energies and sums finite."""


class LargestValue(NamedTuple):
    """Value with the largest magnitude, and its row, from 1."""

    largest: float
    row: int


class MemberLoad(NamedTuple):
    """Load of a link, a member of a mechanism, or a shift element over a duty cycle."""

    torque: LargestValue
    """Largest torque; for a link, the sum of all positive torques on it; NaN for a planet. [N*m]"""
    speed: LargestValue
    """Largest speed; of a member or planet relative to the third link, of a shift element the slip.
    [rpm]"""
    revolutions: float
    """Number of revolutions at this kind of speed; per second if points have shares. [-]"""
    equivalent_torque: float
    """``(sum |T|^p n t / sum n t)^(1/p)`` with exponent p, torques T, speeds n, times or shares t;
    NaN if the member never turns under torque. [N*m]"""


@json_keys(in_="in_", out="out", lost="lost")
class DutyEnergy(NamedTuple):
    """Energies of a duty cycle [J]; with shares, mean powers [W]."""

    in_: float
    out: float
    lost: Mapping[str, float]
    """Lost energy by name of a mechanism, and by ``drag.LINK`` and ``drag.CLUTCH``."""


@json_keys("energy", "efficiency", "exponent", "members")
class Spectrum(NamedTuple):
    """Results of a duty cycle by points."""

    energy: DutyEnergy
    efficiency: float
    members: Mapping[str, MemberLoad]
    messages: Sequence[Message] = ()
    """Warnings about laws outside their points, and overloaded shift elements."""
    are_shares: bool = False
    """True if points have shares, not times: energies are mean powers, revolutions per second."""
    damage: Mapping[str, DeviceDamage] = MappingProxyType({})
    """Damage of components with a fatigue strength, with the points in order as a record."""
    exponent: float = EXPONENT
    """Exponent of the equivalent torques. [-]"""

    def grids(self) -> Iterator[Grid]:
        """Yield tables of a summary: energies, loads of links, members and clutches, damage."""
        quantity, energy = ("mean power, W" if self.are_shares else "energy, J"), self.energy
        lost = [(word(f"lost: {name}"), loss) for name, loss in energy.lost.items() if loss]
        rows = [
            (word("in"), energy.in_),
            (word("out"), energy.out),
            *lost,
            (word("efficiency"), self.efficiency),
        ]
        yield grid_of("Duty cycle", ["", quantity], rows, key="duty")
        members = [
            (
                name,
                load.torque.largest,
                load.torque.row or math.nan,
                load.speed.largest,
                load.speed.row,
                load.revolutions,
                load.equivalent_torque,
            )
            for name, load in self.members.items()
            if load.torque.largest
        ]
        headings = (
            "member",
            "torque, N*m",
            "row of torque",
            "speed, rpm",
            "row of speed",
            "turns a second" if self.are_shares else "turns",
            f"equivalent, p = {self.exponent:.6g}, N*m",
        )
        yield grid_of("Largest over the duty cycle", headings, members, key="duty members")
        if self.damage:
            title = "Damage of the points as one record"
            yield damage_grid(self.damage, title)


DutyResults = Cycle | Spectrum
"""Results over a duty cycle of shares by gear, or of points."""


def spectrum(case: Transmission, points: DutyPoints, exponent: float = EXPONENT) -> Spectrum:
    """Calculate a duty cycle by points.

    Parameters
    ----------
    case : Transmission
        Case, whose own operating points are ignored.
    points : DutyPoints
    exponent : float
        Exponent of the equivalent torque. [-]

    Raises
    ------
    CaseError
        If a point has no torques; the paths of problems are the indices of points.

    Examples
    --------
    A gear pair of efficiency 0.9 and ratio 2 for 10 s at 100 rad/s and 20 N*m: 20 kJ, of which
    2 kJ are lost.

    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 2.0, 0.9, name="pair")], [Gear()])
    >>> points = DutyPoints(*(np.array([number]) for number in (0, 100.0, 20.0, 10.0)))
    >>> loads = spectrum(case, points)
    >>> round(loads.energy.in_, 6), round(loads.energy.lost["pair"], 6), round(loads.efficiency, 9)
    (20000.0, 2000.0, 0.9)
    >>> round(loads.members["2"].torque.largest, 6), round(loads.members["2"].revolutions, 3)
    (36.0, 79.577)
    """
    loads = PointLoads.of(case, points)
    weights = points.weights / points.weights.sum() if points.are_shares else points.weights
    losses, drags = loads.losses(), loads.drag_losses()
    lost = {name: float(powers @ weights) for name, powers in (losses | drags).items()}
    entering, leaving = (float(powers @ weights) for powers in loads.port_powers())
    members = {
        name: _member(torques, speeds, weights, exponent)
        for name, (torques, speeds) in loads.members()
    }
    efficiency = leaving / entering if entering > 0 else math.nan
    energy = DutyEnergy(entering, leaving, lost)
    damage = damages(case, loads.device_torques())
    messages = not_allowed(_doubts(case, loads), case.untold)
    return Spectrum(energy, efficiency, members, messages, points.are_shares, damage, exponent)


def _doubts(case: Transmission, loads: PointLoads) -> Iterator[Message]:
    def where(row: int) -> str:
        return f"in row {row + 1}, gear {case.gears[int(loads.points.gears[row])].name}"

    yield from overloads_at_points(case, loads.held_torques, "rows", where)
    if loads.outside:
        yield outside_message(loads.outside)


def _member(torques: Floats, speeds: Floats, weights: Floats, exponent: float) -> MemberLoad:
    """Return the load of a member, from torques [N*m] and speeds [rad/s]."""
    sizes = np.abs(torques)
    turned = np.nan_to_num(np.abs(speeds)) * weights
    total = float(turned.sum())
    top = float(np.nanmax(sizes, initial=0.0))
    with np.errstate(all="ignore"):
        mean = float(((sizes / top) ** exponent) @ turned / total) if top and total else math.nan
    return MemberLoad(
        _largest(torques),
        _largest(speeds * 30 / math.pi),
        total / (2 * math.pi),
        top * mean ** (1 / exponent) if mean else math.nan,
    )


def _largest(values: Floats) -> LargestValue:
    if np.isnan(values).all():
        return LargestValue(math.nan, 0)
    row = int(np.nanargmax(np.abs(values)))
    return LargestValue(float(values[row]) + 0.0, row + 1)


def points_of(
    case: Transmission, gears: Sequence[str], numbers: Mapping[str, Sequence[float]]
) -> DutyPoints:
    """Return points from columns by name: speed, torque, and time or share.

    Raises
    ------
    CaseError
        If a gear is not in the case, or a number is out of range.
    """
    names = [gear.name for gear in case.gears]
    problems = [
        Problem("E416", f"there is no gear {gear!r} in the case", (row,))
        for row, gear in enumerate(gears)
        if gear not in names
    ]
    problems += [
        Problem("E425", "speed: read 0, expected a speed other than 0", (row,))
        for row, value in enumerate(numbers["speed"])
        if value == 0
    ]
    kind = "share" if "share" in numbers else "time"
    problems += [
        Problem("E425", f"{kind}: read {value:g}, expected 0 or more", (row,))
        for row, value in enumerate(numbers[kind])
        if value < 0
    ]
    problems += [
        Problem("E425", f"{name}: read {value:g}, expected at most {LARGEST_DUTY:g} in SI", (row,))
        for name in ("speed", "torque", kind)
        for row, value in enumerate(numbers[name])
        if abs(value) > LARGEST_DUTY
    ]
    if not problems and not sum(numbers[kind]) > 0:
        problems = [Problem("E419", f"all numbers of `{kind}` are 0, expected one above 0", (0,))]
    if problems:
        raise CaseError(problems)
    speeds, torques, weights = (np.array(numbers[name]) for name in ("speed", "torque", kind))
    indices = np.array([names.index(gear) for gear in gears])
    return DutyPoints(indices, speeds, torques, weights, kind == "share")
