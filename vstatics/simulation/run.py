"""Simulation of a scenario from start to end."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.errors import CaseError, Problem
from vstatics.core.statics.result_arrays import Message
from vstatics.simulation.bounds import Guard
from vstatics.simulation.course import EventRun
from vstatics.simulation.events.instants import start_instant
from vstatics.simulation.events.selection import NoChoice
from vstatics.simulation.events.springs_at_start import settled_twists, with_viscous_damping
from vstatics.simulation.events.start import (
    given_angles,
    start_gear,
    start_speeds,
    with_all_converters,
    with_fixed_ratios,
)
from vstatics.simulation.record.asked import rows_of_tables
from vstatics.simulation.record.dynamic_factors import (
    dynamic_factors,
    missing_static_torques,
    static_torques,
)
from vstatics.simulation.record.motion import Motion
from vstatics.simulation.record.record import Record
from vstatics.simulation.scenario.checks import check_scenario
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.scenario.programme import bare_capacities, cut_controls, programmes
from vstatics.simulation.system.devices import motion_system
from vstatics.simulation.tolerances import CLOSED_ENERGY, NO_ENERGY, RTOL

_END = ("duration",)
"""Key of a scenario at which an aborted run is reported if no other key is the cause."""

Method = Literal["events", "tarasik"]


@refusing()
def simulate(  # noqa: PLR0913 - all but the first by name
    scenario: Scenario,
    *,
    step: float | None = None,
    rtol: float = RTOL,
    method: Method = "events",
    watch: Guard | None = None,
    columns: Sequence[tuple[str, str]] = (),
) -> Motion:
    """Simulate the motion of a case under a scenario.

    Parameters
    ----------
    scenario : Scenario
    step : float, optional
        Spacing of additional instants of the motion. [s]
    rtol : float
        Tolerance of event times relative to the duration, and of speeds and energies relative to
        the largest speed and energy. [-]
    method : {"events", "tarasik"}
        `tarasik` is a published method for comparison; see `published.tarasik`.
    watch : callable, optional
        Function of the simulated time [s] that returns a reason to stop the run, or "".
    columns : sequence of (str, str)
        Table and row of each additional column in `asked`, such as ``("accelerations", "out")``;
        for the method `events` only.

    Returns
    -------
    Motion
        Results; `stopped` is the reason for an early end.

    Raises
    ------
    CaseError
        If the scenario cannot start, with paths in the scenario.

    Examples
    --------
    A brake stops a wheel of 2 kg*m^2:

    >>> from vstatics import ShiftElement, Transmission
    >>> from vstatics.simulation.scenario.laws import constant
    >>> from vstatics.simulation.scenario.parts import Capacity, Scenario, Start
    >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
    >>> scenario = Scenario(case, 3.0, Start(speeds={1: 10.0}), {1: Capacity(constant(40.0))})
    >>> motion = simulate(scenario)
    >>> [(event.element, event.event, round(event.time, 9)) for event in motion.events]
    [('B', 'locks', 0.5)]
    >>> round(motion.energy.heat["B"], 6)
    100.0
    """
    if step is not None and not 0 <= step < math.inf:
        raise ValueError(f"step is {step:g}, expected a number of seconds")
    check_scenario(scenario)
    static = static_torques(scenario)
    with np.errstate(all="ignore"):  # invalid numbers are reported later
        if method == "tarasik":
            from vstatics.simulation.published.tarasik import tarasik

            motion = tarasik(scenario, step=step, rtol=rtol)
        else:
            run = begun(scenario, step=step, rtol=rtol, watch=watch, columns=columns)
            motion = _to_its_end(run)
    factors = dynamic_factors(static, motion.peaks)
    messages = (*motion.messages, *missing_static_torques(static))
    return motion._replace(case=scenario.case, dynamic_factors=factors, messages=messages)


def begun(
    scenario: Scenario,
    *,
    step: float | None,
    rtol: float,
    watch: Guard | None = None,
    columns: Sequence[tuple[str, str]] = (),
) -> EventRun:
    """Prepare the start of a run by the method `events`; see `simulate`."""
    scenario = with_fixed_ratios(with_all_converters(scenario))
    asked = rows_of_tables(columns, scenario)
    gear = start_gear(scenario)
    engaged = (*scenario.start.engaged, *(gear.engaged if gear else ()))
    system = motion_system(scenario, programmes(scenario, engaged), gear)
    speeds = start_speeds(system, gear)
    system, messages = with_viscous_damping(system, speeds)
    angles, twists = given_angles(system)
    if scenario.start.settled:
        try:
            twists = settled_twists(system, speeds)
        except NoChoice:
            raise CaseError(
                "E626",
                "there is no steady state at t = 0: leave out `settled`",
                ("start", "settled"),
            ) from None
    record = Record(system, start_instant(system, speeds, twists, angles), step, asked)
    notes = (*bare_capacities(scenario.case), *cut_controls(scenario))
    record.messages += [*(Message(note.id, note.message) for note in notes), *messages]
    return EventRun(record, engaged, rtol, watch)


def _to_its_end(run: EventRun) -> Motion:
    """Run to the end, check that the energy balance closes, and return the motion."""
    record, watch = run.record, run.watch
    stopped, hurried = None, False
    try:
        run.run(run.duration)
    except CaseError as stop:
        [first, *_] = stop.problems
        hurried = bool(watch and watch(record.time))  # `watch` stopped the run
        stopped = first if first.path or hurried else first._replace(path=_END)
    if not record.pieces:
        assert stopped is not None  # noqa: S101 - a run without pieces was stopped
        raise CaseError([stopped])
    motion = record.motion(stopped, hurried=hurried)
    turnover, balance = record.turnover, abs(motion.energy.balance)
    if stopped or balance <= max(CLOSED_ENERGY * turnover, NO_ENERGY):
        return motion
    return motion._replace(
        stopped=Problem(
            "E627",
            f"the energy balance does not close: {balance:.3g} J of {turnover:.3g} J are left; "
            "use a smaller --rtol",
            _END,
        )
    )
