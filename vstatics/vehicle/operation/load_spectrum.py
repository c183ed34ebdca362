"""A duty cycle by points: gear, speed and torque of the input, each with its time or share.

Energies of all ports and losses, and what each link, member and clutch carries over the cycle.
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
"""Of the equivalent torque, as of tooth roots and roller bearings (10/3), about."""

LARGEST_DUTY = 1e30
"""Largest number of a point in SI, above which energies and their sums may not be finite."""


class LargestValue(NamedTuple):
    """The value that is largest without its sign, and the row that has it, from 1."""

    largest: float
    row: int


class MemberLoad(NamedTuple):
    """What a link, a member of a mechanism, or a shift element carries over a duty cycle."""

    torque: LargestValue
    """[N*m]; of a link the sum of the torques above 0 on it; NaN of a planet."""
    speed: LargestValue
    """[rpm]; of a member or planet against the third link, of a shift element its slip."""
    revolutions: float
    """Of that speed; of shares in a second."""
    equivalent_torque: float
    """``(sum |T|^p n t / sum n t)^(1/p)`` with that speed n [N*m]; NaN where nothing turns."""


@json_keys(in_="in_", out="out", lost="lost")
class DutyEnergy(NamedTuple):
    """Energies of a duty cycle [J]; of shares mean powers [W]."""

    in_: float
    out: float
    lost: Mapping[str, float]
    """By mechanism, ``drag.LINK`` and ``drag.CLUTCH``."""


@json_keys("energy", "efficiency", "exponent", "members")
class Spectrum(NamedTuple):
    """What a duty cycle by points does."""

    energy: DutyEnergy
    efficiency: float
    members: Mapping[str, MemberLoad]
    messages: Sequence[Message] = ()
    """What is doubtful: laws asked outside their points, shift elements that carry too much."""
    are_shares: bool = False
    """Then energies are mean powers, and revolutions those of a second."""
    damage: Mapping[str, DeviceDamage] = MappingProxyType({})
    """Of devices with a fatigue strength, whose torques are those of the points in their order."""
    exponent: float = EXPONENT
    """Of the equivalent torques. [-]"""

    def grids(self) -> Iterator[Grid]:
        """Yield tables of a summary: energies, loads of links, members and clutches, damage."""
        what, energy = ("mean power, W" if self.are_shares else "energy, J"), self.energy
        lost = [(word(f"lost: {name}"), one) for name, one in energy.lost.items() if one]
        rows = [
            (word("in"), energy.in_),
            (word("out"), energy.out),
            *lost,
            (word("efficiency"), self.efficiency),
        ]
        yield grid_of("Duty cycle", ["", what], rows, key="duty")
        members = [
            (
                *(
                    name,
                    one.torque.largest,
                    one.torque.row or math.nan,
                    one.speed.largest,
                    one.speed.row,
                ),
                *(one.revolutions, one.equivalent_torque),
            )
            for name, one in self.members.items()
            if one.torque.largest
        ]
        headings = (
            *("member", "torque, N*m", "row of torque", "speed, rpm", "row of speed"),
            *("turns" + " a second" * self.are_shares, f"equivalent, p = {self.exponent:.6g}, N*m"),
        )
        yield grid_of("Largest over the duty cycle", headings, members, key="duty members")
        if self.damage:
            title = "Damage by the points as one record, whatever their time"
            yield damage_grid(self.damage, title)


DutyResults = Cycle | Spectrum
"""Results over a duty cycle of shares by gear, or of points."""


def spectrum(case: Transmission, points: DutyPoints, exponent: float = EXPONENT) -> Spectrum:
    """Calculate a duty cycle by points.

    Parameters
    ----------
    case : Transmission
        Loads of its own do not count.
    points : DutyPoints
    exponent : float
        Of the equivalent torque. [-]

    Raises
    ------
    CaseError
        If a point has no torques; the paths of problems are the indices of points.

    Examples
    --------
    A pair of .9 and ratio 2 for 10 s at 100 rad/s and 20 N*m: 20 kJ, of which 2 are lost.

    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 2.0, 0.9, name="pair")], [Gear()])
    >>> one = np.ones(1)
    >>> made = spectrum(case, DutyPoints(np.zeros(1, int), 100 * one, 20 * one, 10 * one))
    >>> round(made.energy.in_, 6), round(made.energy.lost["pair"], 6), round(made.efficiency, 9)
    (20000.0, 2000.0, 0.9)
    >>> round(made.members["2"].torque.largest, 6), round(made.members["2"].revolutions, 3)
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
    """What is doubtful about points of a case, whose load tells capacities."""

    def where(row: int) -> str:
        return f"in row {row + 1}, gear {case.gears[int(loads.points.gears[row])].name}"

    yield from overloads_at_points(case, loads.held_torques, "rows", where)
    if loads.outside:
        yield outside_message(loads.outside)


def _member(torques: Floats, speeds: Floats, weights: Floats, exponent: float) -> MemberLoad:
    """What one of them carries; torques [N*m], speeds [rad/s]."""
    sizes = np.abs(torques)
    turned = np.nan_to_num(np.abs(speeds)) * weights
    whole = float(turned.sum())
    top = float(np.nanmax(sizes, initial=0.0))
    with np.errstate(all="ignore"):
        mean = float(((sizes / top) ** exponent) @ turned / whole) if top and whole else math.nan
    if top == 0 and whole:
        mean = math.nan if np.isnan(torques).all() else 0.0
    return MemberLoad(
        _largest(torques),
        _largest(speeds * 30 / math.pi),
        whole / (2 * math.pi),
        top * mean ** (1 / exponent),
    )


def _largest(values: Floats) -> LargestValue:
    if np.isnan(values).all():
        return LargestValue(math.nan, 0)
    row = int(np.nanargmax(np.abs(values)))
    return LargestValue(float(values[row]) + 0.0, row + 1)


def points_of(
    case: Transmission, gears: Sequence[str], numbers: Mapping[str, Sequence[float]]
) -> DutyPoints:
    """The points of columns by name: speed, torque, and time or share.

    Raises
    ------
    CaseError
        If a gear is none of the case, or a duration is below 0.
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
    speeds, torques, weights = (np.array(numbers[one]) for one in ("speed", "torque", kind))
    indices = np.array([names.index(gear) for gear in gears])
    return DutyPoints(indices, speeds, torques, weights, kind == "share")
