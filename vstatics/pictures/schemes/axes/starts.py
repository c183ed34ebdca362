"""Initial orders of the stations (components on the axes) for the search."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder

IN_CHAINS = frozenset({"coupling", "pair"})
"""Kinds of stations that form chains."""


def starts(board: AxesBoard) -> Iterator[StationOrder]:
    """Yield an order along the shafts and, for small gearboxes, the order of the case."""
    count = len(board.stations)
    ways = (0,) * count
    right = frozenset(port.link for port in board.ports if port.role != "input")
    by_links = _by_links(board)
    roles: dict[int, set[str]] = {}
    for station in board.stations:
        for tap in station.glyphs[0].taps if station.glyphs else ():
            roles.setdefault(tap.wire, set()).add(tap.label)
    drums = {link for link, labels in roles.items() if len(labels) > 1 and "ring" in labels}
    orders = [_by_hubs(board, by_links), by_links, [*range(count)]]
    for order in orders[: 1 if drums else 3]:
        yield StationOrder(groups_of(board, order), ways, frozenset(), right)
    if drums:
        allowed = frozenset(drums & board.may_be_drums)
        yield StationOrder(groups_of(board, orders[2]), ways, allowed, right)


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


def _by_hubs(board: AxesBoard, order: Sequence[int]) -> list[int]:
    """Return an order with the gears of each shaft together, and clutches between the gears."""
    clutch: dict[int, int] = {}
    for index, station in enumerate(board.stations):
        for link in station.links if station.kind == "coupling" else ():
            if link in board.idle:
                clutch.setdefault(link, index)
    groups: dict[object, list[tuple[int, int]]] = {}
    for index in order:
        station = board.stations[index]
        idle_links = (
            [link for link in station.links if link in clutch] if station.kind == "pair" else []
        )
        if len(idle_links) == 1:
            (fixed,) = {*station.links} - {*idle_links}
            groups.setdefault((fixed, board.idle[idle_links[0]]), []).append(
                (index, clutch[idle_links[0]])
            )
    blocks = {}
    for wheels in groups.values():
        block: list[int] = []
        for place, (wheel, dog) in enumerate(wheels):
            block += [dog, wheel] if place % 2 else [wheel, dog]
        blocks[wheels[0][0]] = block
    used = {index for block in blocks.values() for index in block}
    hub_order: list[int] = []
    for index in order:
        hub_order += blocks.get(index, [index] if index not in used else [])
    return list(dict.fromkeys(hub_order))


def _by_links(board: AxesBoard) -> list[int]:
    links = [port.link for port in board.ports if port.role == "input"]
    order: list[int] = []
    for link in links:
        for index, station in enumerate(board.stations):
            if link in station.links and index not in order:
                order.append(index)
                links += [link_ahead for link_ahead in station.links if link_ahead not in links]
    return [*order, *(n for n in range(len(board.stations)) if n not in order)]
