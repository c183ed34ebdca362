"""The vehicle that a box is in: its resistance on the road, its engine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from vstatics.core.errors import spoken
from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import Gear, SpeedOf
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.vehicle.tolerances import SAME_SPEED

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields
NUMBERS_OF_VEHICLE = ("mass", "radius", "rolling", "drag_area", "final_drive")

EnginePoints = Sequence[tuple[float, float]]
"""Speed [rad/s] in ascending order, each with the torque [N*m]."""


class Vehicle(NamedTuple):
    """A vehicle.

    Parameters
    ----------
    mass : float
        [kg]
    radius : float
        Of the wheels. [m]
    rolling : float
        Coefficient of the rolling resistance. [-]
    drag_area : float
        Coefficient of air drag by frontal area. [m^2]
    final_drive : float
        Speed of the output by that of the wheels, without sign. [-]
    engine : sequence of pairs
        Full load: speed [rad/s], torque [N*m], straight between.
    overrun : sequence of pairs
        Torque with which the engine brakes, 0 or below; 0 where there are no points.
    fuel : str
        The file of the fuel map; nothing if there is none.

    Examples
    --------
    >>> Vehicle(mass=1200, radius=0.3, rolling=0.012).drag_area
    0.0
    """

    mass: float
    radius: float
    rolling: float = 0.0
    drag_area: float = 0.0
    final_drive: float = 1.0
    engine: EnginePoints = ()
    overrun: EnginePoints = ()
    fuel: str = ""

    @classmethod
    def of(cls, case: TransmissionFields) -> Vehicle | None:
        """Return the vehicle of a case, if there is one."""
        return as_type(case.vehicle, cls)

    def resistance(self, speed: Any, slope: Any = 0.0) -> Any:
        """Force against a speed that is not 0 [m/s], by rolling, ascent (its sine) and air [N].

        >>> round(Vehicle(1000.0, 0.3, rolling=0.01, drag_area=0.5).resistance(10.0), 9)
        128.1
        """
        weight = self.mass * GRAVITY
        return weight * (self.rolling + slope) + AIR * self.drag_area / 2 * speed**2

    def full_torque(self, speed: Any) -> Any:
        """Of the engine at full load at a speed [rad/s] [N*m].

        Below the first of its points that of the first; beyond the last there is none.

        >>> Vehicle(1000.0, 0.3, engine=[(100.0, 80.0), (600.0, 120.0)]).full_torque([0.0, 601.0])
        array([80.,  0.])
        """
        return np.where(self.may_turn(speed), _between(self.engine, speed), 0.0)

    def may_turn(self, speed: Any) -> Any:
        """Whether the engine may turn as fast [rad/s]: no faster than at its last point."""
        last = self.engine[-1][0] * (1 + SAME_SPEED) if self.engine else math.inf
        return np.asarray(speed) <= last

    def overrun_torque(self, speed: Any) -> Any:
        """With which the engine brakes at a speed [rad/s]; below 0 [N*m]."""
        return _between(self.overrun, speed) if self.overrun else np.zeros_like(speed)

    def completed(self) -> Vehicle:
        """A checked one with its numbers as floats."""
        numbers: dict[str, Any] = {name: float(getattr(self, name)) for name in NUMBERS_OF_VEHICLE}
        for name in ("engine", "overrun"):
            numbers[name] = tuple((float(x), float(y)) for x, y in getattr(self, name))
        return self._replace(**numbers)


def _between(points: EnginePoints, speed: Any) -> Any:
    """Straight between points, constant outside."""
    speeds, torques = np.array(points).T
    return np.interp(speed, speeds, torques)


def beside_engine(gear: Gear, name: Callable[[int], str]) -> str:
    """What else gives power in a gear, or takes it: nothing where the engine alone drives.

    Then a vehicle that drives in it needs to know what controls that, which no case tells.

    >>> beside_engine(Gear(speeds={2: 0.0, 3: 0.4}), "link {}".format)
    'a given speed of link 3'
    """
    if gear.balance:
        return "a balance"
    for what, numbers in (("speed of", gear.speeds), ("torque on", gear.torques)):
        links = [link for link, one in numbers.items() if isinstance(one, SpeedOf) or one != 0]
        if links:
            return f"a given {what} {spoken([name(link) for link in links])}"
    return ""


def vehicle_of(fuel: str = "", **others: Any) -> Vehicle:
    """The vehicle of what a case gives."""
    return Vehicle(fuel=fuel, **others)


def vehicle_record(case: TransmissionFields) -> dict[str, Any] | None:
    """A vehicle by the keys of a case."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return None
    record: dict[str, Any] = vehicle._asdict()
    for name in ("engine", "overrun"):
        record[name] = [list(point) for point in record[name]]
    return record | {"fuel": {"file": vehicle.fuel} if vehicle.fuel else None}
