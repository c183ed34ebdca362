"""Search for the speed ratio at which the pump of a converter takes the torque of its gear.

The torque M that the gear (with all losses) gives to the pump, and the speed w of the pump, depend
on the speed ratio i. At the working point ``M = lambda(i) w |w|``, equation (1.38) of Tsitovich and
Algin, 1981. The module `roots` searches all speed ratios between the first and the last point of
the converter. If there are several solutions, the largest speed ratio is used.

In a gear with a slipping lock-up clutch, the slip determines i. The pump takes its torque, and the
clutch carries the rest.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from vstatics.core.model.fields import join
from vstatics.core.model.parts import HOUSING, RAD_PER_RPM, Mechanism
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats, Integers, without
from vstatics.core.numerics.tolerances import (
    EPSILON,
    SAME_PUMP_TORQUE,
    SAME_SOLUTION,
    SETTLED_PUMP_TORQUE,
    TIE,
)
from vstatics.core.statics.carried import is_supplied, pump_factor
from vstatics.core.statics.matrix import torque_ratio_of
from vstatics.core.statics.physical import RELATIVE_TO_INPUT
from vstatics.core.statics.points.laws import Followed, without_laws
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import solve_points
from vstatics.core.statics.points.roots import Follow, Roots, find_roots
from vstatics.core.statics.result_arrays import first_rows, row_names
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import LOSSY_SPEED_RATIO

LEAST_TRIALS = 65
"""Smallest number of trial speed ratios in the grid."""
MOST_SPEED_RATIOS = 16
"""Largest number of sign changes of the surplus in which a speed ratio is searched for."""
ROUNDED = 16 * EPSILON
"""Relative difference of the torques on a pump that is attributed to rounding. [-]"""
TRIALS = 0.382, 0.618
"""Trial speed ratios for gears without a solution, from 0 (first point) to 1 (last point). [-]"""
NO_RATIO, NO_TORQUE = 6, 7
"""States of a gear: no speed ratio agrees with the load, or no torques exist at any speed ratio."""
OF_SPEEDS = ("speeds", "planet_speeds", "slip_speeds", "ratio", "speed_ratio")
"""Names of arrays that can depend on the speed ratio of a converter."""


@dataclass(frozen=True, eq=False)
class SoughtRatio:
    """Converter whose speed ratio depends on the load of a gear."""

    gear: int
    owner: int
    """Number of the converter among the `mechanisms` of the case, without gear sets."""
    converter: Mechanism
    rows: tuple[int, int]
    """Indices of the converter on the last axes of the arrays `torques` and `speed_ratio`."""
    is_alone: bool
    """True if only the converter connects its pump and turbine, and the input drives the pump.

    The speed of the pump and the torque on the pump then do not depend on the speed ratio.
    """
    freewheel: int
    """Result of `freewheel_side` for the converter."""

    @property
    def number(self) -> CaseNumber:
        """Key of the speed ratio in the columns of varied numbers."""
        return CaseNumber(self.gear, "speed_ratios", self.owner)

    @property
    def ends(self) -> tuple[float, float]:
        """First and last speed ratio of the converter's points [-]."""
        return self.converter.points[0][0], self.converter.points[-1][0]

    @property
    def grid(self) -> Floats:
        """Trial speed ratios in descending order, including the points of the converter [-].

        Trials are added directly below and above each speed ratio at which the converter loses no
        power, because no torques exist beyond that ratio. With a
        freewheel, 1 is also a trial, because the freewheel can lock up the converter there.
        """
        by_ratio = [point[0] for point in self.converter.points]
        pieces = math.ceil((LEAST_TRIALS - 1) / max(len(by_ratio) - 1, 1))
        parts = [np.linspace(*ends, pieces, endpoint=False) for ends in pairwise(by_ratio)]
        lossless = np.outer(
            lossless_ratios(self.converter.points), [1 - ROUNDED, 1, 1 + ROUNDED]
        ).ravel()
        locked = [1.0] if self.freewheel else []
        trials = np.concatenate([*parts, by_ratio[-1:], lossless, locked])
        inside = np.unique(trials[(trials >= by_ratio[0]) & (trials <= by_ratio[-1])])[::-1]
        return inside if len(inside) > 1 else np.repeat(inside, 2)

    def at(self, points: Integers) -> SoughtRatio:  # noqa: ARG002 - equal for all points
        """Return the object itself, which is the same for all points."""
        return self

    def surplus(self, results: Results) -> Floats:
        """Return the torque given to the pump minus the torque that the pump takes [N*m].

        The difference is 0 where a freewheel locks up the converter, and where it supplies the
        torque that the driven pump lacks at the speed ratio 1.
        """
        ratio = self._ratio(results)
        brought, speed = self.on_pump(results)
        taken = pump_factor(self.converter.points, ratio) * speed * np.abs(speed)
        left: Floats = brought - taken
        agrees = np.abs(left) <= ROUNDED * np.maximum(np.abs(brought), np.abs(taken))
        agrees |= np.isnan(ratio) & results.consistent[:, self.gear]
        agrees |= is_supplied(self.freewheel, ratio, brought, left)
        return np.where(agrees, 0.0, left)

    def size(self, results: Results) -> Floats:
        """Return the torque on the pump or, if larger, the most that the pump can take [N*m]."""
        brought, speed = self.on_pump(results)
        most = max(abs(point[2]) for point in self.converter.points)
        size: Floats = np.maximum(np.abs(brought), most * speed**2)
        return np.where(size > 0, size, 1.0)

    @property
    def slow(self) -> float:
        """Low speed ratio at which a converter driven by the pump certainly loses power [-]."""
        return min(self.ends[1], LOSSY_SPEED_RATIO)

    @property
    def fast(self) -> float:
        """High speed ratio at which a converter driven by the turbine certainly loses power [-]."""
        last, torque_ratio = self.converter.points[-1][:2]
        return 2 * max(last, 1.0, 1 / torque_ratio if torque_ratio else 0.0)

    def _ratio(self, results: Results) -> Floats:
        return results.speed_ratio[:, self.gear, self.rows[1]]

    def on_pump(self, results: Results) -> tuple[Floats, Floats]:
        """Return the torque that the gear gives to the pump [N*m], and the pump speed [rad/s]."""
        speeds = results.speeds_rpm[:, self.gear, self.converter.first - 1]
        return results.lossy_torques_Nm[:, self.gear, self.rows[0]], speeds * RAD_PER_RPM


