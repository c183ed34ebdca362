"""What the search for gearboxes provides to the program."""

from vstatics.core.annexes import Annex, Command, DocumentKind, Schema

ANNEX = Annex(
    name="synthesis",
    commands={
        "synth": Command(
            "vstatics.synthesis.cli.group",
            "Find gearboxes: schemes, gears, ratios, teeth, whole ones.",
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
