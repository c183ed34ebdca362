"""All JSON Schemas in ``schemas/``: ``python -m vstatics.core.cli.schemas FOLDER`` writes them."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from typing import Any

from vstatics.core.cli.check import ProblemRecord
from vstatics.core.comparison.verdicts import Verdict
from vstatics.core.explain.answer import ExplanationAnswer
from vstatics.core.explain.exercise import SolvedExercise
from vstatics.core.flow.answer import FlowAnswer
from vstatics.core.model.shape import Measure
from vstatics.core.readers.named import schema as case
from vstatics.core.summary.answer import SummaryAnswer
from vstatics.core.tables.answer import documents_of, of_file, schema
from vstatics.core.writers import schema as result
from vstatics.simulation.record.answer import MotionAnswer
from vstatics.simulation.scenario.keys import SCENARIO
from vstatics.sweep.results.statistics import SamplesAnswer
from vstatics.synthesis.boxes.listing import BoxListing, ListedBox
from vstatics.synthesis.cli.box.command import BoxSearchEstimate
from vstatics.synthesis.cli.combinations_output import CombinationEstimate
from vstatics.synthesis.cli.structures import StructureCount, StructureEstimate
from vstatics.synthesis.gears.kinds import (
    EngagedSet,
    EngagedSetList,
    EngagedSetsOfAllPorts,
    EngagedSetsOfPorts,
)
from vstatics.synthesis.ratios.fitting import Fit
from vstatics.synthesis.structures.growth import FoundScheme
from vstatics.synthesis.teeth.solutions import TeethAnswer
from vstatics.torsion.answers import (
    DampingAnswer,
    IdentificationAnswer,
    ModesAnswer,
    RandomAnswer,
    ReductionAnswer,
    ResponseAnswer,
    SimplificationAnswer,
)
from vstatics.torsion.cli import dump
from vstatics.vehicle.damage.devices import DamageAnswer
from vstatics.vehicle.damage.rayleigh import RayleighLife
from vstatics.vehicle.damage.resize import ResizedShaft
from vstatics.vehicle.operation.drive_cycle import CycleAnswer

ANSWERS = {
    "flow": ("Power of gears, of vstatics flow", FlowAnswer),
    "summary": ("Summary of a case, of vstatics summary", SummaryAnswer),
    "cycle": ("A driving cycle, of vstatics cycle", CycleAnswer),
    "explain": ("Gears explained, of vstatics explain", ExplanationAnswer),
    "exercise": ("A gear as an exercise, of vstatics explain --solution", SolvedExercise),
    "modes": ("Natural modes, of vstatics torsion modes", ModesAnswer),
    "reduction": (
        "Reduced inertias and compliances, of vstatics torsion reduce",
        ReductionAnswer,
    ),
    "simplification": ("A simpler scheme, of vstatics torsion simplify", SimplificationAnswer),
    "response": ("Forced vibration, of vstatics torsion response", ResponseAnswer),
    "random": ("Random vibration, of vstatics torsion random", RandomAnswer),
    "identification": (
        "Compliances by a measured frequency, of vstatics torsion identify",
        IdentificationAnswer,
    ),
    "damping": ("Dampings by decrements, of vstatics torsion damping", DampingAnswer),
    "damage": ("Damage by a record of torques, of vstatics damage", DamageAnswer),
    "simulation": ("A simulation, of vstatics simulate", MotionAnswer),
    "samples": ("Statistics of vstatics simulate --samples", SamplesAnswer),
    "fit": ("Ratios for wanted gears, of vstatics synth fit", Fit),
    "teeth": ("Teeth for wanted ratios, of vstatics synth teeth", TeethAnswer),
}
"""Of a file of documents: its title, the record that each is made of."""
OTHERS = {
    "structures": (
        "Schemes of planetary sets, of vstatics synth structures",
        FoundScheme | StructureCount | StructureEstimate,
    ),
    "combinations": (
        "Combinations of shift elements, of vstatics synth combinations",
        EngagedSetList
        | EngagedSet
        | EngagedSetsOfAllPorts
        | EngagedSetsOfPorts
        | CombinationEstimate,
    ),
    "box": (
        "Gearboxes for wanted ratios, of vstatics synth box",
        BoxListing | ListedBox | BoxSearchEstimate,
    ),
    "rayleigh": ("Life under random stresses, of vstatics damage rayleigh", RayleighLife),
    "resize": ("A shaft of equal life, of vstatics damage resize", ResizedShaft),
    "check": ("Problems of cases, by vstatics check", Sequence[ProblemRecord]),
    "compare": ("What changed between results, of vstatics compare", Verdict),
}
"""Of a file that is one of these."""
SCENARIO_MEASURES: tuple[Measure, ...] = (
    *("time", "si_torque", "si_speed", "mass", "length", "area", "velocity", "pump_factor"),
)


def schemas() -> dict[str, dict[str, Any]]:
    """By the name of what each describes."""
    of_case = case.json_schema()
    return {
        "case": of_case,
        "result": result.json_schema(of_case),
        "scenario": case.document_schema(SCENARIO, SCENARIO_MEASURES),
        "dump": dump.json_schema(),
        **{name: documents_of(name, *of) for name, of in ANSWERS.items()},
        **{name: of_file(name, title, schema(kind)) for name, (title, kind) in OTHERS.items()},
    }


def text(schema: dict[str, Any]) -> str:
    """A schema as it stands in its file."""
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for name, made in schemas().items():
        path = os.path.join(sys.argv[1], f"{name}.schema.json")  # noqa: PTH118
        with open(path, "w", encoding="utf-8") as file:  # noqa: PTH123
            file.write(text(made))
