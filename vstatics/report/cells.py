"""Tables of the page: cells with numbers that keep all their digits for sorting."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.report.markup import Markup, joined, tag
from vstatics.statics.results import Results
from vstatics.tables.grid import Column, Grid, number
from vstatics.tables.table import Table
from vstatics.tables.values import tables

LARGE = 1e7
"""From here on numbers are written with a power of ten."""
YES, NO = "●", "·"


class Cell(NamedTuple):
    """A cell of a table."""

    text: str
    value: float | None = None
    """What the text is rounded from; None in a cell of words, NaN for what does not exist."""
    says: str = ""
    """What a sign means, for those who do not see it."""


def numeric(value: float | None, decimals: int = 3) -> Cell:
    """A number as a cell; None does not exist.

    >>> numeric(0.98765), numeric(-1.5e9).text, numeric(None).text
    (Cell(text='.988', value=0.98765, says=''), '-1.5e+09', '-')
    """
    known = math.nan if value is None else value
    if LARGE <= abs(known) < math.inf:
        return Cell(f"{known:.6g}", known)
    return Cell(number(known, decimals), known)


def sign(value: float | None, meaning: str = "yes") -> Cell:
    """A dot for what is so; NaN or None where it is unknown."""
    if value is None or math.isnan(value):
        return Cell("-", math.nan)
    return Cell(YES, 1.0, meaning) if value else Cell(NO, 0.0, "no")


def table(
    title: str,
    columns: Sequence[Column],
    rows: Sequence[Sequence[Cell | str]],
    levels: Sequence[int] = (),
) -> Markup:
    """A table with its title; the first column names the rows.

    Parameters
    ----------
    levels : sequence of int, optional
        How far each row is set in; it stays below the row that it belongs to.
    """
    heads = (tag("th", one.heading, scope="col", class_=_kind(one)) for one in columns)
    depth = levels or [0] * len(rows)
    body = (_row(columns, row, level) for row, level in zip(rows, depth, strict=True))
    inner = tag("table", tag("thead", tag("tr", *heads)), tag("tbody", *body))
    scrolled = tag("div", inner, class_="scroll", tabindex=0, role="region", aria_label=title)
    return tag("section", tag("h3", title), scrolled, class_="table")


def _kind(column: Column) -> str:
    return "number" if column.is_number else "words"


def _row(columns: Sequence[Column], row: Sequence[Cell | str], level: int) -> Markup:
    cells = [
        _cell(column, cell if isinstance(cell, Cell) else Cell(cell), level, is_name=not place)
        for place, (column, cell) in enumerate(zip(columns, row, strict=True))
    ]
    return tag("tr", *cells, data_level=level or False)


def _cell(column: Column, cell: Cell, level: int, *, is_name: bool) -> Markup:
    text = tag("span", cell.text, role="img", aria_label=cell.says) if cell.says else cell.text
    if is_name:
        return tag("th", text, scope="row", class_=f"level{level}" if level > 1 else False)
    value: object = False
    if cell.value is not None:
        value = "" if math.isnan(cell.value) else repr(float(cell.value))
    kind = "sign" if cell.text in (YES, NO) else _kind(column)
    return tag("td", text, class_=kind, data_value=value)


def of_grid(grid: Grid) -> Markup:
    """A grid of texts as a table; one without rows is its title."""
    return table(grid.title, grid.columns, grid.rows) if grid.rows else tag("p", grid.title)


def of_results(results: Results) -> Iterator[Markup]:
    """All tables of the results: lists over gears together, then the others."""
    found = tables(results)
    yield _by_gear([one for one in found if one.quantity.rows == "one"])
    matrix_last = sorted(found, key=lambda one: one.quantity.columns == "devices")
    for one in matrix_last:
        if one.quantity.rows != "one" and one.values.size:
            yield _of_table(one)


def _by_gear(lists: Sequence[Table]) -> Markup:
    """A row for each gear, with the quantities of one number."""
    columns = [Column("gear", is_number=False)]
    columns += [Column(one.quantity.key.replace("_", " ")) for one in lists]
    rows = [
        [Cell(gear), *(_number(one, float(one.values[0, place])) for one in lists)]
        for place, gear in enumerate(lists[0].columns)
    ]
    return table("By gear", columns, rows)


def _of_table(one: Table) -> Markup:
    columns = [Column(_ROWS[one.quantity.rows], is_number=False), *map(Column, one.columns)]
    rows = [
        [Cell(name), *(_number(one, value) for value in values)]
        for name, values in zip(one.rows, one.values.tolist(), strict=True)
    ]
    return table(f"{one.quantity.title} [{one.quantity.key}]", columns, rows)


_ROWS = {
    "links": "link",
    "elements": "element",
    "mechanisms": "mechanism",
    "torques": "torque of",
    "meshes": "mesh",
}


def _number(one: Table, value: float) -> Cell:
    if one.quantity.kind is bool:
        return sign(value)
    if one.quantity.kind is int:
        return numeric(value, 0)
    return numeric(value, one.quantity.decimals)


def listed(entries: Sequence[tuple[str, str]]) -> Markup:
    """Terms, each with what it is."""
    return tag("dl", joined(*(joined(tag("dt", one), tag("dd", text)) for one, text in entries)))
