"""Declaration of the annex of sweeps: its command, public names, document and pictures."""

from vstatics.core.annexes import Annex, Command, DocumentKind, PictureKind

_NO_GEAR = {"gear": "expected --by gear, or the column of a gear"}

ANNEX = Annex(
    name="sweep",
    needs=("pictures",),
    commands={
        "sweep": Command(
            "vstatics.sweep.cli.command", "Calculate variants of a case and write a table.", 30
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
            "contours of a column of a table of `sweep -o` over two varied\n"
            "numbers, and the edge beyond which rows have no number",
            160,
            shows="sweep",
            options=("columns", "levels", "duty", "limits", "best_gear"),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
        "curves": PictureKind(
            "vstatics.sweep.pictures.curves",
            "columns of a table of `sweep -o` over one varied number, a\n"
            "line for each gear, or for each value of another number",
            170,
            shows="sweep",
            options=("columns",),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
        "histogram": PictureKind(
            "vstatics.sweep.pictures.histogram",
            "frequency of the values in columns of a table of `sweep -o`\n"
            "or `simulate --samples -o`",
            180,
            shows="sweep",
            options=("columns",),
            refused=_NO_GEAR,
            plots="plot_written_sweep",
        ),
    },
    picture_options={
        "columns": "only {kinds} have columns of a sweep",
        "levels": "only {kinds} has levels",
        "duty": "only {kinds} show operating points",
        "limits": "only {kinds} shows a full-load curve",
        "best_gear": "only {kinds} shows the best gear",
    },
)
