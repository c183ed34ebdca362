"""The choices that a scheme leaves: which sets are meshed, which link is held, its ports."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.structures.arrays import MEMBERS, Codes
from vstatics.synthesis.structures.least_codes import Symmetries
from vstatics.synthesis.structures.scheme import SetScheme

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


def with_choices(search: BoxSearch, codes: Codes, found: Symmetries) -> Iterator[BoxScheme]:
    """Least codes of classes with all choices that no symmetry makes equal, in their order.

    Parameters
    ----------
    search : BoxSearch
    codes : array, shape (schemes, 3*sets)
    found : Symmetries
        The renamings by which each stays as it is.
    """
    starts = np.searchsorted(found.which, np.arange(len(codes) + 1))
    for row, code in enumerate(codes.reshape(len(codes), search.sets, MEMBERS).tolist()):
        scheme = SetScheme(tuple((a, h, b) for a, h, b in code))
        renamings = found.links[starts[row] : starts[row + 1]].tolist()
        yield from _chosen(search, scheme, renamings)


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
                ports = _all_ports(scheme.links, held, search.input, search.output)
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
def _all_ports(
    links: int, held: int | None, own_input: int | None, own_output: int | None
) -> tuple[Ports, ...]:
    """Inputs and outputs: any moving link, or the shaft of its own."""
    moving = [link for link in range(links) if link != held]
    inputs, outputs = (moving if own is None else [own] for own in (own_input, own_output))
    return tuple((first, last) for first in inputs for last in outputs if first != last)


def _ports(
    search: BoxSearch, scheme: SetScheme, held: int | None, renamings: list[list[int]]
) -> Iterator[Ports]:
    """The least of the choices that renamings make equal."""
    own = range(scheme.links, scheme.links + 2)
    for first, last in _all_ports(scheme.links, held, search.input, search.output):
        images = ([*one, *own] for one in renamings)
        if min((one[first], one[last]) for one in images) == (first, last):
            yield first, last
