"""What torsional vibration provides to the program."""

from vstatics.core.annexes import Annex, Command

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
    methods={
        "frequencies": "vstatics.torsion.vibration.varied_frequencies",
        "mode_names": "vstatics.torsion.vibration.varied_frequencies",
        "modes_grids": "vstatics.torsion.vibration.tables",
        "overview_grids": "vstatics.torsion.vibration.tables",
    },
)
