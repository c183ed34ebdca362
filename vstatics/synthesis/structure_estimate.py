"""How many schemes there will be, how large and how long, before they are all found.

Schemes grow set by set. Of those of each number of sets some are drawn, and what grows from
them stands for all (Knuth 1975, Estimating the efficiency of backtrack programs). Where all
are few all are taken, and the number is exact.
"""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import numpy as np

from vstatics.synthesis.scheme_arrays import Codes
from vstatics.synthesis.structure_lines import lines
from vstatics.synthesis.structures import (
    SchemeBatch,
    StructureSearch,
    batches,
    check_search,
    counted_by,
    next_batch,
    rows_at_once,
    weights,
)

TRIED = 600_000
"""About so many schemes grow for each number of sets."""
WRITTEN = 2000
"""Lines of so many schemes show how long a line is."""


class Estimate(NamedTuple):
    """What is known of a search beforehand."""

    by_links: dict[int, float]
    exact: bool
    """Whether these are counts."""
    bytes: float
    """Of the lines."""
    seconds: float

    @property
    def count(self) -> float:
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
    grown_by = search if listed else counted_by(search)
    random = np.random.default_rng(14)
    [batch] = batches(grown_by._replace(sets=1, links=()))
    weight, seconds, exact = 1.0, 0.0, True
    for _ in range(search.sets - 1):
        codes = _drawn(grown_by, batch.codes, random)
        exact = exact and len(codes) == len(batch.codes)
        weight *= len(batch.codes) / max(len(codes), 1)
        began = time.perf_counter()
        batch = next_batch(grown_by, codes)
        seconds += weight * (time.perf_counter() - began)
    by_links = _by_links(search, batch, 1 if exact else weight)
    length, writing = _written(search, batch) if listed else (0.0, 0.0)
    count = sum(by_links.values())
    return Estimate(by_links, exact, length * count, seconds + writing * count)


def _drawn(search: StructureSearch, codes: Codes, random: np.random.Generator) -> Codes:
    """Some of the schemes, all if they are few."""
    most = rows_at_once(search, codes, TRIED)
    if len(codes) <= most:
        return codes
    return codes[np.sort(random.choice(len(codes), most, replace=False))]


def _by_links(search: StructureSearch, batch: SchemeBatch, weight: float) -> dict[int, float]:
    """The schemes by links, each of the batch for so many."""
    if batch.symmetries is None:
        one = search.ports
        numbers = batch.links * (batch.links - 1) if one else np.ones_like(batch.links)
    else:
        numbers = weights(search, batch)
    counts = {links: int(numbers[batch.links == links].sum()) for links in search.wanted}
    return {links: count * weight for links, count in counts.items()}


def _written(search: StructureSearch, batch: SchemeBatch) -> tuple[float, float]:
    """The mean length of a line, and the time it takes."""
    step = math.ceil(len(batch.codes) / WRITTEN)
    if not step:
        return 0.0, 0.0
    part = _every(batch, step)
    began = time.perf_counter()
    text = lines(search, part)
    seconds = time.perf_counter() - began
    count = text.count("\n")
    return len(text) / count, seconds / count


def _every(batch: SchemeBatch, step: int) -> SchemeBatch:
    """Some of the schemes of a batch, with all their symmetries."""
    found = batch.symmetries
    if found is not None:
        of_them = found.which % step == 0
        found = found._replace(
            least=found.least[::step], which=found.which[of_them] // step, links=found.links[of_them]
        )
    return SchemeBatch(batch.codes[::step], batch.links[::step], found)
