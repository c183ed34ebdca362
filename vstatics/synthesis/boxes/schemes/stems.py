"""Stems: schemes with one gear set less, from which a worker generates the schemes to search.

The leading gear sets of a least code are a least code themselves, so every scheme grows from its
stem. If a scheme has parts without a common link, its last part is the stem. Five gear sets have
300 000 schemes with millions of choices of input and output, but only 15 000 stems.
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
"""Number of stems up to which all schemes are counted; with more stems, a sample is counted."""
ALIKE = 24
"""Number of stems in the sample from each group of stems with similar first gear sets."""
UNIT = 1000
"""Weight of a scheme, an integer larger than the number of choices of input and output."""


class Stems(NamedTuple):
    """All stems of a search, in a fixed order."""

    search: BoxSearch
    codes: Codes
    """Codes of the stems, shape (stems, 3*sets - 3) for `sets` gear sets in the schemes."""
    parts: tuple[tuple[tuple[Part, ...], int], ...]
    """Divisions of schemes into parts without a common link, each with the number of classes of
    equal schemes of its last part.
    """
    ends: Integers
    """Cumulative weights of the stems, about `UNIT` times the number of schemes, shape (stems,)."""

    @property
    def total(self) -> int:
        """Sum of the weights of all stems."""
        return self.before(len(self.ends))

    def before(self, stem: int) -> int:
        """Return the sum of the weights of all stems before a stem."""
        return int(self.ends[stem - 1]) if stem else 0

    def at(self, place: int) -> int:
        """Return the stem at a position on a line on which each stem is as long as its weight."""
        return int(np.searchsorted(self.ends, place, side="right"))

    def schemes(self, stem: int) -> list[BoxScheme]:
        """Return all schemes that grow from a stem, in order."""
        search = self.search
        if search.kept is not None:
            parts = search.kept
            return [
                BoxScheme(parts.scheme, parts.meshed, parts.held, ((parts.input, parts.output),))
            ]
        if stem < len(self.codes):
            batch = _batch(search, self.codes[stem : stem + 1])
            assert batch.symmetries is not None  # noqa: S101 - codes of classes
            return [*with_choices(search, batch.codes, batch.symmetries)]
        stem -= len(self.codes)
        for split, count in self.parts:
            if stem < count:
                codes = codes_of(split, stem)
                return [*with_choices(search, codes, symmetries(codes, orders("sets")))]
            stem -= count
        raise IndexError(stem)


@lru_cache(maxsize=4)
def stems(search: BoxSearch) -> Stems:
    """Return the stems of a search.

    Examples
    --------
    >>> all_stems = stems(BoxSearch(2, 2, 2, (2.0, 3.0)))
    >>> all_stems.codes, all_stems.ends  # six schemes of two sets grow from one stem
    (array([[0, 1, 2]], dtype=uint8), array([6000]))
    """
    if search.kept is not None:  # an existing gearbox gives the scheme
        return Stems(search, np.zeros((1, 0), np.uint8), (), np.array([UNIT]))
    codes = _codes(search)
    weights = [_weights(search, codes)]
    parts = []
    for split in splits(search.sets, search.links) if search.may_be_in_parts else ():
        numbers = counts(split)
        parts.append((split, len(numbers)))
        weights.append(UNIT * numbers)
    return Stems(search, codes, tuple(parts), np.cumsum(np.concatenate(weights)))


def box_schemes(search: BoxSearch) -> Iterator[BoxScheme]:
    """Yield all schemes of a search, stem by stem.

    Examples
    --------
    >>> schemes = list(box_schemes(BoxSearch(2, 2, 2, (2.0, 3.0))))
    >>> len(schemes), sum(len(scheme.ports) for scheme in schemes)  # counts by Burnside's lemma
    (6, 90)
    """
    search_stems = stems(search)
    for stem in range(len(search_stems.ends)):
        yield from search_stems.schemes(stem)


def _codes(search: BoxSearch) -> Codes:
    """Return the stems from which connected schemes of the search can grow, as codes."""
    sets, links = search.sets - 1, search.links
    if links not in StructureSearch(search.sets).link_range:
        return np.zeros((0, MEMBERS * sets), np.uint8)
    if not sets:
        return np.zeros((1, 0), np.uint8)
    asked = StructureSearch(sets, "sets")
    # The last gear set shares at least one link with the others.
    new = range(links - MEMBERS + 1, links + 1)
    asked = asked._replace(links=tuple(number for number in asked.link_range if number in new))
    return np.concatenate([batch.codes for batch in batches(asked)])


def _batch(search: BoxSearch, codes: Codes) -> SchemeBatch:
    asked = StructureSearch(search.sets, "sets", links=(search.links,))
    return next_batch(asked, codes) if search.sets > 1 else next(batches(asked))


def _weights(search: BoxSearch, codes: Codes) -> Integers:
    """Estimate the weight of each stem, `UNIT` times the number of schemes, shape (stems,).

    Stems with equally many links and equal second gear sets have about equally many schemes.
    """
    if not len(codes):
        return np.zeros(0, np.int64)
    if len(codes) <= COUNTED:
        numbers = np.bincount(_batch(search, codes).parents, minlength=len(codes))
        return np.asarray(UNIT * numbers, np.int64)
    # A stem without counted schemes in its sample can still have some, so no weight is 0.
    weights = np.ones(len(codes), np.int64)
    alike = np.column_stack([codes.max(axis=1), codes[:, MEMBERS : 2 * MEMBERS]])
    _, kinds = np.unique(alike, axis=0, return_inverse=True)
    for kind in range(int(kinds.max()) + 1):
        rows = np.flatnonzero(kinds.ravel() == kind)
        some = rows[:: -(-len(rows) // ALIKE)]
        schemes = len(_batch(search, codes[some]).codes)
        weights[rows] += UNIT * schemes // len(some)
    return weights
