"""Declaration of the annex on torsional vibration."""

from vstatics.core.annexes import Annex, Command, PictureKind, ReportPart, Schema

ANNEX = Annex(
    name="torsion",
    needs=("pictures",),
    commands={
        "torsion": Command(
            "vstatics.torsion.cli.group", "The transmission as a torsional system.", 100
        ),
    },
    names={
        "ClutchDump": "vstatics.torsion.clutch.clutch_dump",
    },
    keys={"dump": "vstatics.torsion.clutch.dump_key"},
    methods={
        "frequencies": "vstatics.torsion.vibration.varied_frequencies",
        "mode_names": "vstatics.torsion.vibration.varied_frequencies",
        "modes_grids": "vstatics.torsion.vibration.tables",
        "overview_grids": "vstatics.torsion.vibration.tables",
    },
    groups={
        "torsion": {
            "modes": (
                "vstatics.torsion.cli.modes",
                "Natural frequencies and shapes in every gear.",
            ),
            "reduce": ("vstatics.torsion.cli.reduce", "Inertias and compliances on one link."),
            "simplify": (
                "vstatics.torsion.cli.simplify",
                "Fewer masses, the same low frequencies.",
            ),
            "response": (
                "vstatics.torsion.cli.response",
                "Amplitudes and torques by orders and speeds.",
            ),
            "random": (
                "vstatics.torsion.cli.random",
                "Deviations and life under random excitation.",
            ),
            "dump": ("vstatics.torsion.cli.dump", "The largest torque when the clutch is dumped."),
            "identify": ("vstatics.torsion.cli.measured", "Compliances from a measured frequency."),
            "damping": ("vstatics.torsion.cli.measured", "Dampings from logarithmic decrements."),
        },
    },
    own_names={
        "CaseModes": "vstatics.torsion.vibration.gear_modes",
        "Correlation": "vstatics.torsion.random.spectra",
        "Damped": "vstatics.torsion.vibration.measured",
        "Dump": "vstatics.torsion.clutch.given",
        "DumpTorque": "vstatics.torsion.clutch.dumped",
        "GearDump": "vstatics.torsion.clutch.gear_dump",
        "GearModes": "vstatics.torsion.vibration.gear_modes",
        "GearRandom": "vstatics.torsion.random.random_vibration",
        "GearReduction": "vstatics.torsion.reduction.reduced_values",
        "GearResponse": "vstatics.torsion.forced.harmonic_torques",
        "Harmonic": "vstatics.torsion.forced.harmonic_torques",
        "Identified": "vstatics.torsion.vibration.measured",
        "Mode": "vstatics.torsion.vibration.gear_modes",
        "Simplification": "vstatics.torsion.reduction.simplification",
        "SpectrumPoints": "vstatics.torsion.random.spectra",
        "TorsionScheme": "vstatics.torsion.reduction.scheme",
        "White": "vstatics.torsion.random.spectra",
        "damping": "vstatics.torsion.vibration.measured",
        "dump": "vstatics.torsion.clutch.dumped",
        "gear_dumps": "vstatics.torsion.clutch.gear_dump",
        "gear_scheme": "vstatics.torsion.reduction.reduced_scheme",
        "identify": "vstatics.torsion.vibration.measured",
        "modes": "vstatics.torsion.vibration.gear_modes",
        "random_vibration": "vstatics.torsion.random.random_vibration",
        "reduce": "vstatics.torsion.reduction.reduced_values",
        "response": "vstatics.torsion.forced.harmonic_torques",
        "simplify": "vstatics.torsion.reduction.simplification",
    },
    pictures={
        "modes": PictureKind(
            "vstatics.torsion.pictures.shapes.modes",
            "natural modes of a gear, the first unless --gear says which:\n"
            "shapes over the links, shares of the energy",
            70,
            "Natural modes",
            "vibration",
        ),
        "campbell": PictureKind(
            "vstatics.torsion.pictures.orders.campbell",
            "natural frequencies of all gears over the input speed, and\n"
            "where its orders meet them",
            80,
            "Campbell diagram",
            "vibration",
            options=("orders", "speed"),
            least_width=135.0,
        ),
        "response": PictureKind(
            "vstatics.torsion.pictures.orders.response",
            "amplitude of the input over its speed under 1 N*m, a line for\n"
            "each order, gear by gear",
            90,
            "Response",
            "vibration",
            options=("orders", "speed", "at"),
            least_width=100.0,
        ),
        "dump": PictureKind(
            "vstatics.torsion.pictures.dump",
            "the largest torque when the clutch is dumped, by gear",
            100,
            "Dumped clutch",
            "vibration",
            least_width=135.0,
        ),
    },
    report={"vibration": ReportPart("Vibration", "vstatics.torsion.report.vibration", 110)},
    picture_options={
        "orders": "only {kinds} have orders",
        "speed": "only {kinds} are over a speed",
        "at": "only a response is that of a link",
    },
    schemas={
        "modes": Schema(
            "vstatics.torsion.answers", "ModesAnswer", "Natural modes, of vstatics torsion modes"
        ),
        "reduction": Schema(
            "vstatics.torsion.answers",
            "ReductionAnswer",
            "Reduced inertias and compliances, of vstatics torsion reduce",
        ),
        "simplification": Schema(
            "vstatics.torsion.answers",
            "SimplificationAnswer",
            "A simpler scheme, of vstatics torsion simplify",
        ),
        "response": Schema(
            "vstatics.torsion.answers",
            "ResponseAnswer",
            "Forced vibration, of vstatics torsion response",
        ),
        "random": Schema(
            "vstatics.torsion.answers",
            "RandomAnswer",
            "Random vibration, of vstatics torsion random",
        ),
        "identification": Schema(
            "vstatics.torsion.answers",
            "IdentificationAnswer",
            "Compliances by a measured frequency, of vstatics torsion identify",
        ),
        "damping": Schema(
            "vstatics.torsion.answers",
            "DampingAnswer",
            "Dampings by decrements, of vstatics torsion damping",
        ),
        "dump": Schema("vstatics.torsion.cli.dump", "json_schema"),
    },
)
