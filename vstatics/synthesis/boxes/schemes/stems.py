"""What schemes grow from, so that any of them can be made where they are searched.

The first sets of a least code are a least code themselves, so all of them grow from those of one
set less, their stems; of schemes in parts the last part is the stem. Five sets have 300 000
schemes with millions of ports, but no more than 15 000 stems.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme, with_choices
from vstatics.synthesis.boxes.schemes.parts import Part, codes_of, counts, splits
from vstatics.synthesis.structures.arrays import MEMBERS, Codes, orders
from vstatics.synthesis.structures.growth import SchemeBatch, StructureSearch, batches, next_batch
from vstatics.synthesis.structures.least_codes import symmetries

COUNTED = 500
"""So many stems have the schemes that grow from them counted; of more of them some."""
ALIKE = 24
"""So many of those that begin alike."""
UNIT = 1000
"""Weights are whole numbers; a scheme has so many, more than it has choices of ports."""


class Stems(NamedTuple):
    """All that the schemes of a search grow from, in an order of their own."""

    search: BoxSearch
    codes: Codes
    """Codes of one set less, shape (stems, 3*sets - 3)."""
    parts: tuple[tuple[tuple[Part, ...], int], ...]
    """Splits of schemes in parts, with the number of classes of the last part."""
    ends: Integers
    """The sum of the weights of each stem and of those before: about `UNIT` for each of its
    schemes, shape (all stems,)."""

    @property
    def total(self) -> int:
        """The sum of all weights."""
        return self.before(len(self.ends))

    def before(self, stem: int) -> int:
        """The sum of the weights of those before a stem."""
        return int(self.ends[stem - 1]) if stem else 0

    def at(self, place: int) -> int:
        """The stem at a place of the line on which each is as long as its weight."""
        return int(np.searchsorted(self.ends, place, side="right"))

    def schemes(self, stem: int) -> list[BoxScheme]:
        """All that grow from a stem, in their order."""
        search = self.search
        if search.kept is not None:
            kept = search.kept
            return [BoxScheme(kept.scheme, kept.meshed, kept.held, ((kept.input, kept.output),))]
        if stem < len(self.codes):
            return _grown(search, self.codes[stem : stem + 1])
        stem -= len(self.codes)
        for split, count in self.parts:
            if stem < count:
                codes = codes_of(split, stem)
                return [*with_choices(search, codes, symmetries(codes, orders("sets")))]
            stem -= count
        raise IndexError(stem)


@lru_cache(maxsize=4)
def stems(search: BoxSearch) -> Stems:
    """The stems of a search.

    Examples
    --------
    >>> found = stems(BoxSearch(2, 2, 2, (2.0, 3.0)))
    >>> found.codes, found.ends  # six schemes of two sets grow from one of one set
    (array([[0, 1, 2]], dtype=uint8), array([6000]))
    """
    if search.kept is not None:  # its scheme is known
        return Stems(search, np.zeros((1, 0), np.uint8), (), np.array([UNIT]))
    codes = _codes(search)
    weights = [_weights(search, codes)]
    parts = []
    for split in splits(search.sets, search.links) if search.may_be_in_parts else ():
        own = counts(split)
        parts.append((split, len(own)))
        weights.append(UNIT * own)
    return Stems(search, codes, tuple(parts), np.cumsum(np.concatenate(weights)))


def box_schemes(search: BoxSearch) -> Iterator[BoxScheme]:
    """All schemes that a search looks at, stem by stem.

    Examples
    --------
    >>> found = list(box_schemes(BoxSearch(2, 2, 2, (2.0, 3.0))))
    >>> len(found), sum(len(one.ports) for one in found)  # tree schemes, facts by Burnside
    (6, 90)
    """
    found = stems(search)
    for stem in range(len(found.ends)):
        yield from found.schemes(stem)


def _codes(search: BoxSearch) -> Codes:
    """Codes of one set less from which connected schemes with so many links may grow."""
    sets, links = search.sets - 1, search.links
    if links not in StructureSearch(search.sets).link_range:
        return np.zeros((0, MEMBERS * sets), np.uint8)
    if not sets:
        return np.zeros((1, 0), np.uint8)
    asked = StructureSearch(sets, "sets")
    new = range(links - MEMBERS + 1, links + 1)  # the last set shares a link at least
    asked = asked._replace(links=tuple(one for one in asked.link_range if one in new))
    return np.concatenate([batch.codes for batch in batches(asked)])


def _batch(search: BoxSearch, codes: Codes) -> SchemeBatch:
    """The schemes that grow from some codes of one set less."""
    asked = StructureSearch(search.sets, "sets", links=(search.links,))
    return next_batch(asked, codes) if search.sets > 1 else next(batches(asked))


def _grown(search: BoxSearch, codes: Codes) -> list[BoxScheme]:
    """The schemes that grow from a code of one set less, with all their choices."""
    batch = _batch(search, codes)
    assert batch.symmetries is not None  # noqa: S101 - they are classes
    return [*with_choices(search, batch.codes, batch.symmetries)]


def _weights(search: BoxSearch, codes: Codes) -> Integers:
    """About how many schemes grow from each stem, `UNIT` times; shape (stems,).

    Those with equal links whose first two sets share the same links have about equally many.
    """
    if not len(codes):
        return np.zeros(0, np.int64)
    if len(codes) <= COUNTED:
        found = np.bincount(_batch(search, codes).parents, minlength=len(codes))
        return np.asarray(UNIT * found, np.int64)
    weights = np.ones(len(codes), np.int64)  # of what may have schemes although no other has
    alike = np.column_stack([codes.max(axis=1), codes[:, MEMBERS : 2 * MEMBERS]])
    _, kinds = np.unique(alike, axis=0, return_inverse=True)
    for kind in range(int(kinds.max()) + 1):
        rows = np.flatnonzero(kinds.ravel() == kind)
        some = rows[:: -(-len(rows) // ALIKE)]
        schemes = len(_batch(search, codes[some]).codes)
        weights[rows] += UNIT * schemes // len(some)
    return weights
