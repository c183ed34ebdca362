"""Mean efficiency over a duty cycle, given as each gear's share of energy or time."""

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
"""Quantity of which each gear of a duty cycle has a share."""


class Duty(NamedTuple):
    """Duty cycle given as each gear's share of energy or time."""

    kind: Kind
    shares: Mapping[str, float]
    """Shares by name of the gear; the sum of shares is arbitrary."""


class Stage(NamedTuple):
    """Energy share and efficiency of a gear in a duty cycle."""

    gear: str
    energy: float
    """Share of the input energy; the shares of all gears add up to 1. [-]"""
    efficiency: float
    """Efficiency; 0 if the gear is back-driven and delivers no power. [-]"""


class Cycle(NamedTuple):
    """Results of a duty cycle of shares by gear."""

    stages: Sequence[Stage]
    efficiency: float
    """Output energy divided by input energy. [-]"""

    @property
    def damage(self) -> Mapping[str, object]:
        """Fatigue damage; always empty, because shares by gear have no torques."""
        return {}

    @property
    def messages(self) -> Sequence[Message]:
        """Messages; always empty for shares by gear."""
        return ()

    def grids(self) -> Iterator[Grid]:
        """Yield the table of gears for a summary."""
        title = "Duty cycle: share of the input energy, efficiency"
        rows: list[Values] = [*self.stages, (word("in all"), 1.0, self.efficiency)]
        yield grid_of(title, ["gear", "energy", "efficiency"], rows, key="duty")


def cycle(results: Results, duty: Duty) -> Cycle:
    """Calculate the mean efficiency ``sum(E ETA)/sum(E)`` over all gears.

    E is the input energy and ETA the efficiency of a gear. Shares of energy are used as E. Shares
    of time are multiplied by the gear's input power, which requires an operating point.

    Raises
    ------
    CaseError
        If a gear with a share is not in the case or has no efficiency, or if a share of time
        refers to a gear without input power.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.98)], [Gear([2]), Gear([1])])
    >>> results = cycle(solve(case), Duty("energy", {"1": 1, "2": 3}))
    >>> [stage.energy for stage in results.stages], round(results.efficiency, 4)
    ([0.25, 0.75], 0.9964)
    """
    shares = {gear: share for gear, share in duty.shares.items() if share > 0}
    gears = results.gears
    efficiencies = {gear: _efficiency(results, gear) for gear in gears}
    powers = dict.fromkeys(gears, 1.0 if duty.kind == "energy" else math.nan)
    if duty.kind == "time" and "kW" in known_units(results.case):
        powers = dict(zip(gears, results.input_power_kW.tolist(), strict=True))
    problems = list(_problems(shares, efficiencies, powers))
    if problems:
        raise CaseError(problems)
    largest = max(shares.values())  # the sum of the shares themselves can overflow
    energies = {gear: share / largest * powers[gear] for gear, share in shares.items()}
    total = math.fsum(energies.values())
    stages = [Stage(gear, energy / total, efficiencies[gear]) for gear, energy in energies.items()]
    return Cycle(stages, math.fsum(stage.energy * stage.efficiency for stage in stages))


def _efficiency(results: Results, gear: str) -> float:
    """Return output power divided by input power of a gear; 0 without output power."""
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
    """Yield errors if the mean efficiency does not exist, with paths in the duty cycle."""
    for gear in shares:
        if gear not in efficiencies:
            yield Problem("E416", "there is no such gear in the case", (gear,))
        elif not math.isfinite(efficiencies[gear]):
            yield Problem("E417", "the gear has no efficiency, expected no share for it", (gear,))
        elif not powers[gear] > 0:
            message = "shares of time need the input power of the gear, expected a load with speed"
            yield Problem("E418", f"{message} and torque", (gear,))
    if not shares:
        yield Problem("E419", "all shares are 0, expected one above 0")
