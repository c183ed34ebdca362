"""Request to fit mechanism ratios to wanted gear ratios, checked before the calculation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, listed, plural, quoted, spoken, typed_number
from vstatics.core.explain.bodies import OwnLinks, on_own_links
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.solve import solve
from vstatics.core.statics.status import STATUSES
from vstatics.core.suggestions import nearest
from vstatics.core.summary.design_table import is_same
from vstatics.synthesis.ratios.arrays import reach
from vstatics.synthesis.ratios.formula import GearFormula, gear_formula
from vstatics.synthesis.tolerances import PART_FOR_ZERO_BOUND

LARGEST_SET_RATIO = 14.0
"""Largest default ratio; a gear set with three planets that do not touch is below 13.93. [-]"""
SMALLEST, LARGEST = 1e-9, 1e9
"""Smallest and largest magnitude of a bound, so that products of ratios are finite. [-]"""
ALL = "all"
"""Name for all mechanisms that are not named."""


class Bounds(NamedTuple):
    """Smallest and largest ratio of each mechanism [-]."""

    low: Sequence[float]
    high: Sequence[float]

    def is_fixed(self, index: int) -> bool:
        """Return whether both bounds of a mechanism's ratio are equal."""
        return self.low[index] == self.high[index]


def bounds_of(links: OwnLinks, given: Mapping[str, tuple[float, float]]) -> Bounds:
    """Return the bounds of all mechanisms: the user's or, otherwise, the default bounds.

    Parameters
    ----------
    links : OwnLinks
        Case whose links do not include planets.
    given : mapping of str to (float, float)
        Bounds by the name of a mechanism; `all` stands for mechanisms that are not named. [-]

    Raises
    ------
    CaseError
        If a mechanism does not exist, or bounds are not valid.

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
    names = [mechanism.name for mechanism in links.case.mechanisms]
    problems: list[Problem] = []
    pairs = [usual(links, index) for index in range(len(names))]
    by_index: dict[int, tuple[float, float]] = {}
    for name, pair in given.items():
        path = ("bounds", name)
        problems += (Problem("E819", f"{name}: {text}", path) for text in _wrong(*pair))
        try:
            index = None if name == ALL and ALL not in names else mechanism_index(links, name)
        except ValueError as error:
            problems.append(Problem("E820", str(error), path))
            continue
        if index is None:
            free = [n for n in range(len(names)) if not links.is_fixed(n)]
            by_index |= {n: pair for n in free if n not in by_index}
        elif index in by_index and ALL not in given:
            problems.append(Problem("E821", f"{names[index]} is given twice", path))
        else:
            by_index[index] = pair
    if problems:
        raise CaseError(problems)
    for index, pair in by_index.items():
        low, high = map(float, pair)
        if low == 0:
            low = PART_FOR_ZERO_BOUND * high
        elif high == 0:
            high = PART_FOR_ZERO_BOUND * low
        pairs[index] = low, high
    return Bounds(tuple(low for low, _ in pairs), tuple(high for _, high in pairs))


def usual(links: OwnLinks, index: int) -> tuple[float, float]:
    """Return the default bounds of the ratio of a mechanism.

    The ratio keeps its sign; between moving links it also stays above, or below, 1. A ratio that is
    not determined by teeth, such as that of a shaft, is fixed.
    """
    mechanism = links.case.mechanisms[index]
    size = abs(mechanism.ratio)
    if links.is_fixed(index):
        ratio = 1.0 if math.isnan(mechanism.ratio) else mechanism.ratio
        return ratio, ratio
    widest = max(LARGEST_SET_RATIO, 2 * size, 2 / size)
    least, most = 1 / widest, widest
    if mechanism.third != HOUSING and size != 1:
        least, most = (1.0, widest) if size > 1 else (1 / widest, 1.0)
    return (least, most) if mechanism.ratio > 0 else (-most, -least)


def mechanism_index(links: OwnLinks, asked: str) -> int:
    """Return the index of the mechanism that a name or, failing that, a number from 1 means.

    Raises
    ------
    ValueError
        If the mechanism does not exist, or a gear set of this name has several mechanisms, which
        the message lists.
    """
    names = [mechanism.name for mechanism in links.case.mechanisms]
    if asked in names:
        return names.index(asked)
    of_element = [
        lowered.mechanism.name
        for part in links.parts
        if part.name == asked
        for lowered in part.lowered
    ]
    if of_element:
        raise ValueError(f"{quoted(asked)} has several ratios: expected {spoken(of_element, 'or')}")
    number = typed_number(asked, len(names))
    if number is not None:
        return number - 1
    hint = nearest(asked, names) or f"; mechanisms are {listed(names, 12)}"
    raise ValueError(f"no mechanism {quoted(asked)}{hint}")


def _wrong(low: float, high: float) -> Iterator[str]:
    """Yield the faults of the bounds of a ratio, in words."""
    if not (math.isfinite(low) and math.isfinite(high)):
        yield f"read {low:g}:{high:g}, expected finite numbers"
    elif low > high:
        hint = f"did you mean {high:g}:{low:g}?"
        yield f"read {low:g}:{high:g}, expected the lower bound first; {hint}"
    elif low == high == 0:
        yield "read 0:0, expected a ratio other than 0"
    elif any(bound and not SMALLEST <= abs(bound) <= LARGEST for bound in (low, high)):
        yield f"read {low:g}:{high:g}, expected sizes from {SMALLEST:g} to {LARGEST:g}"


Advance = Callable[[int], None]
"""Function that receives the number of further finished steps, for a progress display."""


def untold(_steps: int) -> None:
    """Ignore the progress of a calculation."""


class FitProblem(NamedTuple):
    """Checked request for a fit: wanted gear ratios, and mechanism ratios to vary."""

    links: OwnLinks
    """Case without planets as links and without freewheels, from `on_engaged_links`."""
    formulas: Sequence[GearFormula]
    """Formula of each gear. A gear without a target can have a formula of the kind `too long`."""
    targets: Mapping[int, float]
    """Wanted ratios, by the index of the gear. [-]"""
    weights: Mapping[int, float]
    """Weights of squared deviations, by the index of the gear. [-]"""
    bounds: Bounds
    tolerance: float

    @property
    def fitted(self) -> list[int]:
        """Indices of gears with a wanted ratio that mechanism ratios can change."""
        return [index for index in self.targets if self.formulas[index].kind == "ratio"]

    @property
    def varied(self) -> list[int]:
        """Indices of mechanisms that affect a wanted ratio, and are not fixed."""
        matter = {ratio for index in self.fitted for ratio in self.formulas[index].ratios}
        return [index for index in sorted(matter) if not self.bounds.is_fixed(index)]

    @property
    def unused(self) -> list[int]:
        """Indices of mechanisms that affect no wanted ratio, and are not fixed."""
        varied, every = self.varied, range(len(self.links.case.mechanisms))
        return [index for index in every if index not in varied and not self.bounds.is_fixed(index)]

    @property
    def anchor(self) -> Floats:
        """Mechanism ratios of the case, clipped to the bounds [-]."""
        ratios = [mechanism.ratio for mechanism in self.links.case.mechanisms]
        return np.clip(ratios, self.bounds.low, self.bounds.high)

    def reach(self, index: int) -> tuple[float, float] | None:
        """Return the smallest and largest ratio of a gear within the bounds, if bounded [-]."""
        formula = self.formulas[index]
        if formula.kind == "constant":
            return formula.constant, formula.constant
        return reach(formula, np.array(self.bounds.low), np.array(self.bounds.high))


def fit_problem(  # noqa: PLR0913 - the arguments of `fit`
    case: Transmission,
    ratios: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]],
    weights: Mapping[str, float],
    tolerance: float,
    *,
    advance: Advance = untold,
) -> FitProblem:
    """Check the arguments of `fit`, and return a problem to solve.

    Raises
    ------
    CaseError
        If arguments are wrong or a ratio is impossible. A path begins with the argument, or with
        `mechanisms` or `gears` if the case does not permit a fit.
    """
    for gear in case.gears:
        for index in case.sought_converters(gear):
            message = f"{case.mechanisms[index].name} has no given speed ratio: expected "
            message += "the gear train behind it, with its turbine as `input`, or a `speed_ratio`"
            raise CaseError("E456", message, ("mechanisms", index + 1))
    links = on_engaged_links(case)
    problems: list[Problem] = []
    if not 0 < tolerance < math.inf:
        problems.append(
            Problem("E822", f"read {tolerance:g}, expected a number above 0", ("tolerance",))
        )
    limits = None
    try:
        limits = bounds_of(links, bounds)
    except CaseError as error:
        problems += error.problems
    targets, wrong = _by_gear(case, "ratios", ratios)
    problems += wrong
    weighted, wrong = _by_gear(case, "weights", weights)
    problems += [*wrong, *_wrong_numbers(case, targets, weighted)]
    if not ratios:
        problems.append(Problem("E823", "expected a ratio for at least one gear", ("ratios",)))
    if limits is None or problems:
        raise CaseError(problems)
    fixed = {n: low for n, low in enumerate(limits.low) if limits.is_fixed(n)}
    formulas = []
    for index in range(len(case.gears)):
        formulas.append(_formula(links, index, fixed, targets))
        advance(1)
    problem = FitProblem(links, formulas, targets, weighted, limits, tolerance)
    problems = [fault for index in targets for fault in _impossible(problem, index)]
    if problems:
        problems += (Problem("E824", text, ("bounds",)) for text in _other_signs(problem))
        raise CaseError(problems)
    return problem


def on_engaged_links(case: Transmission) -> OwnLinks:
    """Return a case without planets as links, in which freewheels do not change state.

    A freewheel becomes a shift element that is engaged in the gears where the freewheel holds at
    the present ratios of the case.
    """
    links = on_own_links(case)
    if case.freewheels:
        links = links._replace(case=solve(links.case).with_freewheels_engaged)
    return links


def _formula(
    links: OwnLinks, index: int, fixed: Mapping[int, float], targets: Mapping[int, float]
) -> GearFormula:
    """Return the formula of a gear. A too long formula is an error only for a wanted ratio.

    Raises
    ------
    CaseError
        If the formula of a target is too long.
    """
    try:
        return gear_formula(links, links.case.gears[index], fixed)
    except CaseError as error:
        if index not in targets:
            return GearFormula("too long", {}, {})
        raise CaseError(
            [problem._replace(path=("gears", index + 1)) for problem in error.problems]
        ) from None


def _by_gear(
    case: Transmission, argument: str, given: Mapping[str, float]
) -> tuple[dict[int, float], list[Problem]]:
    """Return numbers by the index of the gear, and problems with unknown names of gears."""
    numbers: dict[int, float] = {}
    problems = []
    names = [gear.name for gear in case.gears]
    for name, value in given.items():
        if name in names:
            numbers[names.index(name)] = float(value)
        else:  # numbers of gears are refused, because `9=-3.3` could mean any gear
            hint = f"{nearest(name, names)}; gears are {listed(names, 12)}"
            problems.append(Problem("E825", f"no gear {quoted(name)}{hint}", (argument, name)))
    if problems and len(given) > len(case.gears):
        count = len(case.gears)
        problems.append(
            Problem(
                "E826",
                f"read {len(given)} numbers, but the case has {count} {plural('gear', count)}",
                (argument,),
            )
        )
    return numbers, problems


def _wrong_numbers(
    case: Transmission, targets: Mapping[int, float], weights: Mapping[int, float]
) -> Iterator[Problem]:
    for index, target in targets.items():
        if target == 0 or not math.isfinite(target):
            yield Problem(
                "E827",
                f"gear {case.gears[index].name}: read {target:g}, expected a finite ratio"
                " other than 0",
                ("ratios", index),
            )
    for index, weight in weights.items():
        name = case.gears[index].name
        if index not in targets:
            yield Problem(
                "E828",
                f"gear {name}: read a weight without a ratio, expected both",
                ("weights", index),
            )
        if not 0 < weight < math.inf:
            yield Problem(
                "E829",
                f"gear {name}: read {weight:g}, expected a weight above 0",
                ("weights", index),
            )


def _impossible(problem: FitProblem, index: int) -> Iterator[Problem]:
    name, target = problem.links.case.gears[index].name, problem.targets[index]
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
    """Return the reason why no mechanism ratios give the wanted ratio of a gear; "" if possible."""
    status = {known_status.name: known_status for known_status in STATUSES}.get(formula.kind)
    if status is not None:
        return f"gear {name} has no ratio: {status.meaning}"
    if formula.kind == "constant" and not is_same(formula.constant, wanted):
        constant = f"gear {name}: read {wanted:.12g}, but its ratio is {formula.constant:.12g}"
        return f"{constant} whatever the {varied} are"
    return ""


def sign_fault(name: str, wanted: float, limits: tuple[float, float]) -> str:
    """Return a message if all possible ratios have the wrong sign, else "".

    >>> sign_fault("gear 1", -2.0, (2.5, 5.0))
    'gear 1: read -2, but within the bounds its ratio is 2.5 to 5: expected a ratio above 0'
    """
    if not (limits[1] <= 0 < wanted or wanted < 0 <= limits[0]):
        return ""
    expected = "below" if wanted > 0 else "above"
    return f"{name}: read {wanted:g}, but {reach_text(*limits)}: expected a ratio {expected} 0"


def doubts(problem: FitProblem) -> Iterator[str]:
    """Yield warnings about bounds that reverse the sign of a ratio, and unreachable ratios."""
    yield from _other_signs(problem)
    names = [gear.name for gear in problem.links.case.gears]
    alike: dict[tuple[frozenset[tuple[int, Fraction]], ...], int] = {}
    for index, target in problem.targets.items():
        limits = problem.reach(index)
        if limits is not None:
            part = min(max(target, limits[0]), limits[1]) / target
            if not (part > 0 and abs(math.log(part)) <= problem.tolerance):
                yield f"gear {names[index]} cannot have {target:g}: {reach_text(*limits)}"
        _, *polynomials = problem.formulas[index]
        first = alike.setdefault(
            tuple(frozenset(polynomial.items()) for polynomial in polynomials), index
        )
        other = problem.targets[first]
        if abs(math.log(target / other)) > 2 * problem.tolerance:
            both = f"gears {names[first]} and {names[index]}"
            yield f"{both} have the same ratio, but {other:g} and {target:g} are wanted"


def _other_signs(problem: FitProblem) -> Iterator[str]:
    """Yield warnings about mechanisms whose bounds and ratio differ in sign."""
    limits = zip(problem.links.case.mechanisms, *problem.bounds, strict=True)
    for mechanism, low, high in limits:
        if high < 0 < mechanism.ratio or mechanism.ratio < 0 < low:
            ratio = f"{mechanism.name} has the ratio {mechanism.ratio:.4g} in the case"
            hint = f"{-high:g}:{-low:g}" if low != high else f"{-low:g}"
            yield f"{ratio}, but its bounds have the other sign; did you mean {hint}?"


def reach_text(low: float, high: float) -> str:
    """Return the possible ratios of a gear in words.

    >>> reach_text(2.5, 5.0), reach_text(5.0, 5.0)
    ('within the bounds its ratio is 2.5 to 5', 'within the bounds its ratio is 5')
    """
    several = f" to {high:.4g}" if high != low else ""
    return f"within the bounds its ratio is {low:.4g}{several}"


def _is_constant(problem: FitProblem, index: int) -> bool:
    """Return whether a gear ratio is constant even if all mechanism ratios other than 1 vary."""
    links = problem.links
    fixed = {n: 1.0 for n, mechanism in enumerate(links.case.mechanisms) if mechanism.ratio == 1}
    return gear_formula(links, links.case.gears[index], fixed).kind == "constant"
