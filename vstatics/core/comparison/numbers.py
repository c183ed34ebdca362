"""Comparison of results number by number, for example with expected results in CI."""

from __future__ import annotations

import math
from collections.abc import Container, Generator, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.comparison.namesakes import renaming
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.tolerances import ATOL, ROUNDED_PART, RTOL
from vstatics.core.statics.result_arrays import row_names
from vstatics.core.tables.quantities import BY_NAME, QUANTITIES, Quantity
from vstatics.core.tables.written_results import Figure, Figures, WrittenResult


class Difference(NamedTuple):
    """Number that differs from the expected number, or table whose shape differs."""

    table: str
    row: str
    gear: str
    """Name of the gear, or of the device in the distribution matrix."""
    actual: float | str
    """Actual number (NaN if missing), or text if a whole gear, table or row differs."""
    expected: float | str

    @property
    def deviation(self) -> float:
        """Deviation relative to the magnitude of the expected number [-]; NaN if undefined."""
        if isinstance(self.actual, str) or isinstance(self.expected, str) or not self.expected:
            return math.nan
        deviation = (self.actual - self.expected) / abs(self.expected)
        return deviation if math.isfinite(deviation) else math.nan

    @property
    def shown_deviation(self) -> float:
        """Deviation for output [-]; NaN also if the expected number is only a rounding error."""
        if not isinstance(self.expected, str) and abs(self.expected) <= ATOL:
            return math.nan
        return self.deviation


NOT_THERE, THERE = "not there", "there"


def differences(
    actual: WrittenResult,
    expected: WrittenResult,
    *,
    atol: float = ATOL,
    rtol: float = RTOL,
    leave_out: Container[str] = (),
) -> Iterator[Difference]:
    """Yield all differences between two results.

    Numbers agree if ``|actual - expected| <= atol + rtol*|expected|``. A number from a listing can
    also differ by half a unit of its last digit. A missing number agrees only with a missing
    number. Tables that are not in the published listing are compared if both results contain them.
    Gears are matched by name if the results have a common gear name, otherwise by number.

    Parameters
    ----------
    actual, expected : WrittenResult
    atol, rtol : float
        Absolute and relative tolerance.
    leave_out : container of str
        Names of tables that are not compared, as in `Quantity.name`.
    """
    if actual.errors or expected.errors:
        if actual.errors != expected.errors:
            shown = {True: "a case in error", False: "a result"}
            yield Difference("case", "", "", shown[actual.errors], shown[expected.errors])
        return
    gears = expected.gear_names or actual.gear_names
    if set(actual.gear_names) & set(expected.gear_names):
        actual, expected, gears = yield from same_gears(actual, expected)
    renamed = renaming(actual, expected)
    for quantity in QUANTITIES:
        if quantity.name in leave_out:
            continue
        here, there = actual.tables.get(quantity.name), expected.tables.get(quantity.name)
        if here is None or there is None:
            yield from _lacking(quantity, actual, expected)
        else:
            names = _PlaceNames(quantity, expected.case or actual.case, gears)
            rows = _rows(quantity, actual, expected)
            if all(rows):
                rows[0] = [renamed(name, quantity.rows) for name in rows[0]]
                names.rows, here, there = yield from _by_name(quantity.name, rows, (here, there))
            devices = [renamed(name) for name in actual.device_names], expected.device_names
            if quantity.columns == "devices" and all(devices):
                paired = _same_devices(quantity.name, devices, (here, there))
                names.columns, here, there = yield from paired
            yield from _table(names, here, there, atol, rtol)


def same_gears(
    actual: WrittenResult, expected: WrittenResult
) -> Generator[Difference, None, tuple[WrittenResult, WrittenResult, Sequence[str]]]:
    """Yield a difference for each gear of only one result; return results with common gears.

    Returns
    -------
    actual, expected : WrittenResult
    gears : sequence of str
        Names of the common gears.
    """
    here, there = (
        {name: place for place, name in enumerate(result.gear_names)}
        for result in (actual, expected)
    )
    yield from (Difference("", "", old, NOT_THERE, THERE) for old in there if old not in here)
    yield from (Difference("", "", new, THERE, NOT_THERE) for new in here if new not in there)
    both = [name for name in there if name in here]
    actual = _with_gears(actual, [here[name] for name in both])
    return actual, _with_gears(expected, [there[name] for name in both]), both


def _with_gears(result: WrittenResult, places: Sequence[int]) -> WrittenResult:
    """Return a result with only some gears, by index. Tables without gears do not change."""
    count, tables = len(result.gear_names), dict[str, Figures]()
    for key, rows in result.tables.items():
        is_by_gear = BY_NAME[key].columns != "devices" and all(len(row) == count for row in rows)
        tables[key] = [[row[place] for place in places] for row in rows] if is_by_gear else rows
    return result._replace(tables=tables)


