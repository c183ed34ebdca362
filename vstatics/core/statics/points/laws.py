"""Drags and efficiencies that depend: a fixed point over arrays.

Speeds come first; from them follow drags, and efficiencies over speed, for all points at once.
Where freewheels change with that, it is done again until they stay. Efficiencies over torque are
looked for from the least and from the largest that they can be, and where only one of a gear is
unknown between them, too: one solution is wanted.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Path, Problem
from vstatics.core.model.parts import HOUSING, Law
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import SAME_SOLUTION, STANDS_STILL, TIE
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.points.relative import loads_of, solve_points
from vstatics.core.statics.result_arrays import ARRAYS, Outside, first_rows, row_names
from vstatics.core.statics.results import Results

MOST_PASSES = 100
"""Passes in which numbers have to stand still."""
MOST_STATES = 8
"""Passes in which freewheels have to stand still."""
SCANNED = 17
"""Efficiencies between the least and the largest, at which a single unknown is tried."""
MOST_FOUND = 3
"""Solutions that are followed."""
HALVES = 60
"""Steps to one of them."""
NONE, SEVERAL = 1, 2
WITH_LOSSES = (
    *("lossy_torques", "lossy_holding_torques", "efficiency", "losses", "power_balance"),
    *("drag_losses", "lossy_mesh_torques", "mesh_losses", "power_sign"),
)
"""Arrays of which nothing is known where no single torque agrees with an efficiency."""

Laws = Mapping[CaseNumber, Law]


class Followed(NamedTuple):
    """What a case with laws, or with balances, comes to at its points."""

    results: Results
    columns: Columns
    """With all numbers that follow from laws."""
    open: Any
    outside: Outside


def laws_of(case: Transmission) -> Laws:
    """All laws of a case, by the numbers that they give."""
    numbers: dict[CaseNumber, Any] = {}
    for index, gear in enumerate(case.gears):
        for n, torque in case.gear_open_drag(gear).items():
            numbers[CaseNumber(index, "open_drag", n)] = torque
        for link, torque in case.gear_drag(gear).items():
            numbers[CaseNumber(index, "drag", link)] = torque
        for owner, mechanism in enumerate(case.mechanisms):
            numbers[CaseNumber(index, "efficiency", owner)] = mechanism.efficiency
            numbers[CaseNumber(index, "back_efficiency", owner)] = mechanism.back_efficiency
    return {number: law for number, law in numbers.items() if isinstance(law, Law)}


def without_laws(case: Transmission) -> Transmission:
    """The case with plain numbers in place of laws: no drag, efficiencies as at 0."""

    def plain(number: Any, instead: float) -> Any:
        return instead if isinstance(number, Law) else number

    return case.replace(
        drag={link: plain(torque, 0.0) for link, torque in case.drag.items()},
        shift_elements=[e._replace(drag=plain(e.drag, 0.0)) for e in case.shift_elements],
        mechanisms=[
            one._replace(
                efficiency=plain(one.efficiency, float(one.efficiency)),
                back_efficiency=plain(one.back_efficiency, float(one.back_efficiency or 0)),
            )
            for one in case.mechanisms
        ],
        gears=[
            gear._replace(
                drag={link: plain(torque, 0.0) for link, torque in gear.drag.items()},
                open_drag={n: plain(torque, 0.0) for n, torque in gear.open_drag.items()},
            )
            for gear in case.gears
        ],
    )


def follow_laws(case: Transmission, given: Columns, variants: int) -> Followed:
    """The results of all points, with drags and efficiencies as they are there."""
    laws = {number: law for number, law in laws_of(case).items() if number not in given}
    plain = without_laws(case)
    over_speed = {number: law for number, law in laws.items() if law.over == "speed"}
    over_torque = {number: law for number, law in laws.items() if law.over == "torque"}
    columns: dict[CaseNumber, Floats] = dict(given)
    results, sizes, moved = _with_speeds(case, plain, over_speed, columns, variants)
    unsettled = np.where(moved, NONE, 0)
    if over_torque:
        search = _Search(plain, columns, over_torque, variants)
        with_efficiencies, columns, states = search.solved()
        moved = _differ(with_efficiencies.speeds, results.speeds)
        unsettled = np.where(moved, NONE, np.where(states, states, unsettled))
        results = with_efficiencies
        sizes |= search.sizes(results)
    results = _without_values(results, unsettled)
    return Followed(results, columns, unsettled, _outside(case, laws, sizes))


def _outside(case: Transmission, laws: Laws, sizes: Mapping[CaseNumber, Floats]) -> Outside:
    """Where laws are asked outside their points."""
    found: dict[str, Any] = {}
    for number, law in laws.items():
        if not law.points:
            continue
        wrong = law.is_outside(sizes[number])  # type: ignore[attr-defined] # it has points
        if wrong.any():
            none = np.zeros((len(wrong), len(case.gears)), np.bool_)
            found.setdefault(_called(case, number), none)[:, number.gear] |= wrong
    return found


def _with_speeds(
    case: Transmission,
    plain: Transmission,
    laws: Laws,
    columns: dict[CaseNumber, Floats],
    variants: int,
) -> tuple[Results, dict[CaseNumber, Floats], Booleans]:
    """Results with what depends on speed, the speeds that laws asked for, where they still move.

    Drag may turn a freewheel, which changes the speeds.
    """
    results = solve_points(plain, columns, variants)
    for _ in range(MOST_STATES):
        before = results.speeds
        sizes = {number: _speed(plain, results, columns, number) for number in laws}
        for number, law in laws.items():
            columns[number] = _checked(case, number, law.at(sizes[number]))
        results = solve_points(plain, columns, variants)
        moved = _differ(results.speeds, before) & bool(case.freewheels)
        if not moved.any():
            break
    return results, sizes, moved


def _differ(speeds: Floats, others: Floats) -> Booleans:
    """By point and gear: whether a speed is another one, or is no longer determined."""
    same: Booleans = np.isclose(speeds, others, rtol=TIE, atol=TIE, equal_nan=True)
    differ: Any = (~same).any(axis=-1)
    return differ  # type: ignore[no-any-return] # an array


def _speed(case: Transmission, results: Results, columns: Columns, number: CaseNumber) -> Floats:
    """The magnitude of the speed that a law asks for [rad/s]; 0 where it is not determined."""
    index, quantity, owner = number
    if quantity == "drag":
        speed = results.speeds[:, index, owner - 1]
    elif quantity == "open_drag":
        speed = results.slip_speeds[:, index, owner - 1]
    else:
        first, _, third = case.mechanisms[owner].links
        speed = np.zeros(len(results.speeds))
        for link, sign in ((first, 1), (third, -1)):
            if link != HOUSING:
                speed = speed + sign * results.speeds[:, index, link - 1]
    own: Any = loads_of(case, columns, len(results.speeds))[index or 0].speed
    size: Floats = np.nan_to_num(np.abs(speed * own))
    return size


def _checked(case: Transmission, number: CaseNumber, values: Any) -> Floats:
    """What a law gives; else the first value that can't be."""
    wrong = ~(np.isfinite(values) & (values >= 0))
    if wrong.any():
        what = f"the drag of {_called(case, number)}"
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
    found: Floats = values
    return found


