"""Tarasik's published simulation of a gearbox with two degrees of freedom.

    dw_in/dt  = [M_in - M_f sign(w_f) (1 - L) - M_out L P/(u eta)]/(J_in + J_out L/u^2)
    dw_out/dt = {[M_in L P + M_f sign(w_f) (1 - L)] u eta - M_out}/(J_in L u^2 + J_out)     (12)
    w_f = w_in - u w_out                                                                    (13)

M_in and M_out are the external torques, M_f the capacity of the clutch, u and eta the ratio and
efficiency of the engaged gear. L = 1 after the clutch has locked up, otherwise 0; P = 1 while M_f
exceeds the transmitted torque. `TwoMasses.input_inertia` calculates J_in. Equation (12) omits the
rate of change of a lumped inertia and its share at the output, so the energy does not balance; a
message reports the deviation. Errors that would stop the method at once are corrected: M_f is
reduced to the input, (14) uses the magnitude of w_f and (15) the magnitude of u, and a clutch that
does not hold slips.

Source: V. P. Tarasik, Planetary gearbox simulation (in Russian), 2018; (12) to (15).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp

from vstatics.core.errors import CaseError, Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.instants import break_times
from vstatics.simulation.events.start import start_gear, start_speeds
from vstatics.simulation.published.phase_equations import ClutchPhase, PublishedEquations
from vstatics.simulation.published.record_of_phases import TarasikRecord
from vstatics.simulation.published.two_masses import NotTwoError, two_masses
from vstatics.simulation.record.motion import EventKind, Motion
from vstatics.simulation.record.words import event_of
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points
from vstatics.simulation.scenario.parts import Dog, Scenario
from vstatics.simulation.scenario.programme import programmes
from vstatics.simulation.system.curves import capacity_at
from vstatics.simulation.system.devices import motion_system
from vstatics.simulation.system.matrices import Contact, MotionSystem
from vstatics.simulation.tolerances import PUBLISHED_RTOL, RTOL, STANDING

_FINER = 1e-2
"""Integration tolerance relative to the requested tolerance."""
_CHANGES = 1000
"""Largest number of changes between slipping and locking in a time interval."""


def tarasik(scenario: Scenario, *, step: float | None = None, rtol: float = RTOL) -> Motion:
    """Simulate a scenario with the published equations.

    Parameters
    ----------
    scenario : Scenario
        Scenario of a gearbox with two degrees of freedom and one active clutch at a time.
    step : float, optional
        Spacing of additional instants. [s]
    rtol : float
        Tolerance as in `simulate`. [-]

    Returns
    -------
    Motion
        Torques of mechanisms, and of locked shift elements other than the clutch, are NaN, as the
        method does not give them. The motion is `stopped` where the equations do not apply.

    Raises
    ------
    CaseError
        If the scenario contains something that the method does not cover.
    """
    gear = start_gear(scenario)
    engaged = tuple(gear.engaged) if gear else scenario.start.engaged
    system = motion_system(scenario, programmes(scenario, engaged), gear)
    problems = list(refusals(system))
    ends = (scenario.case.input - 1, scenario.case.output - 1)
    if gear is not None:
        ends = (scenario.case.gear_input(gear) - 1, scenario.case.gear_output(gear) - 1)
    names = {system.names[outside.link] for outside in system.outside if outside.link not in ends}
    text = f"equation (12) has torques on input and output only: leave it out, or {_INSTEAD}"
    problems += [Problem("E616", text, ("torques", name)) for name in sorted(names)]
    if problems:
        raise CaseError(problems)
    speeds = start_speeds(system, gear)
    run = _Run(system, ends, speeds, rtol)
    times = set(break_times(system, scenario.duration))
    if step:
        times |= {step * n for n in range(1, math.ceil(scenario.duration / step))}
    stops = sorted(time for time in times if 0 < time < scenario.duration)
    problem = run.through([0.0, *stops, scenario.duration])
    return run.record.motion(problem)


class _ZeroEvent:
    """Event function that ends an integration where its value falls through 0."""

    terminal = True
    direction = -1.0

    def __init__(self, function: Callable[[float, Floats], float]) -> None:
        self.function = function

    def __call__(self, time: float, state: Floats) -> float:
        """Return the value at a time and state."""
        return self.function(time, state)


class _Run:
    """Run of the published method, integrated from change to change of the clutch."""

    def __init__(
        self, system: MotionSystem, ends: tuple[int, int], speeds: Floats, rtol: float
    ) -> None:
        self.system, self.ends, self.rtol = system, ends, rtol * _FINER
        self.record = TarasikRecord(system, speeds)
        self.state = np.array([speeds[ends[0]], speeds[ends[1]], 0.0, 0.0, 0.0, 0.0])
        """State vector of `PublishedEquations`."""
        self.stuck: list[int] = []
        self.speeds = speeds

    def through(self, stops: list[float]) -> Problem | None:
        """Integrate from stop to stop [s]; return the problem that ends the run early, if any."""
        for begin, end in pairwise(stops):
            time = begin
            try:
                phase = self._begin((begin + end) / 2, begin)
                for _ in range(_CHANGES):
                    time, phase = self._piece(phase, time, end)
                    if time == end:
                        break
                else:
                    raise NotTwoError("the clutch neither holds nor slips")  # noqa: TRY301
            except NotTwoError as error:
                text = f"at {time:.9g} s: {error}; equation (12) has two masses and one clutch"
                return Problem("E617", text, ("controls",))
        return None

    def _begin(self, middle: float, time: float) -> ClutchPhase:
        """Return the phase at `time`, from the capacities in the middle of its interval [s]."""
        contacts = self.system.contacts
        active = [n for n, contact in enumerate(contacts) if capacity_at(contact, middle) > 0]
        for n in self.stuck:
            if n not in active:
                self._tell(time, n, "slips")
        self.stuck = [n for n in self.stuck if n in active]
        slips = {n: float(contacts[n].row @ self.speeds) for n in active if n not in self.stuck}
        largest = max(1.0, float(np.abs(self.speeds).max()))
        for n, slip in slips.items():
            if abs(slip) <= STANDING * largest:
                self.stuck.append(n)
                if time > 0:
                    self._tell(time, n, "locks")
        slipping = [n for n in slips if n not in self.stuck]
        if len(slipping) > 1:
            names = " and ".join(contacts[n].name for n in slipping)
            raise NotTwoError(f"{names} slip at once")
        if not slipping:
            return self._holding()
        [clutch] = slipping
        try:
            masses = two_masses(self.system, self.ends, self.stuck, clutch)
        except NotTwoError as error:
            raise NotTwoError(f"{contacts[clutch].name} slips, and {error}") from None
        # The signs are multiplied, because the product of two small slips can underflow to 0.
        direction = math.copysign(1.0, slips[clutch]) * math.copysign(1.0, masses.slip)
        return ClutchPhase(masses, clutch, locked=False, direction=direction)

    def _holding(self) -> ClutchPhase:
        """Return a phase without slip, whose clutch is the last suitable sticking contact."""
        reason: NotTwoError | None = None
        for clutch in reversed(self.stuck):
            others = [n for n in self.stuck if n != clutch]
            try:
                return ClutchPhase(
                    two_masses(self.system, self.ends, others, clutch), clutch, locked=True
                )
            except NotTwoError as error:
                reason = reason or error
        try:
            return ClutchPhase(
                two_masses(self.system, self.ends, self.stuck, None), None, locked=False
            )
        except NotTwoError:
            raise (reason or NotTwoError("nothing joins input and output")) from None

    def _piece(self, phase: ClutchPhase, begin: float, end: float) -> tuple[float, ClutchPhase]:
        """Integrate to the next change of the clutch or to `end`; return that time and phase."""
        equations = PublishedEquations(self.system, self.ends, phase, end)
        self.state[5] = 0.0
        if phase.locked and equations.margin(begin, self.state) < 0:
            return begin, self._breaks_away(phase, equations, begin)
        event = _ZeroEvent(equations.margin if phase.locked else equations.slip)
        size = max(1.0, float(np.abs(self.state[:2]).max()))
        run = solve_ivp(
            equations.rates,
            (begin, end),
            self.state,
            "DOP853",
            events=None if phase.clutch is None else event,
            rtol=max(self.rtol, PUBLISHED_RTOL),
            atol=self.rtol * size,
        )
        if not run.success or not np.isfinite(run.y).all():
            raise NotTwoError(f"the equations end here ({run.message})")
        for instant, state in zip(run.t, run.y.T, strict=True):
            speeds, torque = phase.masses.speeds @ state[:2], equations.torque(instant, state)
            self.record.add(float(instant), speeds, torque, phase.clutch, state)
        self.state = run.y[:, -1]
        self.speeds = phase.masses.speeds @ self.state[:2]
        self.record.heat_of(phase.clutch, float(self.state[5]))
        time = float(run.t[-1])
        if run.status != 1:
            return end, phase
        if phase.locked:
            return time, self._breaks_away(phase, equations, time)
        return time, self._meets(phase, time, end)

    def _meets(self, phase: ClutchPhase, time: float, end: float) -> ClutchPhase:
        """Return the phase after w_f reaches 0: locked, or slipping backward if (15) fails."""
        assert phase.clutch is not None  # noqa: S101 - for mypy: a clutch slipped
        self.state[0] = phase.masses.ratio * self.state[1]
        locked = phase._replace(locked=True)
        if PublishedEquations(self.system, self.ends, locked, end).margin(time, self.state) < 0:
            self._tell(time, phase.clutch, "reverses")
            return phase._replace(direction=-phase.direction)
        self.stuck.append(phase.clutch)
        self._tell(time, phase.clutch, "locks")
        return locked

    def _breaks_away(
        self, phase: ClutchPhase, equations: PublishedEquations, time: float
    ) -> ClutchPhase:
        """Return the phase after a clutch breaks away: slip along its torque or a drift of w_f."""
        assert phase.clutch is not None  # noqa: S101 - for mypy: it was locked
        self.stuck.remove(phase.clutch)
        self._tell(time, phase.clutch, "slips")
        drift = equations.w_f(self.state)
        if abs(drift) > STANDING * np.abs(self.state[:2]).max():  # losses let w_f drift
            return phase._replace(locked=False, direction=math.copysign(1.0, drift))
        self.state[0] = phase.masses.ratio * self.state[1]
        passed = equations.passed(time, self.state)
        return phase._replace(locked=False, direction=math.copysign(1.0, passed))

    def _tell(self, time: float, contact: int, kind: EventKind) -> None:
        self.record.events.append(event_of(time, self.system.contacts[contact], kind))


_INSTEAD = "use the default method, `events`"


def refusals(system: MotionSystem) -> Iterator[Problem]:
    """Yield problems for items of a scenario that equations (12) to (15) do not cover."""
    numbers = {spring.name: k for k, spring in enumerate(system.scenario.case.springs, 1)}
    for key in ("states", "sequences", "speeds", "speed_ratios"):
        if getattr(system.scenario, key):
            yield Problem("E731", f"equation (12) does not cover this key: {_INSTEAD}", (key,))
    for spring in system.springs:
        text = f"{spring.name} is elastic, but equation (12) has rigid shafts: {_INSTEAD}"
        yield Problem("E618", text, ("case", "springs", numbers.get(spring.name, spring.name)))
    for converter in system.converters:
        text = f"equation (12) does not cover converters: {_INSTEAD}"
        yield Problem("E619", text, ("converters", converter.name))
    for outside in system.outside:
        if isinstance(outside.law, Formula) and outside.law.seen:
            name = system.names[outside.link]
            text = (
                f"the torque on {name} depends on more than its own motion, which equation (12) "
                "does not cover"
            )
            yield Problem("E611", f"{text}: {_INSTEAD}", ("torques", name))
    controls = system.scenario.controls or {}
    for contact in system.contacts:
        if contact.element is not None and isinstance(controls.get(contact.element + 1), Dog):
            text = f"a dog clutch closes at once, which equation (12) does not cover: {_INSTEAD}"
            yield Problem("E620", text, ("controls", contact.name))
        else:
            yield from _of_contact(contact)


def _of_contact(contact: Contact) -> Iterator[Problem]:
    curve = contact.programme.curve
    if contact.switch:
        text = f"a torque on {contact.name} jumps, which equation (12) does not cover: {_INSTEAD}"
        yield Problem("E621", text, ("torques", contact.name))
    elif contact.element is None and not contact.is_drag:
        text = (
            f"the resistance of {contact.name} holds at rest, which equation (12) does not cover: "
            "write a formula such as -300*tanh(speed/0.05)"
        )
        yield Problem("E622", text, ("torques", contact.name))
    elif contact.is_drag:
        text = f"{contact.name} has drag, which equation (12) does not cover: {_INSTEAD}"
        yield Problem("E623", text, ("case",))
    elif contact.one_way and contact.element is not None:
        text = f"{contact.name} is a freewheel, which equation (14) does not cover: {_INSTEAD}"
        yield Problem("E624", text, ("case", "shift_elements", contact.element + 1))
    elif contact.programme.look is not None:
        text = (
            f"{contact.name} depends on more than its slip and the time, which equation (12) does "
            "not cover"
        )
        yield Problem("E611", f"{text}: {_INSTEAD}", ("controls", contact.name))
    elif contact.programme.is_dog and isinstance(curve, Points) and len({*curve.y}) > 1:
        text = (
            f"{contact.name} has no capacity in the case, so it engages at once, which equation "
            "(12) does not cover: give it a `capacity` there"
        )
        yield Problem("E625", text, ("shifts",))
