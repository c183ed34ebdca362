"""What happens to a case over time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from vstatics.core.model.converters import Converter
from vstatics.core.model.transmission import Transmission
from vstatics.simulation.scenario.conditions import StepCondition
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, TorqueLaw
from vstatics.simulation.tolerances import LEAST_DURATION, LONGEST_DURATION


class Start(NamedTuple):
    """The speeds at t = 0: by a gear, or by speeds and elements that hold.

    Parameters
    ----------
    gear : str, optional
        Name of a gear.
    speed : float
        Of the input, with a gear. [rad/s]
    speeds : mapping of int to float
        Of links, in place of a gear. [rad/s]
    engaged : sequence of int
        Numbers of shift elements that do not slip at t = 0, beside `speeds`.
    settled : bool
        Whether springs are loaded as they are at rest under the torques of t = 0.
    twists : mapping of str to float
        Of springs, by name, not beside `settled`. [rad, m]
    angles : mapping of int to float
        Of links. [rad, m]

    Examples
    --------
    >>> Start(gear="1", speed=150.0).settled
    False
    """

    gear: str | None = None
    speed: float = 0.0
    speeds: Mapping[int, float] = MappingProxyType({})
    engaged: tuple[int, ...] = ()
    settled: bool = False
    twists: Mapping[str, float] = MappingProxyType({})
    angles: Mapping[int, float] = MappingProxyType({})


class Capacity(NamedTuple):
    """The kinetic capacity of a shift element over time.

    Examples
    --------
    From 0 to 400 N*m in a tenth of a second:

    >>> from vstatics.simulation import Points
    >>> Capacity(Points((0.0, 0.1), (0.0, 400.0)), scale=1.2).scale
    1.2
    """

    law: Curve
    """[N*m], or a pressure where the element has `friction` [Pa]"""
    scale: float = 1.0
    """By which it is multiplied. [-]"""


class Dog(NamedTuple):
    """A dog clutch that joins at once or opens.

    Examples
    --------
    Closed from half a second on:

    >>> Dog(((0.5, True),)).points
    ((0.5, True),)
    """

    points: tuple[tuple[float, bool], ...]
    """Times [s] in ascending order, each with whether it is closed from there on; open before."""


Control: TypeAlias = Capacity | Dog


class Shift(NamedTuple):
    """A shift to another gear.

    Examples
    --------
    >>> Shift(at=1.0, to="2", overlap=0.3)
    Shift(at=1.0, to='2', overlap=0.3)
    """

    at: float
    """[s]"""
    to: str
    """Name of the gear."""
    overlap: float = 0.0
    """Time that it takes. [s]"""


class ControlState(NamedTuple):
    """A number that changes by itself: ``dx/dt = rate``."""

    name: str
    rate: Curve
    """A number, or a formula. [1/s]"""
    start: float = 0.0
    least: float = -math.inf
    most: float = math.inf
    """While it is at a limit and its rate points outward, it stays there."""

    def beyond(self, value: float) -> str:
        """What is said of a value beyond its limits; nothing of one between them."""
        if value > self.most:
            return f"read {value:g}, expected at most {self.most:g}, its max"
        if value < self.least:
            return f"read {value:g}, expected at least {self.least:g}, its min"
        return ""


class SequenceStep(NamedTuple):
    """What is done once a condition was true."""

    when: StepCondition | None = None
    """None: at once."""
    within: float = math.inf
    """So long after the step before it must have been true. [s]"""
    wait: float = 0.0
    """Time from then on until it is done. [s]"""
    settings: Mapping[str, Curve] = MappingProxyType({})
    """Numbers and states, and what they are from then on."""
    shift: Shift | None = None
    """Its time does not count."""
    dogs: Mapping[int, bool] = MappingProxyType({})
    """Number of a dog clutch -> whether it is closed from then on."""


class StepSequence(NamedTuple):
    """Steps, one after the other."""

    name: str
    steps: tuple[SequenceStep, ...]
    repeat: bool = False
    """Whether it begins again behind the last."""


class Scenario(NamedTuple):
    """A case and what happens to it.

    Parameters
    ----------
    case : Transmission
    duration : float
        [s]
    start : Start
    controls : mapping of int to Control, optional
        Number of a shift element -> its control; None: there is no such key.
    torques : sequence of (int, TorqueLaw)
        Outside torques on links; a link may stand there several times. [N*m]
    converters : sequence of Converter
        Of these the case has none of the same name: they stand in place of its own.
    shifts : sequence of Shift, optional
        None: there is no such key.
    targets : mapping of int to sequence of float
        Link -> speeds whose time and angle are asked for. [rad/s]
    settings : mapping of str to float
        Numbers that sequences change.
    states : sequence of ControlState
    sequences : sequence of StepSequence
    speeds : mapping of int to Curve
        Link -> its speed over time, which is given: points without a jump, or a formula of t.
        [rad/s]
    speed_ratios : mapping of int to Curve
        Number of a variator -> its speed ratio over time, w_second/w_first: points without a jump,
        or a formula of t. [-]
    limits : mapping of int to Curve
        Number of a spring -> within what its torque stays, in place of the `limit` of the case.
        [N*m]

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
    targets: Mapping[int, tuple[float, ...]] = MappingProxyType({})
    settings: Mapping[str, float] = MappingProxyType({})
    states: tuple[ControlState, ...] = ()
    sequences: tuple[StepSequence, ...] = ()
    speeds: Mapping[int, Curve] = MappingProxyType({})
    speed_ratios: Mapping[int, Curve] = MappingProxyType({})
    limits: Mapping[int, Curve] = MappingProxyType({})

    @property
    def span(self) -> float:
        """Time by parts of which instants are the same, or near: the duration of no long run."""
        return min(max(self.duration, LEAST_DURATION), LONGEST_DURATION)


def formulas(scenario: Scenario) -> Iterator[Formula]:
    """All formulas of a scenario."""
    for control in (scenario.controls or {}).values():
        if isinstance(control, Capacity) and isinstance(control.law, Formula):
            yield control.law
    yield from (law for _, law in scenario.torques if isinstance(law, Formula))
    yield from (law for law in scenario.limits.values() if isinstance(law, Formula))
    yield from (one.rate for one in scenario.states if isinstance(one.rate, Formula))
    for sequence in scenario.sequences:
        for step in sequence.steps:
            yield from (one for one in step.settings.values() if isinstance(one, Formula))
            if step.when is not None:
                yield from step.when.comparisons
