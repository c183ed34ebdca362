"""The torque that balances machines and a battery: one unknown of a gear, looked for everywhere.

The power that a link gives to its machine is ``P = -external torque x speed``; the battery gets
``P efficiency`` of it, or gives ``P/efficiency`` where P is below 0. What all of them give it, less
what it is to have, is piecewise nearly linear in the torque of the open link: it is calculated at
torques of both signs and of all sizes, and wherever it changes its sign a solution is looked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import BALANCED, EPSILON
from vstatics.core.statics.physical import RELATIVE_TO_INPUT
from vstatics.core.statics.points.laws import Followed, without_laws
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import loads_of, solve_points
from vstatics.core.statics.results import Results

TRIED = 65
"""Torques at which the battery is calculated."""
WIDEST = 100.0
"""The largest of them, by that which the powers of the gear would need."""
FINEST = 1000.0
"""The larger, the closer they stand at 0."""
EDGE_STEPS = 50
"""Halves to a torque at which friction begins to lock."""
MOST_STEPS = 100
"""Steps to a solution."""
MOST_SOLUTIONS = 3
"""Changes of sign that are followed."""
MOST_AT_ONCE = 100_000
"""Points that are calculated at once."""
TRIED_PART = 0.37
"""Part of the load's torque at which it is tried whether the other torques follow. [-]"""
NO_BALANCE, TWO_BALANCES = 3, 4

Follow = Callable[[Columns, int], Followed]
"""Results of points, whatever else depends there."""


@dataclass(frozen=True, eq=False)
class OpenBalance:
    """The balance of a gear."""

    gear: int
    link: int
    """The link whose torque is sought."""
    efficiencies: tuple[tuple[int, float], ...]
    battery: Floats
    """(points,) [W]"""

    @property
    def number(self) -> CaseNumber:
        """The torque."""
        return CaseNumber(self.gear, "torques", self.link)

    def surplus(self, results: Results) -> Floats:
        """What the battery gets above what it is to have, at each point [W]."""
        entering = results.port_powers_kW[:, self.gear]
        total = -self.battery
        for link, efficiency in self.efficiencies:
            power = -1000 * entering[:, link - 1]
            total = total + battery_power(power, efficiency)
        return total


def battery_power(power: Any, efficiency: float) -> Any:
    """What a battery gets of the power that a link gives its machine; in its unit.

    >>> battery_power(np.array([2.0, -2.0]), 0.8).tolist()
    [1.6, -2.5]
    """
    return np.where(power > 0, power * efficiency, power / efficiency)


def balanced(
    case: Transmission,
    balances: Sequence[OpenBalance],
    given: Columns,
    variants: int,
    follow: Follow,
) -> Followed:
    """Return the results of all points, each balance with the torque that it needs.

    Parameters
    ----------
    case : Transmission
        Without its balances.
    follow : callable
        Calculates points whose torques are all given.
    """
    asked = [_at_points(balance, given, variants) for balance in balances]
    columns = {number: column for number, column in given.items() if number.quantity != "battery"}
    columns |= {one.number: np.zeros(variants) for one in asked}
    scales = _scales(case, asked, follow(columns, variants).results, columns)
    grid = np.sinh(np.linspace(-1, 1, TRIED) * np.arcsinh(FINEST)) / FINEST * WIDEST
    surplus = _tried(asked, columns, scales, grid, follow)
    tried = {
        one: _with_edges(one, columns, np.outer(grid, scales[one]), surplus[one], follow)
        for one in asked
    }
    unknown = np.zeros((variants, len(case.gears)), np.int8)
    counts = {one: np.zeros(variants, np.int64) for one in asked}
    for turn in range(MOST_SOLUTIONS):
        searches = {one: _Between(*_ends(*tried[one], turn)) for one in asked}
        while any(search.is_there.any() for search in searches.values()):
            _solve(searches, columns, follow)
            for one, search in searches.items():
                first = search.stands & (counts[one] == 0)
                columns[one.number] = np.where(first, search.best, columns[one.number])
                counts[one] += search.stands
            searches = {one: search.beyond_gap() for one, search in searches.items()}
    for one, count in counts.items():
        unknown[count == 0, one.gear] = NO_BALANCE
        unknown[count > 1, one.gear] = TWO_BALANCES
    found = follow(columns, variants)
    results = _told(found.results, asked, columns, unknown)
    return Followed(results, found.columns, np.where(unknown, unknown, found.open), found.outside)


