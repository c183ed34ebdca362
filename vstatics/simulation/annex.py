"""What simulation over time provides to the program."""

from vstatics.core.annexes import Annex, Command, DocumentKind, Schema

ANNEX = Annex(
    name="simulation",
    commands={
        "simulate": Command(
            "vstatics.simulation.cli.command", "What a scenario does to a case over time.", 80
        ),
    },
    names={
        "VariedScenario": "vstatics.simulation.variants.subject",
        "load_varied": "vstatics.simulation.variants.subject",
        "Motion": "vstatics.simulation.record.motion",
        "Scenario": "vstatics.simulation.scenario.parts",
        "load_scenario": "vstatics.simulation.scenario.file",
        "simulate": "vstatics.simulation.run",
    },
    documents={
        "scenario": DocumentKind(
            "this is a scenario, expected a case; simulate, plot, report and sweep take scenarios",
            {
                "check_document": "vstatics.simulation.cli.documents",
                "document_problems": "vstatics.simulation.scenario.file",
                "load_document": "vstatics.simulation.scenario.file",
                "read_swept_document": "vstatics.simulation.cli.documents",
                "read_with_case": "vstatics.simulation.cli.documents",
            },
        ),
    },
    methods={
        "motion_dataframe": "vstatics.simulation.record.columns",
        "motion_grids": "vstatics.simulation.record.tables",
    },
    schemas={
        "simulation": Schema(
            "vstatics.simulation.record.answer",
            "MotionAnswer",
            "A simulation, of vstatics simulate",
        ),
        "samples": Schema(
            "vstatics.simulation.variants.statistics",
            "SamplesAnswer",
            "Statistics of vstatics simulate --samples",
        ),
        "scenario": Schema("vstatics.simulation.scenario.keys", "json_schema"),
    },
)
