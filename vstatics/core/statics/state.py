"""State of a gear: its speeds, torques and losses, as an object and as rows of arrays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from operator import add
from typing import Any

from vstatics.core.model.fields import Bodies
from vstatics.core.model.parts import HOUSING, Planet
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.tolerances import CLOSED
from vstatics.core.numerics.traced import (
    Number,
    guard_within,
    is_nan,
    is_traced,
    plain,
    residual,
    where,
)
from vstatics.core.start import NamedTuple
from vstatics.core.statics.bodies import turning_as_one
from vstatics.core.statics.efficiency import Signs, lossy_ratios
from vstatics.core.statics.ideal import IdealGear
from vstatics.core.statics.matrix import always_loaded, column_of, columns, value
from vstatics.core.statics.power import LinkPower, device_powers, drag_powers, port_powers
from vstatics.core.statics.signs import SignSearch
from vstatics.core.statics.status import OK, Status, statuses
from vstatics.core.statics.torques import NO_DRAG, Drag, Torques, solve_sums

LOSSY_SPEED_RATIO = 0.01
"""Speed ratio at which every real converter loses power. [-]"""


class GearState(NamedTuple):
    """Speeds, torques and losses of a gear; every freewheel either holds or overruns.

    Speeds are relative to the input speed, torques to the input torque, powers to the
    input power; signs as in `matrix`. NaN marks a value that does not exist.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
    >>> state = solve(case).gear(1)
    >>> state
    <GearState '1': ratio 3.5, efficiency 0.9714>
    >>> state.speeds, state.relative_speeds, state.signs
    ([1.0, 0.0, 0.2857142857142857], [0.7142857142857143], (1.0,))
    >>> round(state.lossy_torques.on_first_link[-1], 9), state.status.name
    (3.4, '')
    """

    ideal: IdealGear
    search: SignSearch
    conflict: bool = False
    """True if no state exists because a freewheel can neither hold nor overrun."""
    exact: bool = False
    """True if the gear is calculated in fractions because floats leave too few digits."""

    def __repr__(self) -> str:
        """Return a short description: gear, ratio and efficiency."""
        numbers = f"ratio {self.ratio:.4g}, efficiency {self.search.lossy.efficiency:.4g}"
        return f"<GearState {self.gear.name!r}: {numbers}>"

    @property
    def case(self) -> Transmission:
        """Transmission to which the gear belongs."""
        return self.ideal.variant.case

    @property
    def gear(self) -> Gear:
        """Gear in which holding freewheels are listed as engaged."""
        return self.ideal.gear

    @property
    def engaged(self) -> Sequence[int]:
        """Numbers of the engaged shift elements, including freewheels that hold."""
        return self.gear.joining

    @property
    def holding(self) -> list[int]:
        """Numbers of the freewheels that hold."""
        return [number for number in self.case.freewheels if number in self.gear.engaged]

    @property
    def speeds(self) -> list[Number]:
        """Speed of each link, including planets that are links [-]."""
        return self.ideal.speeds.links

    @property
    def relative_speeds(self) -> list[Number]:
        """Speed difference ``w_f - w_h`` of each mechanism, first link minus third [-]."""
        return self.ideal.speeds.relative_speeds

    @property
    def slip_speeds(self) -> list[Number]:
        """Slip speed of each shift element, first link minus second [-]."""
        return self.ideal.speeds.slips

    @property
    def trial_ratios(self) -> list[Number]:
        """Ratio of each mechanism, with `LOSSY_SPEED_RATIO` for unknown speed ratios [-].

        The sign of a torque behind a converter does not depend on the speed ratio.
        """
        ratios = zip(self.case.mechanisms, self.ideal.variant.ratios, strict=True)
        return [
            LOSSY_SPEED_RATIO if part.kind == "converter" and is_nan(ratio) else ratio
            for part, ratio in ratios
        ]

    @property
    def output_speed(self) -> Number:
        """Speed of the gear's output link [-]."""
        return self.speeds[self.case.gear_output(self.gear) - 1]

    @property
    def ratio(self) -> float:
        """Ratio ``w_input/w_output`` [-]; NaN if the output is at rest."""
        speed = self.output_speed
        ratio: Any = math.nan if speed == 0 else 1 / speed
        return ratio  # type: ignore[no-any-return] # traced while a plan is recorded

    @property
    def drag(self) -> Drag:
        """Drag of links and disengaged shift elements."""
        return self.ideal.drag

    @property
    def torques(self) -> Torques:
        """Torques without losses and drag."""
        return self.ideal.torques

    @property
    def lossy_torques(self) -> Torques:
        """Torques with losses and drag."""
        return self.search.lossy.torques

    @property
    def signs(self) -> Signs:
        """Signs of power in the mechanisms, which are the exponents x of the efficiencies.

        +1 if the first link drives, -1 if it is driven, NaN if indeterminate. Without power the
        convention `Transmission.idle` determines the sign.
        """
        return self.search.lossy.signs

    @property
    def lossy_ratios(self) -> list[Number]:
        """Ratio with losses of each mechanism [-], with the exponents x of `signs`.

        It is ``u * efficiency**x``, or ``u / efficiency**x`` for a variator.
        """
        return lossy_ratios(self.ideal.variant.ratios, self.ideal.variant.efficiencies, self.signs)

    @property
    def mechanism_losses(self) -> Sequence[Number]:
        """Power lost in each mechanism [-]."""
        return self.search.lossy.losses

    @property
    def tied_up(self) -> bool:
        """True if the constraints on the speeds are contradictory."""
        return not self.ideal.speeds.consistent

    @property
    def balanced(self) -> bool:
        """True if torques without losses exist."""
        return self.ideal.torques.consistent

    @property
    def calculable(self) -> bool:
        """True if speeds and torques exist, so that losses can be calculated."""
        return self.balanced and not self.tied_up and not self.conflict

    @property
    def consistent(self) -> bool:
        """True if torques with losses exist and agree with the directions of power."""
        return bool(self.search.lossy.admissible)

    @property
    def certain(self) -> bool:
        """True if all systems of equations keep correct digits in spite of rounding."""
        ideal = self.ideal
        torques = ideal.torques, ideal.torques_with_drag, self.lossy_torques
        return ideal.speeds.certain and all(solution.certain for solution in torques)

    @property
    def statuses(self) -> list[Status]:
        """All statuses of the gear, causes before effects."""
        return statuses(
            tied_up=self.tied_up,
            conflict=self.conflict,
            output_speed=self.output_speed,
            balanced=self.balanced,
            dragged=self.search.dragged,
            locked=self.search.locked,
            undecided=self.search.undecided,
            missing=self.ideal.speeds.missing,
        )

    @property
    def status(self) -> Status:
        """The first of `statuses`, or `OK`."""
        return next(iter(self.statuses), OK)

    @property
    def unloaded(self) -> list[str]:
        """Names of links whose speeds are indeterminate because nothing drives or loads them.

        Such links are free on purpose, for example the race between a disengaged brake and a
        freewheel, or an engine and generator behind a disengaged clutch. The list is empty if a
        shift element is probably missing: the output is indeterminate, or a device loads an
        indeterminate link or connects it to a rotating link.
        """
        case = self.case
        free = {link for link, speed in enumerate(self.speeds, 1) if is_nan(speed)}
        if not self.calculable or case.gear_output(self.gear) in free:
            return []
        turning = {link for link, speed in enumerate(self.speeds, 1) if speed != 0} - free
        carried = [self.torques, self.lossy_torques][: 1 + self.consistent]
        always = always_loaded(case, self.gear)
        for device, shares in enumerate(columns(case, self.ideal.variant.ratios)):
            is_driven = device in always and turning & shares.keys()
            is_loaded = any(torques.factors[device] != 0 for torques in carried)
            if free & shares.keys() and (is_driven or is_loaded):
                return []
        names = enumerate(case.link_names[: case.own_links], 1)
        return [name for link, name in names if link in free]

    @property
    def bodies(self) -> Bodies:
        """Body of each link, the housing first, identified by the body's smallest link number."""
        return turning_as_one(self.case, self.gear, self.speeds)

    def powers(self, *, lossy: bool = True) -> list[LinkPower]:
        """Return the powers that links give to devices, ports and drag [-].

        Unlike in `Results`, powers keep their real direction when coasting. Devices come first,
        then ports and drag.
        """
        torques = self.lossy_torques if lossy else self.torques
        drag = self.drag if lossy else NO_DRAG
        members = [
            {name: plain(torque) for name, torque in members.items()}
            for members in self.member_torques(lossy=lossy)
        ]
        given = (self.case, self.gear, self.speeds, torques)
        direction = self.ideal.direction
        return [
            link_power._replace(power=direction * plain(link_power.power))
            for link_power in (
                *device_powers(*given, members=members, drag=drag),
                *port_powers(*given),
                *drag_powers(self.case, self.gear, self.speeds, drag),
            )
        ]

    def member_torques(self, *, lossy: bool) -> list[dict[str, Number | Residual]]:
        """Return the torques from links to the members of each mechanism or drawn gear set [-].

        The torque on a member of a drawn gear set is a sum over the mechanisms of the set. The sum
        can be determinate even if the terms are not.
        """
        ratios = self.ideal.variant.ratios
        if lossy:
            factors = lossy_ratios([1.0] * len(ratios), self.ideal.variant.efficiencies, self.signs)
            ratios = [u * factor for u, factor in zip(ratios, factors, strict=True)]
        torques = self.lossy_torques if lossy else self.torques
        factors_of = torques.factors
        shares_of = list(map(column_of, self.case.mechanisms, ratios))
        elements = len(self.case.shift_elements)
        torques_by_member: list[dict[str, Number | Residual]] = []
        unknown: list[tuple[int, str, dict[int, Number]]] = []
        for place, device in enumerate(self.case.own_devices):
            torques_by_member.append({})
            for member in device.members:
                shares = [
                    (elements + index, value(shares_of[index][part]))
                    for index, part in member.places
                ]
                torque = residual([share * factors_of[index] for index, share in shares])
                torques_by_member[place][member.name] = torque
                if isinstance(torque, float) and math.isnan(torque):
                    unknown.append((place, member.name, dict(shares)))
        exists = self.consistent if lossy else self.calculable
        if unknown and exists and all(ratio == ratio for ratio in ratios):  # noqa: PLR0124
            sums = [shares for _, _, shares in unknown]
            drag = self.drag if lossy else NO_DRAG
            values = solve_sums(self.case, self.gear, columns(self.case, ratios), sums, drag)
            for (place, name, _), sum_ in zip(unknown, values, strict=True):
                torques_by_member[place][name] = sum_
        return torques_by_member


