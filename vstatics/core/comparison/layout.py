"""Verdicts as lines for a terminal or as Markdown."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import zip_longest
from typing import Any

from vstatics.core.comparison.numbers import NOT_THERE, Difference, shown
from vstatics.core.comparison.sweeps import VARIANT
from vstatics.core.comparison.verdicts import PLURALS, CaseVerdict
from vstatics.core.errors import plural
from vstatics.core.tables.markdown import escaped
from vstatics.core.tables.numbers import fixed, rounded
from vstatics.core.tables.text import INDENT, TABLE_WIDTH, broken
from vstatics.core.texts import tr

CASE_LINES = 20
"""Largest number of lines about a case, unless all numbers are requested."""
LONGEST_VALUE = 60
"""Largest number of characters of a value of the case. Longer values are shortened."""
Cells = tuple[str, str, str, str, str]
"""Texts of a row: table (or `CHANGES`), place, expected value, actual value, deviation."""
CHANGES = ""
"""Value instead of the name of a table in rows about changes of a case."""


def text(verdict: CaseVerdict, *, all_numbers: bool = False) -> list[str]:
    """Return the lines of a verdict: the headline, then the largest differences of each table.

    >>> from vstatics.core.comparison.numbers import Difference
    >>> ratio = Difference("ratio", "", "R", -3.343, -3.297)
    >>> print(*text(CaseVerdict("box", "changed", None, [ratio], {"ratio": 1})), sep="\\n")
    box: 1 of 1 ratio differs
      ratio       R  -3.297 -> -3.343  -1.40 %
    """
    rows, further = _rows(verdict, all_numbers=all_numbers)
    kinds = max((len(row[0]) for row in rows), default=0)
    places = max((len(row[1]) for row in rows), default=0)
    values = max((len(f"{old} -> {new}") for *_, old, new, percent in rows if percent), default=0)
    lines = [verdict.headline]
    for kind, place, old, new, deviation in rows:
        head = f"  {kind.ljust(max(kinds, len('efficiency')))}  {place}"
        line = f"{head.ljust(len(head) + places - len(place))}  {f'{old} -> {new}'.ljust(values)}"
        line = f"{line}  {deviation}".rstrip()
        if len(line) <= TABLE_WIDTH:
            lines.append(line)
        else:
            lines += broken([f"{head} ", old, f"-> {new}  {deviation}".rstrip()], indent=3 * INDENT)
    return [*lines, *(f"  {line}" for line in further)]


def markdown(verdict: CaseVerdict, *, all_numbers: bool = False) -> list[str]:
    """Return the lines of a verdict as Markdown with a table."""
    rows, further = _rows(verdict, all_numbers=all_numbers)
    name, _, says = verdict.headline.partition(": ")
    lines = [f"**{escaped(name)}**: {escaped(says)}"]
    if rows:
        lines += ["", "| what | where | expected | actual | deviation |"]
        lines += ["| :--- | :--- | ---: | ---: | ---: |"]
        lines += [f"| {' | '.join(map(escaped, row))} |" for row in rows]
    return [*lines, *(part for line in further for part in ("", escaped(line)))]


def _rows(verdict: CaseVerdict, *, all_numbers: bool) -> tuple[list[Cells], list[str]]:
    """Return the rows to show, and further lines: number of omitted rows, or further errors.

    Ratios, steps and efficiencies are shown first. Differences of other tables are shown only if
    none of these differ. For a sweep, differences of all columns are shown.
    """
    if verdict.problems:
        return [], [*map(str, verdict.problems[1:])]
    kinds: dict[str, list[Cells]] = {
        CHANGES: [("case", path, *shown_values(old, new), "") for path, old, new in verdict.case]
    }
    for number in verdict.differences:
        if verdict.is_sweep or number.table != "case":
            cells = _cells(number, is_sweep=verdict.is_sweep)
            kinds.setdefault(number.table, []).append(cells)
    count = sum(map(len, kinds.values()))
    if all_numbers:
        return [row for rows in kinds.values() for row in rows], []
    first = [kind for kind in kinds if kind in PLURALS and not verdict.is_sweep] or [
        kind for kind in kinds if kind != CHANGES
    ]
    # Rows of different tables alternate, so that the first rows include every table.
    turns: Iterable[Any] = zip_longest(*([kind] * len(kinds[kind]) for kind in [CHANGES, *first]))
    order = [kind for turn in turns for kind in turn if kind is not None]
    taken = order[: CASE_LINES - 1 if len(order) == count < CASE_LINES else CASE_LINES - 2]
    rows = [row for kind, of_kind in kinds.items() for row in of_kind[: taken.count(kind)]]
    changes = len(kinds[CHANGES]) - taken.count(CHANGES)
    omitted = [f"{changes} more {plural('change', changes)}"] * bool(changes)
    numbers = count - len(taken) - changes
    omitted += [f"{numbers} more {plural('number', numbers)}"] * bool(numbers)
    return rows, [f"... {', '.join(omitted)}: --all"] * bool(omitted)


def _cells(difference: Difference, *, is_sweep: bool) -> Cells:
    table, row, gear, actual, expected = difference
    if table == "variant":
        row = row.removeprefix(VARIANT)
    place = ", ".join(filter(None, (row, gear)))
    if table == "step" and not is_sweep:
        place = f"{gear}-{row}"
    if isinstance(actual, str) or isinstance(expected, str):
        return table, place, str(expected), str(actual), ""
    return table, place, *_numbers(expected, actual), percent(difference.shown_deviation)


def _numbers(old: float, new: float) -> tuple[str, str]:
    if old != old or new != new:  # noqa: PLR0124 - NaN
        first, second = (shown(x) if x != x else rounded(x) for x in (old, new))  # noqa: PLR0124
        return first, second
    for digits in (None, *range(4, 16)):
        texts = rounded(old, digits=digits), rounded(new, digits=digits)
        if texts[0] != texts[1]:
            return texts
    return shown(old), shown(new)


def percent(deviation: float) -> str:
    """Return a deviation in % with a sign; empty for NaN.

    >>> percent(0.0065), percent(-1.5), percent(1e-9), percent(float("nan"))
    ('+0.65 %', '-150.00 %', '+1.0e-07 %', '')
    """
    if deviation != deviation:  # noqa: PLR0124 - NaN
        return ""
    percent = 100 * deviation
    if abs(percent) < 0.005 or abs(percent) >= 1e6:
        return f"{percent:+.1e} %"
    return f"{'+' if percent > 0 else '-'}{fixed(abs(percent), decimals=2)} %"


def shown_values(old: Any, new: Any) -> tuple[str, str]:
    """Return two values of a case as texts. `NOT_THERE` stands for a missing key."""
    texts = [
        value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
        for value in (tr(NOT_THERE) if value is None else value for value in (old, new))
    ]
    first, second = (
        text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 3] + "..." for text in texts
    )
    return first, second