def lossless_ratios(points: Iterable[Sequence[float]]) -> list[float]:
    """Return the speed ratios i [-] at which the interpolated torque ratio has the value 1/i.

    >>> lossless_ratios([(0, 1.25, 0.002), (1, 1.25, -0.001)])
    [0.8]
    """
    ratios = []
    for (left, before, _), (right, after, _) in pairwise(points):
        slope = (after - before) / (right - left)
        roots = np.roots([slope, before - slope * left, -1])
        real = (float(root.real) for root in roots if abs(root.imag) < TIE)
        ratios += [root for root in real if left <= root <= right]
    return [ratio for ratio in ratios if ratio > 0]


def with_varied_slips(case: Transmission, columns: Columns) -> Transmission:
    """Return a case with 1 for each varied slip of 0, which would bypass the converter."""
    gears = list(case.gears)
    for (index, quantity, owner), column in columns.items():
        if index is not None and quantity in ("slip", "relative_slip") and column.any():
            gear = gears[index]
            if gear.slip.get(owner) == 0:
                gears[index] = gear._replace(slip={**gear.slip, owner: 1.0})
    return case if gears == list(case.gears) else case.replace(gears=gears)


def without_sought(case: Transmission, given: Columns) -> tuple[Transmission, list[SoughtRatio]]:
    """Split a case into a case with trial speed ratios, and the unknown speed ratios.

    Parameters
    ----------
    given : mapping
        Varied numbers. A speed ratio among these is known.
    """
    gears, sought = list(case.gears), list[SoughtRatio]()
    torques, ratios = first_rows(case), row_names(case, "converters")
    for index, gear in enumerate(case.gears):
        for place in case.sought_converters(gear):
            owner = place - case.own_mechanisms.start + 1
            numbers = CaseNumber(index, "speed_ratios", owner), CaseNumber(index, "ratio", place)
            if any(number in given for number in numbers):
                continue
            part = case.mechanisms[place]
            rows = torques[place], ratios.index(part.name)
            side = case.freewheel_side(gear, place)
            ratio = SoughtRatio(index, owner, part, rows, _is_alone(case, gear, place), side)
            sought.append(ratio)
            trial = {**gear.speed_ratios, owner: _trial(ratio, TRIALS[0])}
            gears[index] = gear._replace(speed_ratios=trial)
    return (case.replace(gears=gears) if sought else case), sought


