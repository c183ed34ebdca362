"""Search for the torque on a link that balances the powers of electric machines and a battery.

A link gives its machine the power ``P = -external torque x speed``. The battery receives ``P x
efficiency`` if P is positive, and delivers ``-P/efficiency`` if P is negative. An efficiency can
depend on the speed and the torque of its machine. The surplus is the power that the battery
receives from all machines, minus the charging power that the case prescribes. The module `roots`
searches a grid of torques of both signs for the torques at which the surplus vanishes.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from vstatics.core.errors import CaseError, spoken
from vstatics.core.model.laws import MapLaw
from vstatics.core.model.parts import RAD_PER_RPM, Law
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers, without
from vstatics.core.numerics.tolerances import BALANCED
from vstatics.core.statics.physical import RELATIVE_TO_INPUT
from vstatics.core.statics.points.laws import Followed, without_laws
from vstatics.core.statics.points.machines import battery_power, efficiency_at, outside_map
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import loads_of, solve_points
from vstatics.core.statics.points.roots import Follow, find_roots
from vstatics.core.statics.result_arrays import Outside
from vstatics.core.statics.results import Results

GRID_SIZE = 65
"""Number of trial torques in the grid."""
GRID_WIDTH = 100.0
"""Largest torque of the grid, relative to the result of `_scales`. [-]"""
GRID_REFINEMENT = 1000.0
"""Value of sinh at the end of the grid, which follows sinh to have more trial torques near 0. [-]
"""
MOST_SOLUTIONS = 3
"""Largest number of sign changes of the surplus in which a torque is searched for."""
STEEP_CELL_POINTS = 5
"""Number of trial torques in a cell of a map in which the battery's power can have an extremum."""
PROBE_PART = 0.37
"""Arbitrary trial torque, to test if torques are determinate, relative to the input torque. [-]"""
NO_BALANCE, TWO_BALANCES = 3, 4
"""States of a gear: no torque balances the battery, or several torques do."""


@dataclass(frozen=True, eq=False)
class OpenBalance:
    """Battery balance of a gear that determines the torque on a link."""

    gear: int
    link: int
    """Link with the unknown torque."""
    efficiencies: tuple[tuple[int, float], ...]
    """Link and efficiency of each machine; an efficiency can be a law. [-]"""
    battery: Floats
    """Charging power of the battery, shape (points,). [W]"""

    @property
    def number(self) -> CaseNumber:
        """Key of the unknown torque in the columns of varied numbers."""
        return CaseNumber(self.gear, "torques", self.link)

    def surplus(self, results: Results) -> Floats:
        """Return the surplus of power at each point [W]."""
        entering = results.port_powers_kW[:, self.gear]
        total = -self.battery
        for link, efficiency in self.efficiencies:
            power = -1000 * entering[:, link - 1]
            speed, torque = self.machine(results, link, power)
            total = total + battery_power(power, efficiency_at(efficiency, speed, torque, power))
        return total

    def size(self, results: Results) -> Floats:
        """Return the sum of the magnitudes of all powers at each point [W], for comparison."""
        entering = 1000 * np.abs(results.port_powers_kW[:, self.gear]).sum(axis=-1)
        powers: Floats = entering + np.abs(self.battery)
        return powers

    def at(self, points: Integers) -> OpenBalance:
        """Return the balance for the points with the indices `points`."""
        return replace(self, battery=self.battery[points])

    def machine(self, results: Results, link: int, power: Floats) -> tuple[Floats, Floats]:
        """Return the magnitude of a machine's speed [rad/s], and the torque along the speed [N*m].

        The torque is calculated from the power that the link gives to the machine [W]. It is
        negative for a positive power (generator), and 0 at rest.
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
    """Calculate all points with the torques that satisfy the battery balances.

    Parameters
    ----------
    case : Transmission
        Case without balances.
    balances : sequence of OpenBalance
        Balances of the gears.
    given : mapping
        Varied numbers.
    variants : int
        Number of points.
    follow : callable
        Function that calculates points with known torques.
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
    grids = {
        balance: _with_steep_cells(balance, np.outer(grid, scales[balance]), columns, follow)
        for balance in open_balances
    }
    roots = find_roots(grids, columns, follow, most=MOST_SOLUTIONS, agreed=BALANCED)
    unknown = np.zeros((variants, len(case.gears)), np.int8)
    for balance in open_balances:
        found = roots[balance]
        columns[balance.number] = np.nan_to_num(found.first)
        unknown[found.number == 0, balance.gear] = NO_BALANCE
        unknown[found.number > 1, balance.gear] = TWO_BALANCES
    solution = follow(columns, variants)
    results = _with_torques(solution.results, open_balances, columns, unknown)
    return solution._replace(
        results=results,
        open=np.where(unknown, unknown, solution.open),
        outside={**solution.outside, **_outside(case, open_balances, results)},
    )