Numbers = Sequence[Number]
Values = Mapping[str, Number | Residual | Condition | Sequence[Number | Residual | Condition]]
"""Values of a gear, by the name of the array in `Results`.

Values are floats, or traced numbers while a plan is recorded.
"""


def values_of(state: GearState) -> Values:
    """Return the values of a gear for each array of `Results`."""
    case = state.case
    speeds, search, lossy = state.ideal.speeds, state.search, state.search.lossy
    links, devices = case.own_links, case.own_devices
    return {
        "speeds": speeds.links[:links],
        "planet_speeds": list(_planet_speeds(state)),
        "slip_speeds": speeds.slips,
        "ratio": state.ratio,
        "speed_ratio": list(_speed_ratios(state)),
        "torques": _torques(state, lossy=False),
        "holding_torques": _by_link(links, state.torques.holding),
        "lossy_torques": _torques(state, lossy=True),
        "lossy_holding_torques": _by_link(links, state.lossy_torques.holding),
        "efficiency": lossy.efficiency,
        "power_sign": lossy.signs,
        "idle": [all(search.idle[index] for index in device.mechanisms) for device in devices],
        "losses": [
            reduce(add, (lossy.losses[index] for index in device.mechanisms)) for device in devices
        ],
        "power_balance": lossy.balance,
        "drag_losses": lossy.drag_losses,
        "gear_losses": lossy.gear_losses,
        "slip_losses": lossy.slip_losses,
        "consistent": state.consistent,
        "locked": search.locked,
        "dragged": search.dragged,
        "undecided": search.undecided,
        "turned": search.turned,
        "choices": search.choices,
        "tied_up": state.tied_up,
        "missing": speeds.missing,
        "excess": speeds.excess,
        "balanced": state.balanced,
        "holds": [n in state.gear.carrying for n in range(1, len(case.shift_elements) + 1)],
        "conflict": state.conflict,
        "exact": state.exact,
        "mesh_torques": list(_mesh_torques(state, state.torques.on_first_link)),
        "lossy_mesh_torques": list(_mesh_torques(state, state.lossy_torques.on_first_link)),
        "mesh_losses": [
            lossy.losses[index] for device in devices for index, _ in device.meshes_by_index
        ],
    }