def _is_alone(case: Transmission, gear: Gear, place: int) -> bool:
    """Return whether the input drives a pump that only the converter connects with its turbine.

    It is also required that no speed is prescribed, and that the turbine drives the output: the
    torque of a turbine that drives only its drag does not depend on the torque of the input.
    """
    bodies = list(range(case.links + 1))
    drag, freewheels = case.gear_open_drag(gear), case.freewheels
    joining: list[Iterable[int]] = [
        element.links
        for number, element in enumerate(case.shift_elements, 1)
        if number in {*gear.carrying, *freewheels} or drag[number]
    ]
    joining += [part.links for n, part in enumerate(case.mechanisms) if n != place]
    joining += [spring.form for spring in case.springs]
    for links in joining:
        join(bodies, *(link for link in links if link != HOUSING))
    pump, turbine = (bodies[link] for link in case.mechanisms[place].links[:2])
    slipping = case.elements_at(gear.slipping)
    slips = {bodies[link] for element in slipping for link in element.links if link != HOUSING}
    is_given = gear.speeds or gear.balance is not None or turbine in slips
    ends = bodies[case.gear_input(gear)], bodies[case.gear_output(gear)]
    return pump == ends[0] and pump not in (turbine, ends[1]) and not is_given


def _trial(ratio: SoughtRatio, part: float) -> float:
    first, last = ratio.ends
    return first + part * (last - first)


def with_found_ratios(
    case: Transmission,
    sought: Sequence[SoughtRatio],
    given: Columns,
    variants: int,
    follow: Follow,
) -> Followed:
    """Calculate all points, with the speed ratios at which the pumps take the torques of the gears.

    Parameters
    ----------
    case : Transmission
        Case with trial speed ratios.
    sought : sequence of SoughtRatio
        Unknown speed ratios of different gears.
    given : mapping
        Varied numbers.
    variants : int
        Number of points.
    follow : callable
        Function that calculates points with known speed ratios.
    """
    trials = [
        {ratio.number: np.full(variants, _trial(ratio, part)) for ratio in sought}
        for part in TRIALS
    ]
    by_slip = _ratios_by_slip(case, sought, given, variants)
    for trial in trials:
        for ratio, (at_slip, _) in by_slip.items():
            trial[ratio.number] = np.where(np.isnan(at_slip), trial[ratio.number], at_slip)
    columns = {**given, **trials[0]}
    searched = [ratio for ratio in sought if ratio not in by_slip]
    roots = _roots(searched, columns, variants, follow)
    for ratio, (at_slip, torque) in by_slip.items():
        columns[ratio.number._replace(quantity="pump_torques")] = torque
        roots[ratio] = Roots(at_slip[np.newaxis], np.isfinite(torque))
    state = np.zeros((variants, len(case.gears)), np.int8)
    others: dict[int, Floats] = {}
    for ratio in sought:
        found = -np.sort(-roots[ratio].values, axis=0)
        lacks = np.isnan(found[0])
        columns[ratio.number] = np.where(lacks, columns[ratio.number], found[0])
        others[ratio.gear] = _apart(found)
        state[lacks, ratio.gear] = NO_TORQUE
        state[lacks & roots[ratio].has_surplus, ratio.gear] = NO_RATIO
    solution = follow(columns, variants)
    results = solution.results
    if state.any():
        tried = [ratio for ratio in searched if not ratio.is_alone]
        _mark_gaining(tried, columns, variants, follow, state)
        other = {n: np.where(state[:, n.gear], t, columns[n]) for n, t in trials[1].items()}
        results = _without_ratios(results, follow({**columns, **other}, variants).results, state)
    return solution._replace(
        results=results, open=np.where(state, state, solution.open), others=others
    )


