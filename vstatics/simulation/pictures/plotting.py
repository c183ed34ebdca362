"""Pictures of a run for Python users."""

from __future__ import annotations

from typing import Any

from vstatics.core.model.laws import with_load
from vstatics.core.model.parts import NOMINAL_LOAD
from vstatics.core.statics.solve import solve
from vstatics.pictures import kinds_of_runs
from vstatics.pictures.plotting import Picture, plot
from vstatics.simulation.record.motion import Motion


def plot_motion(motion: Motion, kind: str = "shift", **how: Any) -> Picture:
    """Draw a picture of a run; see `plot` for further parameters and errors.

    Raises
    ------
    ValueError
        If `kind` is not a picture of a run, or if the motion has no case.

    Examples
    --------
    >>> from vstatics import ShiftElement, Transmission
    >>> from vstatics.simulation import Scenario, Start, simulate
    >>> case = Transmission(1, [ShiftElement(1)], [], [], inertias={1: 2.0})
    >>> plot_motion(simulate(Scenario(case, 1.0, Start(speeds={1: 10.0}))), "stick")
    Traceback (most recent call last):
    ValueError: 'stick' is not a picture of a run; expected one of shift, plan
    """
    if kind not in (kinds := kinds_of_runs()):
        expected = f"expected one of {', '.join(kinds)}"
        raise ValueError(f"{kind!r} is not a picture of a run; {expected}")
    if motion.case is None:
        raise ValueError("the motion has no case; expected one of `simulate`")
    return plot(solve(with_load(motion.case, NOMINAL_LOAD)), kind, motion=motion, **how)
