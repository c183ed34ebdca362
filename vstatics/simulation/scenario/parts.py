"""What happens to a case over time."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from vstatics.model.transmission import Transmission
from vstatics.simulation.scenario.laws import Curve, TorqueLaw


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
    """

    gear: str | None = None
    speed: float = 0.0
    speeds: Mapping[int, float] = MappingProxyType({})
    engaged: tuple[int, ...] = ()
    settled: bool = False


class Capacity(NamedTuple):
    """The kinetic capacity of a shift element over time."""

    law: Curve
    """[N*m], or a pressure where the element has `friction` [Pa]"""
    scale: float = 1.0
    """By which it is multiplied. [-]"""


class Dog(NamedTuple):
    """A dog clutch that joins at once or opens."""

    points: tuple[tuple[float, bool], ...]
    """Times [s] in ascending order, each with whether it is closed from there on; open before."""


Control: TypeAlias = Capacity | Dog


class Converter(NamedTuple):
    """A torque converter between two links.

    ``M_P = lambda w_P |w_P|``, ``M_T = K M_P``, by the points i = w_T/w_P, K, lambda.
    """

    name: str
    pump: int
    turbine: int
    points: tuple[tuple[float, float, float], ...]
    """i [-], K [-], lambda [N*m*s^2]; i ascends."""


class Shift(NamedTuple):
    """A shift to another gear."""

    at: float
    """[s]"""
    to: str
    """Name of the gear."""
    overlap: float = 0.0
    """Time that it takes. [s]"""


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
    shifts : sequence of Shift, optional
        None: there is no such key.
    targets : mapping of int to sequence of float
        Link -> speeds whose time and angle are asked for. [rad/s]
    """

    case: Transmission
    duration: float
    start: Start = Start()
    controls: Mapping[int, Control] | None = None
    torques: tuple[tuple[int, TorqueLaw], ...] = ()
    converters: tuple[Converter, ...] = ()
    shifts: tuple[Shift, ...] | None = None
    targets: Mapping[int, tuple[float, ...]] = MappingProxyType({})
