"""Springs and other elastic components: their twists, torque curves and limits."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from vstatics.core.model.parts import HOUSING, NO_DAMPING, Damping
from vstatics.core.model.struts import Strut, StrutCurve
from vstatics.core.start import NamedTuple

Twist = tuple[tuple[int, float], ...]
"""Pairs of link and coefficient. The twist is the sum of link angles times coefficients."""


class TwistCurve(NamedTuple):
    """Torque over twist, piecewise linear between points and extrapolated with the last slopes.

    Examples
    --------
    >>> play = TwistCurve((-0.2, -0.1, 0.1, 0.2), (-30.0, 0.0, 0.0, 30.0))
    >>> play.at(0.05), round(play.at(0.3), 9), round(play.energy(-0.2), 9), play.has_play
    (0.0, 60.0, 1.5, True)
    """

    twists: tuple[float, ...]
    """Twists of the points, at least two, strictly ascending. [rad]"""
    torques: tuple[float, ...]
    """Torques of the points, ascending or constant. [N*m]"""

    @property
    def corners(self) -> tuple[float, ...]:
        """Twists at which the slope of the curve changes [rad]."""
        return self.twists[1:-1]

    def piece(self, number: int) -> tuple[float, float]:
        """Return the straight line of a piece: torque at zero twist [N*m] and slope [N*m/rad]."""
        left, right = self.twists[number : number + 2]
        below, above = self.torques[number : number + 2]
        slope = (above - below) / (right - left)
        return below - slope * left, slope

    def alone(self, number: int) -> TwistCurve:
        """Return the curve that extends a piece as a straight line to both sides."""
        return TwistCurve(self.twists[number : number + 2], self.torques[number : number + 2])

    @property
    def bends(self) -> bool:
        """True unless the curve is a straight line through 0."""
        return len(self.twists) > 2 or self.piece(0)[0] != 0

    def side(self, number: int) -> float:
        """Return the sign of the torque on a piece, +1 or -1; 0 for a piece without torque."""
        torque = sum(self.torques[number : number + 2])
        return math.copysign(1.0, torque) if torque else 0.0

    @property
    def has_gap(self) -> bool:
        """True if the torque is 0 on some pieces of the curve (a gap or play), but not on all."""
        if self.torques.count(0.0) < 2:
            return False
        pieces = self._pieces
        return (0.0, 0.0) in pieces and len({*pieces}) > 1

    @property
    def has_play(self) -> bool:
        """True if the torque is 0 around zero twist."""
        return self.piece(bisect_right(self.corners, 0.0)) == (0.0, 0.0)

    @property
    def steepest(self) -> float:
        """Largest slope [N*m/rad]."""
        return max(slope for _, slope in self._pieces)

    def at(self, twist: float) -> float:
        """Return the torque at a twist [N*m]."""
        value, slope = self.piece(bisect_right(self.corners, twist))
        return value + slope * twist

    def energy(self, twist: float) -> float:
        """Return the integral of the torque from zero twist to a twist [J]."""
        low, high = sorted((0.0, twist))
        ends = (low, *(corner for corner in self.corners if low < corner < high), high)
        energy = sum((self.at(a) + self.at(b)) * (b - a) / 2 for a, b in pairwise(ends))
        return energy if twist > 0 else -energy

    def twist_at(self, torque: float) -> float | None:
        """Return the twist nearest 0 at which a torque [N*m] occurs [rad]; None if it never occurs.

        Examples
        --------
        >>> play = TwistCurve((-0.2, 0.1, 0.2), (0.0, 0.0, 30.0))
        >>> play.twist_at(0.0), play.twist_at(30.0), play.twist_at(-1.0)
        (0.0, 0.2, None)
        """
        bounds = []
        for bisect, anywhere in ((bisect_left, -math.inf), (bisect_right, math.inf)):
            value, slope = self.piece(self._piece(bisect(self.torques, torque) - 1))
            bounds.append((torque - value) / slope if slope else anywhere)
        least, most = bounds
        if math.isinf(least) and math.isinf(most):
            return None
        return min(max(0.0, least), most)

    def slope_at(self, torque: float) -> float:
        """Return the slope at a torque [N*m/rad]; 0 in play or if the torque is never reached.

        At a corner the slope belongs to the piece with the larger magnitude of torque.

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

    @property
    def _pieces(self) -> list[tuple[float, float]]:
        return [self.piece(number) for number in range(len(self.twists) - 1)]

    def _piece(self, number: int) -> int:
        return min(max(number, 0), len(self.twists) - 2)


def straight_curve(stiffness: float) -> TwistCurve:
    """Return the straight curve of a stiffness [N*m/rad]."""
    return TwistCurve((-1.0, 1.0), (-stiffness, stiffness))


class SpringLimit(NamedTuple):
    """Torque limit that grows with the torque of a second spring, as tyre grip with wheel load.

    Parameters
    ----------
    base : float
        Limit at zero torque or force of the other spring. [N*m]
    of : str
        Name of the other spring.
    times : float
        Increase of the limit per torque [-] or force [m] of the other spring. The limit is never
        below 0.
    """

    base: float
    of: str
    times: float


