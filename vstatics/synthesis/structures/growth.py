"""All schemes of so many planetary sets, as they grow set by set, and one by one.

The first sets of a least code are a least code themselves, connected and sound as it is. So
every class grows once, from one of one set less; nothing has to be compared with what was
found before, and memory does not grow with their number.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.core.arguments import refusing
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.tables.answer import Count, Sometimes, Words
from vstatics.synthesis.structures import arrays
from vstatics.synthesis.structures.arrays import MEMBERS, Codes
from vstatics.synthesis.structures.least_codes import Symmetries, symmetries

Classes = Literal["none", "sets", "members", "order"]
"""Schemes that count as one: none do; equal up to renaming of sets; also with sun and ring
exchanged; with the members of a set in any order."""
MOST_SETS = 10
SCHEMES_AT_ONCE = 50_000
"""So many schemes grow at once, for the sake of memory."""


class StructureSearch(NamedTuple):
    """Which schemes are asked for.

    Examples
    --------
    >>> StructureSearch(3, classes="sets", links=(5,)).wanted
    (5,)
    """

    sets: int
    classes: Classes = "none"
    unsound: bool = False
    """Whether also those where a group of sets is locked."""
    ports: bool = False
    """Whether an input and an output are chosen."""
    links: tuple[int, ...] = ()
    """Only with so many; any when empty."""
    matrix: bool = False
    """Whether their matrices are told, too."""

    @property
    def link_range(self) -> range:
        """The numbers of links that connected schemes of two or more degrees of freedom have.

        >>> StructureSearch(4).link_range
        range(6, 10)
        """
        return range(self.sets + 2, 2 * self.sets + 2)

    @property
    def wanted(self) -> tuple[int, ...]:
        """The numbers of links that are asked for, ascending."""
        return tuple(sorted(set(self.links))) or tuple(self.link_range)


class SchemeBatch(NamedTuple):
    """Some of the schemes, in ascending order of their codes."""

    codes: Codes
    """Shape (schemes, 3*sets)."""
    links: NDArray[np.intp]
    """Shape (schemes,)."""
    symmetries: Symmetries | None
    """By which renamings they stay as they are; None where only they themselves are a class."""
    parents: NDArray[np.intp]
    """The row that each grew from, shape (schemes,)."""


class SchemePorts(NamedTuple):
    """Inputs and outputs of schemes."""

    which: NDArray[np.intp]
    """The row of the scheme, ascending, shape (ports,)."""
    input: NDArray[np.intp]
    output: NDArray[np.intp]


def check_search(search: StructureSearch) -> None:
    """Refuse what can't be asked for.

    Raises
    ------
    ValueError
    """
    if not 1 <= search.sets <= MOST_SETS:
        raise ValueError(f"read {search.sets} sets, expected 1 to {MOST_SETS}")
    there = search.link_range
    for links in search.links:
        if links not in there:
            sets = f"{search.sets} sets have" if search.sets > 1 else "one set has"
            expected = f"{there[0]} to {there[-1]}" if len(there) > 1 else f"{there[0]}"
            raise ValueError(f"read {links} links, but {sets} {expected}")


def batches(search: StructureSearch) -> Iterator[SchemeBatch]:
    """All schemes, batch by batch, in ascending order of their codes.

    Parameters
    ----------
    search : StructureSearch

    Examples
    --------
    >>> search = StructureSearch(2, "members")
    >>> [one] = batches(search)
    >>> one.codes[:2].tolist(), one.links
    ([[0, 1, 2, 0, 1, 3], [0, 1, 2, 0, 2, 3]], array([4, 4, 4, 5, 4, 5, 5]))
    """
    check_search(search)
    codes = arrays.first_codes()
    found = None if search.classes == "none" else symmetries(codes, arrays.orders(search.classes))
    first = SchemeBatch(codes, arrays.link_counts(codes), found, np.zeros(1, np.intp))
    yield from _grown(search, first)


def _grown(search: StructureSearch, batch: SchemeBatch) -> Iterator[SchemeBatch]:
    """What grows from some schemes in the end, depth first."""
    if batch.codes.shape[1] == MEMBERS * search.sets:
        if len(batch.codes):
            yield batch
        return
    for start in range(0, len(batch.codes), step := rows_at_once(search, batch.codes)):
        yield from _grown(search, next_batch(search, batch.codes[start : start + step]))


def rows_at_once(search: StructureSearch, codes: Codes, most: int = SCHEMES_AT_ONCE) -> int:
    """From so many schemes about `most` may grow."""
    links = int(codes.max(initial=0)) + 1
    choices = len(arrays.next_sets(links, apart=search.classes == "none"))
    return max(most // choices, 1)


def next_batch(search: StructureSearch, codes: Codes) -> SchemeBatch:
    """The schemes of one set more that grow from some, shape (schemes, 3*sets)."""
    apart = search.classes == "none"
    which, grown = arrays.grown(codes, apart=apart)
    to_come = search.sets - grown.shape[1] // MEMBERS
    links = arrays.link_counts(grown)
    most_new = to_come * (MEMBERS if apart else MEMBERS - 1)
    wanted, there = np.array(search.wanted), links[:, np.newaxis]
    good = ((wanted >= there) & (wanted <= there + most_new)).any(axis=1)
    if apart and not to_come:
        good &= arrays.are_connected(grown)
    which, grown, links = which[good], grown[good], links[good]
    if not search.unsound:
        good = arrays.stays_sound(codes, which, grown)
        which, grown, links = which[good], grown[good], links[good]
    if apart:
        return SchemeBatch(grown, links, None, which)
    found = symmetries(grown, arrays.orders(search.classes))
    numbers = np.cumsum(found.least) - 1
    own = found._replace(which=numbers[found.which], least=found.least[found.least])
    return SchemeBatch(grown[found.least], links[found.least], own, which[found.least])


def counted_by(search: StructureSearch) -> StructureSearch:
    """The search by whose classes schemes are counted; each has a weight."""
    return search._replace(classes="sets") if search.classes == "none" else search


def weights(search: StructureSearch, batch: SchemeBatch) -> Integers:
    """How many of the schemes that are asked for each class stands for, shape (schemes,).

    All orders of the sets, by the number of those that change nothing; the choices of input
    and output that a symmetry does not change into each other, by Burnside's lemma.

    Parameters
    ----------
    search : StructureSearch
    batch : SchemeBatch
        Of `counted_by`.
    """
    assert batch.symmetries is not None  # noqa: S101 - they are counted by classes
    which, links = batch.symmetries.which, batch.symmetries.links
    rows = len(batch.codes)
    own = np.bincount(which, minlength=rows).astype(np.int64)
    choices = batch.links * (batch.links - 1) if search.ports else np.ones(rows, np.int64)
    if search.classes == "none":
        return np.asarray(choices * (math.factorial(search.sets) // own))
    if not search.ports:
        return choices
    fixed = (links == np.arange(links.shape[1])).sum(axis=1)
    return np.asarray(np.bincount(which, fixed * (fixed - 1), rows).astype(np.int64) // own)


def labelled_weights(search: StructureSearch, batch: SchemeBatch) -> Floats:
    """How many schemes each class has where sets have numbers and members names, (schemes,)."""
    assert batch.symmetries is not None  # noqa: S101 - they are classes
    own = np.bincount(batch.symmetries.which, minlength=len(batch.codes))
    orders = len(arrays.orders(search.classes))
    return np.asarray(math.factorial(search.sets) * float(orders) ** search.sets / own)


def ports(batch: SchemeBatch) -> SchemePorts:
    """The inputs and outputs of each scheme; of those that a symmetry makes equal the least.

    Examples
    --------
    >>> [batch] = batches(StructureSearch(1, "order"))  # one set: all choices are equal
    >>> ports(batch)
    SchemePorts(which=array([0]), input=array([0]), output=array([1]))
    """
    parts = [_ports_of(batch, links) for links in np.unique(batch.links).tolist()]
    which, first, second = (np.concatenate(one) for one in zip(*parts, strict=True))
    order = np.argsort(which, kind="stable")
    return SchemePorts(which[order], first[order], second[order])


def _ports_of(batch: SchemeBatch, links: int) -> SchemePorts:
    """Those of the schemes with so many links."""
    first, second = np.nonzero(~np.eye(links, dtype=bool))
    of_links = batch.links == links
    rows = np.flatnonzero(of_links)
    is_least = np.ones((len(rows), len(first)), dtype=bool)
    if batch.symmetries is not None:
        renamings = of_links[batch.symmetries.which]
        new = batch.symmetries.links[renamings].astype(np.intp)
        starts = np.flatnonzero(np.diff(batch.symmetries.which[renamings], prepend=-1))
        places = new[:, first] * links + new[:, second]
        is_least = np.minimum.reduceat(places, starts, axis=0) == first * links + second
    row, pair = np.nonzero(is_least)
    return SchemePorts(rows[row], first[pair], second[pair])


SchemeCode = Annotated[str, Words(pattern="^[0-9]+(-[0-9]+)*$")]
"""The links of sun, carrier and ring of each set as text."""


class FoundScheme(NamedTuple):
    """A scheme, or a choice of its input and output.

    Examples
    --------
    >>> FoundScheme("0-1-2-0-1-3", 4, input=0, output=3).links
    4
    """

    code: SchemeCode
    links: Count
    """How many there are."""
    input: Count | None
    """Links of the code; None where none are chosen."""
    output: Count | None
    matrix: Sometimes[Sequence[Sequence[int]]] = None
    """A row for each link, a column for each sun, carrier and ring: 1 where it has that."""


def matrices(batch: SchemeBatch) -> Iterator[list[list[int]]]:
    """The matrix of each scheme, as `FoundScheme` has it.

    >>> [batch] = batches(StructureSearch(1))
    >>> [*matrices(batch)]
    [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]
    """
    for code, links in zip(batch.codes, batch.links.tolist(), strict=True):
        yield (np.arange(links)[:, np.newaxis] == code).astype(int).tolist()


@refusing()
def schemes(search: StructureSearch) -> Iterator[FoundScheme]:
    """All schemes that are asked for, in ascending order of their codes.

    Parameters
    ----------
    search : StructureSearch
        What schemes are asked for.

    Returns
    -------
    iterator of FoundScheme

    Raises
    ------
    ValueError
        If there can be none such.

    Examples
    --------
    >>> for one in schemes(StructureSearch(2, "order")):
    ...     print(one.code, one.links)
    0-1-2-0-1-3 4
    0-1-2-0-3-4 5
    >>> next(schemes(StructureSearch(2, ports=True)))
    FoundScheme(code='0-1-2-0-1-3', links=4, input=0, output=1, matrix=None)
    """
    for batch in batches(search):
        codes = ["-".join(map(str, row)) for row in batch.codes.tolist()]
        links = batch.links.tolist()
        chosen: Iterable[Any]
        if search.ports:
            chosen = zip(*(one.tolist() for one in ports(batch)), strict=True)
        else:
            chosen = ((row, None, None) for row in range(len(codes)))
        told = [*matrices(batch)] if search.matrix else [None] * len(codes)
        yield from (FoundScheme(codes[k], links[k], i, o, told[k]) for k, i, o in chosen)
