"""Pieces of a torque law between its jumps over the speed or the angle of its link.

Points jump where an abscissa repeats. Formulas jump at comparisons and at `sign`, where the speed
or angle is fixed (`corners`) or moves with time or angle (`surfaces`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import groupby, pairwise, product
from typing import NamedTuple

from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Curve, Over, Points, constant

_MOST_JUMPS = 100
"""Number of fixed jumps of a formula above which the formula is not split."""
_ANYTHING = 0.7390851332151607
"""Arbitrary value for other quantities in a formula, to compare two versions of the formula."""
_MOST_SURFACES = 4
"""Number of moving jumps up to which a formula is split, as n jumps give 2^n combinations."""


class LawJump(NamedTuple):
    """Speed or angle of a link at which a torque law jumps."""

    over: Over
    at: Curve
    """Speed or angle of the jump. [rad/s or rad]"""
    side: str = "+"
    """Side of the jump (`+` or `-`) to which the value right at the jump belongs."""
    by_angle: float = 0.0
    """Derivative of the jump's speed with respect to the angle of the link. [1/s]"""

    @property
    def speed(self) -> Curve:
        """Speed of a motion that slides along the jump, without its term in the angle [rad/s]."""
        return self.at if self.over == "speed" else curve_slope(self.at)

    @property
    def change(self) -> Curve:
        """Derivative of `speed` with respect to time [rad/s^2]."""
        return curve_slope(self.speed)

    @property
    def rests(self) -> bool:
        """True if the speed of the jump is always 0."""
        return self.speed == constant(0.0) and not self.by_angle


class LawPiece(NamedTuple):
    """Piece of a torque law between neighbouring jumps."""

    law: Points | Formula
    when: tuple[tuple[int, str], ...] = ()
    """Indices of the adjacent jumps, each with its side (`+` or `-`) on which the piece holds."""


def split_at_jumps(law: Points | Formula) -> tuple[list[LawJump], list[LawPiece]]:
    """Return the jumps of a law over speed or angle, and its pieces between them.

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
    if law.over == "time":
        return [], [LawPiece(law)]
    jumps: list[LawJump] = []
    begins, ends = [0], []
    for at, group in groupby(range(len(law.x)), key=law.x.__getitem__):
        first, *repeated = group
        if repeated:
            jumps.append(LawJump(law.over, constant(at)))
            ends.append(first + 1)
            begins.append(repeated[-1])
    ranges = [slice(*ends) for ends in zip(begins, [*ends, len(law.x)], strict=True)]
    pieces = [
        LawPiece(Points(law.x[points_between], law.y[points_between], law.over), sides)
        for points_between, sides in zip(ranges, _adjacent(0, len(jumps)), strict=True)
    ]
    return jumps, pieces


def _of_formula(law: Formula) -> tuple[list[LawJump], list[LawPiece]]:
    speeds, angles = law.jumps("speed"), law.jumps("angle")
    if len(speeds) + len(angles) > _MOST_JUMPS:
        return [], [LawPiece(law)]
    jumps = [*_jumps(law, "speed", speeds), *_jumps(law, "angle", angles)]
    pieces: list[LawPiece] = []
    by_speed = zip(_intervals(speeds), _adjacent(0, len(speeds)), strict=True)
    by_angle = [*zip(_intervals(angles), _adjacent(len(speeds), len(angles)), strict=True)]
    for speed, sides in by_speed:
        for angle, sides_by_angle in by_angle:
            inner = law.between("speed", *speed).between("angle", *angle)
            pieces += _between_surfaces(inner, (*sides, *sides_by_angle), jumps)
    return jumps, pieces if jumps else [LawPiece(law)]


def _between_surfaces(
    law: Formula, sides_at_jumps: tuple[tuple[int, str], ...], jumps: list[LawJump]
) -> Iterator[LawPiece]:
    """Yield the pieces of a law between moving jumps, and append the jumps to `jumps`."""
    surfaces = law.surfaces
    if len(surfaces) > _MOST_SURFACES:
        surfaces = {}
    numbers = []
    for (over, at, by_angle), side in surfaces.items():
        jump = LawJump(over, _constant_or_formula(law._replace(tree=at)), side, by_angle)
        if jump not in jumps:
            jumps.append(jump)
        numbers.append(jumps.index(jump))
    for sides in product("-+", repeat=len(surfaces)):
        piece = law
        for surface, side in zip(surfaces, sides, strict=True):
            piece = piece.on_side(surface, 1.0 if side == "+" else -1.0)
        yield LawPiece(
            _constant_or_formula(piece), (*sides_at_jumps, *zip(numbers, sides, strict=True))
        )


def _jumps(law: Formula, over: Over, places: tuple[float, ...]) -> Iterator[LawJump]:
    for place, before in zip(places, _intervals(places), strict=False):
        below = law.between(over, *before)
        right_there = (0.0, place, 0.0) if over == "speed" else (0.0, 0.0, place)
        is_below = _at(below, right_there) == _at(law, right_there)
        yield LawJump(over, constant(place), "-" if is_below else "+")


def _at(law: Formula, motion: tuple[float, float, float]) -> float:
    """Return the value of a law; quantities other than `motion` have an arbitrary value."""
    return law.function(*motion, *[_ANYTHING] * len(law.seen))


def _constant_or_formula(formula: Formula) -> Points | Formula:
    if formula.variables or formula.seen:
        return formula
    return constant(formula.function(0.0, 0.0, 0.0))


def curve_slope(curve: Curve) -> Curve:
    """Return the derivative of a curve with respect to time."""
    if isinstance(curve, Formula):
        return _constant_or_formula(curve.slope)
    slopes = [curve.piece(number)[1] for number in range(len(curve.x) + 1)]
    if not any(slopes):
        return constant(0.0)
    ends = [(x, slopes[number + after]) for number, x in enumerate(curve.x) for after in (0, 1)]
    times, values = zip(*ends, strict=True)
    return Points(times, values)


def _intervals(places: tuple[float, ...]) -> list[tuple[float, float]]:
    return [*pairwise([-math.inf, *places, math.inf])]


def _adjacent(first: int, count: int) -> list[tuple[tuple[int, str], ...]]:
    """Return the jumps at the ends of each interval: index, and side (+ or -) of the interval."""
    return [
        tuple(
            (first + number, side)
            for number, side in ((place - 1, "+"), (place, "-"))
            if 0 <= number < count
        )
        for place in range(count + 1)
    ]
