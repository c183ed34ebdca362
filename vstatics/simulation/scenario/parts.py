"""Data model of a scenario: the inputs of a case over time."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from vstatics.core.errors import Path
from vstatics.core.model.converters import Converter
from vstatics.core.model.empty import EMPTY
from vstatics.core.model.transmission import Transmission
from vstatics.simulation.scenario.conditions import StepCondition
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, TorqueLaw
from vstatics.simulation.tolerances import LEAST_DURATION, LONGEST_DURATION


class Start(NamedTuple):
    """Motion at t = 0: a gear with the input speed, or speeds and shift elements that stick.

    Parameters
    ----------
    gear : str, optional
        Name of a gear.
    speed : float
        Speed of the input, with a gear. [rad/s]
    speeds : mapping of int to float
        Speeds of links by link number, instead of a gear. [rad/s]
    engaged : sequence of int
        Numbers of the shift elements that stick at t = 0, in addition to `speeds`.
    settled : bool
        True if the twists of springs balance the torques of t = 0 at rest.
    twists : mapping of str to float
        Twists of springs by name [rad]; extensions of straight springs [m].
    angles : mapping of int to float
        Angles of links by link number [rad]; positions of masses [m].

    Examples
    --------
    >>> Start(gear="1", speed=150.0).settled
    False
    """

    gear: str | None = None
    speed: float = 0.0
    speeds: Mapping[int, float] = EMPTY
    engaged: tuple[int, ...] = ()
    settled: bool = False
    twists: Mapping[str, float] = EMPTY
    angles: Mapping[int, float] = EMPTY


class Capacity(NamedTuple):
    """Kinetic capacity of a shift element over time.

    Examples
    --------
    From 0 to 400 N*m in a tenth of a second:

    >>> from vstatics.simulation import Points
    >>> Capacity(Points((0.0, 0.1), (0.0, 400.0)), scale=1.2).scale
    1.2
    """

    law: Curve
    """Torque [N*m], or pressure [Pa] if the shift element has `friction`."""
    scale: float = 1.0
    """Factor of the law. [-]"""


class Dog(NamedTuple):
    """Times at which a dog clutch closes or opens.

    Examples
    --------
    Closed from half a second on:

    >>> Dog(((0.5, True),)).points
    ((0.5, True),)
    """

    points: tuple[tuple[float, bool], ...]
    """Ascending times [s], each with True (clutch closes) or False (clutch opens)."""


Control: TypeAlias = Capacity | Dog


class Shift(NamedTuple):
    """Shift to a new gear.

    Examples
    --------
    >>> Shift(at=1.0, to="2", overlap=0.3)
    Shift(at=1.0, to='2', overlap=0.3)
    """

    at: float
    """Time at which the shift begins. [s]"""
    to: str
    """Name of the new gear."""
    overlap: float = 0.0
    """Duration in which torque passes from released to engaged shift elements. [s]"""


class ControlState(NamedTuple):
    """State x of the control, with ``dx/dt = rate``."""

    name: str
    rate: Curve
    """Rate of change, a number or a formula. [1/s times the unit of the state]"""
    start: float = 0.0
    least: float = -math.inf
    most: float = math.inf
    """Upper limit, at which the state stays while its rate is positive."""

    def beyond(self, value: float) -> str:
        """Return a message about a value beyond the limits, empty for other values."""
        if value > self.most:
            return f"read {value:g}, expected at most {self.most:g}, its max"
        if value < self.least:
            return f"read {value:g}, expected at least {self.least:g}, its min"
        return ""


class SequenceStep(NamedTuple):
    """Step of a sequence, which acts after a condition becomes true."""

    when: StepCondition | None = None
    """Condition of the step, if any."""
    within: float = math.inf
    """Longest permitted time from the preceding step until the condition is true. [s]"""
    wait: float = 0.0
    """Time from the condition to the action. [s]"""
    settings: Mapping[str, Curve] = EMPTY
    """New values of settings and states, by name."""
    shift: Shift | None = None
    """Shift that begins with the action; its time `at` is ignored."""
    dogs: Mapping[int, bool] = EMPTY
    """True if the step closes a dog clutch, False if it opens it, by number of the clutch."""


class StepSequence(NamedTuple):
    """Sequence of consecutive steps."""

    name: str
    steps: tuple[SequenceStep, ...]
    repeat: bool = False
    """True if the sequence begins again after the last step."""


class StaticTorque(NamedTuple):
    """Gear and input torque of the static torques in dynamic factors."""

    gear: str
    torque: float
    """Input torque. [N*m]"""


class Scenario(NamedTuple):
    """Inputs of a case over time.

    Parameters
    ----------
    case : Transmission
    duration : float
        Time to simulate. [s]
    start : Start
    controls : mapping of int to Control, optional
        Controls of shift elements by number; None if the document lacks the key.
    torques : sequence of (int, TorqueLaw)
        External torques on links; a link can appear several times. [N*m]
    converters : sequence of Converter
        Torque converters that replace all converters of the case.
    shifts : sequence of Shift, optional
        Shifts in their order; None if the document lacks the key.
    targets : mapping of int to sequence of float
        Speeds for which time and distance are reported, by link number. [rad/s]
    settings : mapping of str to float
        Initial values of the numbers that sequences set, by name.
    states : sequence of ControlState
    sequences : sequence of StepSequence
    speeds : mapping of int to Curve
        Given speeds over time, by link number: points without a jump, or a formula of t. [rad/s]
    speed_ratios : mapping of int to Curve
        Speed ratios over time, w_second/w_first, by number of the variator: points without a jump,
        or a formula of t. [-]
    limits : mapping of int to Curve
        Torque limits by number of the spring, instead of the `limit` of the case. [N*m]
    static : StaticTorque, optional
        Gear and input torque for dynamic factors.

    Examples
    --------
    A wheel of 2 kg*m^2 under 4 N*m for 3 s:

    >>> from vstatics import Transmission, simulate
    >>> from vstatics.simulation import constant
    >>> case = Transmission(1, [], [], [], inertias={1: 2.0})
    >>> scenario = Scenario(case, 3.0, Start(speeds={1: 1.0}), torques=[(1, constant(4.0))])
    >>> round(float(simulate(scenario).speeds[-1, 0]), 9)
    7.0
    """

    case: Transmission
    duration: float
    start: Start = Start()
    controls: Mapping[int, Control] | None = None
    torques: tuple[tuple[int, TorqueLaw], ...] = ()
    converters: tuple[Converter, ...] = ()
    shifts: tuple[Shift, ...] | None = None
    targets: Mapping[int, tuple[float, ...]] = EMPTY
    settings: Mapping[str, float] = EMPTY
    states: tuple[ControlState, ...] = ()
    sequences: tuple[StepSequence, ...] = ()
    speeds: Mapping[int, Curve] = EMPTY
    speed_ratios: Mapping[int, Curve] = EMPTY
    limits: Mapping[int, Curve] = EMPTY
    static: StaticTorque | None = None

    @property
    def value_names(self) -> list[str]:
        """Names of settings and states."""
        return [*self.settings, *(state.name for state in self.states)]

    @property
    def span(self) -> float:
        """Time scale for deciding if two instants coincide: the duration, clipped to limits [s]."""
        return min(max(self.duration, LEAST_DURATION), LONGEST_DURATION)


def placed_steps(scenario: Scenario) -> Iterator[tuple[Path, SequenceStep]]:
    """Yield the steps of all sequences, each with its path in the scenario."""
    for sequence in scenario.sequences:
        for number, step in enumerate(sequence.steps, 1):
            yield ("sequences", sequence.name, number), step


def placed_laws(scenario: Scenario) -> Iterator[tuple[Path, TorqueLaw | StepCondition]]:
    """Yield each law and condition with its path in the scenario.

    Laws of links and components that the case does not have are left out.
    """
    case, controls = scenario.case, (scenario.controls or {}).items()
    capacities = [(n, control.law) for n, control in controls if isinstance(control, Capacity)]
    of_parts: tuple[tuple[str, Sequence[str], Iterable[tuple[int, TorqueLaw]]], ...] = (
        ("controls", [element.name for element in case.shift_elements], capacities),
        ("torques", case.link_names, scenario.torques),
        ("limits", [spring.name for spring in case.springs], scenario.limits.items()),
        ("speeds", case.link_names, scenario.speeds.items()),
        ("speed_ratios", [part.name for part in case.mechanisms], scenario.speed_ratios.items()),
    )
    for key, names, laws in of_parts:
        yield from (((key, names[n - 1]), law) for n, law in laws if 0 < n <= len(names))
    for state in scenario.states:
        yield ("states", state.name, "rate"), state.rate
    for path, step in placed_steps(scenario):
        if step.when:
            yield (*path, "when"), step.when
        for name, value in step.settings.items():
            yield (*path, "set", name), value


def formulas(scenario: Scenario) -> Iterator[Formula]:
    """Yield all formulas of a scenario, with the comparisons of each condition."""
    for _, law in placed_laws(scenario):
        if isinstance(law, StepCondition):
            yield from law.comparisons
        elif isinstance(law, Formula):
            yield law
