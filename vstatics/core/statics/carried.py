"""What shift elements and converters carry by the loads of their gears, and whether they can."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import SAME_RATIO, VISIBLE_EXCESS
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.result_arrays import Message

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission
    from vstatics.core.statics.results import Results

SAME_TORQUE = 0.05
"""So much a converter's torque may be off, of the larger one: points are read from diagrams."""


def larger_torques(torques: Floats, lossy_torques: Floats) -> Floats:
    """What elements are taken to carry: the larger of torques without and with losses.

    Losses are not known exactly, and the torque is nearest to one or the other.

    >>> larger_torques(np.array([2.0, -3.0]), np.array([-2.5, np.nan])).tolist()
    [2.5, 3.0]
    """
    sizes: Floats = np.fmax(np.abs(torques), np.abs(lossy_torques))
    return sizes


def carried_torques(results: Results, common: float) -> tuple[Floats, Booleans]:
    """(gears, shift elements) of one case: torques by a common one, and whether there are any.

    `common` is an input torque [N*m]; 0 where none is told, then that of each gear is the unit.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> torques, carrying = carried_torques(solve(case), 0.0)
    >>> torques[carrying].round(4).tolist()
    [2.5, 0.7143]
    """
    case = results.case
    count = len(case.shift_elements)
    both = [results.in_own_unit(name)[:, :count] for name in ("torques", "lossy_torques")]
    sizes = larger_torques(*both)
    own = (case.gear_load(gear).torque_size for gear in case.gears)
    units = [abs(torque / common) if torque and common else 1.0 for torque in own]
    torques = sizes * np.array(units)[:, np.newaxis]
    carrying = results.holds & (sizes > SAME_RATIO)  # relative to the input torque
    return torques, carrying


def torque_of_pump(points: Sequence[tuple[float, ...]], speed_ratio: float, speed: float) -> float:
    """``lambda w |w|`` that a converter takes, straight between its points, constant outside.

    Parameters
    ----------
    points : sequence of (float, float, float)
        i [-], K [-], lambda [N*m*s^2]; i ascends.
    speed_ratio : float
        [-]
    speed : float
        Of the pump. [rad/s]

    Returns
    -------
    float
        [N*m]

    Source
    ------
    (1.38) of Tsitovich and Algin, 1981.

    Examples
    --------
    >>> torque_of_pump([(0, 2, 0.01), (1, 1, 0.0)], 0.5, -100.0)
    -50.0
    """
    by_ratio, _, factors = np.transpose(points)
    return float(np.interp(speed_ratio, by_ratio, factors)) * speed * abs(speed)


def out_of_balance(results: Results) -> Iterator[tuple[int, str]]:
    """Of one case each gear's index, and what a converter can't take at its speed ratio.

    That is known where its points have lambda, and the load has a speed and a torque.
    """
    case = results.case
    for index, given in enumerate(case.gears):
        load = case.gear_load(given)
        if not (case.has_converter and load.speed and load.torque and results.consistent[index]):
            continue
        state = results.gear_at(index)
        bypassed, ratios = case.bypassed(state.gear), state.ideal.variant.ratios
        for place, one in enumerate(case.mechanisms):
            if not one.can_be_open or place in bypassed:
                continue
            speed = plain(state.speeds[one.first - 1]) * load.speed * RAD_PER_RPM
            able = torque_of_pump(one.points, plain(ratios[place]), speed)
            on_pump = state.lossy_torques.on_first_link[len(case.shift_elements) + place]
            brought = plain(on_pump) * load.torque
            if disagree(brought, able):
                at = plain(ratios[place]), speed
                yield index, disagreement(one.name, brought, able, at)


def disagree(brought: float, able: float) -> bool:
    """Whether the torque that comes to a pump differs from the torque that the pump takes."""
    return abs(brought - able) > SAME_TORQUE * max(abs(brought), abs(able))


def disagreement(name: str, brought: float, able: float, at: tuple[float, float]) -> str:
    """Text about a converter that cannot take the torque of the load.

    Parameters
    ----------
    brought, able : float
        Torque that comes to the pump, and torque that the pump takes. [N*m]
    at : tuple of float
        Speed ratio [-] and speed of the pump [rad/s].
    """
    ratio, speed = at
    return (
        f"the load brings {_told(brought)} N*m to the pump of {name}, which at the speed ratio "
        f"{ratio:.4g} and {speed / RAD_PER_RPM:.5g} rpm takes {_told(able)} N*m: give the speed "
        "ratio or the load at which they agree"
    )


def overloads(results: Results) -> Iterator[tuple[int, str]]:
    """Of one case each gear's index, and what an engaged element carries above its capacity."""
    case = results.case
    able = [(number, one) for number, one in enumerate(case.shift_elements) if one.capacity]
    if not able:
        return
    common = case.load.torque_size if case.load else 0.0
    torques, carrying = carried_torques(results, common)
    unit, of = (common, "N*m") if common else (1.0, "times the input torque")
    for number, element in able:
        capacity = float(element.capacity or 0.0)
        above = carrying[:, number] & (torques[:, number] > capacity * (1 + VISIBLE_EXCESS))
        for gear in np.flatnonzero(above).tolist():
            has, can = (_told(one * unit) for one in (torques[gear, number], capacity))
            yield gear, f"{element.name} carries {has} of {can} {of}, more than its capacity"


def overloads_at_points(
    case: Transmission, torques: Floats, of: str, where: Callable[[int], str]
) -> Iterator[Message]:
    """What elements carry above their capacities over points of load.

    A capacity that is relative to whatever the input torque is says nothing of these.

    Parameters
    ----------
    case : Transmission
        With the load by which capacities are told.
    torques : array
        (points, shift elements), NaN or 0 where one carries nothing [N*m].
    of : str
        What the points are, `rows`.
    where : callable
        Says of the index of a point where it is.
    """
    common = case.load.torque_size if case.load else 0.0
    sizes = np.abs(np.nan_to_num(torques))
    for number, element in enumerate(case.shift_elements if common else ()):
        capacity = common * float(element.capacity or np.inf)
        above = sizes[:, number] > capacity * (1 + VISIBLE_EXCESS)
        if above.any():
            row = int(sizes[:, number].argmax())
            has, can = _told(sizes[row, number]), _told(capacity)
            text = (
                f"in {int(above.sum())} of {len(above)} {of} {element.name} carries up to {has} of "
                f"{can} N*m, more than its capacity, most {where(row)}"
            )
            yield Message("W430", text)


def _told(torque: float) -> str:
    return f"{torque:.5g}" if torque < 99999 else f"{torque:.0f}"
