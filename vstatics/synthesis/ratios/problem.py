"""What is asked of a fit, checked before anything is calculated at length."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import (
    CaseError,
    Problem,
    listed,
    nearest,
    plural,
    quoted,
    spoken,
    typed_number,
)
from vstatics.core.explain.bodies import OwnLinks, on_own_links
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.solve import solve
from vstatics.core.statics.status import STATUSES
from vstatics.core.summary.design_table import is_same
from vstatics.synthesis.ratios.arrays import reach
from vstatics.synthesis.ratios.formula import GearFormula, gear_formula
from vstatics.synthesis.tolerances import PART_FOR_ZERO_BOUND

LARGEST_SET_RATIO = 14.0
"""The ratio of a planetary set with three planets is below 13.93, as they must not touch."""
SMALLEST, LARGEST = 1e-9, 1e9
"""No bound is smaller or larger: products of ratios are to be numbers."""
ALL = "all"
"""Stands for all mechanisms that are not named themselves."""


class Bounds(NamedTuple):
    """Least and largest ratio of each mechanism [-]."""

    low: Sequence[float]
    high: Sequence[float]

    def is_fixed(self, index: int) -> bool:
        """Whether a ratio is given."""
        return self.low[index] == self.high[index]


def bounds_of(own: OwnLinks, given: Mapping[str, tuple[float, float]]) -> Bounds:
    """The bounds of all mechanisms: as they are given, else as suit the case.

    Parameters
    ----------
    own : OwnLinks
    given : mapping of str to (float, float)
        By the name of a mechanism; `all` for those that are not named. [-]

    Raises
    ------
    CaseError
        If there is no such mechanism, or no ratio is within the bounds.

    Examples
    --------
    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> mechanisms = [Mechanism(1, 2, 3, -2.5), Mechanism(1, 2, 0, 0.8)]
    >>> own = on_own_links(Transmission(3, [], mechanisms, [Gear()]))
    >>> bounds_of(own, {})
    Bounds(low=(-14.0, 0.07142857142857142), high=(-1.0, 14.0))
    >>> bounds_of(own, {"D1": (-4, -1.5)}).low
    (-4.0, 0.07142857142857142)
    """
    names = [mechanism.name for mechanism in own.case.mechanisms]
    problems: list[Problem] = []
    found = [usual(own, index) for index in range(len(names))]
    by_index: dict[int, tuple[float, float]] = {}
    for name, pair in given.items():
        path = ("bounds", name)
        problems += (Problem("E819", f"{name}: {text}", path) for text in _wrong(*pair))
        try:
            index = None if name == ALL and ALL not in names else mechanism_index(own, name)
        except ValueError as error:
            problems.append(Problem("E820", str(error), path))
            continue
        if index is None:
            free = [n for n in range(len(names)) if not own.is_fixed(n)]
            by_index |= {n: pair for n in free if n not in by_index}
        elif index in by_index and ALL not in given:
            problems.append(Problem("E821", f"{names[index]} is given twice", path))
        else:
            by_index[index] = pair
    if problems:
        raise CaseError(problems)
    for index, pair in by_index.items():
        found[index] = _without_zero(*map(float, pair))
    return Bounds(tuple(low for low, _ in found), tuple(high for _, high in found))


def usual(own: OwnLinks, index: int) -> tuple[float, float]:
    """The bounds of a mechanism for which none are given.

    Its ratio keeps its sign, and between moving links stays above or below 1; what is no matter
    of teeth stays as it is.
    """
    mechanism = own.case.mechanisms[index]
    size = abs(mechanism.ratio)
    if own.is_fixed(index):
        return mechanism.ratio, mechanism.ratio
    widest = max(LARGEST_SET_RATIO, 2 * size, 2 / size)
    least, most = 1 / widest, widest
    if mechanism.third != HOUSING and size != 1:
        least, most = (1.0, widest) if size > 1 else (1 / widest, 1.0)
    return (least, most) if mechanism.ratio > 0 else (-most, -least)


def mechanism_index(own: OwnLinks, asked: str) -> int:
    """The index of the mechanism of a name, or else of a number from 1.

    Raises
    ------
    ValueError
        If there is none, or an element that is called has several; it tells which.
    """
    names = [mechanism.name for mechanism in own.case.mechanisms]
    if asked in names:
        return names.index(asked)
    of_element = [
        lowered.mechanism.name
        for part in own.parts
        if part.name == asked
        for lowered in part.lowered
    ]
    if of_element:
        message = f"{quoted(asked)} has several ratios: expected {spoken(of_element, 'or')}"
        raise ValueError(message)
    number = typed_number(asked, len(names))
    if number is not None:
        return number - 1
    hint = nearest(asked, names) or f"; mechanisms are {listed(names, 12)}"
    raise ValueError(f"no mechanism {quoted(asked)}{hint}")


def _wrong(low: float, high: float) -> Iterator[str]:
    """What is wrong with bounds."""
    if not (math.isfinite(low) and math.isfinite(high)):
        yield f"read {low:g}:{high:g}, expected finite numbers"
    elif low > high:
        hint = f"did you mean {high:g}:{low:g}?"
        yield f"read {low:g}:{high:g}, expected the lower bound first; {hint}"
    elif low == high == 0:
        yield "read 0:0, expected a ratio other than 0"
    elif any(one and not SMALLEST <= abs(one) <= LARGEST for one in (low, high)):
        yield f"read {low:g}:{high:g}, expected sizes from {SMALLEST:g} to {LARGEST:g}"


def _without_zero(low: float, high: float) -> tuple[float, float]:
    if low == 0:
        return PART_FOR_ZERO_BOUND * high, high
    return (low, PART_FOR_ZERO_BOUND * low) if high == 0 else (low, high)


Advance = Callable[[int], None]
"""Told how many steps more are done."""


def untold(_steps: int) -> None:
    """Tell nobody."""


class FitProblem(NamedTuple):
    """Ratios wanted of gears, and the ratios of mechanisms that may be varied for them."""

    own: OwnLinks
    """The case on its own links, each freewheel as it is with the case's own ratios."""
    formulas: Sequence[GearFormula]
    """By gear; those that are too long are asked of none that is wanted."""
    targets: Mapping[int, float]
    """Index of a gear -> the ratio wanted [-]."""
    weights: Mapping[int, float]
    """Index of a gear -> weight of the square of its deviation [-]."""
    bounds: Bounds
    tolerance: float

    @property
    def fitted(self) -> list[int]:
        """The gears whose ratios can be fitted: of those wanted, all that are no constants."""
        return [index for index in self.targets if self.formulas[index].kind == "ratio"]

    @property
    def varied(self) -> list[int]:
        """The indices of mechanisms that matter for what is wanted, and are not fixed."""
        matter = {ratio for index in self.fitted for ratio in self.formulas[index].ratios}
        return [index for index in sorted(matter) if not self.bounds.is_fixed(index)]

    @property
    def unused(self) -> list[int]:
        """The indices of mechanisms that matter for nothing that is wanted, and are not fixed."""
        varied, every = self.varied, range(len(self.own.case.mechanisms))
        return [one for one in every if one not in varied and not self.bounds.is_fixed(one)]

    @property
    def anchor(self) -> Floats:
        """The case's own ratios, or the bounds nearest to them [-]."""
        ratios = [mechanism.ratio for mechanism in self.own.case.mechanisms]
        return np.clip(ratios, self.bounds.low, self.bounds.high)

    def reach(self, index: int) -> tuple[float, float] | None:
        """The least and the largest ratio of a gear within the bounds, where it has these [-]."""
        formula = self.formulas[index]
        if formula.kind == "constant":
            return formula.constant, formula.constant
        return reach(formula, np.array(self.bounds.low), np.array(self.bounds.high))


