"""Losses that depend on speed, torque or both, solved for all points at once.

Speeds do not depend on losses. Drag torques, efficiencies over speed, and losses measured for whole
gears (whose input torque is known) therefore follow directly from the speeds. If drag changes the
states of freewheels, they are recalculated until the states settle. Efficiencies over torque, or
over speed and torque, result from fixed-point iterations, which start from the smallest efficiency.
The module `numerics.fixed_points` checks that no other efficiencies agree with their torques, or
searches for all of them. For formulas, it uses bounds estimated from samples. A solution is
accepted only if it is unique.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping
from copy import copy
from functools import partial
from itertools import chain, combinations
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Path, Problem
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.laws import MapLaw, PointLaw
from vstatics.core.model.parts import HOUSING, Law
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers, without
from vstatics.core.numerics.fixed_points import (
    AllFixedPoints,
    Extremes,
    Laws,
    TrialTorques,
    find_fixed_points,
)
from vstatics.core.numerics.tolerances import STANDS_STILL, TIE
from vstatics.core.statics.freewheels import with_engaged
from vstatics.core.statics.points.gear_loss import brake_torque
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import loads_of, solve_points
from vstatics.core.statics.result_arrays import Outside, first_rows
from vstatics.core.statics.results import Results

MOST_FIXED_POINT_STEPS = 30
"""Largest number of fixed-point iterations."""
MOST_EXTRAPOLATED_STEPS = 40
"""Largest number of extrapolated iterations, which follow slow or oscillating iterations."""
MOST_FREEWHEEL_PASSES = 8
"""Largest number of passes until the states of freewheels settle."""
FORMULA_SAMPLES = 17
"""Number of torques at which a formula is evaluated to estimate its bounds."""
LARGEST_FORMULA_TORQUE = 1e6
"""Torque up to which a formula is evaluated where torques have no limit. [N*m]"""
LEAST_EFFICIENCY = 1e-6
"""Lower limit of efficiencies from a formula during a search. [-]"""
NONE, SEVERAL, NO_EFFICIENCY = 1, 2, 5
"""States of a gear: no solution, several solutions, or a formula without a valid efficiency."""
WITH_LOSSES = (
    *("lossy_torques", "lossy_holding_torques", "efficiency", "losses", "power_balance"),
    *("drag_losses", "gear_losses", "slip_losses"),
    *("lossy_mesh_torques", "mesh_losses", "power_sign"),
)
"""Arrays that do not exist if the efficiencies have no unique solution."""

LawsOf = Mapping[CaseNumber, Law]
_Sizes = Mapping[CaseNumber, tuple[Floats, ...]]
"""Magnitudes of speed [rad/s], torque [N*m] or both at which each law is evaluated."""


class Followed(NamedTuple):
    """Solution at all points of a case with laws, battery balances or converters."""

    results: Results
    columns: Columns
    """Values of the varied numbers, and of the numbers that laws or searches determine."""
    open: Integers
    """States as in `OperatingPoints.open`, shape (points, gears): 0 for a unique solution."""
    outside: Outside
    """Flags of points outside the range of a law, by the name of the part that has the law."""
    wrong: Outside = EMPTY
    """Flags of points where a formula gives no valid efficiency, by the name of the part."""
    others: Mapping[int, Floats] = EMPTY
    """Smaller speed ratios of a converter that agree with the load, shape (points, ratios), by
    gear.
    """


def follow_laws(case: Transmission, given: Columns, variants: int) -> Followed:
    """Calculate all points; laws determine drag torques, efficiencies and losses."""
    if not case.laws:
        settled = np.zeros((variants, len(case.gears)), np.int8)
        return Followed(solve_points(case, given, variants), given, settled, EMPTY)
    laws = {number: law for number, law in laws_of(case).items() if number not in given}
    plain = without_laws(case)
    sought = {n: law for n, law in laws.items() if _is_efficiency(n) and law.over != "speed"}
    known = {number: law for number, law in laws.items() if number not in sought}
    columns: dict[CaseNumber, Floats] = dict(given)
    results, sizes, moved = _with_speeds(case, plain, known, columns, variants)
    unsettled = np.where(moved, NONE, 0)
    if sought:
        search = _Search(plain, columns, sought, results)
        with_efficiencies, columns, states = search.solved()
        moved = _differ(with_efficiencies.speeds, results.speeds)
        unsettled = np.where(moved, NONE, np.where(states, states, unsettled))
        results = with_efficiencies
        sizes |= search.sizes(results)
        lacks = np.isnan(results.lossy_output_torque) | (unsettled == NONE)
        if plain.freewheels and lacks.any():
            lossless = columns | {number: np.ones(variants) for number in sought}
            drives = np.isfinite(solve_points(plain, lossless, variants).lossy_output_torque)
            lacks &= drives  # most gears without torques are neutral in any case
        for held in _subsets(plain.freewheels):
            if not lacks.any():
                break
            columns, sizes, holds = _with_held(
                case, plain, (known, sought), given, (columns, sizes), lacks, held
            )
            if holds.any():
                results = solve_points(plain, columns, variants)
                unsettled[holds] = 0
                lacks &= ~holds
    wrong = _wrong_efficiencies(case, laws, sizes, results, unsettled == 0)
    for where in wrong.values():
        unsettled[where] = NO_EFFICIENCY
    results = _without_values(results, unsettled)
    return Followed(
        results, columns, unsettled, _outside(case, laws, sizes, unsettled.shape), wrong
    )


def laws_of(case: Transmission) -> LawsOf:
    """Return all laws of a case, by the number that each law determines."""
    numbers: dict[CaseNumber, Any] = {}
    for index, gear in enumerate(case.gears):
        for n, torque in case.gear_open_drag(gear).items():
            numbers[CaseNumber(index, "open_drag", n)] = torque
        for link, torque in case.gear_drag(gear).items():
            numbers[CaseNumber(index, "drag", link)] = torque
        for owner, mechanism in enumerate(case.mechanisms):
            numbers[CaseNumber(index, "efficiency", owner)] = mechanism.efficiency
            numbers[CaseNumber(index, "back_efficiency", owner)] = mechanism.back_efficiency
        numbers[CaseNumber(index, "loss_torques", case.gear_input(gear))] = gear.loss
    return {number: law for number, law in numbers.items() if isinstance(law, Law)}


def without_laws(case: Transmission) -> Transmission:
    """Return the case with numbers instead of laws.

    Drag and losses are 0, and an efficiency has its value at speed and torque 0.
    """

    def plain(number: Any, instead: float) -> Any:
        return instead if isinstance(number, Law) else number

    return case.replace(
        drag={link: plain(torque, 0.0) for link, torque in case.drag.items()},
        shift_elements=[e._replace(drag=plain(e.drag, 0.0)) for e in case.shift_elements],
        mechanisms=[
            mechanism._replace(
                efficiency=plain(mechanism.efficiency, float(mechanism.efficiency)),
                back_efficiency=plain(
                    mechanism.back_efficiency, float(mechanism.back_efficiency or 0)
                ),
            )
            for mechanism in case.mechanisms
        ],
        gears=[
            gear._replace(
                drag={link: plain(torque, 0.0) for link, torque in gear.drag.items()},
                open_drag={n: plain(torque, 0.0) for n, torque in gear.open_drag.items()},
                loss=None,
            )
            for gear in case.gears
        ],
    )


def _with_speeds(
    case: Transmission,
    plain: Transmission,
    laws: LawsOf,
    columns: dict[CaseNumber, Floats],
    variants: int,
) -> tuple[Results, dict[CaseNumber, tuple[Floats, ...]], Booleans]:
    """Return results with laws over known speeds, these speeds, and flags of unsettled gears.

    Drag can release or lock a freewheel, which changes the speeds and therefore the drag again.
    """
    results = solve_points(plain, columns, variants)
    loads: Any = loads_of(plain, columns, variants)
    sizes: dict[CaseNumber, tuple[Floats, ...]] = {}
    moved = np.zeros(results.consistent.shape, np.bool_)
    for _ in range(MOST_FREEWHEEL_PASSES if laws else 0):
        before = results.speeds
        sizes = {
            number: law.sizes_of(
                _speed(plain, results, columns, number), np.abs(loads[number.gear or 0].torque)
            )
            for number, law in laws.items()
        }
        for number, law in laws.items():
            columns[number] = _checked(case, number, _values(law, number, sizes[number]))
        results = solve_points(plain, columns, variants)
        moved = _differ(results.speeds, before) & bool(case.freewheels)
        if not moved.any():
            break
    return results, sizes, moved


def _speed(case: Transmission, results: Results, columns: Columns, number: CaseNumber) -> Floats:
    """Return the magnitude of the speed at which a law is evaluated [rad/s]; 0 if indeterminate."""
    index, quantity, owner = number
    if quantity in ("drag", "loss_torques"):
        speed = results.speeds[:, index, owner - 1]
    elif quantity == "open_drag":
        speed = results.slip_speeds[:, index, owner - 1]
    else:
        first, _, third = case.mechanisms[owner].links
        speed = np.zeros(len(results.speeds))
        for link, sign in ((first, 1), (third, -1)):
            if link != HOUSING:
                speed = speed + sign * results.speeds[:, index, link - 1]
    input_speed: Any = loads_of(case, columns, len(results.speeds))[index or 0].speed
    size: Floats = np.nan_to_num(np.abs(speed * input_speed))
    return size


def _values(law: Law, number: CaseNumber, sizes: tuple[Floats, ...]) -> Floats:
    """Return the drag torque [N*m], efficiency [-] or brake torque [N*m] that a law determines."""
    if number.quantity == "loss_torques":
        return brake_torque(law, *sizes)
    values: Floats = law.at(*sizes)
    return np.where(_are_efficiencies(values), values, 1.0) if _is_efficiency(number) else values


def _checked(case: Transmission, number: CaseNumber, values: Floats) -> Floats:
    """Return the values of a law; raise CaseError for the first value that is not valid."""
    wrong = ~(np.isfinite(values) & (values >= 0))
    if wrong.any():
        what = f"the drag of {_name(case, number)}"
        message = (
            f"{what}: read {values[wrong][0]:g}, expected a torque of 0 or more at every speed"
        )
        index, quantity, owner = number
        path: Path = ("gears", (index or 0) + 1, quantity, owner)
        if owner not in getattr(case.gears[index or 0], quantity):
            of_case: dict[str, Path] = {
                "open_drag": ("shift_elements", owner, "drag"),
                "drag": ("drag", owner),
            }
            path = of_case[quantity]
        raise CaseError([Problem("E268", message, path)])
    return values


def _differ(speeds: Floats, others: Floats) -> Booleans:
    same: Booleans = np.isclose(speeds, others, rtol=TIE, atol=TIE, equal_nan=True)
    return np.asarray((~same).any(axis=-1))


def _wrong_efficiencies(
    case: Transmission, laws: LawsOf, sizes: _Sizes, results: Results, settled: Booleans
) -> Outside:
    """Return flags of points where the formula of an efficiency in use is outside (0, 1]."""
    settled = settled & results.consistent
    by_name = defaultdict[str, Booleans](lambda: np.zeros_like(settled))
    for number, law in laws.items():
        if law.text and _is_efficiency(number):
            wrong = ~_are_efficiencies(law.at(*sizes[number])) & settled[:, number.gear]
            wrong &= _is_in_use(case, number, results)
            if wrong.any():
                by_name[_name(case, number)][:, number.gear] |= wrong
    return by_name


def _is_efficiency(number: CaseNumber) -> bool:
    return number.quantity in ("efficiency", "back_efficiency")


def _is_in_use(case: Transmission, number: CaseNumber, results: Results) -> Booleans:
    """Return flags of points at which power flows in the direction of an efficiency."""
    sign = results.power_sign[:, number.gear, number.owner]
    in_use: Booleans = sign > 0 if number.quantity == "efficiency" else sign < 0
    return in_use if case.mechanisms[number.owner].back_efficiency is not None else sign != 0


def _are_efficiencies(values: Floats) -> Booleans:
    return (values > LEAST_EFFICIENCY) & (values <= 1)


class _Search:
    """Search for efficiencies that depend on torque and agree with the resulting torques."""

    def __init__(
        self, case: Transmission, columns: Columns, laws: LawsOf, results: Results
    ) -> None:
        self.strict, self.columns, self.laws = case, columns, laws
        # While slipping clutches are allowed to produce power, torques are continuous functions.
        gears = [gear._replace(slip_drives=bool(gear.slip)) for gear in case.gears]
        self.case = case.replace(gears=gears)
        self.variants = len(results.speeds)
        self.speeds = {number: _speed(case, results, columns, number) for number in laws}
        rows = first_rows(case)
        self.rows = {number: rows[number.owner] for number in laws}
        self.of_gear: dict[int, list[CaseNumber]] = {}
        for number in laws:
            self.of_gear.setdefault(number.gear or 0, []).append(number)

    def sizes(self, results: Results) -> dict[CaseNumber, tuple[Floats, ...]]:
        """Return magnitudes of speed [rad/s] and torque [N*m] for each law; NaN if unknown."""
        torques = results.lossy_torques_Nm
        return {
            number: law.sizes_of(
                self.speeds[number], np.abs(torques[:, number.gear, self.rows[number]])
            )
            for number, law in self.laws.items()
        }

    def _tried(
        self, guess: Mapping[CaseNumber, Floats]
    ) -> tuple[Results, dict[CaseNumber, Floats]]:
        """Return results for trial efficiencies, and the efficiencies that laws then have."""
        results = solve_points(self.case, {**self.columns, **guess}, self.variants)
        sizes = self.sizes(results)
        efficiencies = {}
        for number, law in self.laws.items():
            values: Floats = law.at(*sizes[number])
            if law.text:  # trial torques can give values outside (0, 1]
                values = np.clip(np.nan_to_num(values, nan=LEAST_EFFICIENCY), LEAST_EFFICIENCY, 1.0)
            efficiencies[number] = np.where(np.isnan(sizes[number][-1]), np.nan, values)
        return results, efficiencies

    def iterated(self, end: Any) -> tuple[dict[CaseNumber, Floats], Booleans, Booleans]:
        """Iterate to a fixed point from the least or largest efficiencies.

        Returns
        -------
        guess, is_fixed, is_lacking
            Efficiencies, and flags of shape (points, gears) that mark convergence and missing
            torques.
        """
        guess = {
            number: np.full(self.variants, float(end(_ends(law))))
            for number, law in self.laws.items()
        }
        still, lacking = np.zeros((2, self.variants, len(self.case.gears)), np.bool_)
        rows, part = np.arange(self.variants), self
        before = present = {number: column.copy() for number, column in guess.items()}
        for step in range(MOST_FIXED_POINT_STEPS + MOST_EXTRAPOLATED_STEPS):
            _, efficiencies = part._tried(present)
            still[rows], lacking[rows] = True, False
            extrapolates = step >= MOST_FIXED_POINT_STEPS and step % 2 == 1
            latest, present = present, {}
            for number, values in efficiencies.items():
                moved = np.abs(values - latest[number]) > STANDS_STILL
                still[rows, number.gear or 0] &= ~moved
                lacking[rows, number.gear or 0] |= np.isnan(values)
                following = np.where(np.isnan(values), latest[number], values)
                if extrapolates:
                    limit = _extrapolated(before[number], latest[number], following)
                    limit = np.clip(limit, *_ends(self.laws[number]))
                    following = np.where(moved & np.isfinite(limit), limit, following)
                guess[number][rows], present[number] = following, following
            unsettled = ~still[rows].all(axis=1)
            rows = rows[unsettled]
            if not rows.size:
                break
            part = self._part(rows)
            before, present = (
                {number: column[unsettled] for number, column in columns.items()}
                for columns in (latest, present)
            )
        return guess, still & ~lacking, lacking

    def solved(self) -> tuple[Results, dict[CaseNumber, Floats], Integers]:
        """Return results, all numbers, and the state of each gear (0 for a unique solution)."""
        best, still, lacking = self.iterated(min)
        state = np.where(still, 0, NONE).astype(np.int8)
        for gear in self.of_gear:
            self._count(gear, best, state)
        rows = np.flatnonzero((lacking & (state == NONE)).any(axis=1))
        if rows.size:  # missing torques are reported elsewhere
            lacking[rows] &= self._part(rows).iterated(max)[2]
        state[lacking & (state == NONE)] = 0
        columns = {**self.columns, **best}
        results = solve_points(self.strict, columns, self.variants)
        return results, columns, state

    def _count(self, gear: int, best: dict[CaseNumber, Floats], state: Integers) -> None:
        """Search for all efficiencies of a gear, and set its state."""
        numbers = [n for n in self.of_gear[gear] if len(set(_ends(self.laws[n]))) > 1]
        if not numbers:
            return
        laws = self._laws_of(self.case, gear, numbers, best)
        none = np.zeros((len(numbers), self.variants))
        ends = laws.values(np.arange(self.variants), none, none + np.inf)
        known = np.array([np.where(state[:, gear] == 0, best[n], np.nan) for n in numbers])
        if self.strict.gears[gear].slip_drives and np.isfinite(known).all():
            return
        fixed = find_fixed_points(laws, *ends, known)
        fixed, exist = self._in_range(numbers, best, fixed)
        solutions = np.bincount(fixed.point, exist, self.variants)
        is_solved = np.isin(np.arange(self.variants), fixed.point)
        state[:, gear] = np.where(solutions > 1, SEVERAL, np.where(is_solved, 0, NONE))
        for n, efficiencies in zip(numbers, fixed.efficiencies, strict=True):
            best[n] = best[n].copy()
            best[n][fixed.point] = efficiencies

    def _in_range(
        self, numbers: list[CaseNumber], best: Mapping[CaseNumber, Floats], fixed: AllFixedPoints
    ) -> tuple[AllFixedPoints, Booleans]:
        """Remove invalid solutions of points that also have valid solutions.

        In an invalid solution, the value of a formula is limited, or torques do not exist because a
        slipping shift element would produce power. Also return flags of the solutions with torques.
        """
        valid = np.ones(len(fixed.point), np.bool_)
        gear = numbers[0].gear or 0
        slips = bool(self.case.gears[gear].slip)
        if not fixed.point.size or not (slips or any(self.laws[n].text for n in numbers)):
            return fixed, valid
        torques = self._laws_of(self.strict, gear, numbers, best).torques_at(*fixed)
        valid &= torques.exist
        for n, torque, exponent in zip(numbers, *torques[:2], strict=True):
            law = self.laws[n]
            if law.text:
                sizes = law.sizes_of(self.speeds[n][fixed.point], np.abs(torque))
                valid &= (exponent == 0) | _are_efficiencies(law.at(*sizes))
        remains = valid | ~np.isin(fixed.point, fixed.point[valid])
        fixed = AllFixedPoints(fixed.point[remains], fixed.efficiencies[:, remains])
        return fixed, torques.exist[remains]

    def _laws_of(
        self,
        case: Transmission,
        gear: int,
        numbers: list[CaseNumber],
        best: Mapping[CaseNumber, Floats],
    ) -> Laws:
        """Return the laws that determine `numbers` of a gear, calculated without other gears."""
        alone = case.replace(gears=[case.gears[gear]])
        given = {**self.columns, **best}
        columns = {
            n._replace(gear=n.gear and 0): column
            for n, column in given.items()
            if n.gear in (None, gear)
        }
        owners = [n.owner for n in numbers]
        rows = [self.rows[n] for n in numbers]
        mechanisms = [self.case.mechanisms[owner] for owner in owners]
        ways = [[-1 if m.kind == "variator" else 1] for m in mechanisms]
        is_back = [n.quantity == "back_efficiency" for n in numbers]
        has_back = [m.back_efficiency is not None for m in mechanisms]
        unused = [[-has + 2 * back] for has, back in zip(has_back, is_back, strict=True)]

        def torques_at(point: Integers, efficiencies: Floats) -> TrialTorques:
            at = {number: column[point] for number, column in columns.items()}
            at |= {n._replace(gear=0): e for n, e in zip(numbers, efficiencies, strict=True)}
            results = solve_points(alone, at, len(point))
            torques = results.lossy_torques_Nm[:, 0, rows].T
            signs = results.power_sign[:, 0, owners].T
            exist = results.consistent[:, 0]
            torques = np.where(np.isnan(torques) & exist, 0.0, torques)
            return TrialTorques(torques, np.where(signs * unused > 0, 0.0, signs * ways), exist)

        def bounds(
            over: Callable[..., tuple[Floats, Floats]], point: Integers, low: Floats, high: Floats
        ) -> Extremes:
            each = [
                over(self.laws[n], self.speeds[n][point], *ends)
                for n, *ends in zip(numbers, low, high, strict=True)
            ]
            return Extremes(*map(np.array, zip(*each, strict=True)))

        return Laws(torques_at, partial(bounds, _values_over), partial(bounds, _slopes_over))

    def _part(self, rows: Integers) -> _Search:
        """Return the search for the points with the indices `rows`."""
        part = copy(self)
        part.variants = len(rows)
        part.columns = {number: column[rows] for number, column in self.columns.items()}
        part.speeds = {number: speeds[rows] for number, speeds in self.speeds.items()}
        return part


def _with_held(  # noqa: PLR0913, PLR0917
    case: Transmission,
    plain: Transmission,
    laws: tuple[LawsOf, LawsOf],
    given: Columns,
    found: tuple[dict[CaseNumber, Floats], dict[CaseNumber, tuple[Floats, ...]]],
    lacks: Booleans,
    held: Collection[int],
) -> tuple[dict[CaseNumber, Floats], dict[CaseNumber, tuple[Floats, ...]], Booleans]:
    """Return numbers and sizes with values for more points, and flags of the completed points.

    Trial efficiencies can open a freewheel that holds in the solution, so that the search has no
    torques. Here clutches, which carry torques of any sign, replace the freewheels `held`.
    A point is completed only if the freewheels hold by themselves with the numbers found.
    """
    (known, sought), rows = laws, np.flatnonzero(lacks.any(axis=1))
    tied, part = _with_clutches(plain, held), {n: column[rows] for n, column in given.items()}
    speeds, tied_sizes, moved = _with_speeds(case, tied, known, part, rows.size)
    search = _Search(tied, part, sought, speeds)
    results, part, state = search.solved()
    tied_sizes |= search.sizes(results)
    free = solve_points(plain, part, rows.size)
    holds = lacks[rows] & (state == 0) & ~moved & np.isfinite(free.lossy_output_torque)
    holds &= ~_differ(free.speeds, results.speeds) & ~_differ(results.speeds, speeds.speeds)
    columns, sizes = dict(found[0]), dict(found[1])
    for number, of_number in tied_sizes.items():
        here = holds[:, number.gear or 0]
        at = rows[here]
        for whole, new in zip(sizes[number], of_number, strict=True):
            whole[at] = new[here]
        columns[number] = columns[number].copy()
        columns[number][at] = part[number][here]
    completed = np.zeros_like(lacks)
    completed[rows] = holds
    return columns, sizes, completed


def _subsets(numbers: Collection[int]) -> Iterator[tuple[int, ...]]:
    """Yield all sets of numbers except the empty set, smallest sets first."""
    sizes = range(1, len(numbers) + 1)
    return chain.from_iterable(combinations(numbers, size) for size in sizes)


def _with_clutches(case: Transmission, held: Collection[int]) -> Transmission:
    """Return a case in which engaged clutches replace freewheels, given by their numbers."""
    elements = [
        element._replace(kind="") if number in held else element
        for number, element in enumerate(case.shift_elements, 1)
    ]
    gears = [with_engaged(gear, [*held]) for gear in case.gears]
    return case.replace(shift_elements=elements, gears=gears)


def _values_over(law: Law, speed: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Return bounds of the values of a law at torques from `low` to `high`."""
    if isinstance(law, MapLaw | PointLaw):
        return law.table.values_over(speed, low, high)
    _, values = _sampled(law, speed, low, high)
    slack = np.abs(np.diff(values, 2, axis=0)).max(axis=0) / 4
    least, largest = values.min(axis=0) - slack, values.max(axis=0) + slack
    return np.maximum(least, LEAST_EFFICIENCY), np.minimum(largest, 1.0)


