"""Course of a run from event to event."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy, deepcopy
from dataclasses import replace
from itertools import combinations, islice, product

import numpy as np

from vstatics.core.errors import CaseError, Path, Problem, listed, quoted
from vstatics.core.model.parts import ShiftElement
from vstatics.core.model.springs import Spring
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.bounds import Guard
from vstatics.simulation.events.impacts import impact
from vstatics.simulation.events.instants import (
    Instant,
    break_times,
    instant_of,
    large_sizes,
    seen_at,
)
from vstatics.simulation.events.location import Finder, MarginEnd
from vstatics.simulation.events.margins import FOLLOWING, Awaited, LargeSizes, Watch
from vstatics.simulation.events.meetings import CornerMeetings, CornerPlace
from vstatics.simulation.events.search import KIND_OF, Kind
from vstatics.simulation.events.selection import (
    ModesAsked,
    ModeSelection,
    NoChoice,
    Selected,
    turned,
)
from vstatics.simulation.events.sequence_commands import value_of, with_actions, with_states
from vstatics.simulation.events.sequences import SequenceProgress
from vstatics.simulation.events.sides import Judge, end_of_slide
from vstatics.simulation.events.stretches import Closed, KnownSolutions, NoFit
from vstatics.simulation.events.time_steps import StepTolerances, TimeStep, TooSmall, steps
from vstatics.simulation.events.unbounded import unbounded
from vstatics.simulation.record.motion import EventKind
from vstatics.simulation.record.record import Record
from vstatics.simulation.record.words import event_of, released, slid_back
from vstatics.simulation.scenario.parts import SequenceStep
from vstatics.simulation.scenario.programme import programmes
from vstatics.simulation.system.curves import capacity_at, programme_at
from vstatics.simulation.system.devices import with_programmes
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, Contact, Elastic
from vstatics.simulation.system.ports import SIGNS_OF_MESHES, States
from vstatics.simulation.system.shares import LEAVING, Slide
from vstatics.simulation.system.sight import Compared, Corner, control_path, corners, with_settings
from vstatics.simulation.system.sliding import slides
from vstatics.simulation.system.structure import moves
from vstatics.simulation.tolerances import (
    AHEAD_OF_STOP,
    BEYOND_ALL,
    LEAST_RTOL,
    NEAR_JUMP,
    NO_PROGRESS,
    NO_STEP,
    SAME_INSTANT,
    SIGHT,
    SLIDING,
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
_MOST_SUBSETS = 200
"""Largest number of subsets of jumps met together along which the motion may slide."""
_MOST_SWITCHES = 500
"""Number of arrivals at a jump, faster and faster, above which a run stops."""
_PATIENCE = 500
"""Number of events between checks of progress."""
_MOST_STEPS_AT_ONCE = 1000
"""Number of simultaneous sequence steps above which a run stops."""
_CURE_OF_JUMPS = "replace the jump with a ramp, or switch with a hysteresis in a sequence"


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
        self.meetings = CornerMeetings(self.span)
        self.slides: Mapping[CornerPlace, Slide] = {}
        """Corners along which the motion slides."""
        self.slides_from = 0.0
        """Time at which the latest of these slides began. [s]"""
        self.fewer: list[list[CornerPlace]] = []
        """Subsets of `slides`, largest last, to try if the motion cannot slide along all."""
        self.smooth: set[CornerPlace] = set()
        """Corners at which a formula could jump, but was continuous when last reached."""
        self.watched: list[tuple[CornerPlace, Awaited]] = []
        """Nearest corners of formulas, each with the comparison that changes its sign there."""
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
            if len(self.system.slides) > len(self.slides):  # the motion has left jumps
                self._slide([*self.slides])
            self._go(equations, instant_of(equations, event.time, event.state))
            self._record_ends(event)
            self.scales = self.scales._replace(
                speed=max(self.scales.speed, largest(self.at.speeds))
            )

    def copy(self) -> EventRun:
        """Return an independent copy of the run at the present time."""
        copied = copy(self)
        copied.record, copied.meetings = self.record.copy(), deepcopy(self.meetings)
        copied.sequences, copied.fewer = [copy(each) for each in self.sequences], [*self.fewer]
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
        before = [corner.places for corner in self.corners]
        if step.shift is not None or step.dogs:
            self.inputs = with_actions(self.inputs, self.engaged, at.time, step)
            system = with_programmes(system, programmes(self.inputs, self.engaged))
        settings = {name: values.get(name, value) for name, value in system.settings.items()}
        self.system = with_settings(system, settings)
        self._look_ahead()
        if self.slides and before != [corner.places for corner in self.corners]:
            self._slide([])  # `slides` has the numbers of the corners before the step
        self.selection = self.selection.of(self.system)

    def _look_ahead(self) -> None:
        """Find the bends and jumps of inputs over time, and the corners of formulas."""
        self.breaks = break_times(self.system, self.horizon)
        self.corners = corners(self.system)

    def _go(self, equations: Equations, at: Instant) -> None:
        self.at, self.before, self.met, self.at_limit = at, equations.states, [], []

    def _record_ends(self, event: MarginEnd) -> None:
        before = self.before
        if not event.watches or before is None:
            self.left = []
            return
        self._meet(event)
        self._count(event)
        self.left = self.left if self.at_once else []
        if any(watch.kind not in FOLLOWING for watch in event.watches):
            self.left = [*self.left, before]
        self.before = turned(before, event.watches)
        self.met = [watch.of for watch in event.watches if watch.kind == "slip"]
        if self.slides and self.slides_from == event.time:
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
            self._record_changes(self.at.time, self.before, equations.states, joined)
            if self.slides and not self._slides_on(equations, state):
                self.selection = self.selection.of(self.system)
                continue
            if not (self.sequences or self.corners):
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
                self.watched = [*self._near_corners(judge)]
                selected.margins.follow("corner", enumerate((margin for _, margin in self.watched)))
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

    def _near_corners(self, judge: Judge) -> Iterator[tuple[CornerPlace, Awaited]]:
        """Yield the corners nearest to the present values, without bends that need no event."""
        for place, slide in self.slides.items():
            yield place, end_of_slide(self.system, slide.share)
        for index, corner in enumerate(self.corners):
            for number, awaited in judge.nearest(corner.compared):
                place = CornerPlace(index, number)
                if place in self.slides:
                    continue
                jumps = corner.jumps[number] and place not in self.smooth
                if jumps or not self.meetings.is_passed(place, self.at.time):
                    yield place, awaited

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

    def _meet(self, event: MarginEnd) -> None:
        """Record the corners that an event reaches; raise an error on endless switching there."""
        met = [self.watched[watch.of] for watch in event.watches if watch.kind == "corner"]
        for place, _ in met:
            self.meetings.note(place, event.time)
        # A slide can end because the motion meets another jump, so slides come last.
        for place, judged in sorted(met, key=lambda each: each[0] in self.slides):
            corner = self.corners[place.corner]
            if not corner.jumps[place.number]:
                continue
            if place in self.slides:
                share = self.slides[place].share
                self._slide([near for near in self.slides if self.slides[near].share != share])
                return
            hastens = place not in self.smooth and self.meetings.hastens(
                place, event.time, self.until
            )
            if self.meetings.switches(place, judged, hastens=hastens):
                self.smooth.discard(place)
                latest = self.meetings.latest(event.time)
                watched = dict(self.watched)
                near_jumps = [
                    near
                    for near in dict.fromkeys([place, *latest])
                    if near in watched and self.corners[near.corner].jumps[near.number]
                ]
                self._slide(list(dict.fromkeys([*self.slides, *near_jumps])))
                self.slides_from = event.time
                shares = {slide.share for slide in self.slides.values()}
                subsets = (
                    [near for near in self.slides if self.slides[near].share in fewer]
                    for count in range(len(shares) - 1, 0, -1)
                    for fewer in combinations(shares, count)
                )
                self.fewer = [*islice(subsets, _MOST_SUBSETS)][::-1]
                return
            if hastens and self.meetings.counts[place] > _MOST_SWITCHES:
                why = "faster and faster, so the run does not reach its end"
                raise self._endless(place, event.time, why)

    def _endless(self, place: CornerPlace, time: float, why: str) -> CaseError:
        corner = self.corners[place.corner]
        message = f"at {time:.9g} s {quoted(corner.text)} switches back and forth {why}"
        return CaseError("E601", f"{message}; {_CURE_OF_JUMPS}", corner.path)

    def _slide(self, places: Sequence[CornerPlace]) -> None:
        """Let the motion slide along the jumps of formulas at some corners from now on."""
        pairs = [self.corners[place.corner].compared[place.number] for place in places]
        jumps = [self.corners[place.corner].places[place.number] for place in places]
        seen = seen_at(self.system, self.at)
        sizes = {place: NEAR_JUMP * awaited.size for place, awaited in self.watched}
        sizes |= {place: slide.near for place, slide in self.slides.items()}
        near = [
            sizes.get(place)
            or NEAR_JUMP * largest(np.array([*pair.at(self.at.time, seen), STANDING]))
            for place, pair in zip(places, pairs, strict=True)
        ]
        self.slides = dict(zip(places, slides(self.system, jumps, pairs, near), strict=True))
        system = replace(self.system, slides=tuple(self.slides.values()))
        self.system = with_settings(system, system.settings)
        self.corners = corners(self.system)

    def _slides_on(self, equations: Equations, state: Floats) -> bool:
        """Return whether the motion slides along all corners in `slides`; remove other corners."""
        time = math.nextafter(equations.time, math.inf)
        seen = equations.changes.seen_at(equations.time, state)
        shares = equations.share(equations.time, state, equations.rates(equations.time, state)[0])
        along = []
        for place, slide in self.slides.items():
            first, second = self.corners[place.corner].compared[place.number].at(time, seen)
            is_near = abs(first - second) <= SLIDING / NEAR_JUMP * slide.near
            if is_near and abs(shares[slide.share]) <= 1 + STANDING:
                along.append(place)
        if len(along) == len(self.slides):
            return True
        if smooth := self._continuous(equations, state):
            self.smooth |= smooth
            self._slide([place for place in self.slides if place not in smooth])
            return False
        begins = equations.time <= self.slides_from
        if begins and self.fewer and len(self.fewer[-1]) > len(along):
            along = self.fewer.pop()
        if begins and not along:
            why = (
                "without end: on each side of its jump the motion returns to the other side, and "
                "the program finds no mean of both sides that keeps the motion on the jump"
            )
            raise self._endless(next(iter(self.slides)), equations.time, why)
        self._slide(along)
        return False

    def _continuous(self, equations: Equations, state: Floats) -> set[CornerPlace]:
        """Return the corners in `slides` at which no torque and no rate of a state jumps now."""
        assert equations.sliding is not None  # noqa: S101 - there are slides
        steps = equations.sliding.steps(
            equations.time, state, equations.rates(equations.time, state)[0]
        )
        values = self.record.value_scales / SMALL_VALUE
        are_smooth = [
            largest(torques) <= NO_STEP * self.scales.torque
            and bool((np.abs(rates[:, 0]) * self.span <= NO_STEP * values[: len(rates)]).all())
            for torques, rates in steps
        ]
        return {place for place, slide in self.slides.items() if are_smooth[slide.share]}

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
            watch = event.watches[0]
            name, path = self._owner(watch)
            message = (
                f"at {event.time:.9g} s {name} alternates between sticking and slipping without "
                "end, so the run cannot continue; let its torque change steadily with the speed, "
                "or give its links an inertia or a damper"
            )
            if watch.kind in FOLLOWING:
                message = (
                    f"at {event.time:.9g} s {name} is reached again and again without end, so "
                    f"the run cannot continue; {_CURE_OF_JUMPS}"
                )
            raise CaseError("E601", message, path)

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
                raise self._no_state() from None
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
        """Return a state in which the motion leaves, or slides along, the jumps at which it is now.

        The value of a formula for equal terms applies to no motion that leaves the jump. The value
        on a side applies if the motion under this value goes to this side, and the mean of both
        sides if the motion stays on the jump.
        """
        met = dict(self._jumps_met(asked.at))
        jumps = [self.corners[place.corner].places[place.number] for place in met]
        near = slides(self.system, jumps, [*met.values()], [0.0] * len(jumps))
        groups = len({slide.share for slide in near})
        ways = (
            way
            for on_jump in range(groups + 1)
            for way in product((1.0, -1.0, 0.0), repeat=groups)
            if way.count(0.0) == on_jump
        )
        before = self.slides, self.system, self.corners, self.selection
        for way in islice(ways, _MOST_SUBSETS if groups else 0):
            signs = [slide.sign * way[slide.share] for slide in near]
            along = [place for place, sign in zip(met, signs, strict=True) if not sign]
            if along:
                self._slide([*self.slides, *along])
            leaving = [
                slide._replace(share=LEAVING, sign=sign)
                for slide, sign in zip(near, signs, strict=True)
                if sign
            ]
            self.system = replace(self.system, slides=(*self.system.slides, *leaving))
            self.system = with_settings(self.system, self.system.settings)
            self.selection = self.selection.of(self.system)
            with suppress(NoChoice, CaseError, np.linalg.LinAlgError):
                selected = self.selection.select(asked)
                if self._follows(selected, [*met.values()], signs):
                    if along:
                        self.slides_from, self.fewer = asked.at.time, []
                    return selected
            self.slides, self.system, self.corners, self.selection = before
        return None

    def _jumps_met(self, at: Instant) -> Iterator[tuple[CornerPlace, Compared]]:
        """Yield the jumps of formulas whose compared terms are equal at an instant."""
        time, seen = math.nextafter(at.time, math.inf), seen_at(self.system, at)
        for index, corner in enumerate(self.corners):
            for number, pair in enumerate(corner.compared):
                place = CornerPlace(index, number)
                can_see = max(pair.places, default=0) < self.system.layout.seen_shares
                if corner.jumps[number] and can_see and place not in self.slides:
                    first, second = pair.at(time, seen)
                    if abs(first - second) <= SLIDING * max(abs(first), abs(second), STANDING):
                        yield place, pair

    def _follows(
        self, selected: Selected, pairs: Sequence[Compared], signs: Sequence[float]
    ) -> bool:
        """Return whether a motion goes to the given sides of jumps; 0 if it stays on the jump."""
        equations, state = selected.equations, selected.state
        rates = equations.rates(equations.time, state)[0]
        if not largest(equations.share(equations.time, state, rates)) <= 1 + STANDING:
            return False
        judge = Judge(equations, equations.time, state, self.scales, self.record.value_scales)
        return all(
            not sign or SIGNS.get(judge.judged(pair).side) == sign
            for pair, sign in zip(pairs, signs, strict=True)
        )

    def _no_state(self) -> CaseError:
        at = self.at
        _, choices = self.selection.choices.at(at, self.before, self.scales, self.met)
        named = [(kind, index) for kind, index, _ in choices if kind != "pieces"]
        if corner := self._jump_of(named):
            return CaseError(
                "E601",
                f"at {at.time:.9g} s no state is admissible on either side of the jump of "
                f"{quoted(corner.text)}; {_CURE_OF_JUMPS}",
                corner.path,
            )
        names = [self._name_of(kind, index) for kind, index in named]
        message = (
            f"at {at.time:.9g} s no state is consistent with the torques: neither sticking nor "
            f"slipping of {', '.join(names) or 'any component'}"
        )
        light = np.flatnonzero(~self.system.heavy.any(axis=0)).tolist()
        if not light:
            return CaseError("E602", message)
        links = listed([self.system.names[link] for link in light], 6)
        message += f"; the speeds of links without inertia can jump: give {links} an inertia"
        return CaseError("E602", message, ("case", "inertias"))

    def _jump_of(self, choices: Collection[tuple[Kind, int]]) -> Corner | None:
        """Return a jump of a formula that is reached now, or was reached by a law in `choices`."""
        now = self.meetings.latest(self.at.time)
        earlier = [place for place in self.meetings.times if place not in now]
        paths = {self._path_of(*choice) for choice in choices}
        for place in (*now, *earlier):
            corner = self.corners[place.corner]
            if corner.jumps[place.number] and (place in now or corner.path in paths):
                return corner
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
                    return event
        except TooSmall:
            if behind := self._behind_corner(equations, end):
                return behind
            time, state = self.record.time, self.record.pieces[-1].states[-1]
            jumps = self._jumps_met(instant_of(equations, time, state))
            if time == self.too_small_at or not any(jumps):
                raise CaseError([self._too_small(equations)]) from None
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
            for index, (place, awaited) in enumerate(self.watched)
            if SIGNS.get(awaited.side, sides[index]) != sides[index]
            and self.corners[place.corner].jumps[place.number]
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
        both = (awaited.compared.at(time, seen) for _, awaited in self.watched)
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

    def _too_small(self, equations: Equations) -> Problem:
        """Return the reason for too small time steps, such as a torque that is invalid or jumps."""
        time, state = self.record.time, self.record.pieces[-1].states[-1]
        change = equations.derivative(time, state)
        for ahead in AHEAD_OF_STOP:
            at = time + ahead * self.duration
            moved = state + (at - time) * change
            if lacking := equations.lacking(at, moved):
                return lacking
            _, torques = equations.acting(at, state)
            if np.isfinite(moved).all():
                later = equations.acting(at, moved)[1]
                torques = np.where(np.isfinite(later), torques, later)
            for load, torque in zip(self.system.outside, torques.tolist(), strict=False):
                name = self.system.names[load.link]
                what = f"at {at:.6g} s the torque on {name} is {torque:g}"
                if not math.isfinite(torque):
                    return Problem("E605", f"{what}, expected a number", ("torques", name))
                if abs(torque) > BEYOND_ALL * self.scales.torque:
                    return Problem("E606", f"{what} N*m: it grows without bound", ("torques", name))
            if problem := unbounded(equations, time, at, state):
                return problem
        return self._too_steep(equations, time, state)

    def _too_steep(self, equations: Equations, time: float, state: Floats) -> Problem:
        """Return a problem at the latest corner, or for the torque that changes most with speed."""
        for place in self.meetings.latest(time)[:1]:
            corner = self.corners[place.corner]
            message = (
                f"at {time:.9g} s no time step is small enough at a corner of "
                f"{quoted(corner.text)}: next to it a value changes too steeply, or is not a number"
            )
            return Problem("E608", message, corner.path)
        message = (
            f"at {time:.9g} s no time step is small enough: a torque jumps with the speed, or "
            "changes too steeply with it; write dry friction of a load as `resistance`"
        )
        slopes = np.abs(equations.slopes_by_rate(time, state)[: self.system.layout.outside])
        if not slopes.any():
            return Problem("E608", message)
        name = self.system.names[self.system.outside[int(slopes.argmax())].link]
        return Problem("E608", message, ("torques", name))

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
        rigid: list[int] = []
        joining: list[int] = []
        for index, contact in enumerate(system.contacts):
            if contact.one_way or contact.while_open is not None:
                continue
            if contact.programme.look is None and math.isinf(capacity_at(contact, at.time)):
                rigid.append(index)
                slip = abs(float(contact.row @ at.speeds))
                if slip > STANDING * self.scales.speed and (
                    before is None or before.contacts[index] != "rigid"
                ):
                    joining.append(index)
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

    def _record_changes(
        self, time: float, before: States | None, states: States, joined: Collection[int]
    ) -> None:
        """Record the changes of states, except for contacts that have closed in an impact."""
        if before is None:
            return
        for index, contact in enumerate(self.system.contacts):
            if not (contact.is_drag or index in joined):
                change = before.contacts[index], states.contacts[index]
                self._record_change(time, contact, *change)
        for index, spring in enumerate(self.system.springs):
            self._record_change(time, spring, before.springs[index], states.springs[index])
        self._record_meshes(time, before, states)

    def _record_meshes(self, time: float, before: States, states: States) -> None:
        """Record the mechanisms that begin or cease to stick, if only friction holds them."""
        changes = zip(self.system.meshes, before.meshes, states.meshes, strict=True)
        for mesh, earlier, later in changes:
            locks = earlier in SIGNS_OF_MESHES and later == "stick"
            if locks or (earlier == "stick" and later in SIGNS_OF_MESHES):
                held = (states if locks else before).held
                loose = self.selection.structure(held, ("",) * len(states.meshes))
                if moves(mesh.slip, loose.free, loose.light):
                    kind: EventKind = "locks" if locks else "slips"
                    self.record.events.append(event_of(time, mesh, kind))

    def _owner(self, watch: Watch) -> tuple[str, Path]:
        """Return the name of the owner of a margin, and its path in the scenario."""
        match watch.kind:
            case "split":
                return "a group of sticking components", ()
            case "corner":
                corner = self.corners[self.watched[watch.of][0].corner]
                return quoted(corner.text), corner.path
            case "state":
                name = self.system.scenario.states[watch.of].name
                return f"the state {name}", ("states", name)
            case "awaited":
                progress = self.sequences[watch.of]
                return f"the sequence {progress.name}", progress.path
            case "piece":
                return self._name_of_law(watch.of), ()
        kind = KIND_OF.get(watch.kind) or "meshes"  # the power of a mechanism changes its direction
        return self._name_of(kind, watch.of), self._path_of(kind, watch.of)

    def _path_of(self, kind: Kind, index: int) -> Path:
        scenario, system = self.system.scenario, self.system
        device = getattr(system, kind)[index] if kind in ("contacts", "springs") else None
        if device is None:
            return ()
        if isinstance(device, Contact) and device.switch:
            return "torques", device.name
        key, name = path = control_path(device)
        given: Collection[int] = scenario.controls or ()
        parts: Sequence[ShiftElement | Spring] = system.case.shift_elements
        if key == "limits":
            given, parts = scenario.limits, system.case.springs
        return path if name in (parts[number - 1].name for number in given) else ()

    def _name_of(self, kind: Kind, index: int) -> str:
        return str(getattr(self.system, kind)[index].name)

    def _name_of_law(self, index: int) -> str:
        """Return the name of a law, by its index in `States.pieces`."""
        outside, frictions = self.system.layout.outside, self.system.layout.frictions
        if index >= frictions:
            return self.system.may_slip[index - frictions].name
        if index >= outside:
            return self.system.converters[index - outside].name
        return f"the torque on {self.system.names[self.system.outside[index].link]}"

    def _record_change(
        self, time: float, device: Contact | Elastic, before: str, after: str
    ) -> None:
        sticks = ("stick", "rigid", "parted")  # a spring that parts within its play is not slipping
        kind: EventKind | None = None
        if before in sticks and after not in sticks:
            kind = "slips"
        elif (before in SIGNS and after in sticks) or (before == "open" and after == "rigid"):
            kind = "locks"
        elif {before, after} == {*SIGNS}:
            # A contact without capacity can be at rest. Then it begins to slip instead of
            # reversing.
            slips = self.record.largest_slip(device.row) > STANDING * self.scales.speed
            kind = "reverses" if slips else "slips"
            if kind == "slips" and self._is_slipping(device, time):
                return
        if kind is not None:
            event = event_of(time, device, kind)
            event = released(event) if after == "open" else event
            self.record.events.append(slid_back(event) if after == "-" else event)

    def _is_slipping(self, device: Contact | Elastic, time: float) -> bool:
        """Return whether a contact or spring began to slip right before a time [s].

        The direction of such a slip can be wrong, if the slip was too small for the look-ahead.
        """
        near = SIGHT * self.span
        events = reversed(self.record.events)
        last = next((event for event in events if event.element == device.name), None)
        if last is None:
            return time <= near
        return last.event == "slips" and time - last.time <= near
