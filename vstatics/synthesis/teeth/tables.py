"""Tables of found tooth numbers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vstatics.core.tables.grid import Cell, Grid, Values, exact, grid_of, whole
from vstatics.core.tables.text import broken
from vstatics.synthesis.ratios.tables import number
from vstatics.synthesis.teeth.finding import FoundTeeth
from vstatics.synthesis.teeth.layout import named_ratios
from vstatics.synthesis.teeth.problem import TeethProblem
from vstatics.synthesis.teeth.solutions import TeethSolution

TEETH_WIDTH = 30
"""Number of letters in the column of teeth. Further teeth continue in the next row."""


def teeth_grids(result: FoundTeeth) -> Iterator[Grid]:
    """Yield tables of gears, tooth numbers, all solutions, and the number of candidates.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.synthesis.teeth.finding import find_teeth
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gears, teeth, *_ = teeth_grids(find_teeth(case, {"1": 4.0}))
    >>> gears.texts, teeth.texts
    ([['1', '4.0000', '4.0000', '0']], [['D1', 'sun 17, ring 51, planet 17', '4', '-3.0000']])
    """
    best = result.solutions[0]
    yield _wanted(result.problem, best)
    yield _teeth(result.problem, best)
    names = [layout.name for layout in result.problem.layouts]
    solutions: list[Values] = []
    for place, solution in enumerate(result.solutions, 1):
        teeth = ["/".join(map(str, solution.teeth[name].values())) for name in names]
        solutions.append((place, _error(solution.error), *teeth))
    yield grid_of("Solutions", ["solution", "error", *names], solutions)
    rows = (
        (table.layout.name, int(table.total), len(table.rows), len(table.ratios))
        for table in result.tables
    )
    yield grid_of("Choice", ["gear set", "teeth and planets", "teeth", "ratios"], rows)


def _error(value: float) -> Cell:
    return Cell(f"{value:.3g}" if value else "0", value, kind=float)


def _wanted(problem: TeethProblem, best: TeethSolution) -> Grid:
    targets = {target.name: target for target in problem.targets}
    rows = []
    of_sets = named_ratios(problem.layouts)
    sets = of_sets.keys() & targets.keys() - best.gears.keys()
    wanted = {name: best.ratios[part.name] for name, part in of_sets.items() if name in sets}
    for name, ratio in {**best.gears, **wanted}.items():
        target = targets.get(name)
        error = _error(float(target.apart(np.array(ratio)))) if target else None
        rows.append((name, number(target.wanted if target else None), exact(ratio, 4), error))
    return grid_of("Gears", ["gear", "wanted", "ratio", "error"], rows)


def _teeth(problem: TeethProblem, best: TeethSolution) -> Grid:
    rows = list[tuple[str, str, int | str | None, str, str]]()
    for layout in problem.layouts:
        counts = [f"{wheel} {count}," for wheel, count in best.teeth[layout.name].items()]
        counts[-1] = counts[-1].rstrip(",")
        teeth, *further = broken(counts, TEETH_WIDTH, indent="")
        ratios = ", ".join(f"{best.ratios[part.name]:.4f}" for part in layout.ratios)
        of_wheels = best.modules.get(layout.name, {}) if best.modules else {}
        modules = ", ".join(f"{wheel} {module:g}" for wheel, module in of_wheels.items())
        if len({*of_wheels.values()}) == 1:
            modules = f"{next(iter(of_wheels.values())):g}"
        rows.append((layout.name, teeth, best.planets.get(layout.name), ratios, modules))
        rows += [("", line, "", "", "") for line in further]
    modules = "modules [mm]"
    return grid_of(
        "Teeth",
        ("gear set", "teeth", "planets", "ratio", modules),
        rows,
        optional=[] if best.modules else [modules],
    )


def asked_grids(problem: TeethProblem) -> Iterator[Grid]:
    """Yield a table of the ranges of all gears, and the kind of each gear set."""
    limits = problem.limits
    rows = []
    for layout in problem.layouts:
        planets = ", ".join(map(str, sorted(limits.counts(layout)))) if layout.planets else "-"
        for wheel, (low, high) in zip(layout.wheels, limits.of_wheels(layout), strict=True):
            front = f"{layout.name}.{wheel}", whole(low), whole(high)
            rows.append((*front, planets, layout.element.kind))
    yield grid_of("Ranges", ["wheel", "from", "to", "planets", "kind"], rows)
