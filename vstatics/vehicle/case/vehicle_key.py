"""Declaration of the key `vehicle` of a case, with checks."""

from __future__ import annotations

from vstatics.core.model.carried import CaseKey
from vstatics.core.model.shape import NUMBER, TEXT, ByKey, KeyShape, Leaf, ListOf, RowOf
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.vehicle.case.vehicle import Vehicle, vehicle_record
from vstatics.vehicle.case.vehicle_checks import doubts_of_vehicle, of_vehicle, without_vehicle

_POINTS = ListOf(
    RowOf((Leaf("si_speed"), Leaf("si_torque")), "speed, torque"), "points", unique=False
)
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
            NUMBER,
            "Coefficient of the rolling resistance.",
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
    ),
    Vehicle,
)
KEY = CaseKey(
    KeyShape("vehicle", VEHICLE, "The vehicle of the gearbox."),
    Vehicle | None,
    vehicle_record,
    of_vehicle,
    doubts_of_vehicle,
    without_vehicle,
)
