"""Actions of a sequence step: it sets numbers, starts a shift, or moves dog clutches."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve
from vstatics.simulation.scenario.parts import Dog, Scenario, SequenceStep
from vstatics.simulation.scenario.programme import programmes
from vstatics.simulation.system.devices import with_programmes
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.sight import looking, with_settings


class StepCommands:
    """Actions of finished sequence steps, written into the scenario as inputs at their times.

    Parameters
    ----------
    scenario : Scenario
    engaged : sequence of int
        Numbers of the shift elements that are engaged at the start.
    """

    def __init__(self, scenario: Scenario, engaged: tuple[int, ...]) -> None:
        self.scenario, self.engaged = scenario, engaged

    def given(
        self, system: MotionSystem, time: float, step: SequenceStep, values: Mapping[str, float]
    ) -> MotionSystem:
        """Return the system after a sequence step has acted.

        Parameters
        ----------
        system : MotionSystem
        time : float
            Time at which the step acts. [s]
        step : SequenceStep
        values : mapping of str to float
            Values of the numbers that the step sets.
        """
        if step.shift is not None:
            shifts = self.scenario.shifts or ()
            place = bisect_right([shift.at for shift in shifts], time)
            shifts = (*shifts[:place], step.shift._replace(at=time), *shifts[place:])
            self.scenario = self.scenario._replace(shifts=shifts)
        controls = dict(self.scenario.controls or {})
        for number, closed in step.dogs.items():
            control = controls.get(number)
            before: tuple[tuple[float, bool], ...] = ((0.0, number in self.engaged),)
            if isinstance(control, Dog):
                before = control.points
            earlier = [point for point in before if point[0] < time]
            later = [point for point in before if point[0] > time]
            controls[number] = Dog((*earlier, (time, closed), *later))
        if step.dogs:
            self.scenario = self.scenario._replace(controls=controls)
        if step.shift is not None or step.dogs:
            system = with_programmes(system, programmes(self.scenario, self.engaged))
        settings = {name: values.get(name, default) for name, default in system.settings.items()}
        return with_settings(system, settings)


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
