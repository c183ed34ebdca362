"""What bends in a transmission: springs, each with its twist."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from vstatics.model.parts import HOUSING, NO_DAMPING, Damping

Twist = tuple[tuple[int, float], ...]
"""Links with their coefficients: the twist is the sum of coefficient times angle."""


class Spring(NamedTuple):
    """An elastic device: a torque by a twist, which is any linear form of angles.

    Its column in the structural-distribution matrix is its twist.

    Parameters
    ----------
    twist : mapping of int to float, or pairs of these
        Links with their coefficients; that of a shaft is the angle of the first link less
        that of the second. The housing does not turn, so it may be left out.
    stiffness : float, optional
        [N*m/rad]
    compliance : float, optional
        In place of the stiffness. [rad/(N*m)]
    damping : Damping or float
        A number is viscous. [N*m*s/rad]
    name : str
        ``S`` and the number when not given.
    limit : float, optional
        In a scenario its torque stays within it, the rest is slip, as of a tyre. [N*m]

    Examples
    --------
    >>> Spring({1: 1, 2: -1}, compliance=0.002).rate
    500.0
    """

    twist: Mapping[int, float] | Twist
    stiffness: float | None = None
    compliance: float | None = None
    damping: Damping | float = NO_DAMPING
    name: str = ""
    limit: float | None = None

    @property
    def form(self) -> dict[int, float]:
        """The links that turn, with their coefficients, none of them 0."""
        pairs = dict(self.twist).items()
        return {link: float(part) for link, part in pairs if link != HOUSING and part}

    @property
    def rate(self) -> float:
        """The stiffness [N*m/rad], whichever of the two is given."""
        return self.stiffness if self.stiffness is not None else 1 / (self.compliance or 0.0)


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
    return {**spring._asdict(), "links": links, "twist": twist}


def spring_name(number: int) -> str:
    """The name of a spring that has none: S and its number."""
    return f"S{number}"
