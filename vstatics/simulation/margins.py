"""How far everything is from changing its state: a margin for each, below 0 where it must."""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.equations import Equations
from vstatics.simulation.laws import Points
from vstatics.simulation.ports import capacity_at, programme_at
from vstatics.simulation.split import least, widest
from vstatics.simulation.system import Contact

Watched = Literal["slip", "hold", "split", "mesh", "flow", "cone", "limit", "grip", "piece"]
"""A slip that may end; what sticks may slip, alone or together; a mesh may stand still, its flow
turn, or it may begin to move; a spring may reach its limit, or grip again; points over a speed may
have a corner; a capacity may lie above that of the case, or below 0."""


class Watch(NamedTuple):
    """What a margin is of."""

    kind: Watched
    of: int
    """Of the contact, mesh, spring or outside torque."""
    side: int = 1
    """The side on which it changes: the sign of the torque, or of the step to another piece."""


class LargeSizes(NamedTuple):
    """What is large here."""

    speed: float
    """[rad/s]"""
    torque: float
    """[N*m]"""


class Margins:
    """The margins of equations; torques in N*m, speeds in rad/s."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        system, states = equations.system, equations.states
        layout, structure = equations.layout, equations.structure
        self.watches: list[Watch] = []
        self.is_torque: list[bool] = []
        place = {(one.kind, one.of): row for row, one in enumerate(structure.multipliers)}
        self.slipping: list[tuple[int, float]] = []
        self.holding: list[tuple[Contact, int, int]] = []
        """Contact, its multiplier, and the side: +1 its upper limit, -1 its lower one."""
        for index, state in enumerate(states.contacts):
            if state in ("+", "-"):
                self.slipping.append((layout.contacts + index, 1.0 if state == "+" else -1.0))
                self._watch("slip", index, torque=False)
        for index, (contact, state) in enumerate(
            zip(system.contacts, states.contacts, strict=True)
        ):
            if state == "stick":
                for side in (1, -1):
                    if (side == 1 and contact.one_way) or math.isfinite(
                        capacity_at(contact, equations.time)
                    ):
                        self.holding.append((contact, place["contact", index], side))
                        self._watch("hold", index, side)
        self._meshes(place)
        self._springs()
        self._pieces()
        self.held_rows = np.array([row for _, row, _ in self.holding], dtype=int)
        self.sides = np.array([side for _, _, side in self.holding], dtype=float)
        self.shared = structure.redundant.shape[1] > 0 and bool(self.holding or self.cones)
        if self.shared:
            self._watch("split", -1)
        self.groups = self._constant_limits()

    def _watch(self, kind: Watched, index: int, side: int = 1, *, torque: bool = True) -> None:
        self.watches.append(Watch(kind, index, side))
        self.is_torque.append(torque)

    def _meshes(self, place: dict[tuple[str, int], int]) -> None:
        system, states = self.equations.system, self.equations.states
        self.moving: list[tuple[int, float, float]] = []
        self.cones: list[tuple[int, int, float, float]] = []
        for index, state in enumerate(states.meshes):
            if state not in ("", "stick"):
                speed, torque = (1.0 if sign == "+" else -1.0 for sign in state)
                self.moving.append((index, speed, torque))
                self._watch("mesh", index, torque=False)
                self._watch("flow", index)
        for index, (mesh, state) in enumerate(zip(system.meshes, states.meshes, strict=True)):
            if state == "stick":
                rows = place["mesh", index], place["friction", index]
                self.cones.append((*rows, 1 - mesh.efficiency, 1 / mesh.back - 1))
                self._watch("cone", index, 1)
                self._watch("cone", index, -1)

    def _springs(self) -> None:
        system, states = self.equations.system, self.equations.states
        self.bending: list[int] = []
        self.gripping: list[tuple[int, float]] = []
        for index, (spring, state) in enumerate(zip(system.springs, states.springs, strict=True)):
            if state == "stick" and math.isfinite(programme_at(spring.limit, self.equations.time)):
                self.bending.append(index)
                self._watch("limit", index)
        for index, (spring, state) in enumerate(zip(system.springs, states.springs, strict=True)):
            if state in ("+", "-"):
                self.gripping.append((index, 1.0 if state == "+" else -1.0))
                self._watch("grip", index, torque=spring.viscous > 0)

    def _pieces(self) -> None:
        """Corners of points over a speed or an angle."""
        equations = self.equations
        self.corners: list[tuple[int, bool, float, float]] = []
        for index, one in enumerate(equations.system.outside):
            law = one.law
            if not isinstance(law, Points) or law.over == "time":
                continue
            piece = equations.states.pieces[index]
            by_angle = law.over == "angle"
            port = equations.layout.angles.index(one.link) if by_angle else index
            if piece > 0:
                self.corners.append((port, by_angle, law.x[piece - 1], 1.0))
                self._watch("piece", index, -1, torque=False)
            if piece < len(law.x):
                self.corners.append((port, by_angle, law.x[piece], -1.0))
                self._watch("piece", index, 1, torque=False)

    def _constant_limits(self) -> Floats | None:
        """Limits of what sticks as ``c0 + c1 t``; None where one is a formula."""
        time = self.equations.time
        lines = []
        for contact, _, side in self.holding:
            curve = contact.programme.curve
            if not isinstance(curve, Points):
                return None
            value, slope = curve.piece(curve.piece_at(time))
            if contact.one_way and side == 1:
                lines.append((0.0, 0.0))
                continue
            factor = contact.static * contact.programme.factor
            if contact.friction is not None:
                factor *= contact.friction.coefficient[0][1]
            lines.append((factor * value, factor * slope))
        return np.array(lines).reshape(len(lines), 2)

    def limits(self, time: float) -> Floats:
        """Limits of what sticks at a time [N*m]."""
        if self.groups is not None:
            return self.groups[:, 0] + self.groups[:, 1] * time
        return np.array(
            [
                0.0
                if contact.one_way and side == 1
                else contact.static * capacity_at(contact, time)
                for contact, _, side in self.holding
            ]
        )

    def units(self, scales: LargeSizes) -> Floats:
        """What is large beside each margin."""
        return np.where(self.is_torque, scales.torque, scales.speed)

    def at(self, time: float, state: Floats) -> Floats:
        """All margins."""
        equations = self.equations
        rates, _ = equations.rates(time, state)
        torques = equations.torques(time, state, rates)
        made = [sign * rates[port] for port, sign in self.slipping]
        held = equations.multipliers(torques)
        slack = self._slack(time, held)
        mine = len(self.holding)
        shown = np.full(len(slack), np.inf) if self.shared else slack
        made += list(shown[:mine])
        if self.moving:
            links = equations.speeds(time, state)
            for index, speed, torque in self.moving:
                made += [
                    speed * float(equations.system.meshes[index].slip @ links),
                    torque * held[index],
                ]
        made += list(shown[mine:])
        made += self._of_springs(time, state, rates, torques)
        for port, by_angle, corner, side in self.corners:
            at = state[equations.angles][port] if by_angle else rates[port]
            made.append(side * (at - corner))
        if self.shared:
            made.append(self._together(slack, held))
        return np.array(made)

    def _slack(self, time: float, held: Floats) -> Floats:
        """Of contacts that stick, then of meshes."""
        slack = self.limits(time) - self.sides * held[self.held_rows] if self.holding else _NONE
        if not self.cones:
            return slack
        cones = []
        for mesh, friction, less, more in self.cones:
            torque, taken = held[mesh], held[friction]
            sign = 1.0 if torque >= 0 else -1.0
            cones += [sign * (taken + less * torque), sign * (more * torque - taken)]
        return np.concatenate([slack, cones])

    def _directions(self, held: Floats) -> Floats:
        """Changes of the slacks along redundant directions."""
        redundant = self.equations.structure.redundant
        rows = [-side * redundant[row] for _, row, side in self.holding]
        for mesh, friction, less, more in self.cones:
            sign = 1.0 if held[mesh] >= 0 else -1.0
            rows.append(sign * (redundant[friction] + less * redundant[mesh]))
            rows.append(sign * (more * redundant[mesh] - redundant[friction]))
        return np.array(rows).reshape(len(rows), redundant.shape[1])

    def _together(self, slack: Floats, held: Floats) -> float:
        smallest = float(slack.min())
        if smallest >= 0:
            return smallest
        return widest(slack, self._directions(held))

    def split(self, time: float, held: Floats) -> tuple[Floats, bool]:
        """Torques of what holds, those of least norm within the limits; whether it is a choice."""
        if not self.shared:
            return held, False
        slack = self._slack(time, held)
        change = least(slack, self._directions(held))
        if change is None:
            return held, True
        return held + self.equations.structure.redundant @ change, True

    def _of_springs(
        self, time: float, state: Floats, rates: Floats, torques: Floats
    ) -> list[float]:
        equations = self.equations
        first = equations.layout.springs
        made = []
        for index in self.bending:
            limit = programme_at(equations.system.springs[index].limit, time)
            made.append(limit - abs(float(torques[first + index])))
        if self.gripping:
            slopes = equations.limit_slopes(time, rates, state)
        for index, sign in self.gripping:
            spring = equations.system.springs[index]
            rate = float(rates[first + index])
            if spring.viscous:
                trial = spring.stiffness * float(state[equations.twists][index])
                trial += spring.viscous * rate
                made.append(sign * trial - programme_at(spring.limit, time))
            else:
                made.append(sign * (rate - float(slopes[index]) / spring.stiffness))
        return made


_NONE = np.zeros(0)
