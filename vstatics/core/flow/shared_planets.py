"""Loops of power that may not be in the metal: within one set that is written as several.

A deck has a Ravigneaux set as two mechanisms, and power may go round between these
that no part of the set carries. Only elements tell which mechanisms share planets.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.core.elements.drawing import parts_of
from vstatics.core.flow.circulation import CommonLinks, Loop
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.transmission import Transmission


def shared(case: Transmission, loop: Loop) -> tuple[CommonLinks, ...]:
    """What mechanisms that may be one set of planets share, if a loop runs only through such.

    Planets that are shared have one carrier, so one link is common to all mechanisms;
    and two that share planets have a wheel in common besides, or one with a third does.
    A gear pair has no planets. Links that a clutch joins are two: what goes round
    through the clutch is real.

    Returns
    -------
    tuple of CommonLinks
        As many pairs of mechanisms as join all of them, nothing for a loop that is real.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> from vstatics.core.flow.circulation import Node
    >>> sets = [Mechanism(1, 3, 4, -2.0, name="m1"), Mechanism(2, 3, 4, 3.0, name="m2")]
    >>> case = Transmission(4, [], sets, [Gear()], link_names=("s1", "s2", "r", "c"))
    >>> around = Node("link", 3, "r"), Node("mechanism", 1, "m1")
    >>> around += Node("link", 4, "c"), Node("mechanism", 2, "m2")
    >>> shared(case, Loop(around, 0.6))
    (CommonLinks(first='m1', second='m2', links=('r', 'c')),)
    """
    given = _sets(case)
    names = [(node.kind, node.number) for node in loop.nodes if node.kind != "link"]
    if not all(kind == "mechanism" and number in given for kind, number in names):
        return ()
    numbers = sorted(number for _, number in names)
    if not set.intersection(*(set(given[number]) for number in numbers)):
        return ()
    pairs = _joining(numbers, given)
    if len(pairs) < len(numbers) - 1:
        return ()
    own = case.own_devices
    return tuple(
        CommonLinks(own[one - 1].name, own[other - 1].name, tuple(map(case.link_name, links)))
        for one, other, links in pairs
    )


def _sets(case: Transmission) -> dict[int, tuple[int, ...]]:
    """The links of each mechanism that is given as such and may be a part of a set, by number."""
    given = {
        number: part.lowered[0].mechanism
        for number, part in enumerate(parts_of(case), 1)
        if part.element is None
    }
    return {number: one.links for number, one in given.items() if one.third != HOUSING}


def _joining(
    numbers: Sequence[int], given: Mapping[int, Sequence[int]]
) -> list[tuple[int, int, list[int]]]:
    """Pairs of mechanisms with two common links, each with one that is joined already."""
    pairs: list[tuple[int, int, list[int]]] = []
    joined, others = list(numbers[:1]), list(numbers[1:])
    while others:
        for one, other in ((a, b) for a in joined for b in others):
            common = [link for link in dict.fromkeys(given[one]) if link in given[other]]
            if len(common) > 1:
                pairs.append((one, other, common))
                joined.append(other)
                others.remove(other)
                break
        else:
            break
    return pairs
