"""What sweeps of variants provide to the program."""

from vstatics.core.annexes import Annex, Command, DocumentKind

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
        "sweep": "vstatics.sweep",
    },
    documents={
        "sweep file": DocumentKind(
            "this is a sweep file, expected a case; `vstatics sweep --file` takes it"
        ),
    },
    methods={
        "part_numbers": "vstatics.sweep.variants.part_numbers",
        "plot_sweep": "vstatics.sweep.pictures.plotting",
        "with_part_numbers": "vstatics.sweep.variants.part_numbers",
    },
)
