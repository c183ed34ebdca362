"""Sweeps against sweeps: variants by their number, columns by their name."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from itertools import zip_longest

from vstatics.comparison.numbers import ATOL, RTOL, is_same, shown
from vstatics.errors import plural
from vstatics.tables.quantities import BY_NAME
from vstatics.tables.written_results import Figure, WrittenSweep

MOST_TOLD_NUMBERS = 20
"""So many numbers of a column are told."""


def sweep_differences(
    actual: WrittenSweep,
    expected: WrittenSweep,
    *,
    atol: float = ATOL,
    rtol: float = RTOL,
    leave_out: Container[str] = (),
) -> Iterator[str]:
    """Every place in which two sweeps differ, a line each; the first ones of a column.

    Parameters
    ----------
    leave_out : container of str
        Keys of tables, `Quantity.key`, whose columns are not compared.
    """
    here, there = (
        {number: place for place, number in enumerate(_rows(one))} for one in (actual, expected)
    )
    yield from _lacking("variant", [n for n in there if n not in here], "expected")
    yield from _lacking("variant", [n for n in here if n not in there], "not expected")
    found, wanted = (
        {name: column for name, column in one.columns.items() if _table(name) not in leave_out}
        for one in (actual, expected)
    )
    yield from _lacking("column", [name for name in wanted if name not in found], "expected")
    yield from _lacking("column", [name for name in found if name not in wanted], "not expected")
    both = [number for number in there if number in here]
    told = [
        f"variant {number}, status: {actual.status[here[number]]}, "
        f"expected {expected.status[there[number]]}"
        for number in both
        if actual.status[here[number]] != expected.status[there[number]]
    ]
    yield from _first(told, "status")
    for name in (name for name in wanted if name in found):
        pairs = (
            (number, found[name][here[number]], wanted[name][there[number]]) for number in both
        )
        told = [
            f"variant {number}, {name}: {shown(one)}, expected {shown(other)}"
            for number, one, other in pairs
            if not is_same(Figure(one), Figure(other), atol, rtol)
        ]
        yield from _first(told, name)


def _rows(sweep: WrittenSweep) -> list[str]:
    """What names each row: the number of its variant, and its gear where it has one."""
    pairs = zip_longest(map(str, sweep.variants), sweep.gears, fillvalue="")
    return [f"{number}, gear {gear}" if gear else number for number, gear in pairs]


def _table(column: str) -> str:
    """The key of the table that a column is of, such as ``W[C1,low]``."""
    quantity = BY_NAME.get(column.partition("[")[0])
    return quantity.key if quantity else ""


def _first(told: Sequence[str], column: str) -> Iterator[str]:
    yield from told[:MOST_TOLD_NUMBERS]
    if len(told) > MOST_TOLD_NUMBERS:
        yield f"{column}: {len(told) - MOST_TOLD_NUMBERS} more variants differ"


def _lacking(kind: str, names: Sequence[str], what: str) -> Iterator[str]:
    """One line for all of a kind."""
    if names:
        shown = ", ".join(
            names[:MOST_TOLD_NUMBERS]
        ) + f" and {len(names) - MOST_TOLD_NUMBERS} more" * (len(names) > MOST_TOLD_NUMBERS)
        side = "not there, expected" if what == "expected" else "there, but not expected"
        yield f"{plural(kind, len(names))} {shown}: {side}"
