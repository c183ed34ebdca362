"""Dynamic factors: largest torques of a run relative to static torques."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.statics.matrix import torque_ratio_of
from vstatics.core.statics.result_arrays import Message, first_rows, row_names
from vstatics.core.statics.solve import solve
from vstatics.simulation.record.converters import turbine
from vstatics.simulation.record.motion import Peak
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.tolerances import PRINTED


def static_torques(scenario: Scenario) -> dict[str, float]:
    """Return the magnitudes of the static torques of components, with losses [N*m].

    Parameters
    ----------
    scenario : Scenario
        Scenario with `static`, or the result is empty. Losses are calculated at the speed
        in the `load` of the gear, or else at the speed of the input at the start, if not 0.

    Raises
    ------
    CaseError
        If statics cannot calculate the gear.
    """
    if scenario.static is None:
        return {}
    case, torque = scenario.case, scenario.static.torque
    gear = case.gears[case.gear_number(scenario.static.gear) - 1]
    load = case.gear_load(gear)
    start = scenario.start.speeds.get(case.input, scenario.start.speed) / RAD_PER_RPM
    speed = (start or None) if load.speed is None else load.speed
    gear = gear._replace(load=load._replace(speed=speed, torque=torque, power=None))
    try:
        results = solve(replace(case, gears=[gear], coast=None))
    except CaseError as error:
        problems = [problem._replace(path=("static",), place=None) for problem in error.problems]
        raise CaseError(problems) from None
    rows = np.abs(results.lossy_torques[0] * torque).tolist()
    by_row = dict(zip(row_names(case, "torques"), rows, strict=True))
    parts = case.devices[len(case.shift_elements) :]
    torques = by_row | {parts[index]: rows[row] for index, row in first_rows(case).items()}
    for part in case.mechanisms:
        if part.can_be_open:
            pump, driven = (results.speeds[0, link - 1] for link in (part.first, part.second))
            torques[turbine(part.name)] = torques[part.name] * torque_ratio_of(part, driven / pump)
    return torques


def dynamic_factors(
    static: Mapping[str, float], peaks: Mapping[str, Peak]
) -> dict[str, float | None]:
    """Return the largest torques divided by the static torques, None for a static torque of 0.

    >>> dynamic_factors({"C": 50.0, "B": 0.0}, {"C": Peak(-91.5, 0.2), "B": Peak(3.0, 0.1)})
    {'C': 1.83, 'B': None}
    >>> dynamic_factors({}, {"C": Peak(-91.5, 0.2)})
    {}
    """
    least = PRINTED * max(static.values(), default=0.0)
    return {
        name: abs(peak.torque) / static[name] if static.get(name, 0.0) > least else None
        for name, peak in peaks.items()
        if static
    }


def missing_static_torques(static: Mapping[str, float]) -> list[Message]:
    """Return a warning if statics has no torques.

    >>> missing_static_torques({"C": 50.0})
    []
    """
    text = "statics has no torques for `static`, so there are no dynamic factors"
    return [Message("W605", text)] if np.isnan([*static.values()]).any() else []
