"""Initial orders of the stations (components on the axes) for the search."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

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
    chains: dict[int, tuple[int, ...]] = {index: (index,) for index in order}
    excluded = {port.link for port in board.ports} | board.cages
    for link in board.axis_of:
        connected = [index for index in order if link in board.stations[index].links]
        kinds = {board.stations[index].kind for index in connected}
        is_shared = len(connected) == 2 and link not in excluded
        if not is_shared or "coupling" not in kinds or not kinds <= IN_CHAINS:
            continue
        first, second = connected
        before, after = chains[first], chains[second]
        # A gear pair is at the end of a chain.
        are_ends = all(
            n in {chain[0], chain[-1]} and (len(chain) == 1 or board.stations[n].kind != "pair")
            for n, chain in ((first, before), (second, after))
        )
        if are_ends and before != after:
            chain = before if before[-1] == first else before[::-1]
            chain += after if after[0] == second else after[::-1]
            chains |= dict.fromkeys(chain, chain)
    groups = dict.fromkeys(chains[index] for index in order)
    return tuple(
        group if order.index(group[0]) <= order.index(group[-1]) else group[::-1]
        for group in groups
    )


def _by_links(board: AxesBoard) -> list[int]:
    links = [port.link for port in board.ports if port.role == "input"]
    order: list[int] = []
    for link in links:
        for index, station in enumerate(board.stations):
            if link in station.links and index not in order:
                order.append(index)
                links += [link_ahead for link_ahead in station.links if link_ahead not in links]
    return [*order, *(n for n in range(len(board.stations)) if n not in order)]
