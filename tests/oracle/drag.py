"""Drag above the load, exact: all sets of signs are tried, whatever the flow without losses is.

A drag torque acts against the speed of its link, or between the links of an open element
against its slip. A set of signs is admissible if no mechanism gives power. For gears with one
input and one output, without freewheels, whose speeds and torques have one solution.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from tests.oracle.linear import ZERO, exact, sign
from tests.oracle.systems import Speeds, Torques, ratios
from vstatics.core.model.transmission import HOUSING, Gear, Transmission


@dataclass(frozen=True)
class Admissible:
    """What a set of signs that agrees with its flow leads to."""

    output: Fraction
    """Torque given to the load."""
    efficiency: Fraction
    """Of a dragged gear below 0. When coasting: the power at the input by that at the output."""
    losses: Fraction
    """In mechanisms; below 0 when coasting."""


@dataclass(frozen=True)
class GearWithDrag:
    """A gear with drag, and the same one without."""

    found: list[Admissible]
    bare: list[Admissible]
    drag_losses: Fraction

    @property
    def possible(self) -> list[Admissible]:
        """Those that pass power; if there are none but without drag, those in which drag wins."""
        passing = _passing(self.found)
        return passing or (self.found if _passing(self.bare) else [])

    @property
    def locked(self) -> bool:
        """Friction holds it."""
        return not self.possible

    @property
    def dragged(self) -> bool:
        """Power enters at the output too."""
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
    """A gear with its drag."""
    speeds = Speeds(case, gear)
    drag, taken = drag_of(case, gear, speeds)
    found, bare = (_every_admissible(case, gear, speeds, each) for each in (drag, {}))
    return GearWithDrag(found, bare, taken)


def _of_one_piece(case: Transmission, index: int) -> tuple[int, ...]:
    """The signs by convention of a mechanism in which nothing moves."""
    if case.idle == "exact":
        return (0,)
    return tuple({1, sign(exact(case.mechanisms[index].ratio))})


def _every_admissible(
    case: Transmission, gear: Gear, speeds: Speeds, drag: dict[int, Fraction]
) -> list[Admissible]:
    turn = -1 if case.coast else 1
    relative = [speeds.difference(one.first, one.third) for one in case.mechanisms]
    etas = [exact(one.efficiency) for one in case.mechanisms]
    output_speed = speeds.link(case.gear_output(gear))
    assert output_speed
    found = []
    choices = [
        (1,) if eta == 1 else (1, -1) if motion != 0 else _of_one_piece(case, k)
        for k, (eta, motion) in enumerate(zip(etas, relative, strict=True))
    ]
    for signs in product(*choices):
        factors = [eta**x for eta, x in zip(etas, signs, strict=True)]
        lossy = [u * factor for u, factor in zip(ratios(case), factors, strict=True)]
        torques = Torques(case, gear, lossy, drag)
        powers = [
            None if motion is None else (torques.mechanism(k) if motion else ZERO)
            for k, motion in enumerate(relative)
        ]
        output = torques.mx()
        if not torques.system.consistent or output is None or None in powers:
            continue
        losses = [
            torque * motion * (1 - factor)  # type: ignore[operator]
            for torque, motion, factor in zip(powers, relative, factors, strict=True)
        ]
        if all(loss * turn >= 0 for loss in losses):
            passed = output * output_speed
            if passed or turn > 0:
                eta = passed if turn > 0 else 1 / passed
                found.append(Admissible(output, eta, sum(losses, ZERO)))
    return found
