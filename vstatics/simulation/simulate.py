"""Simulate a scenario."""

from __future__ import annotations

import math

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.simulation.course import Course, Stop
from vstatics.simulation.motion import Energy, Motion
from vstatics.simulation.ports import Layout
from vstatics.simulation.programme import programmes
from vstatics.simulation.record import Record
from vstatics.simulation.scenario import Scenario
from vstatics.simulation.selection import Instant
from vstatics.simulation.start import start_gear, start_speeds
from vstatics.simulation.system import motion_system

BALANCE = 1e-8
"""A run closes that leaves no more than this part of the largest energy."""


def simulate(scenario: Scenario, *, step: float | None = None, rtol: float = 1e-8) -> Motion:
    """The motion of a case by a scenario.

    Parameters
    ----------
    scenario : Scenario
    step : float, optional
        Its multiples are instants of the motion too. [s]
    rtol : float
        Accuracy of event times by the duration, of speeds and energies by their largest. [-]

    Returns
    -------
    Motion
        With `stopped` where the run had to stop before its end.

    Raises
    ------
    CaseError
        Of what can't begin, with paths in the scenario.

    Examples
    --------
    A brake stops a wheel of 2 kg*m^2:

    >>> from vstatics import ShiftElement, Transmission
    >>> from vstatics.simulation.laws import constant
    >>> from vstatics.simulation.scenario import Capacity, Scenario, Start
    >>> case = Transmission(1, [ShiftElement(1, name="B")], [], [], inertias={1: 2.0})
    >>> scenario = Scenario(case, 3.0, Start(speeds={1: 10.0}), {1: Capacity(constant(40.0))})
    >>> motion = simulate(scenario)
    >>> [(event.element, event.event, round(event.time, 9)) for event in motion.events]
    [('B', 'locks', 0.5)]
    >>> round(motion.energy.heat["B"], 6)
    100.0
    """
    gear = start_gear(scenario)
    engaged = (*scenario.start.engaged, *(gear.engaged if gear else ()))
    system = motion_system(scenario, programmes(scenario, engaged), gear)
    layout = Layout(system)
    speeds = start_speeds(system, gear)
    size = layout.ports + 2 * len(system.springs) + len(system.meshes)
    twists = np.zeros(len(system.springs))
    start = Instant(0.0, speeds, twists, np.zeros(len(layout.angles)), np.zeros(size))
    record = Record(system, start, step)
    stopped: Problem | None = None
    try:
        with np.errstate(all="ignore"):
            Course(system, record, rtol).run(start)
    except Stop as stop:
        stopped = stop.problem
    if not record.kept:
        assert stopped is not None  # noqa: S101 - it can't end without a start
        raise CaseError([stopped])
    motion = record.motion(stopped)
    return motion if stopped else _closed(motion)


def _closed(motion: Motion) -> Motion:
    """The motion, marked where its energy does not close."""
    energy = motion.energy
    largest = _largest(energy)
    if abs(energy.balance) <= BALANCE * largest or largest == 0:
        return motion
    message = (
        f"the energy does not close: {energy.balance:.3g} J are left of {largest:.3g} J; a smaller "
        "--rtol may help"
    )
    return motion._replace(stopped=Problem(message))


def _largest(energy: Energy) -> float:
    """The largest of work, heat and changes of energies [J]."""
    heat = math.fsum(energy.heat.values())
    return max(abs(energy.work), heat, abs(energy.kinetic), abs(energy.elastic), energy.impact)
