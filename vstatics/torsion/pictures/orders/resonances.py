"""Natural frequencies of some gears, where they are alike, and where orders meet them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.tolerances import SAME_FREQUENCY
from vstatics.torsion.pictures.orders.excited import Order
from vstatics.torsion.tolerances import LEAST_PARTICIPATION

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


class GearMode(NamedTuple):
    """A natural mode of a gear, as its input feels it."""

    gear: str
    place: int
    """Of the gear among those that are shown, from 0."""
    number: int
    """From 1."""
    frequency: float
    """Without damping. [Hz]"""
    participation: float
    """Amplitude of the input, by the largest of the mode. [-]"""
    damping_ratio: float
    """0 where nothing is damped. [-]"""

    @property
    def is_excited(self) -> bool:
        """Whether the input moves in it."""
        return self.participation > LEAST_PARTICIPATION


class Meeting(NamedTuple):
    """A resonance: an order meets a natural frequency."""

    mode: GearMode
    order: Order

    @property
    def speed(self) -> float:
        """Of the input. [rpm]."""
        return self.order.speed(self.mode.frequency)


def gear_modes(found: Sequence[GearModes], inputs: Sequence[str]) -> list[GearMode]:
    """The modes of gears, excited at their inputs, which are links by their names."""
    return [
        GearMode(
            gear.name,
            place,
            number,
            certain(mode.frequency),
            abs(certain(mode.shape[link])),
            mode.damping_ratio,
        )
        for place, (gear, link) in enumerate(zip(found, inputs, strict=True))
        for number, mode in enumerate(gear.modes, 1)
    ]


def meetings(
    modes: Sequence[GearMode], orders: Sequence[Order], fastest: float, slowest: float = 0.0
) -> Iterator[Meeting]:
    """The resonances up to a speed, from another speed on [rpm].

    >>> mode = GearMode("1", 0, 1, 50.0, 0.3, 0.0)
    >>> orders = [Order(n, False) for n in (0.5, 1.0, 2.0)]
    >>> [(one.order.number, one.speed) for one in meetings([mode], orders, 3000.0)]
    [(1.0, 3000.0), (2.0, 1500.0)]
    """
    for mode in modes:
        for order in orders:
            met = Meeting(mode, order)
            if mode.is_excited and is_between(met.speed, slowest, fastest):
                yield met


def is_between(speed: float, slowest: float, fastest: float) -> bool:
    """Return whether a speed is within a range, its ends included."""
    return slowest * (1 - NO_POWER) <= speed <= fastest * (1 + NO_POWER)


class SharedMode(NamedTuple):
    """A mode of one number in gears in which its frequency is the same, within a tolerance."""

    number: int
    modes: Sequence[GearMode]
    """By ascending frequency, one of each gear."""

    @property
    def frequency(self) -> float:
        """In the middle of them [Hz]."""
        return math.sqrt(self.modes[0].frequency * self.modes[-1].frequency)

    @property
    def gears(self) -> list[str]:
        """Names, in the order in which they are shown."""
        return [one.gear for one in sorted(self.modes, key=lambda one: one.place)]


def shared_modes(modes: Sequence[GearMode]) -> list[SharedMode]:
    """Modes of gears that are alike as one, by number and frequency.

    Examples
    --------
    >>> some = [GearMode(str(n), n, 1, f, 1.0, 0.0) for n, f in enumerate((20.0, 21.0, 20.05))]
    >>> [(one.gears, round(one.frequency, 3)) for one in shared_modes(some)]
    [(['0', '2'], 20.025), (['1'], 21.0)]
    """
    found = []
    ascending = sorted(modes, key=lambda one: (one.number, one.frequency, one.place))
    for number, own in groupby(ascending, key=lambda one: one.number):
        alike: list[GearMode] = []
        for one in own:
            if alike and one.frequency > alike[0].frequency * (1 + SAME_FREQUENCY):
                found.append(SharedMode(number, alike))
                alike = []
            alike.append(one)
        found.append(SharedMode(number, alike))
    return found
