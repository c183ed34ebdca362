"""What bends in a transmission: springs, each with its twist."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.core.model.parts import HOUSING, NO_DAMPING, Damping
from vstatics.core.model.struts import Strut, StrutCurve

Twist = tuple[tuple[int, float], ...]
"""Links with their coefficients: the twist is the sum of coefficient times angle."""


class TwistCurve(NamedTuple):
    """A torque over a twist: straight between points, beyond them with the last slope.

    Examples
    --------
    >>> play = TwistCurve((-0.2, -0.1, 0.1, 0.2), (-30.0, 0.0, 0.0, 30.0))
    >>> play.at(0.05), round(play.at(0.3), 9), round(play.energy(-0.2), 9), play.has_play
    (0.0, 60.0, 1.5, True)
    """

    twists: tuple[float, ...]
    """Two at least, each larger than the one before. [rad]"""
    torques: tuple[float, ...]
    """None is less than the one before. [N*m]"""

    @property
    def corners(self) -> tuple[float, ...]:
        """Twists at which it bends [rad]."""
        return self.twists[1:-1]

    def piece(self, number: int) -> tuple[float, float]:
        """Torque at a twist of 0, and slope, of the straight line of a piece."""
        left, right = self.twists[number : number + 2]
        below, above = self.torques[number : number + 2]
        slope = (above - below) / (right - left)
        return below - slope * left, slope

    def alone(self, number: int) -> TwistCurve:
        """The straight line of a piece, without its ends."""
        return TwistCurve(self.twists[number : number + 2], self.torques[number : number + 2])

    @property
    def bends(self) -> bool:
        """Whether it is not straight through 0."""
        return len(self.twists) > 2 or self.piece(0)[0] != 0

    def side(self, number: int) -> float:
        """Return the sign of the torque on a piece next to a play; 0 in the play."""
        torque = sum(self.torques[number : number + 2])
        return math.copysign(1.0, torque) if torque else 0.0

    @property
    def has_gap(self) -> bool:
        """Whether a piece of it has no torque: what it joins can part there."""
        pieces = [self.piece(number) for number in range(len(self.twists) - 1)]
        return (0.0, 0.0) in pieces and len({*pieces}) > 1

    @property
    def has_play(self) -> bool:
        """Whether it has no torque about a twist of 0."""
        return self.piece(bisect_right(self.corners, 0.0)) == (0.0, 0.0)

    @property
    def steepest(self) -> float:
        """The largest slope [N*m/rad]."""
        return max(self.piece(number)[1] for number in range(len(self.twists) - 1))

    def at(self, twist: float) -> float:
        """The torque at a twist [N*m]."""
        value, slope = self.piece(bisect_right(self.corners, twist))
        return value + slope * twist

    def energy(self, twist: float) -> float:
        """The integral of the torque from a twist of 0 on [J]."""
        low, high = sorted((0.0, twist))
        ends = (low, *(one for one in self.corners if low < one < high), high)
        energy = sum((self.at(a) + self.at(b)) * (b - a) / 2 for a, b in pairwise(ends))
        return energy if twist > 0 else -energy

    def twist_at(self, torque: float) -> float | None:
        """The twist nearest 0 at which it has a torque [rad]; None: it never has.

        Examples
        --------
        >>> play = TwistCurve((-0.2, 0.1, 0.2), (0.0, 0.0, 30.0))
        >>> play.twist_at(0.0), play.twist_at(30.0), play.twist_at(-1.0)
        (0.0, 0.2, None)
        """
        found = []
        for bisect, anywhere in ((bisect_left, -math.inf), (bisect_right, math.inf)):
            value, slope = self.piece(self._piece(bisect(self.torques, torque) - 1))
            found.append((torque - value) / slope if slope else anywhere)
        least, most = found
        if math.isinf(least) and math.isinf(most):
            return None
        return min(max(0.0, least), most)

    def slope_at(self, torque: float) -> float:
        """The slope where it has a torque [N*m/rad]; in play, and where it never has it, 0.

        At a corner it is that of the larger torque.

        Examples
        --------
        >>> play = TwistCurve((-0.2, -0.1, 0.1, 0.2, 0.3), (-30.0, 0.0, 0.0, 30.0, 90.0))
        >>> [round(play.slope_at(torque), 6) for torque in (0.0, -20.0, 30.0)]
        [0.0, 300.0, 600.0]
        """
        first, behind = bisect_left(self.torques, torque), bisect_right(self.torques, torque)
        if behind > first + 1:
            return 0.0
        return self.piece(self._piece((behind if torque > 0 else first) - 1))[1]

    def _piece(self, number: int) -> int:
        return min(max(number, 0), len(self.twists) - 2)


def straight_curve(stiffness: float) -> TwistCurve:
    """That of a stiffness [N*m/rad]."""
    return TwistCurve((-1.0, 1.0), (-stiffness, stiffness))


class SpringLimit(NamedTuple):
    """A limit that follows the torque of another spring, as grip does the load of a wheel, (5.8).

    Parameters
    ----------
    base : float
        Where the other has none. [N*m]
    of : str
        The other spring.
    times : float
        What its torque, or force, adds by its size; the limit is never below 0. [-, m]
    """

    base: float
    of: str
    times: float


def limit_of(base: float, of: str = "", times: float = 0.0) -> float | SpringLimit:
    """A limit by the keys of a case."""
    return SpringLimit(base, of, times) if of else base


def limit_fault(of: str = "", times: float | None = None, **_others: Any) -> str:
    """Why these keys do not tell a limit.

    >>> limit_fault("suspension")
    'expected `of` and `times` both, or none of them'
    """
    told = bool(of) == (times is not None)
    return "" if told else "expected `of` and `times` both, or none of them"


class Spring(NamedTuple):
    """An elastic device: a torque by a twist, which is any linear form of angles.

    Its column in the structural-distribution matrix is its twist.

    Parameters
    ----------
    twist : mapping of int to float, or pairs of these
        Links with their coefficients; that of a shaft is the angle of the first link less
        that of the second. The housing does not turn, so it may be left out.
    stiffness : float, optional
        A spring without one is a damper alone. [N*m/rad]
    compliance : float, optional
        In place of the stiffness. [rad/(N*m)]
    damping : Damping or float
        A number is viscous. [N*m*s/rad]
    name : str
        ``S`` and the number when not given.
    limit : float or SpringLimit, optional
        In a scenario its torque stays within it, the rest is slip, as of a tyre. [N*m]
    points : sequence of (float, float), optional
        In place of a stiffness: twists, which rise, and torques, which do not fall. They begin
        with (0, 0) and hold in both directions, unless a twist is below 0. [rad, N*m]
    friction : float
        Dry friction beside it, in a scenario. [N*m]
    strut : Strut, optional
        In place of a stiffness.

    Examples
    --------
    >>> Spring({1: 1, 2: -1}, compliance=0.002).rate
    500.0
    >>> Spring({1: 1, 2: -1}, points=[(0, 0), (0.1, 0), (0.2, 30)]).curve.twists
    (-0.2, -0.1, 0.1, 0.2)
    """

    twist: Mapping[int, float] | Twist
    stiffness: float | None = None
    compliance: float | None = None
    damping: Damping | float = NO_DAMPING
    name: str = ""
    limit: float | SpringLimit | None = None
    points: Sequence[tuple[float, float]] = ()
    friction: float = 0.0
    strut: Strut | None = None

    @property
    def form(self) -> dict[int, float]:
        """The links that turn, with their coefficients, none of them 0."""
        pairs = dict(self.twist).items()
        return {link: float(part) for link, part in pairs if link != HOUSING and part}

    @property
    def rate(self) -> float:
        """The stiffness [N*m/rad], whichever is given; of points the steepest."""
        if self.strut:
            return self.strut.slope(self.strut.at)
        if self.points:
            return self.curve.steepest
        if self.compliance:
            return 1 / self.compliance
        return self.stiffness or 0.0

    @property
    def is_damper(self) -> bool:
        """Whether it has no stiffness: a damper alone, which carries nothing at mean speeds."""
        return not (self.stiffness or self.compliance or self.points or self.strut)

    @property
    def curve(self) -> TwistCurve | StrutCurve:
        """Its torque over its twist, in both directions."""
        if self.strut:
            return StrutCurve(self.strut)
        points = [*self.points]
        if not points:
            return straight_curve(self.rate)
        if points[0][0] >= 0:  # which is no corner
            points = [*((-twist, -torque) for twist, torque in points[:0:-1]), *points[1:]]
        twists, torques = zip(*points, strict=True)
        return TwistCurve(twists, torques)


def between(first: int, second: int = HOUSING) -> Twist:
    """The twist of a shaft from one link to another, or to the housing.

    >>> between(1, 2), between(3)
    (((1, 1.0), (2, -1.0)), ((3, 1.0), (0, -1.0)))
    """
    return (first, 1.0), (second, -1.0)


def ends(twist: Mapping[int, float] | Twist) -> tuple[int, int] | None:
    """The links of a shaft that has this twist; none if it is no shaft's.

    >>> ends(between(2)), ends({1: 1, 2: -1, 3: -1})
    ((2, 0), None)
    """
    match [(link, part) for link, part in dict(twist).items() if link != HOUSING]:
        case [(link, 1)]:
            return link, HOUSING
        case [(link, -1)]:
            return HOUSING, link
        case [(first, 1), (second, -1)]:
            return first, second
    return None


def spring_of(
    links: tuple[int, int] | None = None, twist: Mapping[int, float] | None = None, **others: Any
) -> Spring:
    """A spring by the keys of a case: a shaft's links, or any twist."""
    return Spring(between(*links) if links else twist or (), **others)


def spring_fault(
    links: tuple[int, int] | None = None, twist: Mapping[int, float] | None = None, **_others: Any
) -> str:
    """Why these keys do not tell a spring.

    >>> spring_fault((1, 2), {1: 1.0})
    'read both `links` and `twist`, expected one of them'
    """
    if links is None and twist is None:
        return "expected `links`, those of a shaft, or `twist`, a coefficient for each link"
    if links is not None and twist is not None:
        return "read both `links` and `twist`, expected one of them"
    return ""


def spring_record(spring: Spring) -> dict[str, Any]:
    """A spring by the keys of a case."""
    links = ends(spring.twist)
    twist = spring.form if links is None else None
    limit = spring.limit
    told = limit if limit is None or isinstance(limit, SpringLimit) else {"base": limit}
    return {**spring._asdict(), "links": links, "twist": twist, "limit": told}


def spring_name(number: int) -> str:
    """The name of a spring that has none: S and its number."""
    return f"S{number}"


def spring_names(springs: Sequence[Spring]) -> list[str]:
    """Their names, as they will be filled in."""
    return [one.name or spring_name(number) for number, one in enumerate(springs, 1)]
