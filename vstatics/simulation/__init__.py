"""Simulation of shifts and launches: the motion of a case over time under a scenario.

1. `scenario` reads a scenario: a case, a start, controls or shifts, and torques. 2. `system` builds
a `MotionSystem`, and its equations of motion while a set of contacts sticks. A contact transmits
torque by friction or by form: a shift element, a dry-friction load, a drag. 3. `events` solves the
equations, in closed form or step by step, up to the next event, and selects the contacts that
stick, slip or are open after the event. 4. `course` goes from event to event, and `record` stores
the results as a `Motion`. `run` does all of this, `bounds` limits the wall-clock time, and
`stepping` advances a run interactively.

`published` is the method of Tarasik, for comparison. `variants` runs many variations of a scenario
for sweeps and samples. `pictures` draws a run over time, `report` writes the section of a report
about a run, and `cli` is the command. The equations are derived in docs/simulation/method.md.

>>> from vstatics import ShiftElement, Transmission
>>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
>>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
>>> brake = {1: Capacity(constant(40.0))}
>>> motion = simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake))
>>> motion.events[0].event, round(motion.events[0].time, 6), round(motion.energy.heat["B"], 6)
('locks', 0.5, 100.0)

Sources: the matrix method of Algin; Tarasik, Planetary gearbox simulation, 2018; Tsitovich, Algin,
Vehicle dynamics, 1981.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.core.extras import later
from vstatics.simulation.annex import ANNEX

if TYPE_CHECKING:
    from vstatics.core.model.converters import Converter
    from vstatics.simulation.record.motion import Motion
    from vstatics.simulation.run import simulate
    from vstatics.simulation.scenario.file import load_scenario
    from vstatics.simulation.scenario.formula import Formula
    from vstatics.simulation.scenario.laws import Points, Resistance, Road, constant
    from vstatics.simulation.scenario.parts import Capacity, Dog, Scenario, Shift, Start
    from vstatics.simulation.stepping import SteppedRun, begin

__all__ = [
    "Capacity",
    "Converter",
    "Dog",
    "Formula",
    "Motion",
    "Points",
    "Resistance",
    "Road",
    "Scenario",
    "Shift",
    "Start",
    "SteppedRun",
    "begin",
    "constant",
    "load_scenario",
    "simulate",
]


__getattr__ = later(__name__, ANNEX.own_names)


def __dir__() -> list[str]:
    return __all__
