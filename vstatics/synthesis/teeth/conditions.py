"""Conditions on tooth numbers, as filters of candidates with the formulas of `elements.teeth`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from vstatics.core.elements.teeth.conditions import (
    INSIDE,
    TIPS,
    closes,
    common_step,
    crossing_distance,
    lean,
    neighbours_room,
    passing_room,
    seated,
)
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.tolerances import TIP_CLEARANCE
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.limits import AxisEquation, TeethLimits

FOOT = 2.5
"""Outer diameter minus pitch diameter of a ring gear, for the teeth and the rim. [modules]"""


@dataclass(frozen=True)
class TeethCandidates:
    """Candidate tooth numbers of a gear set as rows, with numbers of planets and modules.

    A component is a group of meshing gears, with a common module, given as an index into `modules`.
    """

    layout: TeethLayout
    modules: Floats
    rows: Integers
    """Tooth numbers of the gears, number of planets and modules, shape (candidates, wheels + 1 +
    components).
    """

    def teeth(self, wheel: int) -> Floats:
        """Return the tooth numbers of a gear, shape (candidates,)."""
        return self.rows[:, wheel].astype(np.float64)

    @property
    def counts(self) -> Integers:
        """Numbers of planets, shape (candidates,)."""
        return self.rows[:, len(self.layout.wheels)]

    def module(self, component: int) -> Floats:
        """Return the modules of a component, shape (candidates,) [mm, or 1]."""
        return self.modules[self.rows[:, len(self.layout.wheels) + 1 + component]]

    def span(self, rim: int) -> Floats:
        """Return twice the distance of a planet gear from the axis, in modules of the gear."""
        axis = self.layout.axis(rim)
        assert axis is not None  # noqa: S101 - conditions need an axis
        wheel, other = axis
        teeth = self.teeth(wheel), self.teeth(other)
        span = teeth[0] - teeth[1] if self.layout.internal[wheel] else teeth[0] + teeth[1]
        here, there = (self.layout.component[number] for number in (rim, other))
        return span if here == there else span * self.module(there) / self.module(here)

    def sides(self, pair: tuple[int, int]) -> tuple[Floats, Floats, Floats]:
        """Return the distances of two meshing planets from the axis and each other [modules]."""
        first, second = pair
        apart = (self.teeth(first) + self.teeth(second)) / 2
        return self.span(first) / 2, self.span(second) / 2, apart


Test = Callable[[TeethCandidates], Booleans]


class TeethCondition(NamedTuple):
    """Condition on candidate tooth numbers."""

    label: str
    needs: frozenset[int]
    """Indices of the columns of candidates that must be known to check the condition."""
    test: Test


def teeth_conditions(layout: TeethLayout, limits: TeethLimits) -> Iterator[TeethCondition]:
    """Yield all conditions on the tooth numbers of a gear set, except coincidence of the axes."""
    yield from _in_rings(layout)
    if limits.largest_diameter is not None:
        yield from _within(layout, limits.largest_diameter)
    if not layout.planets:
        return
    every = range(len(layout.wheels), len(layout.wheels) + 1 + 1 + max(layout.component))
    count, *modules = every
    axes = {}
    for rim in (rim for rims in layout.planets for rim in rims):
        axis = layout.axis(rim)
        if axis is not None:
            axes[rim] = frozenset({rim, *axis, *modules})
    for rim, needs in axes.items():
        test = partial(_have_room, rim, limits.clearance)
        yield TeethCondition("neighbouring planets", needs | {count}, test)
    for rim, wheel in layout.passing:
        test = partial(_pass, rim, wheel, limits.clearance)
        yield TeethCondition("planets beside wheels", axes[rim] | {wheel}, test)
    for pair in layout.meshes:
        if set(pair) <= axes.keys():
            needs = axes[pair[0]] | axes[pair[1]]
            yield TeethCondition("triangle of the axes", needs, partial(_close, pair))
            test = partial(_have_room_across, pair, limits.clearance)
            yield TeethCondition("neighbouring planets", needs | {count}, test)
    for train in layout.trains:
        rims = {rim for planet in train for rim in layout.planets[planet]}
        used = {*rims, *(wheel for wheel, rim in layout.around if rim in rims), count}
        yield TeethCondition("assembly", frozenset(used), partial(_go_in, train))


def _in_rings(layout: TeethLayout) -> Iterator[TeethCondition]:
    for pair in layout.around:
        if layout.internal[pair[0]]:
            yield TeethCondition("interference", frozenset(pair), partial(_fit_in, *pair))
    if layout.element.kind == "internal_pair":
        yield TeethCondition("interference", frozenset({0, 1}), _differ)


def _fit_in(ring: int, rim: int, rows: TeethCandidates) -> Booleans:
    return rows.teeth(ring) - rows.teeth(rim) >= INSIDE


def _differ(rows: TeethCandidates) -> Booleans:
    return np.abs(rows.teeth(0) - rows.teeth(1)) >= INSIDE


def _within(layout: TeethLayout, largest: float) -> Iterator[TeethCondition]:
    """Yield conditions that rims of ring gears, tips of gears, and planets fit a diameter."""
    first, rims = len(layout.wheels) + 1, {rim for rims in layout.planets for rim in rims}
    for number in range(len(layout.wheels)):
        needs, is_rim = frozenset({number, first + layout.component[number]}), number in rims
        if is_rim:
            axis = layout.axis(number)
            if axis is None:
                continue
            needs |= {*axis, first + layout.component[axis[1]]}
        test = partial(_is_within, number, largest, is_rim)
        yield TeethCondition("largest diameter", needs, test)


def _is_within(number: int, largest: float, is_rim: bool, rows: TeethCandidates) -> Booleans:  # noqa: FBT001 - by position
    across = rows.teeth(number) + (FOOT if rows.layout.internal[number] else TIPS)
    if is_rim:
        across += rows.span(number)
    return across * rows.module(rows.layout.component[number]) <= largest + TIP_CLEARANCE


def _have_room(rim: int, clearance: float, rows: TeethCandidates) -> Booleans:
    room = neighbours_room(rows.span(rim), rows.teeth(rim), np.sin(np.pi / rows.counts))
    # A single planet has no neighbours.
    return (room - clearance >= TIP_CLEARANCE) | (rows.counts < 2)


def _pass(rim: int, wheel: int, clearance: float, rows: TeethCandidates) -> Booleans:
    teeth = rows.teeth(rim), rows.teeth(wheel)
    room = passing_room(rows.span(rim), *teeth, internal=rows.layout.internal[wheel])
    return (room > TIP_CLEARANCE) & (room >= 2 * clearance - TIP_CLEARANCE)


def _close(pair: tuple[int, int], rows: TeethCandidates) -> Booleans:
    return np.asarray(closes(*rows.sides(pair)), dtype=np.bool_)


def _have_room_across(pair: tuple[int, int], clearance: float, rows: TeethCandidates) -> Booleans:
    """Check that a planet does not touch the second next planet, with which it does not mesh."""
    first, second, apart = rows.sides(pair)
    turn = 2 * math.pi / rows.counts
    room = crossing_distance(first, second, apart, turn) - apart - TIPS
    has_room = (room - clearance >= TIP_CLEARANCE) & (lean(first, second, apart) < turn)
    return has_room | (rows.counts < 2)


def _go_in(train: list[int], rows: TeethCandidates) -> Booleans:
    """Check that all planets of a meshing train can be assembled at equal angles."""
    layout = rows.layout
    column = {rim: place for place, planet in enumerate(train) for rim in layout.planets[planet]}
    lines = []
    for pair in (*layout.around, *layout.meshes):
        if pair[1] in column:
            line = np.zeros((len(train) + 1, len(rows.rows)), np.int64)
            for wheel in pair:  # central gears have a common last column
                line[column.get(wheel, -1)] += rows.rows[:, wheel] * (
                    -1 if layout.internal[wheel] else 1
                )
            lines.append(line)
    fits: Booleans = seated(common_step(np.stack(lines), len(train)), rows.counts)
    return fits


def solved(
    equation: AxisEquation, column: int, candidates: TeethCandidates
) -> tuple[Floats, Floats]:
    """Return the range of a tooth number that an equation permits, given all other numbers."""
    known_sum = np.full(len(candidates.rows), -equation.value)
    for wheel, (factor, component) in equation.terms.items():
        if wheel != column:
            known_sum = known_sum + factor * candidates.module(component) * candidates.teeth(wheel)
    factor, component = equation.terms[column]
    within, both = equation.tolerance
    slack = within * (candidates.module(both[0]) + candidates.module(both[1])) / 2
    by = factor * candidates.module(component)
    ends = (-slack - known_sum) / by, (slack - known_sum) / by
    return np.minimum(*ends), np.maximum(*ends)
