"""Request of a search for tooth numbers, checked before the search."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from vstatics.core.elements.group_checks import LARGEST_WHEEL
from vstatics.core.elements.teeth.conditions import SHIFT
from vstatics.core.errors import CaseError, Problem, listed, quoted
from vstatics.core.explain.bodies import OwnLinks
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.solve import solve
from vstatics.core.suggestions import nearest
from vstatics.synthesis.ratios.formula import ONE, GearFormula, gear_formula
from vstatics.synthesis.ratios.problem import on_engaged_links, ratio_fault
from vstatics.synthesis.teeth.layout import TeethLayout, named_ratios, teeth_layouts
from vstatics.synthesis.teeth.limits import TeethLimits
from vstatics.synthesis.teeth.targets import TeethError, TeethTarget

MOST_RATIOS = 8
"""Largest number n of tooth ratios in the formula of a gear. Regions have 2**n corners."""
MOST_PLANETS = 12
"""Largest number of planets around an axis."""
MOST_MODULES = 20
"""Largest number of available modules."""


class TeethProblem(NamedTuple):
    """Checked request of a search for tooth numbers."""

    links: OwnLinks
    """Case without planets as links, in which freewheels do not change state."""
    layouts: Sequence[TeethLayout]
    """Gear sets that affect a wanted ratio."""
    targets: Sequence[TeethTarget]
    """Wanted ratios. The columns in their formulas are the ratios of all gear sets in order."""
    limits: TeethLimits
    unused: Sequence[str]
    """Names of gear sets with teeth that do not affect any wanted ratio."""


def teeth_problem(
    case: Transmission, ratios: Mapping[str, float], limits: TeethLimits, error: TeethError = "ln"
) -> TeethProblem:
    """Check the arguments of `find_teeth`, and return a problem to solve.

    Raises
    ------
    CaseError
        If arguments are wrong, with all problems; each path begins with the option.
    """
    links = on_engaged_links(case)
    layouts = teeth_layouts(links)
    problems = [*_wrong_limits(limits, layouts)]
    if not ratios:
        problems.append(
            Problem("E836", "expected a ratio for at least one gear or gear set", ("ratios",))
        )
    formulas: dict[str, GearFormula] = {}
    asked = _AskedByName(links, layouts)
    for name, wanted in ratios.items():
        try:
            formulas[name] = asked.formula(name, wanted)
        except CaseError as failed:
            problems += failed.problems
    if problems:
        raise CaseError(problems)
    occurring = {index for formula in formulas.values() for index in formula.ratios}
    used = [part for part in layouts if any(r.mechanism in occurring for r in part.ratios)]
    if not used:
        message = "the wanted ratios depend on no gear set whose teeth can be searched"
        if layouts:
            message += f"; such gear sets are {listed([layout.name for layout in layouts], 12)}"
        raise CaseError("E837", message, ("ratios",))
    columns: dict[int, int] = {}
    for layout in used:
        for ratio in layout.ratios:
            columns[ratio.mechanism] = len(columns)
    targets = [
        TeethTarget(name, float(ratios[name]), formula, columns, error)
        for name, formula in formulas.items()
        if formula.kind == "ratio"
    ]
    unused = [layout.name for layout in layouts if layout not in used]
    return TeethProblem(links, used, targets, limits, unused)


def own_ratios(case: Transmission) -> dict[str, float]:
    """Return the present gear ratios of a case, by the name of the gear [-].

    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> own_ratios(Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])]))
    {'1': 3.5}
    """
    ratios = zip(case.gears, solve(case).ratio.tolist(), strict=True)
    return {gear.name: ratio for gear, ratio in ratios if math.isfinite(ratio) and ratio}


@dataclass(frozen=True)
class _AskedByName:
    """Case with gear ratios and gear-set ratios by name."""

    links: OwnLinks
    layouts: Sequence[TeethLayout]

    def formula(self, name: str, wanted: float) -> GearFormula:
        """Return the formula for the ratio of the gear or gear set called `name`.

        Raises
        ------
        CaseError
            If no gear or gear set has the name, or if the ratio is impossible.
        """
        path = ("ratios", name)
        gears = [gear.name for gear in self.links.case.gears]
        what = f"gear {name}" if name in gears else name
        if wanted == 0 or not math.isfinite(wanted):
            raise CaseError(
                "E827", f"{what}: read {wanted:g}, expected a finite ratio other than 0", path
            )
        if name in gears:
            return self._of_gear(gears.index(name), wanted)
        of_sets = named_ratios(self.layouts)
        if name not in of_sets:
            hint = f"{nearest(name, [*gears, *of_sets])}; gears are {listed(gears, 12)}"
            if of_sets:
                hint += f"; gear sets are {listed([*of_sets], 12)}"
            raise CaseError("E839", f"no gear or gear set {quoted(name)}{hint}", path)
        ratio = of_sets[name]
        if wanted * ratio.sign < 0:
            side = "below" if ratio.sign < 0 else "above"
            raise CaseError(
                "E840",
                f"{name}: read {wanted:g}, expected a ratio {side} 0: did you mean {-wanted:g}?",
                path,
            )
        return GearFormula("ratio", {1 << ratio.mechanism: ONE}, {0: ONE})

    def _of_gear(self, index: int, wanted: float) -> GearFormula:
        case = self.links.case
        name, path = case.gears[index].name, ("ratios", case.gears[index].name)
        with_teeth = {ratio.mechanism for layout in self.layouts for ratio in layout.ratios}
        fixed = {
            number: mechanism.ratio
            for number, mechanism in enumerate(case.mechanisms)
            if number not in with_teeth
        }
        try:
            formula = gear_formula(self.links, case.gears[index], fixed)
        except CaseError as failed:
            raise CaseError([problem._replace(path=path) for problem in failed.problems]) from None
        if fault := ratio_fault(name, formula, wanted, "teeth"):
            raise CaseError("E841", fault, path)
        if len(formula.ratios) > MOST_RATIOS:
            raise CaseError(
                "E842",
                f"gear {name}: its ratio depends on {len(formula.ratios)} basic ratios, expected "
                f"at most {MOST_RATIOS}",
                path,
            )
        return formula


def _wrong_limits(limits: TeethLimits, layouts: Sequence[TeethLayout]) -> Iterator[Problem]:
    wheels = [*dict.fromkeys(wheel for layout in layouts for wheel in layout.wheels)]
    special = [f"{layout.name}.{wheel}" for layout in layouts for wheel in layout.wheels]
    names = ["all", *wheels, *special]
    for name, (low, high) in limits.ranges.items():
        if name not in names:
            hint = f"{nearest(name, names)}; toothed gears are {listed(wheels, 12)}"
            yield Problem("E847", f"no toothed gear {quoted(name)}{hint}", ("range", name))
        elif not 1 <= low <= high < LARGEST_WHEEL:
            yield Problem(
                "E848",
                f"{name}: read {low}:{high}, expected two numbers of teeth"
                f" below {LARGEST_WHEEL}, the smaller number first",
                ("range", name),
            )
    for count in limits.planets:
        if not 1 <= count <= MOST_PLANETS:
            yield Problem(
                "E843",
                f"read {count}, expected numbers of planets from 1 to {MOST_PLANETS}",
                ("planets",),
            )
    if not 0 <= limits.clearance < math.inf:
        yield Problem(
            "E844",
            f"read {limits.clearance:g}, expected a number of modules of 0 or more",
            ("clearance",),
        )
    pairs = [layout.name for layout in layouts if layout.element.kind == "gear_pair"]
    for name, distance in limits.centre.items():
        if name not in pairs:
            hint = nearest(name, pairs) + (f"; pairs are {listed(pairs, 12)}" if pairs else "")
            yield Problem("E845", f"no external gear pair {quoted(name)}{hint}", ("centre", name))
        elif not 0 < distance < LARGEST_WHEEL:
            yield Problem(
                "E846",
                f"{name}: read {distance:g}, expected a number of modules above 0",
                ("centre", name),
            )
    yield from _wrong_sizes(limits)


def _wrong_sizes(limits: TeethLimits) -> Iterator[Problem]:
    if any(not 0 < module < math.inf for module in limits.modules):
        yield Problem("E849", "expected modules above 0", ("modules",))
    if len(limits.modules) > MOST_MODULES:
        yield Problem(
            "E850",
            f"read {len(limits.modules)}, expected at most {MOST_MODULES} modules",
            ("modules",),
        )
    if limits.largest_diameter is not None:
        if not 0 < limits.largest_diameter < math.inf:
            yield Problem(
                "E851",
                f"read {limits.largest_diameter:g}, expected a length above 0",
                ("largest-diameter",),
            )
        if not limits.modules:
            yield Problem(
                "E852",
                "the size of teeth follows from their module: give --modules",
                ("largest-diameter",),
            )
    if not 0 <= limits.shift <= SHIFT:
        yield Problem(
            "E853",
            f"read {limits.shift}, expected 0 to {SHIFT} teeth"
            ": profile shifts cannot compensate more",
            ("shift",),
        )
