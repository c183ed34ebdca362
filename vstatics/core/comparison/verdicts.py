"""What is said of a result that is held against another, and of many."""

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
from vstatics.core.tables.answer import Sometimes, told
from vstatics.core.tables.written_results import WrittenResult
from vstatics.core.texts import tr

State = Literal["same", "changed", "added", "gone", "unreadable"]
MAIN = {"ratio": "ratio", "step": "step", "ETA": "efficiency"}
"""Tables that are told first, by what they are called there."""
PLURALS = {"ratio": "ratios", "step": "steps", "efficiency": "efficiencies"}


class NumberRecord(NamedTuple):
    """A number that differs, as it stands in JSON."""

    table: str
    row: str | None
    """Or the variant of a sweep."""
    gear: str | None
    """The lower one of a step; the device of AJK."""
    expected: float | str | None
    """A text tells of a whole table or row."""
    actual: float | str | None
    deviation: float | None
    """By the expected number without its sign."""


@told("name", "state", "case", "numbers", "errors")
class CaseVerdict(NamedTuple):
    """A result that is held against the expected one; `case` and `numbers` say what is other."""

    name: str
    state: State
    changes: Sequence[CaseChange] | None = ()
    """None where one result does not tell its case."""
    found: Sequence[Difference] = ()
    """The largest of each table first."""
    counts: Mapping[str, int] = {}
    """How many ratios, steps and efficiencies there are; of a sweep variants and columns."""
    differs: bool = False
    """Whether anything differs but the case."""
    problems: Sequence[Problem] = ()
    """Why it can't be compared, where it is unreadable."""

    @property
    def errors(self) -> Sometimes[Sequence[str]]:
        """The problems in words, where there are any."""
        return [*map(str, self.problems)] or None

    @property
    def case(self) -> Sequence[CaseChange]:
        """What is other in the case."""
        return self.changes or ()

    @property
    def numbers(self) -> Sequence[NumberRecord]:
        """The numbers that differ."""
        return [
            NumberRecord(
                one.table,
                None if one.table == "step" and not self.is_sweep else one.row or None,
                one.gear or None,
                one.expected,
                one.actual,
                one.deviation,
            )
            for one in self.found
        ]

    @property
    def is_sweep(self) -> bool:
        """Whether tables are columns of a sweep, whose names are those of the user."""
        return "column" in self.counts

    @property
    def headline(self) -> str:
        """What is other, in a line."""
        if self.state in ("added", "gone"):
            return f"{self.name}: {self.state}"
        if self.problems:
            return f"{self.name}: {self.state}: {self.problems[0]}"
        if self.is_sweep:
            return f"{self.name}: {sweep_headline(self.found, self.counts)}"
        if any(one.table == "case" for one in self.found):
            [one] = self.found
            return f"{self.name}: {one.actual}, expected {one.expected}"
        tables = [one.table for one in self.found]
        numbers = [
            tr(f"{{number}} of {{all}} {PLURALS[table]}", number=tables.count(table), all=count)
            for table, count in self.counts.items()
            if table in tables
        ]
        others = len(tables)
        told = tr("no number differs")
        if numbers:
            told = tr("{numbers} differ", numbers=", ".join(numbers))
        elif others:
            told = tr("{count} other number differs|{count} other numbers differ", count=others)
        elif self.differs:
            told = tr("no number differs, but gears are not the same")
        if self.changes is None:
            return f"{self.name}: {told}"
        count = tr("no change of the case")
        if changes := len(self.changes):
            count = tr("{count} change of the case|{count} changes of the case", count=changes)
        return f"{self.name}: {count}; {told}"


@told("same", "changed", "added", "gone", "cases", unreadable="some_unreadable")
class Verdict(NamedTuple):
    """What is said of many results, as it stands in JSON."""

    same: int
    changed: int
    added: int
    gone: int
    cases: Sequence[CaseVerdict]

    def __repr__(self) -> str:
        """How many of each state; not all their numbers."""
        return f"<Verdict: {self.tally}>"

    @property
    def differs(self) -> bool:
        """Whether anything is not as expected but changes of cases without effect."""
        return any(one.differs for one in self.cases)

    @property
    def unreadable(self) -> int:
        """How many results can't be compared, as they can't be read."""
        return sum(one.state == "unreadable" for one in self.cases)

    @property
    def some_unreadable(self) -> Sometimes[int]:
        """The same where there are any."""
        return self.unreadable or None

    @property
    def tally(self) -> str:
        """How many results there are of each state."""
        counts = [*zip(self._fields[:4], self[:4], strict=True)]
        counts += [("unreadable", self.unreadable)] * bool(self.unreadable)
        return ", ".join(f"{count} {state}" for state, count in counts)


