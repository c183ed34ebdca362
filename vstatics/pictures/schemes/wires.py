"""The lines of links: where torque passes, cut where others cross them or their names stand."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.schemes.placing import Placement
from vstatics.pictures.schemes.scheme import Scheme, SchemeState
from vstatics.pictures.sheet.groups import grouped
from vstatics.pictures.sheet.labels import Point, Segment, Span, width

CUT = 4.0
"""Half the gap of a wire where another crosses it. [pt]"""
WIRE_NAME_GAP = 3.0
"""From a name to the line on which it stands. [pt]"""


class WireLines(NamedTuple):
    """The lines of a link: level ones from left to right, upright ones from below [pt]."""

    loaded: Sequence[Segment]
    pale: Sequence[Segment]
    """No torque passes these."""
    points: set[Point]
    """Where loaded lines begin, end, or branch: torque passes the joints there."""


def wire_lines(placement: Placement, scheme: Scheme, state: SchemeState) -> dict[int, WireLines]:
    """All level and upright lines of each wire.

    Torque passes a piece of a wire if on both sides of it there is something that carries
    torque: a member of a device, a port.
    """
    gaps = [((wire, y), x, CUT) for x, y, _, wire in placement.crossings()]
    for wire, (x, y) in placement.labels.items():
        gaps.append(((wire, y), x, width(scheme.name(wire)) / 2 + WIRE_NAME_GAP))
    cuts = grouped((level, (x - half, x + half)) for level, x, half in gaps)
    lines = grouped([*_upright(placement), *_level(placement)])
    ends = grouped(_ends(placement, scheme, state))
    found: dict[int, WireLines] = {}
    for wire, own in lines.items():
        runs = [(line, True) for line in own]
        points = {at for line in own for at in line}
        if state.loaded is not None:
            runs, points = passed(own, {*ends.get(wire, ())})
        pieces = [
            (piece, there)
            for line, there in runs
            for piece in _cut(line, cuts.get((wire, line[0][1]), []))
        ]
        loaded, pale = ([piece for piece, one in pieces if one == there] for there in (True, False))
        found[wire] = WireLines(loaded, pale, points)
    return found


def passed(
    lines: Sequence[Segment], met: set[Point]
) -> tuple[list[tuple[Segment, bool]], set[Point]]:
    """Lines in pieces, and whether torque passes each; the points of those that it passes.

    Parameters
    ----------
    met : set of Point
        Where something that carries torque meets the lines.

    >>> passed([((0, 0), (4, 0)), ((2, 0), (2, 3))], {(0, 0), (2, 3)})[0]
    [(((0, 0), (2, 0)), True), (((2, 0), (4, 0)), False), (((2, 0), (2, 3)), True)]
    """
    split = [_split(line, lines, met) for line in lines]
    steps = [step for points in split for step in pairwise(points)]
    kept = _between(met, steps)
    runs = [run for along in split for run in _runs(along, kept)]
    return runs, {at for step in kept for at in step}


def _level(placement: Placement) -> Iterator[tuple[int, Segment]]:
    """Those of tracks."""
    for track, (left, right) in placement.row.spans.items():
        y = placement.y(track)
        yield track[0], ((left, y), (right, y))


def _upright(placement: Placement) -> Iterator[tuple[int, Segment]]:
    """Those of taps; two that meet from above and below are one."""
    spans = grouped(((wire, x), (low, high)) for x, low, high, wire in placement.verticals())
    for (wire, x), own in spans.items():
        ends = sorted(own)
        if len(ends) > 1 and ends[0][1] >= ends[1][0]:
            ends = [(ends[0][0], ends[-1][1])]
        yield from ((wire, ((x, low), (x, high))) for low, high in ends)


def _ends(placement: Placement, scheme: Scheme, state: SchemeState) -> Iterator[tuple[int, Point]]:
    """Where something that carries torque meets each wire."""
    loaded = state.loaded or ()
    taps = [tap for tap in placement.row.taps if tap.item < len(loaded) and tap.reach != "none"]
    outside = {tap.item for tap in taps if tap.reach != "row"}
    for tap in taps:
        if tap.wire in loaded[tap.item] and (tap.reach != "row" or tap.item not in outside):
            yield tap.wire, (tap.x, tap.y if tap.reach == "row" else placement.edge(tap.side))
    for port in scheme.ports:
        if port not in state.idle_ports:
            x = 0.0 if port.is_left else placement.row.width
            yield port.link, (x, placement.y(placement.end_of(port.link)))


def _split(line: Segment, others: Iterable[Segment], ends: Iterable[Point]) -> list[Point]:
    """The points of a line at which it may branch, in their order."""
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
    """The steps that are left if those that lead to no end are taken away."""
    kept = {step for step in steps if step[0] != step[1]}
    while True:
        points = [at for step in kept for at in step]
        loose = {at for at in points if points.count(at) == 1} - ends
        if not loose:
            return kept
        kept = {step for step in kept if not loose & {*step}}


def _runs(points: Sequence[Point], kept: set[Segment]) -> Iterator[tuple[Segment, bool]]:
    """A line in as few pieces as differ in whether torque passes."""
    start = 0
    marks = [step in kept for step in pairwise(points)]
    for place, mark in enumerate(marks, 1):
        if place == len(marks) or marks[place] != mark:
            yield (points[start], points[place]), mark
            start = place


def _cut(line: Segment, gaps: Iterable[Span]) -> Iterator[Segment]:
    """What gaps leave of a level line."""
    (left, y), (right, top) = line
    if left == right:
        yield line
        return
    for start, stop in sorted(gaps):
        if start >= right or stop <= left:
            continue
        if start > left:
            yield (left, y), (start, top)
        left = max(left, stop)
    if right > left:
        yield (left, y), (right, top)
