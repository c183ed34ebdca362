"""Summaries beside one another."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import reduce
from string import ascii_uppercase

from vstatics.model.parts import HOUSING
from vstatics.summary import Summary
from vstatics.summary.design_table import GearLine
from vstatics.summary.extremes import (
    LOSSY_TORQUES,
    PLANETS,
    SLIPS,
    TORQUES,
    Largest,
    overall,
    quantity,
)
from vstatics.summary.grids import ACCELERATION, INERTIA, other_combinations
from vstatics.summary.inertia import GearInertia
from vstatics.tables.grid import Cell, Grid, Row, exact, grid_of, whole
from vstatics.tables.quantities import headed

LARGEST = {
    PLANETS: "largest planet speed",
    SLIPS: "largest slip",
    TORQUES: "largest torque",
    LOSSY_TORQUES: "largest torque with losses",
}
"""Tables, and how their largest values are called."""

_MISSING = GearLine("", math.nan, "", math.nan, math.nan, "")


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
            yield grid._replace(title=f"{letter}. {grid.title}")


def _gears(summaries: Sequence[Summary]) -> Grid:
    lines = [{line.gear: line for line in summary.design.gears} for summary in summaries]
    names = _names(summaries)
    called = letters(len(summaries))
    quantities = "ratio", "step", "efficiency"
    headings = (f"{quantity} {letter}" for quantity in quantities for letter in called)
    rows = []
    for name in names:
        found = [by_name.get(name, _MISSING) for by_name in lines]
        values = zip(*((line.ratio, line.step, line.efficiency) for line in found), strict=True)
        rows.append([name, *(value for of_all in values for value in of_all)])
    return grid_of("Gears", ["gear", *headings], rows, key="gears")


def _names(summaries: Sequence[Summary]) -> Sequence[str]:
    """The names of all gears."""
    own = ([line.gear for line in summary.design.gears] for summary in summaries)
    names: list[str] = reduce(_in_order, own, [])
    return names


def _inertias(summaries: Sequence[Summary]) -> Grid:
    lines = [{one.gear: one for one in summary.inertias} for summary in summaries]
    none = GearInertia("", math.nan, math.nan)
    by_gear = {name: [by_name.get(name, none) for by_name in lines] for name in _names(summaries)}
    shown = {INERTIA: "inertia", ACCELERATION: "acceleration"}
    if all(math.isnan(one.acceleration) for found in by_gear.values() for one in found):
        del shown[ACCELERATION]
    headings = [f"{heading} {letter}" for heading in shown for letter in letters(len(summaries))]
    rows = [
        [name, *(getattr(one, field) for field in shown.values() for one in found)]
        for name, found in by_gear.items()
    ]
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


def _in_all(summaries: Sequence[Summary]) -> Iterator[Row]:
    """Rows of what is told of a case as a whole."""
    yield _row("forward gears", [_count(len(one.design.forward)) for one in summaries])
    yield _row(
        "shift elements", [_count(len(one.results.case.shift_elements)) for one in summaries]
    )
    kinds = [
        [HOUSING not in (each.first, each.second) for each in one.results.case.shift_elements]
        for one in summaries
    ]
    yield _row("of them between two links", [_count(sum(one)) for one in kinds])
    changes = [[one.changes for one in each.transitions if not one.jumped] for each in summaries]
    yield _row("most that change in a shift", [_count(max(one, default=0)) for one in changes])
    yield _row("spread", [(exact(one.design.spread), "") for one in summaries])
    yield _row("mean forward efficiency", [(exact(_mean_efficiency(one)), "") for one in summaries])
    if any(one.cycle for one in summaries):
        yield _row(
            "efficiency of the duty cycle",
            [(exact(one.cycle.efficiency if one.cycle else math.nan), "") for one in summaries],
        )
    if any(one.margins for one in summaries):
        yield _row("least margin", [_least_margin(one) for one in summaries])
    for loaded in (False, True):
        for key, name in LARGEST.items():
            shown = quantity(key, loaded=loaded)
            lines = [overall(one.largest.get(shown.key, ())) for one in summaries]
            if any(lines):
                cells = [_largest(line, shown.decimals) for line in lines]
                yield _row(headed(name, shown.unit), cells)


Cells = tuple[Cell, str]
"""A number, and where it is found."""


def _row(name: str, cells: Sequence[Cells]) -> Row:
    return [name, *(cell for both in cells for cell in both)]


def _count(how_many: int) -> Cells:
    return whole(how_many), ""


def _mean_efficiency(summary: Summary) -> float:
    """Of all forward gears, NaN where one has none."""
    forward = [
        line.efficiency for line in summary.design.gears if line.gear in summary.design.forward
    ]
    return math.fsum(forward) / len(forward) if forward else math.nan


def _least_margin(summary: Summary) -> Cells:
    known = [one for one in summary.margins if one.gear]
    if not known:
        return exact(None), ""
    least = min(known, key=lambda one: one.least)
    return exact(least.least), f"{least.element}, {least.gear}"


def _largest(line: Largest | None, decimals: int) -> Cells:
    if line is None:
        return exact(None), ""
    return exact(line.value, decimals), f"{line.row}, {line.gear}" if line.gear else ""
