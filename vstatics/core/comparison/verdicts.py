"""Verdicts of a comparison: on a single result, and on many results."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

from vstatics.core.comparison.case_changes import CaseChange, case_changes
from vstatics.core.comparison.numbers import Difference, differences
from vstatics.core.comparison.steps import step_differences, steps_of
from vstatics.core.comparison.sweeps import sweep_headline
from vstatics.core.comparison.tolerances import Tolerances
from vstatics.core.errors import Problem
from vstatics.core.tables.answer import Sometimes, json_keys
from vstatics.core.tables.written_results import WrittenResult
from vstatics.core.texts import tr

State = Literal["same", "changed", "added", "gone", "unreadable"]
MAIN = ("ratio", "step", "efficiency")
"""Names of tables whose differences come first."""
PLURALS = {"ratio": "ratios", "step": "steps", "efficiency": "efficiencies"}


class NumberRecord(NamedTuple):
    """Number that differs, as a record for JSON."""

    table: str
    row: str | None
    """Name of the row of a table, or number of the variant in a sweep."""
    gear: str | None
    """Name of the gear (for a step ratio, the lower gear), or of a device in the distribution
    matrix.
    """
    expected: float | str | None
    """Expected number (None if missing), or text if a whole table or row differs."""
    actual: float | str | None
    deviation: float | None
    """Deviation relative to the magnitude of the expected number. [-]"""


@json_keys("name", "state", "case", "numbers", "errors")
class CaseVerdict(NamedTuple):
    """Verdict on a result, compared with the expected result."""

    name: str
    state: State
    changes: Sequence[CaseChange] | None = ()
    """Changes of the case; None if a result does not contain its case."""
    differences: Sequence[Difference] = ()
    """Numbers that differ, largest differences of each table first."""
    counts: Mapping[str, int] = {}
    """Numbers of compared ratios, step ratios and efficiencies, or of variants and columns."""
    differs: bool = False
    """True if numbers differ. Changes of the case alone do not count."""
    problems: Sequence[Problem] = ()
    """Errors of results that cannot be read."""

    @property
    def errors(self) -> Sometimes[Sequence[str]]:
        """Problems as text; None without problems."""
        return [*map(str, self.problems)] or None

    @property
    def case(self) -> Sequence[CaseChange]:
        """Changes of the case; empty if unknown."""
        return self.changes or ()

    @property
    def numbers(self) -> Sequence[NumberRecord]:
        """Numbers that differ, as records."""
        return [
            NumberRecord(
                difference.table,
                None
                if difference.table == "step" and not self.is_sweep
                else difference.row or None,
                difference.gear or None,
                difference.expected,
                difference.actual,
                difference.deviation,
            )
            for difference in self.differences
        ]

    @property
    def is_sweep(self) -> bool:
        """True for a comparison of sweeps, whose tables are columns."""
        return "column" in self.counts

    @property
    def headline(self) -> str:
        """Summary of the verdict in a single line."""
        if self.state in ("added", "gone"):
            missing = "expected" if self.state == "added" else "actual"
            return f"{self.name}: {self.state} (no {missing} result)"
        if self.problems:
            return f"{self.name}: {self.state}: {self.problems[0]}"
        if self.is_sweep:
            return f"{self.name}: {sweep_headline(self.differences, self.counts)}"
        tables = [difference.table for difference in self.differences]
        if "case" in tables:
            [failure] = self.differences
            return f"{self.name}: {failure.actual}, expected {failure.expected}"
        forms = "{{number}} of {{count}} {0}|{{number}} of {{count}} {1}"
        numbers = [
            tr(forms.format(table, PLURALS[table]), number=tables.count(table), count=count)
            for table, count in self.counts.items()
            if table in tables
        ]
        others = len(tables)
        summary = tr("no number differs")
        if numbers:
            count = sum(table in self.counts for table in tables)
            summary = tr(
                "{numbers} differs|{numbers} differ", numbers=", ".join(numbers), count=count
            )
        elif others:
            summary = tr("{count} other number differs|{count} other numbers differ", count=others)
        elif self.differs:
            summary = tr("no number differs, but gears are not the same")
        if self.changes is None:
            return f"{self.name}: {summary}"
        changed = tr("no change of the case")
        if changes := len(self.changes):
            changed = tr("{count} change of the case|{count} changes of the case", count=changes)
        return f"{self.name}: {changed}; {summary}"


@json_keys("same", "changed", "added", "gone", "cases", unreadable="some_unreadable")
class Verdict(NamedTuple):
    """Verdict on many results, as a record for JSON."""

    same: int
    changed: int
    added: int
    gone: int
    cases: Sequence[CaseVerdict]

    def __repr__(self) -> str:
        """Return the number of results with each outcome, such as `same` or `changed`."""
        return f"<Verdict: {self.tally}>"

    @property
    def differs(self) -> bool:
        """True if any result differs. Changes of cases alone do not count."""
        return any(case.differs for case in self.cases)

    @property
    def unreadable(self) -> int:
        """Number of results that cannot be read and so cannot be compared."""
        return sum(case.state == "unreadable" for case in self.cases)

    @property
    def some_unreadable(self) -> Sometimes[int]:
        """Number of unreadable results; None without such results."""
        return self.unreadable or None

    @property
    def tally(self) -> str:
        """Number of results with each outcome, as text."""
        counts = [*zip(self._fields[:4], self[:4], strict=True)]
        counts += [("unreadable", self.unreadable)] * bool(self.unreadable)
        return ", ".join(f"{count} {state}" for state, count in counts)


def verdict(cases: Sequence[CaseVerdict]) -> Verdict:
    """Return the verdict on many results, with the number of results with each outcome.

    >>> verdict([CaseVerdict("a", "same"), CaseVerdict("b", "gone", differs=True)])
    <Verdict: 1 same, 0 changed, 0 added, 1 gone>
    """
    counts = Counter(case.state for case in cases)
    return Verdict(counts["same"], counts["changed"], counts["added"], counts["gone"], cases)


OTHER_ROWS = (
    "a listing of Visual-Statics has rows for mechanisms, and the other result has rows for "
    "gear sets: expected the output of `vstatics run` in the format listing, JSON or CSV"
)


def unreadable(name: str, problems: Sequence[Problem]) -> CaseVerdict:
    """Return the verdict on a result that cannot be compared."""
    return CaseVerdict(name, "unreadable", differs=True, problems=problems)


def compared(
    name: str, actual: WrittenResult | None, expected: WrittenResult | None, how: Tolerances
) -> CaseVerdict:
    """Return the verdict on a result and its expected result. Either can be missing."""
    if actual is None or expected is None:
        return CaseVerdict(name, "gone" if actual is None else "added", differs=True)
    if actual.is_of_source != expected.is_of_source and (actual.has_own or expected.has_own):
        return unreadable(name, [Problem("E110", OTHER_ROWS)])
    unequal = list(differences(actual, expected, **how._asdict()))
    steps, counts = _steps(actual, expected, unequal, how)
    changes = _changes(actual, expected, unequal)
    numbers = [item for item in (*unequal, *steps) if item.table]
    state: State = "changed" if changes or unequal else "same"
    return CaseVerdict(name, state, changes, largest_first(numbers), counts, bool(unequal))


def largest_first(items: Iterable[Difference]) -> list[Difference]:
    """Return differences sorted by table (ratios, steps and efficiencies first), then by size."""
    numbers = [*items]
    order = [*MAIN, *dict.fromkeys(number.table for number in numbers)]
    numbers.sort(key=lambda number: (order.index(number.table), -_size(number)))
    return numbers


def _size(difference: Difference) -> float:
    return math.inf if math.isnan(difference.shown_deviation) else abs(difference.shown_deviation)


def _steps(
    actual: WrittenResult,
    expected: WrittenResult,
    unequal: Sequence[Difference],
    how: Tolerances,
) -> tuple[Sequence[Difference], dict[str, int]]:
    """Return step ratios that differ, and numbers of compared ratios, steps and efficiencies."""
    gears = [_gears(result) for result in (actual, expected)]
    if not {*gears[0]} & {*gears[1]} and len(gears[0]) == len(gears[1]):
        gears[0] = gears[1]
    cases = actual.case or expected.case, expected.case or actual.case
    here, there = map(steps_of, (actual, expected), gears, cases)
    ratios = {item.gear for item in unequal if item.table in ("ratio", "")}
    steps: Sequence[Difference] = ()
    if "ratio" not in how.leave_out:
        steps = list(step_differences(here, there, ratios, how.atol, how.rtol))
    counts = {table: max(_count(result, table) for result in (actual, expected)) for table in MAIN}
    return steps, counts | {"step": len({*here, *there})}


def _gears(result: WrittenResult) -> Sequence[str]:
    [ratios] = result.tables.get("ratio") or [[]]
    return list(result.gear_names) or [str(number) for number, _ in enumerate(ratios, 1)]


def _count(result: WrittenResult, table: str) -> int:
    [row] = result.tables.get(table) or [[]]
    return sum(not math.isnan(figure.value) for figure in row)


def _changes(
    actual: WrittenResult,
    expected: WrittenResult,
    unequal: Sequence[Difference],
) -> list[CaseChange] | None:
    gears: list[CaseChange] = []
    for item in unequal:
        if not item.table:
            values: list[Any] = [None if text == "not there" else text for text in item[3:]]
            gears.append(CaseChange(f"gears.{item.gear}", values[1], values[0]))
    if (
        not (actual.case and expected.case)
        or actual.printed != expected.printed
        or any(result.is_of_source for result in (actual, expected))
    ):
        return gears or None
    changes = list(case_changes(actual.case, expected.case))
    paths = {change.path for change in changes}
    return [*(change for change in gears if change.path not in paths), *changes]
