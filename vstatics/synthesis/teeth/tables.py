"""Found teeth as tables."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vstatics.core.tables.grid import Cell, Grid, Values, exact, grid_of, whole
from vstatics.synthesis.ratios.tables import number
from vstatics.synthesis.teeth.finding import FoundTeeth
from vstatics.synthesis.teeth.layout import named_ratios
from vstatics.synthesis.teeth.limits import TeethLimits
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.solutions import TeethSolution


def teeth_grids(found: FoundTeeth) -> Iterator[Grid]:
    """What the best teeth give, the teeth, all solutions, and what they were chosen from.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gears, teeth, *_ = teeth_grids(find_teeth(case, {"1": 4.0}))
    >>> gears.texts, teeth.texts
    ([['1', '4.0000', '4.0000', '0']], [['D1', 'sun 17, ring 51, planet 17', '4', '-3.0000']])
    """
    best = found.solutions[0]
    yield _wanted(found.problem, best)
    yield _teeth(found.problem, best)
    yield _solutions(found)
    yield _choice(found)


def _error(value: float) -> Cell:
    """An error, which may be of any size."""
    return Cell(f"{value:.3g}" if value else "0", value, kind=float)


def _wanted(problem: TeethProblem, best: TeethSolution) -> Grid:
    targets = {target.name: target for target in problem.targets}
    rows = []
    of_sets = named_ratios(problem.layouts)
    sets = of_sets.keys() & targets.keys() - best.gears.keys()
    wanted = {name: best.ratios[one.name] for name, one in of_sets.items() if name in sets}
    for name, ratio in {**best.gears, **wanted}.items():
        target = targets.get(name)
        error = _error(float(target.apart(np.array(ratio)))) if target else None
        rows.append((name, number(target.wanted if target else None), exact(ratio, 4), error))
    return grid_of("Gears", ["gear", "wanted", "ratio", "error"], rows)


def _teeth(problem: TeethProblem, best: TeethSolution) -> Grid:
    rows = []
    for layout in problem.layouts:
        teeth = ", ".join(f"{wheel} {count}" for wheel, count in best.teeth[layout.name].items())
        ratios = ", ".join(f"{best.ratios[one.name]:.4f}" for one in layout.ratios)
        of_wheels = best.modules.get(layout.name, {}) if best.modules else {}
        modules = ", ".join(f"{wheel} {module:g}" for wheel, module in of_wheels.items())
        rows.append((layout.name, teeth, best.planets.get(layout.name), ratios, modules))
    modules = "modules [mm]"
    headings = "element", "teeth", "planets", "ratio", modules
    return grid_of("Teeth", headings, rows, optional=[] if best.modules else [modules])


def _solutions(found: FoundTeeth) -> Grid:
    names = [layout.name for layout in found.problem.layouts]
    rows: list[Values] = []
    for place, one in enumerate(found.solutions, 1):
        teeth = ["/".join(map(str, one.teeth[name].values())) for name in names]
        rows.append((place, _error(one.error), *teeth))
    return grid_of("Solutions", ["solution", "error", *names], rows)


def _choice(found: FoundTeeth) -> Grid:
    """How many teeth fulfil the conditions of each element by itself."""
    rows = (
        (one.layout.name, int(one.total), len(one.rows), len(one.ratios)) for one in found.tables
    )
    return grid_of("Choice", ["element", "teeth and planets", "teeth", "ratios"], rows)


def asked_grids(problem: TeethProblem) -> Iterator[Grid]:
    """What is looked for, before it is: the ranges of all wheels, and of what kind each element is.

    A mechanism has the kind that it is taken for.
    """
    limits: TeethLimits = problem.limits
    rows = []
    for layout in problem.layouts:
        planets = ", ".join(map(str, sorted(limits.counts(layout)))) if layout.planets else "-"
        for wheel, (low, high) in zip(layout.wheels, limits.of_wheels(layout), strict=True):
            front = f"{layout.name}.{wheel}", whole(low), whole(high)
            rows.append((*front, planets, layout.element.kind))
    yield grid_of("Ranges", ["wheel", "from", "to", "planets", "kind"], rows)
