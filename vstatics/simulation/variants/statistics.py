"""Statistics of samples: of the random numbers and of the results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import plural
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.answer import document
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.sweep.results.statistics import PARTS, Statistics, statistics


@document("vstatics-samples")
class SamplesAnswer(NamedTuple):
    """Statistics of the random numbers, and of the results."""

    drawn: Mapping[str, Statistics]
    results: Mapping[str, Statistics]


def columns_statistics(columns: Mapping[str, Floats]) -> dict[str, Statistics]:
    """Return the statistics of columns, except for columns that are 0 or missing in all runs."""
    return {
        name: statistics(numbers)
        for name, numbers in columns.items()
        if np.nan_to_num(numbers).any()
    }


def samples_answer(varied: Sequence[str], columns: Mapping[str, Statistics]) -> SamplesAnswer:
    """Separate the statistics of random numbers from the statistics of results."""
    drawn = {name: numbers for name, numbers in columns.items() if name in varied}
    return SamplesAnswer(
        drawn, {name: numbers for name, numbers in columns.items() if name not in varied}
    )


def statistics_grids(samples: SamplesAnswer) -> Iterator[Grid]:
    """Yield a table of random numbers and a table of results, with a row for each quantity.

    The title contains the number of runs, unless it differs between rows and needs a column.
    """
    heads = ("mean", "deviation", *(f"{part:.0%}" for part in PARTS))
    for title, columns in zip(("Drawn", "Results"), samples, strict=True):
        runs = {column.variants for column in columns.values()}
        is_same = len(runs) == 1
        rows = [
            (name, part.mean, part.deviation, *part.quantiles, "" if is_same else part.variants)
            for name, part in columns.items()
        ]
        head = f"{title}, {max(runs)} {plural('run', max(runs))}" if is_same else title
        if rows:
            key = title.lower()
            yield grid_of(head, ["", *heads, "runs"], rows, key=key, optional=["runs"])
