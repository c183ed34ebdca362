"""Vehicle transmissions calculated from their kinematic scheme.

Speeds, planet and slip speeds, torques with and without losses, efficiency and
power flow in every gear, by the matrix method of Algin.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(
...     links=3,
...     shift_elements=[ShiftElement(1, 2), ShiftElement(2, 0)],
...     mechanisms=[Mechanism(1, 2, 3, ratio=-2.5, efficiency=0.96)],
...     gears=[Gear([1], name="direct"), Gear([2], name="low")],
... )
>>> results = solve(case)
>>> results.ratio
array([1. , 3.5])
>>> results.efficiency.round(4)
array([1.    , 0.9714])
"""

try:
    import vstatics.start  # noqa: F401 - first: it makes the import of the others safe and fast
except KeyboardInterrupt:
    raise SystemExit(130) from None  # before it has done so

# isort: split
from typing import TYPE_CHECKING

from vstatics.errors import CaseError, Place, Problem, ReadError, VstaticsError
from vstatics.extras import HIGHER, __version__, later
from vstatics.model.parts import Damping, Load
from vstatics.model.springs import Spring
from vstatics.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.readers import load, loads
from vstatics.statics.matrix import distribution_matrix
from vstatics.statics.result_arrays import Message
from vstatics.statics.results import Results
from vstatics.statics.solve import solve
from vstatics.statics.state import GearState
from vstatics.sweep import sweep

if TYPE_CHECKING:
    from vstatics.checking import check
    from vstatics.comparison.compare import compare
    from vstatics.comparison.verdicts import Verdict
    from vstatics.damage.devices import DeviceDamage, damages
    from vstatics.damage.rayleigh import RayleighLife, rayleigh_life
    from vstatics.damage.resize import ResizedShaft, resized, resized_by_ratio
    from vstatics.elements.drawing import Drawing
    from vstatics.elements.element import Element, PlanetMass
    from vstatics.examples import example
    from vstatics.explain.exercise import exercise
    from vstatics.explain.explanation import Explanation, explain_gear
    from vstatics.explain.worksheet import GearExercise
    from vstatics.flow.power import flows
    from vstatics.flow.power_flow import GearFlow, PowerFlow
    from vstatics.model.clutch_dump import ClutchDump
    from vstatics.model.fatigue import Fatigue
    from vstatics.model.vehicle import Vehicle
    from vstatics.pictures.plotting import Picture, plot
    from vstatics.report import write_report
    from vstatics.simulation.record.motion import Motion
    from vstatics.simulation.run import simulate
    from vstatics.simulation.scenario.file import load_scenario
    from vstatics.simulation.scenario.parts import Scenario
    from vstatics.summary import Summary, summarize
    from vstatics.summary.operation.cycles import cycle
    from vstatics.summary.operation.drive_cycle import DriveCycle
    from vstatics.summary.operation.trace import Trace
    from vstatics.sweep.chunk import Chunk
    from vstatics.sweep.swept import Sweep
    from vstatics.sweep.variants.subject import VariedScenario, load_varied
    from vstatics.writers.saving import save

__all__ = [
    "CaseError",
    "Chunk",
    "ClutchDump",
    "Damping",
    "DeviceDamage",
    "Drawing",
    "DriveCycle",
    "Element",
    "Explanation",
    "Fatigue",
    "Gear",
    "GearExercise",
    "GearFlow",
    "GearState",
    "Load",
    "Mechanism",
    "Message",
    "Motion",
    "Picture",
    "Place",
    "PlanetMass",
    "PowerFlow",
    "Problem",
    "RayleighLife",
    "ReadError",
    "ResizedShaft",
    "Results",
    "Scenario",
    "ShiftElement",
    "Spring",
    "Summary",
    "Sweep",
    "Trace",
    "Transmission",
    "VariedScenario",
    "Vehicle",
    "Verdict",
    "VstaticsError",
    "__version__",
    "check",
    "compare",
    "cycle",
    "damages",
    "distribution_matrix",
    "example",
    "exercise",
    "explain_gear",
    "flows",
    "load",
    "load_scenario",
    "load_varied",
    "loads",
    "plot",
    "rayleigh_life",
    "resized",
    "resized_by_ratio",
    "save",
    "simulate",
    "solve",
    "summarize",
    "sweep",
    "write_report",
]

