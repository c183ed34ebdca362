"""Ratios of mechanisms for wanted ratios of gears: least squares, and the case with them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import listed
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.transmission import HOUSING, Mechanism, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_same
from vstatics.core.tables.answer import told
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
"""So much ``|ln(i/target)|`` is met: half a per cent."""

_NONE: Mapping[str, float] = MappingProxyType({})
_NO_BOUNDS: Mapping[str, tuple[float, float]] = MappingProxyType({})


class FitSolution(NamedTuple):
    """Ratios of mechanisms, and what they give."""

    ratios: Mapping[str, float]
    """By mechanism [-]."""
    gears: Mapping[str, float]
    """The ratio of every gear of the case [-]; NaN where it has none."""
    residual: float
    """The largest ``|ln(i/target)|`` [-]."""
    unmet: Sequence[str]
    """Gears with more than the tolerance."""


@told(*FitSolution._fields, "solutions")
class Fit(NamedTuple):
    """The best solution, and all."""

    ratios: Mapping[str, float]
    gears: Mapping[str, float]
    residual: float
    unmet: Sequence[str]
    solutions: Sequence[FitSolution]
    """Minima of the sum of squares, the best first: where it meets all, those that do."""
    problem: FitProblem
    free: Sequence[str]
    """Mechanisms whose ratios the wanted ones do not determine, those among them that matter for
    none: they stay as near as may be to the case's own."""
    warnings: Sequence[str]
    """What else is to be known of it."""


@refusing()
def fit(  # noqa: PLR0913 - all but the first two by name
    case: Transmission,
    ratios: Mapping[str, float],
    *,
    bounds: Mapping[str, tuple[float, float]] = _NO_BOUNDS,
    weights: Mapping[str, float] = _NONE,
    tolerance: float = TOLERANCE,
    advance: Advance = untold,
) -> Fit:
    """Ratios of mechanisms with which gears have the ratios that are wanted.

    The sum of ``weight ln(i/target)^2`` is least. Where the teeth of a drawn element mesh with
    shared planets, its ratios are those between its central wheels, the carrier held.

    Parameters
    ----------
    case : Transmission
        What its mechanisms have does not matter, but for their signs and where there is a choice.
    ratios : mapping of str to float
        By the name of a gear, never by its number: what it should have. [-]
    bounds : mapping of str to (float, float)
        By mechanism, or `all`: least and largest ratio. Without, one keeps its sign, and its size
        is up to 14, where it has moving links on the same side of 1. [-]
    weights : mapping of str to float
        By the name of a gear; 1 when not given. [-]
    tolerance : float
        The largest ``|ln(i/target)|`` of a gear that is met. [-]
    advance : callable
        Called with how many steps more are done, from the first formula of a gear on.

    Returns
    -------
    Fit
        Ratios of the mechanisms [-], ratios of the gears with them [-], what is not met.

    Raises
    ------
    CaseError
        If no ratios can be looked for; the path of each problem begins with the argument.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = fit(case, {"1": 4.0})
    >>> round(found.ratios["D1"], 9), found.residual < 1e-12, found.unmet
    (-3.0, True, [])
    """
    problem = fit_problem(case, ratios, bounds, weights, tolerance, advance=advance)
    found, free = found_ratios(problem, advance)
    free = [*free, *problem.unused]
    minima = [_solution(problem, one) for one in found]
    best = minima[0]
    solutions = minima if best.unmet else [one for one in minima if not one.unmet]
    names = [mechanism.name for mechanism in problem.own.case.mechanisms]
    loose = [name for index, name in enumerate(names) if index in free]
    warnings = [
        *doubts(problem),
        *(_kept(problem) if best.unmet else ()),
        *_freewheels(case, problem, best),
    ]
    return Fit(*best, solutions, problem, loose, warnings)


def _solution(problem: FitProblem, ratios: Floats) -> FitSolution:
    """What ratios of all mechanisms give."""
    case = problem.own.case
    named = dict(zip((one.name for one in case.mechanisms), ratios.tolist(), strict=True))
    gears = dict(zip((gear.name for gear in case.gears), _gears(problem, ratios), strict=True))
    deviations = {
        case.gears[index].name: deviation(gears[case.gears[index].name], target)
        for index, target in problem.targets.items()
    }
    unmet = [name for name, one in deviations.items() if not one <= problem.tolerance]
    return FitSolution(named, gears, max(deviations.values()), unmet)


def deviation(ratio: float, target: float) -> float:
    """How far a ratio is from what is wanted: ``|ln(i/target)|`` [-].

    >>> round(deviation(4.04, 4.0), 6), deviation(-4.0, 4.0)
    (0.00995, inf)
    """
    quotient = ratio / target
    return abs(math.log(quotient)) if 0 < quotient < math.inf else math.inf


