"""Corners of formulas that a motion reaches, and jumps along which the motion slides.

At a jump, both sides can drive the motion back to the jump. Then the motion slides along the jump,
until one of the sides drives it away.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy, deepcopy
from dataclasses import replace
from itertools import combinations, islice, product
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, quoted
from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.events.instants import Instant, seen_at
from vstatics.simulation.events.location import MarginEnd
from vstatics.simulation.events.margins import Awaited, LargeSizes
from vstatics.simulation.events.meetings import CornerMeetings, CornerPlace
from vstatics.simulation.events.sides import Judge, end_of_slide
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import SIGNS, MotionSystem
from vstatics.simulation.system.shares import LEAVING, Slide
from vstatics.simulation.system.sight import Compared, corners, with_settings
from vstatics.simulation.system.sliding import slides
from vstatics.simulation.tolerances import NEAR_JUMP, NO_STEP, SLIDING, STANDING

_MOST_SUBSETS = 200
"""Largest number of subsets of jumps, or of ways off them, that are tried at an instant."""
_MOST_SWITCHES = 500
"""Number of arrivals at a jump, at ever shorter intervals, above which a run stops."""
CURE_OF_JUMPS = "replace the jump with a ramp, or switch with a hysteresis in a sequence"
"""Advice if a formula jumps back and forth."""


class FormulaCorners:
    """Corners of formulas in a run: corners ahead, corners met, and slides along jumps.

    Parameters
    ----------
    system : MotionSystem
    """

    def __init__(self, system: MotionSystem) -> None:
        self.all = corners(system)
        self.meetings = CornerMeetings(system.scenario.span)
        self.slides: Mapping[CornerPlace, Slide] = {}
        """Jumps along which the motion slides."""
        self.slides_from = 0.0
        """Time at which the latest of these slides began. [s]"""
        self.fewer: list[list[CornerPlace]] = []
        """Subsets of `slides`, largest last, to try if the motion cannot slide along all."""
        self.smooth: set[CornerPlace] = set()
        """Jumps at which the formula was continuous when last reached."""
        self.watched: list[tuple[CornerPlace, Awaited]] = []
        """Nearest corners, each with the comparison that changes its sign there."""

    def copy(self) -> FormulaCorners:
        """Return an independent copy."""
        copied = copy(self)
        copied.meetings, copied.fewer = deepcopy(self.meetings), [*self.fewer]
        copied.smooth = {*self.smooth}
        return copied

    def is_jump(self, place: CornerPlace) -> bool:
        """Return whether the formula can jump at a corner."""
        return self.all[place.corner].jumps[place.number]

    def nearest(self, system: MotionSystem, judge: Judge) -> Iterator[tuple[CornerPlace, Awaited]]:
        """Yield the corners nearest to the present values, without bends that need no event."""
        for place, slide in self.slides.items():
            yield place, end_of_slide(system, slide.share)
        for index, corner in enumerate(self.all):
            for number, awaited in judge.nearest(corner.compared):
                place = CornerPlace(index, number)
                if place in self.slides:
                    continue
                jumps = corner.jumps[number] and place not in self.smooth
                if jumps or not self.meetings.is_passed(place, judge.now.time):
                    yield place, awaited

    def meet(self, system: MotionSystem, at: Instant, event: MarginEnd, end: float) -> MotionSystem:
        """Record the corners that an event reaches, and return the system with its slides.

        Parameters
        ----------
        system : MotionSystem
        at : Instant
            Instant of the event.
        event : MarginEnd
        end : float
            End of the run. [s]

        Raises
        ------
        CaseError
            If the motion switches back and forth at a jump without end.
        """
        met = [self.watched[watch.of] for watch in event.watches if watch.kind == "corner"]
        for place, _ in met:
            self.meetings.note(place, event.time)
        # A slide can end because the motion meets another jump, so slides come last.
        for place, judged in sorted(met, key=lambda each: each[0] in self.slides):
            if not self.is_jump(place):
                continue
            if place in self.slides:
                share = self.slides[place].share
                others = [near for near in self.slides if self.slides[near].share != share]
                return self.slide(system, at, others)
            hastens = place not in self.smooth and self.meetings.hastens(place, event.time, end)
            if self.meetings.switches(place, judged, hastens=hastens):
                self.smooth.discard(place)
                return self._slide_along_met(system, at, place)
            if hastens and self.meetings.counts[place] > _MOST_SWITCHES:
                why = "faster and faster, so the run does not reach its end"
                raise self._endless(place, event.time, why)
        return system

    def _slide_along_met(
        self, system: MotionSystem, at: Instant, place: CornerPlace
    ) -> MotionSystem:
        """Let the motion slide along a jump and the jumps met together with it."""
        watched = dict(self.watched)
        met = dict.fromkeys([place, *self.meetings.latest(at.time)])
        near = [jump for jump in met if jump in watched and self.is_jump(jump)]
        system = self.slide(system, at, [*dict.fromkeys([*self.slides, *near])])
        self.slides_from = at.time
        shares = {slide.share for slide in self.slides.values()}
        subsets = (
            [jump for jump in self.slides if self.slides[jump].share in fewer]
            for count in range(len(shares) - 1, 0, -1)
            for fewer in combinations(shares, count)
        )
        self.fewer = [*islice(subsets, _MOST_SUBSETS)][::-1]
        return system

    def slide(
        self, system: MotionSystem, at: Instant, places: Sequence[CornerPlace]
    ) -> MotionSystem:
        """Return the system whose motion slides along the jumps at some corners from now on."""
        pairs = [self.all[place.corner].compared[place.number] for place in places]
        jumps = [self.all[place.corner].places[place.number] for place in places]
        seen = seen_at(system, at)
        sizes = {place: NEAR_JUMP * awaited.size for place, awaited in self.watched}
        sizes |= {place: slide.near for place, slide in self.slides.items()}
        near = [
            sizes.get(place) or NEAR_JUMP * largest(np.array([*pair.at(at.time, seen), STANDING]))
            for place, pair in zip(places, pairs, strict=True)
        ]
        self.slides = dict(zip(places, slides(system, jumps, pairs, near), strict=True))
        system = _with_slides(system, self.slides.values())
        self.all = corners(system)
        return system

    def kept(
        self, equations: Equations, state: Floats, scales: LargeSizes, values: Floats
    ) -> list[CornerPlace] | None:
        """Return the jumps along which the motion slides on; None if these are all of `slides`.

        Parameters
        ----------
        equations : Equations
        state : ndarray
        scales : LargeSizes
            Large speed and torque of the run.
        values : ndarray
            Large value of each control state and temperature.

        Raises
        ------
        CaseError
            If both sides of a jump drive the motion back, and no mean keeps it on the jump.
        """
        time = math.nextafter(equations.time, math.inf)
        seen = equations.changes.seen_at(equations.time, state)
        rates = equations.rates(equations.time, state)[0]
        shares = equations.share(equations.time, state, rates)
        along = []
        for place, slide in self.slides.items():
            first, second = self.all[place.corner].compared[place.number].at(time, seen)
            is_near = abs(first - second) <= SLIDING / NEAR_JUMP * slide.near
            if is_near and abs(shares[slide.share]) <= 1 + STANDING:
                along.append(place)
        if len(along) == len(self.slides):
            return None
        if smooth := self._continuous(equations, state, scales, values):
            self.smooth |= smooth
            return [place for place in self.slides if place not in smooth]
        begins = equations.time <= self.slides_from
        if begins and self.fewer and len(self.fewer[-1]) > len(along):
            return self.fewer.pop()
        if begins and not along:
            why = (
                "without end: on each side of its jump the motion returns to the other side, and "
                "the program finds no mean of both sides that keeps the motion on the jump"
            )
            raise self._endless(next(iter(self.slides)), equations.time, why)
        return along

    def _continuous(
        self, equations: Equations, state: Floats, scales: LargeSizes, values: Floats
    ) -> set[CornerPlace]:
        """Return the corners in `slides` at which no torque and no rate of a state jumps now."""
        assert equations.sliding is not None  # noqa: S101 - there are slides
        rates, span = equations.rates(equations.time, state)[0], equations.system.scenario.span
        are_smooth = [
            largest(torques) <= NO_STEP * scales.torque
            and bool((np.abs(changes[:, 0]) * span <= NO_STEP * values[: len(changes)]).all())
            for torques, changes in equations.sliding.steps(equations.time, state, rates)
        ]
        return {place for place, slide in self.slides.items() if are_smooth[slide.share]}

    def _endless(self, place: CornerPlace, time: float, why: str) -> CaseError:
        corner = self.all[place.corner]
        message = f"at {time:.9g} s {quoted(corner.text)} switches back and forth {why}"
        return CaseError("E601", f"{message}; {CURE_OF_JUMPS}", corner.path)

    def jumps_met(
        self, system: MotionSystem, at: Instant
    ) -> Iterator[tuple[CornerPlace, Compared]]:
        """Yield the jumps of formulas whose compared terms are equal at an instant."""
        time, seen = math.nextafter(at.time, math.inf), seen_at(system, at)
        for index, corner in enumerate(self.all):
            for number, pair in enumerate(corner.compared):
                place = CornerPlace(index, number)
                can_see = max(pair.places, default=0) < system.layout.seen_shares
                if corner.jumps[number] and can_see and place not in self.slides:
                    first, second = pair.at(time, seen)
                    if abs(first - second) <= SLIDING * max(abs(first), abs(second), STANDING):
                        yield place, pair

    def ways(self, system: MotionSystem, at: Instant) -> Iterator[WayOffJumps]:
        """Yield ways in which the motion can leave, or slide along, the jumps at which it is now.

        The value of a formula for equal terms applies to no motion that leaves the jump. The value
        on a side applies if the motion under this value goes to this side, and the mean of both
        sides if the motion stays on the jump.
        """
        met = dict(self.jumps_met(system, at))
        jumps = [self.all[place.corner].places[place.number] for place in met]
        near = slides(system, jumps, [*met.values()], [0.0] * len(jumps))
        groups = len({slide.share for slide in near})
        combined = (
            sides
            for on_jump in range(groups + 1)
            for sides in product((1.0, -1.0, 0.0), repeat=groups)
            if sides.count(0.0) == on_jump
        )
        for sides in islice(combined, _MOST_SUBSETS if groups else 0):
            signs = [slide.sign * sides[slide.share] for slide in near]
            along = [place for place, sign in zip(met, signs, strict=True) if not sign]
            after, moved = copy(self), system
            if along:
                moved = after.slide(system, at, [*self.slides, *along])
                after.slides_from, after.fewer = at.time, []
            leaving = [
                slide._replace(share=LEAVING, sign=sign)
                for slide, sign in zip(near, signs, strict=True)
                if sign
            ]
            moved = _with_slides(moved, [*moved.slides, *leaving])
            yield WayOffJumps(after, moved, [*met.values()], signs)

    def without_left(self, system: MotionSystem, at: Instant) -> MotionSystem:
        """Return the system without the jumps that the motion has left since the last event."""
        if len(system.slides) == len(self.slides):
            return system
        return self.slide(system, at, [*self.slides])


class WayOffJumps(NamedTuple):
    """A way in which the motion can leave, or slide along, the jumps at which it is."""

    corners: FormulaCorners
    system: MotionSystem
    pairs: Sequence[Compared]
    """Terms that are equal at each jump."""
    signs: Sequence[float]
    """Side of each jump to which the motion goes; 0 if it stays on the jump."""

    def is_taken(self, equations: Equations, state: Floats, judge: Judge) -> bool:
        """Return whether the motion of the system goes this way."""
        rates = equations.rates(equations.time, state)[0]
        if not largest(equations.share(equations.time, state, rates)) <= 1 + STANDING:
            return False
        return all(
            not sign or SIGNS.get(judge.judged(pair).side) == sign
            for pair, sign in zip(self.pairs, self.signs, strict=True)
        )


def _with_slides(system: MotionSystem, along: Iterable[Slide]) -> MotionSystem:
    system = replace(system, slides=tuple(along))
    return with_settings(system, system.settings)
