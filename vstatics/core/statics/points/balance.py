"""Search for the torque on a link that balances the powers of electric machines and a battery.

A link gives its machine the power ``P = -external torque x speed``; the battery receives
``P x efficiency``, or gives ``P/efficiency`` if P is below 0. An efficiency can depend on the speed
and the torque of its machine. The surplus is the sum over all machines minus the charging power
that the case demands. It is a piecewise nearly linear function of the unknown torque. It is
calculated on a grid of torques of both signs and all sizes. In the first `MOST_SOLUTIONS` intervals
in which its sign changes, roots are searched for by the Illinois rule (Dowell, Jarratt 1971) and
bisection.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.parts import RAD_PER_RPM, Law
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import BALANCED, EPSILON
from vstatics.core.statics.physical import RELATIVE_TO_INPUT
from vstatics.core.statics.points.laws import Followed, without_laws
from vstatics.core.statics.points.machines import battery_power, efficiency_at, machine_torque
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import loads_of, solve_points
from vstatics.core.statics.result_arrays import Outside
from vstatics.core.statics.results import Results

GRID_SIZE = 65
"""Number of torques in the grid."""
GRID_WIDTH = 100.0
"""Largest torque of the grid, relative to the torque expected from the powers of the gear. [-]"""
GRID_REFINEMENT = 1000.0
"""Value of sinh at the end of the grid; a larger value places more of its torques near 0. [-]"""
EDGE_STEPS = 50
"""Number of bisections to find the torque at which friction begins to lock the gear."""
MOST_ROOT_STEPS = 100
"""Largest number of iterations for a root."""
MOST_SOLUTIONS = 3
"""Largest number of sign changes searched for roots."""
MOST_POINTS_AT_ONCE = 100_000
"""Largest number of points calculated at once, to limit memory."""
PROBE_PART = 0.37
"""Arbitrary torque, relative to the input torque, to test if other torques are determinate. [-]"""
NO_BALANCE, TWO_BALANCES = 3, 4
"""Numbers for the states of a gear: no torque balances the battery, or several torques do."""

Follow = Callable[[Columns, int], Followed]
"""Function that solves points, including laws."""


@dataclass(frozen=True, eq=False)
class OpenBalance:
    """Battery balance of a gear with the unknown torque of a link."""

    gear: int
    link: int
    """Link with the unknown torque."""
    efficiencies: tuple[tuple[int, float], ...]
    """Links and efficiencies of machines, which can be laws."""
    battery: Floats
    """Charging power of the battery, shape (points,). [W]"""

    @property
    def number(self) -> CaseNumber:
        """Key of the unknown torque in the columns of varied numbers."""
        return CaseNumber(self.gear, "torques", self.link)

    def surplus(self, results: Results) -> Floats:
        """Return the surplus of charging power at each point [W]."""
        entering = results.port_powers_kW[:, self.gear]
        total = -self.battery
        for link, efficiency in self.efficiencies:
            power = -1000 * entering[:, link - 1]
            speed, torque = self.machine(results, link, power)
            total = total + battery_power(power, efficiency_at(efficiency, speed, torque, power))
        return total

    def machine(self, results: Results, link: int, power: Floats) -> tuple[Floats, Floats]:
        """Return the magnitude of a machine's speed [rad/s], and its torque along it [N*m].

        The torque follows from the power given to the machine [W]; it is 0 at rest.
        """
        speed = np.abs(results.speeds_rpm[:, self.gear, link - 1]) * RAD_PER_RPM
        return speed, np.divide(-power, speed, out=np.zeros_like(power), where=speed > 0)


def balanced(
    case: Transmission,
    balances: Sequence[OpenBalance],
    given: Columns,
    variants: int,
    follow: Follow,
) -> Followed:
    """Solve all points, with the torques that satisfy the balances.

    Parameters
    ----------
    case : Transmission
        Case without balances.
    balances : sequence of OpenBalance
        Balances of the gears.
    given : mapping
        Columns of varied numbers.
    variants : int
        Number of points.
    follow : callable
        Function that solves points with given torques.
    """
    open_balances = []
    for balance in balances:
        constant = np.repeat(balance.battery, variants)
        battery = given.get(CaseNumber(balance.gear, "battery"), constant)
        open_balances.append(replace(balance, battery=battery))
    columns = {number: column for number, column in given.items() if number.quantity != "battery"}
    columns |= {balance.number: np.zeros(variants) for balance in open_balances}
    scales = _scales(case, open_balances, follow(columns, variants).results, columns)
    grid = (
        np.sinh(np.linspace(-1, 1, GRID_SIZE) * np.arcsinh(GRID_REFINEMENT))
        / GRID_REFINEMENT
        * GRID_WIDTH
    )
    surplus = _surpluses(open_balances, columns, scales, grid, follow)
    tried = {
        balance: _with_edges(
            balance, columns, np.outer(grid, scales[balance]), surplus[balance], follow
        )
        for balance in open_balances
    }
    unknown = np.zeros((variants, len(case.gears)), np.int8)
    counts = {balance: np.zeros(variants, np.int64) for balance in open_balances}
    for turn in range(MOST_SOLUTIONS):
        searches = {
            balance: _RootSearch(*_ends(*tried[balance], turn)) for balance in open_balances
        }
        while any(search.is_there.any() for search in searches.values()):
            _iterate(searches, columns, follow)
            for balance, search in searches.items():
                first = search.stands & (counts[balance] == 0)
                columns[balance.number] = np.where(first, search.best, columns[balance.number])
                counts[balance] += search.stands
            searches = {balance: search.beyond_gap() for balance, search in searches.items()}
    for balance, count in counts.items():
        unknown[count == 0, balance.gear] = NO_BALANCE
        unknown[count > 1, balance.gear] = TWO_BALANCES
    solution = follow(columns, variants)
    results = _with_torques(solution.results, open_balances, columns, unknown)
    return Followed(
        results,
        solution.columns,
        np.where(unknown, unknown, solution.open),
        {**solution.outside, **_outside(case, open_balances, results)},
        solution.wrong,
    )


def _outside(case: Transmission, balances: Sequence[OpenBalance], results: Results) -> Outside:
    """Return the points at which a machine is outside the map of its efficiency, by its link."""
    outside: dict[str, Booleans] = {}
    for balance in balances:
        for link, law in balance.efficiencies:
            if not isinstance(law, Law):
                continue
            power = -1000 * results.port_powers_kW[:, balance.gear, link - 1]
            speed, torque = balance.machine(results, link, power)
            wrong = law.is_outside(*law.sizes_of(speed, machine_torque(law, torque)))
            wrong &= power != 0
            if wrong.any():
                none = np.zeros_like(results.consistent)
                outside.setdefault(case.link_name(link), none)[:, balance.gear] |= wrong
    return outside


def settled_gear(case: Transmission, gear: Gear, state: int) -> Gear:
    """Return a gear whose unknown torque is NaN unless it has exactly one solution."""
    if state not in (NO_BALANCE, TWO_BALANCES):
        return gear
    link = sought_link(case.gears[case.gear_number(gear.name) - 1], gear)
    return gear._replace(torques={**gear.torques, link: math.nan})


def sought_link(gear: Gear, settled: Gear) -> int:
    """Return the link with the unknown torque: only the settled gear has a torque on this link."""
    return next(link for link in settled.torques if link not in gear.torques)


def without_balances(case: Transmission) -> tuple[Transmission, list[OpenBalance]]:
    """Separate a case into a case without balances and the balances with unknown torques.

    Raises
    ------
    CaseError
        If several links have neither speed nor torque, and a torque on a single link would not
        determine the others by equilibrium.
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
    """Return the link with the unknown torque in a gear, and links whose torques follow.

    If a machine is on a separate gear train, that train determines its torque. The unknown is then
    the torque of another machine, although its speed is given.
    """
    gear = case.gears[index]
    output = case.gear_output(gear)
    free = gear.open_links((case.gear_input(gear), output))
    machines = [link for link, _ in gear.balance.efficiencies] if gear.balance else []
    candidates = [*free, *(link for link in machines if link in gear.speeds and link != output)]
    for link in candidates:
        holding = tuple(held for held in (*gear.speeds, *free) if held not in (link, output))
        if _is_determined(case, index, link, holding):
            return link, holding
    if len(free) > 1:
        names = spoken(map(case.link_name, free))
        message = (
            f"read {names} without speed and torque, but equilibrium does not determine all of "
            "their torques but one: expected a speed or a torque for one of them"
        )
        raise CaseError("E269", message, ("gears", index + 1, "balance"))
    return free[0], None