def fit_problem(  # noqa: PLR0913 - what `fit` is given
    case: Transmission,
    ratios: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]],
    weights: Mapping[str, float],
    tolerance: float,
    *,
    advance: Advance = untold,
) -> FitProblem:
    """What is asked, by `fit`, in numbers.

    Raises
    ------
    CaseError
        With all that can't be; each problem's path begins with the argument that it is about.
    """
    own = on_engaged_links(case)
    problems: list[Problem] = []
    if not 0 < tolerance < math.inf:
        message = f"read {tolerance:g}, expected a number above 0"
        problems.append(Problem("E822", message, ("tolerance",)))
    limits = None
    try:
        limits = bounds_of(own, bounds)
    except CaseError as error:
        problems += error.problems
    targets, wrong = _by_gear(case, "ratios", ratios)
    problems += wrong
    weighted, wrong = _by_gear(case, "weights", weights)
    problems += [*wrong, *_wrong_numbers(case, targets, weighted)]
    if not ratios:
        problems.append(Problem("E823", "expected a ratio for one gear at least", ("ratios",)))
    if limits is None or problems:
        raise CaseError(problems)
    fixed = {n: low for n, low in enumerate(limits.low) if limits.is_fixed(n)}
    formulas = []
    for index in range(len(case.gears)):
        formulas.append(_formula(own, index, fixed, targets))
        advance(1)
    made = FitProblem(own, formulas, targets, weighted, limits, tolerance)
    problems = [one for index in targets for one in _impossible(made, index)]
    if problems:
        problems += (Problem("E824", text, ("bounds",)) for text in _other_signs(made))
        raise CaseError(problems)
    return made


