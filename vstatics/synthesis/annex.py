"""What the search for gearboxes provides to the program."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="synthesis",
    needs=("pictures",),
    commands={
        "synth": Command(
            "vstatics.synthesis.cli.group",
            "Find gearboxes: schemes, gears, ratios, teeth, whole ones.",
            110,
        ),
    },
    methods={
        "box_grids": "vstatics.synthesis.boxes.tables",
    },
)
