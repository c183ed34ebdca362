"""Efficiency over a duty cycle: gears with their shares of energy or of time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

from vstatics.core.errors import CaseError, Problem
from vstatics.core.statics.physical import known_units
from vstatics.core.statics.ports import ports
from vstatics.core.statics.result_arrays import Message
from vstatics.core.statics.results import Results
from vstatics.core.tables.grid import Grid, Values, grid_of, word

Kind = Literal["energy", "time"]
"""What the shares of a duty cycle are shares of."""


class Duty(NamedTuple):
    """A duty cycle."""

    kind: Kind
    shares: Mapping[str, float]
    """Name of a gear -> its share of the input energy, or of the time; of any sum."""


class Stage(NamedTuple):
    """A gear in a duty cycle."""

    gear: str
    energy: float
    """Share of the input energy; all together are 1. [-]"""
    efficiency: float
    """0 where the gear is dragged and nothing leaves it."""


class Cycle(NamedTuple):
    """A duty cycle of a transmission."""

    stages: Sequence[Stage]
    efficiency: float
    """Energy that leaves by energy that enters. [-]"""

    @property
    def damage(self) -> Mapping[str, object]:
        """Damage, which shares by gear do not give."""
        return {}

    @property
    def messages(self) -> Sequence[Message]:
        """Doubts, of which shares by gear have none."""
        return ()

    def grids(self) -> Iterator[Grid]:
        """Yield the table of a summary."""
        title = "Duty cycle: share of the input energy, efficiency"
        rows: list[Values] = [*self.stages, (word("in all"), 1.0, self.efficiency)]
        yield grid_of(title, ["gear", "energy", "efficiency"], rows, key="duty")


def cycle(results: Results, duty: Duty) -> Cycle:
    """Mean efficiency of one case: ``sum(E ETA)/sum(E)`` with the input energies E of its gears.

    Shares of energy are the E themselves; shares of time are multiplied by the input power
    of the gear, which needs a load.

    Raises
    ------
    CaseError
        If a gear with a share is none of the case, has no efficiency, or no input power
        though the shares are of time.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.98)], [Gear([2]), Gear([1])])
    >>> made = cycle(solve(case), Duty("energy", {"1": 1, "2": 3}))
    >>> [stage.energy for stage in made.stages], round(made.efficiency, 4)
    ([0.25, 0.75], 0.9964)
    """
    shares = {gear: share for gear, share in duty.shares.items() if share > 0}
    gears = [gear.name for gear in results.case.gears]
    efficiencies = {gear: _efficiency(results, gear) for gear in gears}
    powers = dict.fromkeys(gears, 1.0 if duty.kind == "energy" else math.nan)
    if duty.kind == "time" and "kW" in known_units(results.case):
        powers = dict(zip(gears, results.input_power_kW.tolist(), strict=True))
    problems = list(_problems(shares, efficiencies, powers))
    if problems:
        raise CaseError(problems)
    largest = max(shares.values())  # shares of any sum: also of one that overflows
    energies = {gear: share / largest * powers[gear] for gear, share in shares.items()}
    total = math.fsum(energies.values())
    stages = [Stage(gear, energy / total, efficiencies[gear]) for gear, energy in energies.items()]
    return Cycle(stages, math.fsum(stage.energy * stage.efficiency for stage in stages))


def _efficiency(results: Results, gear: str) -> float:
    """What leaves a gear by what enters it, also where it is dragged, NaN where it has no power."""
    number = results.case.gear_number(gear)
    if not results.dragged[number - 1]:
        return float(results.efficiency[number - 1])
    power = {"in": 0.0, "out": 0.0, "": 0.0}
    for port in ports(results.gear_at(number - 1)).ports:
        power[port.way] += port.power
    return power["out"] / power["in"]


def _problems(
    shares: Mapping[str, float], efficiencies: Mapping[str, float], powers: Mapping[str, float]
) -> Iterator[Problem]:
    """Why the mean efficiency does not exist; paths are those of the duty cycle."""
    for gear in shares:
        if gear not in efficiencies:
            yield Problem("E416", "there is no such gear in the case", (gear,))
        elif not math.isfinite(efficiencies[gear]):
            yield Problem("E417", "the gear has no efficiency, expected no share for it", (gear,))
        elif not powers[gear] > 0:
            message = "shares of time need the power of the gear, expected a load with speed"
            yield Problem("E418", f"{message} and torque", (gear,))
    if not shares:
        yield Problem("E419", "all shares are 0, expected one above 0")
