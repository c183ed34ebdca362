"""Torques of shift elements and converters, compared with their capacities."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from vstatics.core.model.parts import RAD_PER_RPM, Size
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.numerics.tolerances import SAME_RATIO, VISIBLE_EXCESS
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.result_arrays import Message

if TYPE_CHECKING:
    from vstatics.core.model.transmission import Transmission
    from vstatics.core.statics.results import Results

SAME_TORQUE = 0.05
"""Relative difference up to which two torques on a pump count as equal.

The tolerance is wide because the points of a converter are read from diagrams.
"""


def larger_torques(torques: Floats, lossy_torques: Floats) -> Floats:
    """Return the larger magnitude of the torques without and with losses.

    The larger torque is compared with the capacity, because losses are only approximate and the
    real torque is near one of the two values.

    >>> larger_torques(np.array([2.0, -3.0]), np.array([-2.5, np.nan])).tolist()
    [2.5, 3.0]
    """
    sizes: Floats = np.fmax(np.abs(torques), np.abs(lossy_torques))
    return sizes


def carried_torques(results: Results, common: float) -> tuple[Floats, Booleans]:
    """Return the torques on shift elements, and flags of shift elements that carry torque.

    Both arrays have the shape (gears, shift elements). Torques are results of `larger_torques`,
    relative to the input torque `common` [N*m] or, if that is 0, to the input torque of each gear.

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
    loads = (case.gear_load(gear).torque_size for gear in case.gears)
    units = [abs(torque / common) if torque and common else 1.0 for torque in loads]
    torques = sizes * np.array(units)[:, np.newaxis]
    carrying = results.holds & (sizes > SAME_RATIO)  # relative to the input torque
    return torques, carrying


