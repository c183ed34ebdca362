"""Orders of the stations from which a better one is sought."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder

IN_CHAINS = frozenset({"coupling", "pair"})
"""Stations that stand in chains."""


def starts(board: AxesBoard) -> Iterator[StationOrder]:
    """From shaft to shaft; in small boxes also in the order of the case."""
    count = len(board.stations)
    ways = (0,) * count
    right = frozenset(port.link for port in board.ports if port.role != "input")
    by_links = _by_links(board)
    roles: dict[int, set[str]] = {}
    for one in board.stations:
        for tap in one.glyphs[0].taps if one.glyphs else ():
            roles.setdefault(tap.wire, set()).add(tap.label)
    drums = {link for link, own in roles.items() if len(own) > 1 and "ring" in own}
    orders = [_by_hubs(board, by_links), by_links, [*range(count)]]
    for order in orders[: 1 if drums else 3]:
        yield StationOrder(groups_of(board, order), ways, frozenset(), right)
    if drums:
        own = frozenset(drums & board.may_be_drums)
        yield StationOrder(groups_of(board, orders[2]), ways, own, right)


def groups_of(board: AxesBoard, order: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """What stands in a chain keeps together: dampers in line, an idle wheel with its clutch."""
    beside: dict[int, list[int]] = {index: [] for index in order}
    group = {index: index for index in order}
    ends = {port.link for port in board.ports}
    for link in board.axis_of:
        own = [index for index in order if link in board.stations[index].links]
        kinds = {board.stations[index].kind for index in own}
        if len(own) != 2 or link in ends or "coupling" not in kinds or not kinds <= IN_CHAINS:
            continue
        one, other = own
        free = all(len(beside[n]) < (1 if board.stations[n].kind == "pair" else 2) for n in own)
        if free and group[one] != group[other] and link not in board.cages:
            beside[one].append(other)
            beside[other].append(one)
            group = {n: group[one] if g == group[other] else g for n, g in group.items()}
    found: list[tuple[int, ...]] = []
    used: set[int] = set()
    for index in order:
        if index not in used:
            chain = _chain(index, beside)
            places = [order.index(one) for one in chain]
            found.append(chain if places[0] <= places[-1] else chain[::-1])
            used |= {*chain}
    return tuple(found)


def _chain(index: int, beside: Mapping[int, Sequence[int]]) -> tuple[int, ...]:
    """All of a chain, from one of its ends."""
    before, at = -1, index
    while ahead := [one for one in beside[at] if one != before]:  # to its end, then back
        before, at = at, ahead[0]
    chain = [at]
    while ahead := [one for one in beside[chain[-1]] if one not in chain]:
        chain.append(ahead[0])
    return tuple(chain)


def _by_hubs(board: AxesBoard, order: Sequence[int]) -> list[int]:
    """Wheels of one shaft together, the clutches of two idle ones between them."""
    clutch: dict[int, int] = {}
    for index, one in enumerate(board.stations):
        for link in one.links if one.kind == "coupling" else ():
            if link in board.idle:
                clutch.setdefault(link, index)
    groups: dict[object, list[tuple[int, int]]] = {}
    for index in order:
        one = board.stations[index]
        own = [link for link in one.links if link in clutch] if one.kind == "pair" else []
        if len(own) == 1:
            (fixed,) = {*one.links} - {*own}
            groups.setdefault((fixed, board.idle[own[0]]), []).append((index, clutch[own[0]]))
    blocks = {}
    for wheels in groups.values():
        block: list[int] = []
        for place, (wheel, dog) in enumerate(wheels):
            block += [dog, wheel] if place % 2 else [wheel, dog]
        blocks[wheels[0][0]] = block
    used = {index for block in blocks.values() for index in block}
    found: list[int] = []
    for index in order:
        found += blocks.get(index, [index] if index not in used else [])
    return list(dict.fromkeys(found))


def _by_links(board: AxesBoard) -> list[int]:
    """Stations by breadth from the input."""
    links = [port.link for port in board.ports if port.role == "input"]
    order: list[int] = []
    for link in links:
        for index, one in enumerate(board.stations):
            if link in one.links and index not in order:
                order.append(index)
                links += [other for other in one.links if other not in links]
    return [*order, *(n for n in range(len(board.stations)) if n not in order)]
