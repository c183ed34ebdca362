"""What simulation over time provides to the program."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="simulation",
    needs=("pictures", "sweep"),
    commands={
        "simulate": Command(
            "vstatics.simulation.cli.command", "What a scenario does to a case over time.", 80
        ),
    },
    names={
        "Motion": "vstatics.simulation.record.motion",
        "Scenario": "vstatics.simulation.scenario.parts",
        "load_scenario": "vstatics.simulation.scenario.file",
        "simulate": "vstatics.simulation.run",
    },
    methods={
        "motion_dataframe": "vstatics.simulation.record.columns",
        "motion_grids": "vstatics.simulation.record.tables",
    },
)
