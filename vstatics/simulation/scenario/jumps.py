"""A law of a torque that jumps over the speed or the angle of its link: its pieces between jumps.

Points do where an abscissa repeats, formulas by comparisons and `sign`, at a number (`corners`) or
at what depends on time or angle (`surfaces`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import groupby, pairwise, product
from typing import NamedTuple

from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Over, Points, constant

_MOST_JUMPS = 100
"""Of a formula; with more of them it is taken as it stands."""
_ANYTHING = 0.7390851332151607
"""What is seen elsewhere, where all that counts is whether two values are the same."""
_MOST_SURFACES = 4
"""The same of those that depend on time, which may cross."""


class LawJump(NamedTuple):
    """Where a law jumps."""

    over: Over
    at: Curve
    """[rad/s or rad]"""
    side: str = "+"
    """On which side its own value is: that of the points, or the formula, right there."""
    by_angle: float = 0.0
    """What a speed there has besides, by the angle. [1/s]"""

    @property
    def speed(self) -> Curve:
        """At which a motion slides along it, but for what the angle adds [rad/s]."""
        return self.at if self.over == "speed" else curve_slope(self.at)

    @property
    def change(self) -> Curve:
        """That of this speed with time [rad/s^2]."""
        return curve_slope(self.speed)

    @property
    def rests(self) -> bool:
        """Whether this speed is always 0."""
        return self.speed == constant(0.0) and not self.by_angle


class LawPiece(NamedTuple):
    """A law between jumps."""

    law: Points | Formula
    when: tuple[tuple[int, str], ...] = ()
    """Numbers of the jumps beside it, and on which side of each it holds."""


def split_at_jumps(law: Points | Formula) -> tuple[list[LawJump], list[LawPiece]]:
    """Where a law jumps over a speed or an angle, and what it is between.

    Examples
    --------
    >>> limiter = Points((0.0, 300.0, 300.0), (100.0, 100.0, 0.0), "speed")
    >>> jumps, pieces = split_at_jumps(limiter)
    >>> jumps
    [LawJump(over='speed', at=Points(x=(0.0,), y=(300.0,), over='time'), side='+', by_angle=0.0)]
    >>> [(piece.law.y, piece.when) for piece in pieces]
    [((100.0, 100.0), ((0, '-'),)), ((0.0,), ((0, '+'),))]
    """
    if isinstance(law, Formula):
        return _of_formula(law)
    return ([], [LawPiece(law)]) if law.over == "time" else _of_points(law)


def _of_points(law: Points) -> tuple[list[LawJump], list[LawPiece]]:
    jumps: list[LawJump] = []
    begins, ends = [0], []
    for at, group in groupby(range(len(law.x)), key=law.x.__getitem__):
        first, *others = group
        if others and law.over != "time":
            jumps.append(LawJump(law.over, constant(at)))
            ends.append(first + 1)
            begins.append(others[-1])
    parts = [slice(*ends) for ends in zip(begins, [*ends, len(law.x)], strict=True)]
    pieces = [
        LawPiece(Points(law.x[part], law.y[part], law.over), beside)
        for part, beside in zip(parts, _beside(0, len(jumps)), strict=True)
    ]
    return jumps, pieces


def _of_formula(law: Formula) -> tuple[list[LawJump], list[LawPiece]]:
    speeds, angles = law.jumps("speed"), law.jumps("angle")
    if len(speeds) + len(angles) > _MOST_JUMPS:
        return [], [LawPiece(law)]
    jumps = [*_jumps(law, "speed", speeds), *_jumps(law, "angle", angles)]
    pieces: list[LawPiece] = []
    by_speed = zip(_intervals(speeds), _beside(0, len(speeds)), strict=True)
    by_angle = [*zip(_intervals(angles), _beside(len(speeds), len(angles)), strict=True)]
    for speed, beside in by_speed:
        for angle, others in by_angle:
            inner = law.between("speed", *speed).between("angle", *angle)
            pieces += _between_surfaces(inner, (*beside, *others), jumps)
    return jumps, pieces if jumps else [LawPiece(law)]


def _between_surfaces(
    law: Formula, beside: tuple[tuple[int, str], ...], jumps: list[LawJump]
) -> Iterator[LawPiece]:
    """The pieces of a law between its jumps that depend on time or angle; these are added."""
    surfaces = law.surfaces
    if len(surfaces) > _MOST_SURFACES:
        surfaces = {}
    numbers = []
    for (over, at, by_angle), side in surfaces.items():
        jump = LawJump(over, _plain(law._replace(tree=at)), side, by_angle)
        if jump not in jumps:
            jumps.append(jump)
        numbers.append(jumps.index(jump))
    for sides in product("-+", repeat=len(surfaces)):
        piece = law
        for surface, side in zip(surfaces, sides, strict=True):
            piece = piece.on_side(surface, 1.0 if side == "+" else -1.0)
        yield LawPiece(_plain(piece), (*beside, *zip(numbers, sides, strict=True)))


def _jumps(law: Formula, over: Over, places: tuple[float, ...]) -> Iterator[LawJump]:
    for at, before in zip(places, _intervals(places), strict=False):
        below = law.between(over, *before)
        right_there = (0.0, at, 0.0) if over == "speed" else (0.0, 0.0, at)
        own = _at(below, right_there) == _at(law, right_there)
        yield LawJump(over, constant(at), "-" if own else "+")


def _at(law: Formula, own: tuple[float, float, float]) -> float:
    """The value of a law, whatever else it sees."""
    return law.function(*own, *[_ANYTHING] * len(law.seen))


def _plain(formula: Formula) -> Points | Formula:
    """A number where nothing else is left."""
    if formula.variables or formula.seen:
        return formula
    return constant(formula.function(0.0, 0.0, 0.0))


def curve_slope(curve: Curve) -> Curve:
    """The change of a place or a speed with time."""
    if isinstance(curve, Formula):
        return _plain(curve.slope)
    slopes = [curve.piece(number)[1] for number in range(len(curve.x) + 1)]
    if not any(slopes):
        return constant(0.0)
    ends = [(x, slopes[number + after]) for number, x in enumerate(curve.x) for after in (0, 1)]
    times, values = zip(*ends, strict=True)
    return Points(times, values)


def _intervals(places: tuple[float, ...]) -> list[tuple[float, float]]:
    return [*pairwise([-math.inf, *places, math.inf])]


def _beside(first: int, count: int) -> list[tuple[tuple[int, str], ...]]:
    """Of each interval between jumps, the jumps at its ends."""
    return [
        tuple(
            (first + number, side)
            for number, side in ((place - 1, "+"), (place, "-"))
            if 0 <= number < count
        )
        for place in range(count + 1)
    ]
