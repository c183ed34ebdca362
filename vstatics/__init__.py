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
    import vstatics.core.start  # noqa: F401 - first, because it makes further imports safe and fast
except KeyboardInterrupt:
    raise SystemExit(130) from None  # Ctrl-C during this import

# isort: split
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

from vstatics.core.annexes import module_of_name, public_names
from vstatics.core.errors import CaseError, Place, Problem, ReadError, VstaticsError
from vstatics.core.extras import __version__, later
from vstatics.core.model.parts import Damping, Load
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.readers import load, loads
from vstatics.core.record import CORE

if TYPE_CHECKING:
    from vstatics.core.checking import check
    from vstatics.core.comparison.compare import compare
    from vstatics.core.comparison.verdicts import Verdict
    from vstatics.core.elements import CentralWheel, MeshEfficiency, transmission
    from vstatics.core.elements.drawing import Drawing
    from vstatics.core.elements.element import Element, PlanetMass
    from vstatics.core.explain.exercise import GearExercise, exercise
    from vstatics.core.explain.explanation import Explanation, explain_gear
    from vstatics.core.flow.power import flows
    from vstatics.core.flow.power_flow import GearFlow, PowerFlow
    from vstatics.core.statics.result_arrays import Message
    from vstatics.core.statics.results import Results
    from vstatics.core.statics.solve import distribution_matrix, solve
    from vstatics.core.statics.state import GearState
    from vstatics.core.summary import Summary, summarize
    from vstatics.core.writers.saving import save
    from vstatics.page.report.saving import write_report
    from vstatics.pictures.plotting import Picture, plot
    from vstatics.simulation.examples import Example
    from vstatics.simulation.record.motion import Motion
    from vstatics.simulation.run import simulate
    from vstatics.simulation.scenario.file import load_scenario
    from vstatics.simulation.scenario.parts import Scenario
    from vstatics.simulation.variants.subject import VariedScenario, load_varied
    from vstatics.sweep import sweep
    from vstatics.sweep.chunk import Chunk
    from vstatics.sweep.swept import Sweep
    from vstatics.torsion.clutch.clutch_dump import ClutchDump
    from vstatics.vehicle.case.bearing import Bearing
    from vstatics.vehicle.case.fatigue import Fatigue, TorqueStrength
    from vstatics.vehicle.case.vehicle import Machine, Vehicle
    from vstatics.vehicle.damage.devices import DeviceDamage, damages
    from vstatics.vehicle.damage.rayleigh import RayleighLife, rayleigh_life
    from vstatics.vehicle.damage.resize import ResizedShaft, resized, resized_by_ratio
    from vstatics.vehicle.operation.drive_cycle import DriveCycle
    from vstatics.vehicle.operation.driving import cycle
    from vstatics.vehicle.operation.trace import Trace
    from vstatics.vehicle.operation.traction import Performance

    example: Example
    __all__ = [
        "Bearing",
        "CaseError",
        "CentralWheel",
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
        "Machine",
        "Mechanism",
        "MeshEfficiency",
        "Message",
        "Motion",
        "Performance",
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
        "TorqueStrength",
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
        "transmission",
        "write_report",
    ]

_FIRST = (
    *("CaseError", "Damping", "Gear", "Load", "Mechanism", "Place", "Problem", "ReadError"),
    *("ShiftElement", "Spring", "Transmission", "VstaticsError", "__version__", "load", "loads"),
)
"""Public names that are imported with the package."""


_later = later(__name__, CORE.names, module_of_name)
_elements = ModuleType("vstatics.elements", "Gear sets with teeth: names that `vstatics` has, too.")
_of_elements = ("CentralWheel", "Drawing", "Element", "MeshEfficiency", "PlanetMass")
vars(_elements)["__getattr__"] = later(
    "vstatics.elements",
    dict.fromkeys((*_of_elements, "transmission"), "vstatics.core.elements"),
)
sys.modules[_elements.__name__] = _elements
"""Alias module `vstatics.elements`, from which earlier scripts import these names."""


class _Package(ModuleType):
    """Package whose functions keep their names although annexes have equal names.

    The import system binds each imported annex to its name; `sweep` must remain the function.
    """

    def __setattr__(self, name: str, value: object) -> None:
        named = vars(value).get(name, value) if isinstance(value, ModuleType) else value
        super().__setattr__(name, named)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    """Import a public name on first use, and read the records of annexes only then."""
    return __dir__() if name == "__all__" else _later(name)


def __dir__() -> list[str]:
    """Return the public names of the core and of the annexes that are installed."""
    return sorted([*_FIRST, *CORE.names, *public_names()])
