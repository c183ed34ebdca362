"""Gears in which all is determined and agrees, so that little can be said of them."""

from __future__ import annotations

import math
from collections.abc import Iterator

from vstatics.model.transmission import Gear
from vstatics.numerics.tolerances import UNCERTAIN
from vstatics.statics.results import Results

USUAL = {
    "tied_up": False,
    "conflict": False,
    "missing": 0,
    "excess": 0,
    "balanced": True,
    "consistent": True,
    "locked": False,
    "undecided": False,
    "choices": 1,
}
"""What the arrays say of such a gear."""


def usual_gears(results: Results) -> Iterator[bool]:
    """By gear of one case: whether speeds and torques exist, agree, and are the only ones.

    >>> from vstatics import Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)],
    ...                     [Gear([1]), Gear([], name="N")])
    >>> list(usual_gears(solve(case)))
    [True, False]
    """
    case, usual = results.case, tuple(USUAL.values())
    marks = zip(*(getattr(results, name).tolist() for name in USUAL), strict=True)
    turned, speeds = results.turned.tolist(), results.speeds.tolist()
    torques, of_meshes = results.torques.tolist(), results.mesh_torques.tolist()
    for number, (gear, own) in enumerate(zip(case.gears, marks, strict=True)):
        speed, torque = speeds[number][case.gear_output(gear) - 1], torques[number][-1]
        yield (
            own == usual
            and True not in turned[number]
            and not math.isnan(sum(torques[number]) + sum(of_meshes[number]))
            and speed != 0
            and not is_uncertain(gear, speed, torque)
        )


def is_uncertain(gear: Gear, output_speed: float, output_torque: float) -> bool:
    """Whether speeds and torques, which check one another by ``Mx * w_output = 1``, do not."""
    if gear.speeds or gear.torques:
        return False
    return abs(output_torque * output_speed - 1) > UNCERTAIN
