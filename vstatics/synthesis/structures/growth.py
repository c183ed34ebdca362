"""Enumeration of all schemes with a number of planetary gear sets, set by set.

The leading gear sets of a least code are a least code themselves, connected and sound if the whole
is. So every class of equal schemes grows exactly once, from a class with one set less. Schemes need
not be compared with earlier results, and memory does not grow with their number.
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
"""Differences that are ignored between schemes: none, the order of gear sets, also exchange of sun
and ring, or also the order of all three members.
"""
MOST_SETS = 10
"""Largest number of gear sets."""
SCHEMES_AT_ONCE = 50_000
"""Number of schemes that grow at once, to limit memory."""


class StructureSearch(NamedTuple):
    """Request for schemes of planetary gear sets.

    Examples
    --------
    >>> StructureSearch(3, classes="sets", links=(5,)).wanted
    (5,)
    """

    sets: int
    classes: Classes = "none"
    unsound: bool = False
    """True to include schemes in which a group of gear sets is always locked up."""
    ports: bool = False
    """True to list each choice of input and output of a scheme."""
    links: tuple[int, ...] = ()
    """Wanted numbers of links; empty for any number."""
    matrix: bool = False
    """True to include the incidence matrix of each scheme."""

    @property
    def link_range(self) -> range:
        """Possible numbers of links of connected schemes with two or more degrees of freedom.

        >>> StructureSearch(4).link_range
        range(6, 10)
        """
        return range(self.sets + 2, 2 * self.sets + 2)

    @property
    def wanted(self) -> tuple[int, ...]:
        """Requested numbers of links, ascending."""
        return tuple(sorted(set(self.links))) or tuple(self.link_range)


class SchemeBatch(NamedTuple):
    """Batch of schemes in ascending order of codes."""

    codes: Codes
    """Codes of the schemes (links of sun, carrier and ring of each set), shape (schemes, 3*sets).
    """
    links: NDArray[np.intp]
    """Number of links of each scheme, shape (schemes,)."""
    symmetries: Symmetries | None
    """Renamings that leave each scheme unchanged.

    None if schemes are not grouped into classes.
    """
    parents: NDArray[np.intp]
    """Row of the earlier batch from which each scheme grew, shape (schemes,)."""


class SchemePorts(NamedTuple):
    """Choices of input and output of schemes."""

    which: NDArray[np.intp]
    """Row of the scheme of each choice, ascending, shape (ports,)."""
    input: NDArray[np.intp]
    output: NDArray[np.intp]


def check_search(search: StructureSearch) -> None:
    """Refuse an impossible request.

    Raises
    ------
    ValueError
        If the number of sets or of links is out of range.
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
    """Yield all schemes, batch by batch, in ascending order of codes.

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
    kept_renamings = (
        None if search.classes == "none" else symmetries(codes, arrays.orders(search.classes))
    )
    first = SchemeBatch(codes, arrays.link_counts(codes), kept_renamings, np.zeros(1, np.intp))
    yield from _grown(search, first)


def _grown(search: StructureSearch, batch: SchemeBatch) -> Iterator[SchemeBatch]:
    """Yield batches of complete schemes (all sets placed) that grow from a batch, depth first."""
    if batch.codes.shape[1] == MEMBERS * search.sets:
        if len(batch.codes):
            yield batch
        return
    for start in range(0, len(batch.codes), step := rows_at_once(search, batch.codes)):
        yield from _grown(search, next_batch(search, batch.codes[start : start + step]))


def rows_at_once(search: StructureSearch, codes: Codes, most: int = SCHEMES_AT_ONCE) -> int:
    """Return the number of schemes from which about `most` schemes grow."""
    links = int(codes.max(initial=0)) + 1
    choices = len(arrays.next_sets(links, apart=search.classes == "none"))
    return max(most // choices, 1)


def next_batch(search: StructureSearch, codes: Codes) -> SchemeBatch:
    """Return the schemes that grow from codes by a further gear set."""
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
    least = symmetries(grown, arrays.orders(search.classes))
    numbers = np.cumsum(least.least) - 1
    renamings = least._replace(which=numbers[least.which], least=least.least[least.least])
    return SchemeBatch(grown[least.least], links[least.least], renamings, which[least.least])


def counted_by(search: StructureSearch) -> StructureSearch:
    """Return the search for the classes whose `weights` add up to the number of schemes."""
    return search._replace(classes="sets") if search.classes == "none" else search


def weights(search: StructureSearch, batch: SchemeBatch) -> Integers:
    """Return the number of requested schemes that each class represents, shape (schemes,).

    If no classes are requested, a class of n gear sets with s symmetries represents n!/s schemes.
    Each scheme counts with all pairs of input and output, if these are requested. Otherwise the
    number is 1 or, with input and output, the number of pairs that no symmetry makes equal
    (Burnside's lemma).

    Parameters
    ----------
    search : StructureSearch
    batch : SchemeBatch
        Batch of the search that `counted_by` returns.
    """
    assert batch.symmetries is not None  # noqa: S101 - classes have symmetries
    which, links = batch.symmetries.which, batch.symmetries.links
    rows = len(batch.codes)
    counts = np.bincount(which, minlength=rows).astype(np.int64)
    choices = batch.links * (batch.links - 1) if search.ports else np.ones(rows, np.int64)
    if search.classes == "none":
        return np.asarray(choices * (math.factorial(search.sets) // counts))
    if not search.ports:
        return choices
    fixed = (links == np.arange(links.shape[1])).sum(axis=1)
    return np.asarray(np.bincount(which, fixed * (fixed - 1), rows).astype(np.int64) // counts)


def labelled_weights(search: StructureSearch, batch: SchemeBatch) -> Floats:
    """Return the number of schemes with numbered gear sets and named members in each class."""
    assert batch.symmetries is not None  # noqa: S101 - classes have symmetries
    counts = np.bincount(batch.symmetries.which, minlength=len(batch.codes))
    orders = len(arrays.orders(search.classes))
    return np.asarray(math.factorial(search.sets) * float(orders) ** search.sets / counts)


def ports(batch: SchemeBatch) -> SchemePorts:
    """Return the choices of input and output of each scheme; symmetric choices only once.

    Examples
    --------
    >>> [batch] = batches(StructureSearch(1, "order"))  # one set: all choices are equal
    >>> ports(batch)
    SchemePorts(which=array([0]), input=array([0]), output=array([1]))
    """
    parts = [_ports_of(batch, links) for links in np.unique(batch.links).tolist()]
    which, first, second = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    order = np.argsort(which, kind="stable")
    return SchemePorts(which[order], first[order], second[order])


def _ports_of(batch: SchemeBatch, links: int) -> SchemePorts:
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
"""Links of sun, carrier and ring of each gear set, as text."""


class FoundScheme(NamedTuple):
    """Scheme, with a choice of input and output if requested.

    Examples
    --------
    >>> FoundScheme("0-1-2-0-1-3", 4, input=0, output=3).links
    4
    """

    code: SchemeCode
    links: Count
    """Number of links."""
    input: Count | None
    """Number of the input link in the code.

    None means that no input link is requested.
    """
    output: Count | None
    matrix: Sometimes[Sequence[Sequence[int]]] = None
    """Incidence matrix with a row for each link and a column for each sun, carrier and ring."""


def matrices(batch: SchemeBatch) -> Iterator[list[list[int]]]:
    """Yield the incidence matrix of each scheme, as in `FoundScheme`.

    >>> [batch] = batches(StructureSearch(1))
    >>> [*matrices(batch)]
    [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]
    """
    for code, links in zip(batch.codes, batch.links.tolist(), strict=True):
        yield (np.arange(links)[:, np.newaxis] == code).astype(int).tolist()


@refusing()
def schemes(search: StructureSearch) -> Iterator[FoundScheme]:
    """Yield all requested schemes in ascending order of codes.

    Parameters
    ----------
    search : StructureSearch
        Requested schemes.

    Returns
    -------
    iterator of FoundScheme
        Schemes; with ports, one for each choice of input and output.

    Raises
    ------
    ValueError
        If such schemes cannot exist.

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
            chosen = zip(*(column.tolist() for column in ports(batch)), strict=True)
        else:
            chosen = ((row, None, None) for row in range(len(codes)))
        incidences = [*matrices(batch)] if search.matrix else [None] * len(codes)
        yield from (FoundScheme(codes[k], links[k], i, o, incidences[k]) for k, i, o in chosen)
