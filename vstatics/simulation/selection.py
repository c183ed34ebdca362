"""What sticks and what slips from an instant on.

Of the admissible choices that with most sticking, then the one nearest to before: all that may
stick is tried as sticking first, then with one of them slipping, and so on. A choice is admissible
where no margin is below 0, and none that is 0 falls.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from heapq import heappop, heappush
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from vstatics.errors import CaseError
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.simulation.converters import converter_piece
from vstatics.simulation.curves import capacity_at, programme_at
from vstatics.simulation.equations import Equations
from vstatics.simulation.laws import Points
from vstatics.simulation.margins import LargeSizes, Margins, Watch
from vstatics.simulation.ports import PortLayout, States
from vstatics.simulation.structure import MotionStructure, Structures
from vstatics.simulation.system import MotionSystem

_AMPLE = 1e300
_MOST_TRIED = 2000
"""Choices, before it is told that there is none."""
SMALL = 1e-9
"""A speed or torque that is 0 but for rounding, by the largest of its kind."""


class Instant(NamedTuple):
    """Where everything is."""

    time: float
    """[s]"""
    speeds: Floats
    """Of links. [rad/s]"""
    twists: Floats
    angles: Floats
    accounts: Floats
    """Works and losses up to here. [J]"""


class NoChoice(Exception):  # noqa: N818 - it never leaves the room
    """No admissible choice."""


class Jump(NamedTuple):
    """Twists that change at once, along motions without inertia."""

    link: str
    energy: float
    """Lost. [J]"""


class Selected(NamedTuple):
    """A choice, with the equations and the state that follow."""

    equations: Equations
    margins: Margins
    state: Floats
    jump: Jump | None = None


Choice = tuple[str, int, tuple[str, ...]]
"""`contact`, `mesh` or `spring`, its index, its states: the one that sticks first."""


class ModeSelection:
    """Chooses what sticks and what slips in a system."""

    def __init__(self, system: MotionSystem, layout: PortLayout) -> None:
        self.system, self.layout = system, layout
        self.structures = Structures(system)
        loose = self.structures.of(
            (False,) * len(system.contacts),
            tuple("" for _ in system.meshes),
        )
        rows = np.array([one.row for one in system.contacts]).reshape(-1, len(system.names))
        touched = np.abs(rows @ loose.light) if loose.light.size else np.zeros((len(rows), 1))
        self.touched = touched.max(axis=1, initial=0.0) > SMALL
        """Contacts whose slip can jump, since something without inertia moves along."""
        self.within = 1e-7 * system.scenario.duration
        """How far it is looked ahead. [s]"""

    def select(
        self,
        at: Instant,
        before: States | None,
        scales: LargeSizes,
        left: Sequence[States] = (),
        met: Sequence[int] = (),
    ) -> Selected:
        """The choice from an instant on.

        Parameters
        ----------
        at : Instant
        before : States, optional
        scales : LargeSizes
        left : sequence of States
            That can't be kept.
        met : sequence of int
            Indices of contacts whose slip ends here.

        Raises
        ------
        NoChoice
        CaseError
            Of a link without inertia whose speed nothing determines.
        """
        base, choices = self.choices(at, before, scales, met)
        search = _Search(base, choices, before)
        fault: CaseError | None = None
        for states in search:
            try:
                found, failing = self._tried(states, at, scales)
            except CaseError as error:
                fault, found, failing = fault or error, None, []
            except np.linalg.LinAlgError:
                found, failing = None, []
            if found is not None and found.equations.states not in left:
                return found
            failing = [watch for watch in failing if self._may_change(watch, states, choices)]
            search.fails(states, failing, self._released(states, at, choices))
        if fault is not None:
            raise fault
        raise NoChoice

    def _may_change(self, watch: Watch, states: States, choices: Sequence[Choice]) -> bool:
        """Whether a mesh that fails could move at all, with what sticks besides meshes."""
        if _KINDS[watch.kind] != "mesh":
            return True
        free = {index for kind, index, _ in choices if kind == "mesh"}
        meshes = tuple("" if index in free else one for index, one in enumerate(states.meshes))
        try:
            motions = self.structures.of(states.held, meshes)
        except np.linalg.LinAlgError:
            return True
        slip = self.system.meshes[watch.of].slip
        moves = np.concatenate([slip @ motions.free, slip @ motions.light])
        return bool((np.abs(moves) > SMALL).any())

    def _released(self, states: States, at: Instant, choices: Sequence[Choice]) -> States | None:
        """The states with all meshes moving that would, if none of them held by its friction."""
        held = [
            index
            for kind, index, _ in choices
            if kind == "mesh" and states.meshes[index] == "stick"
        ]
        if not held:
            return None
        meshes = list(states.meshes)
        for index in held:
            meshes[index] = ""
        loose = states._replace(meshes=tuple(meshes))
        try:
            structure = self.structures.of(loose.held, loose.meshes)
            equations = Equations(self.system, self.layout, structure, loose, at.time)
            state = state_of(equations, at)
            rates, _ = equations.rates(at.time, state)
            torques = equations.torques(at.time, state, rates)
        except (CaseError, np.linalg.LinAlgError):
            return None
        turning = structure.free @ (structure.accelerations @ torques)
        carried = structure.torques @ torques
        slips = np.array([self.system.meshes[index].slip @ turning for index in held])
        least = SMALL * float(np.abs(turning).max(initial=0.0))
        for index, slip in zip(held, slips.tolist(), strict=True):
            flow = "+" if carried[index] >= 0 else "-"
            meshes[index] = ("+" if slip > 0 else "-") + flow if abs(slip) > least else "stick"
        return states._replace(meshes=tuple(meshes))

    def choices(
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
        capacity = capacity_at(contact, at.time, slip)
        if capacity == 0:  # it may begin to rise here
            capacity = capacity_at(contact, at.time + self.within, slip)
        if contact.while_open is not None:
            times = at.time, at.time + self.within
            if any(self._programme_of(contact.while_open, time) for time in times):
                return "open"
        if capacity == 0 and not contact.one_way:
            return "open"
        if not contact.row.any():
            return "rigid"
        if math.isinf(capacity) and not contact.one_way:
            return "rigid"
        sign = "+" if slip > 0 else "-"
        if abs(slip) > SMALL * scales.speed and not (met or self.touched[index]):
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
        if mesh.lossless:
            return ""
        speed = float(mesh.slip @ at.speeds)
        last = before.meshes[index] if before else ""
        torque = last[1] if last not in ("", "stick") else "+"
        if abs(speed) > SMALL * scales.speed:
            return ("+" if speed > 0 else "-") + torque
        choices.append(("mesh", index, ("stick", "+" + torque, "-" + torque)))
        return "stick"

    def _spring(self, index: int, at: Instant, scales: LargeSizes, choices: list[Choice]) -> str:
        spring = self.system.springs[index]
        limit = programme_at(spring.limit, at.time)
        if math.isinf(limit):
            return "stick"
        if limit == 0 == programme_at(spring.limit, at.time + self.within):
            return "open"
        torque = spring.stiffness * float(at.twists[index])
        near = limit - SMALL * scales.torque
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
            small = SMALL * max(1.0, abs(value))
            if low - small <= value <= high + small:
                return last
        return piece

    def _converter_piece(self, index: int, at: Instant, before: States | None) -> int:
        """The piece of the points of a converter; at a corner it may be either side's."""
        converter = self.system.converters[index]
        pump, turbine = (float(at.speeds[link - 1]) for link in converter[1:3])
        last = None if before is None else before.pieces[self.layout.outside + index]
        if pump == 0 or max(abs(pump), abs(turbine)) <= SMALL:
            # no ratio; what follows tells, piece by piece
            return len(converter.points) if last is None else last
        ratio = turbine / pump
        if last is not None:
            ratios = [-math.inf, *(point[0] for point in converter.points), math.inf]
            if ratios[last] - SMALL <= ratio <= ratios[last + 1] + SMALL:
                return last
        return converter_piece(converter, ratio)

    def _tried(
        self, states: States, at: Instant, scales: LargeSizes
    ) -> tuple[Selected | None, list[Watch]]:
        """A choice if it is admissible, with the flows of meshes and the pieces that go with it.

        Else what fails in it.
        """
        tried: set[States] = set()
        failing: list[Watch] = []
        while states not in tried:
            tried.add(states)
            structure = self.structures.of(states.held, states.meshes)
            equations = Equations(self.system, self.layout, structure, states, at.time)
            state = state_of(equations, at)
            if caught := self._caught(structure, at, state, scales):
                return None, caught
            state, jump = consistent(equations, state, scales)
            margins = Margins(equations)
            failing = self._failing(margins, at.time, state, scales)
            if not failing:
                return Selected(equations, margins, state, jump), []
            states = _turned(states, failing) or states
        return None, failing

    def _caught(
        self, structure: MotionStructure, at: Instant, state: Floats, scales: LargeSizes
    ) -> list[Watch]:
        """What can't stick, since something heavy would have to change its speed at once."""
        heavy = self.system.heavy
        speeds = heavy @ (structure.free @ state[: structure.free.shape[1]])
        if np.abs(speeds - heavy @ at.speeds).max() <= 100 * SMALL * scales.speed:
            return []
        slips = {
            index: float(contact.row @ at.speeds)
            for index, contact in enumerate(self.system.contacts)
            if structure.held[index] and self.touched[index]
        }
        return [
            Watch("hold", index, 1 if slip > 0 else -1)
            for index, slip in slips.items()
            if abs(slip) > SMALL * scales.speed
        ]

    def _failing(
        self, margins: Margins, time: float, state: Floats, scales: LargeSizes
    ) -> list[Watch]:
        """What is below its margin, or at it and falling."""
        now = margins.at(time, state)
        now = np.where(np.isposinf(now), _AMPLE, now)
        units = margins.units(scales)
        below = ~(now >= -SMALL * units)
        if below.any():
            return _failed(margins, time, state, below)
        near = now <= SMALL * units
        if not near.any():
            return []
        ahead = state + self.within * margins.equations.derivative(time, state)
        then = margins.at(time + self.within, ahead)
        falls = near & (then - now < -1e-12 * units)
        return _failed(margins, time + self.within, ahead, falls)


