"""Course of a run from event to event."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy

import numpy as np

from vstatics.core.errors import CaseError, listed
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.bounds import Guard
from vstatics.simulation.events.formula_corners import FormulaCorners
from vstatics.simulation.events.impacts import impact
from vstatics.simulation.events.instants import (
    Instant,
    break_times,
    instant_of,
    large_sizes,
)
from vstatics.simulation.events.location import Finder, MarginEnd
from vstatics.simulation.events.margins import FOLLOWING, LargeSizes, Watch
from vstatics.simulation.events.meetings import CornerPlace
from vstatics.simulation.events.selection import (
    ModesAsked,
    ModeSelection,
    NoChoice,
    Selected,
    turned,
)
from vstatics.simulation.events.sequence_commands import value_of, with_actions, with_states
from vstatics.simulation.events.sequences import SequenceProgress
from vstatics.simulation.events.sides import Judge
from vstatics.simulation.events.stops import StopCauses
from vstatics.simulation.events.stretches import Closed, KnownSolutions, NoFit
from vstatics.simulation.events.time_steps import StepTolerances, TimeStep, TooSmall, steps
from vstatics.simulation.record.record import Record
from vstatics.simulation.record.state_changes import StateChanges
from vstatics.simulation.record.words import event_of
from vstatics.simulation.scenario.parts import SequenceStep
from vstatics.simulation.scenario.programme import programmes
from vstatics.simulation.system.curves import is_limited, programme_at
from vstatics.simulation.system.devices import with_programmes
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS
from vstatics.simulation.system.ports import States
from vstatics.simulation.system.sight import corners, with_settings
from vstatics.simulation.tolerances import (
    LEAST_RTOL,
    NO_PROGRESS,
    SAME_INSTANT,
    SMALL_VALUE,
    STANDING,
    STEP_PART,
    STEP_PART_AT_CORNERS,
)

_MOST_EVENTS_AT_ONCE = 60
"""Number of nearly simultaneous events above which a run stops."""
_MANY_EVENTS_AT_ONCE = 30
"""Number of nearly simultaneous events above which the motion is tried on each side of jumps."""
_LOOSEST = 4096.0
"""Largest factor on tolerances of speed and torque while events repeat at an instant."""
_MOST_EVENTS = 100_000
"""Number of events above which a run stops."""
_BEHIND = 4.0
"""Shortest step tried across the corner of a formula, in units of the rounding error of time."""
_MOST_LARGER = 8
"""Largest number of attempts with explicit steps, each with a larger scale of control values."""
_FAR_FROM_JUMP = 1e3
"""Distance from a jump beyond which a motion does not slide along it, relative to `Slide.near`."""
_PATIENCE = 500
"""Number of events between checks of progress."""
_MOST_STEPS_AT_ONCE = 1000
"""Number of simultaneous sequence steps above which a run stops."""


class EventRun:
    """Run of a scenario from event to event, beginning at the start of a record.

    Parameters
    ----------
    record : Record
        Record with the system and the start.
    engaged : sequence of int
        Numbers of the shift elements engaged at the start.
    rtol : float
        Tolerance as in `simulate`. [-]
    watch : callable, optional
        Function that can stop the run; see `simulate`.
    """

    def __init__(
        self, record: Record, engaged: tuple[int, ...], rtol: float, watch: Guard | None = None
    ) -> None:
        self.record = record
        system = self.system = record.system
        self.selection = ModeSelection(system)
        self.sequences = [SequenceProgress(sequence) for sequence in system.scenario.sequences]
        self.inputs, self.engaged = system.scenario, engaged
        """`inputs` is the scenario with the shifts and dog clutches of finished sequence steps."""
        self.rtol, self.watch = rtol, watch
        self.duration = self.until = self.horizon = system.scenario.duration
        """`horizon` is the time until which bends and jumps of inputs (`breaks`) are known. [s]"""
        self.span = system.scenario.span
        self.corners = FormulaCorners(system)
        self._look_ahead()
        self.scales = large_sizes(system, record.start)
        self.at = record.start
        self.before: States | None = None
        """Sticking and slipping states before the present instant."""
        self.left: list[States] = []
        """States that ended at the present instant, so that they cannot be selected again."""
        self.met: list[int] = []
        """Indices of the contacts whose slip ended at the present instant."""
        self.at_limit: list[int] = []
        """Indices of the contacts that reached their torque limit at the present instant."""
        self.length: float | None = None
        """Length of the last time step. [s]"""
        self.solutions = KnownSolutions()
        self.too_small_at = math.nan
        """Time at which time steps became too small on a jump, so that its sides are tried. [s]"""
        self.latest = self.mark = 0.0
        self.at_once = self.events = 0

    def run(self, until: float) -> None:
        """Advance the run to a time [s].

        Raises
        ------
        CaseError
            If the run cannot go on.
        """
        self.until = until
        if until > self.horizon:
            self.horizon = 2 * until
            self._look_ahead()
        while self.at.time < until:
            selected = self._settled()
            equations = selected.equations
            breaks = (time for time in self.breaks if time > equations.time)
            due = (progress.next_time() for progress in self.sequences)
            end = min(next(breaks, until), until, *due)
            event = self._to_event(selected, end)
            self.system = self.corners.without_left(self.system, self.at)
            self._go(equations, instant_of(equations, event.time, event.state))
            self._record_ends(event)
            self.scales = self.scales._replace(
                speed=max(self.scales.speed, largest(self.at.speeds))
            )

    def copy(self) -> EventRun:
        """Return an independent copy of the run at the present time."""
        copied = copy(self)
        copied.record, copied.corners = self.record.copy(), self.corners.copy()
        copied.sequences = [copy(each) for each in self.sequences]
        copied.solutions = self.solutions.copy()
        return copied

    def give(self, step: SequenceStep, values: Mapping[str, float]) -> None:
        """Apply a sequence step now, regardless of its condition.

        Parameters
        ----------
        step : SequenceStep
        values : mapping of str to float
            Values of the numbers and states that the step sets.
        """
        at, system = self.at, self.system
        self.at = at._replace(values=with_states(system.scenario, at.values, values))
        before = [corner.places for corner in self.corners.all]
        if step.shift is not None or step.dogs:
            self.inputs = with_actions(self.inputs, self.engaged, at.time, step)
            system = with_programmes(system, programmes(self.inputs, self.engaged))
        settings = {name: values.get(name, value) for name, value in system.settings.items()}
        self.system = with_settings(system, settings)
        self._look_ahead()
        self.corners.all = corners(self.system)
        if self.corners.slides and before != [corner.places for corner in self.corners.all]:
            self._slide([])  # `slides` has the numbers of the corners before the step
        self.selection = self.selection.of(self.system)

    def _look_ahead(self) -> None:
        """Find the bends and jumps of inputs over time."""
        self.breaks = break_times(self.system, self.horizon)

    def _slide(self, places: Sequence[CornerPlace]) -> None:
        self.system = self.corners.slide(self.system, self.at, places)

    def _go(self, equations: Equations, at: Instant) -> None:
        self.at, self.before, self.met, self.at_limit = at, equations.states, [], []

    def _record_ends(self, event: MarginEnd) -> None:
        before = self.before
        if not event.watches or before is None:
            self.left = []
            return
        self.system = self.corners.meet(self.system, self.at, event, self.until)
        self._count(event)
        self.left = self.left if self.at_once else []
        if any(watch.kind not in FOLLOWING for watch in event.watches):
            self.left = [*self.left, before]
        self.before = turned(before, event.watches)
        self.met = [watch.of for watch in event.watches if watch.kind == "slip"]
        if self.corners.slides and self.corners.slides_from == event.time:
            # Contacts at rest can begin to slip while the motion switches back and forth.
            near, self.left = _FAR_FROM_JUMP * STANDING * self.scales.speed, []
            self.met += [
                index
                for index, contact in enumerate(self.system.contacts)
                if not contact.switch and abs(float(contact.row @ self.at.speeds)) <= near
            ]
        self.at_limit = [watch.of for watch in event.watches if watch.kind == "hold"]

    def _settled(self) -> Selected:
        """Apply all due sequence steps, and select the states of contacts after them."""
        self.selection = self.selection.of(self.system)
        for _ in range(_MOST_STEPS_AT_ONCE + 1):
            self.at, joined = self._joined(self.at, self.before)
            selected = self._selected()
            equations, state = selected.equations, selected.state
            if self.before is not None:
                standing = STANDING * self.scales.speed
                changes = StateChanges(self.record, self.selection, self.at.time, standing)
                changes.add(self.before, equations.states, joined)
            if not self._slides_on(equations, state):
                self.selection = self.selection.of(self.system)
                continue
            if not (self.sequences or self.corners.all):
                return selected
            judge = Judge(equations, self.at.time, state, self.scales, self.record.value_scales)
            if self._drags_otherwise(judge):
                continue
            asked = self.at.time, judge, self.record.happened
            due = next((each for each in self.sequences if each.is_due(*asked)), None)
            if due is None:
                self.record.cuts(self.system, judge.ahead)
                awaited = (
                    (number, comparison)
                    for number, progress in enumerate(self.sequences)
                    for comparison in progress.awaited(judge)
                )
                selected.margins.follow("awaited", awaited)
                self.corners.watched = [*self.corners.nearest(self.system, judge)]
                watched = (margin for _, margin in self.corners.watched)
                selected.margins.follow("corner", enumerate(watched))
                return selected
            self._go(equations, instant_of(equations, self.at.time, state))
            self.left = []
            self._do(due, judge.now)
        names = listed([progress.name for progress in self.sequences if progress.step], 6)
        raise CaseError(
            "E697",
            f"at {self.at.time:.9g} s more than {_MOST_STEPS_AT_ONCE} steps are done at "
            f"one instant by {names}; let a step wait for a time or an event",
            ("sequences",),
        )

    def _slides_on(self, equations: Equations, state: Floats) -> bool:
        """Return whether the motion slides on along all jumps; otherwise let it leave some."""
        if not self.corners.slides:
            return True
        values = self.record.value_scales / SMALL_VALUE
        along = self.corners.kept(equations, state, self.scales, values)
        if along is None:
            return True
        self._slide(along)
        return False

    def _drags_otherwise(self, judge: Judge) -> bool:
        """Return whether feedback control now closes or opens a shift element that has drag.

        The control is 0 at such an instant, so the motion a little later decides.
        """
        carrying, states = self.selection.choices.carrying, judge.equations.states
        for contact, state in zip(self.system.contacts, states.contacts, strict=True):
            element = contact.while_open
            if element is None or element in carrying:
                continue
            programme = self.system.by_element[element].programme
            carries = programme_at(programme, *judge.ahead) > 0
            if programme.look is not None and carries != (state == "open"):
                carrying[element] = carries
                return True
        return False

    def _do(self, due: SequenceProgress, seen: tuple[float, Sequence[float]]) -> None:
        step = due.step
        assert step is not None  # noqa: S101 - a due sequence has a step
        values = {
            name: value_of(self.system, value, *seen) for name, value in step.settings.items()
        }
        for name, value in values.items():
            if not math.isfinite(value):
                raise CaseError(
                    "E677",
                    f"at {seen[0]:.9g} s {name} is {value:g}, expected a number",
                    (*due.path, "set", name),
                )
        self.record.sets(self.at.time, values)
        self.give(step, values)
        self.record.done(self.at.time, due.sequence.name, due.go_on(self.at.time))

    def _count(self, event: MarginEnd) -> None:
        close = event.time - self.latest <= SAME_INSTANT * self.span
        self.at_once = self.at_once + 1 if close else 0
        self.latest = event.time
        self.events += 1
        stays = False
        if self.events % _PATIENCE == 0:
            stays = event.time - self.mark < NO_PROGRESS * self.span
            self.mark = event.time
        if stays or self.at_once > _MOST_EVENTS_AT_ONCE or len(self.record.events) > _MOST_EVENTS:
            raise self._causes(event.time).endless(event.watches[0])

    def _causes(self, time: float) -> StopCauses:
        return StopCauses(self.system, self.corners, self.sequences, time)

    def _selected(self) -> Selected:
        at, before, met = self.at, self.before, self.met
        # Rounding decides the order of simultaneous events, so tolerances grow with their number.
        slack = min(_LOOSEST, 4.0 ** max(0, self.at_once - 1))
        scales = LargeSizes(self.scales.speed * slack, self.scales.torque * slack)
        asked = ModesAsked(at, before, scales, self.left, met)
        fresh = asked._replace(left=())
        selected: Selected | None
        try:
            try:
                repeats = at.time == self.too_small_at or self.at_once > _MANY_EVENTS_AT_ONCE
                selected = (repeats and self._at_jumps(fresh)) or self.selection.select(asked)
            except NoChoice:
                selected = self.selection.select(fresh)
        except NoChoice:
            selected = self._at_jumps(fresh)
            if not selected:
                _, choices = self.selection.choices.at(at, before, self.scales, met)
                raise self._causes(at.time).no_state(choices) from None
        except np.linalg.LinAlgError:
            raise CaseError(
                "E603",
                f"at {at.time:.9g} s the equations of motion are singular; give links without "
                "inertia an inertia, or hold them",
            ) from None
        if selected.jump is not None:
            self.record.jumps(at.time, selected.jump)
        if len(self.at_limit) > 1:
            states = selected.states
            self._note_alternative(asked._replace(left=[*self.left, states]), states)
        return selected

    def _at_jumps(self, asked: ModesAsked) -> Selected | None:
        """Return a state in which the motion leaves, or slides along, the jumps at which it is."""
        for way in self.corners.ways(self.system, asked.at):
            selection = self.selection.of(way.system)
            with suppress(NoChoice, CaseError, np.linalg.LinAlgError):
                selected = selection.select(asked)
                equations, state = selected.equations, selected.state
                values = self.record.value_scales
                judge = Judge(equations, equations.time, state, self.scales, values)
                if way.is_taken(equations, state, judge):
                    self.corners, self.system, self.selection = way.corners, way.system, selection
                    return selected
        return None

    def _note_alternative(self, asked: ModesAsked, states: States) -> None:
        """Add a note on contacts that could break away instead of contacts in `states`."""
        try:
            other = self.selection.selected(asked, thorough=False)
        except (NoChoice, CaseError):
            return
        alternative = other.states
        broken = [
            {index for index in self.at_limit if candidate.contacts[index] != "stick"}
            for candidate in (states, alternative)
        ]
        if broken[0] != broken[1]:
            self.record.fits_too(asked.at.time, *broken)

    def _to_event(self, selected: Selected, end: float) -> MarginEnd:
        """Integrate up to the time `end`, or up to an event before `end`."""
        equations = selected.equations
        if end <= equations.time:
            return MarginEnd(end, selected.state, ())
        tolerances = self._tolerances(equations)
        equations.ports.until = math.nextafter(end, -math.inf)
        self.record.begin(selected.margins, selected.state)
        due = self._jumps_due(equations, selected.state) if self.at_once > 1 else ()
        if due and (behind := self._behind_corner(equations, end, due)):
            return behind
        finder = Finder(selected.margins, self.scales)
        try:
            for step in self._steps(selected, end, tolerances):
                self.length = step.next_length or step.end - step.start
                event = finder.event_in(step) or MarginEnd(step.end, step.last, ())
                finder.check_drags(event.time, event.state)
                self.record.step(step, event.time, event.state)
                reached = self.record.time
                if self.watch is not None and reached < self.until and (why := self.watch(reached)):
                    raise CaseError("E604", f"at {reached:.9g} s {why}")
                if event.watches:
                    at = event.time, event.state
                    broken = (selected.margins.breaking(watch, *at) for watch in event.watches)
                    return event._replace(watches=tuple(broken))
        except TooSmall:
            if behind := self._behind_corner(equations, end):
                return behind
            time, state = self.record.time, self.record.pieces[-1].states[-1]
            jumps = self.corners.jumps_met(self.system, instant_of(equations, time, state))
            if time == self.too_small_at or not any(jumps):
                causes, torque = self._causes(time), self.scales.torque
                raise CaseError([causes.too_small(equations, state, torque)]) from None
            self.too_small_at = time
            return MarginEnd(time, state, ())
        return MarginEnd(end, step.last, ())

    def _jumps_due(self, equations: Equations, state: Floats) -> set[int]:
        """Return the indices of watched jumps of formulas that occur immediately after a state.

        Until such a jump has occurred, a contact can alternate between two states.
        """
        sides = self._sides(equations, equations.time, state).tolist()
        return {
            index
            for index, (place, awaited) in enumerate(self.corners.watched)
            if SIGNS.get(awaited.side, sides[index]) != sides[index] and self.corners.is_jump(place)
        }

    def _behind_corner(
        self, equations: Equations, end: float, due: Collection[int] = ()
    ) -> MarginEnd | None:
        """Return the state just after a corner, or None if no corner is next to the last state.

        If indices of corners `due` are given, the state is behind all of them.

        The motion is extrapolated linearly across the corner. Integration would give a quantity
        that starts from 0 at the corner an error as large as the quantity.
        """
        time, state = self.record.time, self.record.pieces[-1].states[-1]
        before, change = self._sides(equations, time, state), equations.derivative(time, state)
        length = _BEHIND * math.ulp(time or self.span)
        while length <= SAME_INSTANT * self.span and time + length < end:
            at, there = time + length, state + length * change
            sides = self._sides(equations, at, there)
            passed = np.flatnonzero(sides * before < abs(sides)).tolist()
            if passed and {*passed}.issuperset(due):
                return MarginEnd(at, there, tuple(Watch("corner", index) for index in passed))
            length *= 2
        return None

    def _sides(self, equations: Equations, time: float, state: Floats) -> Floats:
        """Return the sign of the difference of the numbers compared at each watched corner."""
        seen = equations.changes.seen_at(time, state)
        both = (awaited.compared.at(time, seen) for _, awaited in self.corners.watched)
        return np.sign([first - second for first, second in both])

    def _steps(
        self, selected: Selected, end: float, tolerances: StepTolerances
    ) -> Iterator[TimeStep]:
        """Yield time steps up to a time, in closed form if possible, otherwise explicit."""
        equations, state = selected.equations, selected.state
        time = equations.time
        if equations.has_closed_form:
            try:
                closed = Closed(equations, state, self.scales.torque, self.solutions)
                for step in closed.steps(state, end):
                    yield step
                    time, state = step.end, step.last
            except NoFit:
                self.length = None
            else:
                return
        yield from self._explicit_steps(equations, (time, state), end, tolerances)

    def _explicit_steps(
        self,
        equations: Equations,
        begin: tuple[float, Floats],
        end: float,
        tolerances: StepTolerances,
    ) -> Iterator[TimeStep]:
        time, state = begin
        for _ in range(_MOST_LARGER):
            try:
                for step in steps(equations, (time, state), end, tolerances, self.length):
                    yield step
                    time, state = step.end, step.last
            except TooSmall:
                at_corner = self._behind_corner(equations, end)
                if at_corner or not self.record.leaves_zero(equations, time, state):
                    raise
                tolerances, self.length = self._tolerances(equations), None
            else:
                return
        raise TooSmall

    def _tolerances(self, equations: Equations) -> StepTolerances:
        part = STEP_PART_AT_CORNERS if self.system.varying else STEP_PART
        relative = max(part * self.rtol, LEAST_RTOL)
        absolute = np.empty(equations.size)
        speed, torque = self.scales
        absolute[: equations.motions] = relative * speed
        stiff = equations.ports.stiffness
        absolute[equations.twists] = relative * torque / np.where(stiff > 0, stiff, 1.0)
        absolute[equations.angles] = relative * speed * self.duration
        absolute[equations.values] = relative * self.record.value_scales
        absolute[equations.works.start :] = relative * self.record.energy_scale
        return StepTolerances(relative, absolute)

    def _joined(self, at: Instant, before: States | None) -> tuple[Instant, Collection[int]]:
        """Return the instant after an impact, and the indices of contacts that close at a slip."""
        system = self.system
        rigid = [
            index
            for index, contact in enumerate(system.contacts)
            if not (contact.one_way or is_limited(contact, at.time))
        ]
        joining = [
            index
            for index in rigid
            if (before is None or before.contacts[index] != "rigid")
            and abs(float(system.contacts[index].row @ at.speeds)) > STANDING * self.scales.speed
        ]
        if not joining:
            return at, joining
        after_impact = impact(system, at, rigid, joining)
        self.record.impact_work += after_impact.work
        for index, energy in zip(joining, after_impact.energies, strict=True):
            if at.time > 0:  # an impact at the start is not an event
                joined = event_of(at.time, system.contacts[index], "impact", energy)
                self.record.events.append(joined)
            self.record.impact += energy
        return at._replace(speeds=after_impact.speeds), joining
