"""Choice of gears in a driving cycle: by shift speeds, or the highest possible gear.

The last engine speed is the speed of the last full-load point. A gear in which the engine would
exceed it is chosen only if no other gear is possible.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import listed, quoted
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.readers.named.si_units import measured
from vstatics.core.summary.design_table import ranges_of
from vstatics.vehicle.operation.point_loads import unknown_gear
from vstatics.vehicle.operation.trace import blocks


class ShiftSpeed(NamedTuple):
    """Road speeds of shifts between two neighbouring gears."""

    low: str
    high: str
    up: float
    """Mean road speed of a step from which the higher gear is engaged. [m/s]"""
    down: float
    """Mean road speed of a step below which the lower gear is engaged. [m/s]"""

    def between(self, names: Collection[str]) -> ShiftSpeed:
        """Return the shift between two of the given gears, whose names can contain dashes.

        >>> ShiftSpeed("2", "-3", 5.0, 4.0).between(["2-", "3"])[:2]
        ('2-', '3')
        """
        text = f"{self.low}-{self.high}"
        for at, letter in enumerate(text):
            low, high = text[:at].strip(), text[at + 1 :].strip()
            if letter == "-" and low in names and high in names:
                return self._replace(low=low, high=high)
        return self


def read_shifts(text: str) -> list[ShiftSpeed]:
    """Parse shift speeds of neighbouring gears, beginning with the lowest gears.

    Raises
    ------
    ValueError
        If the text is invalid; the message states the expected form.

    Examples
    --------
    >>> [shift.low for shift in read_shifts("1-2: 18 km/h/14.4 km/h, 2-3: 36 km/h/27 km/h")]
    ['1', '2']
    >>> read_shifts("1-2: 18 km/h/14.4 km/h")[0].down.__round__(9)
    4.0
    """
    shifts: list[ShiftSpeed] = []
    for item in text.split(","):
        gears, colon, speeds = item.partition(":")
        gears = gears.strip()
        low, dash, high = gears[1:].partition("-")  # a name can begin with a dash
        low, high = f"{gears[:1]}{low}".strip(), high.strip()
        up, down = _two_speeds(speeds)
        if not (colon and dash and low and high) or up is None or down is None:
            example = "1-2: 15 km/h/12 km/h, 2-3: 30 km/h/25 km/h"
            expected = f"a text such as {example!r}, each speed with its unit"
            raise ValueError(f"read {item.strip()!r}, expected {expected}")
        if down > up:
            raise ValueError(f"read {item.strip()!r}, expected a downshift below the upshift")
        if shifts and shifts[-1].high != low and "-" not in shifts[-1].high + high:
            raise ValueError(f"read {item.strip()!r}, expected a shift from gear {shifts[-1].high}")
        shifts.append(ShiftSpeed(low, high, up, down))
    return shifts


def _two_speeds(text: str) -> tuple[float | None, float | None]:
    """Parse two speeds [m/s] separated by a slash; units can contain slashes, too."""
    for at, letter in enumerate(text):
        if letter == "/":
            try:
                parts = (text[:at].strip(), text[at + 1 :].strip())
                up, down = (measured(part, "velocity") for part in parts)
            except ValueError:
                continue
            if up >= 0 and down >= 0 and all(any(map(str.isalpha, part)) for part in parts):
                return up, down
    return None, None


def directions(ratios: Floats, names: Sequence[str]) -> list[list[int]]:
    """Return gear indices by direction of travel, forward first; each begins with the lowest gear.

    >>> directions(np.array([-3.3, 1.0, 4.7, np.nan]), ["R", "2", "1", "N"])
    [[2, 1], [0]]
    """
    return ranges_of(ratios.tolist(), [True] * len(ratios), names)


class EngineSpeeds(NamedTuple):
    """Engine speeds in each gear at the steps of a driving cycle."""

    output: Floats
    """Magnitudes of output speeds, shape (steps,). [rad/s]"""
    ratios: Floats
    """Engine speed divided by output speed, shape (gears,). [-]"""
    at_rest: Floats
    """Engine speeds from slips in rpm while the output is at rest, shape (gears,). [rad/s]"""
    may_turn: Callable[[Floats], Booleans]
    """Function that returns True for speeds [rad/s] within the engine's range."""
    slipping: Collection[int] = ()
    """Indices of gears with slipping converters, which count as lower than gears of equal ratio."""

    def of(self, gear: int | Integers, rows: slice = slice(None)) -> Floats:
        """Return engine speeds in a gear, or in a gear for each step, at some steps [rad/s].

        They are 0 at standstill, also in gears without a ratio.
        """
        output = self.output[rows]
        return np.where(output > 0, output * self.ratios[gear] + self.at_rest[gear], 0.0)


