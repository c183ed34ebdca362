"""What sweeps of variants provide to the program."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="sweep",
    commands={
        "sweep": Command(
            "vstatics.sweep.cli.command", "Calculate variants of a case, to a table.", 30
        ),
    },
    names={
        "Chunk": "vstatics.sweep.chunk",
        "Sweep": "vstatics.sweep.swept",
        "VariedScenario": "vstatics.sweep.variants.subject",
        "load_varied": "vstatics.sweep.variants.subject",
        "sweep": "vstatics.sweep",
    },
    methods={
        "plot_sweep": "vstatics.sweep.pictures.plotting",
    },
)