def _failed(margins: Margins, time: float, state: Floats, failing: Booleans) -> list[Watch]:
    """What fails; of what holds together what is at its limit."""
    found: list[Watch] = []
    for index in np.flatnonzero(failing):
        watch = margins.watches[index]
        found += margins.tight(time, state) if watch.kind == "split" else [watch]
    return found


def _turned(states: States, failing: Sequence[Watch]) -> States | None:
    """The states with other flows of meshes and on other pieces; None if more than that fails."""
    if any(watch.kind not in ("flow", "piece") for watch in failing):
        failing = [watch for watch in failing if watch.kind == "flow"]
    return turned(states, failing) if failing else None


def turned(states: States, watches: Sequence[Watch]) -> States:
    """The states with the other flow of each mesh that is watched, and on the next pieces."""
    meshes, pieces = list(states.meshes), list(states.pieces)
    for watch in watches:
        if watch.kind == "flow":
            state = meshes[watch.of]
            meshes[watch.of] = state[0] + ("-" if state[1] == "+" else "+")
        elif watch.kind == "piece":
            pieces[watch.of] += watch.side
    return states._replace(meshes=tuple(meshes), pieces=tuple(pieces))


def consistent(
    equations: Equations, state: Floats, scales: LargeSizes
) -> tuple[Floats, Jump | None]:
    """The state with the twists that balance the torques where nothing heavy moves."""
    if not equations.light or not equations.by_slope.shape[1]:
        return state, None
    time = equations.time
    rates, _ = equations.rates(time, state)
    torques = equations.torques(time, state, rates)
    rest = equations.by_slope.T @ (equations.structure.balances @ torques)
    if np.abs(rest).max() <= SMALL * scales.torque:
        return state, None
    motion = equations.along @ -np.linalg.solve(equations.stiff, rest)
    turned = equations.structure.light_rates @ motion
    made = state.copy()
    made[equations.twists] += np.where(equations.ports.bends, turned[equations.spring_ports], 0.0)
    given = torques * turned
    given[equations.spring_ports] = 0.0
    made[equations.works] += given
    before, after = (equations.elastic_energy(one) for one in (state, made))
    signs = np.ones(len(given))
    signs[equations.layout.outside :] = -1.0
    lost = float(signs @ given) - (after - before)
    links = np.abs(equations.structure.light @ motion)
    return made, Jump(equations.system.names[int(links.argmax())], lost)


