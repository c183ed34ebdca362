"""How many schemes there will be, how large and how long, before they are all found.

Schemes grow set by set. Of those of each number of sets some are drawn, and what grows from
them stands for all (Knuth 1975, Estimating the efficiency of backtrack programs). Where all
are few all are taken, and the number is exact.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.structures import arrays
from vstatics.synthesis.structures.counts import count
from vstatics.synthesis.structures.growth import (
    SchemeBatch,
    StructureSearch,
    batches,
    check_search,
    counted_by,
    labelled_weights,
    next_batch,
    rows_at_once,
    weights,
)
from vstatics.synthesis.structures.json_lines import lines

GROWN_SCHEMES = 600_000
"""About so many schemes grow for each number of sets, fewer where each has more renamings."""
FEW_SETS = 4
"""Fewer grow where there are more sets, as all of them are more."""
COUNTED_SETS = 6
"""So many sets are counted as soon as estimated."""
WRITTEN = 2000
"""Lines of so many schemes show how long a line is."""


class Estimate(NamedTuple):
    """What is known of a search beforehand."""

    by_links: Mapping[int, float]
    exact: bool
    """Whether these are counts."""
    bytes: float
    """Size of the lines. [bytes]"""
    seconds: float
    """How long it takes. [s]"""

    @property
    def total(self) -> float:
        """Schemes in all."""
        return sum(self.by_links.values())


def estimate(search: StructureSearch, *, listed: bool) -> Estimate:
    """What a search will give, from what grows of some schemes.

    Parameters
    ----------
    search : StructureSearch
    listed : bool
        Whether the schemes are written, or only counted.

    Examples
    --------
    >>> estimate(StructureSearch(3, "sets"), listed=False)[:2]  # all of them are tried
    ({5: 190, 6: 155, 7: 37}, True)
    """
    check_search(search)
    grown = _sample(search) if listed or search.classes != "none" else None
    if search.classes == "none":
        counts = _labelled(search)
    else:
        assert grown is not None  # noqa: S101 - only labelled ones are counted without
        counts = _of_classes(search, grown)
    if grown is None or not listed:
        return counts
    length, writing = _written(search, grown.batch)
    seconds = grown.seconds + writing * counts.total
    return counts._replace(bytes=length * counts.total, seconds=seconds)


def _labelled(search: StructureSearch) -> Estimate:
    """Schemes whose sets have numbers, and how long it takes to count them."""
    if _are_soon_counted(search):
        return Estimate(count(search), exact=True, bytes=0.0, seconds=0.0)
    sample = _sample(counted_by(search))
    by_links = _by_links(search, sample, weights(search, sample.batch))
    # they are counted by a list of those of two sets less
    seconds = _sample(StructureSearch(search.sets - 2, "sets")).seconds
    return Estimate(by_links, sample.exact, 0.0, seconds)


def _of_classes(search: StructureSearch, sample: _DrawnSchemes) -> Estimate:
    """Classes. Where labelled schemes are counted, those of the sample tell its error."""
    by_links = _by_links(search, sample, weights(search, sample.batch))
    whole = search._replace(classes="none", ports=False)
    if not sample.exact and _are_soon_counted(whole):
        stand = _by_links(search, sample, labelled_weights(search, sample.batch))
        known = count(whole)
        by_links = {
            links: number * known[links] / stand[links] if stand[links] else number
            for links, number in by_links.items()
        }
    return Estimate(by_links, sample.exact, 0.0, sample.seconds)


def _are_soon_counted(search: StructureSearch) -> bool:
    return search.unsound or search.sets <= COUNTED_SETS


def _by_links(
    search: StructureSearch, sample: _DrawnSchemes, numbers: NDArray[Any]
) -> dict[int, float]:
    """How many there are, where each scheme of the sample stands for so many of a class."""
    all_of_them = numbers * sample.weights
    links = sample.batch.links
    sums = {wanted: float(all_of_them[links == wanted].sum()) for wanted in search.wanted}
    return {wanted: int(one) if one.is_integer() else one for wanted, one in sums.items()}


class _DrawnSchemes(NamedTuple):
    """Some of the schemes of all sets."""

    batch: SchemeBatch
    weights: Floats
    """Each stands for so many."""
    exact: bool
    """Whether they are all."""
    seconds: float
    """That it takes to find all."""


def _sample(search: StructureSearch) -> _DrawnSchemes:
    """Schemes that grow from some of those with one set less, and so on."""
    [batch] = batches(search._replace(sets=1, links=()))
    sizes, exact, seconds = np.ones(1), True, 0.0
    for _ in range(search.sets - 1):
        before = len(batch.codes)
        rows, sizes = _drawn(search, batch, sizes)
        exact = exact and len(rows) == before
        began = time.perf_counter()
        batch = next_batch(search, batch.codes[rows])
        spent = time.perf_counter() - began
        seconds += spent * (sizes.mean() if len(sizes) else 0.0)
        sizes = sizes[batch.parents]
    return _DrawnSchemes(batch, sizes, exact, seconds)


def _drawn(
    search: StructureSearch, batch: SchemeBatch, sizes: Floats
) -> tuple[NDArray[np.intp], Floats]:
    """The rows of some of the schemes, and for how many each stands; all if they are few.

    There are as many of each number of links, at equal steps of what they stand for.
    """
    orders = 1 if search.classes == "none" else len(arrays.orders(search.classes))
    tried = GROWN_SCHEMES // orders // max(search.sets - FEW_SETS, 1)
    most = rows_at_once(search, batch.codes, tried)
    if len(batch.codes) <= most:
        return np.arange(len(batch.codes)), sizes
    groups = [np.flatnonzero(batch.links == links) for links in np.unique(batch.links)]
    drawn, stand = [], []
    for group in groups:
        share = rows_at_once(search, batch.codes[group], tried // len(groups))
        chosen, own = group, sizes[group]
        if len(group) > share:
            reached = np.cumsum(own)
            step = reached[-1] / share
            chosen = group[np.searchsorted(reached, (np.arange(share) + 0.5) * step)]
            own = np.full(share, step)
        drawn.append(chosen)
        stand.append(own)
    return np.concatenate(drawn), np.concatenate(stand)


def _written(search: StructureSearch, batch: SchemeBatch) -> tuple[float, float]:
    """The mean length of a line, and the time it takes."""
    step = math.ceil(len(batch.codes) / WRITTEN)
    if not step:
        return 0.0, 0.0
    part = _every(batch, step)
    began = time.perf_counter()
    text = lines(search, part)
    seconds = time.perf_counter() - began
    written = text.count(b"\n")
    return len(text) / written, seconds / written


def _every(batch: SchemeBatch, step: int) -> SchemeBatch:
    """Some of the schemes of a batch, with all their symmetries."""
    found = batch.symmetries
    if found is not None:
        of_them = found.which % step == 0
        found = found._replace(
            least=found.least[::step],
            which=found.which[of_them] // step,
            links=found.links[of_them],
        )
    return SchemeBatch(batch.codes[::step], batch.links[::step], found, batch.parents[::step])