def _slopes_over(law: Law, speed: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Return bounds of the slopes of a law at torques from `low` to `high`."""
    if isinstance(law, MapLaw | PointLaw):
        return law.table.slopes_over(speed, low, high)
    torques, values = _sampled(law, speed, low, high)
    slopes = np.nan_to_num(np.diff(values, axis=0) / np.diff(torques, axis=0))
    slack = np.abs(np.diff(slopes, axis=0)).max(axis=0)
    return slopes.min(axis=0) - slack, slopes.max(axis=0) + slack


def _sampled(law: Law, speed: Floats, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Return torques from `low` to `high`, and the values of a formula there."""
    share = np.linspace(0, 1, FORMULA_SAMPLES)[:, None]
    width = np.where(np.isfinite(high), high - low, LARGEST_FORMULA_TORQUE)
    torques = low + width * np.where(np.isfinite(high), share, share**4)
    values = law.at(*law.sizes_of(np.broadcast_to(speed, torques.shape).ravel(), torques.ravel()))
    values = np.nan_to_num(np.reshape(values, torques.shape), nan=LEAST_EFFICIENCY)
    return torques, np.clip(values, LEAST_EFFICIENCY, 1.0)


def _extrapolated(first: Floats, second: Floats, third: Floats) -> Floats:
    """Return the limits of sequences, extrapolated from three terms by Aitken's method."""
    with np.errstate(divide="ignore", invalid="ignore"):
        limit: Floats = third - (third - second) ** 2 / (third - 2 * second + first)
    return limit


def _ends(law: Law) -> tuple[float, float]:
    ends: tuple[float, float] = getattr(law, "ends", (LEAST_EFFICIENCY, 1.0))
    return ends


def _without_values(results: Results, state: Integers) -> Results:
    """Return results with NaN for losses in gears without a unique solution."""
    wrong = state != 0
    if not wrong.any():
        return results
    changed: dict[str, Any] = {}
    for name in WITH_LOSSES:
        changed[name] = without(results.in_own_unit(name), wrong)
    consistent, undecided = results.consistent & ~wrong, results.undecided | wrong
    return results._replace(**changed, consistent=consistent, undecided=undecided)


def _outside(case: Transmission, laws: LawsOf, sizes: _Sizes, shape: tuple[int, ...]) -> Outside:
    outside = defaultdict[str, Booleans](lambda: np.zeros(shape, np.bool_))
    for number, law in laws.items():
        wrong = law.is_outside(*sizes[number])
        if wrong.any():
            outside[f"{_name(case, number)} ({law.domain()})"][:, number.gear] |= wrong
    return outside


def _name(case: Transmission, number: CaseNumber) -> str:
    if number.quantity == "loss_torques":
        return f"the loss of gear {case.gears[number.gear or 0].name}"
    if number.quantity == "drag":
        return case.link_name(number.owner)
    if number.quantity == "open_drag":
        return case.shift_elements[number.owner - 1].name
    return case.mechanisms[number.owner].name
