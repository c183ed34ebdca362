"""What torsional vibration provides to the program."""

from vstatics.core.annexes import Annex, Command, Schema

ANNEX = Annex(
    name="torsion",
    commands={
        "torsion": Command(
            "vstatics.torsion.cli.group", "The transmission as a torsional system.", 100
        ),
    },
    names={
        "ClutchDump": "vstatics.torsion.clutch.clutch_dump",
    },
    methods={
        "frequencies": "vstatics.torsion.vibration.varied_frequencies",
        "mode_names": "vstatics.torsion.vibration.varied_frequencies",
        "modes_grids": "vstatics.torsion.vibration.tables",
        "overview_grids": "vstatics.torsion.vibration.tables",
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
