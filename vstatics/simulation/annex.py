"""Declaration of the annex: its commands, public names, documents, pictures and schemas."""

from vstatics.core.annexes import Annex, Command, DocumentKind, PictureKind, ReportPart, Schema

ANNEX = Annex(
    name="simulation",
    needs=("pictures", "sweep"),
    commands={
        "simulate": Command(
            "vstatics.simulation.cli.command", "Simulate a shift or launch over time.", 80
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
        "motion_dataset": "vstatics.simulation.record.columns",
        "drawn_run": "vstatics.simulation.cli.scenario_run",
        "motion_grids": "vstatics.simulation.record.tables",
        "paired_runs": "vstatics.simulation.report.pair",
        "plot_motion": "vstatics.simulation.pictures.plotting",
        "read_scenario": "vstatics.simulation.scenario.file",
        "run_of": "vstatics.simulation.cli.scenario_run",
    },
    own_names={
        "Capacity": "vstatics.simulation.scenario.parts",
        "Converter": "vstatics.core.model.converters",
        "Dog": "vstatics.simulation.scenario.parts",
        "Formula": "vstatics.simulation.scenario.formula",
        "Motion": "vstatics.simulation.record.motion",
        "Points": "vstatics.simulation.scenario.laws",
        "Resistance": "vstatics.simulation.scenario.laws",
        "Road": "vstatics.simulation.scenario.laws",
        "Scenario": "vstatics.simulation.scenario.parts",
        "Shift": "vstatics.simulation.scenario.parts",
        "Start": "vstatics.simulation.scenario.parts",
        "SteppedRun": "vstatics.simulation.stepping",
        "begin": "vstatics.simulation.stepping",
        "constant": "vstatics.simulation.scenario.laws",
        "load_scenario": "vstatics.simulation.scenario.file",
        "simulate": "vstatics.simulation.run",
    },
    pictures={
        "shift": PictureKind(
            "vstatics.simulation.pictures.shift",
            "simulation of a scenario over time: gear, speeds, slips, torques\n"
            "and torque capacities, vehicle or output, heat, events",
            110,
            "Run over time",
            "run",
            options=("motion", "out"),
            refused={"gear": "a run goes through all gears of its scenario"},
        ),
    },
    report={
        "run": ReportPart(
            "Run",
            "vstatics.simulation.report.motion",
            20,
            scripts="vstatics.simulation.report.runs.scripts",
        ),
    },
    picture_options={"out": "only shift has columns of a run"},
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
