"""The same case in motion: what happens to it by a scenario.

1. `scenario` reads what happens: a case, a start, controls or shifts, torques.
2. `system` makes a `MotionSystem` of it, and the equations that hold while the same things stick.
3. `events`: they are solved in closed form, else step by step, to where a margin ends; from there
   on something else sticks.
4. `course` goes from event to event, `record` keeps what is asked for: a `Motion`, whose energy
   must close. `run` is all of it, `bounds` says how long it may take; `stepping` goes on as it is
   told.

`published` is the method of Tarasik, for comparison. `variants` are many runs with other numbers,
of sweeps and samples. `pictures` draws a run over time, `report` has the section of a page, `cli`
the command `vstatics simulate`. The annex needs scipy, an extra. How it all is derived:
docs/method.md.

>>> from vstatics import ShiftElement, Transmission
>>> from vstatics.simulation import Capacity, Scenario, Start, constant, simulate
>>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
>>> brake = {1: Capacity(constant(40.0))}
>>> motion = simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}), brake))
>>> motion.events[0].event, round(motion.events[0].time, 6), round(motion.energy.heat["B"], 6)
('locks', 0.5, 100.0)

Sources: the matrix method of Algin; Tarasik, Planetary gearbox simulation, 2018; Tsitovich, Algin,
Vehicle dynamics, Minsk, 1981 (chapters 1.3 to 1.5 and 3).
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