def _speed_ratios(state: GearState) -> Iterator[Number]:
    unloaded = state.case.unloaded_converters(state.gear)
    for place, mechanism in enumerate(state.case.mechanisms):
        if mechanism.kind == "converter":
            yield math.nan if place in unloaded else state.ideal.variant.ratios[place]


def _planet_speeds(state: GearState) -> Iterator[Number | Residual]:
    case, ratios = state.case, state.ideal.variant.ratios
    for device in case.own_devices:
        for planet in device.planets:
            index = planet.mechanism
            if planet.wheels and (index < 0 or ratios[index] == planet.ratio):
                yield _planet_speed_by_wheels(state, planet)
            else:
                yield _planet_speed_by_ratio(state, index)


def _planet_speed_by_ratio(state: GearState, index: int) -> Number | Residual:
    mechanism, motion = state.case.mechanisms[index], state.relative_speeds[index]
    if mechanism.planet_ratio is not None:
        return motion / mechanism.planet_ratio
    ratio = state.ideal.variant.ratios[index]
    is_plain = mechanism.is_plain(ratio)
    return math.nan if is_plain is False else where(is_plain, motion / ((ratio + 1) / 2))


def _planet_speed_by_wheels(state: GearState, planet: Planet) -> Number:
    if math.isnan(planet.speed):
        return math.nan

    def speed(link: int) -> Number:
        return 0.0 if link == HOUSING else state.speeds[link - 1]

    carrier = speed(planet.carrier)
    for wheel in planet.wheels:
        wheel_speed = speed(wheel.link)
        if wheel_speed == wheel_speed and carrier == carrier:  # noqa: PLR0124 - else NaN
            if state.relative_speeds[wheel.mechanism] == 0:
                return 0.0
            return (wheel_speed - carrier) / wheel.ratio * planet.speed
    return math.nan


