"""Gear of a vehicle with a free converter: its speed ratio i follows from the torque on its pump.

Engine and output turn independently: each link has the speed ``a w + b x + c`` at the engine speed
w and the output speed x. Slips in rpm add the constant c. Both speeds determine i. At the speed
w_P, the pump takes the torque ``lambda(i) w_P |w_P|``, and the gearbox supplies the torque M to it,
with all losses. The engine speed is a root of the surplus of torque, ``(M - lambda(i) w_P
|w_P|)/w^2``. The surplus is nearly a quadratic polynomial of 1/w between the points of engine and
converter. Roots are bracketed between these points, and approached by the Illinois rule (Dowell,
Jarratt 1971).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.parts import Gear, Load, OfLoad
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.statics.freewheels import with_engaged
from vstatics.core.statics.points.converters import lossless_ratios
from vstatics.core.statics.points.roots import EDGE_STEPS, Edges
from vstatics.core.statics.result_arrays import first_rows, row_names
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.vehicle.case.vehicle import beside_engine, free_converters
from vstatics.vehicle.tolerances import (
    APPROACHES,
    BELOW_LOCK,
    LEAST_EXCESS,
    LOSSLESS,
    NO_SPEED,
    SAME_SPEED,
)

INTERVALS = 2
"""Number of intervals between neighbouring points that are searched for sign changes."""
MOST_STEPS = 100
"""Largest number of steps of the Illinois rule."""
MOST_DOUBLINGS = 40
"""Largest number of times that a trial torque or force is doubled, to bracket a root."""
MOST_POINTS_AT_ONCE = 100_000
"""Largest number of operating points that are solved at once, to limit memory."""
SLOWEST_PART = 4.0 ** -np.arange(1.0, 6.0)
"""Engine speeds near 0 that bracket roots, relative to the last engine speed. [-]"""
FASTEST_OF_SEARCH = 1e7
"""Largest engine speed of the search. [rad/s]"""

Carried = Callable[[Integers, Floats], Floats]
"""Torques of all devices, shape (rows, devices) [N*m].

