"""How many schemes of planetary sets there are, counted without listing them.

Labelled schemes follow from recursions over the number of sets; classes follow from them by
the lemma of Burnside: the mean, over all renamings, of the schemes that a renaming leaves as
they are. For all renamings but the identity these are few, and are written down, orbit by
orbit; for the identity they are the labelled ones.

A *body* is a largest group of sets that turn as one piece, links - sets <= 1 somewhere. Each
connected scheme is a sound one of the sets outside of its bodies, where a body stands in the
place of a link. With bodies of b links an outside element has b links to join. Sound schemes
have at least N + 2 links and bodies of N sets at most N + 1, so both follow from the rest.
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import product
from math import comb, factorial, perm, prod
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

ByLinks = dict[int, int]
Permutation = tuple[int, ...]
"""Of the 3 N elements: sun, carrier, ring of the first set, and so on."""
SUN_AND_RING = (2, 1, 0)
KEPT = (0, 1, 2)
CYCLE = (1, 2, 0)
ONES = np.array([bits.bit_count() for bits in range(1 << 15)])


def labelled(sets: int) -> ByLinks:
    """All partitions of the elements with none of a set together, by number of links."""
    found = Counter({0: 1})
    for _ in range(sets):
        more: Counter[int] = Counter()
        for links, count in found.items():
            for new in range(4):
                more[links + new] += count * comb(3, new) * perm(links, 3 - new)
        found = more
    return {links: count for links, count in sorted(found.items()) if count}


@cache
def connected(sets: int) -> ByLinks:
    """Those of one part: all, less those in which the part of the first set is smaller."""
    found = Counter(labelled(sets))
    for size in range(1, sets):
        for links, count in connected(size).items():
            for others, more in labelled(sets - size).items():
                found[links + others] -= comb(sets - 1, size - 1) * count * more
    return {links: count for links, count in sorted(found.items()) if count}


@cache
def _with_bodies(sets: int) -> ByLinks:
    """Connected schemes with at least one body and at least one set outside."""
    found: Counter[int] = Counter()
    for outside in range(1, sets - 1):
        for sizes, count in _sizes_of_links(outside).items():
            for links, ways in _attached(sizes, sets - outside, len(sizes)).items():
                found[links] += count * comb(sets, outside) * ways
    return found


def _attached(sizes: tuple[int, ...], sets: int, links: int) -> Counter[int]:
    """Ways to put bodies of so many labelled sets in the place of links of these sizes."""
    if not sizes:
        return Counter() if sets else Counter({links: 1})
    found = _attached(sizes[1:], sets, links)
    for inside in range(2, sets + 1):
        for own, count in bodies(inside).items():
            rest = _attached(sizes[1:], sets - inside, links - 1 + own)
            for total, ways in rest.items():
                found[total] += comb(sets, inside) * count * own ** sizes[0] * ways
    return found


@cache
def sound(sets: int) -> ByLinks:
    """Connected schemes in which no group of sets turns as one piece."""
    return _of_one_kind(sets, range(sets + 2, 2 * sets + 2))


@cache
def bodies(sets: int) -> ByLinks:
    """Schemes that turn as one piece."""
    return _of_one_kind(sets, range(sets + 2))


def _of_one_kind(sets: int, links: Iterable[int]) -> ByLinks:
    mixed, all_of_them = _with_bodies(sets), connected(sets)
    return {j: left for j in links if (left := all_of_them.get(j, 0) - mixed[j])}


@cache
def _sizes_of_links(sets: int) -> Counter[tuple[int, ...]]:
    """Of the sound schemes of few sets: how many elements their links have."""
    listed = fixed(tuple(range(3 * sets)))
    codes = listed.codes[listed.is_sound()]
    return Counter(tuple(np.bincount(code).tolist()) for code in codes)


class Fixed(NamedTuple):
    """Schemes that a permutation of the elements turns into themselves, a row for each."""

    codes: npt.NDArray[np.int8]
    """The link of each element."""
    moved: npt.NDArray[np.int8]
    """Where each link goes; a link that there is not stays."""
    links: npt.NDArray[np.int64]

    def masks(self) -> list[npt.NDArray[np.int64]]:
        """The links of each set, as bits."""
        bits = np.int64(1) << self.codes.astype(np.int64)
        return [
            np.bitwise_or.reduce(bits[:, at : at + 3], axis=1) for at in range(0, bits.shape[1], 3)
        ]

    def is_connected(self) -> npt.NDArray[np.bool_]:
        """Whether all sets hang together."""
        masks = self.masks()
        reached = masks[0].copy()
        for _ in masks:
            for mask in masks:
                reached |= np.where(reached & mask, mask, 0)
        hangs: npt.NDArray[np.bool_] = np.all([mask & reached != 0 for mask in masks], axis=0)
        return hangs

    def is_sound(self) -> npt.NDArray[np.bool_]:
        """Whether they hang together and no group of sets turns as one piece."""
        masks = self.masks()
        unions: list[npt.NDArray[np.int64]] = [np.zeros_like(masks[0])]
        good = self.is_connected()
        for mask in masks:
            unions += [union | mask for union in unions]
        for group, union in enumerate(unions[1:], 1):
            good &= ONES[union] >= group.bit_count() + 2
        return good

    def kept(self) -> npt.NDArray[np.int64]:
        """How many links stay where they are."""
        columns = np.arange(self.moved.shape[1])
        stays = (self.moved == columns) & (columns < self.links[:, np.newaxis])
        counted: npt.NDArray[np.int64] = stays.sum(axis=1, dtype=np.int64)
        return counted


def fixed(moves: Permutation) -> Fixed:
    """All schemes, connected or not, that a permutation of the elements leaves as they are."""
    size = len(moves)
    state = Fixed(
        np.full((1, size), -1, np.int8),
        np.arange(size, dtype=np.int8)[np.newaxis],
        np.zeros(1, np.int64),
    )
    for orbit in orbits(moves):
        states = list(_extended(state, orbit))
        state = Fixed(*(np.concatenate(parts) for parts in zip(*states, strict=True)))
    return state


def orbits(moves: Permutation) -> Iterator[list[int]]:
    """Elements that follow one another."""
    left = set(range(len(moves)))
    while left:
        orbit = [min(left)]
        while moves[orbit[-1]] != orbit[0]:
            orbit.append(moves[orbit[-1]])
        left -= set(orbit)
        yield orbit


def _extended(state: Fixed, orbit: list[int]) -> Iterator[Fixed]:
    """The elements of an orbit in links that there are, and in new ones."""
    length, size = len(orbit), state.codes.shape[1]
    for period in (d for d in range(1, length + 1) if length % d == 0):
        if any(orbit[n] // 3 == orbit[0] // 3 for n in range(period, length, period)):
            continue  # two elements of a set on one link
        for link in range(size):
            way = [np.full(len(state.links), link, np.int8)]
            for _ in range(period):
                way.append(np.take_along_axis(state.moved, way[-1][:, np.newaxis], 1)[:, 0])
            good = (way[-1] == link) & (link < state.links)
            for early in way[1:-1]:
                good &= early != link
            own = orbit[0] // 3 * 3
            good &= (state.codes[:, own : own + 3] != link).all(axis=1)
            if good.any():
                codes = state.codes[good]
                for n, element in enumerate(orbit):
                    codes[:, element] = way[n % period][good]
                yield Fixed(codes, state.moved[good], state.links[good])
        codes, moved, links = state.codes.copy(), state.moved.copy(), state.links
        good = links + period <= size
        codes, moved, links = codes[good], moved[good], links[good]
        for n, element in enumerate(orbit):
            codes[:, element] = links + n % period
        rows = np.arange(len(links))
        for n in range(period):
            moved[rows, links + n] = links + (n + 1) % period
        yield Fixed(codes, moved, links + period)


def classes(sets: int, group: str = "sets", *, ports: bool = False, all_: bool = False) -> ByLinks:
    """Classes by number of links: sound ones, or all that are connected.

    The group is ``sets`` (renaming), ``members`` (sun and ring of a set as well), ``order``
    (any order in a set). With ports an input and an output are chosen, in this order.
    """
    found: Counter[int] = Counter()
    for moves, size in conjugates(sets, group):
        if moves == tuple(range(3 * sets)):
            numbers = connected(sets) if all_ else sound(sets)
            for links, count in numbers.items():
                found[links] += size * count * (links * (links - 1) if ports else 1)
            continue
        listed = fixed(moves)
        good = listed.is_connected() if all_ else listed.is_sound()
        kept = listed.kept()[good]
        weights = kept * (kept - 1) if ports else np.ones_like(kept)
        for links in np.unique(listed.links[good]).tolist():
            found[links] += size * int(weights[listed.links[good] == links].sum())
    order = sum(size for _, size in conjugates(sets, group))
    assert not any(count % order for count in found.values())
    return {
        links: count // order
        for links, count in sorted(found.items())
        if sets + 2 <= links <= 2 * sets + 1
    }


WITHIN: dict[str, list[tuple[tuple[int, ...], int]]] = {
    # an element of each conjugacy class of what may be done in a set, order of its centralizer
    "sets": [(KEPT, 1)],
    "members": [(KEPT, 2), (SUN_AND_RING, 2)],
    "order": [(KEPT, 6), (SUN_AND_RING, 2), (CYCLE, 3)],
}


def conjugates(sets: int, group: str) -> Iterator[tuple[Permutation, int]]:
    """A permutation of the elements for each class of conjugates, and the size of the class."""
    within = WITHIN[group]
    whole = factorial(sets) * within[0][1] ** sets  # the first class is the identity alone
    for shares in product(range(sets + 1), repeat=len(within)):
        if sum(shares) != sets:
            continue
        for cycles in product(*map(_partitions, shares)):
            moves: list[int] = []
            centralizer = 1
            for (turn, order), lengths in zip(within, cycles, strict=True):
                for length in lengths:
                    moves += _cycle(len(moves) // 3, length, turn)
                centralizer *= prod(
                    factorial(times) * (length * order) ** times
                    for length, times in Counter(lengths).items()
                )
            yield tuple(moves), whole // centralizer


def _cycle(first: int, length: int, turn: tuple[int, ...]) -> list[int]:
    """Sets that follow one another; the last one goes to the first with a turn inside."""
    moves = [3 * (first + n + 1) + k for n in range(length - 1) for k in range(3)]
    return moves + [3 * first + turn[k] for k in range(3)]


def _partitions(number: int, largest: int | None = None) -> list[tuple[int, ...]]:
    """Ways to write a number as a sum."""
    if not number:
        return [()]
    most = number if largest is None else min(largest, number)
    return [
        (part, *rest) for part in range(most, 0, -1) for rest in _partitions(number - part, part)
    ]
