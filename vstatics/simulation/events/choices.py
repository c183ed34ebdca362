"""What speeds and capacities fix of an instant, and what may stick or slip there."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vstatics.simulation.events.instants import STANDING, Instant
from vstatics.simulation.events.margins import LargeSizes
from vstatics.simulation.events.search import Choice
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.system.curves import capacity_at, programme_at
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.ports import PortLayout, States, converter_piece
from vstatics.simulation.system.structure import Structures


class ModeChoices:
    """The choices of a system.

    Parameters
    ----------
    system : MotionSystem
    layout : PortLayout
    structures : Structures
    """

    def __init__(self, system: MotionSystem, layout: PortLayout, structures: Structures) -> None:
        self.system, self.layout = system, layout
        loose = structures.of(
            (False,) * len(system.contacts),
            tuple("" for _ in system.meshes),
        )
        rows = np.array([one.row for one in system.contacts]).reshape(-1, len(system.names))
        touched = np.abs(rows @ loose.light) if loose.light.size else np.zeros((len(rows), 1))
        self.touched = touched.max(axis=1, initial=0.0) > STANDING
        """Contacts whose slip can jump, since something without inertia moves along."""
        motions = np.hstack([loose.free, loose.light])
        self.idle = [not (np.abs(mesh.slip @ motions) > STANDING).any() for mesh in system.meshes]
        """Mechanisms whose links always turn as one: nothing is lost there, as in statics."""
        self.carried = [
            bool((np.abs(mesh.slip @ loose.light) > STANDING).any()) for mesh in system.meshes
        ]
        """Mechanisms whose speeds can jump in the same way."""
        self.within = 1e-7 * system.scenario.duration
        """How far it is looked ahead. [s]"""

    def at(
        self,
        at: Instant,
        before: States | None,
        scales: LargeSizes,
        met: Sequence[int] = (),
    ) -> tuple[States, list[Choice]]:
        """What is fixed by speeds and capacities, and what has a choice."""
        choices: list[Choice] = []
        contacts = [
            self._contact(index, at, scales, choices, met=index in met)
            for index in range(len(self.touched))
        ]
        meshes = [
            self._mesh(index, at, before, scales, choices)
            for index in range(len(self.system.meshes))
        ]
        springs = [
            self._spring(index, at, scales, choices) for index in range(len(self.system.springs))
        ]
        pieces = tuple(self._piece(index, at, before) for index in range(len(self.system.outside)))
        pieces += tuple(
            self._converter_piece(index, at, before) for index in range(self.layout.converters)
        )
        return States(tuple(contacts), tuple(meshes), tuple(springs), pieces), choices

    def _contact(
        self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice], *, met: bool
    ) -> str:
        contact = self.system.contacts[index]
        slip = float(contact.row @ at.speeds)
        now = math.nextafter(at.time, math.inf)
        capacity = capacity_at(contact, now, slip)
        if capacity == 0:  # it may begin to rise here
            capacity = capacity_at(contact, at.time + self.within, slip)
        if contact.while_open is not None:
            times = now, at.time + self.within
            if any(self._programme_of(contact.while_open, time) for time in times):
                return "open"
        if capacity == 0 and not contact.one_way:
            return "open"
        if not contact.row.any():
            return "rigid"
        if math.isinf(capacity) and not contact.one_way:
            return "rigid"
        sign = "+" if slip > 0 else "-"
        if abs(slip) > STANDING * scales.speed and not (met or self.touched[index]):
            return sign
        if contact.one_way:
            states = ("stick", "+") if math.isinf(capacity) else ("stick", "+", "-")
        else:
            states = ("stick", "+", "-") if sign == "+" else ("stick", "-", "+")
        choices.append(("contact", index, states))
        return "stick"

    def _programme_of(self, element: int, time: float) -> float:
        """Capacity of a shift element, wherever it stands."""
        for contact in self.system.contacts:
            if contact.element == element:
                return programme_at(contact.programme, time)
        for spring in self.system.springs:
            if spring.element == element:
                return programme_at(spring.limit, time)
        return 0.0

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
            return ("+" if speed > 0 else "-") + torque
        signs = ("-", "+") if speed < 0 else ("+", "-")
        choices.append(("mesh", index, ("stick", *(sign + torque for sign in signs))))
        return "stick"

    def _spring(self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice]) -> str:
        spring = self.system.springs[index]
        limit = programme_at(spring.limit, math.nextafter(at.time, math.inf))
        if math.isinf(limit):
            return "stick"
        if limit == 0 == programme_at(spring.limit, at.time + self.within):
            return "open"
        torque = spring.stiffness * float(at.twists[index])
        near = limit - STANDING * scales.torque
        if spring.viscous:
            choices.append(("spring", index, ("stick", "+", "-")))
        elif abs(torque) >= near:
            choices.append(("spring", index, ("stick", "+" if torque > 0 else "-")))
        return "stick"

    def _piece(self, index: int, at: Instant, before: States | None) -> int:
        """The piece of points over a speed or an angle; at a corner it may be either side's."""
        one = self.system.outside[index]
        law = one.law
        if not isinstance(law, Points) or law.over == "time":
            return 0
        if law.over == "speed":
            value = float(at.speeds[one.link])
        else:
            value = float(at.angles[self.layout.angles.index(one.link)])
        piece = law.piece_at(value)
        if before is not None:
            last = before.pieces[index]
            low = -math.inf if last == 0 else law.x[last - 1]
            high = math.inf if last == len(law.x) else law.x[last]
            small = STANDING * max(1.0, abs(value))
            if low - small <= value <= high + small:
                return last
        return piece

    def _converter_piece(self, index: int, at: Instant, before: States | None) -> int:
        """The piece of the points of a converter; at a corner it may be either side's."""
        converter = self.system.converters[index]
        pump, turbine = (float(at.speeds[link - 1]) for link in converter[1:3])
        last = None if before is None else before.pieces[self.layout.outside + index]
        if pump == 0 or max(abs(pump), abs(turbine)) <= STANDING:
            # no ratio; what follows tells, piece by piece
            return len(converter.points) if last is None else last
        ratio = turbine / pump
        if last is not None:
            ratios = [-math.inf, *(point[0] for point in converter.points), math.inf]
            if ratios[last] - STANDING <= ratio <= ratios[last + 1] + STANDING:
                return last
        return converter_piece(converter, ratio)
