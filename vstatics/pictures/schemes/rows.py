"""The structure in rows no wider than a page: what stands in each, what goes on in others.

The order of devices is that of one long row, cut where few wires are. A link that goes on in
another row leaves at the end of the row with its name, and comes in again with it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice, pairwise, product
from typing import NamedTuple

from vstatics.pictures.schemes.board import ITEM_GAP
from vstatics.pictures.schemes.placing import Placement
from vstatics.pictures.schemes.scheme import Scheme, SchemePort, SchemeState
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.sheet.groups import grouped

Place = Callable[[Scheme], Placement]
"""Finds the places of all that a scheme has, in one row."""
Wide = Callable[[Scheme, Placement], float]
"""How wide the picture of a row is. [pt]"""
MOST_ORDERS = 2000
"""Orders of devices that are tried, times devices."""
EMPTY_PART = 1.0
"""What the empty part of a row costs, squared, in wires that are cut."""


class SchemeRow(NamedTuple):
    """Devices in a row."""

    whole: Scheme
    scheme: Scheme
    """Of its devices alone, with ports where a link goes on in another row."""
    placement: Placement
    numbers: Sequence[int]
    """Of its devices, those in the whole scheme."""
    before: Collection[int] = ()
    """Those in earlier rows."""

    def state(self, state: SchemeState) -> SchemeState:
        """What is marked in it, by what is marked in the whole."""
        if state.loaded is None:
            return state
        own = {number: place for place, number in enumerate(self.numbers)}
        engaged, idle, pieces = (
            frozenset(own[one] for one in marked if one in own)
            for marked in (state.engaged, state.idle, state.pieces)
        )
        further = [port for port in self.scheme.ports if port.is_further]
        pale = {port for port in further if not self._passes(port, state)}
        return replace(
            state,
            engaged=engaged,
            idle=idle,
            pieces=pieces,
            loaded=[state.loaded[number] for number in self.numbers],
            idle_ports=state.idle_ports | pale,
        )

    def _passes(self, port: SchemePort, state: SchemeState) -> bool:
        """Whether torque passes from row to row: something carries it on both sides."""
        first = {*self.before, *([] if port.is_left else self.numbers)}
        sides = {
            number in first for number, links in enumerate(state.loaded or ()) if port.link in links
        }
        sides |= {
            one.is_left
            for one in self.whole.ports
            if one.link == port.link and one not in state.idle_ports
        }
        return len(sides) > 1

    def titles(self, titles: Titles) -> Titles:
        """What its devices and links say."""
        own = {place: titles.devices[number] for place, number in enumerate(self.numbers)}
        return titles._replace(devices=own)


def rows_of(scheme: Scheme, place: Place, wide: Wide, room: float) -> list[SchemeRow]:
    """A scheme in as few rows as it needs in a width [pt]; in one if it has room.

    Where one device alone is wider than that its row is, too.
    """
    whole = place(scheme)
    count = len(scheme.devices)
    if wide(scheme, whole) <= room or count < 2:
        return [SchemeRow(scheme, scheme, whole, range(count))]
    long_row = sorted(whole.row.lefts, key=whole.row.lefts.__getitem__)
    tried = islice(_orders(scheme, long_row), max(MOST_ORDERS // count, 1))
    orders = [(one, [_going_on(scheme, one, at) for at in range(count + 1)]) for one in tried]
    widths = {one: wide + ITEM_GAP for one, wide in whole.row.widths.items()}
    known: KnownRows = {}
    while True:
        _, order, cuts = min(_cut(*one, widths, known, room) for one in orders)
        pairs = pairwise(cuts)
        parts = [(frozenset(order[:start]), tuple(order[start:end])) for start, end in pairs]
        new = [part for part in parts if part not in known]
        for before, own in new:
            row = _row(scheme, before, own, place)
            known[before, own] = row, wide(row.scheme, row.placement)
        if not new:
            return [known[part][0] for part in parts]


KnownRows = dict[tuple[frozenset[int], tuple[int, ...]], tuple[SchemeRow, float]]
"""By the devices of earlier rows and its own ones: a row that was made, with its true width."""


def _orders(scheme: Scheme, order: Sequence[int]) -> Iterator[list[int]]:
    """The order of the long row, and others with brakes beside another device of their link."""
    yield [*order]
    brakes = [one for one in order if scheme.devices[one].is_on_housing]
    rest = [one for one in order if one not in brakes]
    homes = [
        [one for one in rest if scheme.devices[one].links >= scheme.devices[brake].links]
        for brake in brakes
    ]
    for chosen in product(*homes) if rest else ():
        beside = grouped(zip(chosen, brakes, strict=True))
        yield [each for one in rest for each in (*beside.get(one, ()), one)]


def _cut(
    order: list[int],
    wires: Sequence[int],
    widths: Mapping[int, float],
    known: KnownRows,
    room: float,
) -> tuple[tuple[int, float], list[int], list[int]]:
    """Where an order is cut and what that costs: rows, then wires that go on.

    Parameters
    ----------
    wires : sequence of int
        So many go on at each place between devices.
    widths : mapping
        Of devices, each with a gap; of rows that are known their own serves. [pt]
    """
    count = len(order)
    best: list[tuple[int, float, int]] = [(0, 0.0, 0)]
    for end in range(1, count + 1):
        ways = []
        least = 0.0
        for start in range(end - 1, -1, -1):
            least += widths[order[start]]
            made = known.get((frozenset(order[:start]), tuple(order[start:end])))
            wide = made[1] if made else least
            if wide <= room or start == end - 1:
                rows, cost, _ = best[start]
                empty = EMPTY_PART * max(1 - wide / room, 0.0) ** 2
                ways.append((rows + 1, cost + wires[end] + empty, start))
            if least > room:
                break
        best.append(min(ways))
    cuts = [count]
    while cuts[0]:
        cuts.insert(0, best[cuts[0]][2])
    return best[-1][:2], order, cuts


def _going_on(scheme: Scheme, order: Sequence[int], at: int) -> int:
    """How many links have devices on both sides of a cut."""
    before, behind = (
        {link for number in own for link in scheme.devices[number].links}
        for own in (order[:at], order[at:])
    )
    return len(before & behind)


def _row(
    scheme: Scheme, before: Collection[int], numbers: Sequence[int], place: Place
) -> SchemeRow:
    """A row with what leads to it from earlier ones, and on to later ones."""
    every = range(len(scheme.devices))
    behind = [one for one in every if one not in before and one not in numbers]
    early, own, late = (
        {link for number in part for link in scheme.devices[number].links}
        for part in (before, numbers, behind)
    )
    ports = [
        port for port in scheme.ports if _stands_here(port, own, early if port.is_left else late)
    ]
    ports += [SchemePort(link, "before") for link in sorted(own & early)]
    ports += [SchemePort(link, "behind") for link in sorted(own & late)]
    numbers = sorted(numbers)
    part = Scheme(scheme.links, [scheme.devices[one] for one in numbers], ports, is_part=True)
    return SchemeRow(scheme, part, place(part), numbers, before)


def _stands_here(port: SchemePort, own: set[int], farther: set[int]) -> bool:
    """Whether a port is in a row: an input in the first one that has its link, others in the last.

    Parameters
    ----------
    own, farther : set of int
        The links of the row, and those of the rows toward the port's end.
    """
    return port.link in own and port.link not in farther
