"""What excites the input of a case: orders of its speed, and the speeds at which it runs."""

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
"""Of any four-stroke engine: half orders, the shaft, the firing of four, six, eight, twelve
cylinders."""
FASTEST_INPUT = 6000.0
"""Where nothing tells the speed of the input. [rpm]"""
ABOVE_ONE, ABOVE_RANGE = 1.25, 1.05
"""How far a diagram goes above the only speed that is known, above the highest of several."""
PER_MINUTE = 60.0


class Order(NamedTuple):
    """How often something excites in a revolution."""

    number: float
    fires: bool
    """Whether it is that in which cylinders fire, or a multiple."""

    @property
    def name(self) -> str:
        """As it is written.

        >>> Order(0.5, False).name
        '0.5×'
        """
        return f"{self.number:g}×"

    def frequency(self, speed: float) -> float:
        """At a speed [rpm] in Hz."""
        return self.number * speed / PER_MINUTE

    def speed(self, frequency: float) -> float:
        """At which it excites a frequency [Hz] in rpm."""
        return frequency * PER_MINUTE / self.number


def orders_of(case: Transmission, asked: Excitation) -> list[Order]:
    """The orders that are asked for, else those of the engine; ascending.

    Of N cylinders N/2 fire in a revolution; with half orders, and the shaft, they and N are shown.
    Orders of another link than the input are none of the engine.

    Examples
    --------
    >>> case = Transmission(2, [], [], [Gear()], inertias={1: 1.0}, cylinders=6)
    >>> [(one.number, one.fires) for one in orders_of(case, Excitation())]
    [(0.5, False), (1.0, False), (3.0, True), (6.0, True)]
    >>> [one.fires for one in orders_of(case, Excitation(orders=(4.5, 9.0)))]
    [False, True]
    """
    is_input = not asked.at or case.link_number(asked.at) == case.input
    cylinders = case.cylinders if is_input else None
    own = ORDERS if cylinders is None else (0.5, 1.0, cylinders / 2, float(cylinders))
    return [Order(one, _fires(one, cylinders)) for one in sorted({*(asked.orders or own)})]


def _fires(order: float, cylinders: int | None) -> bool:
    if cylinders is None:
        return False
    times = 2 * order / cylinders
    return times > 1 - NO_POWER and abs(times - round(times)) <= NO_POWER * times


def running_speeds(case: Transmission, gears: Iterable[Gear], asked: Excitation) -> list[float]:
    """The speeds of the input that a case tells, ascending [rpm].

    They are those of loads, of the engine of the vehicle, of a clutch that is dumped, and what is
    known besides.

    Examples
    --------
    >>> from vstatics import Load
    >>> case = Transmission(2, [], [], [Gear()], inertias={1: 1.0}, load=Load(-5800.0))
    >>> running_speeds(case, case.gears, Excitation(speeds=(900.0,)))
    [900.0, 5800.0]
    """
    found = [*asked.speeds, *(case.gear_load(gear).speed or 0.0 for gear in gears)]
    found += (one / RAD_PER_RPM for one in _of_engine(case))
    return sorted({certain(abs(one)) for one in found if one})


@runtime_checkable
class HasEngine(Protocol):
    """The vehicle of a case, as far as its engine is concerned."""

    @property
    def engine(self) -> Sequence[tuple[float, float]]:
        """Speed [rad/s] and torque [N*m] at full load."""

    @property
    def overrun(self) -> Sequence[tuple[float, float]]:
        """Speed [rad/s] and torque [N*m] of the engine as a brake."""


def _of_engine(case: Transmission) -> Iterator[float]:
    """Speeds of the engine [rad/s]."""
    if isinstance(case.vehicle, HasEngine):
        yield from (speed for speed, _ in (*case.vehicle.engine, *case.vehicle.overrun))
    dump = ClutchDump.of(case)
    if dump is not None and dump.J1[0] == case.input:
        yield dump.omega1


def highest_speed(known: Sequence[float], frequencies: Sequence[float], lowest: float) -> float:
    """A round speed above those that are known, else one at which an order is above all [rpm].

    Parameters
    ----------
    known : sequence of float
        Ascending. [rpm]
    frequencies : sequence of float
        Natural ones, where nothing is known. [Hz]
    lowest : float
        The lowest order.

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
    """What a picture of vibration is over."""

    orders: Sequence[Order]
    """Ascending."""
    running: Sequence[float]
    """Speeds at which the input runs, ascending. [rpm]"""
    fastest: float
    """The highest speed that is shown. [rpm]"""
    slowest: float = 0.0
    """The lowest speed that is shown. [rpm]"""


def excited_speeds(
    case: Transmission, gears: Sequence[Gear], frequencies: Sequence[float], asked: Excitation
) -> ExcitedSpeeds:
    """Orders and speeds of gears with natural frequencies [Hz]."""
    orders = orders_of(case, asked)
    running = running_speeds(case, gears, asked)
    if asked.shown is not None:
        slowest, fastest = asked.shown
        return ExcitedSpeeds(orders, running, fastest, slowest)
    return ExcitedSpeeds(orders, running, highest_speed(running, frequencies, orders[0].number))
