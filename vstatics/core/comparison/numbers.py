"""Results against results, number by number: for golden files in CI."""

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
    """A number, or the shape of a table, that is not as expected."""

    table: str
    row: str
    gear: str
    """Or the device, in AJK."""
    actual: float | str
    """NaN is no value; a text tells of a whole gear, table or row."""
    expected: float | str

    @property
    def is_number(self) -> bool:
        """Whether both are numbers, or none."""
        return not isinstance(self.actual, str) and not isinstance(self.expected, str)

    @property
    def deviation(self) -> float:
        """By the expected number without its sign; NaN where that is nothing or none."""
        if isinstance(self.actual, str) or isinstance(self.expected, str) or not self.expected:
            return math.nan
        deviation = (self.actual - self.expected) / abs(self.expected)
        return deviation if math.isfinite(deviation) else math.nan

    @property
    def told_deviation(self) -> float:
        """The same for people: NaN also where what is expected is rounding noise."""
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
    """Every place in which two results differ.

    A number from a listing matches anything within half of its last digit. Otherwise
    ``|actual - expected| <= atol + rtol*|expected|``. What does not exist matches
    only what does not exist. Tables that the report of the source lacks are compared
    where both results have them. Gears are those of the same name, where both tell names
    and have one in common; else those of the same number.

    Parameters
    ----------
    actual, expected : WrittenResult
    atol, rtol : float
    leave_out : container of str
        Keys of tables, `Quantity.key`, that are not compared.
    """
    if actual.errors or expected.errors:
        if actual.errors != expected.errors:
            shown = {True: "a case in error", False: "a result"}
            yield Difference("case", "", "", shown[actual.errors], shown[expected.errors])
        return
    gears = expected.gear_names or actual.gear_names
    if set(actual.gear_names) & set(expected.gear_names):
        actual, expected, gears = yield from same_gears(actual, expected)
    called = renaming(actual, expected)
    for quantity in QUANTITIES:
        if quantity.key in leave_out:
            continue
        here, there = actual.tables.get(quantity.key), expected.tables.get(quantity.key)
        if here is None or there is None:
            yield from _lacking(quantity, actual, expected)
        else:
            names = _PlaceNames(quantity, expected.case or actual.case, gears)
            rows = _rows(quantity, actual, expected)
            if all(rows):
                rows[0] = [called(name, quantity.rows) for name in rows[0]]
                names.rows, here, there = yield from _by_name(quantity.key, rows, (here, there))
            devices = [called(name) for name in actual.device_names], expected.device_names
            if quantity.columns == "devices" and all(devices):
                paired = _same_devices(quantity.key, devices, (here, there))
                names.columns, here, there = yield from paired
            yield from _table(names, here, there, atol, rtol)


def same_gears(
    actual: WrittenResult, expected: WrittenResult
) -> Generator[Difference, None, tuple[WrittenResult, WrittenResult, Sequence[str]]]:
    """Both results with the gears that both have, in one order; the others are a line each."""
    found, wanted = (
        {name: place for place, name in enumerate(one.gear_names)} for one in (actual, expected)
    )
    for name in wanted:
        if name not in found:
            yield Difference("", "", name, NOT_THERE, THERE)
    for name in found:
        if name not in wanted:
            yield Difference("", "", name, THERE, NOT_THERE)
    both = [name for name in wanted if name in found]
    pairs = (actual, found), (expected, wanted)
    one, other = (_picked(result, [places[name] for name in both]) for result, places in pairs)
    return one, other, both


def _picked(result: WrittenResult, places: Sequence[int]) -> WrittenResult:
    """A result with some of its gears; a table that has other columns is left as it is."""
    count, tables = len(result.gear_names), dict[str, Figures]()
    for key, rows in result.tables.items():
        is_by_gear = BY_NAME[key].columns != "devices" and all(len(row) == count for row in rows)
        tables[key] = [[row[place] for place in places] for row in rows] if is_by_gear else rows
    return result._replace(tables=tables)


def _rows(
    quantity: Quantity, actual: WrittenResult, expected: WrittenResult
) -> list[Sequence[str]]:
    """The names of a table's rows in both results.

    A drawn case has rows of its own, which are not those of mechanisms.
    """
    both = actual, expected
    rows = [one.rows.get(quantity.key, ()) for one in both]
    if any(rows) or all(one.case for one in both):
        rows = [own or _named(one, quantity) for own, one in zip(rows, both, strict=True)]
    if any(len({*names}) != len(names) for names in rows):
        rows = [(), ()]
    return rows


def _named(result: WrittenResult, quantity: Quantity) -> Sequence[str]:
    """The rows of a table by the case, where they are as many; the source has numbers only."""
    case = None if result.is_of_source else result.case
    names = row_names(case, quantity.rows) if case else ()
    return names if len(names) == len(result.tables[quantity.key]) else ()


def _by_name(
    table: str, names: Sequence[Sequence[str]], figures: Sequence[Figures]
) -> Generator[Difference, None, tuple[Sequence[str], Figures, Figures]]:
    """The rows that both results have, in one order, after those that only one has."""
    found, wanted = (dict(zip(*pair, strict=True)) for pair in zip(names, figures, strict=True))
    new = [name for name in found if name not in wanted]
    gone = [name for name in wanted if name not in found]
    for name in new:
        yield Difference(table, name, "", THERE, NOT_THERE)
    for name in gone:
        yield Difference(table, name, "", NOT_THERE, THERE)
    both = [name for name in wanted if name in found]
    return both, [found[name] for name in both], [wanted[name] for name in both]


def _same_devices(
    table: str, names: Sequence[Sequence[str]], figures: Sequence[Figures]
) -> Generator[Difference, None, tuple[Sequence[str], Figures, Figures]]:
    """The columns that both results have, in one order, after those that only one has."""
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
    """A table that only one of the results has.

    Empty tables are not printed; and a listing of the source has its own tables only.
    """
    one = actual if quantity.key in actual.tables else expected
    other = expected if one is actual else actual
    if not any(one.tables.get(quantity.key, ())):
        return
    if quantity.published or not other.is_of_source:
        found = (THERE, NOT_THERE) if one is actual else (NOT_THERE, THERE)
        yield Difference(quantity.key, "", "", *found)


class _PlaceNames:
    """Names of the rows and columns of a table, numbers where no case tells them."""

    def __init__(self, quantity: Quantity, case: Transmission | None, gears: Sequence[str]) -> None:
        self.table = quantity.key
        self.one = quantity.rows == "one"
        self.rows: Sequence[str] = row_names(case, quantity.rows) if case else ()
        self.columns = gears
        if quantity.columns == "devices":
            self.columns = case.devices if case else ()

    def row(self, number: int) -> str:
        if self.one:
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
        for column, (one, two) in enumerate(zip(row, other, strict=True)):
            if not is_same(one, two, atol, rtol):
                place = names.table, names.row(number), names.column(column)
                yield Difference(*place, one.value, two.value)


def is_same(one: Figure, two: Figure, atol: float, rtol: float) -> bool:
    """Whether two numbers agree as `differences` says."""
    if math.isnan(one.value) or math.isnan(two.value):
        return math.isnan(one.value) and math.isnan(two.value)
    slack = max(one.slack, two.slack) * (1 + ROUNDED_PART)  # .5 of a digit is itself rounded
    return abs(one.value - two.value) <= slack + atol + rtol * abs(two.value)


def shown(value: float) -> str:
    """A number in the words of a difference; NaN stands for no number."""
    return "no value" if math.isnan(value) else repr(value)
