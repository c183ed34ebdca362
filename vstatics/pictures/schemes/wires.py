"""The lines of links: where torque passes, cut where others cross them or their names stand."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

from vstatics.pictures.schemes.placing import Placement
from vstatics.pictures.schemes.scheme import Scheme, SchemeState
from vstatics.pictures.sheet.labels import Point

CUT = 4.0
"""Half the gap of a wire where another crosses it. [pt]"""
WIRE_NAME_GAP = 3.0
"""From a name to the line on which it stands. [pt]"""

Stretch = tuple[Point, Point]
"""A level line from left to right, or an upright one from below."""


class WireLines(NamedTuple):
    """The lines of a link [pt]."""

    loaded: Sequence[Stretch]
    pale: Sequence[Stretch]
    """No torque passes these."""
    points: frozenset[Point]
    """Where loaded lines begin, end, or branch."""

    def is_loaded(self, at: Point) -> bool:
        """Whether torque passes the place of a joint."""
        return at in self.points


def wire_lines(
    placement: Placement, widths: Mapping[int, float], scheme: Scheme, state: SchemeState
) -> dict[int, WireLines]:
    """All level and upright lines of each wire.

    Torque passes a piece of a wire if on both sides of it there is something that carries
    torque: a member of a device, a port.

    Parameters
    ----------
    widths : mapping of int to float
        Of the names that stand on their wires. [pt]
    """
    cuts: dict[tuple[int, float], list[tuple[float, float]]] = {}
    for x, y, _, wire in placement.crossings():
        cuts.setdefault((wire, y), []).append((x - CUT, x + CUT))
    for wire, (x, y) in placement.labels.items():
        half = widths[wire] / 2 + WIRE_NAME_GAP
        cuts.setdefault((wire, y), []).append((x - half, x + half))
    lines = _upright(placement)
    for track, (left, right) in placement.row.spans.items():
        y = placement.y(track)
        lines.setdefault(track[0], []).append(((left, y), (right, y)))
    ends = None if state.loaded is None else _ends(placement, scheme, state, state.loaded)
    inside = _inside(placement)
    found: dict[int, WireLines] = {}
    for wire, own in lines.items():
        loaded: list[Stretch] = own
        points = {at for line in own for at in line}
        if ends is not None:
            split = [_split(line, own, ends.get(wire, set())) for line in own]
            steps = [step for points in split for step in pairwise(points)]
            kept = _between(ends.get(wire, set()), [*steps, *inside.get(wire, [])])
            points = {at for step in kept for at in step}
            runs = [(run, there) for along in split for run, there in _runs(along, kept)]
            loaded = [run for run, there in runs if there]
            pale = [run for run, there in runs if not there]
        else:
            pale = []
        found[wire] = WireLines(
            [piece for line in loaded for piece in _cut(line, cuts.get((wire, line[0][1]), []))],
            [piece for line in pale for piece in _cut(line, cuts.get((wire, line[0][1]), []))],
            frozenset(points),
        )
    return found


def _upright(placement: Placement) -> dict[int, list[Stretch]]:
    """Those of taps; two that meet from above and below are one."""
    spans: dict[tuple[int, float], list[tuple[float, float]]] = {}
    for x, low, high, wire in placement.verticals():
        spans.setdefault((wire, x), []).append((low, high))
    lines: dict[int, list[Stretch]] = {}
    for (wire, x), own in spans.items():
        ends = sorted(own)
        if len(ends) > 1 and ends[0][1] >= ends[1][0]:
            ends = [(ends[0][0], ends[-1][1])]
        lines.setdefault(wire, []).extend(((x, low), (x, high)) for low, high in ends)
    return lines


def _ends(
    placement: Placement, scheme: Scheme, state: SchemeState, loaded: Sequence[frozenset[int]]
) -> dict[int, set[Point]]:
    """Where something that carries torque meets each wire."""
    ends: dict[int, set[Point]] = {}
    taps = [tap for tap in placement.row.taps if tap.item < len(loaded) and tap.reach != "none"]
    outside = {tap.item for tap in taps if tap.reach != "row"}
    for tap in taps:
        if tap.wire in loaded[tap.item] and (tap.reach != "row" or tap.item not in outside):
            y = tap.y if tap.reach == "row" else placement.edge(tap.side)
            ends.setdefault(tap.wire, set()).add((tap.x, y))
    for port in scheme.ports:
        if port not in state.idle_ports:
            x = 0.0 if port.role == "input" else placement.row.width
            at = x, placement.y(placement.end_of(port.link))
            ends.setdefault(port.link, set()).add(at)
    return ends


def _inside(placement: Placement) -> dict[int, list[Stretch]]:
    """What joins the wires above and below a device within it: the bar of a carrier."""
    taps: dict[tuple[int, int, float], list[Point]] = {}
    for tap in placement.row.taps:
        if tap.reach == "row":
            taps.setdefault((tap.item, tap.wire, tap.x), []).append((tap.x, tap.y))
    bars: dict[int, list[Stretch]] = {}
    for (_, wire, _), points in taps.items():
        bars.setdefault(wire, []).extend(combinations(points, 2))
    return bars


def _split(line: Stretch, others: Iterable[Stretch], ends: Iterable[Point]) -> list[Point]:
    """The points of a line at which it may branch, in their order."""
    points = {*line, *(at for at in ends if _is_on(at, line))}
    is_upright = line[0][0] == line[1][0]
    for other in others:
        upright, level = (line, other) if is_upright else (other, line)
        at = upright[0][0], level[0][1]
        if _is_on(at, line) and _is_on(at, other):
            points.add(at)
    return sorted(points)


def _is_on(at: Point, line: Stretch) -> bool:
    (left, low), (right, high) = line
    return left <= at[0] <= right and low <= at[1] <= high


def _between(ends: set[Point], steps: Iterable[Stretch]) -> set[Stretch]:
    """The steps that are left if those that lead to no end are taken away."""
    kept = {step for step in steps if step[0] != step[1]}
    while True:
        points = [at for step in kept for at in step]
        loose = {at for at in points if points.count(at) == 1} - ends
        if not loose:
            return kept
        kept = {step for step in kept if not loose & {*step}}


def _runs(points: Sequence[Point], kept: set[Stretch]) -> Iterator[tuple[Stretch, bool]]:
    """A line in as few pieces as differ in whether torque passes."""
    start = 0
    marks = [step in kept for step in pairwise(points)]
    for place, mark in enumerate(marks, 1):
        if place == len(marks) or marks[place] != mark:
            yield (points[start], points[place]), mark
            start = place


def _cut(line: Stretch, gaps: Iterable[tuple[float, float]]) -> Iterator[Stretch]:
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
