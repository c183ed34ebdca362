"""Sensitivity of each gear's ratio and efficiency to those of each mechanism.

Ratios are differentiated exactly by the adjoint of the speed equations, efficiencies by finite
differences.
"""

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
from vstatics.core.statics.matrix import always_coupled, speed_rows
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.statics.state import GearState
from vstatics.core.statics.torques import times


def sensitivities(results: Results) -> Floats:
    """Return relative sensitivities ``(u/i) di/du`` of gear ratios i to basic ratios u.

    For a variator or converter, u is the speed ratio. Prescribed speeds stay constant relative to
    the input, or to the link of `SpeedOf`. The results must belong to a single case.

    Returns
    -------
    ndarray, shape (gears, mechanisms)
        Sensitivities [-]; NaN if the ratio or the sensitivity is indeterminate.

    Source
    ------
    docs/summary.md, from the equations for speeds of docs/method.md.

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
    by_gear: Floats = np.array(of_gears).reshape(len(of_gears), len(results.case.mechanisms))
    return np.where(np.isfinite(by_gear), by_gear + 0.0, np.nan)


def _of_speeds(state: GearState) -> list[float]:
    """Return the sensitivities of a gear's ratio to all basic ratios [-].

    The speed equations are ``A w = b``. The solution v of ``A^T v = e_output`` is the change of the
    output speed per unit of each right-hand side. A change dA_k of row k causes ``dw_output = -v_k
    dA_k w``.
    """
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
        zip(always_coupled(case, state.gear), weights, strict=False)
    )  # mechanisms are first
    changes = []
    for place, (mechanism, u, motion) in enumerate(
        zip(case.mechanisms, state.ideal.variant.ratios, state.relative_speeds, strict=True),
        len(case.shift_elements),
    ):
        by_ratio = u * motion if mechanism.kind else -motion
        weight = by_device.get(place, 0.0)
        changes.append(float(plain(times(weight, by_ratio) * state.ratio)))
    return changes


EFFICIENCY_DIFFERENCE = 1e-3
"""Relative step of efficiencies in finite differences. [-]

With this step, finite differences of fourth order are accurate to about ten digits.
"""
NEARLY_LOSSLESS = 1 - 1e-13
"""Substitute for an efficiency of 1. [-]

Lossless variants have another structure, so they could not be calculated together with other
variants.
"""
BACKWARD = (25 / 12, -4.0, 3.0, -4 / 3, 1 / 4)
"""Weights of the values at 0, -1, -2, -3, -4 steps for the first derivative (Fornberg 1988)."""


def efficiency_sensitivities(results: Results) -> Floats:
    """Return relative sensitivities ``(n/ETA) dETA/dn`` to the efficiencies n of mechanisms.

    Backward differences are used, because efficiencies cannot exceed 1. Each gear has the values of
    its laws. The results must belong to a single case.

    Returns
    -------
    ndarray, shape (gears, mechanisms)
        Sensitivities [-]; NaN if a gear has no efficiency.

    Examples
    --------
    In a gear set with its ring held, ``-u n/(1 - u n)`` of the power is transmitted by the teeth.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
    >>> efficiency_sensitivities(solve(case)).round(9), round(2.4 / 3.4, 9)
    (array([[0.70588235]]), 0.705882353)
    """
    by_gear = _at_load(results)
    slopes = {
        mechanisms: _efficiency_slopes(results.case, mechanisms)
        for mechanisms in dict.fromkeys(by_gear)
    }
    of_gears = np.array([slopes[mechanisms][:, index] for index, mechanisms in enumerate(by_gear)])
    with np.errstate(all="ignore"):
        relative: Floats = of_gears / results.efficiency[:, np.newaxis]
    relative[np.abs(relative) < NO_SENSITIVITY] = 0.0
    return np.where(np.isfinite(relative), relative, np.nan)


def _at_load(results: Results) -> list[tuple[Mechanism, ...]]:
    """Return the mechanisms in each gear, with values instead of laws."""
    case, points = results.case, results.points

    def plain(given: Any, there: float) -> Any:
        return there if isinstance(given, Law) else given

    if points is None or not points.efficiencies:
        return [tuple(case.mechanisms)] * len(case.gears)
    return [
        tuple(
            mechanism._replace(
                efficiency=plain(mechanism.efficiency, there.forward),
                back_efficiency=plain(mechanism.back_efficiency, there.back),
            )
            for mechanism, there in zip(case.mechanisms, of_gear, strict=True)
        )
        for of_gear in points.efficiencies
    ]


def _efficiency_slopes(case: Transmission, mechanisms: tuple[Mechanism, ...]) -> Floats:
    """Return ``n dETA/dn`` of a case for the efficiencies n of mechanisms, (mechanisms, gears)."""
    given = np.minimum([mechanism.efficiency for mechanism in mechanisms], NEARLY_LOSSLESS)
    count, steps = len(given), len(BACKWARD)
    efficiencies = np.tile(given, (count, steps, 1))
    lower = 1 - EFFICIENCY_DIFFERENCE * np.arange(steps)
    efficiencies[range(count), :, range(count)] = given[:, np.newaxis] * lower
    efficiencies[[mechanism.kind == "converter" for mechanism in mechanisms]] = (
        given  # the loss of a converter follows from its points
    )
    totals = solve(case.with_numbers(mechanisms), efficiencies=efficiencies).efficiency
    return np.tensordot(totals, BACKWARD, axes=(1, 0)) / EFFICIENCY_DIFFERENCE