def torque_of_pump(points: Sequence[tuple[float, ...]], speed_ratio: float, speed: float) -> float:
    """Return the torque ``lambda w |w|`` that the pump of a converter takes [N*m].

    The pump factor lambda is interpolated linearly between the points and constant outside them.

    Parameters
    ----------
    points : sequence of (float, float, float)
        Speed ratio [-] in ascending order, torque ratio [-] and lambda [N*m*s^2].
    speed_ratio : float
        Speed ratio, turbine to pump. [-]
    speed : float
        Speed of the pump. [rad/s]

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
    return float(pump_factor(points, speed_ratio)) * speed * abs(speed)


def pump_factor(points: Sequence[tuple[float, ...]], speed_ratio: Size) -> Size:
    """Return lambda [N*m*s^2] of a converter at a speed ratio or an array of speed ratios.

    >>> pump_factor([(0, 2, 0.01), (1, 1, 0.0)], np.array([0.5, 2.0])).tolist()
    [0.005, 0.0]
    """
    by_ratio, _, factors = np.transpose(points)
    factor: Size = np.interp(speed_ratio, by_ratio, factors)
    return factor


def out_of_balance(results: Results) -> Iterator[tuple[int, str]]:
    """Yield the gears in which the pump of a converter cannot take the incoming torque.

    Each item is the index of a gear and the text of a message. A converter with a prescribed speed
    ratio is checked if its points contain lambda and the load has a speed and a torque.
    """
    case = results.case
    for index, given in enumerate(case.gears):
        load = case.gear_load(given)
        if not (load.speed and load.torque and results.consistent[index]):
            continue
        state = results.gear_at(index)
        unloaded, ratios = case.unloaded_converters(state.gear), state.ideal.variant.ratios
        for place, mechanism in enumerate(case.mechanisms):
            if not mechanism.can_be_open or place in unloaded:
                continue
            speed = plain(state.speeds[mechanism.first - 1]) * load.speed * RAD_PER_RPM
            taken = torque_of_pump(mechanism.points, plain(ratios[place]), speed)
            on_pump = state.lossy_torques.on_first_link[len(case.shift_elements) + place]
            brought = plain(on_pump) * load.torque
            side = case.freewheel_side(state.gear, place)
            if is_supplied(side, plain(ratios[place]), brought, brought - taken):
                continue
            if disagree(brought, taken):
                at = plain(ratios[place]), speed
                yield index, disagreement(mechanism.name, brought, taken, at)


def is_supplied(side: int, ratio: Size, brought: Size, surplus: Size) -> Booleans:
    """Return whether a freewheel supplies the torque that a driven pump lacks.

    Parameters
    ----------
    side : int
        Result of `freewheel_side` for the converter.
    ratio : float or ndarray
        Speed ratio of the converter. [-]
    brought, surplus : float or ndarray
        Torque that the train gives to the pump, and its excess over the torque that the pump takes.
        [N*m]
    """
    lacks = np.multiply(side, surplus) < 0
    supplied: Booleans = np.equal(ratio, 1) & lacks & (np.multiply(side, brought) > 0)
    return supplied


def disagree(brought: float, able: float) -> bool:
    """Return whether the torque that the train gives to a pump differs from what the pump takes."""
    return abs(brought - able) > SAME_TORQUE * max(abs(brought), abs(able))


def disagreement(name: str, brought: float, able: float, at: tuple[float, float]) -> str:
    """Return the text of a message about a converter that cannot take the torque.

    Parameters
    ----------
    brought, able : float
        Torque that the train gives to the pump, and torque that the pump can take. [N*m]
    at : tuple of float
        Speed ratio [-] and speed of the pump [rad/s].
    """
    ratio, speed = at
    return (
        f"the load brings {_text(brought)} N*m to the pump of {name}, which at the speed ratio "
        f"{ratio:.4g} and {speed / RAD_PER_RPM:.5g} rpm takes {_text(able)} N*m: give the speed "
        "ratio or the load at which they agree"
    )


def overloads(results: Results) -> Iterator[tuple[int, str]]:
    """Yield the shift elements that carry more than their torque capacity.

    Each item is the index of a gear and the text of a message.
    """
    case = results.case
    common = case.load.torque_size if case.load else 0.0
    torques, carrying = carried_torques(results, common)
    unit, of = (common, "N*m") if common else (1.0, "times the input torque")
    for number, element in enumerate(case.shift_elements):
        capacity = float(element.capacity or np.inf)
        above = carrying[:, number] & (torques[:, number] > capacity * (1 + VISIBLE_EXCESS))
        for gear in np.flatnonzero(above).tolist():
            has, can = map(_text, (torques[gear, number] * unit, capacity * unit))
            yield (
                gear,
                f"{element.name} carries {has} {of}, more than its torque capacity of {can} {of}",
            )


def overloads_at_points(
    case: Transmission, torques: Floats, of: str, where: Callable[[int], str]
) -> Iterator[Message]:
    """Yield messages about shift elements that are overloaded at operating points.

    Nothing is yielded for a case without an input torque, because its capacities are relative.

    Parameters
    ----------
    case : Transmission
        Case whose load is the reference of relative capacities.
    torques : array
        Torques, shape (points, shift elements); NaN or 0 if a shift element carries no torque.
        [N*m]
    of : str
        Plural noun for the points in the text, such as `rows`.
    where : callable
        Function from the index of a point to words for the point.
    """
    common = case.load.torque_size if case.load else 0.0
    sizes = np.abs(np.nan_to_num(torques))
    for number, element in enumerate(case.shift_elements if common else ()):
        capacity = common * float(element.capacity or np.inf)
        above = sizes[:, number] > capacity * (1 + VISIBLE_EXCESS)
        if above.any():
            row = int(sizes[:, number].argmax())
            has, can = _text(sizes[row, number]), _text(capacity)
            text = (
                f"in {int(above.sum())} of {len(above)} {of} {element.name} carries up to {has} "
                f"N*m, more than its torque capacity of {can} N*m, most {where(row)}"
            )
            yield Message("W430", text)


def _text(torque: float) -> str:
    return f"{torque:.5g}" if torque < 99999 else f"{torque:.0f}"