def _is_determined(case: Transmission, index: int, link: int, holding: tuple[int, ...]) -> bool:
    """Return whether a given torque on a link determines all other torques of a gear."""
    gear = case.gears[index]._replace(balance=None, holding=holding)
    alone = without_laws(case.replace(gears=[gear]))
    load: Any = loads_of(alone, {}, 1)[0].torque
    torque = PROBE_PART * np.concatenate([load, -load]) + PROBE_PART
    results = solve_points(alone, {CaseNumber(0, "torques", link): torque}, len(torque))
    held = results.in_own_unit("holding_torques")[:, 0, [other - 1 for other in holding]]
    known = np.isfinite(held).all(axis=-1) & np.isfinite(results.in_own_unit("output_torque")[:, 0])
    return bool((results.balanced[:, 0] & known).any() or results.tied_up.any())


def _scales(
    case: Transmission, balances: list[OpenBalance], results: Results, columns: Columns
) -> dict[OpenBalance, Floats]:
    """Estimate the magnitude of the unknown torque of each balance [N*m], shape (points,)."""
    loads = loads_of(case, columns, len(results.speeds))
    scales = {}
    for balance in balances:
        load: Any = loads[balance.gear]
        speed = np.abs(results.speeds[:, balance.gear, balance.link - 1] * load.speed)
        entering = np.nan_to_num(np.abs(results.port_powers_kW[:, balance.gear])).sum(axis=-1)
        needed = (1000 * entering + np.abs(balance.battery)) / np.where(speed > 0, speed, np.inf)
        scales[balance] = np.nan_to_num(np.maximum(np.abs(load.torque), needed)) + 1.0
    return scales


