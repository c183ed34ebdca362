"""The structural-distribution matrix, and the linear systems for speeds and torques.

Source: Algin, Schematization and calculation of mobile machine presented as multibody system
(tables 1 and 3, figures 3 and 4).

Sign convention of the whole program: the column of a device contains the torques that its links
give to the device when the torque on its first link is 1. External torques act on a link, and the
input torque is +1. The output torque is the torque that the train gives to its load. Without
losses, the output torque therefore equals the ratio ``w_input/w_output``.

The coefficients of a gear set or gear pair in its column are also its coefficients in the speed
equation (its row). A variator of the speed ratio i has the column and row (i, -1). This also
applies to i = 0: the second link is then at rest under any torque, and the first link carries no
torque. A converter of the torque ratio K has the row (i, -1) and the column (1, -K).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from vstatics.core.model.empty import EMPTY
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, SpeedOf, Transmission
from vstatics.core.numerics.arrays import Booleans, Floats, as_floats
from vstatics.core.numerics.elimination import RIGHT, Coefficient, Equation
from vstatics.core.numerics.traced import Number, is_exact
from vstatics.core.start import NamedTuple
from vstatics.core.statics.efficiency import Efficiency, efficiencies_by_direction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


Column = Mapping[int, Coefficient]
"""Torque on each link of a device, by link number, if the torque on its first link is 1. [-]"""


class Variant(NamedTuple):
    """Transmission with ratios and efficiencies as floats, or traced for many variants."""

    case: Transmission
    ratios: Sequence[Number]
    """Basic ratio u of each mechanism. [-]"""
    efficiencies: Sequence[Efficiency]
    """Efficiency of each mechanism in both directions. [-]"""
    columns: Sequence[Column]
    """Columns of the structural-distribution matrix without losses."""
    rows: Sequence[Column]
    """Speed equation of each device: coefficients of the link speeds, whose weighted sum is 0."""


def variant_of(
    case: Transmission,
    ratios: Sequence[Number] | None = None,
    efficiencies: Sequence[Number | Efficiency] | None = None,
) -> Variant:
    """Return the variant with other ratios and efficiencies, by default the numbers of the case."""
    if ratios is None:
        ratios = [mechanism.ratio for mechanism in case.mechanisms]
    both = efficiencies_by_direction(case, efficiencies)
    torques = columns(case, ratios)
    return Variant(
        case, ratios, both, torques, rows(case, ratios) if case.has_converter else torques
    )


def columns(case: Transmission, ratios: Sequence[Number]) -> list[Column]:
    """Return the matrix columns of all devices: shift elements, mechanisms and springs.

    The housing has no row in the matrix.

    Parameters
    ----------
    ratios : sequence of Number
        Basic ratio of each mechanism. [-]
    """
    return _by_device(case, map(column_of, case.mechanisms, ratios))


def rows(case: Transmission, ratios: Sequence[Number]) -> list[Column]:
    """Return the speed equations of shift elements, mechanisms and springs, as in `columns`."""
    return _by_device(case, map(row_of, case.mechanisms, ratios))


def _by_device(case: Transmission, of_mechanisms: Iterable[Sequence[Coefficient]]) -> list[Column]:
    mechanisms = [
        _without_housing(mechanism.links, torques)
        for mechanism, torques in zip(case.mechanisms, of_mechanisms, strict=True)
    ]
    return [
        *case.derived(_of_elements),
        *mechanisms,
        *(spring.form for spring in case.springs),
    ]


def _of_elements(case: Transmission) -> list[Column]:
    return [_without_housing(element.links, ON_ELEMENT) for element in case.shift_elements]


ON_ELEMENT = (1, -1)
"""Torques on the first and the second link of a shift element."""


def _without_housing(links: Sequence[int], torques: Sequence[Coefficient]) -> Column:
    return {link: torque for link, torque in zip(links, torques, strict=True) if link != HOUSING}


def column_of(mechanism: Mechanism, ratio: Any) -> tuple[Any, Any, Any]:
    """Return the torques on the three links of a mechanism, relative to the torque on the first.

    >>> column_of(Mechanism(1, 2, 0, 0.4, kind="converter", points=((0, 2.4), (0.8, 1))), 0.4)
    (1, -1.7, (1.7, -1))
    """
    if mechanism.kind != "converter":
        return row_of(mechanism, ratio)
    torque_ratio = torque_ratio_of(mechanism, ratio)
    return 1, -torque_ratio, (torque_ratio, -1)


def row_of(mechanism: Mechanism, ratio: Any) -> tuple[Any, Any, Any]:
    """Return the coefficients of the link speeds in the speed equation of a mechanism.

    >>> row_of(Mechanism(1, 2, 0, 0.4, kind="variator"), 0.4)
    (0.4, -1, (1, -0.4))
    """
    return (ratio, -1, (1, -ratio)) if mechanism.kind else on_mechanism(ratio)


def on_mechanism(ratio: Number) -> tuple[Number, Number, tuple[Number, Number]]:
    """Return the torques on the links of a mechanism: 1, -u, and u - 1 as the terms (u, -1).

    The difference is not calculated, because it would lose digits if the basic ratio u is near 1.
    """
    return 1, -ratio, (ratio, -1)


def torque_ratio_of(converter: Mechanism, speed_ratio: Any) -> Any:
    """Return the torque ratio of a converter, second link to first, at a speed ratio [-].

    The torque ratio is interpolated linearly between the points and constant outside them.
    """
    points = tuple((point[0], point[1]) for point in converter.points)
    if isinstance(speed_ratio, np.ndarray):
        return np.interp(speed_ratio, *np.transpose(points))
    if is_exact(speed_ratio):
        exact = type(speed_ratio)
        points = tuple((exact(i), exact(K)) for i, K in points)
    if speed_ratio <= points[0][0]:
        return points[0][1]
    for (left, before), (right, after) in pairwise(points):
        if speed_ratio <= right:
            return before + (speed_ratio - left) * ((after - before) / (right - left))
    return points[-1][1]


def column(ratio: Any) -> tuple[Any, Any, Any]:
    """Return the torques on the three links of a mechanism: 1, -u and u - 1.

    The basic ratio u is a number, an array or a symbol.

    >>> column(-2.5)
    (1, 2.5, -3.5)
    """
    first, second, third = on_mechanism(ratio)
    return first, second, value(third)


def value(coefficient: Any) -> Any:
    """Return the value of a coefficient, which is a number or a pair of terms to be added."""
    return coefficient[0] + coefficient[1] if isinstance(coefficient, tuple) else coefficient


def structural_matrix(case: Transmission, ratios: ArrayLike | None = None) -> Floats:
    """Return the structural-distribution matrix, shape (..., links, devices) [-].

    Parameters and errors are as in the public function `distribution_matrix`.

    Examples
    --------
    A brake on the ring gear (link 3) of a planetary gear set:

    >>> from vstatics.core.model.transmission import ShiftElement
    >>> mechanism = Mechanism(1, 3, 2, -2.5)
    >>> structural_matrix(Transmission(3, [ShiftElement(3, 0)], [mechanism], [Gear([1])]))
    array([[ 0. ,  1. ],
           [ 0. , -3.5],
           [ 1. ,  2.5]])
    """
    if ratios is None:
        given = np.array([mechanism.ratio for mechanism in case.mechanisms], dtype=np.float64)
    else:
        given = by_mechanism("ratios", ratios, len(case.mechanisms))
    matrix = np.zeros((1 + case.links, len(case.devices), *given.shape[:-1]))
    by_device: Any = given.tolist() if given.ndim == 1 else np.moveaxis(given, -1, 0)
    for number, torques in enumerate(columns(case, by_device)):
        for link, torque in torques.items():
            matrix[link, number] = value(torque)
    without_housing = matrix[1:]
    return without_housing if given.ndim == 1 else np.moveaxis(without_housing, (0, 1), (-2, -1))


def speed_rows(case: Transmission, gear: Gear, rows: Sequence[Column]) -> list[Equation]:
    """Return the equations for the link speeds of a gear. Unknown ``n - 1`` is the speed of link n.

    Mechanisms have the equation ``w_f - u w_s + (u - 1) w_h = 0``, shift elements ``w_a - w_b =
    slip``, where the slip of an engaged element is 0. The equation of a spring states that its
    twist is constant. Further equations are ``w_input = 1`` and one for each prescribed speed,
    which is a number or a multiple of another link's speed (figure 3). `always_loaded` devices have
    an equation, except converters whose speed ratio the slip of a shift element determines.

    Parameters
    ----------
    rows : sequence of Column
        Speed equations of all devices, from `rows`.
    """
    coupled = always_coupled(case, gear)
    equations: list[Equation] = [
        {link - 1: part for link, part in rows[device].items()}
        for device in [*coupled, *(number - 1 for number in gear.engaged)]
    ]
    for number, slip in gear.slip.items():
        of_links = {link - 1: part for link, part in rows[number - 1].items()}
        equations.append({**of_links, RIGHT: slip})
    equations.append({case.gear_input(gear) - 1: 1.0, RIGHT: 1.0})
    for link, speed in gear.speeds.items():
        if isinstance(speed, SpeedOf):
            equations.append({link - 1: 1.0, speed.link - 1: -speed.factor})
        else:
            equations.append({link - 1: 1.0, RIGHT: speed})
    return equations


INPUT_SPEED = "the input speed"
"""Name of the equation ``w_input = 1`` in messages."""
GIVEN_SPEED = "the given speed of link "
"""Prefix of the name of the equation of a prescribed speed; the name of the link follows."""


def speed_row_names(case: Transmission, gear: Gear) -> list[str]:
    """Return the name of each equation of `speed_rows`, for messages."""
    return [
        *(case.devices[device] for device in always_coupled(case, gear)),
        *(element.name for element in case.elements_at(gear.carrying)),
        INPUT_SPEED,
        *(f"{GIVEN_SPEED}{case.link_name(link)}" for link in gear.speeds),
    ]


def torque_rows(
    case: Transmission,
    gear: Gear,
    columns: Sequence[Column],
    drag: Mapping[int, Number] = EMPTY,
    external: Mapping[int, Number] | None = None,
) -> list[Equation]:
    """Return the equilibrium equation of each link of a gear (figure 4).

    The system is ``A M + e_out Mx - E_held Mh = T`` with the matrix A of `columns`, the torques M
    on first links, the output torque Mx, the holding torques Mh, and the known external torques T
    including drag. e_out and E_held contain 1 for the output link and for the held links. The known
    torque on the pump of a converter (`Gear.pump_torques`) is a further equation.

    Unknowns are the torque on the first link of each of `loaded_devices`, the output torque, and
    the holding torque of each of `held_links`. A disengaged shift element carries no torque, so it
    adds no unknown.

    Parameters
    ----------
    drag : mapping of int to float
        Drag as an external torque on each link, by link number. [-]
    external : mapping of int to float, optional
        Result of `external_torques` for the gear, if it is already known. [-]
    """
    rows: list[dict[int, Coefficient]] = [{} for _ in range(case.links)]
    loaded = loaded_devices(case, gear)
    for unknown, device in enumerate(loaded):
        for link, torque in columns[device].items():
            rows[link - 1][unknown] = torque
    rows[case.gear_output(gear) - 1][len(loaded)] = 1.0
    for unknown, link in enumerate(held_links(case, gear), len(loaded) + 1):
        rows[link - 1][unknown] = -1.0
    torques = dict(external_torques(case, gear) if external is None else external)
    for link, torque in drag.items():
        torques[link] = torques.get(link, 0.0) + torque
    for link, torque in torques.items():
        rows[link - 1][RIGHT] = torque
    for device, torque in pump_torques(case, gear).items():
        rows.append({loaded.index(device): 1.0, RIGHT: torque})
    return [*rows]


def loaded_devices(case: Transmission, gear: Gear) -> list[int]:
    """Return the indices of the devices that can carry torque.

    These are shift elements that are engaged or have a prescribed slip, and `always_loaded`.
    """
    return sorted(number - 1 for number in gear.carrying) + always_loaded(case, gear)


def always_loaded(case: Transmission, gear: Gear) -> list[int]:
    """Return the device indices of mechanisms and springs that can carry torque.

    Converters that are bypassed or open, and springs without stiffness, are left out.
    """
    elements, mechanisms = len(case.shift_elements), len(case.mechanisms)
    left_out = case.unloaded_converters(gear)
    left_out |= {n for n, spring in enumerate(case.springs, mechanisms) if spring.is_damper}
    number = elements + mechanisms + len(case.springs)
    return [device for device in range(elements, number) if device - elements not in left_out]


def always_coupled(case: Transmission, gear: Gear) -> list[int]:
    """Return the device indices of mechanisms and springs that have a speed equation."""
    known = pump_torques(case, gear)
    return [device for device in always_loaded(case, gear) if device not in known]


def pump_torques(case: Transmission, gear: Gear) -> dict[int, Any]:
    """Return the known torques on the pumps of converters by device [-]; see `Gear`."""
    if not gear.pump_torques:
        return {}
    first, loaded = case.own_mechanisms.start - 1, always_loaded(case, gear)
    first += case.among_devices.start
    return {
        first + number: given_torque(case, gear, torque)
        for number, torque in gear.pump_torques.items()
        if first + number in loaded  # a clutch with slip 0 bypasses the converter
    }


def held_links(case: Transmission, gear: Gear) -> list[int]:
    """Return the links whose prescribed speed is held by an unknown external torque.

    A prescribed speed of the output adds no unknown, because its torque is the output torque.
    """
    holding = gear.speeds if gear.holding is None else gear.holding
    return [link for link in holding if link != case.gear_output(gear)]


def external_torques(case: Transmission, gear: Gear) -> dict[int, float]:
    """Return the known external torques by link: input torque and `torques` of the gear [-].

    The relative input torque is 1, or 0 if the input torque is 0. The other torques are then in
    N*m.
    """
    torques = {case.gear_input(gear): case.input_torque(gear)}
    for link, torque in gear.torques.items():
        torques[link] = torques.get(link, 0.0) + given_torque(case, gear, torque)
    return torques


def given_torque(case: Transmission, gear: Gear, torque: Any) -> Any:
    """Return an external torque of a gear relative to the input torque [-].

    The result is 0 for a fraction of an input torque of 0. A torque that varies (traced or an
    array) or that is an `OfLoad` is returned unchanged.
    """
    if isinstance(torque, OfLoad) or not isinstance(torque, float | int):
        return torque
    return torque * case.input_torque(gear)


def by_mechanism(name: str, given: ArrayLike, mechanisms: int) -> Floats:
    """Return `given` as an array of floats whose last axis has the length `mechanisms`.

    Raises
    ------
    CaseError
        If the array contains something other than numbers; the message calls it `name`.
    ValueError
        If the last axis has another length.
    """
    array = as_floats(name, given)
    if array.ndim == 0 or array.shape[-1] != mechanisms:
        raise ValueError(f"{name} of shape {array.shape}: expected a last axis of {mechanisms}")
    return array


Quantity = Literal["ratio", "efficiency"]
"""Name of a property of mechanisms that can differ between variants."""
EXPECTED = {
    "ratio": "a finite ratio other than 0",
    "efficiency": "an efficiency above 0 and up to 1",
}
"""Permitted numbers of each quantity in words, for messages."""


def expected_ratio(between: tuple[float, float]) -> str:
    """Return words for the ratios that are possible between two bounds.

    >>> expected_ratio((-math.inf, -1.0)), expected_ratio((-math.inf, math.inf))
    ('a finite ratio below -1, as teeth give it', 'a finite ratio other than 0')
    """
    ends = zip(("above", "below"), between, strict=True)
    bounds = ", ".join(f"{word} {end:g}" for word, end in ends if math.isfinite(end))
    return f"a finite ratio {bounds}, as teeth give it" if bounds else EXPECTED["ratio"]


def impossible(
    quantity: Quantity, numbers: Floats, between: tuple[float, float] = (-math.inf, math.inf)
) -> Booleans:
    """Return flags of numbers that are not valid as a ratio or an efficiency of a mechanism.

    Parameters
    ----------
    numbers : ndarray, shape (variants,)
        Ratios or efficiencies. [-]
    between : (float, float)
        Bounds of ratios, as in `Transmission.ratio_range`.

    Examples
    --------
    >>> impossible("ratio", np.array([-2.0, 1.0, np.nan]))
    array([False, False,  True])
    >>> impossible("ratio", np.array([-2.0, 0.0]))
    array([False,  True])
    """
    if quantity == "efficiency":
        return ~((numbers > 0) & (numbers <= 1))
    low, high = numbers.min(initial=math.inf), numbers.max(initial=-math.inf)
    least, most = between
    if least < low <= high < min(most, 0.0) or max(least, 0.0) < low <= high < most:
        return np.zeros_like(numbers, np.bool_)  # shortcut: nearly always all numbers are valid
    possible: Booleans = (least < numbers) & (numbers < most) & (numbers != 0)
    return ~possible
