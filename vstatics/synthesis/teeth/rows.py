"""All teeth of an element that fulfil the conditions, grown wheel by wheel in the best order.

The wheels of a ratio come first, then those that the equations of the axes leave hardly a choice.
Every condition is asked as soon as all is known that it needs.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from vstatics.core.elements.teeth.conditions import UNCUT_SHIFTED
from vstatics.core.numerics.arrays import Floats, Integers, counted, portions
from vstatics.synthesis.teeth.conditions import (
    TeethCandidates,
    TeethCondition,
    solved,
    teeth_conditions,
)
from vstatics.synthesis.teeth.layout import TeethLayout
from vstatics.synthesis.teeth.limits import AxisEquation, TeethLimits, axis_equations
from vstatics.synthesis.tolerances import ROUNDED_TEETH

CANDIDATES_AT_ONCE = 300_000
"""So many candidates are looked at together."""

LARGEST_LOGARITHM = 50.0
"""Of logarithms: no number of teeth is near it."""
MOST_CANDIDATES = 100_000_000
"""So many candidates are looked at, which takes half a minute."""
LOOKED = "left"
"""What counts the candidates that may still be looked at, among those that are told."""

Windows = Mapping[int, tuple[float, float]]
"""Number of a ratio of an element -> the least and largest size that is of use [-]."""


class TooManyError(Exception):
    """There are more candidates than may be looked at."""


@dataclass(frozen=True)
class TeethRows:
    """The teeth of an element within limits."""

    layout: TeethLayout
    limits: TeethLimits

    @cached_property
    def ranges(self) -> Integers:
        """Fewest and most teeth of each wheel, undercut ones too, (wheels, 2)."""
        return np.array(self.limits.of_wheels(self.layout), dtype=np.int64)

    @cached_property
    def least(self) -> Integers:
        """Fewest teeth of each wheel that are not undercut, or the range's own."""
        layout = self.layout
        cut = layout.element.kind not in ("chain", "bevel_pair")
        least = np.where(np.array(layout.internal) | (not cut), 1, UNCUT_SHIFTED)
        return np.maximum(self.ranges[:, 0], least)

    @property
    def counts(self) -> tuple[int, ...]:
        """How many planets there may be, the number that is best liked first."""
        return self.limits.counts(self.layout)

    @cached_property
    def modules(self) -> Floats:
        """All modules; 1 where there are none."""
        return np.array(sorted(set(self.limits.modules)) or [1.0])

    @cached_property
    def _sets_of_modules(self) -> Integers:
        """The modules of all components, (choices, components), by numbers in `modules`.

        Of one component the smallest serves as well as any; where nobody asks for a diameter, so
        does one choice of all that have the same quotients.
        """
        components = max(self.layout.component) + 1
        if components == 1:
            return np.zeros((1, 1), np.int64)
        found: dict[tuple[float, ...], tuple[int, ...]] = {}
        for choice in itertools.product(range(len(self.modules)), repeat=components):
            modules = [float(self.modules[number]) for number in choice]
            if self.limits.largest_diameter is None:
                modules = [round(one / modules[0], 9) for one in modules]
            found.setdefault(tuple(modules), choice)
        return np.array(list(found.values()), np.int64)

    def found(
        self, windows: Windows, told: Counter[str] | None = None, effort: int = MOST_CANDIDATES
    ) -> Iterator[Integers]:
        """All teeth, in pieces.

        Parameters
        ----------
        windows : mapping of int to (float, float)
            Between which sizes ratios are of use.
        told : Counter
            Gets how many candidates each condition excludes.
        effort : int
            So many candidates may be looked at.

        Raises
        ------
        TooManyError
            If there are more.

        Yields
        ------
        ndarray, shape (rows, wheels + 1 + components)
            As `TeethCandidates` has them.
        """
        told = Counter() if told is None else told
        told[LOOKED] = effort
        columns = len(self.layout.wheels) + 1 + self._sets_of_modules.shape[1]
        start = np.zeros((len(self._sets_of_modules), columns), np.int32)
        start[:, len(self.layout.wheels) + 1 :] = self._sets_of_modules
        yield from self._grown(self._plan(), 0, start, windows, told)

    def _grown(
        self,
        plan: Sequence[tuple[int, list[TeethCondition]]],
        place: int,
        rows: Integers,
        windows: Windows,
        told: Counter[str],
    ) -> Iterator[Integers]:
        if place == len(plan):
            yield rows
            return
        column, conditions = plan[place]
        known = {column for column, _ in plan[:place]}
        low, high = self._between(column, known, rows, windows, told)
        widths = np.maximum(high - low + 1, 0)
        told[LOOKED] -= len(rows) + int(widths.sum())
        if told[LOOKED] < 0:
            raise TooManyError
        for piece in portions(widths, CANDIDATES_AT_ONCE):
            which, more = counted(widths[piece])
            grown = rows[piece][which]
            grown[:, column] = low[piece][which] + more
            if column == len(self.layout.wheels):
                grown[:, column] = np.array(self.counts)[grown[:, column]]
            for condition in conditions:
                kept = condition.test(TeethCandidates(self.layout, self.modules, grown))
                told[condition.label] += int(len(kept) - kept.sum())
                grown = grown[kept]
            if len(grown):
                yield from self._grown(plan, place + 1, grown, windows, told)

    def _between(
        self,
        column: int,
        known: set[int],
        rows: Integers,
        windows: Windows,
        told: Counter[str],
    ) -> tuple[Integers, Integers]:
        """The least and largest value of a column, by row; numbers of planets by their places."""
        if column == len(self.layout.wheels):
            zeros = np.zeros(len(rows), np.int64)
            return zeros, zeros + len(self.counts) - 1
        low = np.full(len(rows), self.least[column])
        high = np.full(len(rows), self.ranges[column, 1])
        told["undercut"] += len(rows) * int(self.least[column] - self.ranges[column, 0])
        for label, bounds in self._bounds(column, known, rows, windows):
            before = np.maximum(high - low + 1, 0).sum()
            low = np.maximum(low, np.ceil(bounds[0] - ROUNDED_TEETH)).astype(np.int64)
            high = np.minimum(high, np.floor(bounds[1] + ROUNDED_TEETH)).astype(np.int64)
            told[label] += int(before - np.maximum(high - low + 1, 0).sum())
        return low, high

    def _bounds(
        self, column: int, known: set[int], rows: Integers, windows: Windows
    ) -> Iterator[tuple[str, tuple[Floats, Floats]]]:
        """Between what the equations of the axes and the ratios leave a wheel."""
        candidates = TeethCandidates(self.layout, self.modules, rows)
        for equation in self._equations:
            if column in equation.terms and equation.terms.keys() <= known | {column}:
                yield equation.label, solved(equation, column, candidates)
        for number, window in windows.items():
            powers = self.layout.ratios[number].powers
            if column in powers:
                yield "ratio", self._in_window(powers, window, column, known, candidates)

    def _in_window(
        self,
        powers: Mapping[int, int],
        window: tuple[float, float],
        column: int,
        known: set[int],
        candidates: TeethCandidates,
    ) -> tuple[Floats, Floats]:
        """The teeth of a wheel with which a product of powers may be within a window."""
        low = np.full(len(candidates.rows), math.log(window[0]) if window[0] > 0 else -math.inf)
        high = np.full(len(candidates.rows), math.log(window[1]))
        for wheel, power in powers.items():
            if wheel == column:
                continue
            if wheel in known:
                part = power * np.log(candidates.teeth(wheel))
                low, high = low - part, high - part
                continue
            ends = [power * math.log(max(int(one), 1)) for one in self.ends(wheel)]
            low, high = low - max(ends), high - min(ends)
        power = powers[column]
        low, high = (low / power, high / power) if power > 0 else (high / power, low / power)
        return np.exp(np.minimum(low, LARGEST_LOGARITHM)), np.exp(
            np.minimum(high, LARGEST_LOGARITHM)
        )

    def ends(self, wheel: int) -> tuple[int, int]:
        """Fewest and most teeth of a wheel that may be."""
        return int(self.least[wheel]), int(self.ranges[wheel, 1])

    @cached_property
    def _equations(self) -> list[AxisEquation]:
        return list(axis_equations(self.layout, self.limits))

    def _plan(self) -> list[tuple[int, list[TeethCondition]]]:
        """The columns in their order, each with the conditions that can be asked then."""
        wheels = len(self.layout.wheels)
        modules = {wheels + 1 + number for number in range(max(self.layout.component) + 1)}
        waiting = list(teeth_conditions(self.layout, self.limits))
        known = set(modules)
        widths = (self.ranges[:, 1] - self.least).tolist()
        plan: list[tuple[int, list[TeethCondition]]] = []
        for column in growth_order(self.layout, self._equations, widths):
            known.add(column)
            now = [one for one in waiting if one.needs <= known]
            waiting = [one for one in waiting if not one.needs <= known]
            plan.append((column, now))
        return plan


