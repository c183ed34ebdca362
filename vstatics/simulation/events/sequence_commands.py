"""Actions of a sequence step: it sets numbers, starts a shift, or moves dog clutches."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve
from vstatics.simulation.scenario.parts import Dog, Scenario, SequenceStep
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.sight import looking


def with_actions(
    scenario: Scenario, engaged: Sequence[int], time: float, step: SequenceStep
) -> Scenario:
    """Return the scenario with the shift and the dog clutches of a step as inputs at a time.

    Parameters
    ----------
    scenario : Scenario
    engaged : sequence of int
        Numbers of the shift elements that are engaged at the start.
    time : float
        Time at which the step acts. [s]
    step : SequenceStep
    """
    if step.shift is not None:
        shifts = scenario.shifts or ()
        place = bisect_right([shift.at for shift in shifts], time)
        shifts = (*shifts[:place], step.shift._replace(at=time), *shifts[place:])
        scenario = scenario._replace(shifts=shifts)
    controls = dict(scenario.controls or {})
    for number, closed in step.dogs.items():
        control = controls.get(number)
        before: tuple[tuple[float, bool], ...] = ((0.0, number in engaged),)
        if isinstance(control, Dog):
            before = control.points
        earlier = [point for point in before if point[0] < time]
        later = [point for point in before if point[0] > time]
        controls[number] = Dog((*earlier, (time, closed), *later))
    return scenario._replace(controls=controls) if step.dogs else scenario


def value_of(system: MotionSystem, value: Curve, time: float, seen: Sequence[float]) -> float:
    """Return the value that a step assigns to a number."""
    if isinstance(value, Formula):
        return looking(system, value).at(time, seen)
    return value.y[0]


def with_states(scenario: Scenario, now: Floats, values: Mapping[str, float]) -> Floats:
    """Return the values of control states after a step has set some, clipped to their limits."""
    after = now.copy()
    for index, state in enumerate(scenario.states):
        if state.name in values:
            after[index] = min(max(values[state.name], state.least), state.most)
    return after