def state_of(equations: Equations, at: Instant) -> Floats:
    """The state of equations at an instant."""
    state = np.empty(equations.size)
    structure = equations.structure
    motions = structure.free.T @ at.speeds
    motions += structure.projection @ (at.speeds - structure.free @ motions)
    state[: equations.motions] = motions
    state[equations.twists] = at.twists
    state[equations.angles] = at.angles
    state[equations.works.start :] = at.accounts
    return state


def instant_of(equations: Equations, time: float, state: Floats) -> Instant:
    """The instant that a state of equations stands for."""
    return Instant(
        time,
        equations.speeds(time, state),
        state[equations.twists].copy(),
        state[equations.angles].copy(),
        state[equations.works.start :].copy(),
    )


class _Search:
    """Goes through choices: most sticking first, then nearest to before.

    What fails in a choice tells which to try next; when these are gone, all are tried.
    """

    def __init__(self, base: States, choices: Sequence[Choice], before: States | None) -> None:
        self.base, self.choices, self.before = base, choices, before
        self.place = {choice[:2]: number for number, choice in enumerate(choices)}
        self.seen: set[tuple[tuple[int, str], ...]] = {()}
        self.waiting: list[tuple[tuple[int, ...], tuple[tuple[int, str], ...]]] = [((0,), ())]
        self.changed: tuple[tuple[int, str], ...] = ()

    def __iter__(self) -> Iterator[States]:
        """Choices, as they are to be tried."""
        others = (changed for changed in self._all() if changed not in self.seen)
        for _ in range(_MOST_TRIED):
            if self.waiting:
                changed = heappop(self.waiting)[-1]
            else:
                following = next(others, None)
                if following is None:
                    return
                changed = following
            self.seen.add(changed)
            self.changed = changed
            yield _with(self.base, self.choices, dict(changed))

    def fails(self, states: States, failing: Sequence[Watch], released: States | None) -> None:
        """Note what fails in the choice that was tried last."""
        if released is not None:
            changes = dict(self.changed)
            for number, (kind, index, _) in enumerate(self.choices):
                if kind == "mesh" and released.meshes[index] != states.meshes[index]:
                    changes[number] = released.meshes[index]
            self._push(changes, single=False)
        for watch in failing:
            for number, state in self._others(watch):
                others = {**dict(self.changed), number: state}
                if state == self.choices[number][2][0]:
                    del others[number]
                self._push(others, single=True)

    def _push(self, changes: dict[int, str], *, single: bool) -> None:
        """Have a choice tried: meshes that move together count as one."""
        changed = tuple(sorted(changes.items()))
        if changed in self.seen:
            return
        self.seen.add(changed)
        meshes = sum(self.choices[number][0] == "mesh" for number in changes)
        made = _with(self.base, self.choices, changes)
        slipping = len(changes) - meshes + min(meshes, 1)
        rank = slipping, int(single), _distance(made, self.before), len(self.seen)
        heappush(self.waiting, (rank, changed))

    def _others(self, watch: Watch) -> Iterator[tuple[int, str]]:
        """Other states of what fails."""
        number = self.place.get((_KINDS[watch.kind], watch.of), -1)
        if number < 0:
            return
        options = self.choices[number][2]
        if watch.kind == "hold":
            wanted = "+" if watch.side > 0 else "-"
            options = tuple(option for option in options if option in (wanted, "stick"))
        now = dict(self.changed).get(number, options[0])
        yield from ((number, option) for option in options if option != now)

    def _all(self) -> Iterator[tuple[tuple[int, str], ...]]:
        """All choices, most sticking first."""
        for count in range(len(self.choices) + 1):
            for slipping in combinations(range(len(self.choices)), count):
                for signs in product(*(self.choices[index][2][1:] for index in slipping)):
                    yield tuple(zip(slipping, signs, strict=True))


_KINDS = {
    "slip": "contact",
    "hold": "contact",
    "mesh": "mesh",
    "cone": "mesh",
    "limit": "spring",
    "grip": "spring",
    "flow": "",
    "piece": "",
    "split": "",
}
"""What a margin is of."""


def _with(base: States, choices: Sequence[Choice], changed: dict[int, str]) -> States:
    parts = {
        "contact": list(base.contacts),
        "mesh": list(base.meshes),
        "spring": list(base.springs),
    }
    for number, state in changed.items():
        kind, index, _ = choices[number]
        parts[kind][index] = state
    contacts, meshes, springs = (tuple(parts[kind]) for kind in ("contact", "mesh", "spring"))
    return States(contacts, meshes, springs, base.pieces)


def _distance(states: States, before: States | None) -> int:
    """In how many things states differ from before."""
    if before is None:
        return 0
    return sum(
        one != other
        for mine, others in zip(states[:3], before[:3], strict=True)
        for one, other in zip(mine, others, strict=True)
    )
