"""What a vehicle can: force at the wheels in each gear, top speed, slope, acceleration.

``F = Mx final_drive/radius`` with the output torque at full load, with losses; resistance as of
a road. The largest acceleration of all gears is ``(F - R)/(m + sum J k^2)``, ``k = w/v`` of each
link with an inertia.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import Load
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.constants import GRAVITY
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.vehicle.case.vehicle import Vehicle, beside_engine
from vstatics.vehicle.operation.shifting import directions

if TYPE_CHECKING:
    from vstatics.core.summary import Summary

KMH = 3.6
"""1 m/s."""
HUNDRED = 100 / KMH
"""100 km/h. [m/s]"""
SPEEDS_OF_ENGINE = 256
"""Between the first and the last point; a place between two is found by as many again."""
NARROWINGS = 5
"""So often: then it is known to 1e-12."""
STEPS_TO_100 = 2000
"""Of the integral of time, besides the points of the engine in each gear."""


class GearPerformance(NamedTuple):
    """What a vehicle can in a gear; NaN where it cannot."""

    top_speed: float
    """On the level. [km/h]"""
    slope: float
    """Sine of the steepest ascent; 1 where the force is enough for any. [-]"""


class Performance(NamedTuple):
    """Performance of a vehicle at full load."""

    gears: Mapping[str, GearPerformance]
    top_speed: float
    """Forward. [km/h]"""
    time_to_100: float
    """From rest to 100 km/h at full load, without time for shifts; NaN if it is not reached [s]."""

    @classmethod
    def of(cls, summary: Summary) -> Performance | None:
        """Return the performance in a summary, if the case has a vehicle with an engine."""
        return as_type(summary.vehicle, cls)

    def grids(self) -> Iterator[Grid]:
        """Yield tables for a summary: of each gear, and of all gears."""
        rows = [(name, one.top_speed, one.slope) for name, one in self.gears.items()]
        headings = "gear", "top speed, km/h", "slope"
        yield grid_of("Vehicle at full load", headings, rows, key="vehicle gears")
        row = self.top_speed, self.time_to_100
        yield grid_of("Vehicle", ["top speed, km/h", "0 to 100 km/h, s"], [row], key="vehicle")


def bare(case: Transmission) -> Transmission:
    """The case without loads and directions of its own, for points of any load."""
    gears = [gear._replace(load=None, coast=None) for gear in case.gears]
    return replace(case, gears=gears, load=Load(1000.0, 1.0), coast=None)


def engine_alone(case: Transmission) -> Booleans:
    """In which gears the engine alone drives: of the others nothing is told."""
    return np.array([not beside_engine(gear, case.link_name) for gear in case.gears])


def vehicle_section(case: Transmission) -> Performance | None:
    """Return the performance of a case, if its vehicle has an engine."""
    vehicle = Vehicle.of(case)
    return performance(case) if vehicle and vehicle.engine else None


def performance(case: Transmission) -> Performance:
    """Top speeds, slopes, and the time to 100 km/h of a case with a vehicle and its engine.

    Examples
    --------
    A force of 1000 N at any speed up to 100 rad/s at the wheels of .5 m, without resistance: the
    engine ends it at 180 km/h, and 1000 kg reach 100 km/h in 27.8 s.

    >>> from vstatics import Gear, Mechanism
    >>> car = Vehicle(1000, 0.5, engine=[(0.0, 125.0), (400.0, 125.0)])
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear(name="1")], vehicle=car)
    >>> made = performance(case)
    >>> round(made.top_speed, 6), round(made.time_to_100, 6), round(made.gears["1"].slope, 6)
    (180.0, 27.777778, 0.101937)
    """
    vehicle = Vehicle.of(case)
    assert vehicle is not None and vehicle.engine  # noqa: PT018, S101 - who asks knows
    pull = Traction(bare(case), vehicle)
    gears = {
        gear.name: GearPerformance(KMH * pull.top_speed(number), pull.slope(number))
        for number, gear in enumerate(case.gears)
    }
    ahead = [case.gears[index].name for index in pull.ahead]
    known = [gears[one].top_speed for one in ahead if math.isfinite(gears[one].top_speed)]
    return Performance(gears, max(known, default=math.nan), pull.time_to(HUNDRED))


class Traction:
    """Force and resistance over the speed of the vehicle.

    >>> from vstatics import Gear, Mechanism
    >>> car = Vehicle(1000, 0.5, engine=[(0.0, 125.0), (400.0, 125.0)])
    >>> pull = Traction(bare(Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()])), car)
    >>> pull.largest_force(0), pull.largest_power, pull.largest_speed(0)
    (1000.0, 50000.0, 50.0)
    """

    def __init__(self, case: Transmission, vehicle: Vehicle) -> None:
        """A case without loads of its own, `bare`, in a vehicle with its engine."""
        self.case = case
        self.vehicle = vehicle
        self.first, self.last = vehicle.engine[0][0], vehicle.engine[-1][0]
        still = solve(case)
        outputs = [case.gear_output(gear) - 1 for gear in case.gears]
        speeds = still.speeds
        output = speeds[np.arange(len(outputs)), outputs]
        output = np.where(engine_alone(case), output, math.nan)
        """Of the output, by that of the engine."""
        with np.errstate(all="ignore"):
            self.per_engine = np.abs(output) * vehicle.radius / vehicle.final_drive
            links = np.array([case.heavy.get(n + 1, 0.0) for n in range(speeds.shape[1])])
            turned = np.where(links > 0, links * (speeds / self.per_engine[:, None]) ** 2, 0.0)
            self.mass = vehicle.mass + turned.sum(axis=1)
        """By gear, with what turns. [kg]"""
        with np.errstate(divide="ignore"):
            own = directions(1 / output, [gear.name for gear in case.gears])
        self.ahead = next(iter(own), [])
        """Indices of the gears that are forward."""

    def results(self, speeds: Floats) -> Results:
        """At full load, at speeds of the engine [rad/s]."""
        least = np.maximum(speeds, np.finfo(float).tiny ** 0.25)
        torques = self.vehicle.full_torque(speeds)
        return solve(self.case, vary={"load.speed": least, "load.torque": torques})

    def forces(self, gear: int, speeds: Floats) -> Floats:
        """At the wheels, in the direction of the output, at speeds of the engine [N].

        Below the first point of the engine that of the first point.
        """
        found = self.results(np.maximum(speeds, self.first))
        output = self.case.gear_output(self.case.gears[gear]) - 1
        torque = found.lossy_output_torque_Nm[:, gear] * np.sign(found.speeds[:, gear, output])
        force: Floats = torque * self.vehicle.final_drive / self.vehicle.radius
        return force

    def top_speed(self, gear: int) -> float:
        """Where the force is the resistance, or the engine ends; NaN if it is nowhere so [m/s]."""
        ratio = self.per_engine[gear]
        if not (math.isfinite(ratio) and ratio > 0):
            return math.nan

        def surplus(speeds: Floats) -> Floats:
            left: Floats = self.forces(gear, speeds) - self.vehicle.resistance(speeds * ratio)
            return left

        low, high = self.first, self.last
        for _ in range(NARROWINGS):
            speeds = np.linspace(low, high, SPEEDS_OF_ENGINE + 1)
            with np.errstate(invalid="ignore"):
                enough = np.flatnonzero(surplus(speeds) >= 0)
            if not enough.size:
                return math.nan
            last = int(enough[-1])
            if last == SPEEDS_OF_ENGINE:
                return float(ratio * high)
            low, high = speeds[last], speeds[last + 1]
        return float(ratio * (low + high) / 2)

    def largest_force(self, gear: int) -> float:
        """At the wheels in a gear; NaN without any [N]."""
        return _largest(lambda speeds: self.forces(gear, speeds), self.first, self.last)

    @property
    def largest_power(self) -> float:
        """Of the engine [W]."""
        return _largest(
            lambda speeds: self.vehicle.full_torque(speeds) * speeds, self.first, self.last
        )

    def largest_speed(self, gear: int) -> float:
        """Of the vehicle in a gear, where the engine ends [m/s]."""
        return float(self.per_engine[gear] * self.last)

    def slope(self, gear: int) -> float:
        """The largest ``(F - R at 0)/(m g)``, at most 1; NaN where it drives nothing."""
        weight = self.vehicle.mass * GRAVITY
        if not math.isfinite(self.per_engine[gear]):
            return math.nan
        part = float((self.largest_force(gear) - self.vehicle.resistance(0.0)) / weight)
        return part if math.isnan(part) else min(1.0, part)

    def accelerations(self, speeds: Floats) -> Floats:
        """The largest of all gears ahead at speeds of the vehicle; NaN beyond all [m/s^2]."""
        found = np.full(speeds.shape, -math.inf)
        for gear in self.ahead:
            engine = speeds / self.per_engine[gear]
            force = self.forces(gear, np.minimum(engine, self.last))
            own = (force - self.vehicle.resistance(speeds)) / self.mass[gear]
            found = np.fmax(found, np.where(self.vehicle.may_turn(engine), own, -math.inf))
        return found

    def time_to(self, speed: float) -> float:
        """From rest, by Gauss' rule between points of the engine in each gear [s]."""
        ends = {0.0, speed, *np.linspace(0.0, speed, STEPS_TO_100 + 1).tolist()}
        for gear in self.ahead:
            ends |= {float(self.per_engine[gear] * one) for one, _ in self.vehicle.engine}
        edges = np.array(sorted(one for one in ends if 0 <= one <= speed))
        places, weights = np.polynomial.legendre.leggauss(4)
        half = np.diff(edges) / 2
        middles = (edges[:-1] + edges[1:]) / 2
        speeds = (middles[:, None] + half[:, None] * places).ravel()
        accelerations = self.accelerations(speeds)
        if not (accelerations > 0).all():
            return math.nan
        return float((half[:, None] * weights).ravel() @ (1 / accelerations))


def _largest(function: Callable[[Floats], Floats], low: float, high: float) -> float:
    """The largest value of a function between two places; NaN if it has none."""
    best = math.nan
    for _ in range(NARROWINGS):
        places = np.linspace(low, high, SPEEDS_OF_ENGINE + 1)
        values = function(places)
        if not np.isfinite(values).any():
            return math.nan
        top = int(np.nanargmax(values))
        best = max(float(values[top]), best) if math.isfinite(best) else float(values[top])
        low, high = places[max(top - 1, 0)], places[min(top + 1, SPEEDS_OF_ENGINE)]
    return best
