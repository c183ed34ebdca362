"""State of the levers in a gear: speeds, torques, supports and connections."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.core.model.transmission import HOUSING, Gear, ShiftElement, Transmission
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number, plain
from vstatics.core.statics.results import Results
from vstatics.core.statics.roles import IDLE, ONE_PIECE, Role
from vstatics.pictures.drawing.gear_state import PictureState, state_of
from vstatics.pictures.drawing.tolerances import NO_LEVER_TORQUE
from vstatics.pictures.lever.points import Lever, Source, held_for_good

Spot = tuple[int, int]
"""Point of a lever: index of the lever, and index of the node on the lever."""


class LeverTie(NamedTuple):
    """Connection of two points: a link on two levers, a clutch, or a spring drawn as a shaft."""

    name: str
    """Name of the clutch or spring; empty for a link common to both levers."""
    link: int
    """Number of the link of the first point."""
    ends: tuple[Spot, Spot]
    """Both points, the left point first if the levers are different."""
    is_spring: bool = False


class LeverGear(NamedTuple):
    """State of a gear, shown on the levers of a case."""

    state: PictureState
    torques: Sequence[Sequence[float]]
    """Torques on the points of each lever, without losses, relative to the input torque. [-]"""
    roles: Sequence[set[Role]]
    """Roles of components of each lever, such as `locked up`. A shaft can only be `unloaded`."""
    grounds: dict[Spot, list[str]]
    """Names of the brakes that hold a point; empty for a point on a link that is the housing."""
    ties: Sequence[LeverTie]
    carried: dict[str, float]
    """Torque of each engaged shift element, by name, without losses, relative to the input. [-]"""
    loads: dict[int, set[int]]
    """Indices of the levers at which each link receives or gives torque, by the number of the link.
    """

    def is_way(self, link: int, first: int, last: int) -> bool:
        """Return whether the line of a link transmits torque between levers `first` and `last`."""
        places = self.loads.get(link, set())
        return any(place <= first for place in places) and any(place >= last for place in places)

    def is_loaded(self, lever: int) -> bool:
        """Return whether a lever or shaft carries a torque, or an unknown torque."""
        return self.roles[lever] != {IDLE}

    def is_slack(self, name: str) -> bool:
        """Return whether an engaged shift element carries no torque."""
        return abs(self.carried.get(name, math.nan)) < NO_LEVER_TORQUE

    def is_one_piece(self, lever: int) -> bool:
        """Return whether a lever carries torque and rotates as a block."""
        return ONE_PIECE in self.roles[lever] and "" not in self.roles[lever]

    def stands(self, link: int) -> bool:
        """Return whether a link is at rest: connected to the housing, or with speed 0."""
        return self.state.joined[link] == HOUSING or abs(self.state.speeds[link]) < NO_LEVER_TORQUE

    def shown(self, lever: int, nodes: Lever) -> object:
        """Return a key of everything that the picture of a lever shows in a gear."""
        speeds = [self.state.speeds[node.link] for node in nodes.nodes]
        grounds = {spot: name for spot, name in self.grounds.items() if spot[0] == lever}
        return repr((speeds, self.torques[lever], grounds))


def in_gear(results: Results, number: int, drawn: Sequence[Lever]) -> LeverGear:
    """Return the state of the gear with a number, from 1, on levers from left to right.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> from vstatics.pictures.lever.points import levers
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> gear = in_gear(solve(case), 1, levers(case))
    >>> gear.torques, gear.grounds
    ([[1.0, -3.5, 2.5]], {(0, 2): ['T1']})
    """
    whole = results.gear_at(number - 1)
    state, members = state_of(results, number), whole.member_torques(lossy=False)
    torques = [[_torque(node.sources, members) for node in lever.nodes] for lever in drawn]
    case, spots = results.case, spots_of(drawn)
    grounds = _grounds(case, state, drawn, spots)
    engaged = {number: case.shift_elements[number - 1] for number in state.gear.carrying}
    ties = [*joins(drawn), *ties_of(case, engaged.values(), spots)]
    first = whole.torques.on_first_link
    carried = {element.name: plain(first[number - 1]) for number, element in engaged.items()}
    does = [{state.roles[device] for device in lever.devices} for lever in drawn]
    gear = LeverGear(state, torques, does, grounds, ties, carried, {})
    for place, node in _acts(gear, drawn):
        gear.loads.setdefault(drawn[place].nodes[node].link, set()).add(place)
    for place, lever in enumerate(drawn):
        if lever.shaft and not gear.loads.get(lever.nodes[0].link):
            does[place].add(IDLE)
    return gear


def _acts(gear: LeverGear, drawn: Sequence[Lever]) -> Iterator[Spot]:
    """Yield the points of levers at which links receive or give torque."""
    for spot, names in gear.grounds.items():
        if not (names and all(map(gear.is_slack, names))):
            yield spot
    for tie in gear.ties:
        if tie.name and (tie.is_spring or not gear.is_slack(tie.name)):
            yield from tie.ends
    for place, some in enumerate(gear.torques):
        yield from ((place, node) for node, torque in enumerate(some) if torque)
    given = {gear.state.input, gear.state.output, *gear.state.gear.torques}
    for place, lever in enumerate(drawn):
        if not given.isdisjoint(lever.shaft):
            yield place, 0


def _torque(sources: Sequence[Source], members: Sequence[Mapping[str, Number | Residual]]) -> float:
    total = sum(factor * plain(members[device][member]) for device, member, factor in sources)
    return 0.0 if abs(total) < NO_LEVER_TORQUE else total


def spots_of(drawn: Sequence[Lever]) -> dict[int, list[Spot]]:
    """Return the points on levers of each link, from left to right."""
    spots = grouped(
        (node.link, (place, number))
        for place, lever in enumerate(drawn)
        for number, node in enumerate(lever.nodes)
    )
    for lever in drawn:
        for link in lever.shaft:
            spots.setdefault(link, spots[lever.nodes[0].link])
    return spots


def brakes_of(
    case: Transmission, gear: Gear, spots: dict[int, list[Spot]]
) -> dict[Spot, list[str]]:
    """Return the names of the engaged brakes of each held link, at the link's first point."""
    return grouped(
        (spot, element.name)
        for element in case.elements_at(gear.carrying)
        if HOUSING in element.links
        for spot in spots.get(max(element.links), ())[:1]
    )