def on_engaged_links(case: Transmission) -> OwnLinks:
    """A case on its own links, each freewheel as it is with the case's own ratios."""
    own = on_own_links(case)
    if case.freewheels:
        own = own._replace(case=solve(own.case).with_freewheels_engaged)
    return own


def _formula(
    own: OwnLinks, index: int, fixed: Mapping[int, float], targets: Mapping[int, float]
) -> GearFormula:
    """The formula of a gear; of a gear that nobody asked for one that is too long is none.

    Raises
    ------
    CaseError
        If it is too long.
    """
    try:
        return gear_formula(own, own.case.gears[index], fixed)
    except CaseError as error:
        if index not in targets:
            return GearFormula("too long", {}, {})
        raise CaseError(
            [one._replace(path=("gears", index + 1)) for one in error.problems]
        ) from None


def _by_gear(
    case: Transmission, argument: str, given: Mapping[str, float]
) -> tuple[dict[int, float], list[Problem]]:
    """Numbers by the index of the gear, and names that are none."""
    found: dict[int, float] = {}
    problems = []
    names = [gear.name for gear in case.gears]
    for name, number in given.items():
        if name in names:
            found[names.index(name)] = float(number)
        else:  # a number is no place here: `9=-3.3` would be any gear
            hint = f"{nearest(name, names)}; gears are {listed(names, 12)}"
            problems.append(Problem("E825", f"no gear {quoted(name)}{hint}", (argument, name)))
    if problems and len(given) > len(case.gears):
        count = len(case.gears)
        message = f"{len(given)} are wanted, and the case has {count} {plural('gear', count)}"
        problems.append(Problem("E826", message, (argument,)))
    return found, problems


def _wrong_numbers(
    case: Transmission, targets: Mapping[int, float], weights: Mapping[int, float]
) -> Iterator[Problem]:
    for index, target in targets.items():
        if target == 0 or not math.isfinite(target):
            message = f"gear {case.gears[index].name}: read {target:g}, expected a finite ratio"
            yield Problem("E827", f"{message} other than 0", ("ratios", index))
    for index, weight in weights.items():
        name = case.gears[index].name
        if index not in targets:
            yield Problem("E828", f"gear {name}: no ratio is wanted of it", ("weights", index))
        if not 0 < weight < math.inf:
            message = f"gear {name}: read {weight:g}, expected a weight above 0"
            yield Problem("E829", message, ("weights", index))


