"""Declaration of the annex of pictures: its command, public names and kinds of pictures."""

from vstatics.core.annexes import Annex, Command, PictureKind

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
    },
    pictures={
        "plan": PictureKind(
            "vstatics.pictures.plan.picture",
            "speeds of all links over the output speed: the generalised\nkinematic plan",
            10,
            "Kinematic plan",
            options=("motion", "ratios"),
        ),
        "lever": PictureKind(
            "vstatics.pictures.lever.picture",
            "the lever analogy: sets as levers, their joints, torques and\nspeeds, gear by gear",
            20,
            "Lever diagram",
            options=("merge",),
        ),
        "flow": PictureKind(
            "vstatics.pictures.flow.picture",
            "power of each gear in bands, losses, circulating power",
            30,
            "Power flow",
        ),
        "structure": PictureKind(
            "vstatics.pictures.schemes.structure",
            "mechanisms as boxes, links as wires, clutches and brakes",
            40,
            "Structure",
        ),
        "stick": PictureKind(
            "vstatics.pictures.schemes.stick",
            "the stick diagram of elements, or of what may be planetary sets",
            50,
            "Stick diagram",
            options=("wheels", "order"),
        ),
        "efficiency": PictureKind(
            "vstatics.pictures.flow.efficiency",
            "efficiency by gear, with the losses of each mechanism",
            60,
            "Efficiency",
            alike=True,
        ),
    },
    picture_options={
        "motion": "only {kinds} show a run",
        "merge": "only levers can be merged",
        "wheels": "only stick diagrams name them",
        "order": "only stick diagrams have sets in a row",
        "ratios": "only a plan follows from ratios alone",
    },
)
