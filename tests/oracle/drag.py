"""Drag above the load, exact: all sets of signs are tried, whatever the flow without losses is.

A drag torque acts against the speed of its link, or between the links of an open element
against its slip. A set of signs is admissible if no mechanism gives power. With several ports, the
power at the links by which power leaves without losses and drag is divided by the power at the links
where it enters. Gears have no freewheels, and their speeds and torques have one solution.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from tests.oracle.linear import ONE, ZERO, exact, sign
from tests.oracle.systems import Speeds, Torques, ratios
from vstatics.core.model.transmission import HOUSING, Gear, Transmission


@dataclass(frozen=True)
class Admissible:
    """Result of loss signs that agree with the power flow, for one input and one output."""

    output: Fraction
    """Torque given to the load."""
    efficiency: Fraction
    """Below 0 for a back-driven gear. When coasting: input power divided by output power."""


@dataclass(frozen=True)
class GearWithDrag:
    """A gear with drag, and the same one without."""

    found: list[Admissible]
    bare: list[Admissible]
    drag_losses: Fraction

    @property
    def possible(self) -> list[Admissible]:
        """Results that transmit power. If only the gear without drag has any, all results with drag."""
        passing = _passing(self.found)
        return passing or (self.found if _passing(self.bare) else [])

    @property
    def locked(self) -> bool:
        """Whether the gear is self-locking."""
        return not self.possible

    @property
    def dragged(self) -> bool:
        """Whether power also enters at the output."""
        return bool(self.possible) and all(one.efficiency < 0 for one in self.possible)


def _passing(found: list[Admissible]) -> list[Admissible]:
    return [one for one in found if one.efficiency > 0]


def drag_of(case: Transmission, gear: Gear, speeds: Speeds) -> tuple[dict[int, Fraction], Fraction]:
    """Drag torque on each link, and the power that all of it takes."""
    turn, taken = -1 if case.coast else 1, ZERO
    drag: dict[int, Fraction] = {}
    torques = [(link, HOUSING, torque) for link, torque in gear.drag.items()]
    torques += [
        (one.first, one.second, gear.open_drag.get(number, one.drag))
        for number, one in enumerate(case.shift_elements, 1)
        if number not in gear.engaged
    ]
    for first, second, torque in torques:
        slip = speeds.difference(first, second)
        assert slip is not None
        against = exact(torque) * turn * sign(slip)
        taken += slip * against
        for link, pull in ((first, -against), (second, against)):
            if link != HOUSING:
                drag[link] = drag.get(link, ZERO) + pull
    return drag, taken


def solve_gear(case: Transmission, gear: Gear) -> GearWithDrag:
    """Solve a gear that has one input and one output, with its drag."""
    own = GearOfPorts(case, gear)
    speed = own.speeds.link(case.gear_output(gear))
    assert speed

    def admissible(drag: Mapping[int, Fraction]) -> Iterator[Admissible]:
        for torques in own.agreeing(drag):
            output = torques.mx()
            assert output is not None
            if output or not case.coast:
                yield Admissible(output, (output * speed) ** own.turn)

    return GearWithDrag([*admissible(own.drag)], [*admissible({})], own.drag_losses)


@dataclass(frozen=True)
class Solution:
    """Result of loss signs that agree with the power flow."""

    passed: Fraction | None
    """Output power over input power, for the sides of the flow without losses. None if undefined."""
    torques: Torques
    powers: Mapping[int, Fraction]
    """Power at each port, above 0 where power enters, also when coasting."""
    from_load: Fraction
    """Power that the output receives from its load."""

    @property
    def efficiency(self) -> Fraction | None:
        """Output power over input power, for the sides of the flow with losses."""
        entering = sum((one for one in self.powers.values() if one > 0), ZERO)
        leaving = -sum((one for one in self.powers.values() if one < 0), ZERO)
        return leaving / entering if entering else None


class GearOfPorts:
    """A gear with drag and any number of ports."""

    def __init__(self, case: Transmission, gear: Gear) -> None:
        """Calculate the speeds, the drag, and the torques without drag and other losses."""
        self.case, self.gear = case, gear
        self.turn = -1 if case.coast else 1
        self.speeds = Speeds(case, gear)
        self.ideal = Torques(case, gear, ratios(case))
        self.is_regular = self.ideal.system.consistent and not self.ideal.system.missing
        self.drag, self.drag_losses = drag_of(case, gear, self.speeds)

    @property
    def solutions(self) -> list[Solution]:
        """Results that transmit power. If only the gear without drag has any, all results with drag."""
        found = list(self._solved(self.drag))
        passing = [one for one in found if self._passes(one)]
        return passing or (found if any(map(self._passes, self._solved({}))) else [])

    def is_dragged(self, one: Solution) -> bool:
        """Whether no power is transmitted although the load supplies power and the input takes none."""
        at_input = ONE + exact(self.gear.torques.get(self.case.gear_input(self.gear), 0.0))
        wins = not self._has_sides or one.passed is None or one.passed <= 0
        return bool(wins and at_input * self.turn >= 0 and one.from_load > 0 and self.drag_losses)

    def _passes(self, one: Solution) -> bool:
        return not self._has_sides or (one.passed is not None and one.passed > 0)

    @property
    def _has_sides(self) -> bool:
        powers = self._powers(self.ideal).values()
        return any(one > 0 for one in powers) and any(one < 0 for one in powers)

    def _powers(self, torques: Torques) -> dict[int, Fraction]:
        powers = {link: torques.power(self.speeds, [link]) for link in torques.ports()}
        return {link: self.turn * one for link, one in powers.items() if one is not None}

    def _signs(self) -> Iterator[tuple[int, ...]]:
        """All sets of signs. By convention, few signs are tried for mechanisms without motion or loss."""
        choices: list[tuple[int, ...]] = []
        for one in self.case.mechanisms:
            published = tuple({1, sign(exact(one.ratio))})
            still = (0,) if self.case.idle == "exact" else published
            moves = self.speeds.difference(one.first, one.third) != 0
            choices.append((1,) if one.efficiency == 1 else (1, -1) if moves else still)
        return product(*choices)

    def agreeing(self, drag: Mapping[int, Fraction]) -> Iterator[Torques]:
        """Torques of each set of loss signs with which no mechanism gains power."""
        for signs in self._signs():
            pairs = zip(self.case.mechanisms, signs, strict=True)
            factors = [exact(one.efficiency) ** x for one, x in pairs]
            lossy = [u * factor for u, factor in zip(ratios(self.case), factors, strict=True)]
            torques = Torques(self.case, self.gear, lossy, drag)
            if torques.system.consistent and not torques.system.missing:
                losses = self._losses(torques, factors)
                if all(self.turn * one >= 0 for one in losses):
                    yield torques

    def _solved(self, drag: Mapping[int, Fraction]) -> Iterator[Solution]:
        sides = self._powers(self.ideal)
        for torques in self.agreeing(drag):
            powers = self._powers(torques)
            entering = sum((powers[link] for link, one in sides.items() if one > 0), ZERO)
            leaving = -sum((powers[link] for link, one in sides.items() if one < 0), ZERO)
            output, speed = torques.mx(), self.speeds.link(self.case.gear_output(self.gear))
            assert output is not None
            assert speed is not None
            passed = leaving / entering if entering else None
            yield Solution(passed, torques, powers, -output * speed * self.turn)

    def _losses(self, torques: Torques, factors: list[Fraction]) -> Iterator[Fraction]:
        for number, (one, factor) in enumerate(zip(self.case.mechanisms, factors, strict=True)):
            motion, torque = self.speeds.difference(one.first, one.third), torques.mechanism(number)
            assert motion is not None
            assert torque is not None
            yield torque * motion * (1 - factor)
