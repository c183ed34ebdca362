"""Many schemes as rows of an array, with addition of gear sets and a check of soundness.

A row contains the links of sun, carrier and ring of each gear set in turn. Links are numbered in
the order of their first appearance (a restricted growth string). Its leading sets are also such a
row, so that rows with one more set grow from it. A scheme is unsound if a group of sets always
rotates as a block. All rows that grow from it are unsound, too.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

Bits = NDArray[np.uint64]
"""Links as bits of an integer, in an array."""
Codes = NDArray[np.uint8]
"""Schemes as rows of links, shape (schemes, 3*sets)."""
MEMBERS = 3
"""Number of members of a gear set: sun, carrier and ring."""
LEAST_MOBILITY = 2
"""Smallest degree of freedom (links minus sets) of a group of gear sets that is not locked up."""


def first_codes() -> Codes:
    """Return the only scheme with a single gear set.

    >>> first_codes()
    array([[0, 1, 2]], dtype=uint8)
    """
    return np.arange(MEMBERS, dtype=np.uint8)[np.newaxis]


def link_counts(codes: Codes) -> NDArray[np.intp]:
    """Return the number of links of each scheme, shape (schemes,).

    >>> link_counts(first_codes())
    array([3])
    """
    return np.asarray(codes.max(axis=1).astype(np.intp) + 1)


@cache
def next_sets(links: int, *, apart: bool) -> Codes:
    """Return the possible links of a further gear set, in ascending order, shape (choices, 3).

    Parameters
    ----------
    links : int
        Number of links of the scheme.
    apart : bool
        True to include gear sets that share no link with the scheme.

    Examples
    --------
    >>> len(next_sets(3, apart=False)), next_sets(3, apart=True)[-1]
    (33, array([3, 4, 5], dtype=uint8))
    """
    new = links, links + 1, links + 2
    choices = []
    for chosen in product(range(links + 1), repeat=MEMBERS):
        fresh = iter(new)
        members = tuple(next(fresh) if link == links else link for link in chosen)
        if len(set(members)) == MEMBERS and (apart or members != new):
            choices.append(members)
    return np.array(sorted(choices), dtype=np.uint8)


def grown(codes: Codes, *, apart: bool) -> tuple[NDArray[np.intp], Codes]:
    """Return all schemes that grow from schemes by a further gear set.

    Parameters
    ----------
    codes : array, shape (schemes, 3*sets)
    apart : bool
        True to include gear sets that share no link with the scheme.

    Returns
    -------
    parents : array, shape (grown,)
        Row of `codes` from which each scheme grew.
    grown : array, shape (grown, 3*sets + 3)
        Schemes in the order of their parents, ascending from each parent.

    Examples
    --------
    >>> grown(first_codes(), apart=False)[1].shape
    (33, 6)
    """
    links = link_counts(codes)
    parts = []
    for count in np.unique(links).tolist():
        rows = np.flatnonzero(links == count)
        sets = next_sets(count, apart=apart)
        parents = np.repeat(rows, len(sets))
        parts.append((parents, np.tile(sets, (len(rows), 1))))
    parents = np.concatenate([rows for rows, _ in parts])
    order = np.argsort(parents, kind="stable")
    parents = parents[order]
    last = np.concatenate([sets for _, sets in parts])[order]
    return parents, np.concatenate([codes[parents], last], axis=1)


def link_masks(codes: Codes) -> Bits:
    """Return the links of each gear set as bits, shape (schemes, sets).

    >>> link_masks(first_codes())
    array([[7]], dtype=uint64)
    """
    bits = np.uint64(1) << codes.astype(np.uint64)
    return np.asarray(bits.reshape(len(codes), -1, MEMBERS).sum(axis=2), dtype=np.uint64)


def stays_sound(parents: Codes, which: NDArray[np.intp], children: Codes) -> NDArray[np.bool_]:
    """Return whether schemes are still sound after addition of the last gear set.

    A group of gear sets always rotates as a block if it has fewer than two links more than sets.

    Parameters
    ----------
    parents : array, shape (parents, 3*sets)
        Sound schemes from which the children grew.
    which : array, shape (children,)
        Row in `parents` from which each child grew.
    children : array, shape (children, 3*sets + 3)

    Returns
    -------
    array, shape (children,)
        True for sound schemes.

    Examples
    --------
    >>> parents = first_codes()
    >>> which, children = grown(parents, apart=False)
    >>> int(stays_sound(parents, which, children).sum())  # without six that share three links
    27
    """
    masks = link_masks(parents)
    last = link_masks(children[:, -MEMBERS:])[:, 0]
    unions = [(np.zeros(len(parents), np.uint64), 0)]
    for number in range(masks.shape[1]):
        unions += [(union | masks[:, number], size + 1) for union, size in unions]
    sound = np.ones(len(children), dtype=bool)
    for union, size in unions[1:]:
        sound &= bit_counts(union[which] | last) >= size + 1 + LEAST_MOBILITY
    return sound


def are_connected(codes: Codes) -> NDArray[np.bool_]:
    """Return whether common links connect all gear sets of a scheme, shape (schemes,).

    >>> are_connected(np.array([[0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 4, 0]], dtype=np.uint8))
    array([False,  True])
    """
    masks = link_masks(codes)
    reached = masks[:, 0].copy()
    for _ in range(masks.shape[1] - 1):
        for mask in masks.T:
            reached |= np.where(reached & mask, mask, np.uint64(0))
    return np.asarray(reached == np.bitwise_or.reduce(masks, axis=1))


def _bit_counts(bits: Bits) -> NDArray[np.uint8]:
    """Count the set bits of each integer, for versions of NumPy without `bitwise_count`.

    >>> _bit_counts(np.array([0, 7, 2**63 + 256], dtype=np.uint64))
    array([0, 3, 2], dtype=uint8)
    """
    by_byte = np.ascontiguousarray(bits)[..., np.newaxis].view(np.uint8)
    return np.asarray(np.unpackbits(by_byte, axis=-1).sum(axis=-1, dtype=np.uint8))


bit_counts: Callable[[Bits], NDArray[np.uint8]] = getattr(np, "bitwise_count", _bit_counts)


def orders(classes: str) -> tuple[tuple[int, ...], ...]:
    """Return the orders of members of a gear set that a class of schemes does not distinguish.

    >>> orders("sets"), orders("members"), len(orders("order"))
    (((0, 1, 2),), ((0, 1, 2), (2, 1, 0)), 6)
    """
    if classes == "order":
        return tuple(permutations(range(MEMBERS)))
    return ((0, 1, 2), (2, 1, 0))[: 1 + (classes == "members")]
