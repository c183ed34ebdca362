"""Sweeps against sweeps: variants by their number, columns by their name."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from itertools import groupby, zip_longest
from operator import attrgetter

from vstatics.comparison.numbers import (
    ATOL,
    NOT_THERE,
    RTOL,
    THERE,
    Difference,
    is_same,
    shown,
)
from vstatics.errors import plural
from vstatics.tables.quantities import BY_NAME
from vstatics.tables.written_results import Figure, WrittenSweep

VARIANT = "variant "
MOST_TOLD_NUMBERS = 20
"""So many numbers of a column are told."""


def sweep_places(
    actual: WrittenSweep,
    expected: WrittenSweep,
    *,
    atol: float = ATOL,
    rtol: float = RTOL,
    leave_out: Container[str] = (),
) -> Iterator[Difference]:
    """Every place in which two sweeps differ: `table` is the column, `row` the variant.

    A variant that only one has is of the table `variant`, a column has no row.
    """
    here, there = (
        {row: place for place, row in enumerate(_rows(one))} for one in (actual, expected)
    )
    yield from (Difference("variant", *row, NOT_THERE, THERE) for row in there if row not in here)
    yield from (Difference("variant", *row, THERE, NOT_THERE) for row in here if row not in there)
    found, wanted = (
        {name: column for name, column in one.columns.items() if _table(name) not in leave_out}
        for one in (actual, expected)
    )
    yield from (Difference(n, "", "", NOT_THERE, THERE) for n in wanted if n not in found)
    yield from (Difference(n, "", "", THERE, NOT_THERE) for n in found if n not in wanted)
    both = [(row, here[row], place) for row, place in there.items() if row in here]
    for row, one, other in both:
        if actual.status[one] != expected.status[other]:
            yield Difference("status", *row, actual.status[one], expected.status[other])
    for name in (name for name in wanted if name in found):
        for row, one, other in both:
            values = found[name][one], wanted[name][other]
            if not is_same(Figure(values[0]), Figure(values[1]), atol, rtol):
                yield Difference(name, *row, *values)


def sweep_lines(found: Iterable[Difference]) -> Iterator[str]:
    """Such places in words, a line each; the first ones of a column.

    Parameters
    ----------
    found : iterable of Difference
        Those of `sweep_places`, in their order.
    """
    for kind, ones in groupby(found, _kind_that_lacks):
        if not kind:
            for column, places in groupby(ones, attrgetter("table")):
                yield from _first([_line(one) for one in places], column)
            continue
        for side, some in groupby(ones, attrgetter("actual")):
            names = [_row(one) if kind == "variant" else one.table for one in some]
            yield _lacking(kind, names, is_there=side == THERE)


def _kind_that_lacks(one: Difference) -> str:
    """What one of the sweeps has not: a variant, a column, or nothing."""
    if one.table == "variant":
        return "variant"
    return "" if one.row else "column"


def _row(one: Difference) -> str:
    number = one.row.removeprefix(VARIANT)
    return f"{number}, gear {one.gear}" if one.gear else number


def _line(one: Difference) -> str:
    values = [each if isinstance(each, str) else shown(each) for each in one[3:]]
    return f"variant {_row(one)}, {one.table}: {values[0]}, expected {values[1]}"


def _rows(sweep: WrittenSweep) -> list[tuple[str, str]]:
    """What names each row: its variant, and its gear where it has one."""
    pairs = zip_longest(sweep.variants, sweep.gears, fillvalue="")
    return [(f"{VARIANT}{number}", gear) for number, gear in pairs]


def _table(column: str) -> str:
    """The key of the table that a column is of, such as ``W[C1,low]``."""
    quantity = BY_NAME.get(column.partition("[")[0])
    return quantity.key if quantity else ""


def _first(told: Sequence[str], column: str) -> Iterator[str]:
    yield from told[:MOST_TOLD_NUMBERS]
    if len(told) > MOST_TOLD_NUMBERS:
        yield f"{column}: {len(told) - MOST_TOLD_NUMBERS} more variants differ"


def _lacking(kind: str, names: Sequence[str], *, is_there: bool) -> str:
    """One line for all of a kind."""
    more = len(names) - MOST_TOLD_NUMBERS
    told = ", ".join(names[:MOST_TOLD_NUMBERS]) + f" and {more} more" * (more > 0)
    side = "there, but not expected" if is_there else "not there, expected"
    return f"{plural(kind, len(names))} {told}: {side}"
