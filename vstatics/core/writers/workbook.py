"""Writes cases as workbooks (XLSX); read again they are equal to the last bit."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import Any

from vstatics.core.errors import CaseError
from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.workbook.cells import MOST_CELL_CHARACTERS, MOST_COLUMNS, MOST_ROWS
from vstatics.core.readers.workbook.sheets import (
    CASE_SHEET,
    ENGAGED,
    GEARS,
    LINKS,
    PART_SHEETS,
    Part,
    can_be_path,
    flow_cell,
    path_cell,
    quoted_path_cell,
    text_cell,
)
from vstatics.core.tables.xlsx import sheet_data
from vstatics.core.writers.named import mapping

_Row = list[Any]
_Values = Iterator[tuple[tuple[Part, ...], Any]]
"""Each with its path."""


def write(case: Transmission) -> bytes:
    """A case as a workbook: a sheet for links, shift elements, mechanisms or elements, and gears.

    Raises
    ------
    CaseError
        If openpyxl is missing, or the case is larger than sheets that are read.
    """
    require("xlsx", "a case in XLSX")
    return sheet_data(sheets(mapping(case)))


def sheets(data: Mapping[str, Any]) -> dict[str, list[_Row]]:
    """The sheets of a case that is given as plain data, the first row of each its headings.

    Raises
    ------
    CaseError
        If the case is larger than sheets that are read.

    Examples
    --------
    >>> made = sheets({
    ...     "name": "box", "links": ["a", "b"], "shift_elements": {"B": ["b", "housing"]},
    ...     "mechanisms": {"D": {"first": "a", "second": "b", "ratio": 2.0}},
    ...     "gears": {"low": {"engaged": ["B"], "speeds": {"a": 0.5}}, "free": {}}})
    >>> made["case"], made["links"]
    ([['path', 'value'], ['name', 'box']], [['name'], ['a'], ['b']])
    >>> made["shift_elements"]
    [['name', 'first', 'second'], ['B', 'b', 'housing']]
    >>> made["gears"]
    [['name', 'B', 'speeds.a'], ['low', 'x', 0.5], ['free', None, None]]
    """
    rest = dict(data)
    made: dict[str, list[_Row]] = {CASE_SHEET: []}
    if isinstance(rest.get(LINKS), list):
        made[LINKS] = [["name"], *([_cell(name)] for name in rest.pop(LINKS))]
    names = list(map(str, rest.get("shift_elements", {})))
    for key in PART_SHEETS:
        if rest.get(key):
            parts = rest.pop(key)
            made[key] = _gears(parts, names) if key == GEARS else _parts(parts, key)
    made[CASE_SHEET] = [["path", "value"], *([path_cell(path), one] for path, one in _flat(rest))]
    for name, rows in made.items():
        if len(rows) > MOST_ROWS or len(rows[0]) > MOST_COLUMNS:
            message = f"the sheet {name} would have more than {MOST_ROWS} rows or {MOST_COLUMNS}"
            raise CaseError("E119", f"{message} columns; expected YAML or JSON, which hold them")
    return made


def _parts(parts: Mapping[str, Any], key: str) -> list[_Row]:
    """Rows of parts, a column for each path that one of them has."""
    first = {path: heading for heading, path in PART_SHEETS[key].first.items()}
    told: dict[str, dict[str, Any]] = {}
    for name, part in parts.items():
        whole, ends = part, []
        if first:  # a shift element, which may be its links alone
            whole = dict(part) if isinstance(part, dict) else {"links": part}
            ends = whole.pop("links")
        told[name] = {first["links", at]: _cell(one) for at, one in enumerate(ends, 1)}
        told[name] |= {path_cell(path): one for path, one in _flat(whole)}
    headings = dict.fromkeys([*first.values(), *(one for row in told.values() for one in row)])
    rows = [[_cell(str(name)), *map(row.get, headings)] for name, row in told.items()]
    return [["name", *headings], *rows]


def _gears(gears: Mapping[str, Any], names: Sequence[str]) -> list[_Row]:
    """Rows of gears: columns of shift elements, then of paths."""
    engaged = {name: list(map(str, gear.get("engaged", ()))) for name, gear in gears.items()}
    columns = _in_order(names, list(engaged.values()))
    place = {name: number for number, name in enumerate(columns)}
    headings = {name: text_cell(name) for name in columns}
    told: dict[str, dict[str, Any]] = {}
    for name, gear in gears.items():
        others = {key: value for key, value in gear.items() if key != "engaged"}
        told[name] = {}
        for path, one in _flat(others):
            heading = path_cell(path)
            taken = heading in headings.values()
            told[name][quoted_path_cell(path) if taken else heading] = one
    paths = list(dict.fromkeys(one for row in told.values() for one in row))
    rows = []
    for name, row in told.items():
        mine = engaged[name]
        ordered = mine == sorted(mine, key=place.__getitem__)
        marks = [
            None if one not in mine else ENGAGED if ordered else mine.index(one) + 1
            for one in columns
        ]
        rows.append([_cell(str(name)), *marks, *(row.get(one) for one in paths)])
    return [["name", *headings.values(), *paths], *rows]


def _in_order(names: Sequence[str], engaged: Sequence[Sequence[str]]) -> list[str]:
    """Shift elements in an order that is that of the engaged ones of all gears, where it can be."""
    best, kept = list(names), set[tuple[str, str]]()
    for elements in engaged:
        pairs = kept | {*pairwise(elements)}
        if pairs == kept:
            continue
        try:
            best, kept = _sorted(names, pairs), pairs
        except CycleError:  # its marks are numbers
            continue
    return best


def _sorted(names: Sequence[str], pairs: Collection[tuple[str, str]]) -> list[str]:
    """Names with the first of each pair before the second, else in their own order."""
    sorter = TopologicalSorter[str](dict.fromkeys(names, ()))
    for one, following in pairs:
        sorter.add(following, one)
    sorter.prepare()
    place = {name: number for number, name in enumerate(names)}
    ready, ordered = list[str](), list[str]()
    while sorter.is_active():
        ready = sorted([*ready, *sorter.get_ready()], key=place.__getitem__)
        ordered.append(ready.pop(0))
        sorter.done(ordered[-1])
    return ordered


def _flat(value: Mapping[str, Any], path: tuple[Part, ...] = ()) -> _Values:
    """The values of plain data, each with its path, as they stand in cells."""
    for key, one in value.items():
        yield from _flat_value(one, (*path, str(key)))


def _flat_value(value: Any, path: tuple[Part, ...]) -> _Values:
    if isinstance(value, dict):
        if value and can_be_path([*map(str, value)]):
            yield from _flat(value, path)
            return
        value = flow_cell(value)
    elif isinstance(value, list):
        told = flow_cell(value)
        if len(told) > MOST_CELL_CHARACTERS:
            for number, item in enumerate(value, 1):
                yield from _flat_value(item, (*path, number))
            return
        value = told
    else:
        value = _cell(value)
    yield path, value


def _cell(value: Any) -> Any:
    """A value as it stands in a cell.

    Raises
    ------
    CaseError
        If it is too long for one.
    """
    if isinstance(value, bool) or not isinstance(value, str):
        exact = isinstance(value, bool) or value == float(value)
        finite = isinstance(value, bool) or abs(value) < float("inf")
        return value if exact and finite else repr(value)
    told = text_cell(value)
    if len(told) > MOST_CELL_CHARACTERS:
        message = f"a text has {len(told)} characters, a cell at most {MOST_CELL_CHARACTERS}"
        raise CaseError("E119", f"{message}; expected YAML or JSON, which hold it")
    return told
