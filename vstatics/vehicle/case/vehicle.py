"""Vehicle of a transmission: resistance on the road, engine, fuel map."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import Gear, SpeedOf
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.vehicle.tolerances import SAME_SPEED

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields
NUMBERS_OF_VEHICLE = ("mass", "radius", "rolling", "drag_area", "final_drive")

EnginePoints = Sequence[tuple[float, float]]
"""Points of engine speed [rad/s], in ascending order, and torque [N*m]."""


class Vehicle(NamedTuple):
    """Vehicle driven by a transmission.

    Parameters
    ----------
    mass : float
        Mass. [kg]
    radius : float
        Rolling radius of the wheels. [m]
    rolling : float
        Coefficient of the rolling resistance. [-]
    drag_area : float
        Drag coefficient times frontal area. [m^2]
    final_drive : float
        Output speed of the transmission divided by wheel speed, without sign. [-]
    engine : sequence of pairs
        Full-load curve: speed [rad/s], torque [N*m], interpolated linearly.
    overrun : sequence of pairs
        Braking torque of the engine, 0 or below, with points as in `engine`; 0 without points.
    fuel : str
        File of the fuel map; empty without a map.

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

    @classmethod
    def needed(cls, case: TransmissionFields) -> Vehicle:
        """Return the vehicle of a case.

        Raises
        ------
        CaseError
            If there is none.
        """
        vehicle = cls.of(case)
        if vehicle is None:
            message = "the case has no `vehicle`, expected `vehicle: {mass: ..., radius: ...}`"
            raise CaseError("E427", message)
        return vehicle

    def resistance(self, speed: Any, slope: Any = 0.0) -> Any:
        """Return the resistance [N] of rolling, ascent and air at a speed [m/s].

        The slope is the sine of the angle of ascent.

        >>> round(Vehicle(1000.0, 0.3, rolling=0.01, drag_area=0.5).resistance(10.0), 9)
        128.1
        """
        weight = self.mass * GRAVITY
        return weight * (self.rolling + slope) + AIR * self.drag_area / 2 * speed**2

    def full_torque(self, speed: Any) -> Any:
        """Return the torque of the engine at full load [N*m] at a speed [rad/s].

        Below the first point the torque is constant; beyond the last point it is 0.

        >>> Vehicle(1000.0, 0.3, engine=[(100.0, 80.0), (600.0, 120.0)]).full_torque([0.0, 601.0])
        array([80.,  0.])
        """
        return np.where(self.may_turn(speed), _between(self.engine, speed), 0.0)

    def may_turn(self, speed: Any) -> Any:
        """Return whether the engine can reach a speed, up to the last full-load point [rad/s]."""
        last = self.engine[-1][0] * (1 + SAME_SPEED) if self.engine else math.inf
        return np.asarray(speed) <= last

    def overrun_torque(self, speed: Any) -> Any:
        """Return the torque of the overrunning engine, 0 or below [N*m], at a speed [rad/s]."""
        return _between(self.overrun, speed) if self.overrun else np.zeros_like(speed)

    def completed(self) -> Vehicle:
        """Return the vehicle with all numbers as floats."""
        numbers: dict[str, Any] = {name: float(getattr(self, name)) for name in NUMBERS_OF_VEHICLE}
        for name in ("engine", "overrun"):
            numbers[name] = tuple((float(x), float(y)) for x, y in getattr(self, name))
        return self._replace(**numbers)


def _between(points: EnginePoints, speed: Any) -> Any:
    speeds, torques = np.array(points).T
    return np.interp(speed, speeds, torques)


def beside_engine(gear: Gear, name: Callable[[int], str]) -> str:
    """Return the sources of power other than the engine in a gear as text, or an empty text.

    A vehicle cannot be driven in such a gear, as a case does not describe the control of the other
    machines.

    >>> beside_engine(Gear(speeds={2: 0.0, 3: 0.4}), "link {}".format)
    'a given speed of link 3'
    """
    if gear.balance:
        return "a balance"
    for quantity, numbers in (("speed of", gear.speeds), ("torque on", gear.torques)):
        links = [
            link for link, value in numbers.items() if isinstance(value, SpeedOf) or value != 0
        ]
        if links:
            return f"a given {quantity} {spoken([name(link) for link in links])}"
    return ""


def vehicle_record(case: TransmissionFields) -> dict[str, Any] | None:
    """Return the vehicle of a case as a mapping of keys."""
    vehicle = Vehicle.of(case)
    if vehicle is None:
        return None
    record: dict[str, Any] = vehicle._asdict()
    for name in ("engine", "overrun"):
        record[name] = [list(point) for point in record[name]]
    return record | {"fuel": {"file": vehicle.fuel} if vehicle.fuel else None}
