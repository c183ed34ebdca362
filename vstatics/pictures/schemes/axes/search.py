"""Search for the order of the stations (components on the axes) from left to right.

Good orders have few crossings, short hollow shafts, the clutch first and the output last.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import pairwise

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.places import AxesPlaces, places
from vstatics.pictures.schemes.axes.starts import starts
from vstatics.pictures.schemes.axes.stations import Station
from vstatics.pictures.schemes.axes.wires import EPSILON, crossings, link_lines, overlaps

CROSSING, HOLLOW, DRUM = 150.0, 1.5, 1.3
"""Cost of a crossing [-], and costs per length of hollow shafts and of drums [1/pt]."""
NEIGHBOURS = 90.0
"""Reduction of the cost for two neighbouring clutches on a common hub. [-]"""
LAST = 0.4
"""Cost per distance of a final drive from the right end of the diagram. [1/pt]"""
LEFT_OF_INPUT = 80.0
"""Cost of each station to the left of the input clutch. [-]"""
THROUGH = 300.0
"""Cost of a shaft that passes through an unconnected differential. [-]"""
MOST_IMPROVEMENTS = 30
"""Largest number of passes over all kinds of changes."""
Step = Callable[[StationOrder], Iterator[StationOrder]]


def arranged(board: AxesBoard) -> AxesPlaces:
    """Return the best positions that repeated single changes of an order reach.

    The search is not random, so a case always looks alike.
    """
    best = None
    placed = cache(partial(places, board))  # most orders are reached from several initial orders
    for start in starts(board):
        improved = _improved(board, start, placed)
        if best is None or improved[0] < best[0]:
            best = improved
    assert best is not None  # noqa: S101 - there is at least one initial order
    return best[1]


def _improved(
    board: AxesBoard, start: StationOrder, placed: Callable[[StationOrder], AxesPlaces]
) -> tuple[float, AxesPlaces]:
    """Return the cost and the positions after improving an initial order by single changes."""
    placing = placed(start)
    cost = cost_of(placing)
    tried = {start}  # the cost only decreases, so an order that was tried cannot be an improvement
    for _ in range(MOST_IMPROVEMENTS):
        before = cost
        for steps in _steps(board):
            for step in steps(placing.chosen):
                if step in tried:
                    continue
                tried.add(step)
                candidate = placed(step)
                value = cost_of(candidate, cost)
                if value < cost - 1e-9:
                    cost, placing = value, candidate
        if cost == before:
            break
    return cost, placing


def _steps(board: AxesBoard) -> Iterator[Step]:
    count = len(board.stations)
    for index in range(count):
        yield partial(_moved, board, index=index, length=1)
        if board.ways(index) > 1:
            yield partial(_turned, board, index=index)
    yield partial(_rerouted, board)
    for index in range(count):
        yield partial(_moved, board, index=index, length=2)


def _moved(
    board: AxesBoard, chosen: StationOrder, *, index: int, length: int
) -> Iterator[StationOrder]:
    """Yield orders in which `length` neighbouring groups are moved, and also reversed.

    Moves that do not change the order on any axis are left out.
    """
    at = next(n for n, group in enumerate(chosen.groups) if index in group)
    if index != chosen.groups[at][0] or at + length > len(chosen.groups):
        return
    block, remaining = (
        chosen.groups[at : at + length],
        chosen.groups[:at] + chosen.groups[at + length :],
    )
    backward, occupied = tuple(group[::-1] for group in reversed(block)), board.occupied
    for place in range(len(remaining) + 1):
        before = remaining[place - 1] if place else ()
        if place and all(
            occupied[moved].isdisjoint(occupied[n])
            for group in block
            for moved in group
            for n in before
        ):
            continue
        for moved in (block, backward) if backward != block else (block,):
            yield chosen._replace(groups=(*remaining[:place], *moved, *remaining[place:]))


def _turned(board: AxesBoard, chosen: StationOrder, *, index: int) -> Iterator[StationOrder]:
    for way in range(board.ways(index)):
        ways = (*chosen.ways[:index], way, *chosen.ways[index + 1 :])
        yield chosen._replace(ways=ways)


def _rerouted(board: AxesBoard, chosen: StationOrder) -> Iterator[StationOrder]:
    """Yield choices with a link changed to a drum or shaft, or a port moved to the other end."""
    for link in board.axis_of:
        if link in board.may_be_drums:
            rerouted = chosen._replace(drums=chosen.drums ^ {link})
            yield rerouted
            for index, station in enumerate(board.stations):
                if station.kind == "set" and link in station.links:
                    yield from _turned(board, rerouted, index=index)
    for port in board.ports:
        if port.role != "input":
            yield chosen._replace(rightward=chosen.rightward ^ {port.link})


def cost_of(placing: AxesPlaces, limit: float = float("inf")) -> float:
    """Return the cost of positions; above the limit, a lower bound of the cost."""
    board = placing.board
    value = 2 * max(placing.xs)
    wheeled = board.wheels
    for link, span in placing.spans.items():
        long = span.right - span.left
        value += 0.5 * long
        if span.level > 0:
            value += HOLLOW * long
        elif span.level < 0:
            value += DRUM * long + 30
            value += 1e3 * (link in wheeled and not board.set_halves[placing.axis_of(link)])
    rightward = placing.chosen.rightward
    value += sum(20.0 for p in board.ports if p.role == "output" and p.link not in rightward)
    value -= NEIGHBOURS * _shared_hubs(placing)
    value += _misplaced(placing)
    order = placing.chosen.order
    value += 0.02 * sum(left > right for left, right in pairwise(order))
    if value > limit:
        return value
    lines = link_lines(placing)
    return value + CROSSING * (len(crossings(lines)) + 3 * overlaps(lines))


def _misplaced(placing: AxesPlaces) -> float:
    """Return the cost of final drives not at the right end, and of input clutches not at the left.

    Links that pass through half-sections and differentials also count.
    """
    board, value, right = placing.board, 0.0, max(placing.xs)
    for x, station in zip(placing.xs, board.stations, strict=True):
        if station.kind == "pair" and board.rim & {*station.axes}:
            before = {*station.axes} - board.rim
            earlier = [n for n, station in enumerate(board.stations) if {*station.axes} & before]
            value += LAST * (right - x) + LEFT_OF_INPUT * sum(placing.xs[n] > x for n in earlier)
        elif station.kind == "section":
            value += THROUGH * len(list(passing(placing, station, x)))
        elif station.kind == "differential":
            through = (
                span.left < x < span.right and placing.axis_of(link) == station.axes[0]
                for link, span in placing.spans.items()
                if span.level >= 0 and link != station.links[2]
            )
            value += THROUGH * sum(through)
        elif board.entry & {*station.links}:
            value += LEFT_OF_INPUT * sum(other < x for other in placing.xs)
    return value


def passing(placing: AxesPlaces, section: Station, x: float) -> Iterator[int]:
    """Yield the links on the axis of a half-section that would pass through the section."""
    left, right = x - section.half + EPSILON, x + section.half - EPSILON
    for link, span in placing.spans.items():
        if placing.axis_of(link) == section.axes[0] and span.left < right and span.right > left:
            yield link


def _shared_hubs(placing: AxesPlaces) -> int:
    """Return the number of neighbouring clutches on a common hub between gears."""
    board, count = placing.board, 0
    order = sorted(range(len(placing.xs)), key=placing.xs.__getitem__)
    stations = [board.stations[n] for n in order]
    for axis in range(len(board.axes.axes)):
        for left, right in pairwise([station for station in stations if axis in station.axes]):
            if left.kind == right.kind == "coupling":
                count += not {*left.links}.isdisjoint(right.links)
    return count
