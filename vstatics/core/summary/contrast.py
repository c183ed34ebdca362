"""Comparison of summaries of several cases, side by side."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import reduce
from itertools import chain
from string import ascii_uppercase

from vstatics.core.model.parts import HOUSING
from vstatics.core.summary import Summary
from vstatics.core.summary.extremes import (
    LOSSY_TORQUES,
    PLANETS,
    SLIPS,
    TORQUES,
    Largest,
    overall,
    quantity,
)
from vstatics.core.summary.tables import ACCELERATION, INERTIA, other_combinations
from vstatics.core.tables.grid import Grid, Value, Values, exact, grid_of, word
from vstatics.core.tables.quantities import headed
from vstatics.core.texts import heading as headed_in
from vstatics.core.texts import tr

LARGEST = {
    PLANETS: "largest planet speed",
    SLIPS: "largest slip",
    TORQUES: "largest torque",
    LOSSY_TORQUES: "largest torque with losses",
}
"""Words for the largest values, by name of the table."""


def letters(count: int) -> list[str]:
    """Return labels of cases side by side: A to Z, then AA and so on.

    >>> letters(28)[-3:]
    ['Z', 'AA', 'AB']
    """
    front = ["", *(letters(-(-(count - 26) // 26)) if count > 26 else [])]
    return [before + letter for before in front for letter in ascii_uppercase][:count]


def contrasted(summaries: Sequence[Summary]) -> Iterator[Grid]:
    """Yield tables with cases side by side as A, B, C; gears of the same name share a row."""
    yield _gears(summaries)
    headings = [part for letter in letters(len(summaries)) for part in (letter, "where")]
    if any(summary.inertias for summary in summaries):
        yield _inertias(summaries)
    yield grid_of("In all", ["quantity", *headings], _in_all(summaries), key="in all")
    for letter, summary in zip(letters(len(summaries)), summaries, strict=True):
        if summary.combinations is not None:
            grid = other_combinations(summary)
            yield grid._replace(title=f"{letter}. {tr(grid.title)}")


def _gears(summaries: Sequence[Summary]) -> Grid:
    lines = [{line.gear: line for line in summary.design.gears} for summary in summaries]
    fields = {tr(field): field for field in ("ratio", "step", "efficiency")}
    return _by_gear("Gears", "gears", summaries, lines, fields)


def _by_gear(
    title: str,
    key: str,
    summaries: Sequence[Summary],
    lines: Sequence[Mapping[str, object]],
    fields: Mapping[str, str],
) -> Grid:
    """Return a table with a row for each gear, and columns for some fields of each case."""
    labels = letters(len(summaries))
    headings = [f"{heading} {label}" for heading in fields for label in labels]
    rows = (
        [
            name,
            *(
                getattr(by_name.get(name), field, None)
                for field in fields.values()
                for by_name in lines
            ),
        ]
        for name in _names(summaries)
    )
    return grid_of(title, ["gear", *headings], rows, key=key)


def _names(summaries: Sequence[Summary]) -> Sequence[str]:
    in_cases = ([line.gear for line in summary.design.gears] for summary in summaries)
    names: list[str] = reduce(_in_order, in_cases, [])
    return names


def _inertias(summaries: Sequence[Summary]) -> Grid:
    lines = [{line.gear: line for line in summary.inertias} for summary in summaries]
    fields = {headed_in(INERTIA): "inertia", headed_in(ACCELERATION): "acceleration"}
    if all(math.isnan(line.acceleration) for by_name in lines for line in by_name.values()):
        del fields[headed_in(ACCELERATION)]
    title = "Inertia at the input, acceleration of the input"
    return _by_gear(title, "inertia", summaries, lines, fields)


def _in_order(first: Sequence[str], second: Sequence[str]) -> list[str]:
    """Merge two lists of gears; a gear only in the second list follows its predecessor there.

    >>> _in_order(["1", "2", "R"], ["1", "2", "3", "R"])
    ['1', '2', '3', 'R']
    >>> _in_order(["low", "high"], ["1", "2"])  # nothing in common
    ['low', 'high', '1', '2']
    """
    names = list(first)
    place = 0 if {*first} & {*second} else len(names)
    for name in second:
        if name in names:
            place = names.index(name) + 1
        else:
            names.insert(place, name)
            place += 1
    return names


Fact = tuple[Value, str]
"""Value, and the shift element, gear or shift that has this value."""


def _mean_efficiency(summary: Summary) -> float:
    """Return the mean efficiency of the forward gears [-]; NaN if any efficiency is undefined."""
    forward = [
        line.efficiency for line in summary.design.gears if line.gear in summary.design.forward
    ]
    return math.fsum(forward) / len(forward) if forward else math.nan


def _least_margin(summary: Summary) -> Fact:
    known = [margin for margin in summary.margins if margin.gear]
    if not known:
        return math.nan if summary.margins else None, ""
    least = min(known, key=lambda margin: margin.least)
    return least.least, f"{least.element}, {least.gear}"


def _most_needed(summary: Summary) -> Fact:
    most = max(summary.needed, key=lambda element: element.capacity, default=None)
    return (most.capacity, f"{most.element}, {most.gear}") if most and most.gear else (None, "")


def _most_slip_power(summary: Summary) -> Fact:
    powers = (
        (power, f"{name}, {shift.start}-{shift.end}")
        for shift in summary.transitions
        for name, power in shift.slip_power.items()
        if not shift.skipped and power > 0
    )
    return max(powers, default=(None, ""), key=lambda fact: fact[0] or 0.0)


FACTS: Mapping[str, Callable[[Summary], Fact]] = {
    "forward gears": lambda summary: (len(summary.design.forward), ""),
    "shift elements": lambda summary: (len(summary.results.case.shift_elements), ""),
    "of them between two links": lambda summary: (
        sum(HOUSING not in element.links for element in summary.results.case.shift_elements),
        "",
    ),
    "most that change in a shift": lambda summary: (
        max((shift.changes for shift in summary.transitions if not shift.skipped), default=0),
        "",
    ),
    "spread": lambda summary: (summary.design.spread, ""),
    "mean forward efficiency": lambda summary: (_mean_efficiency(summary), ""),
    "efficiency of the duty cycle": lambda summary: (
        summary.cycle.efficiency if summary.cycle else None,
        "",
    ),
    "least margin": _least_margin,
    "largest slip power": _most_slip_power,
    "largest required torque capacity": _most_needed,
}
"""Functions for overall values of a case, by label. Values that no case has are omitted."""


def _in_all(summaries: Sequence[Summary]) -> Iterator[Values]:
    for name, fact in FACTS.items():
        facts = [fact(summary) for summary in summaries]
        if any(value is not None for value, _ in facts):
            yield [word(name), *chain(*facts)]
    for loaded in (False, True):
        for key, name in LARGEST.items():
            shown = quantity(key, loaded=loaded)
            lines = [overall(summary.largest.get(shown.name, ())) for summary in summaries]
            if any(lines):
                largest = [_largest(line, shown.decimals) for line in lines]
                yield [word(headed(name, shown.unit)), *chain(*largest)]


def _largest(line: Largest | None, decimals: int) -> Fact:
    if line is None:
        return None, ""
    return exact(line.value, decimals), f"{line.row}, {line.gear}" if line.gear else ""
