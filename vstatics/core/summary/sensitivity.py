"""How much ratio and efficiency of each gear change with those of each mechanism."""

from __future__ import annotations

from typing import Any

import numpy as np

from vstatics.core.model.parts import Law, Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics import elimination
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.elimination import RIGHT, Coefficient
from vstatics.core.numerics.tolerances import NO_SENSITIVITY
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import always_loaded, speed_rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import times


def sensitivities(results: Results) -> Floats:
    """Relative sensitivities ``(u/i) di/du``: per cent of ratio per cent of internal ratio.

    Of a variator or converter u is its speed ratio x. Given speeds stay as they are, relative
    to the input or to the link that they follow; torques take no part. The results are of one
    case.

    Returns
    -------
    ndarray, shape (gears, mechanisms)
        NaN where the ratio, or the sensitivity, is not determined. [-]

    Source
    ------
    docs/insight.md, from the equations for speeds of docs/method.md.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> sensitivities(solve(case)).round(4) + 0
    array([[0.7143],
           [0.    ]])
    """
    with np.errstate(all="ignore"):
        of_gears = [_of_speeds(results.gear_at(index)) for index in range(len(results.case.gears))]
    found: Floats = np.array(of_gears).reshape(len(of_gears), len(results.case.mechanisms))
    return np.where(np.isfinite(found), found + 0.0, np.nan)


def _of_speeds(state: GearState) -> list[float]:
    """Of a gear, by how much each equation for its speeds moves the output."""
    case, output = state.case, state.case.gear_output(state.gear)
    by_link: list[dict[int, Coefficient]] = [{} for _ in range(case.links)]
    equations = speed_rows(case, state.gear, state.ideal.variant.rows)
    for number, equation in enumerate(equations):
        for place, part in equation.items():
            if place != RIGHT:
                by_link[place][number] = part
    by_link[output - 1][RIGHT] = 1.0
    weights = elimination.solve(by_link, len(equations)).values
    by_device = dict(
        zip(always_loaded(case, state.gear), weights, strict=False)
    )  # they stand first
    found = []
    for place, (one, u, motion) in enumerate(
        zip(case.mechanisms, state.ideal.variant.ratios, state.relative_speeds, strict=True),
        len(case.shift_elements),
    ):
        by_ratio = u * motion if one.kind else -motion
        weight = by_device.get(place, 0.0)
        found.append(float(plain(times(weight, by_ratio) * state.ratio)))
    return found


EFFICIENCY_DIFFERENCE = 1e-3
"""Of an efficiency, as a part of it: differences of fourth order then have ten digits."""
NEARLY_LOSSLESS = 1 - 1e-13
"""In place of 1, which is a special case: variants with it, each of a structure of its own, would
be calculated one by one."""
BACKWARD = (25 / 12, -4.0, 3.0, -4 / 3, 1 / 4)
"""The first derivative by numbers at 0, -1, -2, -3, -4 differences (Fornberg 1988, table 3)."""


def efficiency_sensitivities(results: Results) -> Floats:
    """By how many per cent the efficiency of a gear changes by one per cent of a mechanism's.

    Differences to lower efficiencies, as none is above 1. Laws count as the numbers that they
    come to in each gear. The results are of one case.

    Returns
    -------
    ndarray, shape (gears, mechanisms)
        ``(n/ETA) dETA/dn``; NaN where a gear has no efficiency. [-]

    Examples
    --------
    In a set whose ring is held the part ``-u n/(1 - u n)`` of the power goes through the teeth.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
    >>> efficiency_sensitivities(solve(case)).round(9), round(2.4 / 3.4, 9)
    (array([[0.70588235]]), 0.705882353)
    """
    by_gear = _at_load(results)
    slopes = {own: _efficiency_slopes(results.case, own) for own in dict.fromkeys(by_gear)}
    of_gears = np.array([slopes[own][:, index] for index, own in enumerate(by_gear)])
    with np.errstate(all="ignore"):
        relative: Floats = of_gears / results.efficiency[:, np.newaxis]
    relative[np.abs(relative) < NO_SENSITIVITY] = 0.0
    return np.where(np.isfinite(relative), relative, np.nan)


def _at_load(results: Results) -> list[tuple[Mechanism, ...]]:
    """The mechanisms as they are in each gear, with numbers in place of laws."""
    case, points = results.case, results.points

    def plain(own: Any, there: float) -> Any:
        return there if isinstance(own, Law) else own

    if points is None or not points.efficiencies:
        return [tuple(case.mechanisms)] * len(case.gears)
    return [
        tuple(
            one._replace(
                efficiency=plain(one.efficiency, there.forward),
                back_efficiency=plain(one.back_efficiency, there.back),
            )
            for one, there in zip(case.mechanisms, of_gear, strict=True)
        )
        for of_gear in points.efficiencies
    ]


def _efficiency_slopes(case: Transmission, mechanisms: tuple[Mechanism, ...]) -> Floats:
    """``n dETA/dn`` of other mechanisms in a case, (mechanisms, gears)."""
    own = np.minimum([one.efficiency for one in mechanisms], NEARLY_LOSSLESS)
    count, steps = len(own), len(BACKWARD)
    efficiencies = np.tile(own, (count, steps, 1))
    lower = 1 - EFFICIENCY_DIFFERENCE * np.arange(steps)
    efficiencies[range(count), :, range(count)] = own[:, np.newaxis] * lower
    efficiencies[[one.kind == "converter" for one in mechanisms]] = own  # loses by its points
    found = solve(case.with_numbers(mechanisms), efficiencies=efficiencies).efficiency
    return np.tensordot(found, BACKWARD, axes=(1, 0)) / EFFICIENCY_DIFFERENCE
