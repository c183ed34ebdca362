"""Search for a quantity that is infinite or too large, after a run has stopped."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from vstatics.core.errors import Path, Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import Elastic
from vstatics.simulation.tolerances import LARGEST_NUMBER


def unbounded(equations: Equations, begin: float, time: float, state: Floats) -> Problem | None:
    """Return a problem for the first control, limit, rate or speed that is infinite or too large.

    Parameters
    ----------
    equations : Equations
    begin : float
        Time at which the run stopped. [s]
    time : float
        Slightly later time, to which the state is extrapolated linearly. [s]
    state : ndarray
    """
    moved = state + (time - begin) * equations.derivative(begin, state)
    state = moved if np.isfinite(moved).all() else state
    for what, value, path in _values(equations, time, equations.changes.seen_at(time, state)):
        if not abs(value) <= LARGEST_NUMBER:
            return Problem(
                "E700",
                f"at {time:.6g} s {what} is {value:g}, expected a number, "
                f"{LARGEST_NUMBER:g} at most",
                path,
            )
    return None


def _values(
    equations: Equations, time: float, seen: Sequence[float]
) -> Iterator[tuple[str, float, Path]]:
    system = equations.system
    for device in system.may_slip:
        look, key = device.programme.look, "limits" if isinstance(device, Elastic) else "controls"
        if look is not None:
            yield f"the {key[:-1]} of {device.name}", look.at(time, seen), (key, device.name)
    for state, rate in zip(system.scenario.states, equations.changes.rates, strict=True):
        yield f"the rate of {state.name}", rate.at(time, seen), ("states", state.name, "rate")
    for link, speed in system.scenario.speeds.items():
        name = system.case.link_name(link)
        yield f"the speed of {name}", speed.at(time), ("speeds", name)
