"""The same case in motion: what happens to it by a scenario.

1. `scenario_file` reads a `Scenario`: a case, a start, controls or shifts, torques.
2. `devices` makes a `MotionSystem` of it: what is heavy, what is rigid, what sticks, what bends;
   `ports` are what gives a torque by what it sees.
3. While the same things stick, constant matrices hold, a `MotionStructure`, and `Equations` with
   them. They are solved in closed form (`stretches`), else step by step (`pieces`).
4. `margins` tell how far all is from a change, `location` finds where one ends; `selection`
   chooses what sticks from there on, `impacts` joins what joins at once.
5. `course` goes from event to event, `record` keeps what is asked for: a `Motion`, whose energy
   must close (`account`).

`tarasik` is the published method, for comparison. The room needs scipy, an extra. How it all is
derived: docs/method.md.

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

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vstatics.simulation.formula import Formula
    from vstatics.simulation.laws import Points, Resistance, Road, constant
    from vstatics.simulation.motion import Motion
    from vstatics.simulation.run import simulate
    from vstatics.simulation.scenario import (
        Capacity,
        Converter,
        Dog,
        Scenario,
        Shift,
        Start,
    )
    from vstatics.simulation.scenario_file import load_scenario

_LATER = {
    "Capacity": "scenario",
    "Converter": "scenario",
    "Dog": "scenario",
    "Formula": "formula",
    "Motion": "motion",
    "Points": "laws",
    "Resistance": "laws",
    "Road": "laws",
    "Scenario": "scenario",
    "Shift": "scenario",
    "Start": "scenario",
    "constant": "laws",
    "load_scenario": "scenario_file",
    "simulate": "run",
}
"""Names that are imported when somebody asks for them."""

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
    "constant",
    "load_scenario",
    "simulate",
]


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(f"vstatics.simulation.{_LATER[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
