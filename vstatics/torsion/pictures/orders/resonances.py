"""Resonances: speeds at which the frequency of an order equals a natural frequency of a gear."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.tolerances import SAME_FREQUENCY
from vstatics.torsion.pictures.orders.orders_and_speeds import Order
from vstatics.torsion.tolerances import LEAST_PARTICIPATION

if TYPE_CHECKING:
    from vstatics.torsion.vibration.gear_modes import GearModes


class GearMode(NamedTuple):
    """Natural mode of a gear, and how much the input moves in the mode."""

    gear: str
    place: int
    """Index of the gear among all gears shown."""
    number: int
    """Number of the mode, from 1."""
    frequency: float
    """Natural frequency without damping. [Hz]"""
    participation: float
    """Amplitude of the input in the mode, divided by the largest amplitude. [-]"""
    damping_ratio: float
    """Damping ratio, 0 without damping. [-]"""

    @property
    def is_excited(self) -> bool:
        """True if the input moves in the mode."""
        return self.participation > LEAST_PARTICIPATION


class Meeting(NamedTuple):
    """Resonance, at which an order meets a natural frequency."""

    mode: GearMode
    order: Order

    @property
    def speed(self) -> float:
        """Speed of the input at the resonance [rpm]."""
        return self.order.speed(self.mode.frequency)


def gear_modes(gears: Sequence[GearModes], inputs: Sequence[str]) -> list[GearMode]:
    """Return the modes of gears; `inputs` are the names of their input links."""
    return [
        GearMode(
            gear.name,
            place,
            number,
            certain(mode.frequency),
            abs(certain(mode.shape[link])),
            mode.damping_ratio,
        )
        for place, (gear, link) in enumerate(zip(gears, inputs, strict=True))
        for number, mode in enumerate(gear.modes, 1)
    ]


def meetings(
    modes: Sequence[GearMode], orders: Sequence[Order], fastest: float, slowest: float = 0.0
) -> Iterator[Meeting]:
    """Yield the resonances at speeds in a range [rpm].

    >>> mode = GearMode("1", 0, 1, 50.0, 0.3, 0.0)
    >>> orders = [Order(n, False) for n in (0.5, 1.0, 2.0)]
    >>> [(met.order.number, met.speed) for met in meetings([mode], orders, 3000.0)]
    [(1.0, 3000.0), (2.0, 1500.0)]
    """
    for mode in modes:
        for order in orders:
            meeting = Meeting(mode, order)
            if mode.is_excited and is_between(meeting.speed, slowest, fastest):
                yield meeting


def is_between(speed: float, slowest: float, fastest: float) -> bool:
    """Return whether a speed is within a range, including both ends."""
    return slowest * (1 - NO_POWER) <= speed <= fastest * (1 + NO_POWER)


class SharedMode(NamedTuple):
    """Mode with nearly equal frequencies in several gears."""

    number: int
    modes: Sequence[GearMode]
    """Modes of the gears, by ascending frequency."""

    @property
    def frequency(self) -> float:
        """Geometric mean of the lowest and the highest frequency [Hz]."""
        return math.sqrt(self.modes[0].frequency * self.modes[-1].frequency)

    @property
    def gears(self) -> list[str]:
        """Names of the gears in their order on the page."""
        return [mode.gear for mode in sorted(self.modes, key=lambda mode: mode.place)]


def by_number(modes: Iterable[GearMode]) -> Iterator[tuple[int, Iterator[GearMode]]]:
    """Group modes by their numbers, in ascending order of numbers, frequencies and gears."""
    ascending = sorted(modes, key=lambda mode: (mode.number, mode.frequency, mode.place))
    return groupby(ascending, key=lambda mode: mode.number)


def shared_modes(modes: Sequence[GearMode]) -> list[SharedMode]:
    """Combine modes of several gears that have equal numbers and nearly equal frequencies.

    Examples
    --------
    >>> modes = [GearMode(str(n), n, 1, f, 1.0, 0.0) for n, f in enumerate((20.0, 21.0, 20.05))]
    >>> [(mode.gears, round(mode.frequency, 3)) for mode in shared_modes(modes)]
    [(['0', '2'], 20.025), (['1'], 21.0)]
    """
    shared = []
    for number, of_number in by_number(modes):
        alike: list[GearMode] = []
        for mode in of_number:
            if alike and mode.frequency > alike[0].frequency * (1 + SAME_FREQUENCY):
                shared.append(SharedMode(number, alike))
                alike = []
            alike.append(mode)
        shared.append(SharedMode(number, alike))
    return shared
