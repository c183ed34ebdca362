"""Division of the lines of a link into pieces with and without torque."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Segment


def passed(
    lines: Sequence[Segment], met: set[Point]
) -> tuple[list[tuple[Segment, bool]], set[Point]]:
    """Return pieces of lines, each with True for a piece with torque, and points with torque.

    Parameters
    ----------
    met : set of Point
        Points where torque-carrying components meet the lines.

    >>> passed([((0, 0), (4, 0)), ((2, 0), (2, 3))], {(0, 0), (2, 3)})[0]
    [(((0, 0), (2, 0)), True), (((2, 0), (4, 0)), False), (((2, 0), (2, 3)), True)]
    """
    split = [_split(line, lines, met) for line in lines]
    steps = [step for points in split for step in pairwise(points)]
    loaded = _between(met, steps)
    runs = [run for along in split for run in _runs(along, loaded)]
    return runs, {at for step in loaded for at in step}


def _split(line: Segment, others: Iterable[Segment], ends: Iterable[Point]) -> list[Point]:
    """Return the points where a line can branch, in order."""
    points = {*line, *(at for at in ends if _is_on(at, line))}
    is_upright = line[0][0] == line[1][0]
    for other in others:
        upright, level = (line, other) if is_upright else (other, line)
        at = upright[0][0], level[0][1]
        if _is_on(at, line) and _is_on(at, other):
            points.add(at)
    return sorted(points)


def _is_on(at: Point, line: Segment) -> bool:
    (left, low), (right, high) = line
    return left <= at[0] <= right and low <= at[1] <= high


def _between(ends: set[Point], steps: Iterable[Segment]) -> set[Segment]:
    """Return the steps that remain when dead ends that do not reach `ends` are removed."""
    remaining = {step for step in steps if step[0] != step[1]}
    while True:
        points = [at for step in remaining for at in step]
        loose = {at for at in points if points.count(at) == 1} - ends
        if not loose:
            return remaining
        remaining = {step for step in remaining if not loose & {*step}}


def _runs(points: Sequence[Point], loaded: set[Segment]) -> Iterator[tuple[Segment, bool]]:
    """Yield pieces of a line, as long as possible, each with True for a piece with torque."""
    start = 0
    marks = [step in loaded for step in pairwise(points)]
    for place, mark in enumerate(marks, 1):
        if place == len(marks) or marks[place] != mark:
            yield (points[start], points[place]), mark
            start = place