def _torques(state: GearState, *, lossy: bool) -> list[Number] | list[Number | Residual]:
    """Return torques on shift elements, mechanisms or members, springs, and the output [-]."""
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


def _mesh_torques(state: GearState, torques: Numbers) -> Iterator[Number]:
    """Yield the torque on the first gear of each mesh [-]; NaN if the teeth are unknown."""
    elements = len(state.case.shift_elements)
    for device in state.case.own_devices:
        for index, is_known in device.meshes_by_index:
            yield torques[elements + index] if is_known else math.nan


def _by_link(links: int, holding: Mapping[int, Number]) -> list[Number]:
    return [holding.get(link, math.nan) for link in range(1, links + 1)]


def guard_power(state: GearState) -> None:
    """Require conservation of power in each variant of traced numbers, without and with losses.

    Without losses output torque times output speed is 1, equation (1) of docs/method.md. A variant
    that violates conservation is calculated separately.
    """
    gear, balance = state.gear, state.search.lossy.balance
    power = state.torques.on_first_link[-1] * state.output_speed
    if is_traced(power) and state.case.conserves_power(gear):
        guard_within(power, 1 - CLOSED, 1 + CLOSED)
    if isinstance(balance, Residual):
        guard_within(balance, -CLOSED, CLOSED)


def flat(values: Values, names: Sequence[str]) -> list[Number | Residual | Condition]:
    """Return the values of the named arrays as a flat list, with 0 for -0 and NaN for overflow."""
    numbers: list[Number | Residual | Condition] = []
    for name in names:
        value = values[name]
        numbers += value if isinstance(value, Sequence) else [value]
    return [
        (value + 0.0 if -math.inf < value < math.inf else math.nan)
        if isinstance(value, float)
        else value
        for value in numbers
    ]
