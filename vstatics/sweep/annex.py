"""Declaration of the annex of sweeps: its command, public names, document and pictures."""

from vstatics.core.annexes import Annex, Command, DocumentKind, PictureKind

_NO_GEAR = {"gear": "expected --by gear, or the column of a gear"}

ANNEX = Annex(
    name="sweep",
    needs=("pictures",),
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
        "plot_sweep": "vstatics.sweep.pictures.plotting",
        "plot_written_sweep": "vstatics.sweep.cli.plot",
    },
    pictures={
        "map": PictureKind(
            "vstatics.sweep.pictures.map",
            "what `sweep -o` wrote, in place of a case: contours of a\n"
            "column over two varied numbers, and where operation ends",
            160,
            shows="sweep",
            options=("columns",),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
        "curves": PictureKind(
            "vstatics.sweep.pictures.curves",
            "of the same: columns over one varied number, a line for each\n"
            "gear, or for each value of another one",
            170,
            shows="sweep",
            options=("columns",),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
        "histogram": PictureKind(
            "vstatics.sweep.pictures.histogram",
            "of the same, and of what `simulate --samples -o` wrote: how\n"
            "often numbers of a column fall into parts of its range",
            180,
            shows="sweep",
            options=("columns",),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
    },
    picture_options={"columns": "only {kinds} are of columns"},
)
