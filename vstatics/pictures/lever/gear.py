"""What levers show of a gear: speeds, torques, what holds them and what ties them together."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Gear, ShiftElement, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import IDLE, ONE_PIECE, Role, roles
from vstatics.pictures.drawing.gear_state import PictureState, shown_of
from vstatics.pictures.drawing.groups import grouped
from vstatics.pictures.drawing.tolerances import NO_LEVER_TORQUE
from vstatics.pictures.lever.points import Lever, held_for_good

Spot = tuple[int, int]
"""A point of a picture: the number of its lever, and of its node."""


class LeverTie(NamedTuple):
    """What joins two points: a link that is on two levers, a clutch, a spring as shaft."""

    name: str
    """None of a link."""
    link: int
    """That of the first point."""
    ends: tuple[Spot, Spot]
    """The left one first, if they are on different levers."""
    is_spring: bool = False


class LeverGear(NamedTuple):
    """A gear on the levers of a case."""

    state: PictureState
    torques: Sequence[Sequence[float]]
    """On the nodes of each lever, without losses, over the input torque. [-]"""
    roles: Sequence[set[Role]]
    """By lever: what its devices do; a shaft is idle or has none."""
    grounds: dict[Spot, str]
    """Points that stand by brakes or in the housing, with the names of the brakes."""
    ties: Sequence[LeverTie]
    carried: dict[str, float]
    """Name of an engaged element -> its torque without losses. [-]"""
    loads: dict[int, set[int]]
    """Link -> the levers at which something gives it torque or takes it."""

    def is_way(self, link: int, first: int, last: int) -> bool:
        """Whether torque of a link passes between two levers, or at one."""
        places = self.loads.get(link, set())
        return any(place <= first for place in places) and any(place >= last for place in places)

    def is_loaded(self, lever: int) -> bool:
        """Whether a lever or shaft carries torque, or one that is not known."""
        return self.roles[lever] != {IDLE}

    def is_slack(self, names: str) -> bool:
        """Whether all shift elements at one place are engaged without torque."""
        torques = [self.carried.get(name, math.nan) for name in names.split(", ")]
        return all(abs(torque) < NO_LEVER_TORQUE for torque in torques)

    def is_one_piece(self, lever: int) -> bool:
        """Whether a lever carries torque, and nothing in it moves."""
        return ONE_PIECE in self.roles[lever] and "" not in self.roles[lever]

    def stands(self, link: int) -> bool:
        """Whether a link stands, by what it is joined to or by a set that is locked."""
        return self.state.joined[link] == HOUSING or abs(self.state.speeds[link]) < NO_LEVER_TORQUE

    def shown(self, lever: int, nodes: Lever) -> object:
        """All that the picture of a lever shows of a gear."""
        speeds = [self.state.speeds[node.link] for node in nodes.nodes]
        grounds = {spot: name for spot, name in self.grounds.items() if spot[0] == lever}
        return repr((speeds, self.torques[lever], grounds))


def in_gear(results: Results, number: int, drawn: Sequence[Lever]) -> LeverGear:
    """A gear on levers that stand in their order from left to right.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> from vstatics.pictures.lever.points import levers
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gear = in_gear(solve(case), 1, levers(case))
    >>> gear.torques, gear.grounds
    ([[1.0, -3.5, 2.5]], {(0, 2): 'T1'})
    """
    whole = results.gear_at(number - 1)
    state, members = shown_of(whole), whole.member_torques(lossy=False)
    by_member = [{name: plain(torque) for name, torque in one.items()} for one in members]
    torques = [
        [_torque(node.sources, by_member) for node in one.nodes if one.devices] for one in drawn
    ]
    case, spots, found = results.case, spots_of(drawn), roles(results, number - 1)
    grounds = _grounds(case, state, drawn, spots)
    engaged = {number: case.shift_elements[number - 1] for number in state.gear.engaged}
    ties = [*joins(drawn), *ties_of(case, engaged.values(), spots)]
    first = whole.torques.on_first_link
    carried = {one.name: plain(first[number - 1]) for number, one in engaged.items()}
    does = [{found[device] for device in one.devices} for one in drawn]
    gear = LeverGear(state, torques, does, grounds, ties, carried, {})
    for place, node in _acts(gear, drawn):
        gear.loads.setdefault(drawn[place].nodes[node].link, set()).add(place)
    for place, lever in enumerate(drawn):
        if lever.shaft and not gear.loads.get(lever.nodes[0].link):
            does[place].add(IDLE)
    return gear


def _acts(gear: LeverGear, drawn: Sequence[Lever]) -> Iterator[Spot]:
    """Points at which something gives torque to a link, or takes it."""
    yield from (spot for spot, name in gear.grounds.items() if not gear.is_slack(name))
    for one in gear.ties:
        if one.name and (one.is_spring or not gear.is_slack(one.name)):
            yield from one.ends
    for place, some in enumerate(gear.torques):
        yield from ((place, node) for node, torque in enumerate(some) if torque)
    given = {gear.state.input, gear.state.output, *gear.state.gear.torques}
    for place, lever in enumerate(drawn):
        if not given.isdisjoint(lever.shaft):
            yield place, 0


def _torque(
    sources: Sequence[tuple[int, str, float]], members: Sequence[dict[str, float]]
) -> float:
    total = sum(factor * members[device][member] for device, member, factor in sources)
    return 0.0 if abs(total) < NO_LEVER_TORQUE else total


def spots_of(drawn: Sequence[Lever]) -> dict[int, list[Spot]]:
    """The points of each link, from left to right."""
    found = grouped(
        (node.link, (place, number))
        for place, lever in enumerate(drawn)
        for number, node in enumerate(lever.nodes)
    )
    for lever in drawn:
        for link in lever.shaft:
            found.setdefault(link, found[lever.nodes[0].link])
    return found


def brakes_of(
    case: Transmission, gear: Gear, spots: dict[int, list[Spot]]
) -> dict[Spot, list[str]]:
    """The names of the engaged brakes at the first point of each link."""
    return grouped(
        (spot, element.name)
        for element in (case.shift_elements[number - 1] for number in gear.engaged)
        if HOUSING in element.links
        for spot in spots.get(max(element.links), ())[:1]
    )


def _grounds(
    case: Transmission, state: PictureState, drawn: Sequence[Lever], spots: dict[int, list[Spot]]
) -> dict[Spot, str]:
    """A link has one ground, with all its brakes; the housing has one at each of its points."""
    good = [spot for link in held_for_good(case) for spot in spots.get(link, ())[:1]]
    names: dict[Spot, list[str]] = {spot: [] for spot in [*spots.get(HOUSING, ()), *good]}
    names |= brakes_of(case, state.gear, spots)
    return {
        (lever, node): ", ".join(some)
        for (lever, node), some in names.items()
        if drawn[lever].is_shown(node)
    }


def joins(drawn: Sequence[Lever]) -> Iterator[LeverTie]:
    """Links that are on several levers, from each to the next."""
    for link, some in spots_of(drawn).items():
        places = dict(reversed(some)) if link != HOUSING else {}
        for both in pairwise(sorted(places.items())):
            yield LeverTie("", link, both)


def ties_of(
    case: Transmission, elements: Iterable[ShiftElement], spots: dict[int, list[Spot]]
) -> Iterator[LeverTie]:
    """Clutches, and springs between links that are shown, from each of these to the next."""
    for element in elements:
        yield from _tie(element.name, *element.links, spots)
    for spring in case.springs:
        shown = [link for link in spring.form if link in spots]
        for both in pairwise(shown):
            yield from (one._replace(is_spring=True) for one in _tie(spring.name, *both, spots))


def _tie(name: str, first: int, second: int, spots: dict[int, list[Spot]]) -> Iterator[LeverTie]:
    """What joins two links, where they are nearest to one another."""
    pairs = [(a, b) for a in spots.get(first, ()) for b in spots.get(second, ()) if a != b]
    if HOUSING not in (first, second) and pairs:
        a, b = min(pairs, key=lambda pair: abs(pair[0][0] - pair[1][0]))
        yield LeverTie(name, first, (min(a, b), max(a, b)))
