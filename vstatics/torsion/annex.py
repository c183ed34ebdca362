"""Declaration of the annex: its commands, keys, public names, documents and pictures."""

from vstatics.core.annexes import Annex, Command, PictureKind, ReportPart, Schema

ANNEX = Annex(
    name="torsion",
    needs=("pictures",),
    commands={
        "torsion": Command(
            "vstatics.torsion.cli.group", "Calculate torsional vibration and clutch dump.", 100
        ),
    },
    names={
        "ClutchDump": "vstatics.torsion.clutch.clutch_dump",
    },
    keys={"dump": "vstatics.torsion.clutch.dump_key"},
    methods={
        "drawn_torques": "vstatics.torsion.cli.response",
        "frequencies": "vstatics.torsion.vibration.varied_frequencies",
        "mode_names": "vstatics.torsion.vibration.varied_frequencies",
        "modes_grids": "vstatics.torsion.vibration.tables",
        "overview_grids": "vstatics.torsion.vibration.tables",
        "vibrating": "vstatics.torsion.system.state",
    },
    groups={
        "torsion": {
            "modes": (
                "vstatics.torsion.cli.modes",
                "Calculate natural frequencies and mode shapes.",
            ),
            "reduce": (
                "vstatics.torsion.cli.reduce",
                "Reduce inertias and compliances to one link.",
            ),
            "simplify": (
                "vstatics.torsion.cli.simplify",
                "Simplify the system, with equal low frequencies.",
            ),
            "response": (
                "vstatics.torsion.cli.response",
                "Calculate the forced vibration by orders and speeds.",
            ),
            "random": (
                "vstatics.torsion.cli.random",
                "Calculate random vibration and fatigue life.",
            ),
            "dump": ("vstatics.torsion.cli.dump", "Calculate the largest torque of a clutch dump."),
            "identify": (
                "vstatics.torsion.cli.measured",
                "Correct compliances by a measured frequency.",
            ),
            "damping": (
                "vstatics.torsion.cli.measured",
                "Calculate damping from logarithmic decrements.",
            ),
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
            "natural modes of each gear (standard output: first gear only):\n"
            "shapes over the links, and shares of the energy",
            70,
            "Natural modes",
            "vibration",
        ),
        "campbell": PictureKind(
            "vstatics.torsion.pictures.orders.campbell",
            "natural frequencies of all gears over the input speed, with\n"
            "their intersections with the orders",
            80,
            "Campbell diagram",
            "vibration",
            options=("orders", "speed"),
            least_width=135.0,
        ),
        "response": PictureKind(
            "vstatics.torsion.pictures.orders.response",
            "amplitude of the input against its speed in each gear, a line for\n"
            "each order, under 1 N*m or the torques of --torque",
            90,
            "Response",
            "vibration",
            options=("orders", "speed", "at", "torque"),
            reads="drawn_torques",
            least_width=100.0,
        ),
        "dump": PictureKind(
            "vstatics.torsion.pictures.dump",
            "largest torque when the clutch is dumped, in each gear",
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
        "torque": "only {kinds} has an exciting torque",
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