_LATER = {
    "Chunk": "vstatics.sweep.chunk",
    "ClutchDump": "vstatics.model.clutch_dump",
    "DeviceDamage": "vstatics.damage.devices",
    "Drawing": "vstatics.elements.drawing",
    "DriveCycle": "vstatics.summary.operation.drive_cycle",
    "Element": "vstatics.elements.element",
    "Explanation": "vstatics.explain.explanation",
    "Fatigue": "vstatics.model.fatigue",
    "GearExercise": "vstatics.explain.worksheet",
    "GearFlow": "vstatics.flow.power_flow",
    "Motion": "vstatics.simulation.record.motion",
    "Picture": "vstatics.pictures.plotting",
    "PlanetMass": "vstatics.elements.element",
    "PowerFlow": "vstatics.flow.power_flow",
    "RayleighLife": "vstatics.damage.rayleigh",
    "ResizedShaft": "vstatics.damage.resize",
    "Scenario": "vstatics.simulation.scenario.parts",
    "Summary": "vstatics.summary",
    "Sweep": "vstatics.sweep.swept",
    "Trace": "vstatics.summary.operation.trace",
    "VariedScenario": "vstatics.sweep.variants.subject",
    "Vehicle": "vstatics.model.vehicle",
    "Verdict": "vstatics.comparison.verdicts",
    "check": "vstatics.checking",
    "compare": "vstatics.comparison.compare",
    "cycle": "vstatics.summary.operation.cycles",
    "damages": "vstatics.damage.devices",
    "example": "vstatics.examples",
    "exercise": "vstatics.explain.exercise",
    "explain_gear": "vstatics.explain.explanation",
    "flows": "vstatics.flow.power",
    "load_scenario": "vstatics.simulation.scenario.file",
    "load_varied": "vstatics.sweep.variants.subject",
    "plot": "vstatics.pictures.plotting",
    "rayleigh_life": "vstatics.damage.rayleigh",
    "resized": "vstatics.damage.resize",
    "resized_by_ratio": "vstatics.damage.resize",
    "save": "vstatics.writers.saving",
    "simulate": "vstatics.simulation.run",
    "summarize": "vstatics.summary",
    "write_report": "vstatics.report",
}
"""Names that are imported when somebody asks for them, as they cost start-up time."""


HIGHER.update(
    box_grids="vstatics.synthesis.boxes.grids",
    by_name="vstatics.tables.names",
    explanation_grids="vstatics.explain.grids",
    flow_grids="vstatics.flow.rows",
    from_dict="vstatics.readers",
    modes_grids="vstatics.torsion.vibration.grids",
    motion_dataframe="vstatics.simulation.record.columns",
    motion_grids="vstatics.simulation.record.grids",
    overview_grids="vstatics.torsion.vibration.grids",
    part_numbers="vstatics.sweep.variants.part_numbers",
    plot="vstatics.pictures.plotting",
    plot_motion="vstatics.pictures.plotting",
    plot_sweep="vstatics.pictures.sweeps.plotting",
    results_html="vstatics.summary.pretty",
    summary_grids="vstatics.summary.grids",
    to_dataframe="vstatics.tables.dataframe",
    to_json="vstatics.writers.result_json",
    to_xarray="vstatics.tables.dataset",
    with_part_numbers="vstatics.sweep.variants.part_numbers",
)
"""What methods do, in rooms, or modules, of which those of their classes must know nothing."""


__getattr__ = later(__name__, _LATER)


def __dir__() -> list[str]:
    return __all__
