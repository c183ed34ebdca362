"""How far everything is from changing its state: a margin for each, below 0 where it must."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, largest
from vstatics.simulation.events.split import least, widest
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.scenario.programme import friction_at
from vstatics.simulation.system.curves import curve_along, programme_along, programme_at
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, Contact, Elastic
from vstatics.simulation.system.sight import Compared
from vstatics.simulation.tolerances import (
    EQUAL_SIDES,
    EXACT_SIDES,
    NO_MARGIN,
    NOT_ZERO,
    PASSED_LIMIT,
    SHARED_TORQUE,
    TIGHT_SLACK,
)

Watched = Literal[
    "slip",
    "hold",
    "split",
    "mesh",
    "flow",
    "cone",
    "limit",
    "grip",
    "piece",
    "state",
    "awaited",
    "corner",
]
"""A slip that may end; what sticks may slip, alone or together; a mesh may stand still, its flow
turn, or it may begin to move; a spring may reach its limit, or grip again; points over a speed may
have a corner; a state may reach its limit, or leave it; what a step waits for may become true; a
formula may bend."""


FOLLOWING: tuple[Watched, ...] = ("state", "awaited", "corner")
"""What follows from the states of what sticks and slips, and decides nothing of them."""


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


class SplitRoom(NamedTuple):
    """The room that limits leave to redundant torques."""

    slack: Floats
    directions: Floats
    """Changes of the slacks along the redundant directions."""
    ways: Floats
    """Of each slack, -1 where that of a mesh is on the other side than by the least norm."""
    widest: Floats
    """The slacks of the split that leaves most room."""

    def is_of(self, slack: Floats, directions: Floats) -> bool:
        """Whether it was found from these."""
        given = self.slack * self.ways, self.directions * self.ways[:, None]
        return np.array_equal(given[0], slack) and np.array_equal(given[1], directions)

    @property
    def room(self) -> float:
        """The largest least slack [N*m]."""
        return float(self.widest.min())

    @property
    def tight(self) -> Booleans:
        """What is at its limit in the split that leaves most room."""
        found: Booleans = self.widest <= self.room + TIGHT_SLACK * largest(self.slack)
        return found

    def on_other_side(self, rows: slice) -> SplitRoom:
        """The same with the torque of a mesh on its other side."""
        slack, directions, ways = (one.copy() for one in self[:3])
        for one in (slack, directions, ways):
            one[rows] *= -1
        return SplitRoom(slack, directions, ways, widest(slack, directions))


class Awaited(NamedTuple):
    """A comparison that a step waits for, or at which a formula bends, and its side."""

    compared: Compared
    side: str
    """`+`, `-`, `0` where it stays there, or `?` of what is no number."""
    size: float
    """Of what is compared, at the instant from which on it is watched."""
    is_equal: bool
    """Whether both are equal at that instant, wherever they move."""
    change: float
    """Of their difference, while it is looked ahead."""


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
            if state in SIGNS:
                self.slipping.append((layout.contacts + index, SIGNS[state]))
                self._watch("slip", index, torque=False)
        for index, (contact, state) in enumerate(
            zip(system.contacts, states.contacts, strict=True)
        ):
            if state == "stick":
                own = contact.switch.jump.side if contact.switch else "+"
                for side in (1, -1) if own == "+" else (-1, 1):
                    if (side == 1 and contact.one_way) or _is_limited(contact, equations.time):
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
        self.last_room: SplitRoom | None = None
        """Found last: what is tight is asked after how far it is from its limit."""
        self.straight_limits = self._straight_limits()
        self.sees = any(one.programme.look is not None for one in system.may_slip)
        """Whether a limit is that of a control which sees something."""
        self.slip_ports = np.array([port for port, _ in self.slipping], dtype=int)
        self.slip_signs = np.array([sign for _, sign in self.slipping])
        contacts = [system.contacts[port - layout.contacts] for port, _ in self.slipping]
        self.switches = [(row, one.switch) for row, one in enumerate(contacts) if one.switch]
        """Rows of slips that are those from a jump, with their jumps."""
        self.jumping = [row for row, one in enumerate(self.holding) if one[0].switch][::2]
        """First of the two limits of each contact at a jump."""
        self.by_torques = self._limits_by_torques() if self.jumping else None
        self.deciding = len(self.watches)
        """So many tell whether a choice is admissible; the others follow it."""
        self._states()
        self.sequences: list[Awaited] = []

    def follow(self, kind: Watched, compared: Iterable[tuple[int, Awaited]]) -> None:
        """Watch what steps of sequences wait for, or corners of formulas, each with a number."""
        for number, one in compared:
            self._watch(kind, number, torque=False)
            self.sequences.append(one)

    def _states(self) -> None:
        """Limits of states: of one that is free both, of one that is held when it leaves."""
        self.limits_of_states: list[tuple[int, int, float]] = []
        held = self.equations.changes.held.tolist()
        for index, one in enumerate(self.equations.system.scenario.states):
            for side, limit in ((1, one.most), (-1, one.least)):
                if math.isfinite(limit) and held[index] in (0, side):
                    self.limits_of_states.append((index, side, limit))
                    self._watch("state", index, side, torque=False)

    def _watch(self, kind: Watched, index: int, side: int = 1, *, torque: bool = True) -> None:
        self.watches.append(Watch(kind, index, side))
        self.is_torque.append(torque)

    def _meshes(self, place: dict[tuple[str, int], int]) -> None:
        system, states = self.equations.system, self.equations.states
        self.moving: list[tuple[int, float, float]] = []
        self.cones: list[tuple[int, int, float, float]] = []
        for index, state in enumerate(states.meshes):
            if state not in ("", "stick"):
                speed, torque = (SIGNS[sign] for sign in state)
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
            if state == "stick" and _is_limited(spring, self.equations.time):
                self.bending.append(index)
                self._watch("limit", index)
        for index, (spring, state) in enumerate(zip(system.springs, states.springs, strict=True)):
            if state in SIGNS:
                self.gripping.append((index, SIGNS[state]))
                self._watch("grip", index, torque=spring.viscous > 0)
        self.touching: list[tuple[int, float]] = []
        """Springs beside their play, by index, and the sign of the torque of spring and damper
        together, which is that of the spring in contact and the other one where they part."""
        for index, (spring, state) in enumerate(zip(system.springs, states.springs, strict=True)):
            side = spring.side(self._piece(index)) if spring.can_part else 0.0
            if side:
                self.touching.append((index, side if state == "stick" else -side))
                self._watch("limit" if state == "stick" else "grip", index)

    def _piece(self, spring: int) -> int:
        """The piece of its points on which a spring is, by its index."""
        return self.equations.states.pieces[self.equations.layout.curves + spring]

    def _pieces(self) -> None:
        """Corners of points over a speed, an angle or a twist."""
        equations = self.equations
        self.corners: list[tuple[int, bool, float, float]] = []
        """Its row among rates, or in the state, the place of the corner, the side."""
        for index, one in enumerate(equations.system.outside):
            law = one.law
            if not isinstance(law, Points) or law.over == "time":
                continue
            if not one.acts(equations.states.contacts):
                continue
            by_angle = law.over == "angle"
            row = self._row_of_angle(one.link) if by_angle else index
            for corner, side in self._ends(index, law.x):
                self.corners.append((row, by_angle, corner, side))
        self._frictions()
        for index, spring in enumerate(equations.system.springs):
            row, at = equations.twists.start + index, equations.layout.curves + index
            for corner, side in self._ends(at, spring.curve.corners, torque=True):
                self.corners.append((row, True, corner, side * spring.stiffness))
        self.ratios: list[tuple[int, float, float]] = []
        """Converter, ratio of speeds at a corner, side."""
        for place, converter in enumerate(equations.system.converters):
            ratios = [ratio for ratio, _, _ in converter.points]
            for corner, side in self._ends(equations.layout.outside + place, ratios):
                self.ratios.append((place, corner, side))

    def _row_of_angle(self, link: int) -> int:
        """In a state, of a link by its index."""
        return int(self.equations.angles.start) + self.equations.layout.angles.index(link)

    def _frictions(self) -> None:
        """Corners of the friction of what slips."""
        equations = self.equations
        contacts = zip(equations.system.contacts, equations.states.contacts, strict=True)
        for index, (contact, state) in enumerate(contacts):
            if state not in SIGNS:
                continue
            way, port = SIGNS[state], equations.layout.contacts + index
            for corner, side in self._ends(equations.layout.frictions + index, contact.corners):
                self.corners.append((port, False, way * corner, way * side))

    def _ends(
        self, index: int, corners: Sequence[float], *, torque: bool = False
    ) -> Iterator[tuple[float, float]]:
        """The corners between which a law is, and on which side of each."""
        piece = self.equations.states.pieces[index]
        for place, step in ((piece - 1, -1), (piece, 1)):
            if 0 <= place < len(corners):
                self._watch("piece", index, step, torque=torque)
                yield corners[place], float(-step)

    def _straight_limits(self) -> Floats | None:
        """Limits of what sticks as ``c0 + c1 t``; None where one is a formula."""
        time = self.equations.time
        lines = []
        for contact, _, side in self.holding:
            curve = contact.programme.curve
            if contact.programme.look is not None or not isinstance(curve, Points):
                return None
            value, slope = curve.piece(curve.piece_at(time))
            if contact.one_way and side == 1:
                lines.append((contact.overrun_drag, 0.0))
                continue
            factor = contact.static * contact.programme.factor * friction_at(contact.friction)
            lines.append((factor * value, factor * slope))
        return np.array(lines).reshape(len(lines), 2)

    def _limits_by_torques(self) -> Floats:
        """Of contacts at jumps: the torques on both sides, between which theirs is.

        While one sticks both sides act, so it takes what is too much of their sum.
        """
        outside = self.equations.system.outside
        made = np.zeros((len(self.holding), self.equations.layout.ports))
        sticking = [watch.of for watch in self.watches if watch.kind == "hold"]
        for row, (contact, _, side) in enumerate(self.holding):
            if contact.switch:
                beside = sticking[row], "-" if side > 0 else "+"
                for port, one in enumerate(outside):
                    if beside in one.when and one.acts(self.equations.states.contacts):
                        made[row, port] = side
        return made

    def limits(self, times: Floats, seen: Floats | None) -> Floats:
        """Limits of what sticks at times, shape (limits, times) [N*m]."""
        if self.straight_limits is not None:
            made: Floats = self.straight_limits[:, :1] + self.straight_limits[:, 1:] * times
            return made
        return np.array([_limits(contact, side, times, seen) for contact, _, side in self.holding])

    def units(self, scales: LargeSizes) -> Floats:
        """What is large beside each margin."""
        units = np.where(self.is_torque, scales.torque, scales.speed)
        at = self.deciding
        for _, _, limit in self.limits_of_states:
            units[at] = EXACT_SIDES / NO_MARGIN * max(abs(limit), NOT_ZERO)
            at += 1
        for one in self.sequences:
            units[at] = EXACT_SIDES / NO_MARGIN * max(one.size, NOT_ZERO)
            at += 1
        return units

    def at(self, time: float, state: Floats) -> Floats:
        """All margins at a time."""
        return self.along(np.array([time]), state[:, None])[:, 0]

    def along(self, times: Floats, states: Floats) -> Floats:
        """All margins at several times, shape (margins, times)."""
        equations = self.equations
        rates, torques = equations.acting_at(times, states)
        held: Floats = equations.structure.torques @ torques
        layout = equations.layout
        times = equations.ports.inside(times)
        seen = equations.seen_at(times, states, rates, torques) if self.sees else None
        slips = rates[self.slip_ports]
        for row, (link, jump) in self.switches:
            angles = states[equations.angles][layout.angles.index(link)]
            if jump.over == "angle":
                slips[row] = angles
            slips[row] -= curve_along(jump.at, times) + jump.by_angle * angles
        parts = [self.slip_signs[:, None] * slips]
        slack = self._slack(times, held, torques, seen)
        mine = len(self.holding)
        shown = np.full(slack.shape, np.inf) if self.shared else slack
        parts.append(shown[:mine])
        if self.moving:
            links = equations.speeds_at(times, states)
            for index, speed, torque in self.moving:
                slip = equations.system.meshes[index].slip @ links
                parts.append(np.array([speed * slip, torque * held[index]]))
        parts.append(shown[mine:])
        parts += self._of_springs(times, states, rates, torques, seen)
        for row, in_state, corner, side in self.corners:
            at = states[row] if in_state else rates[row]
            parts.append(side * (at - corner)[None, :])
        for place, corner, side in self.ratios:
            pump, turbine = (rates[first + place] for first in (layout.pumps, layout.turbines))
            turns = np.where(pump < 0, -1.0, 1.0)
            parts.append((side * turns * (turbine - corner * pump))[None, :])
        if self.shared:
            columns = range(len(times))
            parts.append(np.array([[self._together(slack[:, n], held[:, n]) for n in columns]]))
        if len(self.watches) > self.deciding:
            if seen is None:
                seen = equations.seen_at(times, states, rates, torques)
            parts.append(self._of_values(times, states, seen))
        return np.vstack(parts)

    def _of_values(self, times: Floats, states: Floats, seen: Floats) -> Floats:
        """Of states at their limits, and of what steps wait for."""
        changes = self.equations.changes
        values = states[self.equations.values]
        made = []
        for index, side, limit in self.limits_of_states:
            if changes.held[index]:
                made.append(side * changes.rates[index].along(times, seen))
            else:
                made.append(side * (limit - values[index]))
        for one in self.sequences:
            first, second = one.compared
            found = first.along(times, seen) - second.along(times, seen)
            if one.side in "0?":
                made.append(EQUAL_SIDES * one.size - np.abs(found))
            else:
                made.append(SIGNS[one.side] * found)
        return np.array(made)

    def _slack(self, times: Floats, held: Floats, torques: Floats, seen: Floats | None) -> Floats:
        """Of contacts that stick, then of meshes, shape (slacks, times)."""
        cones = [self.limits(times, seen) - self.sides[:, None] * held[self.held_rows]]
        if self.by_torques is not None:
            cones[0] += self.by_torques @ torques
            for row in self.jumping:
                both = cones[0][row : row + 2]
                width = both.sum(axis=0)
                both[:, width < 0] = width[width < 0]  # it pushes away, to either side
        for mesh, friction, less, more in self.cones:
            torque, taken = held[mesh], held[friction]
            sign = np.where(torque >= 0, 1.0, -1.0)
            cones.append(sign * np.array([taken + less * torque, more * torque - taken]))
        return np.vstack(cones)

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
        if smallest >= -PASSED_LIMIT * largest(held):
            return max(smallest, 0.0)
        return self._roomiest(slack, held).room

    def _roomiest(self, slack: Floats, held: Floats) -> SplitRoom:
        """Limits with the torque of each mesh on the side on which there is most room.

        What a mesh takes lies in a cone on either side of 0. Where its torque is redundant, that of
        least norm says nothing of the side: others are tried while no split is within all limits.
        Only where a mesh is at its limit can its other side leave more room.
        """
        first, redundant = len(self.holding), self.equations.structure.redundant
        directions = self._directions(held)
        if self.last_room and self.last_room.is_of(slack, directions):
            return self.last_room
        best = SplitRoom(slack, directions, np.ones(len(slack)), widest(slack, directions))
        either = [
            slice(first + 2 * place, first + 2 * place + 2)
            for place, (mesh, *_) in enumerate(self.cones)
            if largest(redundant[mesh]) > SHARED_TORQUE
        ]
        while best.room <= 0:
            others = [best.on_other_side(rows) for rows in either if best.tight[rows].any()]
            found = max(others, key=attrgetter("room"), default=best)
            if found.room <= best.room:
                break
            best = found
        self.last_room = best
        return best

    def tight(self, time: float, state: Floats) -> list[Watch]:
        """What is at its limit in the split that leaves most room."""
        at, states = np.array([time]), state[:, None]
        rates, torques = self.equations.acting_at(at, states)
        seen = self.equations.seen_at(at, states, rates, torques) if self.sees else None
        held = (self.equations.structure.torques @ torques)[:, 0]
        found = self._roomiest(self._slack(at, held[:, None], torques, seen)[:, 0], held)
        watches = [one for kind in ("hold", "cone") for one in self.watches if one.kind == kind]
        return [
            watch._replace(side=watch.side * int(way))
            for watch, way, tight in zip(watches, found.ways, found.tight.tolist(), strict=True)
            if tight
        ]

    def breaking(self, watch: Watch, time: float, state: Floats) -> Watch:
        """What ends, for a mesh with the side to which it begins to move."""
        if watch.kind != "cone":
            return watch
        _, torques = self.equations.acting(time, state)
        held = self.equations.structure.torques[watch.of] @ torques
        return watch._replace(side=watch.side if held >= 0 else -watch.side)

    def split(self, times: Floats, states: Floats, rates: Floats, torques: Floats) -> Floats:
        """Torques of what holds, those of least norm within the limits, shape (held, times).

        All shapes end with the times; `rates` and `torques` are those of the ports.
        """
        held: Floats = self.equations.structure.torques @ torques
        if not self.shared:
            return held
        seen = self.equations.seen_at(times, states, rates, torques) if self.sees else None
        slack = self._slack(times, held, torques, seen)
        made = held.copy()
        rounding = PASSED_LIMIT * np.abs(held).max(axis=0, initial=0.0)
        for column in np.flatnonzero(slack.min(axis=0) < -rounding):
            given = slack[:, column], self._directions(held[:, column])
            if self.cones:  # of which the sides are open
                given = self._roomiest(slack[:, column], held[:, column])[:2]
            change = least(*given)
            if change is not None:
                made[:, column] += self.equations.structure.redundant @ change
        return made

    def _of_springs(
        self,
        times: Floats,
        states: Floats,
        rates: Floats,
        torques: Floats,
        seen: Floats | None,
    ) -> list[Floats]:
        equations = self.equations
        first = equations.layout.springs
        springs = equations.system.springs
        made = []
        for index in self.bending:
            limit = programme_along(springs[index].programme, times, seen)
            made.append((limit - np.abs(torques[first + index]))[None, :])
        for index, sign in self.gripping:
            spring, rate = springs[index], rates[first + index]
            if spring.viscous:
                trial = spring.stiffness * states[equations.twists][index] + spring.viscous * rate
                made.append(
                    (sign * trial - programme_along(spring.programme, times, seen))[None, :]
                )
            else:
                slopes = [
                    equations.limit_slopes(time, rates[:, n], states[:, n])[index]
                    for n, time in enumerate(times.tolist())
                ]
                made.append((sign * (rate - np.array(slopes) / spring.stiffness))[None, :])
        for index, sign in self.touching:
            fixed, by_twist = springs[index].curve.piece(self._piece(index))
            elastic = fixed + by_twist * states[equations.twists][index]
            trial = elastic + springs[index].viscous * rates[first + index]
            made.append((sign * trial)[None, :])
        return made


def _is_limited(device: Contact | Elastic, time: float) -> bool:
    """Whether there is a torque that it does not carry."""
    programme = device.programme
    return programme.look is not None or math.isfinite(programme_at(programme, time))


def _limits(contact: Contact, side: int, times: Floats, seen: Floats | None) -> Floats:
    if contact.one_way and side == 1:
        return np.full(len(times), contact.overrun_drag)
    held = programme_along(contact.programme, times, seen)
    return contact.static * friction_at(contact.friction) * held
