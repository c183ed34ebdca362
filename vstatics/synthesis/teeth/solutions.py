"""Solutions of a search for teeth: each place of the tables with all its teeth; JSON, case."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any, NamedTuple

import numpy as np

from vstatics.core.elements.drawing import Drawing, drawing_of
from vstatics.core.elements.element import Element
from vstatics.core.model.parts import Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Integers
from vstatics.core.statics.solve import solve
from vstatics.core.tables.answer import SOMETIMES, told
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.rows import TeethRows
from vstatics.synthesis.teeth.search import MOST_TEETH_SOLUTIONS, BestTeeth
from vstatics.synthesis.teeth.table import TeethTable, of_rows

ERROR_DECIMALS = 14
"""Decimals of an error; what is below them is rounding."""


@told("teeth", "planets", "gears", "error", "modules")
class TeethSolution(NamedTuple):
    """Teeth of the elements that matter for what is wanted."""

    teeth: Mapping[str, Mapping[str, int]]
    """By element, by wheel or rim."""
    planets: Mapping[str, int]
    """How many planets an element has, or pairs of meshed ones."""
    gears: Mapping[str, float]
    """The ratio of every gear of the case [-]; NaN where it has none."""
    error: float
    """The largest of what is wanted: `|ln(i/target)|`, or `|i - target|` [-]."""
    modules: Annotated[Mapping[str, Mapping[str, float]], SOMETIMES]
    """By element, by wheel, where modules are chosen [mm]."""
    ratios: Mapping[str, float]
    """Of the mechanisms of the case on its own links [-]."""


class TeethAnswer(NamedTuple):
    """What `vstatics synth teeth` answers."""

    solutions: Sequence[TeethSolution]


def teeth_solutions(
    problem: TeethProblem, tables: Sequence[TeethTable], best: BestTeeth
) -> Iterator[TeethSolution]:
    """The first of what was found, each place with all its teeth, small ones first."""
    chosen: list[tuple[float, int, tuple[Integers, ...]]] = []
    for error, places in zip(best.errors.tolist(), best.places.tolist(), strict=True):
        alike = [_smallest(table, place) for table, place in zip(tables, places, strict=True)]
        for rows in itertools.islice(_by_size(alike), MOST_TEETH_SOLUTIONS):
            pairs = zip(tables, rows, strict=True)
            total = sum(int(row[: len(table.layout.wheels)].sum()) for table, row in pairs)
            chosen.append((round(error, ERROR_DECIMALS), total, rows))
    chosen.sort(key=lambda one: (*one[:2], [row.tolist() for row in one[2]]))
    for _, _, rows in chosen[:MOST_TEETH_SOLUTIONS]:
        yield _solution(problem, tables, rows)


def _smallest(table: TeethTable, place: int) -> list[Integers]:
    """The rows of a place with the fewest teeth."""
    rows = table.rows[table.starts[place] : table.starts[place + 1]]
    order = np.argsort(rows[:, : len(table.layout.wheels)].sum(axis=1), kind="stable")
    return list(rows[order[:MOST_TEETH_SOLUTIONS]])


def _by_size(alike: Sequence[Sequence[Integers]]) -> Iterator[tuple[Integers, ...]]:
    """Choices of a row each, those with the fewest places down the lists first."""
    total = sum(len(rows) - 1 for rows in alike)
    for depth in range(total + 1):
        for steps in _steps(depth, [len(rows) for rows in alike]):
            yield tuple(rows[step] for rows, step in zip(alike, steps, strict=True))


def _steps(depth: int, lengths: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """All ways to go down so many steps in lists."""
    if not lengths:
        if not depth:
            yield ()
        return
    for step in range(min(depth, lengths[0] - 1) + 1):
        yield from ((step, *others) for others in _steps(depth - step, lengths[1:]))


def _solution(
    problem: TeethProblem, tables: Sequence[TeethTable], rows: Sequence[Integers]
) -> TeethSolution:
    """What rows of all elements give."""
    case = problem.own.case
    ratios = np.array([mechanism.ratio for mechanism in case.mechanisms])
    teeth: dict[str, dict[str, int]] = {}
    planets: dict[str, int] = {}
    modules: dict[str, dict[str, float]] = {}
    points: list[float] = []
    for table, row in zip(tables, rows, strict=True):
        layout, wheels = table.layout, len(table.layout.wheels)
        teeth[layout.name] = dict(zip(layout.wheels, row.tolist(), strict=False))
        if layout.planets:
            planets[layout.name] = int(row[wheels])
        limits = problem.limits
        has_sizes = max(layout.component) > 0 or limits.largest_diameter is not None
        if limits.modules and has_sizes:
            sizes = TeethRows(layout, limits).modules[row[wheels + 1 :]].tolist()
            pairs = zip(layout.wheels, layout.component, strict=True)
            modules[layout.name] = {wheel: sizes[component] for wheel, component in pairs}
        of_row = of_rows(layout, row[np.newaxis])[0].tolist()
        for ratio, value in zip(layout.ratios, of_row, strict=True):
            ratios[ratio.mechanism] = value
        points += of_row
    of_gears = solve(case, ratios=ratios).ratio.tolist()
    gears = dict(zip((gear.name for gear in case.gears), of_gears, strict=True))
    errors = [float(target.errors(np.array([points]))[0]) for target in problem.targets]
    error = round(max(errors), ERROR_DECIMALS)
    named = dict(zip((one.name for one in case.mechanisms), ratios.tolist(), strict=True))
    return TeethSolution(teeth, planets, gears, error, modules, named)


def asked_document(problem: TeethProblem) -> dict[str, Any]:
    """What is looked for: ranges of wheels, numbers of planets, the kinds of the elements."""
    limits = problem.limits
    ranges = {
        layout.name: {
            wheel: {"from": low, "to": high}
            for wheel, (low, high) in zip(layout.wheels, limits.of_wheels(layout), strict=True)
        }
        for layout in problem.layouts
    }
    planets = {one.name: sorted(limits.counts(one)) for one in problem.layouts if one.planets}
    kinds = {one.name: one.element.kind for one in problem.layouts}
    return {"ranges": ranges, "planets": planets, "kinds": kinds}


def case_with_teeth(
    case: Transmission, problem: TeethProblem, solution: TeethSolution
) -> Transmission:
    """The case with found teeth; a mechanism becomes the element that has them.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> found = find_teeth(case, {"1": 3.6})
    >>> solve(case_with_teeth(case, found.problem, found.solutions[0])).ratio.round(9)
    array([3.6])
    """
    given = drawing_of(case)
    drawing = given or Drawing(case.links, (), case.mechanisms)
    layouts = {layout.name: layout for layout in problem.layouts}
    elements = [
        _with_teeth(one, layouts[one.name], solution) if one.name in layouts else one
        for one in drawing.elements
    ]
    left: list[Mechanism] = []
    for mechanism in drawing.mechanisms:
        layout = layouts.get(mechanism.name)
        if layout is None or layout.is_drawn:
            left.append(mechanism)
        else:
            made = replace(  # in place of the mechanism, with its links and losses
                _with_teeth(layout.element, layout, solution),
                efficiency=mechanism.efficiency,
                back_efficiency=mechanism.back_efficiency,
                stiffness=mechanism.stiffness,
                damping=mechanism.damping,
            )
            elements.append(made)
    drawn = replace(drawing, elements=tuple(elements), mechanisms=tuple(left))
    if given is None:
        return case.replace(mechanisms=(), drawing=drawn, description="", source="")
    return case.replace(drawing=drawn, description="", source="")


def _with_teeth(element: Element, layout: TeethLayout, solution: TeethSolution) -> Element:
    teeth = solution.teeth[layout.name]
    planets = solution.planets.get(layout.name, element.planets)
    if not element.rims:
        kept = {name: teeth.get(name, count) for name, count in element.teeth.items()}
        made = replace(element, teeth={**kept, **teeth}, planets=planets, ratios={})
        return replace(made, efficiency=None) if element.ratios else made  # that of each ratio
    rims = {planet: {rim: teeth[rim] for rim in own} for planet, own in element.rims.items()}
    wheels = [wheel._replace(teeth=teeth[wheel.member]) for wheel in element.wheels]
    return replace(element, rims=rims, wheels=tuple(wheels), planets=planets)
