"""The order of the stations: few crossings, short hollow shafts, clutch first, output last."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.places import AxesPlaces, places
from vstatics.pictures.schemes.axes.starts import starts
from vstatics.pictures.schemes.axes.stations import Station
from vstatics.pictures.schemes.axes.wires import EPSILON, crossings, link_lines, overlaps

CROSSING, HOLLOW, DRUM = 150.0, 1.5, 1.3
"""What a crossing costs, and a length of a hollow shaft, or of a drum, over one of a shaft."""
NEIGHBOURS = 90.0
"""What it is worth that two clutches are on one hub."""
LAST = 0.4
"""What a length costs from a final drive to the right end. [1/pt]"""
FIRST = 80.0
"""What a station costs that is on the left of the clutch of the input."""
THROUGH = 300.0
"""What a shaft costs that runs through a differential of which it is no part."""
MOST_PASSES = 30
Step = Callable[[StationOrder], Iterator[StationOrder]]


def arranged(board: AxesBoard) -> AxesPlaces:
    """The best places found: single steps, each the best for its station, until none is better.

    Nothing is by chance, so a case always looks the same.
    """
    best = None
    for start in starts(board):
        found = _improved(board, start)
        if best is None or found[0] < best[0]:
            best = found
    assert best is not None  # noqa: S101 - there is a start
    return best[1]


def _improved(board: AxesBoard, start: StationOrder) -> tuple[float, AxesPlaces]:
    """The end of a walk downhill."""
    found = places(board, start)
    cost = cost_of(found)
    for _ in range(MOST_PASSES):
        before = cost
        for steps in _steps(board):
            for step in steps(found.chosen):
                other = places(board, step)
                value = cost_of(other, cost)
                if value < cost - 1e-9:
                    cost, found = value, other
        if cost == before:
            break
    return cost, found


def _steps(board: AxesBoard) -> Iterator[Step]:
    """All kinds of steps."""
    count = len(board.stations)
    for index in range(count):
        yield partial(_moved, board, index=index, length=1)
        if board.ways(index) > 1:
            yield partial(_turned, board, index=index)
    yield partial(_rerouted, board)
    for length in (2, 3):
        for index in range(count):
            yield partial(_moved, board, index=index, length=length)


def _moved(
    board: AxesBoard, chosen: StationOrder, *, index: int, length: int
) -> Iterator[StationOrder]:
    """Some groups to all places that differ in a row, forward and backward."""
    at = next(n for n, group in enumerate(chosen.groups) if index in group)
    if index != chosen.groups[at][0] or at + length > len(chosen.groups):
        return
    block, rest = chosen.groups[at : at + length], chosen.groups[:at] + chosen.groups[at + length :]
    backward = tuple(group[::-1] for group in reversed(block))
    for place in range(len(rest) + 1):
        before = rest[place - 1] if place else ()
        if place and all(board.apart[one, n] for group in block for one in group for n in before):
            continue
        for own in (block, backward) if backward != block else (block,):
            yield chosen._replace(groups=(*rest[:place], *own, *rest[place:]))


def _turned(board: AxesBoard, chosen: StationOrder, *, index: int) -> Iterator[StationOrder]:
    for way in range(board.ways(index)):
        ways = (*chosen.ways[:index], way, *chosen.ways[index + 1 :])
        yield chosen._replace(ways=ways)


def _rerouted(board: AxesBoard, chosen: StationOrder) -> Iterator[StationOrder]:
    """Links as drums or as shafts, ports at the other end of their rows."""
    for link in board.axis_of:
        if link in board.may_be_drums:
            other = chosen._replace(drums=chosen.drums ^ {link})
            yield other
            for index, one in enumerate(board.stations):
                if one.kind == "set" and link in one.links:
                    yield from _turned(board, other, index=index)
    for port in board.ports:
        if port.role != "input":
            yield chosen._replace(rightward=chosen.rightward ^ {port.link})


def cost_of(found: AxesPlaces, limit: float = float("inf")) -> float:
    """Of places: what is wanted least is dearest."""
    board = found.board
    value = 2 * max(found.xs)
    wheeled = board.wheels
    for link, span in found.spans.items():
        long = span.right - span.left
        value += 0.5 * long
        if span.level > 0:
            value += HOLLOW * long
        elif span.level < 0:
            value += DRUM * long + 30
            value += 1e3 * (link in wheeled and not board.set_halves[found.axis_of(link)])
    value += sum(20.0 for port in board.ports if _is_turned(found, port.link, port.role))
    value -= NEIGHBOURS * _shared_hubs(found)
    value += _misplaced(found)
    order = found.chosen.order
    value += 0.02 * sum(one > other for one, other in pairwise(order))
    if value > limit:
        return value
    lines = link_lines(found)
    return value + CROSSING * (len(crossings(lines)) + 3 * overlaps(lines))


def _misplaced(found: AxesPlaces) -> float:
    """How far the final drive is from the right end, the clutch of the input from the left."""
    board, value, right = found.board, 0.0, max(found.xs)
    for x, one in zip(found.xs, board.stations, strict=True):
        if one.kind == "pair" and board.rim & {*one.axes}:
            before = {*one.axes} - board.rim
            own = [n for n, other in enumerate(board.stations) if {*other.axes} & before]
            value += LAST * (right - x) + FIRST * sum(found.xs[n] > x for n in own)
        elif one.kind == "section":
            value += THROUGH * len(list(passing(found, one, x)))
        elif one.kind == "differential":
            axis = one.axes[0]
            own_axis = [link for link in found.spans if found.axis_of(link) == axis]
            spans = [found.spans[link] for link in own_axis if link != one.links[2]]
            through = (span.level >= 0 and span.left < x < span.right for span in spans)
            value += THROUGH * sum(through)
        elif board.entry & {*one.links}:
            own = [n for n, other in enumerate(board.stations) if {*other.axes} & {*one.axes}]
            value += FIRST * sum(found.xs[n] < x for n in own)
    return value


def passing(found: AxesPlaces, section: Station, x: float) -> Iterator[int]:
    """Links that would pass through a half-section from one side of it to the other."""
    left, right = x - section.half + EPSILON, x + section.half - EPSILON
    for link, span in found.spans.items():
        if found.axis_of(link) == section.axes[0] and span.left < right and span.right > left:
            yield link


def _is_turned(found: AxesPlaces, link: int, role: str) -> bool:
    """Whether the output leaves at the left."""
    return role == "output" and link not in found.chosen.rightward


def _shared_hubs(found: AxesPlaces) -> int:
    """How often two clutches stand on one hub between the wheels that they join to it."""
    board, count = found.board, 0
    for axis in range(len(board.axes.axes)):
        row = [
            n
            for n in sorted(range(len(found.xs)), key=lambda n: found.xs[n])
            if axis in board.stations[n].axes
        ]
        for one, other in pairwise(row):
            both = board.stations[one], board.stations[other]
            if both[0].kind == both[1].kind == "coupling":
                count += bool(set(both[0].links) & set(both[1].links))
    return count
