"""Where orders of the input speed meet natural frequencies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.model.transmission import Gear, Transmission

ORDERS = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0)
"""Of four-stroke engines: half orders, the shaft, the firing of four, six, eight, twelve
cylinders."""
FASTEST = 6000.0
"""Where no load tells the speed of the input. [rpm]"""
OVER = 1.25
"""So far above the speed of the load."""
FREQUENCY_ROOM = 1.1
"""Of the highest frequency that is shown."""
PER_MINUTE = 60.0


class Crossing(NamedTuple):
    """An order that meets a natural frequency: a resonance."""

    speed: float
    """Of the input. [rpm]"""
    frequency: float
    """[Hz]"""
    order: float
    """[-]"""


class OrderRange(NamedTuple):
    """What a Campbell diagram shows, from 0 on, its scales by square roots.

    So orders are straight lines from the origin, and low frequencies stand apart.
    """

    speed: float
    """The highest. [rpm]"""
    frequency: float
    """The highest. [Hz]"""

    def across(self, speed: float) -> float:
        """The place of a speed, the highest at 1."""
        return math.sqrt(speed / self.speed)

    def up(self, frequency: float) -> float:
        """The place of a frequency, the highest at 1."""
        return math.sqrt(frequency / self.frequency)


def highest_speed(case: Transmission, gears: Iterable[Gear], frequencies: Sequence[float]) -> float:
    """A round speed above those that loads have, else one at which all orders are above [rpm].

    >>> from vstatics import Gear, Load
    >>> loads = Load(-5800.0), None
    >>> loaded, bare = (Transmission(2, [], [], [Gear()], load=load) for load in loads)
    >>> highest_speed(loaded, loaded.gears, [20.0]), highest_speed(bare, bare.gears, [20.0])
    (7500.0, 2500.0)
    """
    loads = (case.gear_load(gear) for gear in gears)
    fastest = OVER * max((abs(load.speed or 0.0) for load in loads), default=0.0)
    if not fastest:
        fastest = min(FASTEST, max(frequencies) * PER_MINUTE / ORDERS[0])
    unit = 10.0 ** math.floor(math.log10(fastest)) / 2
    return math.ceil(fastest / unit) * unit


def order_range(speed: float, frequencies: Sequence[float]) -> OrderRange:
    """Up to the highest frequency that an order reaches, a little more.

    >>> order_range(6000.0, [30.0, 250.0, 900.0])
    OrderRange(speed=6000.0, frequency=275.0)
    """
    top = ORDERS[-1] * speed / PER_MINUTE
    reached = [frequency for frequency in frequencies if frequency <= top]
    return OrderRange(speed, FREQUENCY_ROOM * max(reached) if reached else top)


def crossings(shown: OrderRange, frequencies: Iterable[float]) -> Iterator[Crossing]:
    """The resonances within a range, by ascending frequency, then order.

    >>> [(one.order, one.speed) for one in crossings(OrderRange(3000.0, 150.0), [50.0])]
    [(1.0, 3000.0), (2.0, 1500.0), (3.0, 1000.0), (4.0, 750.0), (6.0, 500.0)]
    """
    for frequency in frequencies:
        for order in ORDERS:
            speed = frequency * PER_MINUTE / order
            if speed <= shown.speed and frequency <= shown.frequency:
                yield Crossing(speed, frequency, order)


def root_ticks(highest: float, least: float) -> list[float]:
    """Round numbers up to the highest whose square roots are apart, by parts of the scale.

    >>> root_ticks(1000.0, 0.12)
    [0.0, 20.0, 100.0, 200.0, 500.0, 700.0, 1000.0]
    """
    power = 10.0 ** math.floor(math.log10(highest))
    chosen = [0.0]
    for digits in ((1.0,), (5.0,), (2.0,), (3.0, 7.0), (4.0, 6.0, 8.0, 9.0)):
        for size in (power, power / 10, power / 100):
            for tick in (digit * size for digit in digits):
                at = math.sqrt(tick / highest)
                apart = all(abs(at - math.sqrt(one / highest)) >= least for one in chosen)
                chosen += [tick] if tick <= highest and apart else []
    return sorted(chosen)
