"""Traction of a vehicle: wheel force in each gear, top speed, slope, acceleration.

The wheel force is ``F = Mx final_drive/radius``, with the output torque Mx at full load after
losses. The acceleration is ``(F - R)/(m + sum J k^2)`` in the gear where it is largest, with the
road resistance R, the vehicle mass m, and inertias J. For each inertia, ``k = w/v`` is the speed of
its link divided by the road speed.

The speed ratio of a free converter follows from the torque on its pump at each road speed. Where
the engine would exceed its last full-load point, it remains there and supplies the torque that the
pump takes. In such a gear, k is the change of w with v at constant engine speed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.core.model.carried import as_type
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.constants import GRAVITY
from vstatics.core.statics.solve import solve
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.case.vehicle import Vehicle, beside_engine
from vstatics.vehicle.operation.converter import (
    SLOWEST_PART,
    ConverterGear,
    bare,
    converters_of,
    solved_slips,
)
from vstatics.vehicle.operation.shifting import directions
from vstatics.vehicle.tolerances import AT_REST, SAME_SPEED

if TYPE_CHECKING:
    from vstatics.core.summary import Summary

KMH = 3.6
"""Factor from m/s to km/h."""
HUNDRED = 100 / KMH
"""Speed of 100 km/h. [m/s]"""
SPEEDS_OF_ENGINE = 256
"""Number of intervals of engine speed in each narrowing of a search."""
NARROWINGS = 5
"""Number of narrowings of the interval, for a relative accuracy of 1e-12."""
STEPS_TO_100 = 2000
"""Number of intervals that integrate the time to 100 km/h, in addition to engine points."""
CONVERTER_POINTS = 2049
"""Number of speeds between which forces are interpolated in a gear with a free converter."""


class GearPerformance(NamedTuple):
    """Performance of a vehicle in a gear; NaN if undefined."""

    top_speed: float
    """Top speed on a level road. [km/h]"""
    slope: float
    """Sine of the angle of the steepest ascent; 1 if the wheel force exceeds the weight. [-]"""


class Performance(NamedTuple):
    """Performance of a vehicle at full engine load.

    Examples
    --------
    >>> from vstatics import Vehicle, example, solve, summarize
    >>> engine = Vehicle(1000, 0.5, engine=[(0, 125), (400, 125)])
    >>> summary = summarize(solve(example("simpson").replace(vehicle=engine)))
    >>> performance = Performance.of(summary)
    >>> performance.top_speed if performance else 0.0  # 400 rad/s, wheels of 0.5 m
    720.0
    """

    gears: Mapping[str, GearPerformance]
    top_speed: float
    """Top speed of all forward gears. [km/h]"""
    time_to_100: float
    """Time from rest to 100 km/h at full load, shifting in no time; NaN if unreachable. [s]"""

    @classmethod
    def of(cls, summary: Summary) -> Performance | None:
        """Return the performance in a summary, None without a vehicle with an engine."""
        return as_type(summary.vehicle, cls)

    def grids(self) -> Iterator[Grid]:
        """Yield tables for a summary: of the gears, and of the vehicle."""
        rows = [(name, gear.top_speed, gear.slope) for name, gear in self.gears.items()]
        headings = "gear", "top speed, km/h", "slope"
        yield grid_of("Vehicle at full load", headings, rows, key="vehicle gears")
        row = self.top_speed, self.time_to_100
        yield grid_of("Vehicle", ["top speed, km/h", "0 to 100 km/h, s"], [row], key="vehicle")


def vehicle_section(case: Transmission) -> Performance | None:
    """Return the performance of a case, None if no vehicle has a full-load curve."""
    vehicle = Vehicle.of(case)
    return performance(case) if vehicle and vehicle.full_load else None


def performance(case: Transmission) -> Performance:
    """Calculate top speeds, slopes and the time to 100 km/h of a vehicle with an engine.

    Examples
    --------
    A vehicle of 1000 kg with a wheel force of 1000 N up to a wheel speed of 100 rad/s, at a radius
    of 0.5 m, without resistance: the last engine speed limits it to 180 km/h, and it reaches 100
    km/h in 27.8 s.

    >>> from vstatics import Gear, Mechanism
    >>> car = Vehicle(1000, 0.5, engine=[(0.0, 125.0), (400.0, 125.0)])
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear(name="1")], vehicle=car)
    >>> car_performance = performance(case)
    >>> round(car_performance.top_speed, 6), round(car_performance.time_to_100, 6)
    (180.0, 27.777778)
    >>> round(car_performance.gears["1"].slope, 6)
    0.101937
    """
    vehicle = Vehicle.of(case)
    assert vehicle is not None and vehicle.full_load  # noqa: PT018, S101 - callers check
    pull = Traction(case, vehicle)
    gears = {
        gear.name: GearPerformance(KMH * pull.top_speed(number), pull.slope(number))
        for number, gear in enumerate(case.gears)
    }
    ahead = [case.gears[index].name for index in pull.ahead]
    known = [gears[name].top_speed for name in ahead if math.isfinite(gears[name].top_speed)]
    return Performance(gears, max(known, default=math.nan), pull.time_to_100())


class Traction:
    """Wheel force and road resistance over road speed.

    >>> from vstatics import Gear, Mechanism
    >>> car = Vehicle(1000, 0.5, engine=[(0.0, 125.0), (400.0, 125.0)])
    >>> pull = Traction(Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()]), car)
    >>> pull.largest_force(0), pull.largest_power, pull.largest_speed(0)
    (1000.0, 50000.0, 50.0)
    """

    def __init__(self, case: Transmission, vehicle: Vehicle) -> None:
        """Calculate the speeds in the gears of a case, for a vehicle with an engine."""
        self.converters = converters_of(case)
        """Gears with a free converter, whose speed ratio follows from torques, by index."""
        is_alone = [not beside_engine(case, gear) for gear in case.gears]
        self.case = case = bare(case)
        self.vehicle = vehicle
        self.first, self.last = vehicle.full_load[0][0], vehicle.full_load[-1][0]
        results, added = solved_slips(case)
        outputs = [case.gear_output(gear) - 1 for gear in case.gears]
        speeds = results.speeds
        output = speeds[np.arange(len(outputs)), outputs]
        output = np.where(is_alone, output, math.nan)
        """Output speed divided by engine speed, by gear. [-]

        Free converters have their largest speed ratio without braking torque.
        """
        with np.errstate(all="ignore"):
            self.per_engine = np.abs(output) * vehicle.radius / vehicle.final_drive
            self.at_rest = -added[np.arange(len(outputs)), outputs] / output
            """Engine speed from slips in rpm while the vehicle is at rest, by gear. [rad/s]"""
            links = np.array([case.heavy.get(n + 1, 0.0) for n in range(speeds.shape[1])])
            turns = speeds / self.per_engine[:, None]
            for gear, converter in self.converters.items():
                self.at_rest[gear] = 0.0  # `added` of the converter contains the slips
                turns[gear] = converter.per_output[2:] * vehicle.final_drive / vehicle.radius
            turned = np.where(links > 0, links * turns**2, 0.0)
            self.mass = vehicle.mass + np.nan_to_num(turned).sum(axis=1)  # NaN means a free link
            """Vehicle mass plus inertias of rotating parts reduced to the road, by gear. [kg]"""
        with np.errstate(divide="ignore"):
            ranges = directions(1 / output, [gear.name for gear in case.gears])
        self.ahead = next(iter(ranges), [])
        """Indices of the forward gears."""

    def slowest(self, gear: int) -> float:
        """Return the lowest speed for which `forces` is calculated in a gear [rad/s]."""
        return 0.0 if gear in self.converters else max(self.first, self._least(gear))

    def _least(self, gear: int) -> float:
        """Return the engine speed at which a gear with a slip in rpm starts to move [rad/s]."""
        at_rest = float(self.at_rest[gear])
        return at_rest + AT_REST * self.last if at_rest > 0 else 0.0

    def road_speeds(self, gear: int, speeds: Floats) -> Floats:
        """Return road speeds [m/s] at engine speeds of `forces` [rad/s]."""
        road: Floats = self.per_engine[gear] * (speeds - self.at_rest[gear])
        return road

    def speeds_at(self, gear: int, road: Floats) -> Floats:
        """Return engine speeds for `forces` [rad/s] at road speeds [m/s]."""
        speeds: Floats = road / self.per_engine[gear] + self.at_rest[gear]
        return speeds

    def forces(self, gear: int, speeds: Floats) -> Floats:
        """Return wheel forces [N] in the direction of the output, at engine speeds [rad/s].

        Below the first full-load point, the force is that at the first point. With a free
        converter, `speeds` only represent the road speed. They are the speeds that the engine would
        have at the converter's `free_ratio`, the largest speed ratio without braking torque.
        """
        factor = self.vehicle.final_drive / self.vehicle.radius
        if gear in self.converters:
            torques = self._converter_torques(self.converters[gear], self._output(gear, speeds))
            return factor * torques
        engine = np.maximum(speeds, max(self.first, self._least(gear)))
        turning = np.maximum(engine, np.finfo(float).tiny ** 0.25)
        full = {"load.speed": turning, "load.torque": self.vehicle.full_torque(engine)}
        results = solve(self.case, vary=full)
        output = self.case.gear_output(self.case.gears[gear]) - 1
        torque: Floats = results.lossy_output_torque_Nm[:, gear] * np.sign(
            results.speeds[:, gear, output]
        )
        return torque * factor

    def engine_speeds(self, gear: int, speeds: Floats) -> Floats:
        """Return engine speeds at full load [rad/s], for `speeds` of `forces`."""
        if gear not in self.converters:
            return speeds
        return self._matched(self.converters[gear], self._output(gear, speeds))[0]

    def _output(self, gear: int, speeds: Floats) -> Floats:
        """Return magnitudes of output speeds [rad/s] for `speeds` of `forces`, all above 0."""
        per_output = self.per_engine[gear] * self.vehicle.final_drive / self.vehicle.radius
        output: Floats = np.maximum(speeds, AT_REST * self.last) * per_output
        return output

    def _matched(self, converter: ConverterGear, output: Floats) -> tuple[Floats, Floats]:
        """Return engine speeds [rad/s] and torques [N*m] at full load, NaN without a solution."""
        vehicle, case, last = self.vehicle, converter.case, self.last

        def carried(rows: Integers, engine: Floats, torque: Floats) -> Floats:
            ratios = converter.ratio(engine, output[rows])
            return converter.torques(case, (engine, torque), ratios, {})

        points = [speed for speed, _ in vehicle.full_load if speed > 0]
        search = converter.search(
            1 / np.array([*points, *last * SLOWEST_PART]),
            (converter.free_ratio, 1 / last, math.inf),
            output,
            lambda rows, engine: carried(rows, engine, vehicle.full_torque(engine)),
        )
        engine = search.engine
        if converter.stops:
            locked = np.isnan(engine) & (search.surplus[:, 0] < 0)
            engine = np.where(locked, converter.engine_at(1.0, output), engine)
        torque = np.where(np.isfinite(engine), vehicle.full_torque(engine), np.nan)
        # At the smallest speed ratio the engine has its last speed, and still too much torque.
        ends_last = search.ends[:, 1] >= last * (1 - SAME_SPEED)
        fast = np.flatnonzero(np.isnan(engine) & ends_last & (search.surplus[:, 1] > 0))
        engine[fast] = last
        torque[fast] = converter.torque_at(
            engine[fast],
            output[fast],
            lambda rows, part: carried(fast[rows], engine[fast[rows]], part),
        )
        return engine, torque

    def _converter_torques(self, converter: ConverterGear, output: Floats) -> Floats:
        """Return output torques [N*m], above 0 if driving, at output speeds [rad/s]."""
        engine, torque = self._matched(converter, output)
        torques = np.full(len(output), math.nan)
        rows = np.flatnonzero(np.isfinite(torque))
        ratios = converter.driven_ratio(engine[rows], output[rows])
        vary = {"load.speed": engine[rows], "load.torque": torque[rows], converter.path: ratios}
        link = converter.case.gear_output(converter.case.gears[0])
        if rows.size:
            given = solve(converter.case, vary=vary).lossy_output_torque_Nm[:, 0]
            torques[rows] = given * np.sign(converter.per_output[1 + link])
        return torques

    def top_speed(self, gear: int) -> float:
        """Return the top speed on a level road [m/s]; NaN if the resistance is never overcome."""
        if not (math.isfinite(fastest := self.largest_speed(gear)) and fastest > 0):
            return math.nan

        def surplus(speeds: Floats) -> Floats:
            road = self.road_speeds(gear, speeds)
            difference: Floats = self.forces(gear, speeds) - self.vehicle.resistance(road)
            return difference

        low, high = self.slowest(gear), self.last
        for _ in range(NARROWINGS):
            speeds = np.linspace(low, high, SPEEDS_OF_ENGINE + 1)
            with np.errstate(invalid="ignore"):
                enough = np.flatnonzero(surplus(speeds) >= 0)
            if not enough.size:
                return math.nan
            last = int(enough[-1])
            if last == SPEEDS_OF_ENGINE:
                low = high
                break
            low, high = speeds[last], speeds[last + 1]
        return float(self.road_speeds(gear, np.array((low + high) / 2)))

    def _climbing_force(self, gear: int) -> float:
        """Return the largest wheel force less the growth of rolling resistance with speed [N]."""
        vehicle, weight = self.vehicle, self.vehicle.mass * GRAVITY

        def force(speeds: Floats) -> Floats:
            rolling = vehicle.rolling_at(self.road_speeds(gear, speeds)) - vehicle.rolling_at(0.0)
            climbing: Floats = self.forces(gear, speeds) - weight * rolling
            return climbing

        return _largest(force, self.slowest(gear), self.last)

    def largest_force(self, gear: int) -> float:
        """Return the largest wheel force in a gear, NaN if undefined [N]."""
        return _largest(lambda speeds: self.forces(gear, speeds), self.slowest(gear), self.last)

    @property
    def largest_power(self) -> float:
        """Largest power of the engine [W]."""
        return _largest(
            lambda speeds: self.vehicle.full_torque(speeds) * speeds, self.first, self.last
        )

    def largest_speed(self, gear: int) -> float:
        """Return the road speed at the last engine speed [m/s]."""
        return float(self.road_speeds(gear, np.array(self.last)))

    def slope(self, gear: int) -> float:
        """Return the sine of the steepest ascent, at most 1; NaN if a gear does not drive [-].

        The sine is the largest ``(F - R)/(m g)`` with the wheel force F, and the rolling resistance
        R on a level road. In a gear with a free converter, F and R are the forces at rest.
        """
        weight = self.vehicle.mass * GRAVITY
        if not (math.isfinite(self.per_engine[gear]) and self.at_rest[gear] < self.last):
            return math.nan
        at_rest = gear in self.converters
        force = self.forces(gear, np.zeros(1))[0] if at_rest else self._climbing_force(gear)
        part = float((force - self.vehicle.resistance(0.0)) / weight)
        return part if math.isnan(part) else min(1.0, part)

    def accelerations(self, speeds: Floats) -> Floats:
        """Return the largest acceleration in any forward gear, at road speeds [m/s^2]."""
        largest = np.full(speeds.shape, -math.inf)
        for gear in self.ahead:
            engine = self.speeds_at(gear, speeds)
            force = self._forces_between(gear, np.minimum(engine, self.last))
            acceleration = (force - self.vehicle.resistance(speeds)) / self.mass[gear]
            largest = np.fmax(
                largest, np.where(self.vehicle.may_turn(engine), acceleration, -math.inf)
            )
        return largest

    def _forces_between(self, gear: int, speeds: Floats) -> Floats:
        """Return wheel forces like `forces` [N], interpolated in a gear with a free converter."""
        if gear not in self.converters or len(speeds) <= CONVERTER_POINTS:
            return self.forces(gear, speeds)
        places = np.linspace(0.0, speeds.max(), CONVERTER_POINTS)
        return np.interp(speeds, places, self.forces(gear, places))

    def time_to_100(self) -> float:
        """Return the time from rest to 100 km/h by Gaussian quadrature, NaN if unreachable [s]."""
        corners = [speed for speed, _ in self.vehicle.rolling_points]
        ends = {0.0, HUNDRED, *np.linspace(0.0, HUNDRED, STEPS_TO_100 + 1).tolist(), *corners}
        for gear in self.ahead:
            points = np.array([point for point, _ in self.vehicle.full_load])
            ends |= {*self.road_speeds(gear, points).tolist()}
        edges = np.array(sorted(end for end in ends if 0 <= end <= HUNDRED))
        places, weights = np.polynomial.legendre.leggauss(4)
        half = np.diff(edges) / 2
        middles = (edges[:-1] + edges[1:]) / 2
        speeds = (middles[:, None] + half[:, None] * places).ravel()
        accelerations = self.accelerations(speeds)
        if not (accelerations > 0).all():
            return math.nan
        return float((half[:, None] * weights).ravel() @ (1 / accelerations))


def _largest(function: Callable[[Floats], Floats], low: float, high: float) -> float:
    """Return the largest value of a function in an interval, NaN if undefined."""
    best = math.nan
    for _ in range(NARROWINGS):
        places = np.linspace(low, high, SPEEDS_OF_ENGINE + 1)
        values = function(places)
        if not np.isfinite(values).any():
            return math.nan
        top = int(np.nanargmax(values))
        if top in (0, SPEEDS_OF_ENGINE) and values[top] <= best:
            return best  # it is at an end, and the first places contain both ends
        best = max(float(values[top]), best) if math.isfinite(best) else float(values[top])
        low, high = places[max(top - 1, 0)], places[min(top + 1, SPEEDS_OF_ENGINE)]
    return best
