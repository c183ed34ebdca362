"""What torsional vibration provides to the program."""

from vstatics.core.annexes import Annex, Command

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
    keys={"dump": "vstatics.torsion.clutch.dump_key"},
    methods={
        "modes_grids": "vstatics.torsion.vibration.tables",
        "overview_grids": "vstatics.torsion.vibration.tables",
    },
)
