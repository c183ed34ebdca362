"""Estimate of the number of schemes, the size of their list and the time, from a sample.

Schemes grow set by set. At each number of gear sets, a sample of the schemes is drawn. The schemes
that grow from the sample represent all (Knuth 1975, Estimating the efficiency of backtrack
programs). If there are only few schemes, all are taken, so that the number is exact.
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
"""Number of schemes that grow in each step if all orders of the members differ.
"""
FEW_SETS = 4
"""Number of gear sets above which fewer schemes grow in each step."""
COUNTED_SETS = 6
"""Largest number of gear sets for which counting is as fast as an estimate."""
WRITTEN = 2000
"""Number of schemes in the sample for the mean length of output lines."""


class Estimate(NamedTuple):
    """Estimated result of a search for schemes."""

    by_links: Mapping[int, float]
    """Number of schemes by number of links."""
    exact: bool
    """True if the numbers are exact."""
    bytes: float
    """Size of the output [bytes]."""
    seconds: float
    """Time of the search. [s]"""

    @property
    def total(self) -> float:
        """Total number of schemes."""
        return sum(self.by_links.values())


def estimate(search: StructureSearch, *, listed: bool) -> Estimate:
    """Estimate the results of a search from the growth of a sample.

    Parameters
    ----------
    search : StructureSearch
    listed : bool
        True if the schemes are written, False if only counted.

    Examples
    --------
    >>> estimate(StructureSearch(3, "sets"), listed=False)[:2]  # exact, since there are few
    ({5: 190, 6: 155, 7: 37}, True)
    """
    check_search(search)
    grown = _grown_sample(search) if listed or search.classes != "none" else None
    if search.classes == "none":
        counts = _labelled(search)
    else:
        assert grown is not None  # noqa: S101 - only labelled schemes are counted without a sample
        by_links = _by_links(search, grown, weights(search, grown.batch))
        whole = search._replace(classes="none", ports=False)
        if not grown.exact and _are_soon_counted(whole):
            stand = _by_links(search, grown, labelled_weights(search, grown.batch))
            # The known numbers of schemes with numbered sets correct the sample.
            known = count(whole)
            by_links = {
                links: number * known[links] / stand[links] if stand[links] else number
                for links, number in by_links.items()
            }
        counts = Estimate(by_links, grown.exact, 0.0, grown.seconds)
    if grown is None or not listed:
        return counts
    length, writing = _written(search, grown.batch)
    seconds = grown.seconds + writing * counts.total
    return counts._replace(bytes=length * counts.total, seconds=seconds)


def _labelled(search: StructureSearch) -> Estimate:
    """Estimate the number of schemes with numbered gear sets, and the time to count the schemes."""
    if _are_soon_counted(search):
        return Estimate(count(search), exact=True, bytes=0.0, seconds=0.0)
    sample = _grown_sample(counted_by(search))
    by_links = _by_links(search, sample, weights(search, sample.batch))
    # The count needs a list of the schemes with two gear sets less.
    seconds = _grown_sample(StructureSearch(search.sets - 2, "sets")).seconds
    return Estimate(by_links, sample.exact, 0.0, seconds)


def _are_soon_counted(search: StructureSearch) -> bool:
    return search.unsound or search.sets <= COUNTED_SETS


def _by_links(
    search: StructureSearch, sample: _DrawnSchemes, numbers: NDArray[Any]
) -> dict[int, float]:
    """Return the number of schemes that a sample represents, by number of links."""
    all_of_them = numbers * sample.weights
    links = sample.batch.links
    sums = {wanted: float(all_of_them[links == wanted].sum()) for wanted in search.wanted}
    return {wanted: int(total) if total.is_integer() else total for wanted, total in sums.items()}


class _DrawnSchemes(NamedTuple):
    """Sample of the schemes with the full number of gear sets."""

    batch: SchemeBatch
    weights: Floats
    """Number of schemes that each scheme of the sample represents, shape (schemes,)."""
    exact: bool
    """True if the sample contains all schemes."""
    seconds: float
    """Expected time to find all schemes, not only the sample. [s]"""


def _grown_sample(search: StructureSearch) -> _DrawnSchemes:
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
    """Draw a sample of rows; return the rows, and the number of rows that each represents.

    Few rows are all returned. Otherwise, the sample has equally many rows for each number of links,
    evenly spaced by their weight.
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
        chosen, sizes_of_rows = group, sizes[group]
        if len(group) > share:
            reached = np.cumsum(sizes_of_rows)
            step = reached[-1] / share
            chosen = group[np.searchsorted(reached, (np.arange(share) + 0.5) * step)]
            sizes_of_rows = np.full(share, step)
        drawn.append(chosen)
        stand.append(sizes_of_rows)
    return np.concatenate(drawn), np.concatenate(stand)


def _written(search: StructureSearch, batch: SchemeBatch) -> tuple[float, float]:
    """Return the mean length [bytes] and the mean writing time [s] of an output line."""
    step = math.ceil(len(batch.codes) / WRITTEN)
    if not step:
        return 0.0, 0.0
    reduced = batch.symmetries
    if reduced is not None:
        selected = reduced.which % step == 0
        reduced = reduced._replace(
            least=reduced.least[::step],
            which=reduced.which[selected] // step,
            links=reduced.links[selected],
        )
    part = SchemeBatch(batch.codes[::step], batch.links[::step], reduced, batch.parents[::step])
    began = time.perf_counter()
    text = lines(search, part)
    seconds = time.perf_counter() - began
    written = text.count(b"\n")
    return len(text) / written, seconds / written
