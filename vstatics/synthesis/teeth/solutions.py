"""Solutions of a search for tooth numbers: records, JSON, and the case with the teeth."""

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
from vstatics.core.tables.answer import SOMETIMES, json_keys
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.rows import TeethRows
from vstatics.synthesis.teeth.search import MOST_TEETH_SOLUTIONS, BestTeeth
from vstatics.synthesis.teeth.table import TeethTable, of_rows

ERROR_DECIMALS = 14
"""Number of decimals of an error in comparisons. Further digits are rounding noise."""


@json_keys("teeth", "planets", "gears", "error", "modules")
class TeethSolution(NamedTuple):
    """Tooth numbers of the gear sets that affect a wanted ratio."""

    teeth: Mapping[str, Mapping[str, int]]
    """Tooth number by gear set and gear."""
    planets: Mapping[str, int]
    """Number of planets, or of pairs of meshing planets, by gear set."""
    gears: Mapping[str, float]
    """Ratio of every gear of the case, by name; NaN without a ratio. [-]"""
    error: float
    """Largest error of the targets, `|ln(i/target)|` or `|i - target|`. [-]"""
    modules: Annotated[Mapping[str, Mapping[str, float]], SOMETIMES]
    """Module by gear set and gear, if several modules are available. [mm]"""
    ratios: Mapping[str, float]
    """Ratios of the mechanisms of the case without planets as links, by name. [-]"""


class TeethAnswer(NamedTuple):
    """JSON output of `vstatics synth teeth`."""

    solutions: Sequence[TeethSolution]


def teeth_solutions(
    problem: TeethProblem, tables: Sequence[TeethTable], best: BestTeeth
) -> Iterator[TeethSolution]:
    """Yield the best solutions; of tooth numbers with equal ratios, small numbers come first."""
    chosen: list[tuple[float, int, tuple[Integers, ...]]] = []
    for error, places in zip(best.errors.tolist(), best.places.tolist(), strict=True):
        alike = [_smallest(table, place) for table, place in zip(tables, places, strict=True)]
        for rows in itertools.islice(_by_size(alike), MOST_TEETH_SOLUTIONS):
            pairs = zip(tables, rows, strict=True)
            total = sum(int(row[: len(table.layout.wheels)].sum()) for table, row in pairs)
            chosen.append((round(error, ERROR_DECIMALS), total, rows))
    chosen.sort(key=lambda choice: (*choice[:2], [row.tolist() for row in choice[2]]))
    for _, _, rows in chosen[:MOST_TEETH_SOLUTIONS]:
        yield _solution(problem, tables, rows)


def _smallest(table: TeethTable, place: int) -> list[Integers]:
    """Return the rows with the smallest tooth numbers among rows with equal ratios."""
    rows = table.rows[table.starts[place] : table.starts[place + 1]]
    order = np.argsort(rows[:, : len(table.layout.wheels)].sum(axis=1), kind="stable")
    return list(rows[order[:MOST_TEETH_SOLUTIONS]])


def _by_size(alike: Sequence[Sequence[Integers]]) -> Iterator[tuple[Integers, ...]]:
    """Yield choices of a row from each list, by ascending sum of the positions."""
    total = sum(len(rows) - 1 for rows in alike)
    for depth in range(total + 1):
        for steps in _steps(depth, [len(rows) for rows in alike]):
            yield tuple(rows[step] for rows, step in zip(alike, steps, strict=True))


def _steps(depth: int, lengths: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield all combinations of positions in lists of the `lengths`, with the sum `depth`."""
    if not lengths:
        if not depth:
            yield ()
        return
    for step in range(min(depth, lengths[0] - 1) + 1):
        yield from ((step, *others) for others in _steps(depth - step, lengths[1:]))


def _solution(
    problem: TeethProblem, tables: Sequence[TeethTable], rows: Sequence[Integers]
) -> TeethSolution:
    case = problem.links.case
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
    named = dict(zip((part.name for part in case.mechanisms), ratios.tolist(), strict=True))
    return TeethSolution(teeth, planets, gears, error, modules, named)


def asked_document(problem: TeethProblem) -> dict[str, Any]:
    """Return the request as data: ranges of gears, numbers of planets, kinds of gear sets."""
    limits = problem.limits
    ranges = {
        layout.name: {
            wheel: {"from": low, "to": high}
            for wheel, (low, high) in zip(layout.wheels, limits.of_wheels(layout), strict=True)
        }
        for layout in problem.layouts
    }
    sets = problem.layouts
    planets = {layout.name: sorted(limits.counts(layout)) for layout in sets if layout.planets}
    kinds = {layout.name: layout.element.kind for layout in sets}
    return {"ranges": ranges, "planets": planets, "kinds": kinds}


def case_with_teeth(
    case: Transmission, problem: TeethProblem, solution: TeethSolution
) -> Transmission:
    """Return the case with found tooth numbers. Mechanisms are replaced by gear sets.

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
        _with_teeth(element, layouts[element.name], solution)
        if element.name in layouts
        else element
        for element in drawing.elements
    ]
    left: list[Mechanism] = []
    names: dict[str, str] = {}
    for mechanism in drawing.mechanisms:
        layout = layouts.get(mechanism.name)
        if layout is None or layout.is_drawn:
            left.append(mechanism)
        else:
            gear_set = replace(  # the gear set replaces the mechanism, with its links and losses
                _with_teeth(layout.element, layout, solution),
                efficiency=mechanism.efficiency,
                back_efficiency=mechanism.back_efficiency,
                stiffness=mechanism.stiffness,
                damping=mechanism.damping,
            )
            elements.append(gear_set)
            parts = zip(("first", "second", "third"), gear_set.members, strict=False)
            names |= {f"{gear_set.name}.{old}": f"{gear_set.name}.{new}" for old, new in parts}
    drawn = replace(drawing, elements=tuple(elements), mechanisms=tuple(left))
    places = [part.name for part in left]
    numbers = {
        n: places.index(part.name) + 1
        for n, part in enumerate(drawing.mechanisms, 1)
        if part.name in places
    }
    gears = [gear.renumbered(numbers) for gear in case.gears]
    changes: dict[str, Any] = {"gears": gears} if given else {"gears": gears, "mechanisms": ()}
    for key in ("fatigue", "bearings"):
        changes[key] = _renamed(getattr(case, key), names)
    return case.replace(drawing=drawn, description="", source="", **changes)


def _renamed(data: Any, names: Mapping[str, str]) -> Any:
    if isinstance(data, Mapping):
        return {names.get(key, key): _renamed(value, names) for key, value in data.items()}
    if isinstance(data, tuple):
        values = (_renamed(value, names) for value in data)
        return type(data)(*values) if hasattr(data, "_fields") else tuple(values)
    return names.get(data, data) if isinstance(data, str) else data


def _with_teeth(element: Element, layout: TeethLayout, solution: TeethSolution) -> Element:
    teeth = solution.teeth[layout.name]
    planets = solution.planets.get(layout.name, element.planets)
    if not element.rims:
        numbers = {name: teeth.get(name, count) for name, count in element.teeth.items()}
        changed = replace(element, teeth={**numbers, **teeth}, planets=planets, ratios={})
        # The efficiency belonged to the former ratios.
        return replace(changed, efficiency=None) if element.ratios else changed
    rims = {planet: {rim: teeth[rim] for rim in gears} for planet, gears in element.rims.items()}
    wheels = [wheel._replace(teeth=teeth[wheel.member]) for wheel in element.wheels]
    return replace(element, rims=rims, wheels=tuple(wheels), planets=planets)
