"""Loops of power within a gear set that a case describes as several mechanisms.

A deck describes a Ravigneaux set as two mechanisms. In the model, power can recirculate between
these mechanisms, although no part of the real gear set carries this power. Only drawn gear sets
show which mechanisms share planets.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.core.elements.drawing import parts_of
from vstatics.core.flow.circulation import CommonLinks, Loop
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.transmission import Transmission


def shared(case: Transmission, loop: Loop) -> tuple[CommonLinks, ...]:
    """Return the mechanisms with common links in a loop that can be an artefact of the model.

    Mechanisms that share planets have the same carrier, which is a link common to all. Two of them
    also have a common central gear, or each has a common central gear with a third mechanism. Gear
    pairs have no planets. Links joined by a clutch count as two links, because a loop through a
    clutch is real.

    Returns
    -------
    tuple of CommonLinks
        Pairs of mechanisms that together connect all mechanisms of the loop; empty for a real loop.

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
    devices = case.own_devices
    return tuple(
        CommonLinks(
            devices[first - 1].name, devices[second - 1].name, tuple(map(case.link_name, links))
        )
        for first, second, links in pairs
    )


def _sets(case: Transmission) -> dict[int, tuple[int, ...]]:
    """Return the links of each mechanism, by number, that can belong to a gear set."""
    given = {
        number: part.lowered[0].mechanism
        for number, part in enumerate(parts_of(case), 1)
        if part.element is None
    }
    return {
        number: mechanism.links for number, mechanism in given.items() if mechanism.third != HOUSING
    }


def _joining(
    numbers: Sequence[int], given: Mapping[int, Sequence[int]]
) -> list[tuple[int, int, list[int]]]:
    """Return pairs of mechanisms with two common links, which together connect all mechanisms."""
    pairs = []
    joined, others = list(numbers[:1]), list(numbers[1:])
    while others:
        for first, second in ((a, b) for a in joined for b in others):
            common = [link for link in dict.fromkeys(given[first]) if link in given[second]]
            if len(common) > 1:
                pairs.append((first, second, common))
                joined.append(second)
                others.remove(second)
                break
        else:
            break
    return pairs
