"""Free choices of a scheme: double-pinion sets, a permanently held link, input and output."""

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
"""Numbers of the input and the output link."""


class BoxScheme(NamedTuple):
    """Scheme with given double-pinion sets and held link, and all choices of input and output."""

    scheme: SetScheme
    meshed: tuple[bool, ...]
    """True for each gear set with meshing planets (double-pinion set), shape (sets,)."""
    held: int | None
    """Number of the permanently held link, or None."""
    ports: tuple[Ports, ...]
    """Pairs of input and output link. Symmetric pairs are listed once."""


def with_choices(search: BoxSearch, codes: Codes, symmetries: Symmetries) -> Iterator[BoxScheme]:
    """Yield each scheme with each choice of double-pinion sets and held link, symmetric ones once.

    Parameters
    ----------
    search : BoxSearch
    codes : array, shape (schemes, 3*sets)
        Codes of schemes, each the least code of its class of equal schemes.
    symmetries : Symmetries
        Renamings of links and gear sets that leave each code unchanged.
    """
    starts = np.searchsorted(symmetries.which, np.arange(len(codes) + 1))
    for row, code in enumerate(codes.reshape(len(codes), search.sets, MEMBERS).tolist()):
        scheme = SetScheme(tuple((a, h, b) for a, h, b in code))
        renamings = symmetries.links[starts[row] : starts[row + 1]].tolist()
        yield from _chosen(search, scheme, renamings)


def _chosen(
    search: BoxSearch, scheme: SetScheme, renamings: list[list[int]]
) -> Iterator[BoxScheme]:
    places = {frozenset(members): number for number, members in enumerate(scheme.sets)}
    symmetries = [
        (links, [places[frozenset(links[link] for link in members)] for members in scheme.sets])
        for links in renamings
    ]
    for meshed in combinations(range(len(scheme.sets)), search.meshed):
        images = [tuple(sorted(sets[number] for number in meshed)) for _, sets in symmetries]
        if min(images) != meshed:
            continue
        renamings_kept = [
            links for (links, _), image in zip(symmetries, images, strict=True) if image == meshed
        ]
        are_meshed = tuple(number in meshed for number in range(len(scheme.sets)))
        for held in _held(search, scheme):
            if held is not None and min(links[held] for links in renamings_kept) != held:
                continue
            renamings_held = [
                links for links in renamings_kept if held is None or links[held] == held
            ]
            if len(renamings_held) == 1:  # without a symmetry, all pairs of ports differ
                ports = _all_ports(scheme.links, held, search.input, search.output)
            else:
                ports = tuple(_ports(search, scheme, held, renamings_held))
            if ports:
                yield BoxScheme(scheme, are_meshed, held, ports)


def _held(search: BoxSearch, scheme: SetScheme) -> Iterator[int | None]:
    """Yield the links that can be permanently held: all links with the wanted number of members."""
    if not search.fixed:
        yield None
        return
    for link in range(scheme.links):
        if sum(members.count(link) for members in scheme.sets) == search.fixed:
            yield link


@cache
def _all_ports(
    links: int, held: int | None, input_shaft: int | None, output_shaft: int | None
) -> tuple[Ports, ...]:
    moving = [link for link in range(links) if link != held]
    inputs, outputs = (
        moving if shaft is None else [shaft] for shaft in (input_shaft, output_shaft)
    )
    return tuple((first, last) for first in inputs for last in outputs if first != last)


def _ports(
    search: BoxSearch, scheme: SetScheme, held: int | None, renamings: list[list[int]]
) -> Iterator[Ports]:
    """Yield a single pair of input and output for each group of pairs equal by symmetry."""
    shafts = range(scheme.links, scheme.links + 2)
    for first, last in _all_ports(scheme.links, held, search.input, search.output):
        images = ([*links, *shafts] for links in renamings)
        if min((image[first], image[last]) for image in images) == (first, last):
            yield first, last