def _ladder(shifts: Sequence[ShiftSpeed]) -> list[str]:
    """Return the gears of shifts in their order."""
    ladder = [shifts[0].low, *(shift.high for shift in shifts)]
    for gear, (low, high, _, _) in zip(ladder, shifts, strict=False):
        if gear != low:
            raise ValueError(f"read {f'{low}-{high}'!r}, expected a shift from gear {gear}")
    return ladder


def by_shift_speeds(
    case: Transmission,
    shifts: Sequence[ShiftSpeed],
    speeds: Floats,
    engine: EngineSpeeds,
    ratios: Floats,
) -> Integers:
    """Return the gear index of each step by shift speeds, beginning in the lowest of these gears.

    An upshift occurs at the last engine speed at the latest.

    Parameters
    ----------
    case : Transmission
    shifts : sequence of ShiftSpeed
    speeds : ndarray, shape (steps,)
        Mean road speeds. [m/s]
    engine : EngineSpeeds
    ratios : ndarray, shape (gears,)
        Ratios of the case; NaN if other machines drive, too. [-]

    Raises
    ------
    ValueError
        If a gear does not exist, or if an upshift leads to a larger ratio, another direction, or a
        gear without ratio.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, 2.0)], [Gear(), Gear()])
    >>> speeds, ratios = np.array([3.0, 5.0, 4.5, 3.9]), np.array([2.0, 2.0])
    >>> engine = EngineSpeeds(speeds, ratios, np.zeros(2), np.isfinite)
    >>> by_shift_speeds(case, [ShiftSpeed("1", "2", 5.0, 4.0)], speeds, engine, ratios)
    array([0, 1, 1, 0])
    """
    names = [gear.name for gear in case.gears]
    ladder = _ladder([shift.between(names) for shift in shifts])
    for name in ladder:
        if name not in names:
            raise ValueError(unknown_gear(case, name))
    alike = directions(ratios, names)
    pairs = [f"{names[lower]}-{names[upper]}" for way in alike for lower, upper in pairwise(way)]
    size = dict(zip(names, np.abs(ratios).tolist(), strict=True))
    for low, high in pairwise(ladder):
        both = {names.index(low), names.index(high)}
        if len(both) == 1 or not any(both <= {*way} for way in alike):
            message = f"the shift {low}-{high} does not connect two gears of the same direction"
            raise ValueError(f"{message}; neighbours: {listed(pairs, 20) or 'none'}")
        if size[high] > size[low] * (1 + SAME_RATIO):
            sizes = " and ".join(f"{quoted(name)} {size[name]:.6g}" for name in (low, high))
            message = f"the upshift from {quoted(low)} to {quoted(high)} leads to the larger ratio"
            raise ValueError(f"{message} ({sizes}), expected the lower gear first: {high}-{low}")
    numbers = [names.index(name) for name in ladder]
    place, chosen = 0, np.empty(len(speeds), np.int64)
    for rows in blocks(len(speeds)):
        columns = [engine.may_turn(engine.of(gear, rows)).tolist() for gear in numbers]
        places = []
        for speed, is_allowed in zip(
            speeds[rows].tolist(), zip(*columns, strict=True), strict=True
        ):
            while place < len(shifts) and (speed >= shifts[place].up or not is_allowed[place]):
                place += 1
            while place and speed < shifts[place - 1].down and is_allowed[place - 1]:
                place -= 1
            places.append(place)
        chosen[rows] = np.array(numbers)[places]
    return chosen


def by_least_speed(engine: EngineSpeeds, least: float, ahead: Sequence[int]) -> Integers:
    """Return the highest gear, for each step, in which the engine reaches a least speed.

    If no gear reaches it, and at standstill, the lowest gear within the last engine speed is
    chosen. If all gears exceed the last engine speed, the highest gear is chosen.

    Parameters
    ----------
    engine : EngineSpeeds
    least : float
        Least speed of the engine. [rad/s]
    ahead : sequence of int
        Indices of the forward gears.

    Examples
    --------
    The engine speed should be from 100 to 600 rad/s. In the first step, the engine is too fast in
    gear 0 and too slow in gear 1; in the second step it is too fast in both.

    >>> outputs, ratios = np.array([90.0, 700.0]), np.array([7.0, 1.0])
    >>> engine = EngineSpeeds(outputs, ratios, np.zeros(2), lambda speeds: speeds <= 600)
    >>> by_least_speed(engine, 100.0, [0, 1])
    array([1, 1])
    """
    slips = engine.at_rest != 0
    slips[[*engine.slipping]] = True
    ascending = sorted(ahead, key=lambda gear: (engine.ratios[gear], slips[gear]))
    chosen = np.full(len(engine.output), ascending[0] if ascending else 0)
    for gear in ascending:
        chosen[engine.may_turn(engine.of(gear))] = gear
    for gear in reversed(ascending):
        speeds = engine.of(gear)
        chosen[engine.may_turn(speeds) & (speeds >= least) & (engine.output > 0)] = gear
    return chosen
