"""Margins: distances from changes of state; a margin is negative once its change is due."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter
from typing import Literal, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, largest
from vstatics.simulation.events.split import KnownLimits, least, most_room, widest
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.scenario.programme import friction_at
from vstatics.simulation.system.curves import curve_along, is_limited, programme_along
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, Contact, RigidMechanism
from vstatics.simulation.system.sight import Compared
from vstatics.simulation.system.structure import Multiplier
from vstatics.simulation.system.values import TURNING
from vstatics.simulation.tolerances import (
    EQUAL_SIDES,
    EXACT_SIDES,
    NO_MARGIN,
    NOT_ZERO,
    PASSED_LIMIT,
    SAME_ROOM,
    SHARED_TORQUE,
    STANDING,
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
"""Kinds of margins.

A slip can end. A sticking contact can slip, alone (`hold`) or together with others (`split`). A
moving mechanism can come to rest (`mesh`), its power flow can reverse (`flow`), and a mechanism at
rest can begin to move (`cone`). A spring can reach its torque limit or grip again. A law over a
speed or angle has corners (`piece`). A control state can reach or leave its limit (`state`). The
condition of a sequence step can become true (`awaited`), and a formula can bend or jump (`corner`).
"""


_INSTANTS_OF_PART = 9
"""Largest number of instants in a part of a time step."""
FOLLOWING = ("state", "awaited", "corner")
"""Kinds of margins without influence on the choice between sticking and slipping."""


class Watch(NamedTuple):
    """Identity of a margin: kind of margin, index of its component, and side."""

    kind: Watched
    of: int
    """Index of the contact, mechanism, spring, law, control state, sequence step or corner."""
    side: int = 1
    """Sign of the torque at the limit, or of the step to the next linear piece of a law."""


class LargeSizes(NamedTuple):
    """Speed and torque that count as large in a run, as scales of rounding errors."""

    speed: float
    """Speed that counts as large. [rad/s]"""
    torque: float
    """Torque that counts as large. [N*m]"""


class SplitRoom(NamedTuple):
    """Slacks of redundant torques: distances to their torque limits.

    Redundant torques can be split between sticking contacts and mechanisms in many ways.
    """

    slack: Floats
    directions: Floats
    """Changes of the slacks along redundant torques, shape (slacks, directions)."""
    ways: Floats
    """Signs of slacks, -1 if a mechanism's torque has the opposite sign of the least-norm split."""
    widest: Floats
    """Slacks of the split whose smallest slack is largest."""
    room: float
    """Smallest slack of `widest`, negative if no split is within all limits. [N*m]"""
    known: KnownLimits
    """Limits found in other splits of the same run."""

    @property
    def tight(self) -> Booleans:
        """Flags of the smallest slacks in `widest`."""
        return self.widest <= self.room + TIGHT_SLACK * largest(self.slack)

    def on_other_side(self, rows: slice) -> SplitRoom:
        """Return the slacks for the opposite torque of the mechanism whose slacks are in `rows`."""
        turn = np.ones(len(self.ways))
        turn[rows] = -1.0
        slack, directions = self.slack * turn, self.directions * turn[:, None]
        return split_room(slack, directions, self.ways * turn, self.known)


def split_room(slack: Floats, directions: Floats, ways: Floats, known: KnownLimits) -> SplitRoom:
    """Return the split of redundant torques whose smallest slack is largest."""
    slacks = widest(slack, directions, known)
    return SplitRoom(slack, directions, ways, slacks, float(slacks.min()), known)


class Awaited(NamedTuple):
    """Sign of the difference of two numbers, in a step condition or at a formula corner."""

    compared: Compared
    side: str
    """Sign of the difference from now on: `+`, `-`, `0` for a lasting 0, `?` if not a number."""
    size: float
    """Scale of the compared numbers; a tiny difference relative to it is rounding."""
    is_equal: bool
    """True if both numbers are equal now, even if the difference changes from now on."""
    change: float
    """Magnitude of the change of the difference during the look-ahead."""


