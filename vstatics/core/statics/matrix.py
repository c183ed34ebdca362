"""Structural-distribution matrix of a case or a variant, and the linear systems made from it.

Source: Algin, Schematization and calculation of mobile machine presented as
multibody system (tables 1 and 3, figures 3 and 4).

Sign convention, here and everywhere: the column of a device holds the torques that
its links give to it when the torque on its first link is 1. External torques act on
a link, positive like the input's, which is 1; the output torque is the one that the
train gives to its load. So with a ratio ``w_input/w_output`` above 0 and no losses
the output torque equals the ratio.

The column of a set or pair is its equation for speeds, too. A variator of the speed ratio x
has the column (x, -1), which holds at 0 as well: there its second link stands, takes any torque,
and the first has none. A converter has the row (i, -1) and the column (1, -K).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, SpeedOf, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, as_floats
from vstatics.core.numerics.elimination import RIGHT, Coefficient, Equation
from vstatics.core.numerics.traced import Number, is_exact
from vstatics.core.statics.efficiency import Efficiency, efficiencies_by_direction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


Column = Mapping[int, Coefficient]
"""Link number -> torque on that link when the torque on the first link is 1."""

ON_ELEMENT = (1, -1)
"""Torques on the links of a shift element (a, b)."""

INPUT_SPEED = "the input speed"
"""How messages call this condition."""
GIVEN_SPEED = "the given speed of link "
"""How they call that of another link, with its name."""


def on_mechanism(ratio: Number) -> tuple[Number, Number, tuple[Number, Number]]:
    """Torques on the links (f, s, h) of a mechanism: 1, -u, and u - 1 as two terms."""
    return 1, -ratio, (ratio, -1)


def column(ratio: Any) -> tuple[Any, Any, Any]:
    """The same three as plain values: of a number, an array, or a symbol.

    >>> column(-2.5)
    (1, 2.5, -3.5)
    """
    first, second, third = on_mechanism(ratio)
    return first, second, value(third)


def value(coefficient: Any) -> Any:
    """A coefficient as one number."""
    return coefficient[0] + coefficient[1] if isinstance(coefficient, tuple) else coefficient


def values_of(column: Column) -> dict[int, Any]:
    """Return the coefficients of a column as one number each.

    >>> values_of({1: 1, 3: (-2.5, -1)})
    {1: 1, 3: -3.5}
    """
    return {link: value(coefficient) for link, coefficient in column.items()}


def row_of(mechanism: Mechanism, ratio: Any) -> tuple[Any, Any, Any]:
    """The equation for the speeds of a mechanism's links, the last coefficient as two terms.

    >>> row_of(Mechanism(1, 2, 0, 0.4, kind="variator"), 0.4)
    (0.4, -1, (1, -0.4))
    """
    return (ratio, -1, (1, -ratio)) if mechanism.kind else on_mechanism(ratio)


def column_of(mechanism: Mechanism, ratio: Any) -> tuple[Any, Any, Any]:
    """The torques on a mechanism's links, the last as two terms.

    >>> column_of(Mechanism(1, 2, 0, 0.4, kind="converter", points=((0, 2.4), (0.8, 1))), 0.4)
    (1, -1.7, (1.7, -1))
    """
    if mechanism.kind != "converter":
        return row_of(mechanism, ratio)
    torque_ratio = torque_ratio_of(mechanism, ratio)
    return 1, -torque_ratio, (torque_ratio, -1)


def torque_ratio_of(converter: Mechanism, speed_ratio: Any) -> Any:
    """``M_second/M_first`` of a converter: straight between its points, constant outside [-]."""
    points = tuple((point[0], point[1]) for point in converter.points)
    if isinstance(speed_ratio, np.ndarray):
        return np.interp(speed_ratio, *np.transpose(points))
    if is_exact(speed_ratio):
        exact = type(speed_ratio)
        points = tuple((exact(one), exact(other)) for one, other in points)
    if speed_ratio <= points[0][0]:
        return points[0][1]
    for (left, before), (right, after) in pairwise(points):
        if speed_ratio <= right:
            return before + (speed_ratio - left) * ((after - before) / (right - left))
    return points[-1][1]


def rows(case: Transmission, ratios: Sequence[Number]) -> list[Column]:
    """The equations for speeds of shift elements, mechanisms, springs: see `columns`."""
    return _by_device(case, map(row_of, case.mechanisms, ratios))


def columns(case: Transmission, ratios: Sequence[Number]) -> list[Column]:
    """Columns of the structural-distribution matrix: shift elements, mechanisms, springs.

    The housing has no row.

    Parameters
    ----------
    ratios : sequence of Number
        Internal ratio of each mechanism. [-]
    """
    return _by_device(case, map(column_of, case.mechanisms, ratios))


def _by_device(case: Transmission, of_mechanisms: Iterable[Sequence[Coefficient]]) -> list[Column]:
    """What shift elements, mechanisms and springs have for each of their links."""
    of_elements = [
        _without_housing((element.first, element.second), ON_ELEMENT)
        for element in case.shift_elements
    ]
    mechanisms = [
        _without_housing(mechanism.links, torques)
        for mechanism, torques in zip(case.mechanisms, of_mechanisms, strict=True)
    ]
    return [*of_elements, *mechanisms, *(spring.form for spring in case.springs)]


def _without_housing(links: Sequence[int], torques: Sequence[Coefficient]) -> Column:
    return {link: torque for link, torque in zip(links, torques, strict=True) if link != HOUSING}


@refusing()
def distribution_matrix(case: Transmission, ratios: ArrayLike | None = None) -> Floats:
    """Structural-distribution matrix AJK.

    Parameters
    ----------
    case : Transmission
    ratios : array_like, shape (..., mechanisms), optional
        In place of the case's own internal ratios. [-]

    Returns
    -------
    ndarray, shape (..., links, shift elements + mechanisms + springs)
        Torque on each link per torque on the first link of each device. [-]

    Raises
    ------
    ValueError
        If there is not one ratio for each mechanism.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2, 0)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> distribution_matrix(case)
    array([[ 0. ,  1. ],
           [ 1. ,  2.5],
           [ 0. , -3.5]])
    """
    own = [mechanism.ratio for mechanism in case.mechanisms]
    given = by_mechanism("ratios", own if ratios is None else ratios, len(own))
    elements = len(case.shift_elements)
    matrix = np.zeros((*given.shape[:-1], 1 + case.links, len(case.devices)))
    for number, element in enumerate(case.shift_elements):
        for link, torque in zip((element.first, element.second), ON_ELEMENT, strict=True):
            matrix[..., link, number] = torque
    by_device = given.tolist() if given.ndim == 1 else np.moveaxis(given, -1, 0)
    for number, (mechanism, u) in enumerate(zip(case.mechanisms, by_device, strict=True)):
        for link, torques in zip(mechanism.links, column_of(mechanism, u), strict=True):
            matrix[..., link, elements + number] = value(torques)
    for number, spring in enumerate(case.springs, elements + len(own)):
        for link, coefficient in spring.form.items():
            matrix[..., link, number] = coefficient
    return matrix[..., 1:, :]


def by_mechanism(name: str, given: ArrayLike, mechanisms: int) -> Floats:
    """An array with a last axis of mechanisms.

    Raises
    ------
    CaseError
        If it is none of numbers; it is called `name`.
    ValueError
        If it has another.
    """
    array = as_floats(name, given)
    if array.ndim == 0 or array.shape[-1] != mechanisms:
        raise ValueError(f"{name} of shape {array.shape}: expected a last axis of {mechanisms}")
    return array


Quantity = Literal["ratio", "efficiency"]
"""What of a mechanism can differ from variant to variant."""

EXPECTED = {
    "ratio": "a finite ratio other than 0",
    "efficiency": "an efficiency above 0 and up to 1",
}


def expected_ratio(between: tuple[float, float]) -> str:
    """What a ratio can be between two, in words.

    >>> expected_ratio((-math.inf, -1.0)), expected_ratio((-math.inf, math.inf))
    ('a finite ratio below -1, as teeth give it', 'a finite ratio other than 0')
    """
    ends = zip(("above", "below"), between, strict=True)
    bounds = ", ".join(f"{word} {end:g}" for word, end in ends if math.isfinite(end))
    return f"a finite ratio {bounds}, as teeth give it" if bounds else EXPECTED["ratio"]


def impossible(
    quantity: Quantity, numbers: Floats, between: tuple[float, float] = (-math.inf, math.inf)
) -> Booleans:
    """Which numbers can be no ratio, or no efficiency, of a mechanism.

    Parameters
    ----------
    numbers : ndarray, shape (variants,)
        [-]
    between : (float, float)
        Of ratios, as `Transmission.ratio_range` has them.

    Examples
    --------
    >>> impossible("ratio", np.array([-2.0, 0.0, 1.0, np.nan]))
    array([False,  True, False,  True])
    """
    if quantity == "efficiency":
        return ~((numbers > 0) & (numbers <= 1))
    low, high = numbers.min(initial=math.inf), numbers.max(initial=-math.inf)
    least, most = between
    if least < low <= high < min(most, 0.0) or max(least, 0.0) < low <= high < most:
        return np.zeros_like(numbers, np.bool_)  # as it is nearly always
    possible: Booleans = (least < numbers) & (numbers < most) & (numbers != 0)
    return ~possible


def speed_rows(case: Transmission, gear: Gear, rows: Sequence[Column]) -> list[Equation]:
    """Equations for the link speeds of a gear; unknown ``link - 1`` is the link's speed.

    The row of a mechanism, of a spring, or of an engaged element, is its equation, ``w_f -
    u w_s + (u - 1) w_h = 0`` and ``w_a - w_b = 0``: at mean speeds no twist grows. The input has
    speed 1; then one equation for each further given speed (figure 3), a number or that of
    another link. A bypassed converter has none.

    Parameters
    ----------
    rows : sequence of Column
        See `rows`.
    """
    devices = [*always_loaded(case, gear), *(number - 1 for number in gear.engaged)]
    equations: list[Equation] = [
        {link - 1: part for link, part in rows[device].items()} for device in devices
    ]
    equations.append({case.gear_input(gear) - 1: 1.0, RIGHT: 1.0})
    equations += [_given_speed(link, speed) for link, speed in gear.speeds.items()]
    return equations


def _given_speed(link: int, speed: float | SpeedOf) -> Equation:
    """``w = number``, or ``w - factor w_other = 0``."""
    if isinstance(speed, SpeedOf):
        return {link - 1: 1.0, speed.link - 1: -speed.factor}
    return {link - 1: 1.0, RIGHT: speed}


def speed_row_names(case: Transmission, gear: Gear) -> list[str]:
    """What each equation of `speed_rows` stands for."""
    return [
        *(case.devices[device] for device in always_loaded(case, gear)),
        *(case.shift_elements[number - 1].name for number in gear.engaged),
        INPUT_SPEED,
        *(f"{GIVEN_SPEED}{case.link_name(link)}" for link in gear.speeds),
    ]


def loaded_devices(case: Transmission, gear: Gear) -> list[int]:
    """Indices of the devices that can carry torque: engaged elements, mechanisms, springs."""
    return sorted(number - 1 for number in gear.engaged) + always_loaded(case, gear)


def always_loaded(case: Transmission, gear: Gear) -> list[int]:
    """Those of mechanisms and springs, without bypassed converters and dampers alone."""
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    left_out = case.bypassed(gear)
    left_out |= {n for n, spring in enumerate(case.springs, mechanisms) if spring.is_damper}
    number = elements + mechanisms + len(case.springs)
    return [device for device in range(elements, number) if device - elements not in left_out]


def held_links(case: Transmission, gear: Gear) -> list[int]:
    """Return the links with an unknown external torque, as it holds their given speed.

    A speed given on the output adds no unknown: its torque is the output torque.
    """
    holding = gear.speeds if gear.holding is None else gear.holding
    return [link for link in holding if link != case.gear_output(gear)]


def torque_rows(
    case: Transmission,
    gear: Gear,
    columns: Sequence[Column],
    drag: Mapping[int, Number] = MappingProxyType({}),
) -> list[Equation]:
    """Equilibrium of each link of a gear, ``A M + e_out Mx = T`` (figure 4).

    Unknowns: the torque on the first link of each of `loaded_devices`, the output
    torque, the holding torque of each of `held_links`. An element that is not engaged
    carries none, so it is no unknown.

    Parameters
    ----------
    drag : mapping of int to float
        Link -> external torque of drag. [-]
    """
    rows: list[dict[int, Coefficient]] = [{} for _ in range(case.links)]
    loaded = loaded_devices(case, gear)
    for unknown, device in enumerate(loaded):
        for link, torque in columns[device].items():
            rows[link - 1][unknown] = torque
    rows[case.gear_output(gear) - 1][len(loaded)] = 1.0
    for unknown, link in enumerate(held_links(case, gear), len(loaded) + 1):
        rows[link - 1][unknown] = -1.0
    torques: dict[int, Number] = {**external_torques(case, gear)}
    for link, torque in drag.items():
        torques[link] = torques.get(link, 0.0) + torque
    for link, torque in torques.items():
        rows[link - 1][RIGHT] = torque
    return [*rows]


def external_torques(case: Transmission, gear: Gear) -> dict[int, float]:
    """Known external torques by link [-]: 1 on the input, and the gear's further ones.

    Where the load gives no torque that on the input is 0, and the others are in N*m.
    """
    torques = {case.gear_input(gear): case.input_torque(gear)}
    for link, torque in gear.torques.items():
        torques[link] = torques.get(link, 0.0) + given_torque(case, gear, torque)
    return torques


def given_torque(case: Transmission, gear: Gear, torque: Any) -> Any:
    """A given torque [-]: where the load gives none, 0 if it is a part of that.

    One that varies, traced or an array, stands in the unit of the load as `OfLoad` does.
    """
    if isinstance(torque, OfLoad) or not isinstance(torque, float | int):
        return torque
    return torque * case.input_torque(gear)


class Variant(NamedTuple):
    """A transmission with numbers of its mechanisms: floats, or traced for many variants."""

    case: Transmission
    ratios: Sequence[Number]
    """Internal ratio u of each mechanism. [-]"""
    efficiencies: Sequence[Efficiency]
    columns: Sequence[Column]
    """Of the structural-distribution matrix, without losses."""
    rows: Sequence[Column]
    """The equations for speeds."""


def variant_of(
    case: Transmission,
    ratios: Sequence[Number] | None = None,
    efficiencies: Sequence[Number | Efficiency] | None = None,
) -> Variant:
    """A variant; what is not given is the case's own."""
    if ratios is None:
        ratios = [mechanism.ratio for mechanism in case.mechanisms]
    both = efficiencies_by_direction(case, efficiencies)
    torques = columns(case, ratios)
    return Variant(
        case, ratios, both, torques, rows(case, ratios) if case.has_converter else torques
    )