def _rows(
    quantity: Quantity, actual: WrittenResult, expected: WrittenResult
) -> list[Sequence[str]]:
    """Return the row names of a table in both results; empty if a name is repeated.

    Names in a result take precedence over names from its case, because the rows of a drawn case are
    not mechanisms.
    """
    both = actual, expected
    rows = [result.rows.get(quantity.name, ()) for result in both]
    if any(rows) or all(result.case for result in both):
        rows = [names or _named(result, quantity) for names, result in zip(rows, both, strict=True)]
    if any(len({*names}) != len(names) for names in rows):
        rows = [(), ()]
    return rows


def _named(result: WrittenResult, quantity: Quantity) -> Sequence[str]:
    """Return the row names of a table from the case; empty if the number of rows differs."""
    case = None if result.is_of_source else result.case
    names = row_names(case, quantity.rows) if case else ()
    return names if len(names) == len(result.tables[quantity.name]) else ()


def _by_name(
    table: str, names: Sequence[Sequence[str]], figures: Sequence[Figures]
) -> Generator[Difference, None, tuple[Sequence[str], Figures, Figures]]:
    """Yield a difference for each row of only one result; return common names and values."""
    here, there = (dict(zip(*pair, strict=True)) for pair in zip(names, figures, strict=True))
    yield from (Difference(table, new, "", THERE, NOT_THERE) for new in here if new not in there)
    yield from (Difference(table, old, "", NOT_THERE, THERE) for old in there if old not in here)
    both = [name for name in there if name in here]
    return both, [here[name] for name in both], [there[name] for name in both]


def _same_devices(
    table: str, names: Sequence[Sequence[str]], figures: Sequence[Figures]
) -> Generator[Difference, None, tuple[Sequence[str], Figures, Figures]]:
    """Yield a difference for each column of only one result; return common columns."""
    is_whole = all(
        rows and {len(row) for row in rows} == {len({*devices})}
        for devices, rows in zip(names, figures, strict=True)
    )
    if not is_whole:
        return names[1], figures[0], figures[1]
    turned = [[list(column) for column in zip(*rows, strict=True)] for rows in figures]
    both, *same = yield from _by_name(table, names, turned)
    here, there = ([list(row) for row in zip(*columns, strict=True)] for columns in same)
    return both, here, there


def _lacking(
    quantity: Quantity, actual: WrittenResult, expected: WrittenResult
) -> Iterator[Difference]:
    """Yield a difference for a table that only one of the results has.

    An empty table is ignored, because it is not printed. A published listing lacks only tables of
    the published report.
    """
    is_new = quantity.name in actual.tables
    owner, other = (actual, expected) if is_new else (expected, actual)
    is_filled = any(owner.tables.get(quantity.name, ()))
    if is_filled and (quantity.published or not other.is_of_source):
        values = (THERE, NOT_THERE) if is_new else (NOT_THERE, THERE)
        yield Difference(quantity.name, "", "", *values)


class _PlaceNames:
    """Names of the rows and columns of a table, or numbers if names are unknown."""

    def __init__(self, quantity: Quantity, case: Transmission | None, gears: Sequence[str]) -> None:
        self.table = quantity.name
        self.is_list = quantity.rows == "one"
        self.rows: Sequence[str] = row_names(case, quantity.rows) if case else ()
        self.columns = gears
        if quantity.columns == "devices":
            self.columns = case.devices if case else ()

    def row(self, number: int) -> str:
        if self.is_list:
            return ""
        return self.rows[number] if number < len(self.rows) else str(number + 1)

    def column(self, number: int) -> str:
        return self.columns[number] if number < len(self.columns) else str(number + 1)


def _table(
    names: _PlaceNames, here: Figures, there: Figures, atol: float, rtol: float
) -> Iterator[Difference]:
    if len(here) != len(there):
        yield Difference(names.table, "", "", f"{len(here)} rows", f"{len(there)} rows")
        return
    for number, (row, other) in enumerate(zip(here, there, strict=True)):
        if len(row) != len(other):
            counts = f"{len(row)} columns", f"{len(other)} columns"
            yield Difference(names.table, names.row(number), "", *counts)
            continue
        for column, (figure, expected) in enumerate(zip(row, other, strict=True)):
            if not is_same(figure, expected, atol, rtol):
                place = names.table, names.row(number), names.column(column)
                yield Difference(*place, figure.value, expected.value)


def is_same(actual: Figure, expected: Figure, atol: float, rtol: float) -> bool:
    """Return whether two numbers agree within the tolerances; see `differences`."""
    if math.isnan(actual.value) or math.isnan(expected.value):
        return math.isnan(actual.value) and math.isnan(expected.value)
    slack = max(actual.slack, expected.slack) * (1 + ROUNDED_PART)  # includes rounding
    return abs(actual.value - expected.value) <= slack + atol + rtol * abs(expected.value)


def shown(value: float) -> str:
    """Return a number as text, for the output of a difference."""
    return "no value" if math.isnan(value) else repr(value)
