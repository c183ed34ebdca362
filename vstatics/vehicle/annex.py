"""Declaration of the annex `vehicle`: commands, names, keys, pictures and schemas."""

from vstatics.core.annexes import Annex, Command, PictureKind, Schema

_OWN_GEARS = {"gear": "a duty cycle has its own gears", "coast": "a duty cycle has its own torques"}
_FULL_LOAD = {"coast": "a vehicle is drawn at full load"}

ANNEX = Annex(
    name="vehicle",
    needs=("pictures",),
    commands={
        "cycle": Command(
            "vstatics.vehicle.cli.cycle",
            "Drive a vehicle through a driving cycle.",
            60,
        ),
        "damage": Command(
            "vstatics.vehicle.cli.damage.group",
            "Calculate fatigue damage and life under varying torque.",
            90,
        ),
    },
    names={
        "Bearing": "vstatics.vehicle.case.bearing",
        "DeviceDamage": "vstatics.vehicle.damage.devices",
        "DriveCycle": "vstatics.vehicle.operation.drive_cycle",
        "Fatigue": "vstatics.vehicle.case.fatigue",
        "Machine": "vstatics.vehicle.case.vehicle",
        "Performance": "vstatics.vehicle.operation.traction",
        "RayleighLife": "vstatics.vehicle.damage.rayleigh",
        "ResizedShaft": "vstatics.vehicle.damage.resize",
        "TorqueStrength": "vstatics.vehicle.case.fatigue",
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
        "bearings": "vstatics.vehicle.case.bearing_key",
    },
    methods={
        "damage_grid": "vstatics.vehicle.damage.tables",
        "damages": "vstatics.vehicle.damage.devices",
        "drawn_duty": "vstatics.vehicle.cli.duty",
        "duty_options": "vstatics.vehicle.cli.duty",
        "duty_points": "vstatics.vehicle.duty_file",
        "expect_damage": "vstatics.vehicle.cli.strengths",
        "full_load_curves": "vstatics.vehicle.case.vehicle",
        "read_fuel": "vstatics.vehicle.cli.cycle",
        "torque_life": "vstatics.vehicle.damage.rayleigh",
        "vehicle_section": "vstatics.vehicle.operation.traction",
    },
    types={
        "Damages": "vstatics.vehicle.damage.devices",
        "DutyResults": "vstatics.vehicle.operation.load_spectrum",
        "Performance": "vstatics.vehicle.operation.traction",
    },
    groups={
        "damage": {
            "record": (
                "vstatics.vehicle.cli.damage.record",
                "Calculate the damage under recorded torques.",
            ),
            "rayleigh": (
                "vstatics.vehicle.cli.damage.rayleigh",
                "Calculate the life under a random stress.",
            ),
            "resize": (
                "vstatics.vehicle.cli.damage.resize",
                "Resize a shaft for other torques at equal life.",
            ),
        },
    },
    pictures={
        "traction": PictureKind(
            "vstatics.vehicle.pictures.traction",
            "force at the road wheels of the `vehicle` over its speed in each\n"
            "gear, with all losses, and resistance on slopes of 0 to 30 %",
            120,
            "Wheel force",
            refused=_FULL_LOAD,
            alike=True,
            at_any_load=True,
        ),
        "sawtooth": PictureKind(
            "vstatics.vehicle.pictures.sawtooth",
            "engine speed over road speed in each gear",
            130,
            "Engine speed over road speed",
            refused=_FULL_LOAD,
            alike=True,
            at_any_load=True,
        ),
        "steps": PictureKind(
            "vstatics.vehicle.pictures.steps",
            "forward gears on a logarithmic scale of ratios, with geometric\n"
            "and progressive step ratios for comparison",
            140,
            "Steps between gears",
            alike=True,
        ),
        "spectrum": PictureKind(
            "vstatics.vehicle.pictures.spectrum",
            "revolutions of each member of a duty cycle, by class of torque\n"
            "(load duration distribution)",
            145,
            "Load spectrum",
            options=("duty", "classes"),
            refused=_OWN_GEARS,
            reads="drawn_duty",
            at_any_load=True,
        ),
    },
    picture_options={
        "duty": "only {kinds} show operating points",
        "classes": "only {kinds} has classes of torque",
    },
    schemas={
        "cycle": Schema(
            "vstatics.vehicle.operation.drive_cycle",
            "CycleAnswer",
            "A driving cycle, of vstatics cycle",
        ),
        "damage": Schema(
            "vstatics.vehicle.damage.devices",
            "DamageAnswer",
            "Damage by a record of torques, of vstatics damage",
        ),
        "rayleigh": Schema(
            "vstatics.vehicle.damage.rayleigh",
            "RayleighLife",
            "Life under random stresses, of vstatics damage rayleigh",
            documents=False,
        ),
        "resize": Schema(
            "vstatics.vehicle.damage.resize",
            "ResizedShaft",
            "A shaft of equal life, of vstatics damage resize",
            documents=False,
        ),
    },
)
