"""What the arrays of `Results` have of the state of one gear."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from vstatics.model.own import Planet
from vstatics.model.parts import HOUSING
from vstatics.model.transmission import Transmission
from vstatics.numerics.choices import where
from vstatics.numerics.rests import guard_within
from vstatics.numerics.signed import Condition
from vstatics.numerics.tape import Rest
from vstatics.numerics.tolerances import CLOSED
from vstatics.numerics.traced import Number, is_traced
from vstatics.statics.state import GearState

Numbers = Sequence[Number]
Values = Mapping[str, Number | Rest | Condition | Sequence[Number | Rest | Condition]]
"""Name of an array of `Results` -> its values in one gear and one variant, or traced for many."""


def values_of(state: GearState) -> Values:
    """What the arrays of `Results` have of a gear."""
    case = state.case
    speeds, search, lossy = state.ideal.speeds, state.search, state.search.lossy
    devices = case.own_devices
    return {
        "speeds": speeds.links[: case.own_links],
        "planet_speeds": list(_planet_speeds(state)),
        "slip_speeds": speeds.slips,
        "ratio": state.ratio,
        "torques": _torques(state, lossy=False),
        "holding_torques": _by_link(case, state.torques.holding),
        "lossy_torques": _torques(state, lossy=True),
        "lossy_holding_torques": _by_link(case, state.lossy_torques.holding),
        "efficiency": lossy.efficiency,
        "power_sign": lossy.signs,
        "idle": [all(search.idle[index] for index in one.mechanisms) for one in devices],
        "losses": [_total([lossy.losses[index] for index in one.mechanisms]) for one in devices],
        "power_balance": lossy.balance,
        "drag_losses": lossy.drag_losses,
        "consistent": state.consistent,
        "locked": search.locked,
        "undecided": search.undecided,
        "turned": search.turned,
        "choices": search.choices,
        "tied_up": state.tied_up,
        "missing": speeds.missing,
        "excess": speeds.excess,
        "balanced": state.balanced,
        "holds": [n in state.engaged for n in range(1, len(case.shift_elements) + 1)],
        "conflict": state.conflict,
        "mesh_torques": list(_of_meshes(state, state.torques.on_first_link)),
        "lossy_mesh_torques": list(_of_meshes(state, state.lossy_torques.on_first_link)),
        "mesh_losses": [lossy.losses[index] for one in devices for index, _ in one.meshes_by_index],
    }


def _total(numbers: Numbers) -> Number:
    """The sum of at least one number."""
    total = numbers[0]
    for number in numbers[1:]:
        total = total + number
    return total


def _planet_speeds(state: GearState) -> Iterator[Number | Rest]:
    """Speeds of all planets against their carriers."""
    case, ratios = state.case, state.ideal.variant.ratios
    for device in case.own_devices:
        for planet in device.planets:
            index = planet.mechanism
            if planet.wheels and (index < 0 or ratios[index] == planet.ratio):
                yield _by_wheels(state, planet)
            else:
                yield _by_ratio(state, index)


def _by_ratio(state: GearState, index: int) -> Number | Rest:
    """From the planet ratio of a mechanism."""
    mechanism, motion = state.case.mechanisms[index], state.relative_speeds[index]
    if mechanism.planet_ratio is not None:
        return motion / mechanism.planet_ratio
    ratio = state.ideal.variant.ratios[index]
    is_plain = mechanism.is_plain(ratio)
    return math.nan if is_plain is False else where(is_plain, motion / ((ratio + 1) / 2))


def _by_wheels(state: GearState, planet: Planet) -> Number:
    """From the first wheel that meshes with its train and has a speed."""
    if math.isnan(planet.speed):
        return math.nan

    def speed(link: int) -> Number:
        return 0.0 if link == HOUSING else state.speeds[link - 1]

    carrier = speed(planet.carrier)
    for wheel in planet.wheels:
        own = speed(wheel.link)
        if own == own and carrier == carrier:  # noqa: PLR0124 - else NaN
            if state.relative_speeds[wheel.mechanism] == 0:
                return 0.0
            return (own - carrier) / wheel.ratio * planet.speed
    return math.nan


def _torques(state: GearState, *, lossy: bool) -> list[Number] | list[Number | Rest]:
    """On shift elements, mechanisms or members of drawn elements, springs, and the output."""
    torques = (state.lossy_torques if lossy else state.torques).on_first_link
    if state.case.drawing is None:
        return torques
    members = state.member_torques(lossy=lossy)
    elements = len(state.case.shift_elements)
    return [
        *torques[:elements],
        *(torque for device in members for torque in device.values()),
        *torques[elements + len(state.case.mechanisms) :],
    ]


def _of_meshes(state: GearState, torques: Numbers) -> Iterator[Number]:
    """On the first wheel of each mesh, where its teeth are known."""
    elements = len(state.case.shift_elements)
    for device in state.case.own_devices:
        for index, is_known in device.meshes_by_index:
            yield torques[elements + index] if is_known else math.nan


def _by_link(case: Transmission, holding: Mapping[int, Number]) -> list[Number]:
    return [holding.get(link, math.nan) for link in range(1, case.own_links + 1)]


def guard_power(state: GearState) -> None:
    """Guard, for traced numbers, that power is conserved: without losses and with them.

    Without losses output torque times output speed is 1, equation (1) of docs/method.md.
    A variant of which this is not true is left to be calculated by itself.
    """
    gear, balance = state.gear, state.search.lossy.balance
    power = state.torques.on_first_link[-1] * state.output_speed
    if not gear.speeds and not gear.torques and is_traced(power):
        guard_within(power, 1 - CLOSED, 1 + CLOSED)
    if isinstance(balance, Rest):
        guard_within(balance, -CLOSED, CLOSED)


def flat(values: Values, names: Sequence[str]) -> list[Number | Rest | Condition]:
    """The values of some arrays in their order, without -0; what overflowed does not exist."""
    numbers: list[Number | Rest | Condition] = []
    for name in names:
        value = values[name]
        numbers += value if isinstance(value, Sequence) else [value]
    return [_tidy(value) if isinstance(value, float) else value for value in numbers]


def _tidy(value: float) -> float:
    return value + 0.0 if -math.inf < value < math.inf else math.nan