def _ratios_by_slip(
    case: Transmission, sought: Sequence[SoughtRatio], given: Columns, variants: int
) -> dict[SoughtRatio, tuple[Floats, Floats]]:
    """Return speed ratio [-] and pump torque [N*m] of converters whose lock-up clutch slips."""
    with_slip = {
        ratio.gear: ratio for ratio in sought if case.gears[ratio.gear].slip and not ratio.is_alone
    }
    if not with_slip:
        return {}
    gears = list(case.gears)
    for index, ratio in with_slip.items():
        others = {n: i for n, i in gears[index].speed_ratios.items() if n != ratio.owner}
        opened = (*gears[index].open, ratio.owner)
        gears[index] = gears[index]._replace(open=opened, speed_ratios=others)
    speeds = solve_points(without_laws(case.replace(gears=gears)), given, variants).speeds_rpm
    ratios = {}
    for index, ratio in with_slip.items():
        pump, turbine = (
            speeds[:, index, link - 1] * RAD_PER_RPM for link in ratio.converter.links[:2]
        )
        if np.isfinite(pump - turbine).any():
            at_slip = turbine / pump
            points = ratio.converter.points
            inside = (at_slip >= points[0][0] - TIE) & (at_slip <= points[-1][0] + TIE)
            if case.bypassed(case.gears[index]._replace(engaged=case.gears[index].carrying)):
                # A slip of 0 bypasses the converter, whose speed ratio is then 1 by definition.
                locks = np.abs(at_slip - 1) <= ROUNDED
                at_slip, inside = np.where(locks, 1.0, at_slip), inside | locks
            torque = pump_factor(points, at_slip) * pump * np.abs(pump)
            ratios[ratio] = np.where(inside, at_slip, np.nan), torque
    return ratios


def _roots(
    sought: Sequence[SoughtRatio], columns: Columns, variants: int, follow: Follow
) -> dict[SoughtRatio, Roots]:
    """Return the speed ratios that agree with the load, by search only if necessary."""
    alone = [ratio for ratio in sought if ratio.is_alone]
    others = [ratio for ratio in sought if not ratio.is_alone]
    roots: dict[SoughtRatio, Roots] = {}
    if alone:
        trial = {**columns, **{ratio.number: np.full(variants, ratio.slow) for ratio in alone}}
        slow = fast = follow(trial, variants).results
        lacks = {ratio: np.isnan(ratio.on_pump(slow)[0]) for ratio in alone}
        if any(where.any() for where in lacks.values()):
            for ratio, where in lacks.items():
                trial[ratio.number] = np.where(where, ratio.fast, ratio.slow)
            fast = follow(trial, variants).results
        roots = {ratio: _roots_alone(ratio, slow, fast) for ratio in alone}
    if not others:
        return roots
    longest = max(len(ratio.grid) for ratio in others)
    grids = {
        ratio: np.repeat(_extended(ratio.grid, longest)[:, None], variants, axis=1)
        for ratio in others
    }
    found = find_roots(
        grids,
        columns,
        follow,
        most=MOST_SPEED_RATIOS,
        agreed=SAME_PUMP_TORQUE,
        enough=SETTLED_PUMP_TORQUE,
    )
    return roots | found


