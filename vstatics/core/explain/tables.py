"""Explanations as tables: the matrix, the equations, their solution, signs and ratio."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from vstatics.core.explain import typeset
from vstatics.core.explain.explanation import Explanation
from vstatics.core.explain.sums import Equation, System, in_numbers, in_symbols
from vstatics.core.explain.text import reason, speaks_against, symbol_meaning
from vstatics.core.tables.grid import Cell, Column, Grid, Values, grid_of, whole, word
from vstatics.core.texts import tr


def explanation_grids(explained: Iterable[Explanation]) -> Iterator[Grid]:
    """The tables of gears; those of a gear share a sheet.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.core.explain import explain_gear
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> tables = explanation_grids([explain_gear(solve(case), 1)])
    >>> [table.title.partition(": ")[2] for table in tables]
    ['matrix', 'equations', 'solution', 'power signs', 'ratio']
    """
    for one in explained:
        for grid in _grids(one):
            if grid.rows:
                gear = tr("Gear {gear}", gear=one.gear)
                title = tr("Gear {gear}: {what}", gear=one.gear, what=tr(grid.title))
                yield grid._replace(title=title, group=gear)


def _grids(one: Explanation) -> Iterator[Grid]:
    yield from (matrix(one), _equations(one), _solution(one), _signs(one), _tried(one))
    yield _machines(one)
    yield _ratio(one)


def matrix(one: Explanation) -> Grid:
    """The structural-distribution matrix of what can carry torque."""
    columns = (Column(name, over="device") for name in one.columns)
    rows = zip(one.rows, one.matrix.tolist(), strict=True)
    return grid_of("matrix", ("link", *columns), ((name, *row) for name, row in rows))


def _systems(one: Explanation) -> Iterator[tuple[str, System]]:
    named = ("speeds", one.speeds), ("torques", one.torques), ("torques with losses", one.lossy)
    return ((name, system) for name, system in named if system is not None)


def _equations(one: Explanation) -> Grid:
    rows: list[Values] = [
        [word(name), equation.label, *(_typeset(equation, how) for how in (in_symbols, in_numbers))]
        for name, system in _systems(one)
        for equation in system.equations
    ]
    return grid_of("equations", ["of", "equation of", "in symbols", "in numbers"], rows)


def _typeset(equation: Equation, how: Callable[[Equation], list[str]]) -> Cell:
    return Cell(" ".join(how(equation)), math=typeset.equation(equation, how))


def _symbol(name: str) -> Cell:
    return Cell(name, math=typeset.symbol(name))


def _solution(one: Explanation) -> Grid:
    rows = [
        (word(name), _symbol(unknown), value)
        for name, system in _systems(one)
        for unknown, value in system.values.items()
    ]
    return grid_of("solution", ["of", "unknown", "value"], rows)


def _signs(one: Explanation) -> Grid:
    headings = "torque", "motion", "power", "sign", "ratio", "efficiency", "ratio with losses"
    rows = [(*sign[:4], whole(sign.sign), *sign[5:-1], sign.told) for sign in one.signs]
    return grid_of("power signs", ["mechanism", *headings, "why"], rows)


def _tried(one: Explanation) -> Grid:
    """All signs of a gear that is locked by friction."""
    rows: list[Values] = [
        (name, whole(sign), tried.lossy_ratios[name], tried.output_torque, speaks_against(tried))
        for tried in one.tried or ()
        for name, sign in tried.signs.items()
    ]
    headings = ["mechanism", "sign", "ratio with losses", "Mx", "but"]
    return grid_of("signs that do not agree", headings, rows)


def _machines(one: Explanation) -> Grid:
    """What each machine gives the battery, and what that is to get."""
    rows: list[Values] = []
    if one.balance is not None:
        rows = [tuple(share) for share in one.balance.shares]
        rows.append((word("battery"), None, None, one.balance.battery_kW))
    headings = "link", "to its machine, kW", "efficiency", "to the battery, kW"
    return grid_of("machines and battery", headings, rows)


def _ratio(one: Explanation) -> Grid:
    """The formula, then the values of its symbols."""
    ends = [typeset.symbol(name) for name in (one.input, one.output)]
    ratio = Cell(f"{one.input}/{one.output}", math=rf"\frac{{{ends[0]}}}{{{ends[1]}}}")
    rows: list[Values] = [
        (Cell("i", math="i"), Cell(reason(one.reason)) if one.reason else ratio, one.ratio)
    ]
    if one.formula is not None:
        right = Cell(one.formula.text, math=typeset.formula(one.formula))
        rows.append((_symbol(one.formula.left), right, one.formula.value))
        rows += (
            (_symbol(each.name), symbol_meaning(each.meaning), each.value)
            for each in one.formula.symbols
        )
        speeds = one.formula.speeds.items()
        rows += ((_symbol(name), word("given"), speed) for name, speed in speeds)
    return grid_of("ratio", ["symbol", "is", "value"], rows)