def _impossible(problem: FitProblem, index: int) -> Iterator[Problem]:
    """Why a gear can't have a ratio at all, or none of the sign that is wanted."""
    name, target = problem.own.case.gears[index].name, problem.targets[index]
    formula, path = problem.formulas[index], ("ratios", index)
    if formula.kind != "constant" or _is_constant(problem, index):
        without = ratio_fault(name, formula, target, "ratios of the mechanisms")
        if without or formula.kind == "constant":
            yield from [Problem("E830", without, path)] * bool(without)
            return
    limits = problem.reach(index)
    if limits is not None and (wrong := sign_fault(f"gear {name}", target, limits)):
        yield Problem("E831", wrong, path)


def ratio_fault(name: str, formula: GearFormula, wanted: float, varied: str) -> str:
    """Why a gear can't have a ratio that is wanted, whatever is varied; nothing if it may."""
    status = {one.name: one for one in STATUSES}.get(formula.kind)
    if status is not None:
        return f"gear {name} has no ratio: {status.meaning}"
    if formula.kind == "constant" and not is_same(formula.constant, wanted):
        constant = f"gear {name}: read {wanted:.12g}, but its ratio is {formula.constant:.12g}"
        return f"{constant} whatever the {varied} are"
    return ""


def sign_fault(name: str, wanted: float, limits: tuple[float, float]) -> str:
    """What is wrong with a ratio of the other sign than all within limits; nothing if it has not.

    >>> sign_fault("gear 1", -2.0, (2.5, 5.0))
    'gear 1: read -2, but within the bounds its ratio is 2.5 to 5: expected a ratio above 0'
    """
    if not (limits[1] <= 0 < wanted or wanted < 0 <= limits[0]):
        return ""
    expected = "below" if wanted > 0 else "above"
    return f"{name}: read {wanted:g}, but {reach_text(*limits)}: expected a ratio {expected} 0"


def doubts(problem: FitProblem) -> Iterator[str]:
    """What may not be meant, and ratios that can't be met by themselves or together, in words."""
    yield from _other_signs(problem)
    names = [gear.name for gear in problem.own.case.gears]
    alike: dict[tuple[frozenset[tuple[int, Fraction]], ...], int] = {}
    for index, target in problem.targets.items():
        limits = problem.reach(index)
        if limits is not None:
            part = min(max(target, limits[0]), limits[1]) / target
            if not (part > 0 and abs(math.log(part)) <= problem.tolerance):
                yield f"gear {names[index]} can't have {target:g}: {reach_text(*limits)}"
        _, *polynomials = problem.formulas[index]
        first = alike.setdefault(tuple(frozenset(one.items()) for one in polynomials), index)
        other = problem.targets[first]
        if abs(math.log(target / other)) > 2 * problem.tolerance:
            both = f"gears {names[first]} and {names[index]}"
            yield f"{both} have the same ratio, but {other:g} and {target:g} are wanted"


def _other_signs(problem: FitProblem) -> Iterator[str]:
    """Mechanisms that are to have the other sign than in the case."""
    limits = zip(problem.own.case.mechanisms, *problem.bounds, strict=True)
    for mechanism, low, high in limits:
        if high < 0 < mechanism.ratio or mechanism.ratio < 0 < low:
            ratio = f"{mechanism.name} has the ratio {mechanism.ratio:.4g} in the case"
            hint = f"{-high:g}:{-low:g}" if low != high else f"{-low:g}"
            yield f"{ratio}, and bounds of the other sign; did you mean {hint}?"


def reach_text(low: float, high: float) -> str:
    """What a gear can have, in words.

    >>> reach_text(2.5, 5.0), reach_text(5.0, 5.0)
    ('within the bounds its ratio is 2.5 to 5', 'within the bounds its ratio is 5')
    """
    several = f" to {high:.4g}" if high != low else ""
    return f"within the bounds its ratio is {low:.4g}{several}"


def _is_constant(problem: FitProblem, index: int) -> bool:
    """Whether a gear has one ratio also where no mechanism is given but those of ratio 1."""
    own = problem.own
    fixed = {n: 1.0 for n, one in enumerate(own.case.mechanisms) if one.ratio == 1}
    return gear_formula(own, own.case.gears[index], fixed).kind == "constant"
