"""What drawn runs have in common: what was drawn, and what came of it."""

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
    """What was drawn, and what came of it."""

    drawn: Mapping[str, Statistics]
    results: Mapping[str, Statistics]


def columns_statistics(columns: Mapping[str, Floats]) -> dict[str, Statistics]:
    """The statistics of columns, without those that are 0 or not there in all variants."""
    return {
        name: statistics(numbers)
        for name, numbers in columns.items()
        if np.nan_to_num(numbers).any()
    }


def samples_answer(varied: Sequence[str], found: Mapping[str, Statistics]) -> SamplesAnswer:
    """What was drawn apart from what came of it."""
    drawn = {name: one for name, one in found.items() if name in varied}
    return SamplesAnswer(drawn, {name: one for name, one in found.items() if name not in varied})


def statistics_grids(samples: SamplesAnswer) -> Iterator[Grid]:
    """A table of each."""
    for title, part in zip(("Drawn", "Results"), samples, strict=True):
        if part:
            yield _grid(title, part, title.lower())


def _grid(title: str, found: Mapping[str, Statistics], key: str) -> Grid:
    """A row for each column; how many runs have it is told where that differs."""
    runs = {one.variants for one in found.values()}
    together = len(runs) == 1
    heads = ("mean", "deviation", *(f"{part:.0%}" for part in PARTS))
    rows = []
    for name, one in found.items():
        numbers = (one.mean, one.deviation, *one.quantiles)
        rows.append((name, *numbers, "" if together else one.variants))
    if together:
        number = runs.pop()
        title += f", {number} {plural('run', number)}"
    return grid_of(title, ["", *heads, "runs"], rows, key=key, optional=["runs"])
