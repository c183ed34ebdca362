"""What two results differ by, as lines for a terminal or as Markdown."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import Any

from vstatics.core.comparison.numbers import Difference, shown
from vstatics.core.comparison.sweeps import VARIANT
from vstatics.core.comparison.verdicts import PLURALS, CaseVerdict
from vstatics.core.errors import plural
from vstatics.core.tables.markdown import escaped
from vstatics.core.tables.numbers import fixed, rounded

MOST_LINES = 20
"""Of a case, unless all are asked for."""
LONGEST = 60
"""So many letters of a value of the case are shown."""
Cells = tuple[str, str, str, str, str]
"""Kind, place, expected, actual, deviation."""
CHANGES = ""
"""Kind of the changes of a case: a name that no table and no column of a sweep has."""


def text(one: CaseVerdict, *, all_numbers: bool = False) -> list[str]:
    """The lines of a case: the headline, and below it what changed, the largest of each kind.

    >>> from vstatics.core.comparison.numbers import Difference
    >>> ratio = Difference("ratio", "", "R", -3.343, -3.297)
    >>> print(*text(CaseVerdict("box", "changed", None, [ratio], {"ratio": 9})), sep="\\n")
    box: 1 of 9 ratios differ
      ratio       R  -3.297 -> -3.343  -1.40 %
    """
    rows, left = _rows(one, all_numbers=all_numbers)
    parts = [(kind, place, f"{old} -> {new}", by) for kind, place, old, new, by in rows]
    wide = [max(map(len, column)) for column in zip(*parts, strict=True)] or [0] * 4
    wide[0] = max(wide[0], len("efficiency"))
    lines = ["  ".join(map(str.ljust, row, wide)).rstrip() for row in parts]
    return [one.headline, *(f"  {line}" for line in lines), *(f"  {line}" for line in left)]


def markdown(one: CaseVerdict, *, all_numbers: bool = False) -> list[str]:
    """The same as a table."""
    rows, left = _rows(one, all_numbers=all_numbers)
    name, _, says = one.headline.partition(": ")
    lines = [f"**{escaped(name)}**: {escaped(says)}"]
    if rows:
        lines += ["", "| what | where | expected | actual | deviation |"]
        lines += ["| :--- | :--- | ---: | ---: | ---: |"]
        lines += [f"| {' | '.join(map(escaped, row))} |" for row in rows]
    return [*lines, *(part for line in left for part in ("", escaped(line)))]


def _rows(one: CaseVerdict, *, all_numbers: bool) -> tuple[list[Cells], list[str]]:
    """The rows that are shown, and a line that tells how many are not.

    Without ratios, steps and efficiencies that differ other tables are shown, of a sweep all.
    Of what can't be read the further errors are told.
    """
    if one.problems:
        return [], [*map(str, one.problems[1:])]
    kinds: dict[str, list[Cells]] = {
        CHANGES: [("case", path, *shown_values(old, new), "") for path, old, new in one.case]
    }
    for number in one.found:
        if one.is_sweep or number.table != "case":
            place = _place(number, is_sweep=one.is_sweep)
            kinds.setdefault(number.table, []).append(_cells(number, place))
    count = sum(map(len, kinds.values()))
    if all_numbers:
        return [row for rows in kinds.values() for row in rows], []
    first = [kind for kind in kinds if kind in PLURALS and not one.is_sweep] or [
        kind for kind in kinds if kind != CHANGES
    ]
    order = list(_in_turn([CHANGES, *first], kinds))
    taken = order[: MOST_LINES - 1 if len(order) == count < MOST_LINES else MOST_LINES - 2]
    rows = [row for kind, own in kinds.items() for row in own[: taken.count(kind)]]
    changes = len(kinds[CHANGES]) - taken.count(CHANGES)
    told = [f"{changes} more {plural('change', changes)}"] * bool(changes)
    numbers = count - len(taken) - changes
    told += [f"{numbers} more {plural('number', numbers)}"] * bool(numbers)
    return rows, [f"... {', '.join(told)}: --all"] * bool(told)


def _in_turn(kinds: Sequence[str], rows: dict[str, list[Cells]]) -> Iterator[str]:
    """Kinds one after the other, as often as each has rows: so none takes the place of others."""
    turns: Iterable[Any] = zip_longest(*([kind] * len(rows[kind]) for kind in kinds))
    return (kind for turn in turns for kind in turn if kind is not None)


def _place(one: Difference, *, is_sweep: bool) -> str:
    if one.table == "step" and not is_sweep:
        return f"{one.gear}-{one.row}"
    row = one.row.removeprefix(VARIANT) if one.table == "variant" else one.row
    return ", ".join(filter(None, (row, one.gear)))


def _cells(one: Difference, place: str) -> Cells:
    if isinstance(one.actual, str) or isinstance(one.expected, str):
        return one.table, place, str(one.expected), str(one.actual), ""
    old, new = _numbers(one.expected, one.actual)
    return one.table, place, old, new, percent(one.told_deviation)


def _numbers(old: float, new: float) -> tuple[str, str]:
    """Two numbers with the digits that tell them apart."""
    if old != old or new != new:  # noqa: PLR0124 - NaN
        return shown(old), shown(new)
    for digits in (None, *range(4, 16)):
        texts = rounded(old, digits=digits), rounded(new, digits=digits)
        if texts[0] != texts[1]:
            return texts
    return shown(old), shown(new)


def percent(deviation: float) -> str:
    """With its sign; nothing where there is none.

    >>> percent(0.0065), percent(-1.5), percent(1e-9), percent(float("nan"))
    ('+.65 %', '-150.00 %', '+1.0e-07 %', '')
    """
    if deviation != deviation:  # noqa: PLR0124 - NaN
        return ""
    percent = 100 * deviation
    if abs(percent) < 0.005 or abs(percent) >= 1e6:
        return f"{percent:+.1e} %"
    return f"{'+' if percent > 0 else '-'}{fixed(abs(percent), decimals=2)} %"


def shown_values(old: Any, new: Any) -> tuple[str, str]:
    """Values of a case, not too long."""
    texts = [
        one if isinstance(one, str) else json.dumps(one, ensure_ascii=False) for one in (old, new)
    ]
    first, second = (one if len(one) <= LONGEST else one[: LONGEST - 3] + "..." for one in texts)
    return first, second
