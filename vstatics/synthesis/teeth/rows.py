"""All tooth numbers of a gear set that satisfy the conditions, listed gear by gear.

The gears of a ratio come first, then gears that the equations of coincident axes almost determine.
Each condition is checked as soon as all numbers in it are known.
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
"""Number of candidates that are examined together."""

LARGEST_TEETH_LOGARITHM = 50.0
"""Upper limit of ln(teeth), above any tooth number."""
MOST_TEETH_CANDIDATES = 100_000_000
"""Default largest number of candidates to examine, which takes half a minute."""
LOOKED = "left"
"""Key in the counter `excluded` for the number of candidates that may still be examined."""

Windows = Mapping[int, tuple[float, float]]
"""Smallest and largest useful magnitude of each ratio of the gear set, by index. [-]"""


class TooManyError(Exception):
    """Error if more candidates exist than may be examined."""


@dataclass(frozen=True)
class TeethRows:
    """Generator of the tooth numbers of a gear set within limits."""

    layout: TeethLayout
    limits: TeethLimits

    @cached_property
    def ranges(self) -> Integers:
        """Smallest and largest tooth number of each gear, even with undercut, shape (wheels, 2)."""
        return np.array(self.limits.of_wheels(self.layout), dtype=np.int64)

    @cached_property
    def least(self) -> Integers:
        """Smallest tooth number of each gear within the range and without undercut."""
        layout = self.layout
        cut = layout.element.kind not in ("chain", "bevel_pair")
        least = np.where(np.array(layout.internal) | (not cut), 1, UNCUT_SHIFTED)
        return np.maximum(self.ranges[:, 0], least)

    @property
    def counts(self) -> tuple[int, ...]:
        """Permitted numbers of planets, the preferred number first."""
        return self.limits.counts(self.layout)

    @cached_property
    def modules(self) -> Floats:
        """Available modules [mm]; 1 if no modules are given."""
        return np.array(sorted(set(self.limits.modules)) or [1.0])

    @cached_property
    def _sets_of_modules(self) -> Integers:
        """Choices of modules for all components, as indices into `modules`, (choices, components).

        For a single component, the smallest module suffices. Without a largest diameter, one of
        several choices with equal ratios of modules suffices.
        """
        components = max(self.layout.component) + 1
        if components == 1:
            return np.zeros((1, 1), np.int64)
        choices: dict[tuple[float, ...], tuple[int, ...]] = {}
        for choice in itertools.product(range(len(self.modules)), repeat=components):
            modules = [float(self.modules[number]) for number in choice]
            if self.limits.largest_diameter is None:
                modules = [round(module / modules[0], 9) for module in modules]
            choices.setdefault(tuple(modules), choice)
        return np.array(list(choices.values()), np.int64)

    def pieces(
        self,
        windows: Windows,
        excluded: Counter[str] | None = None,
        effort: int = MOST_TEETH_CANDIDATES,
    ) -> Iterator[Integers]:
        """Yield all tooth numbers that satisfy the conditions, in pieces.

        Parameters
        ----------
        windows : mapping of int to (float, float)
            Ranges of useful magnitudes of ratios. [-]
        excluded : Counter
            Receives the number of candidates that each condition excludes.
        effort : int
            Largest number of candidates to examine.

        Raises
        ------
        TooManyError
            If there are more than `effort` candidates.

        Yields
        ------
        ndarray, shape (rows, wheels + 1 + components)
            Rows as in `TeethCandidates`.
        """
        excluded = Counter() if excluded is None else excluded
        excluded[LOOKED] = effort
        columns = len(self.layout.wheels) + 1 + self._sets_of_modules.shape[1]
        start = np.zeros((len(self._sets_of_modules), columns), np.int32)
        start[:, len(self.layout.wheels) + 1 :] = self._sets_of_modules
        wheels = len(self.layout.wheels)
        modules = {wheels + 1 + number for number in range(max(self.layout.component) + 1)}
        waiting = list(teeth_conditions(self.layout, self.limits))
        known = set(modules)
        widths = (self.ranges[:, 1] - self.least).tolist()
        plan: list[tuple[int, list[TeethCondition]]] = []
        for column in growth_order(self.layout, self._equations, widths):
            known.add(column)
            now = [condition for condition in waiting if condition.needs <= known]
            waiting = [condition for condition in waiting if not condition.needs <= known]
            plan.append((column, now))
        yield from self._grown(plan, 0, start, windows, excluded)

    def _grown(
        self,
        plan: Sequence[tuple[int, list[TeethCondition]]],
        place: int,
        rows: Integers,
        windows: Windows,
        excluded: Counter[str],
    ) -> Iterator[Integers]:
        if place == len(plan):
            yield rows
            return
        column, conditions = plan[place]
        known = {column for column, _ in plan[:place]}
        low, high = self._between(column, known, rows, windows, excluded)
        widths = np.maximum(high - low + 1, 0)
        excluded[LOOKED] -= len(rows) + int(widths.sum())
        if excluded[LOOKED] < 0:
            raise TooManyError
        for piece in portions(widths, CANDIDATES_AT_ONCE):
            which, more = counted(widths[piece])
            grown = rows[piece][which]
            grown[:, column] = low[piece][which] + more
            if column == len(self.layout.wheels):
                grown[:, column] = np.array(self.counts)[grown[:, column]]
            for condition in conditions:
                fits = condition.test(TeethCandidates(self.layout, self.modules, grown))
                excluded[condition.label] += int(len(fits) - fits.sum())
                grown = grown[fits]
            if len(grown):
                yield from self._grown(plan, place + 1, grown, windows, excluded)

    def _between(
        self,
        column: int,
        known: set[int],
        rows: Integers,
        windows: Windows,
        excluded: Counter[str],
    ) -> tuple[Integers, Integers]:
        """Return the smallest and largest possible value of a column, for each row.

        Numbers of planets are given as indices into `counts`.
        """
        if column == len(self.layout.wheels):
            zeros = np.zeros(len(rows), np.int64)
            return zeros, zeros + len(self.counts) - 1
        low = np.full(len(rows), self.least[column])
        high = np.full(len(rows), self.ranges[column, 1])
        excluded["undercut"] += len(rows) * int(self.least[column] - self.ranges[column, 0])
        for label, bounds in self._bounds(column, known, rows, windows):
            before = np.maximum(high - low + 1, 0).sum()
            low = np.maximum(low, np.ceil(bounds[0] - ROUNDED_TEETH)).astype(np.int64)
            high = np.minimum(high, np.floor(bounds[1] + ROUNDED_TEETH)).astype(np.int64)
            excluded[label] += int(before - np.maximum(high - low + 1, 0).sum())
        return low, high

    def _bounds(
        self, column: int, known: set[int], rows: Integers, windows: Windows
    ) -> Iterator[tuple[str, tuple[Floats, Floats]]]:
        """Yield the range that each axis equation and ratio leaves for a gear, with its name."""
        candidates = TeethCandidates(self.layout, self.modules, rows)
        for equation in self._equations:
            if column in equation.terms and equation.terms.keys() <= known | {column}:
                yield equation.label, solved(equation, column, candidates)
        for number, (least, most) in windows.items():
            powers = self.layout.ratios[number].powers
            if column in powers:
                low = np.full(len(rows), math.log(least) if least > 0 else -math.inf)
                high = np.full(len(rows), math.log(most))
                for wheel, power in powers.items():
                    if wheel in known:
                        part = power * np.log(candidates.teeth(wheel))
                        low, high = low - part, high - part
                    elif wheel != column:
                        ends = [power * math.log(max(end, 1)) for end in self.ends(wheel)]
                        low, high = low - max(ends), high - min(ends)
                if powers[column] < 0:
                    low, high = high, low
                low, high = (
                    np.exp(np.minimum(end / powers[column], LARGEST_TEETH_LOGARITHM))
                    for end in (low, high)
                )
                yield "ratio", (low, high)

    def ends(self, wheel: int) -> tuple[int, int]:
        """Return the smallest and largest possible tooth number of a gear."""
        return int(self.least[wheel]), int(self.ranges[wheel, 1])

    @cached_property
    def _equations(self) -> list[AxisEquation]:
        return list(axis_equations(self.layout, self.limits))


def growth_order(
    layout: TeethLayout, equations: Sequence[AxisEquation], widths: Sequence[int]
) -> list[int]:
    """Return the order in which columns are filled: gears, and the number of planets.

    Gears of a ratio are neighbours, except that a gear follows at once if it is the only gear of an
    equation that is not in the order yet. The number of planets follows as soon as a planet gear
    and the gears that determine its axis are in the order.

    Parameters
    ----------
    layout : TeethLayout
    equations : sequence of AxisEquation
    widths : sequence of int
        Number of possible tooth numbers of each gear.

    Examples
    --------
    The columns are sun, ring, planet and number of planets:

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
            left = [wheel for wheel in equation.terms if wheel not in order]
            if len(left) == 1:
                add(left[0])

    of_ratios = sorted((ratio.powers for ratio in layout.ratios), key=len)
    for wheels in (*of_ratios, range(count)):
        for wheel in sorted(wheels, key=lambda number: widths[number]):
            add(wheel)
    add(count)
    return order
