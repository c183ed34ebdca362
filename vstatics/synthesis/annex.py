"""Record of the annex of synthesis: commands, public names, pictures and schemas."""

from vstatics.core.annexes import Annex, Command, DocumentKind, PictureKind, Schema

ANNEX = Annex(
    name="synthesis",
    needs=("pictures",),
    commands={
        "synth": Command(
            "vstatics.synthesis.cli.group",
            "Find gearboxes, gears, ratios and tooth numbers.",
            110,
        ),
    },
    documents={
        "boxes": DocumentKind(
            "these are found boxes, expected a case; "
            "plot --kind boxes, report and summary take one such file",
            {"is_document": "vstatics.synthesis.boxes.reading"},
        ),
    },
    methods={
        "box_option": "vstatics.synthesis.cli.found_boxes",
        "calculated_boxes": "vstatics.synthesis.cli.found_boxes",
        "box_grids": "vstatics.synthesis.boxes.tables",
        "listing_in": "vstatics.synthesis.cli.found_boxes",
        "plot_boxes": "vstatics.synthesis.cli.found_boxes",
        "report_boxes": "vstatics.synthesis.cli.found_boxes",
    },
    groups={
        "synth": {
            "structures": (
                "vstatics.synthesis.cli.structures",
                "List all structures of N planetary gear sets.",
            ),
            "case": ("vstatics.synthesis.cli.case", "Write a structure as a case."),
            "combinations": (
                "vstatics.synthesis.cli.combinations",
                "Find the gears of all combinations of shift elements.",
            ),
            "fit": (
                "vstatics.synthesis.cli.fit",
                "Fit ratios of mechanisms to wanted ratios of gears.",
            ),
            "box": (
                "vstatics.synthesis.cli.box.command",
                "Find gearboxes for wanted ratios.",
            ),
            "teeth": (
                "vstatics.synthesis.cli.teeth",
                "Find tooth numbers for wanted ratios.",
            ),
        },
    },
    own_names={
        "BoxFilter": "vstatics.synthesis.boxes.choice",
        "BoxList": "vstatics.synthesis.boxes.choice",
        "BoxSearch": "vstatics.synthesis.boxes.box",
        "EngagedSet": "vstatics.synthesis.gears.kinds",
        "Fit": "vstatics.synthesis.ratios.fitting",
        "FoundScheme": "vstatics.synthesis.structures.growth",
        "FoundTeeth": "vstatics.synthesis.teeth.finding",
        "RankedBox": "vstatics.synthesis.boxes.choice",
        "SetScheme": "vstatics.synthesis.structures.scheme",
        "StructureSearch": "vstatics.synthesis.structures.growth",
        "TeethLimits": "vstatics.synthesis.teeth.limits",
        "box_is_planar": "vstatics.synthesis.boxes.figures.planar",
        "combinations": "vstatics.synthesis.gears.search",
        "count": "vstatics.synthesis.structures.counts",
        "find_boxes": "vstatics.synthesis.boxes.choice",
        "find_teeth": "vstatics.synthesis.teeth.finding",
        "fit": "vstatics.synthesis.ratios.fitting",
        "scheme_case": "vstatics.synthesis.gears.case_of_scheme",
        "schemes": "vstatics.synthesis.structures.growth",
    },
    pictures={
        "boxes": PictureKind(
            "vstatics.synthesis.pictures.picture",
            "gearboxes found by `synth box -f json`: points of mean loss and\n"
            "largest torque, families, stick diagrams",
            150,
            shows="boxes",
            refused={"gear": "found boxes are shown with all their gears"},
            plots="plot_boxes",
        ),
    },
    schemas={
        "fit": Schema(
            "vstatics.synthesis.ratios.fitting",
            "Fit",
            "Ratios for wanted gears, of vstatics synth fit",
        ),
        "teeth": Schema(
            "vstatics.synthesis.teeth.solutions",
            "TeethAnswer",
            "Teeth for wanted ratios, of vstatics synth teeth",
        ),
        "structures": Schema(
            "vstatics.synthesis.cli.answers",
            "StructuresAnswer",
            "Schemes of planetary sets, of vstatics synth structures",
            documents=False,
        ),
        "combinations": Schema(
            "vstatics.synthesis.cli.answers",
            "CombinationsAnswer",
            "Combinations of shift elements, of vstatics synth combinations",
            documents=False,
        ),
        "box": Schema(
            "vstatics.synthesis.cli.answers",
            "BoxAnswer",
            "Gearboxes for wanted ratios, of vstatics synth box",
            documents=False,
        ),
    },
)