def verdict(cases: Sequence[CaseVerdict]) -> Verdict:
    """Many of them with their count.

    >>> verdict([CaseVerdict("a", "same"), CaseVerdict("b", "gone", differs=True)])
    <Verdict: 1 same, 0 changed, 0 added, 1 gone>
    """
    counts = Counter(one.state for one in cases)
    return Verdict(counts["same"], counts["changed"], counts["added"], counts["gone"], cases)


OTHER_ROWS = (
    "a listing of the source has rows of mechanisms, where the other result has those of "
    "elements: expected a listing in another language, JSON or CSV"
)


def unreadable(name: str, problems: Sequence[Problem]) -> CaseVerdict:
    """What is said of a result that can't be compared."""
    return CaseVerdict(name, "unreadable", differs=True, problems=problems)


def compared(
    name: str, actual: WrittenResult | None, expected: WrittenResult | None, how: Tolerances
) -> CaseVerdict:
    """A result against the expected one; None for one that is not there."""
    if actual is None or expected is None:
        return CaseVerdict(name, "gone" if actual is None else "added", differs=True)
    if actual.is_of_source != expected.is_of_source and (actual.has_own or expected.has_own):
        return unreadable(name, [Problem("E110", OTHER_ROWS)])
    found = list(differences(actual, expected, **how._asdict()))
    steps, counts = _steps(actual, expected, found, how)
    changes = _changes(actual, expected, found, how)
    numbers = [
        one._replace(table=MAIN.get(one.table, one.table)) for one in (*found, *steps) if one.table
    ]
    state: State = "changed" if changes or found else "same"
    return CaseVerdict(name, state, changes, largest_first(numbers), counts, bool(found))


def largest_first(found: Iterable[Difference]) -> list[Difference]:
    """The largest of each table first: ratios, steps, efficiencies, then tables as they come."""
    numbers = [*found]
    order = [*MAIN.values(), *dict.fromkeys(one.table for one in numbers)]
    numbers.sort(key=lambda one: (order.index(one.table), -_size(one)))
    return numbers


def _size(one: Difference) -> float:
    """By which differences are in their order: those without a deviation come first."""
    return math.inf if math.isnan(one.told_deviation) else abs(one.told_deviation)


def _steps(
    actual: WrittenResult,
    expected: WrittenResult,
    found: Sequence[Difference],
    how: Tolerances,
) -> tuple[Sequence[Difference], dict[str, int]]:
    """Steps that differ, and how many ratios, steps and efficiencies are compared."""
    gears = [_gears(one) for one in (actual, expected)]
    if not {*gears[0]} & {*gears[1]} and len(gears[0]) == len(gears[1]):
        gears[0] = gears[1]
    cases = actual.case or expected.case, expected.case or actual.case
    here, there = map(steps_of, (actual, expected), gears, cases)
    ratios = {one.gear for one in found if one.table in ("ratio", "")}
    steps = list(step_differences(here, there, ratios, how.atol, how.rtol))
    if "ratio" in how.leave_out:
        steps = []
    counts = {
        name: max(_count(one, table) for one in (actual, expected)) for table, name in MAIN.items()
    }
    return steps, counts | {"step": len({*here, *there})}


def _gears(result: WrittenResult) -> Sequence[str]:
    """The names of gears, or their numbers."""
    [ratios] = result.tables.get("ratio") or [[]]
    return list(result.gear_names) or [str(number) for number, _ in enumerate(ratios, 1)]


def _count(result: WrittenResult, table: str) -> int:
    """How many numbers a table of one row has."""
    [row] = result.tables.get(table) or [[]]
    return sum(not math.isnan(one.value) for one in row)


def _changes(
    actual: WrittenResult,
    expected: WrittenResult,
    found: Sequence[Difference],
    how: Tolerances,
) -> list[CaseChange] | None:
    """What is other in the case; of gears it is told where nothing else tells of them, too."""
    gears: list[CaseChange] = []
    for one in found:
        if not one.table:
            values: list[Any] = [None if text == "not there" else text for text in one[3:]]
            gears.append(CaseChange(f"gears.{one.gear}", values[1], values[0]))
    if (
        not (actual.case and expected.case)
        or actual.printed != expected.printed
        or any(one.is_of_source for one in (actual, expected))
    ):
        return gears or None
    changes = list(
        case_changes(actual.case, expected.case, atol=how.atol, rtol=how.rtol),
    )
    told = {one.path for one in changes}
    return [*(one for one in gears if one.path not in told), *changes]
