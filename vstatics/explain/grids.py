"""Explanations as tables: the matrix, the equations, their solution, signs and ratio."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from vstatics.explain.equations import System
from vstatics.explain.explanation import Explanation
from vstatics.explain.sums import in_numbers, in_symbols
from vstatics.tables.grid import Column, Grid, Row, exact, text, whole


def grids(explained: Iterable[Explanation]) -> Iterator[Grid]:
    """The tables of gears; those of a gear share a sheet.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.explain import explain_gear
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> [table.title.partition(": ")[2] for table in grids([explain_gear(solve(case), 1)])]
    ['matrix', 'equations', 'solution', 'power signs', 'ratio']
    """
    for one in explained:
        for grid in (matrix(one), _equations(one), _solution(one), _signs(one), _ratio(one)):
            if grid.rows:
                gear = f"Gear {one.gear}"
                yield grid._replace(title=f"{gear}: {grid.title}", group=gear)


def matrix(one: Explanation) -> Grid:
    """The structural-distribution matrix of what can carry torque."""
    columns = [text("link"), *(Column(name, over="device") for name in one.columns)]
    rows: list[Row] = [
        [name, *map(exact, row)] for name, row in zip(one.rows, one.matrix.tolist(), strict=True)
    ]
    return Grid("matrix", columns, rows)


def _systems(one: Explanation) -> Iterator[tuple[str, System]]:
    named = ("speeds", one.speeds), ("torques", one.torques), ("torques with losses", one.lossy)
    return ((name, system) for name, system in named if system is not None)


def _equations(one: Explanation) -> Grid:
    columns = [text("of"), text("equation of"), text("in symbols"), text("in numbers")]
    rows: list[Row] = [
        [name, equation.of, " ".join(in_symbols(equation)), " ".join(in_numbers(equation))]
        for name, system in _systems(one)
        for equation in system.equations
    ]
    return Grid("equations", columns, rows)


def _solution(one: Explanation) -> Grid:
    columns = [text("of"), text("unknown"), Column("value")]
    rows: list[Row] = [
        [name, unknown, exact(value)]
        for name, system in _systems(one)
        for unknown, value in system.values.items()
    ]
    return Grid("solution", columns, rows)


def _signs(one: Explanation) -> Grid:
    headings = "torque", "motion", "power", "sign", "ratio", "efficiency", "ratio with losses"
    columns = [text("mechanism"), *map(Column, headings), text("why")]
    rows: list[Row] = [
        [
            sign.mechanism,
            *map(exact, (sign.torque, sign.motion, sign.power)),
            whole(sign.sign),
            *map(exact, (sign.ratio, sign.efficiency, sign.lossy_ratio)),
            sign.why,
        ]
        for sign in one.signs
    ]
    return Grid("power signs", columns, rows)


def _ratio(one: Explanation) -> Grid:
    """The formula, then the values of its symbols."""
    columns = [text("symbol"), text("is"), Column("value")]
    rows: list[Row] = [["i", one.reason or f"{one.input}/{one.output}", exact(one.ratio)]]
    if one.formula is not None:
        rows.append([one.formula.left, one.formula.text, exact(one.formula.value)])
        rows += ([one.name, one.meaning, exact(one.value)] for one in one.formula.symbols)
        rows += ([name, "given", exact(speed)] for name, speed in one.formula.speeds.items())
    return Grid("ratio", columns, rows)
