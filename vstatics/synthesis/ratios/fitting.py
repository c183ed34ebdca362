"""Fit of mechanism ratios to wanted gear ratios by least squares, and the case with the result."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import listed
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import HOUSING, Mechanism, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_same
from vstatics.core.tables.answer import json_keys
from vstatics.synthesis.ratios.arrays import ratio_arrays
from vstatics.synthesis.ratios.problem import (
    LARGEST_SET_RATIO,
    Advance,
    FitProblem,
    doubts,
    fit_problem,
    untold,
)
from vstatics.synthesis.ratios.search import found_ratios

TOLERANCE = 0.005
"""Default largest deviation ``|ln(i/target)|`` of a ratio that counts as met, 0.5 %. [-]"""


class FitSolution(NamedTuple):
    """Ratios of mechanisms and the resulting gear ratios."""

    ratios: Mapping[str, float]
    """Ratio of each mechanism, by name. [-]"""
    gears: Mapping[str, float]
    """Ratio of every gear of the case, by name; NaN for a gear without a ratio. [-]"""
    residual: float
    """Largest deviation ``|ln(i/target)|``. [-]"""
    unmet: Sequence[str]
    """Names of gears with a deviation above the tolerance."""


@json_keys(*FitSolution._fields, "solutions")
class Fit(NamedTuple):
    """Result of a fit: the best solution, and all solutions."""

    ratios: Mapping[str, float]
    gears: Mapping[str, float]
    residual: float
    unmet: Sequence[str]
    solutions: Sequence[FitSolution]
    """Minima of the sum of squares, the best first. If the best meets all ratios, only solutions
    that meet all ratios are listed.
    """
    problem: FitProblem
    free: Sequence[str]
    """Names of mechanisms whose ratios the wanted ratios do not determine.

    The ratios of these mechanisms stay as near as possible to those in the case.
    """
    warnings: Sequence[str]
    """Further remarks on the result."""


@refusing()
def fit(  # noqa: PLR0913 - all but the first two by name
    case: Transmission,
    ratios: Mapping[str, float],
    *,
    bounds: Mapping[str, tuple[float, float]] = EMPTY,
    weights: Mapping[str, float] = EMPTY,
    tolerance: float = TOLERANCE,
    advance: Advance = untold,
) -> Fit:
    """Find ratios of mechanisms with which gears have wanted ratios.

    The fit minimises the sum of ``weight ln(i/target)^2``. A gear set with shared planets has the
    ratios between its central gears, carrier held.

    Parameters
    ----------
    case : Transmission
        Gearbox; its present ratios only determine the signs, and ratios that the targets do not.
    ratios : mapping of str to float
        Wanted ratio by the name of a gear, never by its number. [-]
    bounds : mapping of str to (float, float)
        Smallest and largest ratio by the name of a mechanism, or for `all`. By default a ratio
        keeps its sign, and has a magnitude up to 14, or twice the present magnitude if that is
        more; between moving links it stays on the same side of 1. [-]
    weights : mapping of str to float
        Weight by the name of a gear, by default 1. [-]
    tolerance : float
        Largest ``|ln(i/target)|`` of a gear that counts as met. [-]
    advance : callable
        Function that is called with the number of further finished steps.

    Returns
    -------
    Fit
        Ratios of the mechanisms [-], resulting ratios of the gears [-], unmet gears.

    Raises
    ------
    CaseError
        If the problem cannot be solved; the path of each problem begins with the argument.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = fit(case, {"1": 4.0})
    >>> round(found.ratios["D1"], 9), found.residual < 1e-12, found.unmet
    (-3.0, True, [])
    """
    problem = fit_problem(case, ratios, bounds, weights, tolerance, advance=advance)
    solutions, free = found_ratios(problem, advance)
    free = [*free, *problem.unused]
    minima = [_solution(problem, solution) for solution in solutions]
    best = minima[0]
    complete = minima if best.unmet else [minimum for minimum in minima if not minimum.unmet]
    names = [mechanism.name for mechanism in problem.links.case.mechanisms]
    loose = [name for index, name in enumerate(names) if index in free]
    warnings = [
        *doubts(problem),
        *(_kept(problem) if best.unmet else ()),
        *_freewheels(case, problem, best),
    ]
    return Fit(*best, complete, problem, loose, warnings)


def _solution(problem: FitProblem, ratios: Floats) -> FitSolution:
    case = problem.links.case
    named = dict(zip((part.name for part in case.mechanisms), ratios.tolist(), strict=True))
    gears = dict(zip((gear.name for gear in case.gears), _gears(problem, ratios), strict=True))
    deviations = {
        case.gears[index].name: deviation(gears[case.gears[index].name], target)
        for index, target in problem.targets.items()
    }
    unmet = [name for name, size in deviations.items() if not size <= problem.tolerance]
    return FitSolution(named, gears, max(deviations.values()), unmet)


def deviation(ratio: float, target: float) -> float:
    """Return the deviation ``|ln(i/target)|`` of a ratio [-]; infinite for the wrong sign.

    >>> round(deviation(4.04, 4.0), 6), deviation(-4.0, 4.0)
    (0.00995, inf)
    """
    quotient = ratio / target
    return abs(math.log(quotient)) if 0 < quotient < math.inf else math.inf


def _gears(problem: FitProblem, ratios: Floats) -> Iterator[float]:
    """Yield the ratios of all gears of the case, from the solver if a formula is too long."""
    formulas = problem.formulas
    if any(formula.kind == "too long" for formula in formulas):
        yield from solve(problem.links.case, ratios=ratios).ratio.tolist()
        return
    of_ratios = [index for index, formula in enumerate(formulas) if formula.kind == "ratio"]
    arrays = ratio_arrays([formulas[index] for index in of_ratios], len(ratios))
    fitted = dict(zip(of_ratios, arrays.ratios(ratios[np.newaxis])[0].tolist(), strict=True))
    for index, formula in enumerate(formulas):
        yield formula.constant if formula.kind == "constant" else fitted.get(index, math.nan)


def _kept(problem: FitProblem) -> Iterator[str]:
    """Yield remarks on mechanisms that keep the ratio -1, which is perhaps a placeholder."""
    links = problem.links
    for index, mechanism in enumerate(links.case.mechanisms):
        if links.is_fixed(index) and mechanism.ratio == -1 and problem.bounds.is_fixed(index):
            hint = f"--bounds {mechanism.name}=-{LARGEST_SET_RATIO:g}:-1 lets it vary"
            yield f"{mechanism.name} keeps -1, as a symmetrical differential has it; {hint}"


def _freewheels(case: Transmission, problem: FitProblem, best: FitSolution) -> Iterator[str]:
    """Yield remarks on gears in which the new ratios change the holding freewheels."""
    if not case.freewheels:
        return
    ratios = list(best.ratios.values())
    before = problem.links.case
    states = solve(on_own_links(case).case, ratios=ratios).with_freewheels_engaged
    for old, new in zip(before.gears, states.gears, strict=True):
        if set(old.engaged) != set(new.engaged):
            yield f"gear {old.name}: with these ratios other freewheels hold, so its own is another"


def fitted_case(case: Transmission, ratios: Mapping[str, float]) -> Transmission:
    """Return the case with new ratios of the mechanisms.

    A gear set under `elements` is defined by teeth, so it is replaced by its mechanisms, without
    planets as links. The planet ratio is left out where the mechanism ratio changes.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        Ratio of each mechanism, by name, as in a `Fit`. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, name="set")], [Gear()])
    >>> fitted_case(case, {"set": -3.0}).mechanisms[0].ratio
    -3.0
    """
    plain = on_own_links(case).case
    mechanisms = [
        part
        if part.kind or is_same(part.ratio, ratios[part.name])
        else part._replace(ratio=ratios[part.name], planet_ratio=None)
        for part in plain.mechanisms
    ]
    return plain.replace(mechanisms=mechanisms, description="", source="")


def lost_by_fit(case: Transmission) -> list[str]:
    """Return the data of a case that a case with fitted ratios lacks, in words."""
    drawing = drawing_of(case)
    if drawing is None:
        return []
    masses = [element.name for element in drawing.elements if element.planet_masses]
    return [f"the masses of the planets of {name}" for name in masses]


def left_out_by_fit(case: Transmission, ratios: Mapping[str, float]) -> list[str]:
    """Return the data on planets that a case with fitted ratios cannot contain, in words.

    Only in a simple planetary gear set does the planet ratio follow from the mechanism ratio.
    Planet ratios that follow from it already are not listed.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        Ratio of each mechanism, by name, as in a `Fit`. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> meshed = Mechanism(1, 2, 3, 2.5, planet_ratio=-0.6, name="set")
    >>> case = Transmission(3, [], [meshed], [Gear()])
    >>> left_out_by_fit(case, {"set": 2.5}), left_out_by_fit(case, {"set": 2.7})
    ([], ['planet speeds of set: with these ratios no planet ratio is known'])
    """
    plain_case = on_own_links(case)
    after = fitted_case(case, ratios).mechanisms
    unknown, plain = [], []
    for index, (old, new) in enumerate(zip(plain_case.case.mechanisms, after, strict=True)):
        if new.third == HOUSING or plain_case.is_fixed(index):
            continue
        if not _has_planet(new):
            if _has_planet(old) or case.drawing is not None:
                unknown.append(new.name)
        elif (
            old.planet_ratio is not None
            and new.planet_ratio is None
            # Planet ratio of a simple planetary gear set.
            and not is_same(old.planet_ratio, (old.ratio + 1) / 2)
        ):
            plain.append(new.name)
    lost = []
    if unknown:
        reason = "with these ratios no planet ratio is known"
        lost.append(f"planet speeds of {listed(unknown)}: {reason}")
    if plain:
        reason = "with these ratios planets turn as in plain sets"
        lost.append(f"planet_ratio of {listed(plain)}: {reason}")
    return lost


def _has_planet(mechanism: Mechanism) -> bool:
    return mechanism.planet_ratio is not None or bool(mechanism.is_plain(mechanism.ratio))
