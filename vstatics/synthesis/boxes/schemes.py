"""The schemes of boxes: meshed sets, a held link, ports; speeds that their sets tell alone."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import (
    chain,
    combinations,
    combinations_with_replacement,
    groupby,
    permutations,
    product,
)
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.structures.arrays import LEAST_MOBILITY, MEMBERS, Codes, orders
from vstatics.synthesis.structures.growth import StructureSearch, batches
from vstatics.synthesis.structures.least_codes import Symmetries, symmetries
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


def box_schemes(search: BoxSearch) -> Iterator[BoxScheme]:
    """All that a search looks at, in an order of their own.

    Examples
    --------
    >>> from collections import Counter
    >>> found = list(box_schemes(BoxSearch(2, 2, 2, (2.0, 3.0))))
    >>> len(found), sum(len(one.ports) for one in found)  # tree schemes, facts by Burnside
    (6, 90)
    """
    if search.kept is not None:
        kept = search.kept
        yield BoxScheme(kept.scheme, kept.meshed, kept.held, ((kept.input, kept.output),))
        return
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
    if search.may_be_in_parts:
        for parts in _in_parts(search.sets, links):
            yield _least(parts)


def _in_parts(sets: int, links: int) -> Iterator[list[Codes]]:
    """Classes of parts that have no link in common, two or more: codes of each part."""
    for sizes in _splits(sets, links, (1, 3)):
        if len(sizes) > 1:
            asked = [StructureSearch(one, "sets", links=(own,)) for one, own in sizes]
            yield [np.concatenate([batch.codes for batch in batches(one)]) for one in asked]


def _splits(sets: int, links: int, least: tuple[int, int]) -> Iterator[tuple[tuple[int, int], ...]]:
    """Sets and links of the parts, ascending."""
    if not sets and not links:
        yield ()
    for number in range(1, sets + 1):
        for own in range(number + LEAST_MOBILITY, 2 * number + 2):
            if (number, own) >= least and own <= links:
                for rest in _splits(sets - number, links - own, (number, own)):
                    yield ((number, own), *rest)


def _least(parts: list[Codes]) -> tuple[Codes, Symmetries]:
    """The least codes of all choices of a class for each part."""
    choices: list[list[tuple[tuple[int, ...], ...]]] = []
    for _, alike in groupby(parts, key=lambda codes: (*codes.shape, int(codes.max()))):
        group = list(alike)
        rows = [tuple(map(int, row)) for row in group[0].tolist()]
        choices.append(list(combinations_with_replacement(rows, len(group))))
    found: list[list[int]] = []
    for chosen in product(*choices):
        sets: list[tuple[int, ...]] = []
        start = 0
        for code in chain.from_iterable(chosen):
            sets += [
                tuple(start + link for link in code[at : at + 3]) for at in range(0, len(code), 3)
            ]
            start += 1 + max(code)
        found.append(min(_grown(order) for order in permutations(sets)))
    codes = np.array(sorted(found), np.uint8)
    return codes, symmetries(codes, orders("sets"))


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


class SpeedBases(NamedTuple):
    """What speeds the moving links of a scheme can have, at some ratios of its sets."""

    ratios: Floats
    """Internal ratios: all corners of the bounds, set j at its upper bound where bit j of the
    row's number is set, then one point within; shape (points, sets). [-]"""
    speeds: Floats
    """Columns span the speeds, shape (points, moving links, free speeds). [-]"""
    factors: Floats
    """By which minors of `speeds` become polynomials of the ratios, shape (points,)."""
    moving: tuple[int, ...]
    """The link that each row of speeds is of, those without a member of a set last."""


def speed_bases(search: BoxSearch, one: BoxScheme) -> SpeedBases:
    """The speeds that are left by Willis' equations, w_a - K w_b - (1 - K) w_h = 0.

    With the equations as rows of a matrix, its columns are split into some that are solved
    for and the free ones: the determinant of the former is the factor.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.schemes import box_schemes
    >>> search = BoxSearch(1, 1, 1, (3.0,))
    >>> bases = speed_bases(search, next(box_schemes(search)))
    >>> bases.ratios[:2].ravel().tolist(), bases.speeds.shape, bases.moving
    ([-1.4, -5.0], (3, 3, 2), (0, 1, 2))
    """
    links = range(search.moving + bool(search.fixed))
    moving = tuple(link for link in links if link != one.held)
    ratios = _points(search.bounds, one.meshed)
    rows = np.zeros((len(ratios), search.sets, len(links)))
    for number, (sun, carrier, ring) in enumerate(one.scheme.sets):
        rows[:, number, sun] = 1
        rows[:, number, ring] = -ratios[:, number]
        rows[:, number, carrier] = ratios[:, number] - 1
    rows = rows[:, :, moving]
    choices = np.array(list(combinations(range(len(moving)), search.sets)))
    determinants = np.linalg.det(rows[:, :, choices].transpose(0, 2, 1, 3))
    solved = choices[np.abs(determinants).min(axis=0).argmax()]
    free = np.setdiff1d(np.arange(len(moving)), solved)
    speeds = np.zeros((len(ratios), len(moving), len(free)))
    speeds[:, free, np.arange(len(free))] = 1
    speeds[:, solved] = -np.linalg.solve(rows[:, :, solved], rows[:, :, free])
    return SpeedBases(ratios, speeds, np.linalg.det(rows[:, :, solved]), moving)


@cache
def _inner(sets: int) -> Floats:
    """A point within the unit cube, where no two ratios agree by chance."""
    return np.asarray(np.sqrt(np.array([2, 3, 5, 7, 11, 13, 17, 19, 23, 29][:sets])) % 1)


def _points(bounds: tuple[float, float], meshed: tuple[bool, ...]) -> Floats:
    """Corners of the bounds, then a point within, shape (points, sets)."""
    low, high = bounds
    ends = [one[::-1] for one in product((low, high), repeat=len(meshed))]
    within = low * (high / low) ** _inner(len(meshed))
    return np.array([*ends, within]) * np.where(meshed, 1.0, -1.0)
