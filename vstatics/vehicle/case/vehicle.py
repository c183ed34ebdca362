"""Vehicle with a transmission: road resistance, and engine with fuel map or electric machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import Gear, SpeedOf, with_floats
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.core.statics.points.machines import battery_power, efficiency_at
from vstatics.vehicle.tolerances import SAME_SPEED

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields

EnginePoints = Sequence[tuple[float, float]]
"""Points (engine speed [rad/s], torque [N*m]) in ascending order of speed."""


class Machine(NamedTuple):
    """Electric machine and battery.

    Parameters
    ----------
    torque : sequence of pairs
        Full-load curve: speed [rad/s], torque [N*m], interpolated linearly.
    generating : sequence of pairs
        Points of the largest braking torque, 0 or below; by default `torque` with the
        opposite sign.
    efficiency : float or Law
        Efficiency as a number, or a map or formula over speed and torque; the torque is below 0
        where the machine generates. [-]
    battery_efficiency : float
        Efficiency of the battery in each direction, charging and discharging. [-]
    auxiliary : float
        Power that other consumers take from the battery at all times. [kW]

    Examples
    --------
    >>> Machine([(0, 200), (500, 80)], efficiency=0.9).braking
    [(0, -200), (500, -80)]
    """

    torque: EnginePoints
    generating: EnginePoints = ()
    efficiency: float = 1.0
    battery_efficiency: float = 1.0
    auxiliary: float = 0.0

    @property
    def braking(self) -> EnginePoints:
        """Points of the largest braking torque of the machine [rad/s, N*m]."""
        return self.generating or [(speed, -torque) for speed, torque in self.torque]

    def electric_power(self, power: Floats, speed: Floats, torque: Floats) -> Floats:
        """Return the electric powers of mechanical powers [W], NaN without an efficiency.

        Parameters
        ----------
        power : ndarray
            Mechanical power, below 0 where the machine generates. [W]
        speed, torque : ndarray
            Magnitude of the speed [rad/s], and torque in the direction of the speed [N*m].

        Examples
        --------
        >>> powers, zeros = np.array([90.0, -90.0]), np.zeros(2)
        >>> Machine([(0, 1)], efficiency=0.9).electric_power(powers, zeros, zeros).tolist()
        [100.0, -81.0]
        """
        efficiency = efficiency_at(self.efficiency, speed, torque, power)
        electric: Floats = -battery_power(-power, efficiency)
        return electric

    def battery_power(self, electric: Floats) -> Floats:
        """Return the battery power for an electric power of the machine and other consumers [W].

        The battery power is below 0 where the battery is charged.

        >>> machine = Machine([(0, 1)], battery_efficiency=0.8, auxiliary=0.02)
        >>> machine.battery_power(np.array([60.0, 0.0, -30.0])).tolist()
        [100.0, 25.0, -8.0]
        """
        power: Floats = -battery_power(-electric - 1e3 * self.auxiliary, self.battery_efficiency)
        return power


class Vehicle(NamedTuple):
    """Vehicle driven by a transmission.

    Parameters
    ----------
    mass : float
        Mass. [kg]
    radius : float
        Rolling radius of the wheels. [m]
    rolling : float or sequence of pairs
        Coefficient of the rolling resistance [-], or points (road speed [m/s], coefficient) in
        ascending order of speed.
    drag_area : float
        Drag coefficient times frontal area. [m^2]
    final_drive : float
        Output speed of the transmission divided by the wheel speed, as a magnitude. [-]
    engine : sequence of pairs
        Full-load curve: speed [rad/s], torque [N*m], interpolated linearly.
    overrun : sequence of pairs
        Points of the largest braking torque of the engine, 0 or below, in the form of `engine`;
        without points the engine cannot brake.
    fuel : str
        File name of the fuel map; empty without a map.
    machine : Machine, optional
        Electric machine instead of an engine.
    recuperation : float
        Share of the braking force at the wheels that the machine should supply, from 0 to 1. [-]

    Examples
    --------
    >>> Vehicle(mass=1200, radius=0.3, rolling=0.012).drag_area
    0.0
    """

    mass: float
    radius: float
    rolling: float | Sequence[tuple[float, float]] = 0.0
    drag_area: float = 0.0
    final_drive: float = 1.0
    engine: EnginePoints = ()
    overrun: EnginePoints = ()
    fuel: str = ""
    machine: Machine | None = None
    recuperation: float = 1.0

    @property
    def full_load(self) -> EnginePoints:
        """Full-load points of the engine or the electric machine [rad/s, N*m]."""
        return self.machine.torque if self.machine else self.engine

    @property
    def first_speed(self) -> float:
        """Engine speed of the first full-load point [rad/s]; 0 without full load."""
        return self.full_load[0][0] if self.full_load else 0.0

    @property
    def braking(self) -> EnginePoints:
        """Points of the largest braking torque of engine or electric machine [rad/s, N*m]."""
        return self.machine.braking if self.machine else self.overrun

    @classmethod
    def of(cls, case: TransmissionFields) -> Vehicle | None:
        """Return the vehicle of a case, if any."""
        return as_type(case.vehicle, cls)

    @classmethod
    def needed(cls, case: TransmissionFields) -> Vehicle:
        """Return the vehicle of a case.

        Raises
        ------
        CaseError
            If the case has no vehicle.
        """
        vehicle = cls.of(case)
        if vehicle is None:
            message = "the case has no `vehicle`, expected `vehicle: {mass: ..., radius: ...}`"
            raise CaseError("E427", message)
        return vehicle

    def resistance(self, speed: Any, slope: Any = 0.0) -> Any:
        """Return the resistance of rolling, ascent and air [N] at a road speed [m/s].

        `slope` is the sine of the angle of ascent [-].

        >>> round(Vehicle(1000.0, 0.3, rolling=0.01, drag_area=0.5).resistance(10.0), 9)
        128.1
        """
        weight = self.mass * GRAVITY
        with np.errstate(over="ignore"):
            return weight * (self.rolling_at(speed) + slope) + AIR * self.drag_area / 2 * speed**2

    def rolling_at(self, speed: Any) -> Any:
        """Return the coefficient of the rolling resistance at a road speed [m/s].

        >>> Vehicle(1000.0, 0.3, rolling=[(0.0, 0.01), (40.0, 0.03)]).rolling_at([0.0, 10.0])
        array([0.01 , 0.015])
        """
        points = self.rolling_points
        return _between(points, speed) if points else self.rolling

    @property
    def rolling_points(self) -> EnginePoints:
        """Points of the rolling resistance [m/s, -], empty if the coefficient is constant."""
        return self.rolling if isinstance(self.rolling, Sequence) else ()

    def full_torque(self, speed: Any) -> Any:
        """Return the full-load torque of the engine or the machine [N*m] at a speed [rad/s].

        Below the first point the torque is constant; beyond the last point it is 0.

        >>> Vehicle(1000.0, 0.3, engine=[(100.0, 80.0), (600.0, 120.0)]).full_torque([0.0, 601.0])
        array([80.,  0.])
        """
        return np.where(self.may_turn(speed), _between(self.full_load, speed), 0.0)

    def may_turn(self, speed: Any) -> Any:
        """Return True where a speed [rad/s] is not above the last point of full load."""
        last = self.full_load[-1][0] * (1 + SAME_SPEED) if self.full_load else math.inf
        return np.asarray(speed) <= last

    def overrun_torque(self, speed: Any) -> Any:
        """Return the largest braking torque [N*m], 0 or below, at an engine speed [rad/s]."""
        if not self.braking:
            return np.zeros_like(speed)
        torques = _between(self.braking, speed)
        as_it_drives = self.machine is not None and not self.machine.generating
        return np.where(self.may_turn(speed), torques, 0.0) if as_it_drives else torques

    def completed(self) -> Vehicle:
        """Return the vehicle with all numbers as floats."""
        return with_floats(self)


def _between(points: EnginePoints, speed: Any) -> Any:
    speeds, torques = np.array(points).T
    return np.interp(speed, speeds, torques)


def full_load_curves(case: TransmissionFields) -> list[EnginePoints]:
    """Return the full-load curve from speed 0, and the curve of braking torque if any.

    Each curve consists of points [rad/s, N*m] and ends with torque 0 at the largest speed.

    Raises
    ------
    CaseError
        If the case has no vehicle, or the vehicle has no full-load curve.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> vehicle = Vehicle(1000.0, 0.3, engine=[(100.0, 80.0), (600.0, 120.0)])
    >>> pair = Mechanism(1, 2, 0, -2.0)
    >>> full_load_curves(Transmission(2, [], [pair], [Gear()], vehicle=vehicle))
    [[(0.0, 80.0), (100.0, 80.0), (600.0, 120.0), (600.0, 0.0)]]
    """
    vehicle = Vehicle.needed(case)
    if not vehicle.full_load:
        message = "the vehicle has no full load: expected `engine` or `machine`"
        raise CaseError("E427", message)
    last = vehicle.full_load[-1][0]
    curves: list[EnginePoints] = []
    for points, torque in (
        (vehicle.full_load, vehicle.full_torque),
        (vehicle.braking, vehicle.overrun_torque),
    ):
        speeds = [0.0, *(speed for speed, _ in points if 0 < speed < last), last]
        curve = [(speed, float(torque(speed))) for speed in speeds]
        if points:
            curves.append([*curve, (last, 0.0)])
    return curves


def beside_engine(case: TransmissionFields, gear: Gear) -> str:
    """Return the reason why the engine is not the only drive of a gear, or "".

    A vehicle cannot be driven in such a gear, because a case does not describe how other machines
    are controlled.

    >>> from vstatics import Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.0)], [Gear(speeds={2: 0.4})])
    >>> beside_engine(case, case.gears[0])
    'a given speed of 2'
    """
    if gear.balance:
        return "a balance"
    for quantity, numbers in (("speed of", gear.speeds), ("torque on", gear.torques)):
        links = [
            link for link, value in numbers.items() if isinstance(value, SpeedOf) or value != 0
        ]
        if links:
            return f"a given {quantity} {spoken([case.link_name(link) for link in links])}"
    return ""


def free_converters(case: TransmissionFields, gear: Gear) -> list[int]:
    """Return the indices of converters whose speed ratio depends on the load of a gear.

    Converters whose lock-up clutch slips are omitted, because the slip determines the speed ratio.
    """
    locked = case.bypassed(gear._replace(engaged=gear.carrying))
    return [place for place in case.sought_converters(gear) if place not in locked]


def vehicle_record(case: TransmissionFields) -> dict[str, Any] | None:
    """Return the key `vehicle` of a document, None without a vehicle."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return None
    record: dict[str, Any] = vehicle._asdict()
    if vehicle.rolling_points:
        record["rolling"] = {"over": "speed", "points": vehicle.rolling_points}
    machine = vehicle.machine
    return record | {
        "fuel": {"file": vehicle.fuel} if vehicle.fuel else None,
        "machine": machine
        and {
            **machine._asdict(),
            "battery": {
                "efficiency": machine.battery_efficiency,
                "auxiliary": machine.auxiliary or None,
            }
            if machine.battery_efficiency != 1 or machine.auxiliary
            else None,
        },
    }