def _gears(problem: FitProblem, ratios: Floats) -> Iterator[float]:
    """The ratios of all gears of the case; by the solver where there is a formula too long."""
    formulas = problem.formulas
    if any(one.kind == "too long" for one in formulas):
        yield from solve(problem.own.case, ratios=ratios).ratio.tolist()
        return
    of_ratios = [index for index, one in enumerate(formulas) if one.kind == "ratio"]
    arrays = ratio_arrays([formulas[index] for index in of_ratios], len(ratios))
    found = dict(zip(of_ratios, arrays.ratios(ratios[np.newaxis])[0].tolist(), strict=True))
    for index, formula in enumerate(formulas):
        yield formula.constant if formula.kind == "constant" else found.get(index, math.nan)


def _kept(problem: FitProblem) -> Iterator[str]:
    """Mechanisms that keep a ratio of -1, which may be meant as a start only."""
    own = problem.own
    for index, mechanism in enumerate(own.case.mechanisms):
        if own.is_fixed(index) and mechanism.ratio == -1 and problem.bounds.is_fixed(index):
            hint = f"--bounds {mechanism.name}=-{LARGEST_SET_RATIO:g}:-1 lets it vary"
            yield f"{mechanism.name} keeps -1, as a symmetrical differential has it; {hint}"


def _freewheels(case: Transmission, problem: FitProblem, best: FitSolution) -> Iterator[str]:
    """Gears in which other freewheels hold with these ratios than with the case's own."""
    if not case.freewheels:
        return
    ratios = list(best.ratios.values())
    before = problem.own.case
    states = solve(on_own_links(case).case, ratios=ratios).with_freewheels_engaged
    for one, other in zip(before.gears, states.gears, strict=True):
        if set(one.engaged) != set(other.engaged):
            yield f"gear {one.name}: with these ratios other freewheels hold, so its own is another"


def fitted_case(case: Transmission, ratios: Mapping[str, float]) -> Transmission:
    """The case with other ratios of its mechanisms.

    A drawn element has teeth, and no other ratio: it becomes its mechanisms, without planets as
    links. The ratio of a planet is left out where that of its mechanism is another.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        By mechanism, as a `Fit` has them. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, name="set")], [Gear()])
    >>> fitted_case(case, {"set": -3.0}).mechanisms[0].ratio
    -3.0
    """
    plain = on_own_links(case).case
    mechanisms = [
        one
        if is_same(one.ratio, ratios[one.name])
        else one._replace(ratio=ratios[one.name], planet_ratio=None)
        for one in plain.mechanisms
    ]
    return plain.replace(mechanisms=mechanisms, description="", source="")


def lost_by_fit(case: Transmission) -> list[str]:
    """What a fitted case does not have of its case."""
    drawing = drawing_of(case)
    if drawing is None:
        return []
    masses = [element.name for element in drawing.elements if element.planet_masses]
    return [f"the masses of the planets of {name}" for name in masses]


def left_out_by_fit(case: Transmission, ratios: Mapping[str, float]) -> list[str]:
    """What a fitted case can't tell of planets, in words.

    A planet ratio follows from that of the mechanism in a plain set only. Nothing is lost where
    that was so before.

    Parameters
    ----------
    case : Transmission
    ratios : mapping of str to float
        By mechanism, as a `Fit` has them. [-]

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> meshed = Mechanism(1, 2, 3, 2.5, planet_ratio=-0.6, name="set")
    >>> case = Transmission(3, [], [meshed], [Gear()])
    >>> left_out_by_fit(case, {"set": 2.5}), left_out_by_fit(case, {"set": 2.7})
    ([], ['planet speeds of set: with these ratios no planet ratio is known'])
    """
    own = on_own_links(case)
    after = fitted_case(case, ratios).mechanisms
    unknown, plain = [], []
    for index, (old, new) in enumerate(zip(own.case.mechanisms, after, strict=True)):
        if new.third == HOUSING or own.is_fixed(index):
            continue
        if not _has_planet(new):
            if _has_planet(old) or case.drawing is not None:
                unknown.append(new.name)
        elif (
            old.planet_ratio is not None
            and new.planet_ratio is None
            and not is_same(old.planet_ratio, (old.ratio + 1) / 2)  # as it is in a plain set
        ):
            plain.append(new.name)
    found = []
    if unknown:
        reason = "with these ratios no planet ratio is known"
        found.append(f"planet speeds of {listed(unknown)}: {reason}")
    if plain:
        reason = "with these ratios planets turn as in plain sets"
        found.append(f"planet_ratio of {listed(plain)}: {reason}")
    return found


def _has_planet(mechanism: Mechanism) -> bool:
    """Whether there is a planet speed."""
    return mechanism.planet_ratio is not None or bool(mechanism.is_plain(mechanism.ratio))