The arguments are row indices, and engine speeds or torques.
"""
Surplus = Callable[[Integers, Floats], Floats]
"""Function of row indices and trials, whose roots are sought."""

Limits = tuple[float, float, float]
"""Largest speed ratio [-], and smallest and largest inverse engine speed [s/rad]."""


def free_ratio(points: Floats) -> float:
    """Return the largest speed ratio at which the pump of a converter does not brake [-].

    >>> free_ratio(np.array([[0, 2, 0.002], [0.9, 1, 0.001], [1.1, 1, -0.001]])).__round__(9)
    1.0
    """
    ratios, factors = points[:, 0], points[:, 2]
    braking = np.flatnonzero(factors < 0)
    if not braking.size or not braking[0]:
        return float(ratios[-1])
    before, after = braking[0] - 1, braking[0]
    part = factors[before] / (factors[before] - factors[after])
    return float(ratios[before] + part * (ratios[after] - ratios[before]))


def bare(case: Transmission) -> Transmission:
    """Return a case without operating points and without coasting, for calculations at any point.

    Free converters have the largest speed ratio without braking torque.
    """
    gears = []
    for gear in case.gears:
        ratios = dict(gear.speed_ratios)
        for place in free_converters(case, gear):
            ratios[place + 1 - case.own_mechanisms.start] = free_ratio(_usable(case, gear, place))
        gears.append(gear._replace(load=None, coast=None, speed_ratios=ratios))
    return replace(case, gears=gears, load=Load(1000.0, 1.0), coast=None)


def solved_slips(case: Transmission) -> tuple[Results, Floats]:
    """Return results of a bare case with slips in rpm set to 0, and the speeds that slips add.

    The speed of a link is its relative speed times the engine speed, plus the added speed [rad/s].
    Drag is left out, because a drag above the torque of the bare case would let freewheels overrun.
    """
    case = case.replace(
        drag={},
        shift_elements=[element._replace(drag=0.0) for element in case.shift_elements],
        gears=[gear._replace(drag={}, open_drag={}, loss=None) for gear in case.gears],
    )
    gears = [
        gear._replace(
            slip={n: 0.0 if isinstance(slip, OfLoad) else slip for n, slip in gear.slip.items()}
        )
        for gear in case.gears
    ]
    results = solve(case.replace(gears=gears))
    added = solve(case).speeds_rpm - results.speeds_rpm
    return results, added * math.pi / 30


def relative_slips(case: Transmission, gear: Gear) -> dict[str, float]:
    """Return the nonzero slips of a gear relative to the input speed, by path [-]."""
    return {
        f"gears.{gear.name}.slip.{case.shift_elements[number - 1].name}": slip
        for number, slip in gear.slip.items()
        if slip and not isinstance(slip, OfLoad)
    }


def converters_of(case: Transmission) -> dict[int, ConverterGear]:
    """Return gears with a free converter and no other drive than the engine, by index.

    Raises
    ------
    CaseError
        If the output speed of such a gear does not depend on the converter's speed ratio.
    """
    gears = {
        index: ConverterGear.of(case, index)
        for index, gear in enumerate(case.gears)
        if free_converters(case, gear) and not beside_engine(case, gear)
    }
    return {index: gear for index, gear in gears.items() if gear}


class EngineSearch(NamedTuple):
    """Result of a search for engine speeds; each row is an output speed."""

    engine: Floats
    """Engine speeds at the largest speed ratio of all solutions; NaN without a solution. [rad/s]"""
    surplus: Floats
    """Sign of the torque surplus at the largest and the smallest speed ratio, shape (rows, 2).

    The largest ratio here is the largest at which the converter has torques. In rows with a
    solution, the second sign is NaN or arbitrary.
    """
    ends: Floats
    """Engine speeds at the largest and the smallest speed ratio, shape (rows, 2). [rad/s]"""


class ConverterGear(NamedTuple):
    """Gear with a free converter, whose speed ratio follows from the torque on its pump."""

    case: Transmission
    """Case with the gear alone."""
    name: str
    """Name of the converter."""
    path: str
    """Path of the speed ratio for the argument `vary` of `solve`."""
    row: int
    """Index of the torque on the pump among the torques of results."""
    stops: bool
    """True if a freewheel limits the speed ratio to 1, where it supplies torque to the pump."""
    points: Floats
    """Rows of speed ratio, torque ratio and lambda, shape (points, 3).

    Interpolated rows are at the free ratio and on both sides of each lossless ratio.
    """
    per_engine: Floats
    """Speeds of pump, turbine and links divided by engine speed, with the output at rest. [-]"""
    per_output: Floats
    """Speeds of pump, turbine and links divided by output speed, with the engine at rest. [-]"""
    added: Floats
    """Speeds of pump, turbine and links that slips in rpm add. [rad/s]"""

    @classmethod
    def of(cls, case: Transmission, index: int) -> ConverterGear | None:
        """Return a gear with a free converter, None if its speeds are indeterminate.

        Raises
        ------
        CaseError
            If the output speed does not depend on the speed ratio.
        """
        known, (place, *_) = bare(case), case.sought_converters(case.gears[index])
        alone = known.replace(gears=[known.gears[index]])
        gear, mechanism = alone.gears[0], alone.mechanisms[place]
        free = alone.gear_ratios(gear)[place]
        points = _with_searched(_usable(case, case.gears[index], place), free)
        path = f"gears.{gear.name}.speed_ratios.{mechanism.name}"
        results, [change] = solved_slips(alone)
        speeds = solve(results.case, vary={path: [free, free - 0.5]}).speeds[:, 0]
        out = case.gear_output(gear) - 1
        output = speeds[:, out]
        ends = [mechanism.first - 1, mechanism.second - 1]
        if not np.isfinite([output, *speeds[:, ends].T]).all():
            return None
        fastest = np.nanmax(np.abs(speeds))
        if abs(output[0] - output[1]) <= NO_SPEED * fastest:
            message = (
                f"the speed of the output does not depend on {mechanism.name} in gear {gear.name}, "
                "so its speed ratio is unknown: give a `speed_ratio`, or list it under `open`"
            )
            raise CaseError("E429", message, ("gears", index + 1))
        per_output = (speeds[0] - speeds[1]) / (output[0] - output[1])
        per_engine = speeds[0] - per_output * output[0]
        noise = np.abs(per_engine) <= NO_SPEED * fastest
        added = change - per_output * change[out]
        added[np.abs(added) <= NO_SPEED * np.abs(results.speeds_rpm).max()] = 0.0
        arrays = np.where(noise, 0.0, per_engine), per_output * np.sign(output[0]), added
        turns = [np.concatenate([array[ends], array]) for array in arrays]
        row = first_rows(alone)[place]
        stops = bool(points[-1, 0] == 1 and alone.freewheel_side(gear, place))
        return cls(alone, mechanism.name, path, row, stops, points, *turns)

    @property
    def free_ratio(self) -> float:
        """Largest speed ratio at which the pump does not brake [-]."""
        return free_ratio(self.points)

    def _turned(self, place: int, output: Floats) -> Floats:
        """Return the speed of pump (0) or turbine (1) if the engine is at rest [rad/s]."""
        speeds: Floats = self.per_output[place] * output + self.added[place]
        return speeds

    def _ratio(self, engine: Floats, output: Floats) -> Floats:
        pump, turbine = (self.per_engine[n] * engine + self._turned(n, output) for n in (0, 1))
        with np.errstate(all="ignore"):
            ratio: Floats = turbine / pump
        return ratio

    def ratio(self, engine: Floats, output: Floats) -> Floats:
        """Return speed ratios at engine and output speeds [rad/s], limited to the points.

        Ratios that differ from a point by rounding noise become equal to it. Slightly above the
        ratio 1, a converter would gain power.
        """
        ratio = self._ratio(engine, output)
        for point in self.points[:, 0]:
            ratio = np.where(np.abs(ratio - point) <= SAME_SPEED, point, ratio)
        return np.clip(ratio, self.points[0, 0], self.points[-1, 0])

    def driven_ratio(self, engine: Floats, output: Floats) -> Floats:
        """Return speed ratios as `ratio` does, but `BELOW_LOCK` instead of 1 with freewheels."""
        ratio = self.ratio(engine, output)
        at_lock = (ratio == 1) & bool(self.case.freewheels)
        return np.where(at_lock, BELOW_LOCK, ratio)

    def _inverse(self, ratios: Floats, output: Floats) -> Floats:
        """Return inverse engine speeds at speed ratios, shape (rows, ratios) [s/rad]."""
        pump, turbine = self.per_engine[:2]
        by_pump, by_turbine = (self._turned(n, output[:, None]) for n in (0, 1))
        with np.errstate(all="ignore"):
            inverse: Floats = (ratios * pump - turbine) / (by_turbine - ratios * by_pump)
        return inverse

    def engine_at(self, ratio: float, output: Floats) -> Floats:
        """Return engine speeds at a speed ratio, for output speeds, shape (rows,) [rad/s]."""
        with np.errstate(divide="ignore"):
            speeds: Floats = 1 / self._inverse(np.array([ratio]), output)[:, 0]
        return speeds

    def taken(self, engine: Floats, output: Floats) -> tuple[Floats, Floats]:
        """Return the torque that the pump takes [N*m], and the sign of its speed."""
        pump = self.per_engine[0] * engine + self._turned(0, output)
        factors = np.interp(self.ratio(engine, output), self.points[:, 0], self.points[:, 2])
        return factors * pump * np.abs(pump), np.sign(pump)

    def is_driving(self, engine: Floats, output: Floats) -> Booleans:
        """Return True where a torque in the direction of the pump's speed drives the output.

        The direction follows from the virtual work of the torques on pump and turbine at constant
        engine speed. In some power splits such a torque brakes the output.
        """
        factors = np.interp(self.ratio(engine, output), self.points[:, 0], self.points[:, 1])
        _, direction = self.taken(engine, output)
        driving: Booleans = direction * (factors * self.per_output[1] - self.per_output[0]) > 0
        return driving

    def is_bypassed(
        self, case: Transmission, load: tuple[Floats, Floats], further: Mapping[str, Floats]
    ) -> Booleans:
        """Return True where a freewheel connects pump and turbine, so the converter has no torque.

        Parameters are as in `torques`. Where the converter drives, the freewheel overruns at every
        speed ratio below 1.
        """
        holding = with_engaged(case.gears[0], case.freewheels)
        if not case.bypassed(holding) or not len(load[0]):
            return np.zeros(len(load[0]), np.bool_)
        below = np.full(len(load[0]), min(self.free_ratio, 1.0) * BELOW_LOCK)
        vary = {"load.speed": load[0], "load.torque": load[1], self.path: below}
        results = solve(case, vary={**vary, **further})
        number = row_names(case, "converters").index(self.name)
        bypassed: Booleans = np.isnan(results.speed_ratio[:, 0, number]) & results.consistent[:, 0]
        return bypassed

    def torques(
        self,
        case: Transmission,
        load: tuple[Floats, Floats],
        ratios: Floats,
        further: Mapping[str, Floats],
    ) -> Floats:
        """Return the torques of all devices with losses, shape (rows, devices) [N*m].

        Parameters
        ----------
        case : Transmission
            `self.case`, or this case with input and output exchanged.
        load : tuple of ndarray
            Speeds [rad/s] and torques [N*m] of the input of `case`.
        ratios : ndarray
            Speed ratios of the converter. [-]
        further : mapping
            Values of other numbers, by path.
        """
        if not len(ratios):
            return np.zeros((0, self.row + 1))
        vary = {"load.speed": load[0], "load.torque": load[1], self.path: ratios}
        torques: Floats = solve(case, vary={**vary, **further}).lossy_torques_Nm[:, 0]
        return torques

    def search(
        self, inverse: Floats, limits: Limits, output: Floats, carried: Carried
    ) -> EngineSearch:
        """Search for engine speeds at which the pump takes the supplied torque.

        Parameters
        ----------
        inverse : ndarray, shape (points,)
            Inverse engine speeds at which the slope of the torque can change. [s/rad]
        limits : tuple of float
            Largest speed ratio [-], smallest and largest inverse engine speed [s/rad].
        output : ndarray, shape (rows,)
            Magnitudes of output speeds. [rad/s]
        carried : callable
            Function of row indices and engine speeds that returns `torques`.
        """
        count = max(1, MOST_POINTS_AT_ONCE // (INTERVALS * (len(inverse) + len(self.points) + 1)))
        parts = []
        for start in range(0, max(len(output), 1), count):
            rows = np.arange(start, min(start + count, len(output)))
            places = self._places(inverse, limits, output[rows])
            parts.append(self._searched(rows, places, output[rows], carried))
        return EngineSearch(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))

    def _places(self, inverse: Floats, limits: Limits, output: Floats) -> Floats:
        """Return inverse engine speeds [s/rad] by descending speed ratio, with NaN at the end."""
        top, least, most = limits
        ratios = np.append(self.points[self.points[:, 0] < top, 0], top)
        at_points = self._inverse(ratios, output)
        places = np.concatenate(
            [at_points, np.broadcast_to(inverse, (len(output), len(inverse)))], axis=1
        )
        with np.errstate(all="ignore"):
            ratio = self._ratio(1 / places, output[:, None])
            room = SAME_SPEED * np.maximum(np.abs(ratio), 1.0)
            valid = np.isfinite(places) & (places >= least * (1 - SAME_SPEED))
            valid &= places <= most * (1 + SAME_SPEED)
            valid &= (ratio >= ratios[0] - room) & (ratio <= top + room)
        pump, turbine = self.per_engine[:2]
        by_pump, by_turbine = (self._turned(n, output[:, None]) for n in (0, 1))
        order = np.where(pump * by_turbine > turbine * by_pump, -1.0, 1.0)
        places = order * np.sort(np.where(valid, order * places, np.nan), axis=1)  # NaN comes last
        parts = np.arange(INTERVALS) / INTERVALS
        between = places[:, :-1, None] * (1 - parts) + places[:, 1:, None] * parts
        between[:, :, 0] = places[:, :-1]  # even if the next inverse speed is NaN
        return np.concatenate([between.reshape(len(output), -1), places[:, -1:]], axis=1)

    def _searched(
        self, rows: Integers, places: Floats, output: Floats, carried: Carried
    ) -> EngineSearch:
        """Search for engine speeds in some rows; rows whose `places` are all NaN give NaN."""
        known = np.isfinite(places)

        def surplus(at: Integers, inverse: Floats) -> Floats:
            engine = 1 / inverse
            taken, direction = self.taken(engine, output[at])
            return direction * (carried(rows[at], engine)[:, self.row] - taken) * inverse**2

        values, sought = np.full(places.shape, np.nan), known.copy()
        for start in range(0, places.shape[1], INTERVALS):
            at, columns = np.nonzero(sought[:, start : start + INTERVALS])
            values[at, columns + start] = surplus(at, places[at, columns + start])
            # Places beyond the first sign change of a row do not affect its root.
            sought[_changes(values).any(axis=1)] = False
        signs = np.sign(values)
        inverse = _first_roots(places, values, surplus)
        lacking = np.flatnonzero(np.isnan(inverse))
        # A gear can be self-locking at only one of two neighbouring places.
        edges = Edges.of(places[lacking].T, values[lacking].T)
        for _ in range(EDGE_STEPS if edges.point.size else 0):
            edges = edges.halved(surplus(lacking[edges.point], edges.middle))
        tried, at_tried = edges.inserted(places[lacking].T, values[lacking].T)
        inverse[lacking] = _first_roots(
            tried.T, at_tried.T, lambda at, inverse: surplus(lacking[at], inverse)
        )
        last = np.maximum(known.sum(axis=1) - 1, 0)
        of_signs = np.stack([np.isfinite(signs).argmax(axis=1), last], axis=1)
        of_ends = np.stack([np.zeros_like(last), last], axis=1)
        return EngineSearch(
            1 / inverse,
            np.take_along_axis(signs, of_signs, axis=1),
            1 / np.take_along_axis(places, of_ends, axis=1),
        )

    def torque_at(self, engine: Floats, output: Floats, carried: Carried) -> Floats:
        """Return engine torques [N*m] that supply the torque of the pump; NaN without a solution.

        Parameters
        ----------
        engine, output : ndarray, shape (rows,)
            Engine speeds, and magnitudes of output speeds. [rad/s]
        carried : callable
            Function of row indices and engine torques that returns `torques`.
        """
        taken, direction = self.taken(engine, output)
        everywhere = np.arange(len(engine))

        def surplus(at: Integers, torque: Floats) -> Floats:
            # The torque is NaN where the converter would deliver more power than it receives. Count
            # this as too little torque on the pump or, when coasting, too little braking torque.
            left = direction[at] * (carried(at, torque)[:, self.row] - taken[at])
            return np.where(np.isnan(left), -gained[at], left)

        gained = np.where(direction * taken < 0, -1, 1) * (np.abs(taken) + 1)
        start = np.zeros(len(engine))
        at_start = surplus(everywhere, start)
        size = 1 + 2 * np.abs(taken * self.per_engine[0])
        end = np.where(at_start > 0, -size, size)
        at_end = surplus(everywhere, end)
        for _ in range(MOST_DOUBLINGS):
            wide = np.flatnonzero(at_end * at_start > 0)
            if not wide.size:
                break
            start[wide], at_start[wide] = end[wide], at_end[wide]
            end[wide] *= 2
            at_end[wide] = surplus(wide, end[wide])
        has_root: Booleans = at_end * at_start <= 0
        torques = np.full(len(engine), np.nan)
        lacks = at_start == -gained
        rows = np.flatnonzero(has_root & (lacks | (at_end == -gained)))
        ends = np.where(lacks, (start, end), (end, start))[:, rows]
        torques[rows] = self._opening(lambda part, x: carried(rows[part], x), *ends)
        rows = rows[np.isfinite(torques[rows])]
        passed = surplus(rows, torques[rows]) * np.where(lacks, at_end, at_start)[rows] < 0
        torques[rows[passed]] = np.nan
        rows = np.flatnonzero(has_root & np.isnan(torques))
        torques[rows] = illinois_root(
            lambda part, x: surplus(rows[part], x),
            (start[rows], end[rows]),
            (at_start[rows], at_end[rows]),
        )
        lacking = rows[np.isnan(carried(rows, torques[rows])[:, self.row])]
        torques[lacking] += np.sign(gained[lacking]) * LEAST_EXCESS * (1 + np.abs(torques[lacking]))
        return torques

    def _opening(self, carried: Carried, lacking: Floats, solved: Floats) -> Floats:
        """Return engine torques [N*m] just before a freewheel opens; NaN where none is found.

        The torque of a freewheel is nearly linear in the engine torque, so a secant predicts where
        it is 0. Beyond this engine torque the gear has no torques.

        Parameters
        ----------
        carried : callable
            As in `torque_at`.
        lacking, solved : ndarray, shape (rows,)
            Engine torques without and with a solution. [N*m]
        """
        everywhere, freewheels = np.arange(len(solved)), np.array(self.case.freewheels, int) - 1
        if not len(solved) or not freewheels.size:
            return np.full(len(solved), np.nan)
        before = solved + (solved - lacking)
        at_before, at_solved = (carried(everywhere, x) for x in (before, solved))
        for part in APPROACHES:
            with np.errstate(all="ignore"):
                change = (at_solved - at_before)[:, freewheels] / (solved - before)[:, None]
                zeros = solved[:, None] - at_solved[:, freewheels] / change
            inside = (zeros - lacking[:, None]) * (zeros - solved[:, None]) < 0
            nearest = np.where(inside, np.abs(zeros - solved[:, None]), np.inf).argmin(axis=1)
            zero = np.where(inside.any(axis=1), zeros[everywhere, nearest], (lacking + solved) / 2)
            trial = zero + part * (solved - zero)
            at_trial = carried(everywhere, trial)
            fits = np.isfinite(at_trial[:, self.row])
            lacking = np.where(fits, lacking, trial)
            before, solved = np.where(fits, (solved, trial), (before, solved))
            at_before, at_solved = np.where(
                fits[:, None], (at_solved, at_trial), (at_before, at_solved)
            )
        is_near = np.abs(solved - lacking) <= LEAST_EXCESS * (1 + np.abs(solved))
        return np.where(is_near, solved, np.nan)


def _usable(case: Transmission, gear: Gear, place: int) -> Floats:
    """Return the points of a converter, up to the speed ratio 1 if a freewheel can lock it up."""
    points = np.array(case.mechanisms[place].points)
    if points[-1, 0] <= 1 or not case.freewheel_side(gear, place):
        return points
    ratios = np.append(points[points[:, 0] < 1, 0], 1.0)
    return _interpolated(points, ratios)


def _interpolated(points: Floats, ratios: Floats) -> Floats:
    return np.stack([np.interp(ratios, points[:, 0], column) for column in points.T], axis=1)


def _with_searched(points: Floats, free: float) -> Floats:
    """Return the points of a converter, with points interpolated where torques can begin or end.

    These are the free ratio, and both sides of each ratio at which the converter loses no power.
    """
    lossless = np.array(lossless_ratios(points))
    lossless = lossless[[np.abs(points[:, 0] - ratio).min() > LOSSLESS for ratio in lossless]]
    sides = np.outer(lossless, [1 - LOSSLESS, 1 + LOSSLESS]).ravel()
    sides = sides[(sides > points[0, 0]) & (sides < points[-1, 0])]
    ratios = np.unique([*points[:, 0], free, *sides])
    return _interpolated(points, ratios)


def _changes(values: Floats) -> Booleans:
    """Return flags of sign changes between neighbouring columns."""
    signs = np.sign(values)
    changes: Booleans = signs[:, :-1] * signs[:, 1:] <= 0  # False if either sign is NaN
    return changes


def _first_roots(places: Floats, values: Floats, surplus: Surplus) -> Floats:
    """Return the root at the first sign change in each row of places, NaN without a change."""
    changes = _changes(values)
    first = changes.argmax(axis=1)
    solved = np.flatnonzero(changes.any(axis=1))
    inverse = np.full(len(places), np.nan)
    ends = (solved, first[solved]), (solved, first[solved] + 1)
    # At low engine speeds the surplus is nearly linear in the square of the inverse speed.
    squares = illinois_root(
        lambda part, x: surplus(solved[part], np.sqrt(x)),
        (places[ends[0]] ** 2, places[ends[1]] ** 2),
        (values[ends[0]], values[ends[1]]),
    )
    inverse[solved] = np.sqrt(squares)
    return inverse


def illinois_root(
    function: Surplus, ends: tuple[Floats, Floats], values: tuple[Floats, Floats]
) -> Floats:
    """Return roots of a function between `ends`, where its values have opposite signs.

    The arguments of the function are the indices of the roots and a trial for each of them.
    """
    (low, high), (at_low, at_high) = map(np.copy, ends), map(np.copy, values)
    swap = np.abs(at_low) < np.abs(at_high)
    low[swap], high[swap] = high[swap], low[swap]
    at_low[swap], at_high[swap] = at_high[swap], at_low[swap]
    open_ = np.flatnonzero((at_high != 0) & (low != high))
    for _ in range(MOST_STEPS):
        if not open_.size:
            break
        a, b, at_a, at_b = (array[open_] for array in (low, high, at_low, at_high))
        new = b - at_b * (b - a) / (at_b - at_a)
        at_new = function(open_, new)
        turned = np.sign(at_new) != np.sign(at_b)
        low[open_] = np.where(turned, b, a)
        at_low[open_] = np.where(turned, at_b, at_a / 2)
        high[open_], at_high[open_] = new, at_new
        still = np.abs(new - b) > SAME_SPEED * np.abs(new)
        open_ = open_[still & (at_new != 0) & np.isfinite(at_new)]
    return high
