"""Comparison of sweeps. Variants are matched by number, columns by name."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from itertools import zip_longest

from vstatics.core.comparison.numbers import NOT_THERE, THERE, Difference, is_same
from vstatics.core.errors import count_of
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
    """Yield all differences between two sweeps. `table` is the column, `row` the variant.

    If only one sweep has a variant, the table of the difference is `variant`. If only one sweep has
    a column, the row of the difference is empty.
    """
    here, there = (
        {row: place for place, row in enumerate(_rows(sweep))} for sweep in (actual, expected)
    )
    yield from (Difference("variant", *row, NOT_THERE, THERE) for row in there if row not in here)
    yield from (Difference("variant", *row, THERE, NOT_THERE) for row in here if row not in there)
    new, old = (
        {name: column for name, column in sweep.columns.items() if _table(name) not in leave_out}
        for sweep in (actual, expected)
    )
    yield from (Difference(n, "", "", NOT_THERE, THERE) for n in old if n not in new)
    yield from (Difference(n, "", "", THERE, NOT_THERE) for n in new if n not in old)
    both = [(row, here[row], place) for row, place in there.items() if row in here]
    for row, place, other in both:
        if actual.status[place] != expected.status[other]:
            yield Difference("status", *row, actual.status[place], expected.status[other])
    for name in (name for name in old if name in new):
        for row, place, other in both:
            values = new[name][place], old[name][other]
            if not is_same(Figure(values[0]), Figure(values[1]), atol, rtol):
                yield Difference(name, *row, *values)


def sweep_counts(
    actual: WrittenSweep, expected: WrittenSweep, leave_out: Container[str] = ()
) -> dict[str, int]:
    """Return the numbers of common variants (or common rows of gears) and of common columns."""
    rows = {*_rows(actual)} & {*_rows(expected)}
    columns = actual.columns.keys() & expected.columns.keys()
    row = "row" if actual.gears or expected.gears else "variant"
    return {row: len(rows), "column": sum(_table(name) not in leave_out for name in columns)}


def sweep_headline(differences: Sequence[Difference], counts: Mapping[str, int]) -> str:
    """Return a line that summarises the differences between two sweeps.

    >>> differences = [Difference("ratio[1]", "variant 3", "", 2.5, 2.0)]
    >>> differences += [Difference("variant", "variant 4", "", NOT_THERE, THERE)]
    >>> sweep_headline(differences, {"variant": 9, "column": 2})
    '1 of 9 variants, 1 of 2 columns differ; 1 variant gone'
    """
    both = [item for item in differences if item.row and item.table != "variant"]
    columns = {item.table for item in both}
    statuses = sum(item.table == "status" for item in both)
    differing = [len({(item.row, item.gear) for item in both}), len(columns - {"status"})]
    numbers = [
        f"{number} of {count_of(kind, count)}"
        for number, (kind, count) in zip(differing, counts.items(), strict=True)
        if number
    ]
    numbers += [f"{statuses} status{'es' * (statuses > 1)}"] * bool(statuses)
    parts = [f"{', '.join(numbers)} {'differ' if len(numbers) > 1 else 'differs'}"] * bool(numbers)
    row = next(iter(counts))
    for kind, unmatched in (
        (row, [item for item in differences if item.table == "variant"]),
        ("column", [item for item in differences if not item.row]),
    ):
        for side, word in ((THERE, "added"), (NOT_THERE, "gone")):
            number = sum(item.actual == side for item in unmatched)
            parts += [f"{count_of(kind, number)} {word}"] * bool(number)
    return "; ".join(parts)


def _rows(sweep: WrittenSweep) -> list[tuple[str, str]]:
    pairs = zip_longest(sweep.variants, sweep.gears, fillvalue="")
    return [(f"{VARIANT}{number}", gear) for number, gear in pairs]


def _table(column: str) -> str:
    """Return the name of the table to which a column such as ``speeds[C1,low]`` belongs."""
    quantity = BY_NAME.get(column.partition("[")[0])
    return quantity.name if quantity else ""
