"""Calculation of the results of a transmission or its variants from checked arguments."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.transmission import IdleConvention, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics import diagnosis
from vstatics.core.statics.matrix import EXPECTED, Quantity, by_mechanism, impossible
from vstatics.core.statics.results import Results
from vstatics.core.statics.variants import solve_one, solve_variants


def solution(  # noqa: PLR0913
    case: Transmission,
    *,
    ratios: ArrayLike | None = None,
    efficiencies: ArrayLike | None = None,
    coast: bool | None = None,
    idle: IdleConvention | None = None,
    vary: Mapping[str, ArrayLike] | None = None,
    explain: bool = True,
) -> Results:
    """Return the results of `solve` without checking the types of the arguments.

    If `explain` is False, the messages about the gears are left to `explained`.
    """
    if case.depends:
        from vstatics.core.model.laws import (
            of_sought_ratios,
            with_varied_load,
            without_loads,
        )  # the import costs start-up time

        case = with_varied_load(case, vary or ())
        if problems := [*without_loads(case), *of_sought_ratios(case)]:
            raise CaseError(problems)
    case = case.with_coast(coast)
    if idle not in (None, case.idle):
        case = replace(case, idle=idle)
    if vary is not None:
        from vstatics.core.statics.points import solve_varied  # the import costs start-up time

        if ratios is not None or efficiencies is not None:
            raise ValueError("solve: expected `vary`, or `ratios` and `efficiencies`, not both")
        return solve_varied(case, vary)
    axes, u, eta = _variants(case, ratios, efficiencies)
    if axes == () and (u is not None or eta is not None):
        case = _with_numbers(case, u, eta)
        u = eta = None
    if case.depends:
        from vstatics.core.statics.points import solve_laws  # the import costs start-up time

        return solve_laws(case, axes, u, eta)
    with np.errstate(all="ignore"):
        if axes == ():
            results = Results(case=case, **solve_one(case))
            return explained(results) if explain else results
        arrays = solve_variants(case, u, eta, math.prod(axes))
    shaped = {name: array.reshape(*axes, *array.shape[1:]) for name, array in arrays.items()}
    return Results(case=case, **shaped)


def explained(results: Results) -> Results:
    """Return the results of a case with messages about the gears.

    Results at several operating points are returned unchanged, as their messages are complete.
    """
    if results.points is not None:
        return results
    return results._replace(messages=tuple(diagnosis.messages(results, results.case)))


def _with_numbers(case: Transmission, u: Floats | None, eta: Floats | None) -> Transmission:
    mechanisms = list(case.mechanisms)
    for quantity, given in (("ratio", u), ("efficiency", eta)):
        if given is not None:
            mechanisms = [
                mechanism._replace(**{quantity: number})
                for mechanism, number in zip(mechanisms, given[0].tolist(), strict=True)
            ]
    return case.with_numbers(mechanisms)


def _variants(
    case: Transmission, ratios: ArrayLike | None, efficiencies: ArrayLike | None
) -> tuple[tuple[int, ...], Floats | None, Floats | None]:
    """Return the shape of the variants, the ratios and the efficiencies.

    Ratios and efficiencies have the shape (variants, mechanisms), with a single axis of variants.
    """
    if ratios is None and efficiencies is None:
        return (), None, None
    count = len(case.mechanisms)
    given = {
        name: None if numbers is None else by_mechanism(name, numbers, count)
        for name, numbers in (("ratios", ratios), ("efficiencies", efficiencies))
    }
    axes = np.broadcast_shapes(*(array.shape[:-1] for array in given.values() if array is not None))
    problems = [
        *_wrong(case, "ratio", given["ratios"]),
        *_wrong(case, "efficiency", given["efficiencies"]),
    ]
    if problems:
        raise CaseError(problems)
    u, eta = (
        None
        if array is None
        else np.broadcast_to(array, (*axes, count)).reshape(math.prod(axes), count)
        for array in given.values()
    )
    return axes, u, eta


def _wrong(case: Transmission, quantity: Quantity, given: Floats | None) -> list[Problem]:
    """Return a problem for the first invalid number in an array ``(..., mechanisms)``."""
    for number in range(len(case.mechanisms) if given is not None else 0):
        column = np.asarray(given)[..., number]
        default = float(getattr(case.mechanisms[number], quantity))
        wrong = impossible(quantity, column)
        if wrong.any():  # numbers of the case itself are already checked
            wrong &= ~np.isclose(column, default, 0, 0, equal_nan=True)
        if wrong.any():
            variant = tuple(int(index) for index in np.argwhere(wrong)[0])
            where = f" in variant {', '.join(map(str, variant))}" if variant else ""
            message = f"read {column[variant]:g}{where}, expected {EXPECTED[quantity]}"
            return [Problem("E415", message, ("mechanisms", number + 1, quantity))]
    return []