def settled_gear(case: Transmission, gear: Gear, state: int) -> Gear:
    """Return a gear whose sought torque is NaN where none balances it, or two do."""
    if state not in (NO_BALANCE, TWO_BALANCES):
        return gear
    link = sought_link(case.gears[case.gear_number(gear.name) - 1], gear)
    return gear._replace(torques={**gear.torques, link: math.nan})


def sought_link(gear: Gear, settled: Gear) -> int:
    """Return the link whose torque balances a gear: only in the settled gear is it given."""
    return next(link for link in settled.torques if link not in gear.torques)


def without_balances(case: Transmission) -> tuple[Transmission, list[OpenBalance]]:
    """Return the case to be solved at given torques, and the balances that these have to meet.

    Raises
    ------
    CaseError
        If several links have neither a speed nor a torque, and equilibrium does not determine all
        of them but one.
    """
    gears, balances = list(case.gears), []
    for index, gear in enumerate(case.gears):
        if gear.balance:
            link, holding = _sought(case, index)
            gears[index] = gear._replace(balance=None, holding=holding)
            battery = np.array([1000 * gear.balance.battery])
            balances.append(OpenBalance(index, link, tuple(gear.balance.efficiencies), battery))
    return case.replace(gears=gears), balances


def _sought(case: Transmission, index: int) -> tuple[int, tuple[int, ...] | None]:
    """Return the link whose torque is sought in a gear, and those whose torques then follow.

    The torque of a machine on a separate train follows from that train alone. So the torque of
    another machine is sought, although its speed is given.
    """
    gear = case.gears[index]
    output = case.gear_output(gear)
    free = gear.open_links((case.gear_input(gear), output))
    machines = [link for link, _ in gear.balance.efficiencies] if gear.balance else []
    candidates = [*free, *(link for link in machines if link in gear.speeds and link != output)]
    for link in candidates:
        holding = tuple(held for held in (*gear.speeds, *free) if held not in (link, output))
        if _follow(case, index, link, holding):
            return link, holding
    if len(free) > 1:
        names = spoken(map(case.link_name, free))
        message = (
            f"read {names} without speed and torque, but equilibrium does not determine all of "
            "their torques but one: expected a speed or a torque for one of them"
        )
        raise CaseError("E269", message, ("gears", index + 1, "balance"))
    return free[0], None


def _follow(case: Transmission, index: int, link: int, holding: tuple[int, ...]) -> bool:
    """Whether all torques of a gear follow from equilibrium, once that on a link is given."""
    gear = case.gears[index]._replace(balance=None, holding=holding)
    alone = without_laws(case.replace(gears=[gear]))
    load: Any = loads_of(alone, {}, 1)[0].torque
    torque = TRIED_PART * np.concatenate([load, -load]) + TRIED_PART
    results = solve_points(alone, {CaseNumber(0, "torques", link): torque}, len(torque))
    held = results.in_own_unit("holding_torques")[:, 0, [other - 1 for other in holding]]
    known = np.isfinite(held).all(axis=-1) & np.isfinite(results.in_own_unit("output_torque")[:, 0])
    return bool((results.balanced[:, 0] & known).any() or results.tied_up.any())


def _at_points(balance: OpenBalance, given: Columns, variants: int) -> OpenBalance:
    battery = given.get(CaseNumber(balance.gear, "battery"), np.repeat(balance.battery, variants))
    return replace(balance, battery=battery)