def _with_steep_cells(
    balance: OpenBalance, grid: Floats, columns: Columns, follow: Follow
) -> Floats:
    """Insert trial torques in cells of maps in which the battery's power can have an extremum.

    In such a cell the efficiency changes relatively more than the torque of the machine.
    """
    inner: dict[int, Floats] = {}
    for link, law in balance.efficiencies:
        if isinstance(law, MapLaw):
            values, ends = np.array(law.table.values), np.array(law.columns)
            sizes = np.maximum(abs(ends[1:]), abs(ends[:-1])) / np.diff(ends)
            least = np.minimum(values[:, 1:], values[:, :-1])
            steep = (abs(np.diff(values)) * sizes >= least).any(axis=0)
            torques = np.linspace(ends[:-1][steep], ends[1:][steep], STEEP_CELL_POINTS).ravel()
            inner[link] = torques if ends[0] < 0 else np.hstack([torques, -torques])
    if not any(torques.size for torques in inner.values()):
        return grid
    results = [follow({**columns, balance.number: row}, grid.shape[1]).results for row in grid]
    extra = []
    for link, wanted in inner.items():
        powers = [-1000 * at.port_powers_kW[:, balance.gear, link - 1] for at in results]
        pairs = zip(results, powers, strict=True)
        of_machine = [np.nan_to_num(balance.machine(at, link, power)[1]) for at, power in pairs]
        order = np.argsort(of_machine, axis=0)
        ordered = np.take_along_axis(np.array(of_machine), order, axis=0).T
        trials = np.take_along_axis(grid, order, axis=0).T
        grid_of = zip(ordered, trials, strict=True)
        extra.append(np.array([np.interp(wanted, *pair) for pair in grid_of]).T)
    return np.sort(np.vstack([grid, *extra]), axis=0)


def _outside(case: Transmission, balances: Sequence[OpenBalance], results: Results) -> Outside:
    """Return flags of points at which a machine is outside its efficiency map, by link name."""
    outside = defaultdict[str, Booleans](lambda: np.zeros_like(results.consistent))
    for balance in balances:
        for link, law in balance.efficiencies:
            if not isinstance(law, Law):
                continue
            power = -1000 * results.port_powers_kW[:, balance.gear, link - 1]
            speed, torque = balance.machine(results, link, power)
            wrong = outside_map(law, speed, torque, power)
            if wrong.any():
                outside[f"{case.link_name(link)} ({law.domain()})"][:, balance.gear] |= wrong
    return outside


def unknown_torque(gear: Gear, settled: Gear) -> Gear:
    """Return a solved gear, with NaN for the torque that the balance does not determine."""
    return settled._replace(torques={**settled.torques, sought_link(gear, settled): math.nan})


def sought_link(gear: Gear, settled: Gear) -> int:
    """Return the link with the unknown torque: only the solved gear has a torque on it."""
    return next(link for link in settled.torques if link not in gear.torques)


def without_balances(case: Transmission) -> tuple[Transmission, list[OpenBalance]]:
    """Split a case into the case without balances, and the balances with unknown torques.

    Raises
    ------
    CaseError
        If several links have neither a speed nor a torque, and no single torque determines the
        others by equilibrium.
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
    """Return the link with the unknown torque in a gear, and the links with dependent torques.

    A machine on a separate gear train has a torque from the equilibrium of this train. The unknown
    is then the torque of another machine, even if that has a prescribed speed.
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
            f"read {names} without speed and torque, but the balance determines the torque of one "
            "link only: expected a speed or a torque for the others"
        )
        raise CaseError("E269", message, ("gears", index + 1, "balance"))
    return free[0], None


def _is_determined(case: Transmission, index: int, link: int, holding: tuple[int, ...]) -> bool:
    """Return whether all torques of a gear are known if the torque on `link` is known."""
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


def _with_torques(
    results: Results, balances: list[OpenBalance], columns: Columns, unknown: Any
) -> Results:
    """Return results with the solved torques; NaN if there is no unique solution."""
    changed: dict[str, Any] = {}
    points: Any = results.points
    for name in ("holding_torques", "lossy_holding_torques"):
        changed[name] = np.array(results.in_own_unit(name))
        for balance in balances:
            unit = points.scales["Nm"][:, balance.gear]
            changed[name][:, balance.gear, balance.link - 1] = columns[balance.number] / unit
    for name in RELATIVE_TO_INPUT:
        changed[name] = without(changed.get(name, results.in_own_unit(name)), unknown != 0)
    for name in ("consistent", "balanced"):
        changed[name] = getattr(results, name) & (unknown == 0)
    return results._replace(**changed)
