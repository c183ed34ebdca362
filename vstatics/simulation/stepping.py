"""Interactive run that a caller advances step by step, and can return to earlier states."""

from __future__ import annotations

import math
from numbers import Real

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, listed, quoted
from vstatics.core.suggestions import nearest
from vstatics.simulation.course import EventRun
from vstatics.simulation.record.motion import Event
from vstatics.simulation.run import begun
from vstatics.simulation.scenario.checks import check_scenario
from vstatics.simulation.scenario.parts import Scenario, SequenceStep
from vstatics.simulation.tolerances import RTOL


@refusing()
def begin(scenario: Scenario, *, rtol: float = RTOL) -> SteppedRun:
    """Begin a run that can be advanced step by step.

    Parameters
    ----------
    scenario : Scenario
        Scenario; its `duration` does not end the run.
    rtol : float
        Tolerance as in `simulate`. [-]

    Returns
    -------
    SteppedRun
        Run at time 0.

    Raises
    ------
    CaseError
        If the scenario cannot start, with paths in the scenario.

    Examples
    --------
    A brake stops a wheel of 2 kg*m^2; an earlier state is restored afterwards:

    >>> from vstatics import ShiftElement, Transmission
    >>> from vstatics.simulation import Capacity, Scenario, Start, constant
    >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
    >>> run = begin(Scenario(case, 1.0, Start(speeds={1: 10.0}), {1: Capacity(constant(40.0))}))
    >>> run.advance(0.25)
    >>> round(run.speeds["1"], 9), run.events
    (5.0, ())
    >>> before = run.state
    >>> run.advance(9.75)
    >>> run.time, [(event.event, round(event.time, 9)) for event in run.events]
    (10.0, [('locks', 0.5)])
    >>> run.state = before
    >>> run.time
    0.25
    """
    check_scenario(scenario)
    with np.errstate(all="ignore"):  # invalid numbers are reported later
        return SteppedRun(begun(scenario, step=None, rtol=rtol))


class SteppedRun:
    """Interactive run, created by `begin`, which a caller advances step by step.

    Attributes
    ----------
    state
        Present state of the run, immutable. Assign an earlier state to return to it.
    """

    def __init__(self, state: EventRun) -> None:
        self.state = state

    @property
    def state(self) -> EventRun:
        """Present state of the run."""
        return self._state

    @state.setter
    def state(self, state: EventRun) -> None:
        if not isinstance(state, EventRun):
            raise CaseError("E730", f"state is {state!r}, expected the state of a run")
        self._state = state

    @property
    def time(self) -> float:
        """Present simulated time [s]."""
        return self.state.at.time

    @property
    def speeds(self) -> dict[str, float]:
        """Present speeds of links, by name [rad/s]."""
        speeds = self.state.at.speeds.tolist()
        return _SteppedSpeeds(zip(self.state.system.names, speeds, strict=True))

    @property
    def events(self) -> tuple[Event, ...]:
        """Events up to the present time."""
        return tuple(self.state.record.events)

    def advance(self, seconds: float, /, **settings: float) -> None:
        """Set numbers, let sequences act, and advance the run.

        Parameters
        ----------
        seconds : float
            Simulated time by which the run advances. [s]
        **settings : float
            New values of numbers that sequences set, and of control states, by name.

        Raises
        ------
        CaseError
            If a name is unknown, or the run cannot go on. The state of the run is then unchanged.
        """
        scenario = self.state.system.scenario
        if not (_is_number(seconds) and seconds > 0):
            raise CaseError("E675", f"advance by {seconds!s} s, expected a number above 0")
        known = scenario.value_names
        for name, value in settings.items():
            if name not in known:
                hint = nearest(name, known) or f", expected {listed(known) or 'no name'}"
                raise CaseError("E676", f"the scenario has no {quoted(name)} to set{hint}")
            if not _is_number(value):
                raise CaseError("E677", f"{name} is {value!s}, expected a number")
        for control in scenario.states:
            if control.name in settings and (beyond := control.beyond(settings[control.name])):
                raise CaseError("E684", f"{control.name}: {beyond}")
        state = self.state.copy()
        with np.errstate(all="ignore"):
            if settings:
                state.give(SequenceStep(), settings)
            state.run(self.time + seconds)
        self.state = state


class _SteppedSpeeds(dict[str, float]):
    """Speeds by link name; the error for an unknown name suggests similar names."""

    def __missing__(self, name: str) -> float:
        hint = nearest(name, self) or f", expected {listed(list(self))}"
        raise CaseError("E679", f"a run has no link {quoted(name)}{hint}")


def _is_number(value: object) -> bool:
    return isinstance(value, Real) and math.isfinite(value)
