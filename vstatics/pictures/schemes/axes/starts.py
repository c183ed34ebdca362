"""Initial orders of the stations (components on the axes) for the search."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder

IN_CHAINS = frozenset({"coupling", "pair"})
"""Kinds of stations that form chains."""


def starts(board: AxesBoard) -> Iterator[StationOrder]:
    """Yield the order of the case, and an order along the shafts."""
    right = frozenset(port.link for port in board.ports if port.role != "input")
    for order in (range(len(board.stations)), _by_links(board)):
        yield StationOrder(groups_of(board, order), (0,) * len(order), rightward=right)


def groups_of(board: AxesBoard, order: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """Return the groups of stations that stay together: chains, such as dampers in series.

    A gear that rotates freely on its shaft is in a group with its clutch.
    """
    neighbours: dict[int, list[int]] = {index: [] for index in order}
    group = {index: index for index in order}
    ends = {port.link for port in board.ports}
    for link in board.axis_of:
        connected = [index for index in order if link in board.stations[index].links]
        kinds = {board.stations[index].kind for index in connected}
        if len(connected) != 2 or link in ends or "coupling" not in kinds or not kinds <= IN_CHAINS:
            continue
        first, second = connected
        free = all(
            len(neighbours[n]) < (1 if board.stations[n].kind == "pair" else 2) for n in connected
        )
        if free and group[first] != group[second] and link not in board.cages:
            neighbours[first].append(second)
            neighbours[second].append(first)
            group = {n: group[first] if g == group[second] else g for n, g in group.items()}
    groups: list[tuple[int, ...]] = []
    used: set[int] = set()
    for index in order:
        if index not in used:
            chain = _chain(index, neighbours)
            places = [order.index(first) for first in chain]
            groups.append(chain if places[0] <= places[-1] else chain[::-1])
            used |= {*chain}
    return tuple(groups)


def _chain(index: int, neighbours: Mapping[int, Sequence[int]]) -> tuple[int, ...]:
    before, at = -1, index
    while ahead := [
        neighbour for neighbour in neighbours[at] if neighbour != before
    ]:  # walk to one end, then back through the whole chain
        before, at = at, ahead[0]
    chain = [at]
    while ahead := [neighbour for neighbour in neighbours[chain[-1]] if neighbour not in chain]:
        chain.append(ahead[0])
    return tuple(chain)


def _by_links(board: AxesBoard) -> list[int]:
    links = [port.link for port in board.ports if port.role == "input"]
    order: list[int] = []
    for link in links:
        for index, station in enumerate(board.stations):
            if link in station.links and index not in order:
                order.append(index)
                links += [link_ahead for link_ahead in station.links if link_ahead not in links]
    return [*order, *(n for n in range(len(board.stations)) if n not in order)]
