"""How much the ratio of each gear changes with the internal ratio of each mechanism."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.statics.results import Results
from vstatics.statics.solve import solve


def sensitivities(results: Results) -> Floats:
    """Relative sensitivities ``(u/i) di/du``: per cent of ratio per cent of internal ratio.

    They need no further solution. The torques of a gear, without losses and without
    further external torques, give ``(u/i) di/du = M (w_first - w_third)/(Mx w_output)``,
    which is the power that the first link brings in, seen from the third link, by that
    at the output. Given speeds, relative to the input speed, stay as they are. The results
    are of one case.

    Returns
    -------
    ndarray, shape (gears, mechanisms)
        NaN where the ratio, or the torque, is not determined. [-]

    Source
    ------
    docs/insight.md, from equation (4) of docs/method.md.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> sensitivities(solve(case)).round(4) + 0
    array([[0.7143],
           [0.    ]])
    """
    alone, case = results, results.case
    if case.unloaded or any(gear.torques for gear in case.gears):
        case = results.with_freewheels_engaged  # each freewheel stays as it is
        gears = [gear._replace(torques={}, load=None) for gear in case.gears]
        case = replace(case, gears=gears, load=None)
        alone = solve(case)
    outputs = np.array([case.gear_output(gear) for gear in case.gears])
    states = [alone.gear(number) for number in range(1, len(outputs) + 1)]
    speeds = np.array([state.speeds for state in states])
    torques = np.array([state.torques.on_first_link for state in states])
    output_power = torques[:, -1] * speeds[np.arange(len(outputs)), outputs - 1]
    motion = np.array([state.relative_speeds for state in states])
    with np.errstate(all="ignore"):
        relative = torques[:, case.among_devices] * motion / output_power[:, np.newaxis]
    # an idle one turns as one piece or carries nothing, which no internal ratio changes
    idle = np.array([state.search.idle for state in states], dtype=bool)
    idle &= np.isfinite(alone.ratio)[:, np.newaxis]
    relative = np.where(idle, 0.0, relative)
    return np.where(np.isfinite(relative), relative + 0.0, np.nan)
