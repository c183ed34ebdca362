"""Duty cycle of operating points: gear, input speed and torque, with time or share.

Results are input and output energies, losses, and the loads of links, members and shift elements.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, not_allowed
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, Integers, rounding_as_zero
from vstatics.core.statics.carried import overloads_at_points
from vstatics.core.statics.diagnosis import outside_message
from vstatics.core.statics.result_arrays import Message
from vstatics.core.tables.answer import Asked, Sometimes, json_keys
from vstatics.core.tables.grid import Grid, grid_of, word
from vstatics.vehicle.damage.devices import DeviceDamage, damages
from vstatics.vehicle.damage.tables import damage_grid
from vstatics.vehicle.duty import Cycle
from vstatics.vehicle.life.bearing_life import BearingLife, bearing_grid, bearing_lives
from vstatics.vehicle.life.classes import Classes, MemberSpectrum, spectra, spectrum_grid
from vstatics.vehicle.life.member_rows import MemberRows, equivalent
from vstatics.vehicle.life.strength import MemberLife, life_grid, lives
from vstatics.vehicle.operation.point_loads import (
    DutyPoints,
    PointLoads,
    at_rows,
    numbers_of_gears,
    unknown_gear,
)

EXPONENT = 3.0
"""Default exponent of equivalent torques, near the exponent of roller bearings (10/3). [-]"""

LARGEST_DUTY = 1e30
"""Largest speed, torque or time of a point in SI units, so that energies stay finite."""


class LargestValue(NamedTuple):
    """Value of largest magnitude, and number of its operating point from 1; 0 if unknown."""

    largest: float
    row: int


class MemberLoad(NamedTuple):
    """Load of a link, a member of a mechanism, or a shift element over a duty cycle."""

    torque: LargestValue
    """Largest torque; for a link, the sum of positive torques on it at a point; NaN for a planet.
    [N*m]
    """
    speed: LargestValue
    """Largest speed: slip of clutches, relative to the third link for members and planets. [rpm]"""
    revolutions: float
    """Number of revolutions at the speeds of `speed`; per second if points have shares. [-]"""
    equivalent_torque: float
    """``(sum |T|^p n t / sum n t)^(1/p)``; NaN if the member never turns under torque. [N*m]

    T are the torques, n the speeds, t the times or shares, and p the exponent.
    """


@json_keys(in_="in_", out="out", lost="lost")
class DutyEnergy(NamedTuple):
    """Energies of a duty cycle [J], or mean powers [W] if points have shares."""

    in_: float
    out: float
    lost: Mapping[str, float]
    """Lost energy by gear set, or by ``drag.NAME``, ``slip.NAME`` or ``gear.NAME``."""


@json_keys("energy", "efficiency", "exponent", "members", "spectrum", "life", "bearings")
class Spectrum(NamedTuple):
    """Results of a duty cycle given by operating points."""

    energy: DutyEnergy
    efficiency: float
    members: Mapping[str, MemberLoad]
    messages: Sequence[Message]
    """Warnings about laws evaluated outside their points, and about overloaded shift elements."""
    are_shares: bool
    """True if points have shares; then energies are powers, and revolutions are per second."""
    damage: Mapping[str, DeviceDamage]
    """Fatigue damage of components by name, from the torques at the points in their order."""
    exponent: float
    """Exponent of the equivalent torques. [-]"""
    spectrum: Asked[Mapping[str, MemberSpectrum]] = None
    """Load duration distribution of each member with a torque, by name, if requested."""
    life: Sometimes[Mapping[str, MemberLife]] = None
    """Life of each member with a torque strength, by name."""
    bearings: Sometimes[Mapping[str, BearingLife]] = None
    """Life of each bearing, by name."""

    def grids(self) -> Iterator[Grid]:
        """Yield the tables of a summary: energies, loads of links, members and clutches, damage."""
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
        if self.life:
            yield life_grid(self.life)
        if self.bearings:
            yield bearing_grid(self.bearings)
        if self.spectrum:
            yield spectrum_grid(self.spectrum, are_shares=self.are_shares)


DutyResults = Cycle | Spectrum
"""Results of a duty cycle, which is given by shares of the gears or by operating points."""


def spectrum(
    case: Transmission,
    points: DutyPoints,
    exponent: float = EXPONENT,
    classes: Classes | None = None,
) -> Spectrum:
    """Calculate a duty cycle of operating points; points at rest only count as time.

    Parameters
    ----------
    case : Transmission
        Case; its operating points are ignored.
    points : DutyPoints
    exponent : float
        Exponent of the equivalent torque. [-]
    classes : int or sequence of float, optional
        Number of torque classes of the load spectra, or upper bounds of the classes [N*m]. Without
        it no spectra are calculated.

    Raises
    ------
    CaseError
        If a point has no torques, or if all speeds are 0; the path of a problem is the index of its
        point.

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
    moving = np.flatnonzero(points.speeds)
    if not moving.size:
        raise CaseError([Problem("E425", "speed: read 0 everywhere, expected a speed", (0,))])
    loads = _loads_of(case, points, moving)
    weights = points.weights / points.weights.sum() if points.are_shares else points.weights
    standing = float(np.delete(weights, moving).sum())
    weights = weights[moving]
    losses = loads.losses() | loads.other_losses()
    lost = {name: float(powers @ weights) for name, powers in losses.items()}
    entering, leaving = (float(powers @ weights) for powers in loads.port_powers())
    by_member = _without_rounding(loads.members())
    members = {
        name: _member(torques, speeds, weights, exponent, moving)
        for name, (torques, speeds) in by_member.items()
    }
    rows = MemberRows.of(case, by_member, weights, standing, loads.speeds)
    efficiency = leaving / entering if entering > 0 else math.nan
    energy = DutyEnergy(entering, leaving, lost)
    damage = damages(case, loads.device_torques())
    messages = not_allowed(_doubts(case, loads, moving), case.untold)
    return Spectrum(
        energy,
        efficiency,
        members,
        messages,
        points.are_shares,
        damage,
        exponent,
        None if classes is None else spectra(rows, classes),
        lives(case, rows),
        bearing_lives(case, rows),
    )