def _roots_alone(ratio: SoughtRatio, slow: Results, fast: Results) -> Roots:
    """Return the speed ratios of a converter for which `is_alone` is true, without iteration.

    The torque and the speed of the pump are known from two trial solutions, and lambda is linear
    between the points.
    """
    brought, speed = (
        np.fmax(*pair) for pair in zip(*map(ratio.on_pump, (slow, fast)), strict=True)
    )
    with np.errstate(all="ignore"):
        factor = brought / (speed * np.abs(speed))
    found = []
    points = ratio.converter.points
    for (left, _, before), (right, _, after) in pairwise(points[:1] + points):
        near = ROUNDED * np.maximum(np.abs(factor), max(abs(before), abs(after)))
        inside = (min(before, after) - near <= factor) & (factor <= max(before, after) + near)
        inside &= np.isfinite(factor)  # a pump at rest takes no torque
        part = np.ones_like(factor) if before == after else (factor - before) / (after - before)
        root = left + np.clip(part, 0.0, 1.0) * (right - left)
        lost = brought * speed * (1 - torque_ratio_of(ratio.converter, root) * root)
        gains = lost < -ROUNDED * np.abs(brought * speed)
        found.append(np.where(inside & ~gains, root, np.nan))
    return Roots(np.array([*found, np.full_like(factor, np.nan)]), np.isfinite(brought))


def _extended(grid: Floats, length: int) -> Floats:
    return np.concatenate([grid, np.repeat(grid[-1:], length - len(grid))])


def _apart(found: Floats) -> Floats:
    """Return the speed ratios below the largest solution, (points, ratios); NaN for repetitions."""
    others = found[1:].copy()
    others[found[:-1] - found[1:] <= SAME_SOLUTION] = np.nan
    return others.T


def _mark_gaining(
    sought: Sequence[SoughtRatio],
    columns: Columns,
    variants: int,
    follow: Follow,
    state: Integers,
) -> None:
    """Set the state NO_RATIO for gears that lack torques only because of the converter.

    In a gear that coasts, for example, the converter would gain power at every speed ratio of its
    points. At larger speed ratios it would lose power, and torques would exist.
    """
    lacks = state == NO_TORQUE
    if not lacks[:, [ratio.gear for ratio in sought]].any():
        return
    beyond = {
        ratio.number: np.where(lacks[:, ratio.gear], ratio.fast, columns[ratio.number])
        for ratio in sought
    }
    results = follow({**columns, **beyond}, variants).results
    for ratio in sought:
        exists = np.isfinite(ratio.surplus(results))
        state[exists & lacks[:, ratio.gear], ratio.gear] = NO_RATIO


def _without_ratios(results: Results, other: Results, state: Integers) -> Results:
    """Return results without torques in gears whose speed ratio is unknown.

    Speeds are also unknown if they differ between two trial speed ratios.
    """
    changed: dict[str, Any] = {}
    lacks = state != 0
    for name in (*OF_SPEEDS, *RELATIVE_TO_INPUT, "power_sign"):
        array = results.in_own_unit(name)
        changed[name] = without(array, lacks)
        if name in OF_SPEEDS:
            same = np.isclose(array, other.in_own_unit(name), rtol=TIE, atol=TIE, equal_nan=True)
            changed[name] = np.where(same, array, changed[name])
    for name in ("consistent", "balanced", "locked", "dragged"):
        changed[name] = getattr(results, name) & ~lacks
    turned = results.turned & ~lacks[..., np.newaxis]
    return results._replace(
        **changed, turned=turned, undecided=results.undecided | (state == NO_RATIO)
    )


def unknown_ratio(gear: Gear, settled: Gear) -> Gear:
    """Return a solved gear, with NaN for a speed ratio that the load does not determine."""
    owners = settled.speed_ratios.keys() - gear.speed_ratios.keys()
    unknown = dict.fromkeys(owners, math.nan)
    return settled._replace(speed_ratios={**settled.speed_ratios, **unknown})


def known_speed_ratios(results: Results, number: int) -> dict[str, float]:
    """Return the known speed ratios of converters in a gear, by name [-].

    Parameters
    ----------
    number : int
        Index of the gear.
    """
    names = row_names(results.case, "converters")
    ratios = zip(names, results.speed_ratio[number].tolist(), strict=True)
    return {name: ratio for name, ratio in ratios if not math.isnan(ratio)}
