"""Writer of cases as workbooks (XLSX). Reading the file gives an equal case."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import Any

from vstatics.core.errors import CaseError, Path
from vstatics.core.extras import require
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.workbook.cells import MOST_CELL_CHARACTERS, MOST_COLUMNS, MOST_ROWS
from vstatics.core.readers.workbook.sheets import (
    CASE_SHEET,
    ENGAGED,
    GEARS,
    LINKS,
    PART_SHEETS,
    can_be_path,
    flow_cell,
    path_cell,
    quoted_path_cell,
    text_cell,
)
from vstatics.core.tables.xlsx import sheet_data
from vstatics.core.writers.named import mapping

_Row = list[Any]
_Values = Iterator[tuple[Path, Any]]
"""Paths and their values."""


def write(case: Transmission) -> bytes:
    """Write a case as a workbook with sheets for links, shift elements, mechanisms and gears.

    Raises
    ------
    CaseError
        If openpyxl is missing, or the case is larger than the largest sheets that can be read.
    """
    require("xlsx", "a case in XLSX")
    return sheet_data(sheets(mapping(case)))


def sheets(data: Mapping[str, Any]) -> dict[str, list[_Row]]:
    """Return the sheets of a case in plain data. The first row of a sheet contains the headings.

    Raises
    ------
    CaseError
        If the case is larger than the largest sheets that can be read.

    Examples
    --------
    >>> rows = sheets({
    ...     "name": "box", "links": ["a", "b"], "shift_elements": {"B": ["b", "housing"]},
    ...     "mechanisms": {"D": {"first": "a", "second": "b", "ratio": 2.0}},
    ...     "gears": {"low": {"engaged": ["B"], "speeds": {"a": 0.5}}, "free": {}}})
    >>> rows["case"], rows["links"]
    ([['path', 'value'], ['name', 'box']], [['name'], ['a'], ['b']])
    >>> rows["shift_elements"]
    [['name', 'first', 'second'], ['B', 'b', 'housing']]
    >>> rows["gears"]
    [['name', 'B', 'speeds.a'], ['low', 'x', 0.5], ['free', None, None]]
    """
    others = dict(data)
    written: dict[str, list[_Row]] = {CASE_SHEET: []}
    if isinstance(others.get(LINKS), list):
        written[LINKS] = [["name"], *([_cell(name)] for name in others.pop(LINKS))]
    names = list(map(str, others.get("shift_elements", {})))
    for key in PART_SHEETS:
        if others.get(key):
            parts = others.pop(key)
            written[key] = _gears(parts, names) if key == GEARS else _parts(parts, key)
    written[CASE_SHEET] = [
        ["path", "value"],
        *([path_cell(path), value] for path, value in _flat(others)),
    ]
    for name, rows in written.items():
        if len(rows) > MOST_ROWS or len(rows[0]) > MOST_COLUMNS:
            message = f"the sheet {name} would have more than {MOST_ROWS} rows or {MOST_COLUMNS}"
            raise CaseError("E119", f"{message} columns; expected YAML or JSON, which hold them")
    return written


def _parts(parts: Mapping[str, Any], key: str) -> list[_Row]:
    first = {path: heading for heading, path in PART_SHEETS[key].first.items()}
    cells: dict[str, dict[str, Any]] = {}
    for name, part in parts.items():
        whole, ends = part, []
        if first:  # some shift elements have no keys except links
            whole = dict(part) if isinstance(part, dict) else {"links": part}
            ends = whole.pop("links")
        cells[name] = {first["links", end]: _cell(link) for end, link in enumerate(ends, 1)}
        cells[name] |= {path_cell(path): value for path, value in _flat(whole)}
    headings = dict.fromkeys(
        [*first.values(), *(heading for row in cells.values() for heading in row)]
    )
    rows = [[_cell(str(name)), *map(row.get, headings)] for name, row in cells.items()]
    return [["name", *headings], *rows]


def _gears(gears: Mapping[str, Any], names: Sequence[str]) -> list[_Row]:
    """Return a row for each gear, with columns for shift elements and for paths."""
    engaged = {name: list(map(str, gear.get("engaged", ()))) for name, gear in gears.items()}
    columns = _in_order(names, list(engaged.values()))
    place = {name: number for number, name in enumerate(columns)}
    headings = {name: text_cell(name) for name in columns}
    cells: dict[str, dict[str, Any]] = {}
    for name, gear in gears.items():
        others = {key: value for key, value in gear.items() if key != "engaged"}
        cells[name] = {}
        for path, value in _flat(others):
            heading = path_cell(path)
            taken = heading in headings.values()
            cells[name][quoted_path_cell(path) if taken else heading] = value
    paths = list(dict.fromkeys(path for row in cells.values() for path in row))
    rows = []
    for name, row in cells.items():
        elements = engaged[name]
        ordered = elements == sorted(elements, key=place.__getitem__)
        marks = [
            None if part not in elements else ENGAGED if ordered else elements.index(part) + 1
            for part in columns
        ]
        rows.append([_cell(str(name)), *marks, *map(row.get, paths)])
    return [["name", *headings.values(), *paths], *rows]


def _in_order(names: Sequence[str], engaged: Sequence[Sequence[str]]) -> list[str]:
    """Return shift elements in an order that suits the order within all gears, if possible."""
    best, known = list(names), set[tuple[str, str]]()
    for elements in engaged:
        pairs = known | {*pairwise(elements)}
        if pairs == known:
            continue
        try:
            best, known = _sorted(names, pairs), pairs
        except CycleError:  # numbers in the cells then state the order
            continue
    return best


def _sorted(names: Sequence[str], pairs: Collection[tuple[str, str]]) -> list[str]:
    sorter = TopologicalSorter[str](dict.fromkeys(names, ()))
    for name, following in pairs:
        sorter.add(following, name)
    sorter.prepare()
    place = {name: number for number, name in enumerate(names)}
    ready, ordered = list[str](), list[str]()
    while sorter.is_active():
        ready = sorted([*ready, *sorter.get_ready()], key=place.__getitem__)
        ordered.append(ready.pop(0))
        sorter.done(ordered[-1])
    return ordered


def _flat(value: Mapping[str, Any], path: Path = ()) -> _Values:
    """Yield the paths of plain data with the contents of cells."""
    for key, item in value.items():
        yield from _flat_value(item, (*path, str(key)))


def _flat_value(value: Any, path: Path) -> _Values:
    if isinstance(value, dict):
        if value and can_be_path([*map(str, value)]):
            yield from _flat(value, path)
            return
        value = flow_cell(value)
    elif isinstance(value, list):
        cell = flow_cell(value)
        if len(cell) > MOST_CELL_CHARACTERS:
            for number, item in enumerate(value, 1):
                yield from _flat_value(item, (*path, number))
            return
        value = cell
    else:
        value = _cell(value)
    yield path, value


def _cell(value: Any) -> Any:
    """Return the content of a cell.

    Raises
    ------
    CaseError
        If a text is too long for a cell.
    """
    if not isinstance(value, str):
        is_exact = value == float(value) and abs(value) < float("inf")
        return value if is_exact else repr(value)
    text = text_cell(value)
    if len(text) > MOST_CELL_CHARACTERS:
        message = f"a text has {len(text)} characters, a cell at most {MOST_CELL_CHARACTERS}"
        raise CaseError("E119", f"{message}; expected YAML or JSON, which hold it")
    return text
