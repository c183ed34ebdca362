"""Case in a driving cycle: clutches replace freewheels, and the wheels can drive."""

from __future__ import annotations

import math

import numpy as np

from vstatics.core.model.parts import Law, Load, OfLoad
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve


def with_clutches(
    case: Transmission, results: Results
) -> tuple[Transmission, dict[int, list[int]]]:
    """Return a case in which clutches replace freewheels that hold only when driving.

    The second result contains the numbers of these freewheels that hold in a gear, by the index of
    the gear.

    Parameters
    ----------
    results : Results
        Results of the driving case without drag.
    """
    if not case.freewheels:
        return case, {}
    coasting = solve(results.case.replace(load=Load(1000.0, -1.0))).holds
    numbers = [
        n for n in case.freewheels if results.holds[:, n - 1].any() and not coasting[:, n - 1].any()
    ]
    elements, gears = list(case.shift_elements), list(case.gears)
    for number in numbers:
        elements[number - 1] = elements[number - 1]._replace(kind="")
    opening = {}
    for index, gear in enumerate(gears):
        if held := [number for number in numbers if results.holds[index, number - 1]]:
            opening[index] = held
            gears[index] = gear._replace(engaged=(*gear.engaged, *held))
    return case.replace(shift_elements=elements, gears=gears), opening


def ends_of(case: Transmission) -> tuple[Integers, Integers]:
    """Return the input link and the output link of each gear, each of shape (gears,)."""
    ends = [(case.gear_input(gear), case.gear_output(gear)) for gear in case.gears]
    inputs, outputs = np.array(ends).T
    return inputs, outputs


def turned(case: Transmission, ratios: Floats) -> Transmission:
    """Return a case with output and input exchanged, without losses of gears as a whole.

    `ratios` are link speeds divided by output speed, shape (gears, links) [-].
    """
    gears = []
    for gear, by_output in zip(case.gears, ratios, strict=True):
        ends = case.gear_input(gear), case.gear_output(gear)
        ratio = float(by_output[ends[0] - 1] / by_output[ends[1] - 1])
        driven = not math.isnan(ratio)  # a gear without a ratio drives nothing
        slip = {
            n: slip if isinstance(slip, OfLoad) else slip * ratio if slip and driven else 0.0
            for n, slip in gear.slip.items()
        }
        gears.append(gear._replace(input=ends[1], output=ends[0], loss=None, slip=slip))
    return case.replace(gears=gears, outputs=())


def relative_drag(case: Transmission) -> dict[str, float]:
    """Return drag torques without unit, which are relative to the input torque, by path [-]."""
    links = [case.link_name(number + 1) for number in range(case.links)]
    names = {"drag": links, "open_drag": [element.name for element in case.shift_elements]}
    return {
        f"gears.{gear.name}.{quantity}.{of_part[part - 1]}": drag
        for gear in case.gears_with_drag
        for quantity, of_part in names.items()
        for part, drag in getattr(gear, quantity).items()
        if drag and not isinstance(drag, Law | OfLoad)
    }
