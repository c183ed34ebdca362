"""Paths to the numbers of a case that can vary, such as ``load.torque`` or ``gears.low.drag.out``.

Paths contain names of gears and components of the case; `*` as the name of a gear selects all
gears. Numbers are in SI units; for example, the power of a battery is in W.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem, quoted
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.paths import Keys, dotted, with_unit
from vstatics.core.model.shape import UNIT_OF, Measure
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, as_floats
from vstatics.core.statics import matrix
from vstatics.core.statics.variants import OF_MECHANISMS, OfGear, OfMechanism
from vstatics.core.suggestions import nearest

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

OfLoads = Literal["load.speed", "load.torque"]
_OF_LOADS: Mapping[Keys, OfLoads] = {
    ("load", "speed"): "load.speed",
    ("load", "torque"): "load.torque",
}


class CaseNumber(NamedTuple):
    """Identification of a number of a case that varies."""

    gear: int | None
    """Index of the gear; None for the operating point of the case."""
    quantity: OfLoads | OfGear | OfMechanism | Literal["battery", "relative_slip"]
    owner: int = 0
    """Number of the link or shift element, or index of the mechanism; 0 for an operating point.

    Speed ratios and pump torques have the number of the mechanism in the case, from 1.
    """


RELATIVE_TO_SPEED: tuple[OfGear, ...] = ("speeds", "slip")
"""Quantities of a gear that are relative to the input speed."""
FREE_RATIOS = ("variator", "converter")
"""Kinds of mechanisms that have a speed ratio for each gear."""
Columns = Mapping[CaseNumber, Floats]
"""Values of varied numbers in SI units, each of shape (variants,)."""


def together(vary: Mapping[str, ArrayLike]) -> tuple[dict[str, Floats], int]:
    """Broadcast arrays to a common length, and return the arrays and the length.

    Raises
    ------
    CaseError
        If a value is not an array of numbers.
    ValueError
        If the arrays cannot be broadcast to a single axis.

    Examples
    --------
    >>> together({"load.torque": [100.0, 200.0], "load.speed": 50})
    ({'load.torque': array([100., 200.]), 'load.speed': array([50., 50.])}, 2)
    """
    arrays = {path: as_floats(path, numbers) for path, numbers in vary.items()}
    try:
        shape = np.broadcast_shapes((1,), *(array.shape for array in arrays.values()))
    except ValueError:
        shape = ()
    if len(shape) != 1:
        shapes = ", ".join(f"{path} {array.shape}" for path, array in arrays.items())
        raise ValueError(f"vary: expected arrays with one axis and equal lengths, read {shapes}")
    return {path: np.broadcast_to(array, shape) for path, array in arrays.items()}, shape[0]


def columns_of(
    case: Transmission, arrays: Mapping[str, Floats], others: Iterable[str] = ()
) -> Columns:
    """Return the values of all varied numbers.

    Parameters
    ----------
    case : Transmission
    arrays : mapping of str to ndarray, shape (variants,)
        Values by path.
    others : iterable of str
        Other valid paths, to suggest for an unknown path.

    Raises
    ------
    CaseError
        If a path is unknown, or a value is not valid.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])
    >>> columns_of(case, {"load.torque": np.array([100.0, 200.0])})
    {CaseNumber(gear=None, quantity='load.torque', owner=0): array([100., 200.])}
    """
    known = case.derived(_by_path)
    columns: dict[CaseNumber, Floats] = {}
    for path, column in arrays.items():
        numbers = known.get(path)
        if not numbers:
            hint = _without_unit(path, known) or nearest(path, [*known, *others])
            message = f"the case has no number {quoted(path)}{hint}"
            raise CaseError([Problem("E421", message, ("vary",))])
        _check(case, path, numbers[0], column)
        for number in numbers:
            if number in columns:
                message = f"{quoted(path)} is varied twice, expected each number once"
                raise CaseError([Problem("E706", message, ("vary",))])
            columns[number] = column
    return columns


def _without_unit(path: str, known: Mapping[str, Sequence[CaseNumber]]) -> str:
    """Return a hint for a path with a unit in brackets, or an empty text."""
    bare, unit = with_unit(path)
    if unit is None or not known.get(bare):
        return ""
    measure = measure_of(known[bare][0].quantity)
    expected = "W" if measure == "power" else UNIT_OF[measure] if measure else "bare numbers"
    return f"; expected {quoted(bare)}, in {expected}"


def numbers_of(case: Transmission) -> dict[str, tuple[CaseNumber, ...]]:
    """Return the numbers of a case by path; `*` selects all gears.

    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])
    >>> numbers_of(case)["gears.1.torques.2"]
    (CaseNumber(gear=0, quantity='torques', owner=2),)
    """
    return {path: tuple(numbers) for path, numbers in case.derived(_by_path).items() if numbers}


def _by_path(case: Transmission) -> dict[str, list[CaseNumber]]:
    """Return the numbers of a case by path; a path can have no numbers in this case."""
    return {dotted(keys): numbers for keys, numbers in _named(case)}


def measure_of(quantity: str) -> Measure | Literal["power"] | None:
    """Return the measure that determines the unit of a number; None for a number without a unit.

    >>> measure_of("speeds"), measure_of("efficiency")
    ('si_speed', None)
    """
    if quantity in ("load.speed", *RELATIVE_TO_SPEED):
        return "si_speed"
    if quantity in ("load.torque", "torques", "drag", "open_drag"):
        return "si_torque"
    return "power" if quantity == "battery" else None


def wrong_numbers(quantity: str, numbers: Floats) -> Booleans:
    """Return flags that mark invalid numbers of a quantity in SI units."""
    return _check_quantity(quantity, numbers)[0]


def _named(case: Transmission) -> Iterator[tuple[Keys, list[CaseNumber]]]:
    for keys, quantity in _OF_LOADS.items():
        yield keys, [CaseNumber(None, quantity)]
    everywhere = range(len(case.gears))
    links = {name: number for number, name in enumerate(case.link_names[: case.own_links], 1)}
    elements = {element.name: n for n, element in enumerate(case.shift_elements, 1)}
    devices = case.mechanisms[case.own_mechanisms]
    free = {
        mechanism.name: n for n, mechanism in enumerate(devices, 1) if mechanism.kind in FREE_RATIOS
    }
    owners: dict[OfGear, dict[str, int]] = {
        "speed_ratios": free,
        "speeds": links,
        "torques": links,
        "drag": links,
        "open_drag": elements,
    }
    for gear, numbers in _together_and_each(case, everywhere):
        for keys, quantity in _OF_LOADS.items():
            yield ("gears", gear, *keys), [CaseNumber(n, quantity) for n in numbers]
        for of_gear, named in owners.items():
            for name, owner in named.items():
                if varied := _acting(case, [CaseNumber(n, of_gear, owner) for n in numbers]):
                    yield ("gears", gear, of_gear, name), varied
    yield from _of_slips(case)
    for name, link in links.items():
        yield ("drag", name), [CaseNumber(n, "drag", link) for n in everywhere]
    for name, number in elements.items():
        yield (name, "drag"), [CaseNumber(n, "open_drag", number) for n in everywhere]
    yield from _of_balances(case)
    yield from _of_mechanisms(case, free)


def _acting(case: Transmission, numbers: Sequence[CaseNumber]) -> list[CaseNumber]:
    """Return the numbers, except speed ratios of converters that are bypassed or open."""
    first = case.own_mechanisms.start - 1
    return [
        number
        for number in numbers
        if number.quantity != "speed_ratios"
        or first + number.owner not in case.unloaded_converters(case.gears[number.gear or 0])
    ]


def _of_mechanisms(
    case: Transmission, free: Mapping[str, int]
) -> Iterator[tuple[Keys, list[CaseNumber]]]:
    everywhere = range(len(case.gears))
    for name, number in free.items():
        if numbers := _acting(case, [CaseNumber(n, "speed_ratios", number) for n in everywhere]):
            yield (name, "speed_ratio"), numbers
    indexed = enumerate(case.mechanisms)
    mechanisms: dict[str, tuple[int, ...]] = {mechanism.name: (n,) for n, mechanism in indexed}
    mechanisms |= {device.name: device.mechanisms for device in case.own_devices}
    for name, indices in mechanisms.items():
        for of_mechanism in OF_MECHANISMS if len(indices) == 1 else ("efficiency",):
            numbers = [CaseNumber(n, of_mechanism, index) for n in everywhere for index in indices]
            yield (name, of_mechanism), numbers


def _of_slips(case: Transmission) -> Iterator[tuple[Keys, list[CaseNumber]]]:
    for place, element in enumerate(case.shift_elements, 1):
        slipping = [n for n, gear in enumerate(case.gears) if place in gear.slip]
        for gear, numbers in _together_and_each(case, slipping):
            slips = [CaseNumber(n, "slip", place) for n in numbers]
            yield ("gears", gear, "slip", element.name), slips
            if not any(isinstance(case.gears[n].slip[place], OfLoad) for n in numbers):
                slips = [CaseNumber(n, "relative_slip", place) for n in numbers]
                yield ("gears", gear, "slip", element.name, "relative"), slips


def _of_balances(case: Transmission) -> Iterator[tuple[Keys, list[CaseNumber]]]:
    balanced = [n for n, gear in enumerate(case.gears) if gear.balance]
    for gear, numbers in _together_and_each(case, balanced):
        batteries = [CaseNumber(n, "battery") for n in numbers]
        yield ("gears", gear, "balance", "battery"), batteries


def _together_and_each(
    case: Transmission, numbers: Sequence[int]
) -> Iterator[tuple[str, Sequence[int]]]:
    """Yield the indices of all gears under the key `*`, then of each gear under its name."""
    yield "*", numbers
    for number in numbers:
        yield case.gears[number].name, [number]


def _check(case: Transmission, path: str, number: CaseNumber, column: Floats) -> None:
    if number.quantity == "ratio":
        between = case.ratio_range(number.owner)
        wrong, expected = (
            matrix.impossible("ratio", column, between),
            matrix.expected_ratio(between),
        )
    else:
        wrong, expected = _check_quantity(number.quantity, column)
    if wrong.any():
        variant = int(np.flatnonzero(wrong)[0])
        message = f"read {column[variant]:g} in variant {variant}, expected {expected}"
        raise CaseError([Problem("E415", message, ("vary", path))])


def _check_quantity(quantity: str, column: Floats) -> tuple[Booleans, str]:
    """Return flags of invalid numbers, and words for the valid numbers."""
    if quantity in ("ratio", "efficiency"):
        return matrix.impossible(quantity, column), matrix.EXPECTED[quantity]  # type: ignore[arg-type] # one of the two
    wrong = ~np.isfinite(column)
    if quantity == "back_efficiency":
        return wrong | (column < 0) | (column > 1), "an efficiency from 0 to 1"
    if quantity in ("drag", "open_drag"):
        return wrong | (column < 0), "a torque of 0 or more"
    if quantity == "load.speed":
        return wrong | (column == 0), "a finite speed other than 0"
    return wrong, "a finite number"
