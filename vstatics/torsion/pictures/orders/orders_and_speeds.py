"""Excitation of the input of a case: orders, and the speeds at which the input runs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol, runtime_checkable

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.style import Excitation
from vstatics.torsion.clutch.clutch_dump import ClutchDump

ORDERS = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0)
"""Orders shown if the number of cylinders is unknown, for four-stroke engines.

These are the half order, the order of the shaft, and the firing orders of 4, 6, 8 and 12 cylinders.
"""
FASTEST_INPUT = 6000.0
"""Largest upper end of the scale of speeds if no speed of the input is known. [rpm]"""
ABOVE_ONE, ABOVE_RANGE = 1.25, 1.05
"""Upper end of the scale of speeds, divided by a single known speed or the highest of several."""
PER_MINUTE = 60.0
"""Number of seconds per minute."""


class Order(NamedTuple):
    """Order of an excitation: number of periods per revolution."""

    number: float
    """Number of periods per revolution."""
    fires: bool
    """True for multiples of the firing order of the cylinders."""

    @property
    def name(self) -> str:
        """Name of the order, as printed.

        >>> Order(0.5, False).name
        '0.5×'
        """
        return f"{self.number:g}×"

    def frequency(self, speed: float) -> float:
        """Return the frequency [Hz] at a speed [rpm]."""
        return self.number * speed / PER_MINUTE

    def speed(self, frequency: float) -> float:
        """Return the speed [rpm] at which the order excites a frequency [Hz]."""
        return frequency * PER_MINUTE / self.number


def orders_of(case: Transmission, asked: Excitation) -> list[Order]:
    """Return the requested orders, or the orders of the engine, ascending.

    In a four-stroke engine N/2 of N cylinders fire per revolution. By default the orders 0.5, 1,
    N/2 and N are shown. Links other than the input have no firing orders.

    Examples
    --------
    >>> case = Transmission(2, [], [], [Gear()], inertias={1: 1.0}, cylinders=6)
    >>> [(order.number, order.fires) for order in orders_of(case, Excitation())]
    [(0.5, False), (1.0, False), (3.0, True), (6.0, True)]
    >>> [order.fires for order in orders_of(case, Excitation(orders=(4.5, 9.0)))]
    [False, True]
    """
    is_input = not asked.at or case.link_number(asked.at) == case.input
    cylinders = case.cylinders if is_input else None
    usual = ORDERS if cylinders is None else (0.5, 1.0, cylinders / 2, float(cylinders))
    numbers = sorted({*(asked.orders or usual)})
    return [Order(number, _fires(number, cylinders)) for number in numbers]


def _fires(order: float, cylinders: int | None) -> bool:
    if cylinders is None:
        return False
    times = 2 * order / cylinders
    return times > 1 - NO_POWER and abs(times - round(times)) <= NO_POWER * times


def running_speeds(case: Transmission, gears: Iterable[Gear], asked: Excitation) -> list[float]:
    """Return the known speeds of a case's input, ascending [rpm].

    These are the requested speeds, and the speeds of loads, of the vehicle's engine and of a clutch
    dump.

    Examples
    --------
    >>> from vstatics import Load
    >>> case = Transmission(2, [], [], [Gear()], inertias={1: 1.0}, load=Load(-5800.0))
    >>> running_speeds(case, case.gears, Excitation(speeds=(900.0,)))
    [900.0, 5800.0]
    """
    speeds = [*asked.speeds, *(case.gear_load(gear).speed or 0.0 for gear in gears)]
    speeds += (speed / RAD_PER_RPM for speed in _engine_speeds(case))
    return sorted({certain(abs(speed)) for speed in speeds if speed})


@runtime_checkable
class HasEngine(Protocol):
    """Vehicle data that is used here: the engine."""

    @property
    def engine(self) -> Sequence[tuple[float, float]]:
        """Points of the full-load curve of the engine: speed [rad/s] and torque [N*m]."""

    @property
    def overrun(self) -> Sequence[tuple[float, float]]:
        """Points of the overrun curve of the engine: speed [rad/s] and torque [N*m]."""


def _engine_speeds(case: Transmission) -> Iterator[float]:
    if isinstance(case.vehicle, HasEngine):
        yield from (speed for speed, _ in (*case.vehicle.full_load, *case.vehicle.braking))
    dump = ClutchDump.of(case)
    if dump is not None and dump.J1[0] == case.input:
        yield dump.omega1


def highest_speed(known: Sequence[float], frequencies: Sequence[float], lowest: float) -> float:
    """Return a round speed [rpm] above all known speeds.

    If no speed is known, return the speed up to which the lowest order meets all natural
    frequencies, limited to `FASTEST_INPUT`.

    Parameters
    ----------
    known : sequence of float
        Known speeds, ascending. [rpm]
    frequencies : sequence of float
        Natural frequencies, used if no speed is known. [Hz]
    lowest : float
        Lowest order.

    Examples
    --------
    >>> highest_speed([5800.0], [], 0.5), highest_speed([800.0, 6500.0], [], 0.5)
    (7500.0, 7000.0)
    >>> highest_speed([], [20.0], 0.5), highest_speed([], [900.0], 0.5)
    (2500.0, 6000.0)
    """
    if known:
        fastest = known[-1] * (ABOVE_RANGE if len(known) > 1 else ABOVE_ONE)
    else:
        fastest = min(FASTEST_INPUT, max(frequencies) * PER_MINUTE / lowest)
    unit = 10.0 ** math.floor(math.log10(fastest)) / 2
    return math.ceil(fastest / unit) * unit


class ExcitedSpeeds(NamedTuple):
    """Orders and speeds of a picture of vibration."""

    orders: Sequence[Order]
    """Orders, ascending."""
    running: Sequence[float]
    """Speeds at which the input runs, ascending; empty if none of them are shown. [rpm]"""
    fastest: float
    """Highest speed shown. [rpm]"""
    slowest: float = 0.0
    """Lowest speed shown. [rpm]"""


def excited_speeds(
    case: Transmission, gears: Sequence[Gear], frequencies: Sequence[float], asked: Excitation
) -> ExcitedSpeeds:
    """Choose the orders and the range of speeds for gears with natural frequencies [Hz]."""
    orders = orders_of(case, asked)
    running = running_speeds(case, gears, asked)
    if asked.shown is not None:
        slowest, fastest = asked.shown
        if running and (running[-1] < slowest or running[0] > fastest):
            running = []
        return ExcitedSpeeds(orders, running, fastest, slowest)
    return ExcitedSpeeds(orders, running, highest_speed(running, frequencies, orders[0].number))