def growth_order(
    layout: TeethLayout, equations: Sequence[AxisEquation], widths: Sequence[int]
) -> list[int]:
    """Columns of wheels, and of the number of planets behind the first planet.

    Those of a ratio stand together, what an equation leaves hardly a choice stands behind it.

    Parameters
    ----------
    layout : TeethLayout
    equations : sequence of AxisEquation
    widths : sequence of int
        How many teeth each wheel may have.

    Examples
    --------
    Sun, ring, planet and number of planets:

    >>> from vstatics.core.explain.bodies import on_own_links
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> from vstatics.synthesis.teeth.layout import teeth_layouts
    >>> from vstatics.synthesis.teeth.limits import TeethLimits, axis_equations
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> (layout,) = teeth_layouts(on_own_links(case))
    >>> growth_order(layout, [*axis_equations(layout, TeethLimits())], [43, 104, 43])
    [0, 1, 2, 3]
    """
    order: list[int] = []
    count = len(layout.wheels)
    axes = [{rim, *axis} for rims in layout.planets for rim in rims if (axis := layout.axis(rim))]

    def add(column: int) -> None:
        if column in order:
            return
        order.append(column)
        if count not in order and any(axis <= {*order} for axis in axes):
            order.append(count)
        for equation in equations:
            left = [one for one in equation.terms if one not in order]
            if len(left) == 1:
                add(left[0])

    of_ratios = sorted((ratio.powers for ratio in layout.ratios), key=len)
    for wheels in (*of_ratios, range(count)):
        for wheel in sorted(wheels, key=lambda one: widths[one]):
            add(wheel)
    add(count)
    return order
