"""The state of a gear: everything that holds of it at an instant, as one object."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.model.own import Member
from vstatics.model.transmission import Gear, Transmission
from vstatics.numerics.rests import rest
from vstatics.numerics.tape import Rest
from vstatics.numerics.traced import Number, plain
from vstatics.statics.bodies import Bodies, turning_as_one
from vstatics.statics.drag import NO_DRAG, Drag
from vstatics.statics.efficiency import Signs, lossy_ratios
from vstatics.statics.ideal import IdealGear
from vstatics.statics.matrix import column, columns
from vstatics.statics.power import LinkPower, device_powers, drag_powers, port_powers
from vstatics.statics.sign_search import SignSearch
from vstatics.statics.status import OK, Status, statuses
from vstatics.statics.torques import Torques, solve_sums


class GearState(NamedTuple):
    """A gear in which every freewheel either holds or overruns.

    Speeds are relative to the input speed, torques to the input torque, powers to the
    input power; signs as in `matrix`. NaN stands for what does not exist.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1])])
    >>> state = solve(case).gear(1)
    >>> state.speeds, state.relative_speeds, state.signs
    ([1.0, 0.0, 0.2857142857142857], [0.7142857142857143], (1.0,))
    >>> round(state.lossy_torques.on_first_link[-1], 9), state.status.name
    (3.4, '')
    """

    ideal: IdealGear
    search: SignSearch
    conflict: bool = False
    """There is no such state: a freewheel can neither hold nor overrun."""

    @property
    def case(self) -> Transmission:
        """The transmission."""
        return self.ideal.case

    @property
    def gear(self) -> Gear:
        """The gear, with the freewheels that hold among the engaged elements."""
        return self.ideal.gear

    @property
    def engaged(self) -> Sequence[int]:
        """Numbers of the shift elements that are engaged, freewheels that hold too."""
        return self.gear.engaged

    @property
    def holding(self) -> list[int]:
        """Numbers of the freewheels that hold."""
        return [number for number in self.case.freewheels if number in self.gear.engaged]

    @property
    def speeds(self) -> list[Number]:
        """Of each link [-], planets that are links too."""
        return self.ideal.speeds.links

    @property
    def relative_speeds(self) -> list[Number]:
        """Of each mechanism: ``w_f - w_h`` [-]."""
        return self.ideal.speeds.relative_speeds

    @property
    def slip_speeds(self) -> list[Number]:
        """Of each shift element: first link against second [-]."""
        return self.ideal.speeds.slips

    @property
    def output_speed(self) -> Number:
        """Of the gear's output link [-]."""
        return self.speeds[self.case.gear_output(self.gear) - 1]

    @property
    def ratio(self) -> Number:
        """``w_input/w_output`` [-]; NaN where the output stands."""
        return math.nan if self.output_speed == 0 else 1 / self.output_speed

    @property
    def drag(self) -> Drag:
        """Of links and open elements."""
        return self.ideal.drag

    @property
    def torques(self) -> Torques:
        """Without losses and drag."""
        return self.ideal.torques

    @property
    def lossy_torques(self) -> Torques:
        """With losses and drag."""
        return self.search.lossy.torques

    @property
    def signs(self) -> Signs:
        """By mechanism: +1 the first link drives, -1 it is driven, 0 idle, NaN open."""
        return self.search.lossy.signs

    @property
    def lossy_ratios(self) -> list[Number]:
        """Of each mechanism: ``u * efficiency**x`` [-]."""
        return lossy_ratios(self.ideal.variant.ratios, self.ideal.variant.efficiencies, self.signs)

    @property
    def mechanism_losses(self) -> Sequence[Number]:
        """Power lost in each mechanism [-]."""
        return self.search.lossy.losses

    @property
    def tied_up(self) -> bool:
        """The conditions for the speeds contradict each other."""
        return not self.ideal.speeds.consistent

    @property
    def balanced(self) -> bool:
        """Torques without losses exist."""
        return self.ideal.torques.consistent

    @property
    def calculable(self) -> bool:
        """Speeds and torques exist, so that losses can be asked for."""
        return self.balanced and not self.tied_up and not self.conflict

    @property
    def consistent(self) -> bool:
        """The torques with losses stand, with signs that agree with their flow."""
        return bool(self.search.lossy.admissible)

    @property
    def statuses(self) -> list[Status]:
        """All that is to be said of the gear as a whole, what explains the others first."""
        return statuses(
            tied_up=self.tied_up,
            conflict=self.conflict,
            output_speed=self.output_speed,
            balanced=self.balanced,
            locked=self.search.locked,
            undecided=self.search.undecided,
        )

    @property
    def status(self) -> Status:
        """The first of `statuses`; `OK` if there is none."""
        return next(iter(self.statuses), OK)

    @property
    def bodies(self) -> Bodies:
        """Which links turn as one piece: for each the least of them, the housing first."""
        return turning_as_one(self.case, self.gear, self.speeds)

    def powers(self, *, lossy: bool = True) -> list[LinkPower]:
        """What links give to devices, to ports and to what drags, in its real direction [-].

        Those of devices come first, then those of ports and of drag.
        """
        torques = self.lossy_torques if lossy else self.torques
        drag = self.drag if lossy else NO_DRAG
        members = [
            {name: plain(torque) for name, torque in members.items()}
            for members in self.member_torques(lossy=lossy)
        ]
        given = (self.case, self.gear, self.speeds, torques)
        return [
            one._replace(power=self.ideal.variant.direction * plain(one.power))
            for one in (
                *device_powers(*given, members=members, drag=drag),
                *port_powers(*given),
                *drag_powers(self.case, self.speeds, drag),
            )
        ]

    def member_torques(self, *, lossy: bool) -> list[dict[str, Number | Rest]]:
        """Torques that links give to the members of each mechanism or drawn element [-].

        A sum may be determined where its parts are not.
        """
        ratios = self.ideal.variant.ratios
        if lossy:
            factors = lossy_ratios([1.0] * len(ratios), self.ideal.variant.efficiencies, self.signs)
            ratios = [u * factor for u, factor in zip(ratios, factors, strict=True)]
        torques = self.lossy_torques if lossy else self.torques
        shares_of = list(map(column, ratios))
        elements = len(self.case.shift_elements)
        found: list[dict[str, Number | Rest]] = []
        unknown: list[tuple[int, str, dict[int, Number]]] = []
        for place, device in enumerate(self.case.own_devices):
            found.append({})
            for member in device.members:
                shares = _shares(member, shares_of, elements)
                torque = rest([share * torques.on_first_link[index] for index, share in shares])
                found[place][member.name] = torque
                if isinstance(torque, float) and math.isnan(torque):
                    unknown.append((place, member.name, dict(shares)))
        exists = self.consistent if lossy else self.calculable
        if unknown and exists and all(ratio == ratio for ratio in ratios):  # noqa: PLR0124
            sums = [shares for _, _, shares in unknown]
            drag = self.drag if lossy else NO_DRAG
            values = solve_sums(self.case, self.gear, columns(self.case, ratios), sums, drag)
            for (place, name, _), value in zip(unknown, values, strict=True):
                found[place][name] = value
        return found


def _shares(
    member: Member, columns: Sequence[Sequence[Number]], elements: int
) -> list[tuple[int, Number]]:
    """Indices of devices, each with the share that a member has of its torque."""
    return [(elements + index, columns[index][place]) for index, place in member.places]
