"""Sweeps against sweeps: variants by their number, columns by their name."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from itertools import zip_longest

from vstatics.core.comparison.numbers import NOT_THERE, THERE, Difference, is_same
from vstatics.core.errors import plural
from vstatics.core.numerics.tolerances import ATOL, RTOL
from vstatics.core.tables.quantities import BY_NAME
from vstatics.core.tables.written_results import Figure, WrittenSweep

VARIANT = "variant "


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


def sweep_counts(
    actual: WrittenSweep, expected: WrittenSweep, leave_out: Container[str] = ()
) -> dict[str, int]:
    """How many variants, or rows of their gears, and columns both have."""
    rows, columns = (
        [set(names(one)) for one in (actual, expected)]
        for names in (_rows, lambda one: [n for n in one.columns if _table(n) not in leave_out])
    )
    row = "row" if actual.gears or expected.gears else "variant"
    return {row: len(rows[0] & rows[1]), "column": len(columns[0] & columns[1])}


def sweep_headline(found: Sequence[Difference], counts: Mapping[str, int]) -> str:
    """What is other in a sweep, in a line.

    >>> found = [Difference("ratio[1]", "variant 3", "", 2.5, 2.0)]
    >>> found += [Difference("variant", "variant 4", "", NOT_THERE, THERE)]
    >>> sweep_headline(found, {"variant": 9, "column": 2})
    '1 of 9 variants, 1 of 2 columns differ; 1 variant gone'
    """
    both = [one for one in found if one.row and one.table != "variant"]
    columns = {one.table for one in both}
    statuses = sum(one.table == "status" for one in both)
    differing = [len({(one.row, one.gear) for one in both}), len(columns - {"status"})]
    told = [
        f"{number} of {count} {plural(kind, count)}"
        for number, (kind, count) in zip(differing, counts.items(), strict=True)
        if number
    ]
    told += [f"{statuses} status{'es' * (statuses > 1)}"] * bool(statuses)
    parts = [f"{', '.join(told)} {'differ' if len(told) > 1 else 'differs'}"] * bool(told)
    row = next(iter(counts))
    for kind, lacking in (
        (row, [one for one in found if one.table == "variant"]),
        ("column", [one for one in found if not one.row]),
    ):
        for side, word in ((THERE, "added"), (NOT_THERE, "gone")):
            number = sum(one.actual == side for one in lacking)
            parts += [f"{number} {plural(kind, number)} {word}"] * bool(number)
    return "; ".join(parts)


def _rows(sweep: WrittenSweep) -> list[tuple[str, str]]:
    """What names each row: its variant, and its gear where it has one."""
    pairs = zip_longest(sweep.variants, sweep.gears, fillvalue="")
    return [(f"{VARIANT}{number}", gear) for number, gear in pairs]


def _table(column: str) -> str:
    """The key of the table that a column is of, such as ``W[C1,low]``."""
    quantity = BY_NAME.get(column.partition("[")[0])
    return quantity.key if quantity else ""
