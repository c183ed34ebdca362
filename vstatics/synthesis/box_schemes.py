"""The schemes of boxes: classes with meshed sets, a link that is held, input and output."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import combinations, combinations_with_replacement, groupby, permutations
from typing import NamedTuple

import numpy as np

from vstatics.synthesis.box import BoxSearch
from vstatics.synthesis.least_codes import Symmetries, symmetries
from vstatics.synthesis.scheme import SetScheme
from vstatics.synthesis.scheme_arrays import LEAST_MOBILITY, MEMBERS, Codes, orders
from vstatics.synthesis.structures import StructureSearch, batches

Ports = tuple[int, int]


class BoxScheme(NamedTuple):
    """A class of schemes whose sets are simple or meshed, with all choices of its ports."""

    scheme: SetScheme
    meshed: tuple[bool, ...]
    """Whether a set has meshed planets."""
    held: int | None
    """The link that is held for good."""
    ports: tuple[Ports, ...]
    """Input and output; of choices that a symmetry makes equal there is one."""


def box_schemes(search: BoxSearch) -> Iterator[BoxScheme]:
    """All that a search looks at, in an order of their own.

    Examples
    --------
    >>> from collections import Counter
    >>> found = list(box_schemes(BoxSearch(2, 2, 2, (2.0, 3.0))))
    >>> len(found), sum(len(one.ports) for one in found)  # tree schemes, facts by Burnside
    (6, 90)
    """
    for codes, found in _classes(search):
        starts = np.searchsorted(found.which, np.arange(len(codes) + 1))
        for row, code in enumerate(codes.reshape(len(codes), -1, MEMBERS).tolist()):
            scheme = SetScheme(tuple((a, h, b) for a, h, b in code))
            renamings = found.links[starts[row] : starts[row + 1]].tolist()
            yield from _chosen(search, scheme, renamings)


def _classes(search: BoxSearch) -> Iterator[tuple[Codes, Symmetries]]:
    """The least codes of all classes, and by which renamings they stay as they are."""
    links = search.links
    if links in StructureSearch(search.sets).link_range:
        asked = StructureSearch(search.sets, "sets", links=(links,))
        for batch in batches(asked):
            assert batch.symmetries is not None  # noqa: S101 - they are classes
            yield batch.codes, batch.symmetries
    if search.fixed:
        for parts in _in_parts(search.sets, links):
            yield _least(parts)


def _in_parts(sets: int, links: int) -> Iterator[list[Codes]]:
    """Classes of parts that have no link in common, two or more: codes of each part."""
    for sizes in _splits(sets, links, (1, 3)):
        if len(sizes) < 2:
            continue
        yield [_connected(*size) for size in sizes]


def _splits(sets: int, links: int, least: tuple[int, int]) -> Iterator[tuple[tuple[int, int], ...]]:
    """Sets and links of the parts, ascending."""
    if not sets and not links:
        yield ()
    for number in range(1, sets + 1):
        for own in range(number + LEAST_MOBILITY, 2 * number + 2):
            if (number, own) >= least and own <= links:
                for rest in _splits(sets - number, links - own, (number, own)):
                    yield ((number, own), *rest)


def _connected(sets: int, links: int) -> Codes:
    """All connected classes, shape (classes, 3*sets)."""
    asked = StructureSearch(sets, "sets", links=(links,))
    return np.concatenate([batch.codes for batch in batches(asked)])


def _least(parts: list[Codes]) -> tuple[Codes, Symmetries]:
    """The least codes of all choices of a class for each part."""
    choices: list[list[tuple[tuple[int, ...], ...]]] = []
    for _, alike in groupby(parts, key=lambda codes: (*codes.shape, int(codes.max()))):
        group = list(alike)
        rows = [tuple(map(int, row)) for row in group[0].tolist()]
        choices.append(list(combinations_with_replacement(rows, len(group))))
    found: list[list[int]] = []
    for one in _products(choices):
        sets: list[tuple[int, ...]] = []
        start = 0
        for code in one:
            sets += [
                tuple(start + link for link in code[at : at + 3]) for at in range(0, len(code), 3)
            ]
            start += 1 + max(code)
        found.append(min(_grown(order) for order in permutations(sets)))
    codes = np.array(sorted(found), np.uint8)
    return codes, symmetries(codes, orders("sets"))


def _products(
    choices: list[list[tuple[tuple[int, ...], ...]]],
) -> Iterator[tuple[tuple[int, ...], ...]]:
    """A choice for each group of parts, one behind the other."""
    if not choices:
        yield ()
        return
    for first in choices[0]:
        for rest in _products(choices[1:]):
            yield (*first, *rest)


def _grown(sets: tuple[tuple[int, ...], ...]) -> list[int]:
    """The restricted growth string of sets in this order."""
    numbers: dict[int, int] = {}
    return [numbers.setdefault(link, len(numbers)) for one in sets for link in one]


def _chosen(
    search: BoxSearch, scheme: SetScheme, renamings: list[list[int]]
) -> Iterator[BoxScheme]:
    """A scheme with all choices that no symmetry makes equal."""
    places = {frozenset(one): number for number, one in enumerate(scheme.sets)}
    own = [
        (links, [places[frozenset(links[link] for link in one)] for one in scheme.sets])
        for links in renamings
    ]
    for meshed in combinations(range(len(scheme.sets)), search.meshed):
        images = [tuple(sorted(sets[number] for number in meshed)) for _, sets in own]
        if min(images) != meshed:
            continue
        kept = [links for (links, _), image in zip(own, images, strict=True) if image == meshed]
        are_meshed = tuple(number in meshed for number in range(len(scheme.sets)))
        for held in _held(search, scheme):
            if held is not None and min(links[held] for links in kept) != held:
                continue
            still = [links for links in kept if held is None or links[held] == held]
            if len(still) == 1:  # most schemes have no symmetry, and the same choices
                ports = _all_ports(scheme.links, held, search.own_input)
            else:
                ports = tuple(_ports(search, scheme, held, still))
            if ports:
                yield BoxScheme(scheme, are_meshed, held, ports)


def _held(search: BoxSearch, scheme: SetScheme) -> Iterator[int | None]:
    """The links that may be held for good: they have so many members."""
    if not search.fixed:
        yield None
        return
    for link in range(scheme.links):
        if sum(one.count(link) for one in scheme.sets) == search.fixed:
            yield link


@cache
def _all_ports(links: int, held: int | None, own_input: bool) -> tuple[Ports, ...]:  # noqa: FBT001
    """Inputs and outputs; a shaft of its own has the number after the links of the sets."""
    moving = [link for link in range(links) if link != held]
    inputs = [links] if own_input else moving
    return tuple((first, last) for first in inputs for last in moving if first != last)


def _ports(
    search: BoxSearch, scheme: SetScheme, held: int | None, renamings: list[list[int]]
) -> Iterator[Ports]:
    """The least of the choices that renamings make equal."""
    for first, last in _all_ports(scheme.links, held, search.own_input):
        images = ((one[first] if first < len(one) else first, one[last]) for one in renamings)
        if min(images) == (first, last):
            yield first, last
