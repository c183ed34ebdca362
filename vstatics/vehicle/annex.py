"""What the vehicle, its cycles and life provides to the program."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="vehicle",
    commands={
        "cycle": Command(
            "vstatics.vehicle.cli.cycle",
            "Drive a case with a vehicle through a cycle of speeds.",
            60,
        ),
        "damage": Command(
            "vstatics.vehicle.cli.damage.group",
            "What torques that vary do to devices: their life.",
            90,
        ),
    },
    names={
        "DeviceDamage": "vstatics.vehicle.damage.devices",
        "DriveCycle": "vstatics.vehicle.operation.drive_cycle",
        "Fatigue": "vstatics.vehicle.case.fatigue",
        "RayleighLife": "vstatics.vehicle.damage.rayleigh",
        "ResizedShaft": "vstatics.vehicle.damage.resize",
        "Trace": "vstatics.vehicle.operation.trace",
        "Vehicle": "vstatics.vehicle.case.vehicle",
        "cycle": "vstatics.vehicle.operation.driving",
        "damages": "vstatics.vehicle.damage.devices",
        "rayleigh_life": "vstatics.vehicle.damage.rayleigh",
        "resized": "vstatics.vehicle.damage.resize",
        "resized_by_ratio": "vstatics.vehicle.damage.resize",
    },
    keys={
        "vehicle": "vstatics.vehicle.case.vehicle_key",
        "fatigue": "vstatics.vehicle.case.fatigue_key",
    },
    methods={
        "damage_grid": "vstatics.vehicle.damage.tables",
        "damages": "vstatics.vehicle.damage.devices",
        "duty_options": "vstatics.vehicle.cli.duty",
        "expect_fatigue": "vstatics.vehicle.cli.strengths",
        "torque_life": "vstatics.vehicle.damage.rayleigh",
        "vehicle_section": "vstatics.vehicle.operation.traction",
    },
    types={
        "Damages": "vstatics.vehicle.damage.devices",
        "DutyResults": "vstatics.vehicle.operation.load_spectrum",
        "Performance": "vstatics.vehicle.operation.traction",
    },
)