class Margins:
    """Margins of a motion between two events, in N*m or rad/s."""

    def __init__(self, equations: Equations, known: KnownLimits) -> None:
        self.equations, self.known = equations, known
        system, layout, structure = equations.system, equations.layout, equations.structure
        self.watches: list[Watch] = []
        self.is_torque: list[bool] = []
        self._contacts()
        self._meshes()
        self._springs()
        self._pieces()
        self.held_rows = np.array([row for _, row, _ in self.holding], dtype=int)
        self.sides = np.array([side for _, _, side in self.holding], dtype=float)
        self.shared = structure.redundant.shape[1] > 0 and bool(self.holding or self.cones)
        if self.shared:
            self._watch("split", -1)
        self.directions = self._positive_directions()
        held = len(self.holding)
        self.either = [
            slice(held + 2 * place, held + 2 * place + 2)
            for place, (mesh, *_) in enumerate(self.cones)
            if largest(structure.redundant[mesh]) > SHARED_TORQUE
        ]
        """Rows of both slacks of each mechanism at rest with a redundant torque, of any sign."""
        self.straight_limits = self._straight_limits()
        self.sees = any(device.programme.look is not None for device in system.may_slip)
        """True if a torque limit is a formula that reads the motion."""
        self.slip_ports = np.array([port for port, _ in self.slipping], dtype=int)
        self.slip_signs = np.array([sign for _, sign in self.slipping])
        contacts = [system.contacts[port - layout.contacts] for port, _ in self.slipping]
        self.switches = [
            (row, contact.switch) for row, contact in enumerate(contacts) if contact.switch
        ]
        """Torque jumps: row of their contact among the slipping contacts, and data of the jump."""
        self.jumping = [row for row, holding in enumerate(self.holding) if holding[0].switch][::2]
        """First of the two rows in `holding` of each contact that represents a torque jump."""
        self.by_torques = self._limits_by_torques() if self.jumping else None
        self.deciding = len(self.watches)
        """Number of leading margins that decide between sticking and slipping."""
        self._states()
        self.sequences: list[Awaited] = []

    def follow(self, kind: Watched, compared: Iterable[tuple[int, Awaited]]) -> None:
        """Add margins of comparisons, each with the index of its sequence or corner."""
        for number, comparison in compared:
            self._watch(kind, number, torque=False)
            self.sequences.append(comparison)

    def _states(self) -> None:
        """Add margins of control states: both limits if free, the departure if held at a limit."""
        self.limits_of_states: list[tuple[int, int, float]] = []
        held = self.equations.changes.held.tolist()
        for index, state in enumerate(self.equations.system.scenario.states):
            if held[index] == TURNING:
                self.limits_of_states.append((index, TURNING, state.start))
                self._watch("state", index, TURNING, torque=False)
            for side, limit in ((1, state.most), (-1, state.least)):
                if math.isfinite(limit) and held[index] in (0, side):
                    self.limits_of_states.append((index, side, limit))
                    self._watch("state", index, side, torque=False)

    def _watch(self, kind: Watched, index: int, side: int = 1, *, torque: bool = True) -> None:
        self.watches.append(Watch(kind, index, side))
        self.is_torque.append(torque)

    def _contacts(self) -> None:
        equations = self.equations
        self.slipping: list[tuple[int, float]] = []
        self.holding: list[tuple[Contact, int, int]] = []
        """Limits of sticking contacts: contact, row of its torque, 1 for upper or -1 for lower."""
        contacts = [
            *enumerate(zip(equations.system.contacts, equations.states.contacts, strict=True))
        ]
        for index, (_, state) in contacts:
            if state in SIGNS:
                self.slipping.append((equations.layout.contacts + index, SIGNS[state]))
                self._watch("slip", index, torque=False)
        for index, (contact, state) in contacts:
            if state == "stick":
                first = contact.switch.jump.side if contact.switch else "+"
                for side in (1, -1) if first == "+" else (-1, 1):
                    if (side == 1 and contact.one_way) or is_limited(contact, equations.time):
                        row = equations.structure.contact_rows[index]
                        self.holding.append((contact, row, side))
                        self._watch("hold", index, side)

    def _meshes(self) -> None:
        system, states = self.equations.system, self.equations.states
        self.moving: list[tuple[int, float, float]] = []
        self.cones: list[tuple[int, int, RigidMechanism]] = []
        for index, state in enumerate(states.meshes):
            if state not in ("", "stick"):
                speed, torque = (SIGNS[sign] for sign in state)
                self.moving.append((index, speed, torque))
                self._watch("mesh", index, torque=False)
                self._watch("flow", index)
        for index, (mesh, state) in enumerate(zip(system.meshes, states.meshes, strict=True)):
            if state == "stick":
                multiplier = Multiplier("friction", index)
                friction = self.equations.structure.multipliers.index(multiplier)
                self.cones.append((index, friction, mesh))
                self._watch("cone", index, 1)
                self._watch("cone", index, -1)

    def _springs(self) -> None:
        system, states = self.equations.system, self.equations.states
        springs = [*enumerate(zip(system.springs, states.springs, strict=True))]
        self.bending: list[int] = []
        self.gripping: list[tuple[int, float]] = []
        for index, (spring, state) in springs:
            if state == "stick" and is_limited(spring, self.equations.time):
                self.bending.append(index)
                self._watch("limit", index)
        for index, (spring, state) in springs:
            if state in SIGNS:
                self.gripping.append((index, SIGNS[state]))
                self._watch("grip", index, torque=spring.viscous > 0)
        self.touching: list[tuple[int, float]] = []
        """Springs twisted beyond their play: index, and sign of the torque in the margin.

        In contact this is the sign of the elastic torque, and while the spring is parted the
        opposite sign.
        """
        for index, (spring, state) in springs:
            side = spring.side(self._piece(index)) if spring.can_part else 0.0
            if side:
                self.touching.append((index, side if state == "stick" else -side))
                self._watch("limit" if state == "stick" else "grip", index)

    def _piece(self, spring: int) -> int:
        return self.equations.states.pieces[self.equations.layout.curves + spring]

    def _pieces(self) -> None:
        """Add margins of the breakpoints of piecewise-linear curves.

        The curves are external torques over speed or angle, friction over slip, springs over twist,
        and converters over speed ratio.
        """
        equations = self.equations
        self.corners: list[tuple[int, bool, float, float]] = []
        """Corners: row, True if the row is in the state (else the port speeds), value, and factor.

        The margin is the factor times the difference of the quantity and the value.
        """
        for index, load in enumerate(equations.system.outside):
            law = load.law
            if not isinstance(law, Points) or law.over == "time":
                continue
            if not load.acts(equations.states.contacts):
                continue
            by_angle = law.over == "angle"
            row = index
            if by_angle:
                row = equations.angles.start + equations.layout.angles.index(load.link)
            for corner, side in self._ends(index, law.x):
                self.corners.append((row, by_angle, corner, side))
        self._friction_corners()
        for index, spring in enumerate(equations.system.springs):
            row, at = equations.twists.start + index, equations.layout.curves + index
            for corner, side in self._ends(at, spring.curve.corners, torque=True):
                self.corners.append((row, True, corner, side * spring.stiffness))
        self.ratios: list[tuple[int, float, float]] = []
        """Ends of active pieces of converters: index of the converter, speed ratio, and factor."""
        for place, converter in enumerate(equations.system.converters):
            ratios = [ratio for ratio, _, _ in converter.points]
            for corner, side in self._ends(equations.layout.outside + place, ratios):
                self.ratios.append((place, corner, side))

    def _friction_corners(self) -> None:
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
        """Add margins of the ends of the active linear piece; yield each end and its factor.

        The factor is +1 at the lower end and -1 at the upper end.
        """
        piece = self.equations.states.pieces[index]
        for place, step in ((piece - 1, -1), (piece, 1)):
            if 0 <= place < len(corners):
                self._watch("piece", index, step, torque=torque)
                yield corners[place], float(-step)

    def _positive_directions(self) -> Floats:
        """Return the changes of slacks along redundant torques, for positive mechanism torques."""
        redundant = self.equations.structure.redundant
        rows = [-side * redundant[row] for _, row, side in self.holding]
        for mesh, friction, mechanism in self.cones:
            less, more = 1 - mechanism.efficiency, 1 / mechanism.back - 1
            rows.append(redundant[friction] + less * redundant[mesh])
            rows.append(more * redundant[mesh] - redundant[friction])
        return np.array(rows).reshape(len(rows), redundant.shape[1])

    def _straight_limits(self) -> Floats | None:
        """Return (c0, c1) of the torque limits ``c0 + c1 t`` of contacts, None if not linear."""
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
        """Return the weights of port torques in the limits of contacts that represent jumps.

        While such a contact sticks, the torques of both sides of the jump act, and the contact
        carries the excess of their sum.
        """
        outside = self.equations.system.outside
        weights = np.zeros((len(self.holding), self.equations.layout.ports))
        sticking = [watch.of for watch in self.watches if watch.kind == "hold"]
        for row, (contact, _, side) in enumerate(self.holding):
            if contact.switch:
                switch_side = sticking[row], "-" if side > 0 else "+"
                for port, load in enumerate(outside):
                    if switch_side in load.when and load.acts(self.equations.states.contacts):
                        weights[row, port] = side
        return weights

    def limits(self, times: Floats, seen: Floats | None) -> Floats:
        """Return torque limits of sticking contacts [N*m], shape (limits, times)."""
        if self.straight_limits is not None:
            return self.straight_limits[:, :1] + self.straight_limits[:, 1:] * times
        return np.array([_limits(contact, side, times, seen) for contact, _, side in self.holding])

    def units(self, scales: LargeSizes) -> Floats:
        """Return the scale of each margin, relative to which a tiny violation is rounding."""
        units = np.where(self.is_torque, scales.torque, scales.speed)
        sizes = [abs(limit) for _, _, limit in self.limits_of_states]
        sizes += [comparison.size for comparison in self.sequences]
        units[self.deciding :] = EXACT_SIDES / NO_MARGIN * np.maximum(sizes, NOT_ZERO)
        return units

    def at(self, time: float, state: Floats) -> Floats:
        """Return all margins in a state at a time, shape (margins,)."""
        return self.along(np.array([time]), state[:, None])[:, 0]

    def along(self, times: Floats, states: Floats, enough: float = -math.inf) -> Floats:
        """Return all margins at several times, shape (margins, times).

        The margin `split` takes the longest time to calculate. After it has fallen below `enough`,
        it is calculated at `_INSTANTS_OF_PART` more times, which complete a part of a time step,
        and is 0 afterwards.
        """
        equations = self.equations
        rates, torques = equations.acting_at(times, states)
        held = equations.structure.torques @ torques
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
            size = np.maximum(np.hypot(pump, turbine), NOT_ZERO)
            # While the pump is at rest, the speed ratio jumps, but torques and margin are 0.
            parts.append((side * pump / size * (turbine - corner * pump))[None, :])
        if self.shared:
            parts.append(self._together(slack, held, enough)[None, :])
        if len(self.watches) > self.deciding:
            if seen is None:
                seen = equations.seen_at(times, states, rates, torques)
            parts.append(self._of_values(times, states, seen))
        return np.concatenate(parts)

    def _of_values(self, times: Floats, states: Floats, seen: Floats) -> Floats:
        """Return the margins of control states at limits and of comparisons."""
        changes = self.equations.changes
        values = states[self.equations.values]
        margins = []
        for index, side, limit in self.limits_of_states:
            if side == TURNING:
                margins.append(changes.leading(index, times, seen))
            elif changes.held[index]:
                margins.append(side * changes.rates[index].along(times, seen))
            else:
                margins.append(side * (limit - values[index]))
        for comparison in self.sequences:
            first, second = comparison.compared
            difference = first.along(times, seen) - second.along(times, seen)
            if comparison.side in "0?":
                margins.append(EQUAL_SIDES * comparison.size - np.abs(difference))
            else:
                margins.append(SIGNS[comparison.side] * difference)
        return np.array(margins)

    def _slack(self, times: Floats, held: Floats, torques: Floats, seen: Floats | None) -> Floats:
        """Return slacks of sticking contacts, then of mechanisms at rest, shape (slacks, times)."""
        cones = [self.limits(times, seen) - self.sides[:, None] * held[self.held_rows]]
        if self.by_torques is not None:
            cones[0] += self.by_torques @ torques
            for row in self.jumping:
                both = cones[0][row : row + 2]
                width = both.sum(axis=0)
                # if width < 0, the torques on both sides drive the motion away from the jump
                both[:, width < 0] = width[width < 0]
        for mesh, friction, mechanism in self.cones:
            torque, taken = held[mesh], held[friction]
            less, more = mechanism.friction_at_rest(torque)
            sign = np.where(torque >= 0, 1.0, -1.0)
            cones.append(sign * np.array([taken + less * torque, more * torque - taken]))
        return np.concatenate(cones)

    def _directions(self, held: Floats) -> Floats:
        """Return the changes of the slacks along redundant torques."""
        ways = [1.0] * len(self.holding)
        for mesh, *_ in self.cones:
            ways += [1.0, 1.0] if held[mesh] >= 0 else [-1.0, -1.0]
        return np.array(ways)[:, None] * self.directions

    def _together(self, slack: Floats, held: Floats, enough: float) -> Floats:
        """Return the smallest slack [N*m] of the best split at each time; see `along`."""
        smallest = slack.min(axis=0)
        is_within = smallest >= -PASSED_LIMIT * np.abs(held).max(axis=0, initial=0.0)
        room: Floats = np.maximum(smallest, 0.0)
        last = len(room)
        for column in np.flatnonzero(~is_within).tolist():
            if column > last:
                break
            room[column] = self._roomiest(slack[:, column], held[:, column]).room
            if room[column] < enough:
                last = min(last, column + _INSTANTS_OF_PART)
        return room

    def _roomiest(self, slack: Floats, held: Floats) -> SplitRoom:
        """Return the slacks for the signs of mechanism torques that leave most slack.

        The friction torque of a mechanism at rest is limited in proportion to its torque, for both
        signs of this torque (a double cone). The least-norm split does not determine the sign of a
        redundant torque, so other signs are tried until some split is within all limits. Only a
        mechanism at its limit can gain slack by the other sign.
        """
        directions = self._directions(held)
        best = split_room(slack, directions, np.ones(len(slack)), self.known)
        if best.room > 0 or not self.either:
            return best
        of_one_sign = np.delete(np.arange(len(slack)), np.r_[tuple(self.either)])
        most = most_room(slack[of_one_sign], directions[of_one_sign], self.known)
        while best.room <= min(0.0, most - SAME_ROOM * largest(slack)):
            tight = best.tight
            others = [best.on_other_side(rows) for rows in self.either if tight[rows].any()]
            roomiest = max(others, key=attrgetter("room"), default=best)
            if roomiest.room <= best.room:
                break
            best = roomiest
        return best

    def tight(self, time: float, state: Floats) -> list[Watch]:
        """Return the identities of the margins with the smallest slack in the best split."""
        at, states = np.array([time]), state[:, None]
        rates, torques = self.equations.acting_at(at, states)
        seen = self.equations.seen_at(at, states, rates, torques) if self.sees else None
        held = (self.equations.structure.torques @ torques)[:, 0]
        room = self._roomiest(self._slack(at, held[:, None], torques, seen)[:, 0], held)
        watches = [
            watch for kind in ("hold", "cone") for watch in self.watches if watch.kind == kind
        ]
        return [
            watch._replace(side=watch.side * int(way))
            for watch, way, tight in zip(watches, room.ways, room.tight.tolist(), strict=True)
            if tight
        ]

    def breaking(self, watch: Watch, time: float, state: Floats) -> Watch:
        """Return `watch` with the side on which the next state is.

        For a mechanism at rest, the side is the direction in which it would move. For a converter,
        the side is the number of pieces from the present piece to the next; if the speed of the
        pump changes its sign, this is the opposite end of the points. Otherwise, if any link has no
        inertia, the next piece is a neighbour, because trials can move such links to any speed.
        """
        layout = self.equations.layout
        if watch.kind == "piece" and layout.outside <= watch.of < layout.frictions:
            converter = self.equations.system.converters[watch.of - layout.outside]
            speeds = self.equations.speeds(time, state).tolist()
            pump, turbine = (speeds[link - 1] for link in converter.links)
            turns = abs(pump) > STANDING * abs(turbine)
            if turns and self.equations.light:
                return watch
            ratio = turbine / pump if turns else math.copysign(math.inf, watch.side)
            piece = bisect_right([point[0] for point in converter.points], ratio)
            return watch._replace(side=piece - self.equations.states.pieces[watch.of] or watch.side)
        if watch.kind != "cone":
            return watch
        _, torques = self.equations.acting(time, state)
        held = self.equations.structure.torques[watch.of] @ torques
        return watch._replace(side=watch.side if held >= 0 else -watch.side)

    def split(self, times: Floats, states: Floats, rates: Floats, torques: Floats) -> Floats:
        """Return constraint torques of least norm within the limits, shape (multipliers, times).

        Times are the last axis of all arguments; `rates` and `torques` have a row for each port.
        """
        held = self.equations.structure.torques @ torques
        if not self.shared:
            return held
        seen = self.equations.seen_at(times, states, rates, torques) if self.sees else None
        slack = self._slack(times, held, torques, seen)
        within_limits = held.copy()
        rounding = PASSED_LIMIT * np.abs(held).max(axis=0, initial=0.0)
        for column in np.flatnonzero(slack.min(axis=0) < -rounding):
            given = slack[:, column], self._directions(held[:, column])
            if self.cones:  # the torque signs of mechanisms at rest are not fixed
                given = self._roomiest(slack[:, column], held[:, column])[:2]
            change = least(*given)
            if change is not None:
                within_limits[:, column] += self.equations.structure.redundant @ change
        return within_limits

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
        margins = []
        for index in self.bending:
            limit = programme_along(springs[index].programme, times, seen)
            margins.append((limit - np.abs(torques[first + index]))[None, :])
        for index, sign in self.gripping:
            spring, rate = springs[index], rates[first + index]
            if spring.viscous:
                trial = spring.stiffness * states[equations.twists][index] + spring.viscous * rate
                margins.append(
                    (sign * trial - programme_along(spring.programme, times, seen))[None, :]
                )
            else:
                slopes = [
                    equations.limit_slopes(time, rates[:, n], states[:, n])[index]
                    for n, time in enumerate(times.tolist())
                ]
                margins.append((sign * (rate - np.array(slopes) / spring.stiffness))[None, :])
        for index, sign in self.touching:
            fixed, by_twist = springs[index].curve.piece(self._piece(index))
            elastic = fixed + by_twist * states[equations.twists][index]
            trial = elastic + springs[index].viscous * rates[first + index]
            margins.append((sign * trial)[None, :])
        return margins


def _limits(contact: Contact, side: int, times: Floats, seen: Floats | None) -> Floats:
    if contact.one_way and side == 1:
        return np.full(len(times), contact.overrun_drag)
    held = programme_along(contact.programme.on_side(side), times, seen)
    return contact.static * friction_at(contact.friction) * held
