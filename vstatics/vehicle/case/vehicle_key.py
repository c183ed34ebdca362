"""Declaration of the key `vehicle` of a case, with checks."""

from __future__ import annotations

from typing import Any

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.carried import CaseKey
from vstatics.core.model.keys import MACHINE_EFFICIENCY, ROLLING
from vstatics.core.model.shape import NUMBER, TEXT, ByKey, KeyShape, Leaf, ListOf, RowOf
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.vehicle.case.vehicle import Machine, Vehicle, vehicle_record
from vstatics.vehicle.case.vehicle_checks import doubts_of_vehicle, of_vehicle, without_vehicle

_POINTS = ListOf(
    RowOf((Leaf("si_speed"), Leaf("si_torque")), "speed, torque"), "points", unique=False
)
MACHINE = ByKey(
    "Machine",
    "Electric machine that drives the transmission, with its battery.",
    (
        KeyShape(
            "torque",
            _POINTS,
            "Full load: points [speed in rad/s, torque in N*m] in ascending order, straight "
            "between.",
            required=True,
            examples=([[0, 200], [400, 200], [1200, 65]],),
        ),
        KeyShape(
            "generating",
            _POINTS,
            "Largest braking torque, points as of `torque`, 0 or below; by default that of "
            "`torque` with a minus.",
            examples=([[0, 0], [100, -150], [1200, -60]],),
        ),
        KeyShape(
            "efficiency",
            MACHINE_EFFICIENCY,
            "Efficiency of the machine: a number, a map over speed and torque, or a formula of w "
            "in rad/s and T in N*m, which is below 0 where the machine generates.",
            default=1,
            limits={"exclusiveMinimum": 0, "maximum": 1},
            examples=(0.92,),
        ),
        KeyShape(
            "battery",
            ByKey(
                "Battery",
                "Battery of the machine.",
                (
                    KeyShape(
                        "efficiency",
                        NUMBER,
                        "Efficiency of the battery, when charged and when discharged.",
                        default=1,
                        limits={"exclusiveMinimum": 0, "maximum": 1},
                        examples=(0.97,),
                    ),
                    KeyShape(
                        "auxiliary",
                        Leaf("power"),
                        "Power that other consumers take from the battery, also at standstill.",
                        examples=("800 W",),
                    ),
                ),
                lambda efficiency=1.0, auxiliary=0.0: (efficiency, auxiliary),
            ),
            "The battery of the machine; without it the battery has no losses.",
        ),
    ),
    lambda battery=(1.0, 0.0), **others: Machine(
        **others, battery_efficiency=battery[0], auxiliary=battery[1]
    ),
)


def _vehicle_fault(**values: Any) -> str:
    """Return a contradiction between engine and electric machine, or an empty text."""
    beside = [quoted(name) for name in ("engine", "overrun", "fuel") if values.get(name)]
    if values.get("machine") and beside:
        return f"read `machine` together with {spoken(beside)}, expected an engine or a machine"
    if not values.get("machine") and values["recuperation"] != 1:
        return "read `recuperation` without `machine`, expected a machine that recuperates"
    return ""


VEHICLE = ByKey(
    "Vehicle",
    "The vehicle of the gearbox, for `vstatics summary` and `vstatics cycle`.",
    (
        KeyShape(
            "mass", Leaf("mass"), "Mass of the vehicle, in kg.", required=True, limits=ABOVE_0
        ),
        KeyShape(
            "radius", Leaf("length"), "Radius of the wheels, in m.", required=True, limits=ABOVE_0
        ),
        KeyShape(
            "rolling",
            ROLLING,
            "Coefficient of the rolling resistance; or points over the speed of the vehicle.",
            default=0,
            limits={"minimum": 0},
            examples=(0.011,),
        ),
        KeyShape(
            "drag_area",
            Leaf("area"),
            "Drag coefficient times frontal area, in m^2; the density of air is 1.2 kg/m^3.",
            default=0,
            limits={"minimum": 0},
            examples=(0.68,),
        ),
        KeyShape(
            "final_drive",
            NUMBER,
            "Speed of the output divided by the speed of the wheels.",
            default=1,
            limits=ABOVE_0,
            examples=(3.1,),
        ),
        KeyShape(
            "engine",
            _POINTS,
            "Full load: points [speed in rad/s, torque in N*m] in ascending order, straight "
            "between.",
            examples=([[100, 150], [200, 320], [600, 250]],),
        ),
        KeyShape(
            "overrun",
            _POINTS,
            "Torque with which the engine brakes, points as of `engine`, 0 or below.",
            examples=([[100, -20], [600, -60]],),
        ),
        KeyShape(
            "fuel",
            ByKey(
                "Fuel map",
                "Fuel consumption of the engine, for `vstatics cycle`.",
                (
                    KeyShape(
                        "file",
                        TEXT,
                        "CSV file, relative to the case: `speed [rpm],torque [N*m],fuel [g/h]`, "
                        "with a row for each point of a grid.",
                        required=True,
                    ),
                ),
                lambda file: file,
            ),
            "The fuel map of the engine.",
        ),
        KeyShape("machine", MACHINE, "Electric machine instead of `engine`, `overrun` and `fuel`."),
        KeyShape(
            "recuperation",
            NUMBER,
            "Part of a braking force at the wheels that the machine is asked for.",
            default=1,
            limits={"minimum": 0, "maximum": 1},
            examples=(0.6,),
        ),
    ),
    Vehicle,
    _vehicle_fault,
)
KEY = CaseKey(
    KeyShape("vehicle", VEHICLE, "The vehicle of the gearbox."),
    Vehicle | None,
    vehicle_record,
    of_vehicle,
    doubts_of_vehicle,
    without_vehicle,
)