def limit_of(base: float, of: str = "", times: float = 0.0) -> float | SpringLimit:
    """Return the limit from the values of a document: a number unless `of` names another spring."""
    return SpringLimit(base, of, times) if of else base


def limit_fault(of: str = "", times: float | None = None, **_others: Any) -> str:
    """Return a message if values do not define a limit, else an empty text.

    >>> limit_fault("suspension")
    'expected both `of` and `times`, or neither'
    """
    is_complete = bool(of) == (times is not None)
    return "" if is_complete else "expected both `of` and `times`, or neither"


class Spring(NamedTuple):
    """Elastic component whose torque depends on a twist, any linear combination of link angles.

    The coefficients of the twist are the column of the spring in the structural-distribution
    matrix.

    Parameters
    ----------
    twist : mapping of int to float, or pairs of these
        Links with their coefficients. The twist of a shaft is the angle of the first link minus
        the angle of the second. The housing can be omitted, because it does not turn.
    stiffness : float, optional
        Stiffness; a spring without stiffness is a viscous or friction damper. [N*m/rad]
    compliance : float, optional
        Compliance instead of the stiffness. [rad/(N*m)]
    damping : Damping or float
        Damping parallel to the stiffness; a number is viscous. [N*m*s/rad]
    name : str
        By default ``S`` and the number.
    limit : float or SpringLimit, optional
        Largest torque in a scenario, beyond which the spring slips like a tyre. [N*m]
    points : sequence of (float, float), optional
        Ascending twists and torques, instead of a stiffness. Points that begin with (0, 0) apply
        in both directions; they can also begin with a twist below 0. [rad, N*m]
    friction : float
        Dry friction parallel to the spring, in simulation and forced vibration. [N*m]
    strut : Strut, optional
        Hydropneumatic strut, instead of a stiffness.

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
        """Coefficients of the twist by link [-], without the housing and without zeros."""
        pairs = dict(self.twist).items()
        return {link: float(part) for link, part in pairs if link != HOUSING and part}

    @property
    def rate(self) -> float:
        """Stiffness [N*m/rad]: given, from a compliance or strut, or the largest slope."""
        if self.strut:
            return self.strut.slope(self.strut.at)
        if self.points:
            return self.curve.steepest
        if self.compliance:
            return 1 / self.compliance
        return self.stiffness or 0.0

    @property
    def is_damper(self) -> bool:
        """True for a damper: it has no stiffness, and so no torque at constant speeds."""
        return not (self.stiffness or self.compliance or self.points or self.strut)

    @property
    def curve(self) -> TwistCurve | StrutCurve:
        """Curve of the torque over the twist, in both directions."""
        if self.strut:
            return StrutCurve(self.strut)
        points = [*self.points]
        if not points:
            return straight_curve(self.rate)
        if points[0][0] >= 0:  # the points apply in both directions; (0, 0) is not a corner
            points = [*((-twist, -torque) for twist, torque in points[:0:-1]), *points[1:]]
        twists, torques = zip(*points, strict=True)
        return TwistCurve(twists, torques)


def between(first: int, second: int = HOUSING) -> Twist:
    """Return the twist of a shaft between two links, or from a link to the housing.

    >>> between(1, 2), between(3)
    (((1, 1.0), (2, -1.0)), ((3, 1.0), (0, -1.0)))
    """
    return (first, 1.0), (second, -1.0)


def ends(twist: Mapping[int, float] | Twist) -> tuple[int, int] | None:
    """Return both links of a shaft from its twist; None if the twist does not belong to a shaft.

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
    """Return the spring from the values of its keys in a document."""
    return Spring(between(*links) if links else twist or (), **others)


def spring_fault(
    links: tuple[int, int] | None = None, twist: Mapping[int, float] | None = None, **_others: Any
) -> str:
    """Return a message if values do not define a spring, else an empty text.

    >>> spring_fault((1, 2), {1: 1.0})
    'read both `links` and `twist`, expected one of them'
    """
    if links is None and twist is None:
        return "expected `links`, the two links of a shaft, or `twist`, a coefficient for each link"
    if links is not None and twist is not None:
        return "read both `links` and `twist`, expected one of them"
    return ""


def spring_record(spring: Spring) -> dict[str, Any]:
    """Return a spring as a mapping with the keys of a document."""
    links = ends(spring.twist)
    twist = spring.form if links is None else None
    limit = spring.limit
    given = limit if limit is None or isinstance(limit, SpringLimit) else {"base": limit}
    return {**spring._asdict(), "links": links, "twist": twist, "limit": given}


def spring_name(number: int) -> str:
    """Return the default name of a spring: S and the number of the spring."""
    return f"S{number}"


def spring_names(springs: Sequence[Spring]) -> list[str]:
    """Return the names of springs, by default from `spring_name`."""
    return [spring.name or spring_name(number) for number, spring in enumerate(springs, 1)]
