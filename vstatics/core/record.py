"""Record of the core, in the form of an annex record: commands, public names, functions."""

from vstatics.core.annexes import Annex, Command

CORE = Annex(
    name="core",
    commands={
        "new": Command("vstatics.core.cli.new", "Write a commented case to start from.", 10),
        "run": Command("vstatics.core.cli.run", "Calculate every gear of each case.", 20),
        "flow": Command(
            "vstatics.core.cli.flow",
            "Show power flow, losses and recirculating power.",
            40,
        ),
        "summary": Command(
            "vstatics.core.cli.summary",
            "Summarize ratios, step ratios, spread, shifts and largest values.",
            50,
        ),
        "explain": Command(
            "vstatics.core.cli.explain", "Explain the equations and the ratio of a gear.", 70
        ),
        "check": Command(
            "vstatics.core.cli.check",
            "Report errors and warnings, and the constraints of each gear.",
            150,
        ),
        "convert": Command(
            "vstatics.core.cli.convert", "Convert a case between deck, YAML, JSON and XLSX.", 160
        ),
        "compare": Command("vstatics.core.cli.compare", "Compare two results.", 170),
    },
    names={
        "CentralWheel": "vstatics.core.elements",
        "Drawing": "vstatics.core.elements.drawing",
        "Element": "vstatics.core.elements.element",
        "Explanation": "vstatics.core.explain.explanation",
        "GearExercise": "vstatics.core.explain.exercise",
        "GearFlow": "vstatics.core.flow.power_flow",
        "GearState": "vstatics.core.statics.state",
        "MeshEfficiency": "vstatics.core.elements",
        "Message": "vstatics.core.statics.result_arrays",
        "PlanetMass": "vstatics.core.elements.element",
        "PowerFlow": "vstatics.core.flow.power_flow",
        "Results": "vstatics.core.statics.results",
        "Summary": "vstatics.core.summary",
        "Verdict": "vstatics.core.comparison.verdicts",
        "check": "vstatics.core.checking",
        "compare": "vstatics.core.comparison.compare",
        "distribution_matrix": "vstatics.core.statics.solve",
        "example": "vstatics.core.examples",
        "exercise": "vstatics.core.explain.exercise",
        "explain_gear": "vstatics.core.explain.explanation",
        "flows": "vstatics.core.flow.power",
        "save": "vstatics.core.writers.saving",
        "solve": "vstatics.core.statics.solve",
        "summarize": "vstatics.core.summary",
        "transmission": "vstatics.core.elements",
    },
    methods={
        "by_name": "vstatics.core.tables.names",
        "explanation_grids": "vstatics.core.explain.tables",
        "flow_grids": "vstatics.core.flow.rows",
        "from_dict": "vstatics.core.readers",
        "part_numbers": "vstatics.core.elements.part_numbers",
        "results_html": "vstatics.core.summary.pretty",
        "summary_grids": "vstatics.core.summary.tables",
        "to_dataframe": "vstatics.core.tables.dataframe",
        "to_json": "vstatics.core.writers.result_json",
        "to_xarray": "vstatics.core.tables.dataset",
        "with_part_numbers": "vstatics.core.elements.part_numbers",
    },
)
"""Record of the core. A module is imported at the first use of a name."""