def _grounds(
    case: Transmission, state: PictureState, drawn: Sequence[Lever], spots: dict[int, list[Spot]]
) -> dict[Spot, list[str]]:
    """Return the held points of a gear, each with the names of the holding brakes.

    A held link is supported at one point only; the housing is supported at each of its points.
    """
    good = [spot for link in held_for_good(case) for spot in spots.get(link, ())[:1]]
    names: dict[Spot, list[str]] = {spot: [] for spot in [*spots.get(HOUSING, ()), *good]}
    names |= brakes_of(case, state.gear, spots)
    return {
        (lever, node): some for (lever, node), some in names.items() if drawn[lever].is_shown(node)
    }


def joins(drawn: Sequence[Lever]) -> Iterator[LeverTie]:
    """Yield the lines between successive levers that share a link, except for the housing."""
    for link, some in spots_of(drawn).items():
        places = dict(reversed(some)) if link != HOUSING else {}
        for both in pairwise(sorted(places.items())):
            yield LeverTie("", link, both)


def ties_of(
    case: Transmission, elements: Iterable[ShiftElement], spots: dict[int, list[Spot]]
) -> Iterator[LeverTie]:
    """Yield the lines of clutches, and of springs between neighbouring links."""
    for element in elements:
        yield from _tie(element.name, *element.links, spots)
    for spring in case.springs:
        shown = [link for link in spring.form if link in spots]
        for both in pairwise(shown):
            yield from (tie._replace(is_spring=True) for tie in _tie(spring.name, *both, spots))


def _tie(name: str, first: int, second: int, spots: dict[int, list[Spot]]) -> Iterator[LeverTie]:
    """Yield the line between two links at the nearest points, if both links are on levers."""
    pairs = [(a, b) for a in spots.get(first, ()) for b in spots.get(second, ()) if a != b]
    if HOUSING not in (first, second) and pairs:
        a, b = min(pairs, key=lambda pair: abs(pair[0][0] - pair[1][0]))
        yield LeverTie(name, first, (min(a, b), max(a, b)))
