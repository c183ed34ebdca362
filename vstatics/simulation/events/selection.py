"""Selection of the states of contacts, mechanisms and springs immediately after an instant.

Among all admissible combinations of states, the combination with most sticking states is selected;
among equally many, the combination nearest to the preceding states. The search begins with all
candidates sticking, then lets a single candidate slip, and so on. A combination is admissible if no
margin is negative, and no margin of 0 falls.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from functools import lru_cache, partial
from itertools import chain
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.events.choices import ModeChoices
from vstatics.simulation.events.instants import Instant, Jump, consistent, motions_of, state_of
from vstatics.simulation.events.margins import LargeSizes, Margins, Watch, Watched
from vstatics.simulation.events.search import KIND_OF, Choice, ModeSearch
from vstatics.simulation.events.split import KnownLimits
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem, sign
from vstatics.simulation.system.ports import States
from vstatics.simulation.system.structure import MotionStructure, moves
from vstatics.simulation.tolerances import FALLING_MARGIN, STANDING, UNLIKE_INERTIAS

_AMPLE = 1e300
"""Finite substitute for an infinite margin, so that margins can be subtracted."""
_NEARER = (1.0, 1e-2, 1e-4)
"""Factors on the length of the look-ahead, tried in turn until one gives a result."""
_MOST_TURNED = 8
"""Largest number of iterations if torques a little later would reverse a slip that begins."""


class NoChoice(Exception):  # noqa: N818 - never raised to callers
    """Signal that no combination of states is admissible."""


class Selected(NamedTuple):
    """Admissible combination of states: margins, consistent state vector, and jump of twists."""

    margins: Margins
    state: Floats
    jump: Jump | None = None

    @property
    def equations(self) -> Equations:
        """Equations of motion of the combination."""
        return self.margins.equations

    @property
    def states(self) -> States:
        """States of all contacts, mechanisms, springs and laws."""
        return self.margins.equations.states


class ModesAsked(NamedTuple):
    """Request for the sticking and slipping states immediately after an instant."""

    at: Instant
    before: States | None
    scales: LargeSizes
    left: Sequence[States] = ()
    """Combinations that already ended at this instant and cannot be selected again."""
    met: Sequence[int] = ()
    """Indices of contacts whose slip ends at this instant."""


class ModeSelection:
    """Selection of sticking and slipping states in a system."""

    def __init__(self, system: MotionSystem) -> None:
        self.system = system
        self.structure = lru_cache(maxsize=512)(partial(MotionStructure, system))
        loose = self.structure((False,) * len(system.contacts), ("",) * len(system.meshes))
        self.choices = ModeChoices(system, loose)
        self.within = self.choices.within
        self.known: KnownLimits = {}

    def of(self, system: MotionSystem) -> ModeSelection:
        """Return the selection for the system with other programmes or settings."""
        if system is self.system and not self.choices.carrying:
            return self
        selection = copy(self)
        selection.system, selection.choices = system, copy(self.choices)
        selection.choices.system, selection.choices.carrying = system, {}
        return selection

    def select(self, asked: ModesAsked) -> Selected:
        """Return an admissible combination of states immediately after an instant.

        Raises
        ------
        NoChoice
        CaseError
            If the speed of a link without inertia is indeterminate.
        """
        ahead = copy(self)
        for nearer in _NEARER:
            ahead.within = nearer * self.within
            with suppress(NoChoice, CaseError):
                return ahead.selected(asked, thorough=False)
        return ahead.selected(asked, thorough=True)

    def selected(self, asked: ModesAsked, *, thorough: bool) -> Selected:
        """Return the first admissible combination of states; if `thorough`, search much longer."""
        at, before, scales, left, met = asked
        base, choices = self.choices.at(at, before, scales, met)
        search = ModeSearch(base, choices, before, partial(self._guess, asked))
        fault: CaseError | None = None
        spare: Selected | None = None
        tried: dict[States, list[Watch]] = {}
        for chosen in chain(search, search.others() if thorough else ()):
            states = self._driven(chosen, choices, at, scales)
            if states in tried:
                search.fails(states, tried[states], None)
                continue
            try:
                candidate, failing = self._tried(states, at, scales)
            except CaseError as error:
                fault, candidate, failing = fault or error, None, []
            except np.linalg.LinAlgError:
                candidate, failing = None, []
            if candidate is not None and candidate.states not in left:
                joined = self._joined(candidate.states, choices)
                if joined == candidate.states:
                    return candidate
                spare = spare or candidate  # used if the joined states fail by rounding
                candidate = self._admissible(joined, at, scales)
                if candidate is not None and candidate.states not in left:
                    return candidate
            failing = [watch for watch in failing if self._may_change(watch, states)]
            tried[states] = failing
            search.fails(states, failing, self._released(states, at, choices))
        if spare is not None:
            return spare
        if fault is not None:
            raise fault
        raise NoChoice

    def _admissible(self, states: States, at: Instant, scales: LargeSizes) -> Selected | None:
        try:
            return self._tried(states, at, scales)[0]
        except (CaseError, np.linalg.LinAlgError):
            return None

    def _joined(self, states: States, choices: Sequence[Choice]) -> States:
        """Return states in which contacts between rigidly connected links stick as well.

        Such a contact cannot slip, and its torque is redundant.
        """
        structure = self.structure(states.held, states.meshes)
        contacts = list(states.contacts)
        devices = self.system.contacts
        chosen = [index for kind, index, _ in choices if kind == "contacts"]
        chosen = [index for index in chosen if not devices[index].switch]
        rows = self.system.rows(devices[index].row for index in chosen)
        apart = moves(rows, structure.free, structure.light).tolist()
        for index, moving in zip(chosen, apart, strict=True):
            contacts[index] = contacts[index] if moving else "stick"
        return states._replace(contacts=tuple(contacts))

    def _guess(self, asked: ModesAsked) -> States | None:
        """Return the states selected a little later in a system where all links have inertia."""
        ahead = SelectionAhead(self.system)
        ahead.within = self.within
        return ahead.found(asked)

    def _driven(
        self, states: States, choices: Sequence[Choice], at: Instant, scales: LargeSizes
    ) -> States:
        """Return the states in which mechanisms move as the links with inertia require.

        While a gear is engaged, the speeds of links with inertia determine nearly all mechanisms.
        Only a mechanism next to slipping contacts can be undetermined: at rest, or with a speed
        that jumps.
        """
        options = {index: options for kind, index, options in choices if kind == "meshes"}
        motions = self._lossless(states) if options else None
        if motions is None:
            return states
        meshes = list(states.meshes)
        speeds = motions.free @ motions_of(self.system, motions, at)
        for index, (_, *moving) in options.items():
            slip = self.system.meshes[index].slip
            speed = float(slip @ speeds)
            if abs(speed) > STANDING * scales.speed and not moves(slip, motions.light):
                meshes[index] = next(state for state in moving if state[0] == sign(speed))
        return states._replace(meshes=tuple(meshes))

    def _may_change(self, watch: Watch, states: States) -> bool:
        """Return whether the mechanism of a margin can move while the sticking contacts stick."""
        if KIND_OF.get(watch.kind) != "meshes" or (motions := self._lossless(states)) is None:
            return True
        return bool(moves(self.system.meshes[watch.of].slip, motions.free, motions.light))

    def _lossless(self, states: States) -> MotionStructure | None:
        """Return the possible motions while contacts stick, None if the contacts contradict.

        The losses of moving mechanisms do not change the possible motions.
        """
        try:
            return self.structure(states.held, ("",) * len(states.meshes))
        except np.linalg.LinAlgError:
            return None

    def _released(self, states: States, at: Instant, choices: Sequence[Choice]) -> States | None:
        """Return the states in which mechanisms move that would move without friction, or None."""
        held = [
            index
            for kind, index, _ in choices
            if kind == "meshes" and states.meshes[index] == "stick"
        ]
        if not held:
            return None
        meshes = list(states.meshes)
        for index in held:
            meshes[index] = ""
        loose = states._replace(meshes=tuple(meshes))
        try:
            equations = self._equations(loose, at)
            _, torques = equations.acting(at.time, state_of(equations, at))
        except (CaseError, np.linalg.LinAlgError):
            return None
        structure = equations.structure
        turning = structure.free @ (structure.accelerations @ torques)
        carried = structure.torques @ torques
        least = STANDING * largest(turning)
        for index in held:
            slip = float(self.system.meshes[index].slip @ turning)
            flow = "+" if carried[index] >= 0 else "-"
            meshes[index] = sign(slip) + flow if abs(slip) > least else "stick"
        return states._replace(meshes=tuple(meshes))

    def _equations(self, states: States, at: Instant) -> Equations:
        structure = self.structure(states.held, states.meshes)
        rounding = STANDING * max(1.0, largest(at.speeds))
        equations = Equations(self.system, structure, states, at.time, rounding, at.carried)
        equations.last_light = structure.light.T @ at.speeds
        return equations

    def _tried(
        self, states: States, at: Instant, scales: LargeSizes
    ) -> tuple[Selected | None, list[Watch]]:
        """Try a combination of states; adjust power flows of mechanisms and pieces of laws.

        Returns the combination if it is admissible, and the failing margins otherwise.
        """
        tried = set()
        failing: list[Watch] = []
        acting = [load.when for load in self.system.outside if load.acts(states.contacts)]
        if any(sum(states.contacts[index] == "stick" for index, _ in when) > 1 for when in acting):
            return None, []  # a law cannot stick at two jumps, over speed and over angle
        while states not in tried:
            tried.add(states)
            equations = self._equations(states, at)
            state = state_of(equations, at)
            heavy, speeds = self.system.heavy, equations.structure.free @ state[: equations.motions]
            jump_of_bodies = largest(heavy @ speeds - heavy @ at.speeds)
            if jump_of_bodies > 100 * STANDING * scales.speed:  # inertia forbids jumps of speed
                return None, self._caught(states, at, scales)
            state, jump = consistent(equations, state, scales)
            equations.check_seen(at.time, state)
            if lacking := equations.lacking(at.time, state):
                raise CaseError([lacking])
            equations.changes.hold_limits(at.time, state)
            margins = Margins(equations, self.known)
            failing = self._failing(margins, at.time, state, scales)
            if not failing:
                return Selected(margins, state, jump), []
            only = all(watch.kind in ("flow", "piece") for watch in failing)
            turning = [
                watch
                for watch in failing
                if only or watch.kind == "flow" or watch.of in self.choices.frictions
            ]
            states = turned(states, turning)
        return None, failing

    def _caught(self, states: States, at: Instant, scales: LargeSizes) -> list[Watch]:
        """Return the margins of components that move at an instant but are assumed to stick."""
        kinds: Sequence[tuple[Watched, Iterable[Floats], Sequence[str]]] = (
            ("hold", (contact.row for contact in self.system.contacts), states.contacts),
            ("cone", (mesh.slip for mesh in self.system.meshes), states.meshes),
        )
        return [
            Watch(kind, index, 1 if slip > 0 else -1)
            for kind, rows, kept in kinds
            for index, slip in enumerate((self.system.rows(rows) @ at.speeds).tolist())
            if kept[index] == "stick" and abs(slip) > STANDING * scales.speed
        ]

    def _failing(
        self, margins: Margins, time: float, state: Floats, scales: LargeSizes
    ) -> list[Watch]:
        """Return the failing margins: negative, or 0 and falling."""
        units = margins.units(scales)[: margins.deciding]
        now = _finite(margins.at(time, state)[: margins.deciding])
        below = ~(now >= -STANDING * units)
        if below.any():
            return _failed(margins, time, state, np.where(below, now / units, np.inf))
        near = now <= STANDING * units
        if not near.any():
            return []
        ahead, then, least = self._ahead(margins, time, state)
        falls = near & (then - now < -least)
        sizes = np.where(falls, then / units, np.inf)
        failing = _failed(margins, time + self.within, ahead, sizes)
        # A mechanism that others hold at rest needs no friction, so its margins cannot fail.
        states = margins.equations.states
        return failing if any(self._may_change(watch, states) for watch in failing) else []

    def _ahead(self, margins: Margins, time: float, state: Floats) -> tuple[Floats, Floats, Floats]:
        """Return state and margins a little later, and the least significant change of each margin.

        Torques are evaluated at the later time, because a brake whose capacity begins at 0 carries
        nothing before. The brake changes a motion from rest only slightly. Its change is therefore
        compared with the speeds and torques at the later time only.
        """
        later, count, equations = time + self.within, margins.deciding, margins.equations
        ahead = state + self.within * equations.derivative(later, state)
        if margins.sees or equations.ports.looks:  # torques depend on the motion
            ahead = self._seen(margins, later, state, ahead)
        then = _finite(margins.at(later, ahead)[:count])
        structure, motions = equations.structure, np.abs(state[: equations.motions])
        acting = np.abs(equations.acting(later, ahead)[1])
        motions = motions + self.within * np.abs(structure.accelerations) @ acting
        speeds, torques = np.abs(structure.free) @ motions, np.abs(structure.torques) @ acting
        # the constraint torques do not contain the torque of a spring at its limit
        sprung = largest(acting[equations.layout.spring_ports])
        # A twist grows with a difference of speeds, whose rounding error is not zero at rest.
        twisted = self.within * largest(equations.ports.stiffness) * largest(speeds)
        sizes = LargeSizes(largest(speeds), max(largest(torques), sprung, twisted))
        return ahead, then, FALLING_MARGIN * margins.units(sizes)[:count]

    def _seen(self, margins: Margins, later: float, state: Floats, ahead: Floats) -> Floats:
        """Return the state a little later, under torques that depend on this later state.

        A steep law around zero slip can reverse a slip that is too small for the look-ahead. Such a
        slip counts as begun if the torques at zero slip start it.
        """
        slips = slice(len(margins.slipping))
        for _ in range(_MOST_TURNED):
            seen, ahead = ahead, state + self.within * margins.equations.derivative(later, ahead)
            before, then = (margins.at(later, vector)[slips] for vector in (seen, ahead))
            turned = (before > 0) & (then < 0)
            if not turned.any():
                return ahead
            share = (before[turned] / (before - then)[turned]).min()
            ahead = seen + share * (ahead - seen)
        return state + self.within * margins.equations.derivative(later, ahead)


class SelectionAhead(ModeSelection):
    """Selection by the margins a little later, with a small inertia on all links."""

    def __init__(self, system: MotionSystem) -> None:
        links = len(system.names)
        little = np.full(links, UNLIKE_INERTIAS * largest(system.inertias))
        super().__init__(
            replace(
                system,
                heavy=np.vstack([system.heavy, np.eye(links)]),
                inertias=np.append(system.inertias, little),
            )
        )

    def found(self, asked: ModesAsked) -> States | None:
        """Return the first admissible combination of states by block pivoting, if any."""
        search = ModeSearch(*self.choices.at(*asked[:3], asked.met), asked.before)
        for states in search.pivoting():
            try:
                selected, failing = self._tried(states, asked.at, asked.scales)
            except np.linalg.LinAlgError:
                return None
            if selected is not None:
                return selected.states
            search.fails(states, failing, None)
        return None

    def _failing(
        self, margins: Margins, time: float, state: Floats, scales: LargeSizes
    ) -> list[Watch]:
        ahead, then, least = self._ahead(margins, time, state)
        sizes = then / margins.units(scales)[: margins.deciding]
        return _failed(margins, time + self.within, ahead, np.where(then < -least, sizes, np.inf))


def _finite(margins: Floats) -> Floats:
    return np.where(np.isposinf(margins), _AMPLE, margins)


def _failed(margins: Margins, time: float, state: Floats, sizes: Floats) -> list[Watch]:
    """Return failing margins, worst first; torques at a limit replace a margin `split`."""
    failed: list[Watch] = []
    for index in np.argsort(sizes, kind="stable")[: int(np.isfinite(sizes).sum())]:
        watch = margins.watches[index]
        failed += margins.tight(time, state) if watch.kind == "split" else [watch]
    return [margins.breaking(watch, time, state) for watch in failed]


def turned(states: States, watches: Sequence[Watch]) -> States:
    """Return the states with reversed power flows and next linear pieces where margins fail."""
    meshes, pieces = list(states.meshes), list(states.pieces)
    for watch in watches:
        if watch.kind == "flow":
            state = meshes[watch.of]
            meshes[watch.of] = state[0] + ("-" if state[1] == "+" else "+")
        elif watch.kind == "piece":
            pieces[watch.of] += watch.side
    return states._replace(meshes=tuple(meshes), pieces=tuple(pieces))
