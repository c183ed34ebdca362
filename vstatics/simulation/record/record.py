"""Record of a run, collected time step by time step, which returns the motion."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from copy import copy

import numpy as np

from vstatics.core.errors import Problem, listed, not_allowed
from vstatics.core.extras import higher
from vstatics.core.model.empty import EMPTY
from vstatics.core.numerics.arrays import Booleans, Floats, largest
from vstatics.core.statics.result_arrays import Message
from vstatics.simulation.events.impacts import kinetic_energy
from vstatics.simulation.events.instants import Instant, Jump
from vstatics.simulation.events.margins import Margins
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.record.account import energy_account
from vstatics.simulation.record.asked import empty_columns
from vstatics.simulation.record.drawn import DrawnRun
from vstatics.simulation.record.motion import Damage, Event, Motion, Reached
from vstatics.simulation.record.row_names import roads_of
from vstatics.simulation.record.segments import Piece, peaks
from vstatics.simulation.record.targets import first_reached
from vstatics.simulation.scenario.formula_code import Seen
from vstatics.simulation.scenario.programme import cut_note
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.known import DISTANCES
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import (
    EXACT_SIDES,
    LEAST_VALUE,
    MADE_CAPACITY,
    ROUNDED_INPUT,
    SAME_TIME,
    SAME_VALUES,
    SHARED_TORQUE,
    SMALL_VALUE,
)

_MOST_NUMBERS, _OF_A_STEP = 200_000, 300
"""Number of stored values above which time steps are reduced to instants, and number that a step
has in addition to its states.
"""


class Record:
    """Record of a run up to the simulated time.

    Parameters
    ----------
    system : MotionSystem
    start : Instant
    step : float, optional
        Spacing of additional instants. [s]
    asked : mapping of str to sequence of str
        Requested rows of additional tables.
    """

    def __init__(
        self,
        system: MotionSystem,
        start: Instant,
        step: float | None,
        asked: Mapping[str, Sequence[str]] = EMPTY,
    ) -> None:
        self.system, self.start, self.every = system, start, step
        self.events: list[Event] = []
        self.impact = 0.0
        self.impact_work = 0.0
        """Work of impacts at links with given speeds. [J]"""
        self.messages: list[Message] = []
        self.noted: set[Hashable] = set()
        """Subjects that already have a note: names of controls and states, or sets of contacts."""
        self.pieces: list[Piece] = []
        """Latest pieces of the run with all time steps; `drawn` contains the earlier pieces."""
        self.drawn, self.numbers = DrawnRun(system, step, asked), 0
        self.time = start.time
        self.energy_scale = max(kinetic_energy(system, start.speeds), 1.0)
        self.worked, self.stored = 0.0, 0.0
        self.value_scales = np.maximum(np.abs(start.values), LEAST_VALUE)
        """Scales of control states and temperatures, to which their tolerances are relative."""
        self.targets = [
            (link - 1, speed)
            for link, speeds in system.scenario.targets.items()
            for speed in speeds
        ]
        self.reached: dict[tuple[int, float], tuple[float, float]] = {}

    def copy(self) -> Record:
        """Return a copy that continues independently, without the recorded pieces."""
        copied = copy(self)
        copied.events, copied.messages, copied.pieces = [*self.events], [*self.messages], []
        copied.drawn = DrawnRun(self.system, self.every, self.drawn.table.asked)
        copied.numbers, copied.noted, copied.reached = 0, {*self.noted}, dict(self.reached)
        return copied

    @property
    def turnover(self) -> float:
        """Largest energy transferred or stored until now, the scale of errors of the balance [J].

        Net work is not a scale, because torques can cancel each other's work.
        """
        return max(self.worked, self.stored)

    def happened(self, seen: Seen, since: float) -> bool:
        """Return whether an event such as `locks` of a component has occurred since a time [s]."""
        return any(
            (event.element, event.event) == (seen.of, seen.word) and event.time >= since
            for event in self.events
        )

    def largest_slip(self, row: Floats) -> float:
        """Return the largest magnitude of a slip since the last event [rad/s].

        Parameters
        ----------
        row : ndarray, shape (links,)
            Coefficients of the speeds of links in the slip.
        """
        piece = self.pieces[-1]
        speeds_at = piece.margins.equations.speeds
        speeds = [speeds_at(*moment) for moment in zip(piece.times, piece.states, strict=True)]
        return largest(np.array(speeds) @ row)

    def done(self, time: float, sequence: str, step: int) -> None:
        """Record that a step of a sequence has acted at a time [s]."""
        self.events.append(Event(time, sequence, "step", None, "step", step))

    def jumps(self, time: float, jump: Jump) -> None:
        """Record the energy lost in a sudden change of twists, and add a warning."""
        self.impact += jump.energy
        text = (
            f"link {jump.link} has no inertia: at {time:.6g} s the torques on it jump, and it "
            "turns at once to where they balance"
        )
        self.messages.append(Message("W602", text))

    def sets(self, time: float, values: Mapping[str, float]) -> None:
        """Add a note if a sequence step sets a state beyond its limits, once for each state."""
        for state in self.system.scenario.states:
            beyond = state.beyond(values.get(state.name, state.start))
            if beyond and state.name not in self.noted:
                self.noted.add(state.name)
                text = f"at {time:.6g} s {state.name} is set beyond its limits: {beyond}"
                self.messages.append(Message("N611", f"{text}; it is kept at this limit"))

    def cuts(self, system: MotionSystem, now: tuple[float, Sequence[float]]) -> None:
        """Add a note if a control exceeds the capacity in the case, once for each control."""
        for device in system.may_slip:
            programme = device.programme
            if programme.look is None or programme.largest is None or device.name in self.noted:
                continue
            if programme.look.at(*now) > programme.largest * (1 + MADE_CAPACITY):
                self.noted.add(device.name)
                text = cut_note(now[0], device.name, programme.largest)
                self.messages.append(Message("N605", text))

    def fits_too(self, time: float, broken: Iterable[int], others: Iterable[int]) -> None:
        """Add a note that other contacts could break away instead, once for each combination."""
        if (both := frozenset([*broken, *others])) in self.noted:
            return
        self.noted.add(both)
        shown, alternatives = (
            listed([self.system.contacts[index].name for index in sorted(indices)])
            for indices in (broken, others)
        )
        text = (
            f"more than one set of slipping shift elements is consistent (first at {time:.6g} s): "
            f"{shown} is shown, {alternatives} could slip instead"
        )
        self.messages.append(Message("N606", text))

    def begin(self, margins: Margins, state: Floats) -> None:
        """Begin a piece of the run, with the equations of `margins`."""
        equations = margins.equations
        self.pieces.append(Piece(margins, equations.time, state))
        self.time = equations.time
        if margins.shared:
            self._tell_shared(equations)
        scale = max(
            kinetic_energy(self.system, equations.speeds(equations.time, state)),
            largest(state[equations.works]),
        )
        self.energy_scale = max(self.energy_scale, scale)
        self._update_stored_energy(equations, equations.time, state)

    def step(self, step: TimeStep, end: float, state: Floats) -> None:
        """Record a time step up to its end, or up to an event at the time `end` [s]."""
        if self.numbers > _MOST_NUMBERS:
            self._draw()
        piece = self.pieces[-1]
        if self.every:
            number = math.floor(step.start / self.every * (1 + SAME_TIME)) + 1
            while number * self.every < end * (1 - SAME_TIME):
                piece.add(number * self.every, step.exact(number * self.every))
                number += 1
        for place in range(len(step.nodes) - 1, len(step.times), len(step.nodes)):
            if step.times[place] < end:
                piece.add(float(step.times[place]), step.states[:, place])
        piece.add(end, state)
        piece.steps.append((step, end))
        self.time = end
        equations = piece.margins.equations
        values = np.abs(state[equations.values])
        self.value_scales = np.maximum(self.value_scales, SMALL_VALUE * values)
        self.worked += float(np.abs(state - step.first)[equations.works.start :].sum())
        self._update_stored_energy(equations, end, state)
        self._record_targets(step, end, state, equations)
        self.numbers += step.states.size + _OF_A_STEP

    def leaves_zero(self, equations: Equations, time: float, state: Floats) -> bool:
        """Return whether a control value is about to exceed its scale; if so, raise the scale.

        A value that leaves 0 cannot be integrated with a small error relative to itself. Its error
        is therefore relative to the magnitude that it soon reaches or, if that does not suffice
        because its rate is a rounding error, to ever larger magnitudes.
        """
        lengths = np.array(DISTANCES) * equations.within
        rates = [
            equations.derivative(time + length, equations.moved(time, state, length))
            for length in lengths.tolist()
        ]
        soon = lengths[-1] * np.abs(rates)[:, equations.values].max(axis=0)
        for part in SMALL_VALUE ** np.arange(1.0, -4.0, -1.0):
            grows = np.isfinite(soon) & (part * soon > 2 * self.value_scales)
            if grows.any():
                self.value_scales = np.where(grows, part * soon, self.value_scales)
                return True
        return False

    def _draw(self, *, hurried: bool = False) -> None:
        """Reduce all pieces to the instants for drawing, and begin a new piece."""
        self.drawn.add(self.pieces, hurried=hurried)
        last = self.pieces[-1]
        self.pieces, self.numbers = [Piece(last.margins, self.time, last.states[-1])], 0

    def _update_stored_energy(self, equations: Equations, time: float, state: Floats) -> None:
        kinetic = kinetic_energy(self.system, equations.speeds(time, state))
        elastic = self.system.elastic_energy(state[equations.twists])
        self.stored = max(self.stored, kinetic + elastic)

    def _record_targets(
        self, step: TimeStep, end: float, state: Floats, equations: Equations
    ) -> None:
        """Record the time and angle at which links first reach target speeds in a time step."""
        targets = [target for target in self.targets if target not in self.reached]
        if not targets:
            return
        times = np.append(step.start, step.times)
        moving = equations.speeds_at(times, np.column_stack([step.first, step.states]))
        for link, speed in targets:

            def speed_at(time: float, link: int = link) -> float:
                at = state if time == end else step.between(np.array([time]))[:, 0]
                return float(equations.speeds(time, at)[link])

            near = EXACT_SIDES * max(abs(speed), largest(moving[:, 0]))
            time = first_reached(step, moving[link], speed_at, speed, near)
            if time is not None and time <= end:
                at = step.between(np.array([time]))[:, 0]
                angle = float(at[equations.angles][equations.layout.angles.index(link)])
                self.reached[link, speed] = time, angle

    def motion(self, stopped: Problem | None, *, hurried: bool) -> Motion:
        """Return the motion, with fewer instants if `hurried` (after a time limit or Ctrl-C)."""
        self._draw(hurried=hurried)
        self._tell_backward()
        system, [last], table = self.system, self.pieces, self.drawn.table
        times, columns = self.drawn.times, self.drawn.columns
        distinct = _different(times, columns[: table.heat.start])
        times, columns = times[distinct], columns[:, distinct]
        speeds, slips, torques, *parts, heat = (columns[rows].T.copy() for rows in table.kinds)
        speeds, slips = (_without_noise(rates, largest(speeds)) for rates in (speeds, slips))
        asked = {
            name: dict(zip(rows, part.T, strict=True))
            for (name, rows), part in zip(table.asked.items(), parts, strict=True)
        }
        messages = [*self.messages, *empty_columns(asked)]
        damages: Mapping[str, Damage] = {}
        if system.case.fatigue:  # the annex `vehicle` calculates fatigue damage
            by_device = dict(zip(table.devices, torques.T, strict=True))
            damages = higher("damages")(system.case, by_device)
        return Motion(
            times,
            system.names,
            tuple(element.name for element in system.case.shift_elements),
            table.devices,
            speeds,
            slips,
            torques,
            heat,
            tuple(self.events),
            energy_account(
                self.start,
                self.time,
                last.margins.equations,
                last.states[-1],
                (self.impact, self.impact_work),
            ),
            peaks(table.devices, times, torques),
            tuple(self._reached()),
            tuple(not_allowed(dict.fromkeys(messages), self.system.case.untold)),
            stopped,
            asked,
            damages,
            self.drawn.picture_tables(distinct),
        )

    def _tell_backward(self) -> None:
        """Add a note for links that end opposite to a target speed, farther away than at first."""
        last = self.pieces[-1]
        speeds = last.margins.equations.speeds(self.time, last.states[-1]).tolist()
        for link, target in self.targets:
            first, end = float(self.start.speeds[link]), speeds[link]
            is_backward = end * target < 0 and abs(end - target) > abs(first - target)
            if is_backward and (link, target) not in self.reached:
                text = (
                    f"{self.system.names[link]} ends at {end:.6g} rad/s, opposite to its target of "
                    f"{target:.6g} rad/s: a single pair of gears reverses the direction, so check "
                    "the signs of ratios, torques and targets"
                )
                self.messages.append(Message("N613", text))

    def _tell_shared(self, equations: Equations) -> None:
        """Add a note on shift elements that share an indeterminate torque, once for each set."""
        structure, contacts = equations.structure, equations.system.contacts
        sharing = tuple(
            multiplier.of
            for row, multiplier in enumerate(structure.multipliers)
            if multiplier.kind == "contact"
            and contacts[multiplier.of].element is not None
            and largest(structure.redundant[row]) > SHARED_TORQUE
        )
        if len(sharing) < 2 or sharing in self.noted:
            return
        self.noted.add(sharing)
        names = ", ".join(contacts[index].name for index in sharing)
        text = (
            f"{names} together hold more than needed (first at {equations.time:.6g} s), so their "
            "torque split is indeterminate; the split with the smallest sum of squares is shown"
        )
        self.messages.append(Message("N602", text))

    def _reached(self) -> list[Reached]:
        roads = roads_of(self.system.scenario).items()
        radii = {link: law.radius for link, law in roads if not law.wheel}
        reached = []
        for link, speed in self.targets:
            time, angle = self.reached.get((link, speed), (math.nan, math.nan))
            distance = angle * radii.get(link + 1, math.nan)
            reached.append(Reached(self.system.names[link], speed, time, angle, distance))
        return reached


def _without_noise(rates: Floats, large: float) -> Floats:
    """Return columns of speeds, each rounded to 14 digits of its largest speed.

    Speeds that can be rounding errors of the speed `large` become 0.

    >>> _without_noise(np.array([[99.99999999999997, 1e-15], [7.0, 2.0]]), 100.0).tolist()
    [[100.0, 0.0], [7.0, 2.0]]
    """
    sizes = np.maximum(np.abs(rates).max(axis=0, initial=0.0), LEAST_VALUE)
    scales = 10.0 ** (13 - np.floor(np.log10(sizes)))
    return np.where(np.abs(rates) < ROUNDED_INPUT * large, 0.0, np.round(rates * scales) / scales)


def _different(times: Floats, columns: Floats) -> Booleans:
    """Return a mask without the second of two equal times, unless a column jumps there."""
    distinct = np.ones(len(times), dtype=bool)
    second = np.flatnonzero(np.diff(times) == 0) + 1
    before, after = columns[:, second - 1], columns[:, second]
    equal = np.isclose(before, after, rtol=SAME_VALUES, atol=SAME_VALUES)
    distinct[second] = ~equal.all(axis=0)
    return distinct
