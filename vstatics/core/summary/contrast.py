"""Summaries beside one another."""

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
"""Tables, and how their largest values are called."""


def letters(count: int) -> list[str]:
    """What cases side by side are called: A to Z, then AA and so on.

    >>> letters(28)[-3:]
    ['Z', 'AA', 'AB']
    """
    front = ["", *(letters(-(-(count - 26) // 26)) if count > 26 else [])]
    return [before + letter for before in front for letter in ascii_uppercase][:count]


def contrasted(summaries: Sequence[Summary]) -> Iterator[Grid]:
    """The tables of cases, called A, B, C, side by side.

    Gears of one name stand on one line.
    """
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
    called = letters(len(summaries))
    fields = "ratio", "step", "efficiency"
    headings = (f"{tr(field)} {letter}" for field in fields for letter in called)
    rows = (
        [name, *(getattr(by_name.get(name), field, None) for field in fields for by_name in lines)]
        for name in _names(summaries)
    )
    return grid_of("Gears", ["gear", *headings], rows, key="gears")


def _names(summaries: Sequence[Summary]) -> Sequence[str]:
    """The names of all gears."""
    own = ([line.gear for line in summary.design.gears] for summary in summaries)
    names: list[str] = reduce(_in_order, own, [])
    return names


def _inertias(summaries: Sequence[Summary]) -> Grid:
    lines = [{one.gear: one for one in summary.inertias} for summary in summaries]
    shown = {INERTIA: "inertia", ACCELERATION: "acceleration"}
    if all(math.isnan(one.acceleration) for by_name in lines for one in by_name.values()):
        del shown[ACCELERATION]
    headings = [
        f"{headed_in(heading)} {letter}" for heading in shown for letter in letters(len(summaries))
    ]
    rows = (
        [
            name,
            *(
                getattr(by_name.get(name), field, None)
                for field in shown.values()
                for by_name in lines
            ),
        ]
        for name in _names(summaries)
    )
    title = "Inertia at the input, acceleration of the input"
    return grid_of(title, ["gear", *headings], rows, key="inertia")


def _in_order(first: Sequence[str], second: Sequence[str]) -> list[str]:
    """The gears of both; one that only the second case has stands after the one before it.

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
"""A number, and where it is found."""


def _mean_efficiency(summary: Summary) -> float:
    """Of all forward gears, NaN where one has none."""
    forward = [
        line.efficiency for line in summary.design.gears if line.gear in summary.design.forward
    ]
    return math.fsum(forward) / len(forward) if forward else math.nan


def _least_margin(summary: Summary) -> Fact:
    known = [one for one in summary.margins if one.gear]
    if not known:
        return math.nan if summary.margins else None, ""
    least = min(known, key=lambda one: one.least)
    return least.least, f"{least.element}, {least.gear}"


def _most_needed(summary: Summary) -> Fact:
    most = max(summary.needed, key=lambda one: one.capacity, default=None)
    return (most.capacity, f"{most.element}, {most.gear}") if most and most.gear else (None, "")


def _most_slip_power(summary: Summary) -> Fact:
    powers = (
        (power, f"{name}, {one.start}-{one.end}")
        for one in summary.transitions
        for name, power in one.slip_power.items()
        if not one.skipped and power > 0
    )
    return max(powers, default=(None, ""), key=lambda fact: fact[0] or 0.0)


FACTS: Mapping[str, Callable[[Summary], Fact]] = {
    "forward gears": lambda one: (len(one.design.forward), ""),
    "shift elements": lambda one: (len(one.results.case.shift_elements), ""),
    "of them between two links": lambda one: (
        sum(HOUSING not in each.links for each in one.results.case.shift_elements),
        "",
    ),
    "most that change in a shift": lambda one: (
        max((each.changes for each in one.transitions if not each.skipped), default=0),
        "",
    ),
    "spread": lambda one: (one.design.spread, ""),
    "mean forward efficiency": lambda one: (_mean_efficiency(one), ""),
    "efficiency of the duty cycle": lambda one: (one.cycle.efficiency if one.cycle else None, ""),
    "least margin": _least_margin,
    "largest slip power": _most_slip_power,
    "largest needed capacity": _most_needed,
}
"""What is told of a case as a whole, where it is known of any."""


def _in_all(summaries: Sequence[Summary]) -> Iterator[Values]:
    """Rows of what is told of a case as a whole."""
    for name, fact in FACTS.items():
        facts = [fact(one) for one in summaries]
        if any(value is not None for value, _ in facts):
            yield [word(name), *chain(*facts)]
    for loaded in (False, True):
        for key, name in LARGEST.items():
            shown = quantity(key, loaded=loaded)
            lines = [overall(one.largest.get(shown.key, ())) for one in summaries]
            if any(lines):
                found = [_largest(line, shown.decimals) for line in lines]
                yield [word(headed(name, shown.unit)), *chain(*found)]


def _largest(line: Largest | None, decimals: int) -> Fact:
    if line is None:
        return None, ""
    return exact(line.value, decimals), f"{line.row}, {line.gear}" if line.gear else ""