def _scales(
    case: Transmission, asked: list[OpenBalance], results: Results, columns: Columns
) -> dict[OpenBalance, Floats]:
    """A torque of the size that a balance may need [N*m]."""
    loads = loads_of(case, columns, len(results.speeds))
    found = {}
    for one in asked:
        load: Any = loads[one.gear]
        speed = np.abs(results.speeds[:, one.gear, one.link - 1] * load.speed)
        entering = np.nan_to_num(np.abs(results.port_powers_kW[:, one.gear])).sum(axis=-1)
        needed = (1000 * entering + np.abs(one.battery)) / np.where(speed > 0, speed, np.inf)
        found[one] = np.nan_to_num(np.maximum(np.abs(load.torque), needed)) + 1.0
    return found


def _tried(
    asked: list[OpenBalance], columns: Columns, scales: Any, grid: Floats, follow: Follow
) -> dict[OpenBalance, Floats]:
    """By balance the surplus at all torques of the grid, (torques, points)."""
    variants = len(next(iter(scales.values())))
    at_once = max(1, MOST_AT_ONCE // variants)
    found: dict[OpenBalance, list[Floats]] = {one: [] for one in asked}
    for start in range(0, len(grid), at_once):
        part = grid[start : start + at_once]
        many = {number: np.tile(column, len(part)) for number, column in columns.items()}
        many |= {one.number: np.outer(part, scales[one]).ravel() for one in asked}
        results = follow(many, variants * len(part)).results
        for one in asked:
            again = replace(one, battery=np.tile(one.battery, len(part)))
            found[one].append(again.surplus(results).reshape(len(part), variants))
    return {one: np.concatenate(parts) for one, parts in found.items()}


def _with_edges(
    one: OpenBalance, columns: Columns, torques: Floats, surplus: Floats, follow: Follow
) -> tuple[Floats, Floats]:
    """Torques and surplus, both (torques, points), with one more row between each two.

    Where friction locks the gear at one of the two, it is the last torque at which it does not:
    what changes its sign before it locks is seen so. Else it is the first of the two again.
    """
    lacks = np.isnan(surplus)
    cell, point = np.nonzero(lacks[1:] != lacks[:-1])
    is_second = lacks[cell, point]
    known, beyond = torques[cell + is_second, point], torques[cell + ~is_second, point]
    last = surplus[cell + is_second, point]
    own = {number: column[point] for number, column in columns.items()}
    there = replace(one, battery=one.battery[point])
    for _ in range(EDGE_STEPS if len(cell) else 0):
        middle = (known + beyond) / 2
        found = there.surplus(follow({**own, one.number: middle}, len(cell)).results)
        known, last = np.where(np.isnan(found), (known, last), (middle, found))
        beyond = np.where(np.isnan(found), middle, beyond)
    torques, surplus = (np.repeat(array, 2, axis=0)[:-1] for array in (torques, surplus))
    torques[2 * cell + 1, point], surplus[2 * cell + 1, point] = known, last
    return torques, surplus


def _ends(
    torques: Floats, surplus: Floats, turn: int
) -> tuple[Floats, Floats, Floats, Floats, Booleans]:
    """The ends of one change of sign, with the surplus there; and where there is that change."""
    signs = np.sign(surplus)
    change = (signs[1:] * signs[:-1] < 0) | ((signs[1:] == 0) & (signs[:-1] != 0))
    change[0] |= signs[0] == 0
    place = np.argmax(np.cumsum(change, axis=0) == turn + 1, axis=0)
    is_there = change.sum(axis=0) > turn
    at = np.arange(surplus.shape[1])
    low, high = torques[place, at], torques[place + 1, at]
    return low, high, surplus[place, at], surplus[place + 1, at], is_there


def _solve(searches: Mapping[OpenBalance, _Between], columns: Columns, follow: Follow) -> None:
    """Search for all torques at once."""
    for step in range(MOST_STEPS):
        guess = {one: search.guess(halve=step % 4 == 3) for one, search in searches.items()}
        tried = {**columns, **{one.number: torque for one, torque in guess.items()}}
        results = follow(tried, len(next(iter(guess.values())))).results
        for one, torque in guess.items():
            powers = 1000 * np.abs(results.port_powers_kW[:, one.gear]).sum(axis=-1)
            searches[one].take(torque, one.surplus(results), powers + np.abs(one.battery))
        if all(search.done for search in searches.values()):
            break


class _Between:
    """The zeros between ends, of all points at once, by the rule of Illinois and by halves.

    What friction locks between them counts as beyond the zero, or as before it.
    """

    def __init__(  # noqa: PLR0913
        self,
        low: Floats,
        high: Floats,
        at_low: Floats,
        at_high: Floats,
        is_there: Booleans,
        *,
        beyond: bool = True,
    ) -> None:
        self.ends = low, high, at_low, at_high
        self.beyond, self.gap = beyond, np.zeros(low.shape, np.bool_)
        self.low, self.high = low, high
        self.at_low, self.at_high = at_low, at_high
        self.is_there = is_there
        self.best, self.left = low, np.full(low.shape, np.inf)
        self.sign = np.sign(at_low)
        self.side = np.zeros(low.shape, np.int8)
        """The end that was moved last."""

    def guess(self, *, halve: bool) -> Floats:
        """A torque between the ends."""
        halves: Floats = (self.low + self.high) / 2
        if halve:
            return halves
        straight = self.low - self.at_low * (self.high - self.low) / (self.at_high - self.at_low)
        inside = (straight >= self.low) & (straight <= self.high)
        found: Floats = np.where(inside, straight, halves)
        return found

    def take(self, torque: Floats, surplus: Floats, powers: Floats) -> None:
        """Move an end; of an end that stays twice the value counts half."""
        left = np.nan_to_num(np.abs(surplus / powers), nan=np.inf)
        self.best = np.where(left < self.left, torque, self.best)
        self.left = np.minimum(left, self.left)
        locked = np.isnan(surplus)
        self.gap |= locked
        same = np.where(locked, not self.beyond, np.sign(surplus) == self.sign)
        self.at_high = np.where(same, self.at_high / np.where(self.side > 0, 2, 1), surplus)
        self.at_low = np.where(same, surplus, self.at_low / np.where(self.side < 0, 2, 1))
        self.low, self.high = np.where(same, torque, self.low), np.where(same, self.high, torque)
        self.side = np.where(same, 1, -1).astype(np.int8)

    @property
    def done(self) -> bool:
        """Whether nothing can come nearer."""
        width = np.abs(self.high - self.low)
        narrow = width <= 4 * EPSILON * np.maximum(np.abs(self.low), np.abs(self.high))
        return bool((~self.is_there | narrow | (self.left <= 2 * EPSILON)).all())

    def beyond_gap(self) -> _Between:
        """The search on the other side of what is locked, where something was."""
        return _Between(*self.ends, self.is_there & self.gap & self.beyond, beyond=False)

    @property
    def stands(self) -> Booleans:
        """Where it is a zero, not a jump."""
        found: Booleans = self.is_there & (self.left <= BALANCED)
        return found


def _told(results: Results, asked: list[OpenBalance], columns: Columns, unknown: Any) -> Results:
    """Results with the torques that were found among those that hold; none where there is none."""
    changed: dict[str, Any] = {}
    points: Any = results.points
    for name in ("holding_torques", "lossy_holding_torques"):
        changed[name] = np.array(results.in_own_unit(name))
        for one in asked:
            unit = points.scales["Nm"][:, one.gear]
            changed[name][:, one.gear, one.link - 1] = columns[one.number] / unit
    for name in RELATIVE_TO_INPUT:
        array = changed.get(name, results.in_own_unit(name))
        where = unknown.astype(bool).reshape(*unknown.shape, *[1] * (array.ndim - unknown.ndim))
        changed[name] = np.where(where, np.nan, array)
    for name in ("consistent", "balanced"):
        changed[name] = getattr(results, name) & (unknown == 0)
    return results._replace(**changed)
