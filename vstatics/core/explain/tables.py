"""Explanations as tables: matrix, equations, solution, signs and ratio."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from vstatics.core.explain import typeset
from vstatics.core.explain.explanation import Explanation
from vstatics.core.explain.sums import Equation, System, in_numbers, in_symbols
from vstatics.core.explain.text import reason, speaks_against, symbol_meaning
from vstatics.core.tables.grid import Cell, Column, Grid, Values, grid_of, whole, word
from vstatics.core.texts import tr


def explanation_grids(explained: Iterable[Explanation]) -> Iterator[Grid]:
    """Yield the tables of gears. In a workbook, all tables of a gear are on a common sheet.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.core.explain import explain_gear
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> tables = explanation_grids([explain_gear(solve(case), 1)])
    >>> [table.title.partition(": ")[2] for table in tables]
    ['matrix', 'equations', 'solution', 'power signs', 'ratio']
    """
    for explanation in explained:
        for grid in _grids(explanation):
            if grid.rows:
                gear = tr("Gear {gear}", gear=explanation.gear)
                title = tr("Gear {gear}: {what}", gear=explanation.gear, what=tr(grid.title))
                yield grid._replace(title=title, group=gear)


def _grids(explanation: Explanation) -> Iterator[Grid]:
    yield from (
        matrix(explanation),
        _equations(explanation),
        _solution(explanation),
        _signs(explanation),
        _tried(explanation),
    )
    yield _converters(explanation)
    yield _machines(explanation)
    yield _ratio(explanation)


def matrix(explanation: Explanation) -> Grid:
    """Return the structural-distribution matrix of devices that can carry torque."""
    columns = (Column(name, over="component") for name in explanation.columns)
    rows = zip(explanation.rows, explanation.matrix.tolist(), strict=True)
    return grid_of("matrix", ("link", *columns), ((name, *row) for name, row in rows))


def _systems(explanation: Explanation) -> Iterator[tuple[str, System]]:
    named = (
        ("speeds", explanation.speeds),
        ("torques", explanation.torques),
        ("torques with losses", explanation.lossy),
    )
    return ((name, system) for name, system in named if system is not None)


def _equations(explanation: Explanation) -> Grid:
    rows: list[Values] = [
        [word(name), equation.label, *(_typeset(equation, how) for how in (in_symbols, in_numbers))]
        for name, system in _systems(explanation)
        for equation in system.equations
    ]
    return grid_of("equations", ["of", "equation of", "in symbols", "in numbers"], rows)


def _typeset(equation: Equation, how: Callable[[Equation], list[str]]) -> Cell:
    return Cell(" ".join(how(equation)), math=typeset.equation(equation, how))


def _symbol(name: str) -> Cell:
    return Cell(name, math=typeset.symbol(name))


def _solution(explanation: Explanation) -> Grid:
    rows = [
        (word(name), _symbol(unknown), value)
        for name, system in _systems(explanation)
        for unknown, value in system.values.items()
    ]
    return grid_of("solution", ["of", "unknown", "value"], rows)


def _signs(explanation: Explanation) -> Grid:
    headings = "torque", "motion", "power", "sign", "ratio", "efficiency", "ratio with losses"
    rows = [(*sign[:4], whole(sign.sign), *sign[5:-1], sign.told) for sign in explanation.signs]
    return grid_of("power signs", ["mechanism", *headings, "why"], rows)


def _tried(explanation: Explanation) -> Grid:
    """Return the table of sign combinations of a self-locking gear, with their contradictions."""
    rows: list[Values] = [
        (name, whole(sign), tried.lossy_ratios[name], tried.output_torque, speaks_against(tried))
        for tried in explanation.tried or ()
        for name, sign in tried.signs.items()
    ]
    headings = ["mechanism", "sign", "ratio with losses", "Mx", "but"]
    return grid_of("signs that do not agree", headings, rows)


def _converters(explanation: Explanation) -> Grid:
    headings = "speed ratio", "K", "lambda", "speed, rad/s", "torque, N*m"
    return grid_of("converters", ["converter", *headings], explanation.converters or ())


def _machines(explanation: Explanation) -> Grid:
    rows: list[Values] = []
    if explanation.balance is not None:
        rows = [tuple(share) for share in explanation.balance.shares]
        rows.append((word("battery"), None, None, explanation.balance.battery_kW))
    headings = "link", "to its machine, kW", "efficiency", "to the battery, kW"
    return grid_of("machines and battery", headings, rows)


def _ratio(explanation: Explanation) -> Grid:
    ends = [typeset.symbol(name) for name in (explanation.input, explanation.output)]
    ratio = Cell(
        f"{explanation.input}/{explanation.output}", math=rf"\frac{{{ends[0]}}}{{{ends[1]}}}"
    )
    rows: list[Values] = [
        (
            Cell("i", math="i"),
            Cell(reason(explanation.reason)) if explanation.reason else ratio,
            explanation.ratio,
        )
    ]
    if explanation.formula is not None:
        right = Cell(explanation.formula.text, math=typeset.formula(explanation.formula))
        rows.append((_symbol(explanation.formula.left), right, explanation.formula.value))
        rows += (
            (_symbol(each.name), symbol_meaning(each.meaning), each.value)
            for each in explanation.formula.symbols
        )
        speeds = explanation.formula.speeds.items()
        rows += ((_symbol(name), word("given"), speed) for name, speed in speeds)
    return grid_of("ratio", ["symbol", "is", "value"], rows)
