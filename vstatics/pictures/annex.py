"""What pictures provide to the program."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="pictures",
    commands={
        "plot": Command(
            "vstatics.pictures.cli.plot", "Draw a picture of a case: SVG, PNG or PDF.", 120
        ),
    },
    names={
        "Picture": "vstatics.pictures.plotting",
        "plot": "vstatics.pictures.plotting",
    },
    methods={
        "plot": "vstatics.pictures.plotting",
        "plot_motion": "vstatics.pictures.plotting",
    },
)
