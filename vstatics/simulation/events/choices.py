"""States of contacts, mechanisms and springs at an instant: fixed, or open with options."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import repeat

from vstatics.core.model.converters import Converter
from vstatics.simulation.events.instants import Instant, seen_at, sliding_speed
from vstatics.simulation.events.margins import LargeSizes
from vstatics.simulation.events.search import Choice
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.system.curves import programme_at
from vstatics.simulation.system.matrices import (
    SIGNS,
    Contact,
    MotionSystem,
    OutsideTorque,
    sign,
)
from vstatics.simulation.system.ports import States
from vstatics.simulation.system.structure import MotionStructure, moves
from vstatics.simulation.tolerances import AHEAD, STANDING


class ModeChoices:
    """Builder of the states that are fixed at an instant, and of the choices where several fit.

    Parameters
    ----------
    system : MotionSystem
    loose : MotionStructure
        Matrices of the motion while nothing sticks.
    """

    def __init__(self, system: MotionSystem, loose: MotionStructure) -> None:
        self.system, self.layout = system, system.layout
        rows, slips = system.port_rows, system.rows(mesh.slip for mesh in system.meshes)
        self.touched = moves(rows[self.layout.contacts : self.layout.springs], loose.light)
        """Flags of contacts whose slip can jump, because it depends on links without inertia."""
        self.idle = ~moves(slips, loose.free, loose.light)
        """Flags of mechanisms whose links always rotate as a block, so that they have no losses."""
        self.carried = moves(slips, loose.light)
        """Flags of mechanisms whose slip can jump, because it depends on links without inertia."""
        self.leaping = moves(rows[: self.layout.outside], loose.light)
        """Flags of external torques on links whose speeds can jump."""
        self.frictions = range(self.layout.frictions, self.layout.curves)
        """Indices of the linear pieces of friction over slip, which no choice contains."""
        self.within = AHEAD * system.scenario.span
        """Length of the look-ahead, the time after which margins are compared with now. [s]"""
        self.carrying: dict[int, bool] = {}
        """True if feedback control lets a shift element carry torque now, by element index."""

    def at(
        self,
        at: Instant,
        before: States | None,
        scales: LargeSizes,
        met: Sequence[int] = (),
    ) -> tuple[States, list[Choice]]:
        """Return the states fixed by speeds and capacities, and the open choices."""
        choices: list[Choice] = []
        system = self.system
        self.seen = seen_at(system, at)
        contacts = [
            "rigid"
            if contact.is_given or contact.is_variator
            else self._switch(index, at, scales, choices, met=index in met)
            if contact.switch
            else self._contact(index, at, scales, choices, met=index in met)
            for index, contact in enumerate(system.contacts)
        ]
        meshes = [
            self._mesh(index, at, before, scales, choices) for index in range(len(system.meshes))
        ]
        springs = [self._spring(index, at, scales, choices) for index in range(len(system.springs))]
        layout = self.layout
        last = before.pieces if before else [None] * (layout.curves + len(springs))
        corners = [spring.curve.corners for spring in system.springs]
        pieces = [
            *map(self._piece, repeat(at), system.outside, last),
            *map(_converter_piece, repeat(at), system.converters, last[layout.outside :]),
            *map(_friction_piece, repeat(at), system.contacts, last[layout.frictions :]),
            *map(_piece_at, at.twists.tolist(), corners, last[layout.curves :]),
        ]
        choices += self._leaps(pieces)
        return States(tuple(contacts), tuple(meshes), tuple(springs), tuple(pieces)), choices

    def _leaps(self, pieces: Sequence[int]) -> Iterator[Choice]:
        """Yield choices among the linear pieces of a speed-dependent law if the speed can jump."""
        for index, (load, leaping) in enumerate(
            zip(self.system.outside, self.leaping, strict=True)
        ):
            law = load.law
            if leaping and isinstance(law, Points) and law.over == "speed" and law.x[1:]:
                now = pieces[index]
                others = sorted(range(len(law.x) + 1), key=lambda piece: abs(piece - now))
                yield "pieces", index, tuple(others)

    def _contact(
        self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice], *, met: bool
    ) -> str:
        contact = self.system.contacts[index]
        now = math.nextafter(at.time, math.inf)
        times = now, at.time + self.within
        capacity = programme_at(contact.programme, now, self.seen)
        if capacity == 0:  # a capacity can begin to rise from 0 now
            capacity = programme_at(contact.programme, times[1], self.seen)
        if contact.while_open is not None:
            programme = self.system.by_element[contact.while_open].programme
            carries = any(programme_at(programme, time, self.seen) for time in times)
            if self.carrying.get(contact.while_open, carries):
                return "open"
        may_rise = contact.one_way or contact.programme.look is not None
        if capacity == 0 and not may_rise:
            return "open"
        if not contact.row.any():
            return "rigid"
        if math.isinf(capacity) and not contact.one_way:
            return "rigid"
        slip = float(contact.row @ at.speeds)
        if abs(slip) > STANDING * scales.speed and not (met or self.touched[index]):
            return sign(slip)
        signs: tuple[str, ...] = ("+", "-") if slip > 0 or contact.one_way else ("-", "+")
        if contact.one_way and math.isinf(capacity):
            signs = ("+",)
        choices.append(("contacts", index, ("stick", *signs)))
        return "stick"

    def _switch(
        self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice], *, met: bool
    ) -> str:
        """Return "stick" at a torque jump, with a choice added, else the side of the motion."""
        switch = self.system.contacts[index].switch
        assert switch is not None  # noqa: S101 - it is asked of these alone
        over, curve, side, _ = switch.jump
        near = STANDING * scales.speed
        apart = slides = float(at.speeds[switch.link]) - sliding_speed(self.system, index, at)
        if over == "angle":
            place = curve.at(math.nextafter(at.time, math.inf))
            apart = float(at.angles[self.layout.angles.index(switch.link)]) - place
            moves, near = abs(slides) > near, STANDING * max(1.0, abs(place))
            if moves and (met or abs(apart) <= near):
                return sign(slides)  # the motion crosses the jump and does not stick
        if abs(apart) > near and not (met or (over == "speed" and self.touched[index])):
            return sign(apart)
        choices.append(("contacts", index, ("stick", side, "-" if side == "+" else "+")))
        return "stick"

    def _mesh(
        self,
        index: int,
        at: Instant,
        before: States | None,
        scales: LargeSizes,
        choices: list[Choice],
    ) -> str:
        mesh = self.system.meshes[index]
        if mesh.lossless or self.idle[index]:
            return ""
        speed = float(mesh.slip @ at.speeds)
        last = before.meshes[index] if before else ""
        torque = last[1] if last not in ("", "stick") else "+"
        if abs(speed) > STANDING * scales.speed and not self.carried[index]:
            return sign(speed) + torque
        signs = ("-", "+") if speed < 0 else ("+", "-")
        choices.append(("meshes", index, ("stick", *(direction + torque for direction in signs))))
        return "stick"

    def _spring(self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice]) -> str:
        spring = self.system.springs[index]
        if spring.can_part:  # a spring with play has no torque limit
            choices.append(("springs", index, ("stick", "parted")))
            return "stick"
        limit = programme_at(spring.programme, math.nextafter(at.time, math.inf), self.seen)
        if math.isinf(limit):
            return "stick"
        later = programme_at(spring.programme, at.time + self.within, self.seen)
        if limit == later == 0 and spring.programme.look is None:
            return "open"
        torque = spring.curve.at(float(at.twists[index]))
        if spring.viscous:
            choices.append(("springs", index, ("stick", "+", "-")))
        else:  # if the limit is nearly 0, both limits are reached
            reached = limit - STANDING * scales.torque
            slipping = [side for side in ("+", "-") if SIGNS[side] * torque >= reached]
            if slipping:
                choices.append(("springs", index, ("stick", *slipping)))
        return "stick"

    def _piece(self, at: Instant, load: OutsideTorque, last: int | None) -> int:
        """Return the index of the active linear piece of a law over speed or angle."""
        law = load.law
        if not isinstance(law, Points) or law.over == "time":
            return 0
        if law.over == "speed":
            return _piece_at(float(at.speeds[load.link]), law.x, last)
        return _piece_at(float(at.angles[self.layout.angles.index(load.link)]), law.x, last)


def _converter_piece(at: Instant, converter: Converter, last: int | None) -> int:
    pump, turbine = (float(at.speeds[link - 1]) for link in converter[1:3])
    ratios = [ratio for ratio, _, _ in converter.points]
    if abs(pump) <= STANDING * abs(turbine) or max(abs(pump), abs(turbine)) <= STANDING:
        # Without input speed there is no speed ratio, so the search tries all pieces.
        # If the turbine is at rest as well, the speed ratio begins at 0.
        first = math.inf if abs(turbine) > STANDING else 0.0
        return bisect_right(ratios, first) if last is None else last
    return _piece_at(turbine / pump, ratios, last)


def _friction_piece(at: Instant, contact: Contact, last: int | None) -> int:
    return _piece_at(abs(float(contact.row @ at.speeds)), contact.corners, last)


def _piece_at(value: float, corners: Sequence[float], last: int | None) -> int:
    """Return the index of the linear piece at a value; at a corner, prefer the piece `last`."""
    if last is not None:
        near, ends = STANDING * max(1.0, abs(value)), (-math.inf, *corners, math.inf)
        if ends[last] - near <= value <= ends[last + 1] + near:
            return last
    return bisect_right(corners, value)