def _called(case: Transmission, number: CaseNumber) -> str:
    """The name of what has a law."""
    if number.quantity == "drag":
        return case.link_name(number.owner)
    if number.quantity == "open_drag":
        return case.shift_elements[number.owner - 1].name
    return case.mechanisms[number.owner].name


class _Search:
    """Efficiencies over torque, that agree with the torques that they make."""

    def __init__(self, case: Transmission, columns: Columns, laws: Laws, variants: int) -> None:
        self.case, self.columns, self.laws = case, columns, laws
        self.variants = variants
        names = row_names(case, "torques")
        first = first_rows(case)
        self.rows = {number: names.index(first[number.owner]) for number in laws}
        self.of_gear: dict[int, list[CaseNumber]] = {}
        for number in laws:
            self.of_gear.setdefault(number.gear or 0, []).append(number)

    def sizes(self, results: Results) -> dict[CaseNumber, Floats]:
        """The magnitude of the torque that each law asks for [N*m]; NaN where there is none."""
        torques = results.lossy_torques_Nm
        return {number: np.abs(torques[:, number.gear, row]) for number, row in self.rows.items()}

    def _tried(
        self, guess: Mapping[CaseNumber, Floats]
    ) -> tuple[Results, dict[CaseNumber, Floats]]:
        """Results with guessed efficiencies, and the efficiencies that their torques have."""
        results = solve_points(self.case, {**self.columns, **guess}, self.variants)
        sizes = self.sizes(results)
        return results, {number: law.at(sizes[number]) for number, law in self.laws.items()}

    def _from(self, end: Any) -> tuple[dict[CaseNumber, Floats], Booleans, Booleans]:
        """The numbers that stand still from one end on; by gear where they do, where none is."""
        guess = {
            number: np.full(self.variants, float(end(y for _, y in law.points)))
            for number, law in self.laws.items()
        }
        still, lacking = np.zeros((2, self.variants, len(self.case.gears)), np.bool_)
        for _ in range(MOST_PASSES):
            _, found = self._tried(guess)
            still[:], lacking[:] = True, False
            for number, values in found.items():
                moved = np.abs(values - guess[number]) > STANDS_STILL
                still[:, number.gear or 0] &= ~moved
                lacking[:, number.gear or 0] |= np.isnan(values)
                guess[number] = np.where(np.isnan(values), guess[number], values)
            if still.all():
                break
        return guess, still & ~lacking, lacking

    def solved(self) -> tuple[Results, dict[CaseNumber, Floats], Any]:
        """Results with the one solution, its numbers, and where there is none or another."""
        several = any(len(numbers) > 1 for numbers in self.of_gear.values())
        starts = [self._from(end) for end in (min, max, *[_middle] * several)]
        best, still, lacking = starts[0]
        state = np.where(still, 0, NONE).astype(np.int8)
        for numbers, stands, lacks in starts[1:]:
            lacking &= lacks
            for number in self.laws:
                gear = number.gear or 0
                apart = np.abs(best[number] - numbers[number]) > SAME_SOLUTION
                state[still[:, gear] & stands[:, gear] & apart, gear] = SEVERAL
                best[number] = np.where(still[:, gear], best[number], numbers[number])
            state[~still & stands] = 0
            still = still | stands
        self._scan(best, state)
        state[lacking & (state == NONE)] = 0  # no torque to agree with: the gear says why
        columns = {**self.columns, **best}
        results = solve_points(self.case, columns, self.variants)
        return results, columns, state

    def _scan(self, best: dict[CaseNumber, Floats], state: Any) -> None:
        """Look between the ends where a gear has one unknown: how many solutions there are."""
        single = [numbers[0] for numbers in self.of_gear.values() if len(numbers) == 1]
        if not single:
            return
        values = {n: [y for _, y in self.laws[n].points] for n in single}
        grid = {n: np.linspace(min(y), max(y), SCANNED) for n, y in values.items()}
        left = {n: np.empty((SCANNED, self.variants)) for n in single}
        for place in range(SCANNED):
            guess = {**best, **{n: np.full(self.variants, grid[n][place]) for n in single}}
            _, found = self._tried(guess)
            for n in single:
                left[n][place] = found[n] - guess[n]
        for n in single:
            self._count(n, best, state, grid[n], left[n])

    def _count(
        self, number: CaseNumber, best: dict[CaseNumber, Floats], state: Any, grid: Any, left: Any
    ) -> None:
        """Follow the changes of sign where there are several, or nothing stood still."""
        turns = np.sign(left[1:]) * np.sign(left[:-1]) < 0
        turns |= (left[1:] == 0) & (np.arange(1, SCANNED) < SCANNED - 1)[:, None]
        own, order = state[:, number.gear], np.cumsum(turns, axis=0)
        beyond = np.abs(best[number] - (grid[1:] + grid[:-1])[:, None] / 2) - SAME_SOLUTION
        among = (turns & (beyond <= (grid[1:] - grid[:-1])[:, None] / 2)).any(axis=0)
        asked = (order[-1] > 1) | (((own == NONE) | ~among) & (order[-1] > 0))
        solutions = ((own == 0) & ~among).astype(np.int64)
        for turn in range(min(int(order[-1].max()), MOST_FOUND) if asked.any() else 0):
            place = np.argmax(turns & (order == turn + 1), axis=0)
            root, stands = self._between(number, best, grid, left, place)
            stands &= asked & (order[-1] > turn)
            first = stands & (own == NONE) & (solutions == 0)
            best[number] = np.where(first, root, best[number])
            solutions += stands
        own[asked & (own == NONE) & (solutions == 1)] = 0
        own[asked & (solutions > 1)] = SEVERAL

    def _between(
        self,
        number: CaseNumber,
        best: Mapping[CaseNumber, Floats],
        grid: Floats,
        left: Floats,
        place: Any,
    ) -> tuple[Floats, Booleans]:
        """The solution behind a place of the grid, by halves; and where it is one, not a jump."""
        low, high = grid[place], grid[place + 1]
        at_low = np.sign(np.take_along_axis(left, place[None], axis=0)[0])
        for _ in range(HALVES):
            middle = (low + high) / 2
            _, found = self._tried({**best, number: middle})
            values = found[number] - middle
            above = np.sign(values) == at_low
            low, high = np.where(above, middle, low), np.where(above, high, middle)
        stands: Booleans = np.abs(values) <= SAME_SOLUTION
        return middle, stands


def _middle(values: Iterable[float]) -> float:
    """Between the least and the largest."""
    known = [*values]
    return (min(known) + max(known)) / 2


def _without_values(results: Results, state: Any) -> Results:
    """Results that say nothing of losses where there is no single solution."""
    wrong = state != 0
    if not wrong.any():
        return results
    changed: dict[str, Any] = {}
    for name in (*WITH_LOSSES, "consistent"):
        array = results.in_own_unit(name)
        where = wrong if array.ndim == wrong.ndim else wrong[..., None]
        changed[name] = np.where(where, False if ARRAYS[name].dtype is np.bool_ else np.nan, array)
    return results._replace(**changed, undecided=results.undecided | wrong)