def _surpluses(
    balances: list[OpenBalance], columns: Columns, scales: Any, grid: Floats, follow: Follow
) -> dict[OpenBalance, Floats]:
    """Return the surplus of each balance at all torques of the grid, shape (torques, points)."""
    variants = len(next(iter(scales.values())))
    at_once = max(1, MOST_POINTS_AT_ONCE // variants)
    surpluses: dict[OpenBalance, list[Floats]] = {balance: [] for balance in balances}
    for start in range(0, len(grid), at_once):
        part = grid[start : start + at_once]
        many = {number: np.tile(column, len(part)) for number, column in columns.items()}
        many |= {balance.number: np.outer(part, scales[balance]).ravel() for balance in balances}
        results = follow(many, variants * len(part)).results
        for balance in balances:
            again = replace(balance, battery=np.tile(balance.battery, len(part)))
            surpluses[balance].append(again.surplus(results).reshape(len(part), variants))
    return {balance: np.concatenate(parts) for balance, parts in surpluses.items()}


def _with_edges(
    balance: OpenBalance, columns: Columns, torques: Floats, surplus: Floats, follow: Follow
) -> tuple[Floats, Floats]:
    """Insert a row between all rows of torques and surplus, both of shape (torques, points).

    If friction locks the gear at one of two neighbouring torques only, the new row has the last
    torque before it locks, found by bisection, so that a sign change before that torque is not
    missed. Otherwise the new row repeats the first of the two.
    """
    lacks = np.isnan(surplus)
    cell, point = np.nonzero(lacks[1:] != lacks[:-1])
    is_second = lacks[cell, point]
    known, beyond = torques[cell + is_second, point], torques[cell + ~is_second, point]
    last = surplus[cell + is_second, point]
    at_points = {number: column[point] for number, column in columns.items()}
    there = replace(balance, battery=balance.battery[point])
    for _ in range(EDGE_STEPS if len(cell) else 0):
        middle = (known + beyond) / 2
        surplus_there = there.surplus(
            follow({**at_points, balance.number: middle}, len(cell)).results
        )
        known, last = np.where(np.isnan(surplus_there), (known, last), (middle, surplus_there))
        beyond = np.where(np.isnan(surplus_there), middle, beyond)
    torques, surplus = (np.repeat(array, 2, axis=0)[:-1] for array in (torques, surplus))
    torques[2 * cell + 1, point], surplus[2 * cell + 1, point] = known, last
    return torques, surplus


def _ends(
    torques: Floats, surplus: Floats, turn: int
) -> tuple[Floats, Floats, Floats, Floats, Booleans]:
    """Return torques and surplus at both ends of a sign change, and flags of existence.

    `turn` is the number of the sign change at each point, from 0.
    """
    signs = np.sign(surplus)
    change = (signs[1:] * signs[:-1] < 0) | ((signs[1:] == 0) & (signs[:-1] != 0))
    change[0] |= signs[0] == 0
    place = np.argmax(np.cumsum(change, axis=0) == turn + 1, axis=0)
    is_there = change.sum(axis=0) > turn
    at = np.arange(surplus.shape[1])
    low, high = torques[place, at], torques[place + 1, at]
    return low, high, surplus[place, at], surplus[place + 1, at], is_there


def _iterate(searches: Mapping[OpenBalance, _RootSearch], columns: Columns, follow: Follow) -> None:
    for step in range(MOST_ROOT_STEPS):
        guess = {balance: search.guess(halve=step % 4 == 3) for balance, search in searches.items()}
        tried = {**columns, **{balance.number: torque for balance, torque in guess.items()}}
        results = follow(tried, len(next(iter(guess.values())))).results
        for balance, torque in guess.items():
            powers = 1000 * np.abs(results.port_powers_kW[:, balance.gear]).sum(axis=-1)
            searches[balance].take(
                torque, balance.surplus(results), powers + np.abs(balance.battery)
            )
        if all(search.done for search in searches.values()):
            break


class _RootSearch:
    """Search for roots between two ends, at all points at once.

    The Illinois rule (regula falsi with halved values of an end that stays) alternates with
    bisection. Torques at which friction locks the gear have no surplus: they count as beyond the
    root if `beyond`, else as before the root.
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
        """End that was moved last: 1 low, -1 high."""

    def guess(self, *, halve: bool) -> Floats:
        """Return a torque between the ends."""
        halves: Floats = (self.low + self.high) / 2
        if halve:
            return halves
        straight = self.low - self.at_low * (self.high - self.low) / (self.at_high - self.at_low)
        inside = (straight >= self.low) & (straight <= self.high)
        torque: Floats = np.where(inside, straight, halves)
        return torque

    def take(self, torque: Floats, surplus: Floats, powers: Floats) -> None:
        """Move an end to a torque; halve the value of an end that stays twice."""
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
        """True if no root can be approached further."""
        width = np.abs(self.high - self.low)
        narrow = width <= 4 * EPSILON * np.maximum(np.abs(self.low), np.abs(self.high))
        return bool((~self.is_there | narrow | (self.left <= 2 * EPSILON)).all())

    def beyond_gap(self) -> _RootSearch:
        """Return the search for roots beyond the torques at which friction locks the gear."""
        return _RootSearch(*self.ends, self.is_there & self.gap & self.beyond, beyond=False)

    @property
    def stands(self) -> Booleans:
        """Flags of points with a root, not a jump, at `best`."""
        is_root: Booleans = self.is_there & (self.left <= BALANCED)
        return is_root


def _with_torques(
    results: Results, balances: list[OpenBalance], columns: Columns, unknown: Any
) -> Results:
    """Return results with the torques found, and NaN at points with no or several solutions."""
    changed: dict[str, Any] = {}
    points: Any = results.points
    for name in ("holding_torques", "lossy_holding_torques"):
        changed[name] = np.array(results.in_own_unit(name))
        for balance in balances:
            unit = points.scales["Nm"][:, balance.gear]
            changed[name][:, balance.gear, balance.link - 1] = columns[balance.number] / unit
    for name in RELATIVE_TO_INPUT:
        array = changed.get(name, results.in_own_unit(name))
        where = unknown.astype(bool).reshape(*unknown.shape, *[1] * (array.ndim - unknown.ndim))
        changed[name] = np.where(where, np.nan, array)
    for name in ("consistent", "balanced"):
        changed[name] = getattr(results, name) & (unknown == 0)
    return results._replace(**changed)
