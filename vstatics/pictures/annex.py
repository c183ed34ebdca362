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
            "kinematic plan (speed plan): speeds of all links over the output\n"
            "speed, both divided by the input speed",
            10,
            "Kinematic plan",
            options=("motion", "ratios"),
        ),
        "lever": PictureKind(
            "vstatics.pictures.lever.picture",
            "lever diagram of each gear: gear sets as levers, with joints,\ntorques and speeds",
            20,
            "Lever diagram",
            options=("merge",),
        ),
        "flow": PictureKind(
            "vstatics.pictures.flow.picture",
            "power flow of each gear as bands, losses, recirculating power",
            30,
            "Power flow",
        ),
        "structure": PictureKind(
            "vstatics.pictures.schemes.structure",
            "block diagram: mechanisms as boxes, links as wires, clutches\nand brakes",
            40,
            "Structure",
            at_any_load=True,
        ),
        "stick": PictureKind(
            "vstatics.pictures.schemes.stick",
            "stick diagram of the gear sets, or of mechanisms that can be\nplanetary gear sets",
            50,
            "Stick diagram",
            options=("wheels", "order"),
            at_any_load=True,
        ),
        "efficiency": PictureKind(
            "vstatics.pictures.flow.efficiency",
            "efficiency of each gear, with the losses of each mechanism",
            60,
            "Efficiency",
            alike=True,
        ),
    },
    picture_options={
        "motion": "only {kinds} show a run",
        "merge": "only levers can be merged",
        "wheels": "only stick diagrams show teeth",
        "order": "only stick diagrams have sets in a row",
        "ratios": "only a plan follows from ratios alone",
    },
)