def _loads_of(case: Transmission, points: DutyPoints, moving: Integers) -> PointLoads:
    """Solve the points `moving`; problems have indices of `points`."""
    parts = points._replace(
        gears=points.gears[moving],
        speeds=points.speeds[moving],
        torques=points.torques[moving],
        weights=points.weights[moving],
    )
    try:
        return PointLoads.of(case, parts)
    except CaseError as error:
        raise at_rows(error, moving) from None


def _without_rounding(
    members: Iterable[tuple[str, tuple[Floats, Floats]]],
) -> dict[str, tuple[Floats, Floats]]:
    """Return torques and speeds by name, with rounding noise set to 0.

    Noise is relative to the largest torque or speed. Otherwise members of a gear set that rotates
    as a block would have small relative speeds, and unloaded links small torques.
    """
    names, loads = zip(*members, strict=True)
    torques, speeds = (rounding_as_zero(np.array(kind)) for kind in zip(*loads, strict=True))
    return {name: (torques[row], speeds[row]) for row, name in enumerate(names)}


def _doubts(case: Transmission, loads: PointLoads, moving: Integers) -> Iterator[Message]:
    def where(row: int) -> str:
        return f"in row {moving[row] + 1}, gear {case.gears[int(loads.points.gears[row])].name}"

    yield from overloads_at_points(case, loads.held_torques, "rows", where)
    if loads.outside:
        yield outside_message(loads.outside)


def _member(
    torques: Floats, speeds: Floats, weights: Floats, exponent: float, places: Integers
) -> MemberLoad:
    """Return the load of a member from torques [N*m] and speeds [rad/s] at points `places`."""
    turned = np.nan_to_num(np.abs(speeds)) * weights
    return MemberLoad(
        _largest(torques, places),
        _largest(speeds * 30 / math.pi, places),
        float(turned.sum()) / (2 * math.pi),
        equivalent(np.abs(torques), turned, exponent) or math.nan,
    )


def _largest(values: Floats, places: Integers) -> LargestValue:
    if np.isnan(values).all():
        return LargestValue(math.nan, 0)
    row = int(np.nanargmax(np.abs(values)))
    return LargestValue(float(values[row]) + 0.0, int(places[row]) + 1)


def points_of(
    case: Transmission, gears: Sequence[str], numbers: Mapping[str, Sequence[float]]
) -> DutyPoints:
    """Return operating points from columns of speed, torque, and time or share.

    Raises
    ------
    CaseError
        If a gear is not in the case, or a number is out of range.
    """
    chosen = numbers_of_gears(case, gears)
    problems = [
        Problem("E416", unknown_gear(case, gear), (row,))
        for row, (gear, speed) in enumerate(zip(gears, numbers["speed"], strict=True))
        if chosen[row] is None and speed
    ]
    kind = _weighing(numbers)
    if problems := [*problems, *wrong_numbers(numbers)]:
        raise CaseError(problems)
    speeds, torques, weights = (np.array(numbers[name]) for name in ("speed", "torque", kind))
    indices = np.array([number or 0 for number in chosen])
    return DutyPoints(indices, speeds, torques, weights, kind == "share")


def _weighing(numbers: Mapping[str, Sequence[float]]) -> str:
    return next(name for name in ("share", "duration", "time") if name in numbers)


def wrong_numbers(numbers: Mapping[str, Sequence[float]]) -> list[Problem]:
    """Return the problems in columns of a duty cycle, with their rows."""
    kind = _weighing(numbers)
    problems = [
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
    return problems
