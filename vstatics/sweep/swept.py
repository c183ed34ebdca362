"""Sweep in Python: an iterator over chunks, or a complete table or dataset."""

from __future__ import annotations

import math
import os
from collections.abc import Generator, Iterable, Iterator
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from vstatics.core.errors import CaseError, listed
from vstatics.core.extras import AnyPicture, higher, require
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.tables.written_results import GEAR, WrittenSweep
from vstatics.sweep.chunk import STATUS, Chunk, joined
from vstatics.sweep.plan import SweepPlan, rounded
from vstatics.sweep.results import best
from vstatics.sweep.tasks import SweepTask, calculate
from vstatics.sweep.units import units_of
from vstatics.sweep.variants.numbered import VariantGrid

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

LEFT_OUT = "left out"
"""Status of a grid point whose variant the condition removed."""
GIB = 2**30


class Sweep(Iterator[Chunk]):
    """Iterator over the variants of a case in chunks, which are calculated on demand.

    The sweep can be iterated once; `to_dataframe`, `to_xarray` and `plot` always calculate all
    variants.

    Parameters
    ----------
    plan : SweepPlan
    jobs : int
        Number of processes.
    """

    def __init__(self, plan: SweepPlan, jobs: int = 1) -> None:
        self.plan, self.jobs = plan, jobs
        self._remaining = self._chunks()

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> Chunk:
        return next(self._remaining)

    def close(self) -> None:
        """End the iteration and the worker processes."""
        self._remaining.close()

    def __repr__(self) -> str:
        """Return a description: varied numbers, number of variants, columns."""
        plan, of = self.plan, " x ".join(map(str, self._shape or [self.plan.variants.count]))
        return f"<Sweep of {listed(plan.names)}: {of} variants, columns {listed(plan.headings)}>"

    def _chunks(self) -> Generator[Chunk]:
        task = SweepTask(self.plan, "csv")
        with task.workers(self.jobs) as called:
            candidates: list[Chunk] = []
            for _, chunk in called.each(calculate, range(self.plan.pieces), ordered=True):
                if self.plan.objectives:
                    candidates = [best.within(self.plan, joined([*candidates, chunk]))]
                else:
                    yield chunk
            if candidates:
                yield from best.among(self.plan, lambda: candidates)

    @property
    def _shape(self) -> list[int]:
        """Number of values of each varied number of a grid; empty for other kinds of variants."""
        variants = self.plan.variants
        return [*map(len, variants.values)] if isinstance(variants, VariantGrid) else []

    def to_dataframe(self) -> pd.DataFrame:
        """Return all variants as a pandas table.

        Returns
        -------
        DataFrame
            One row for each variant, or for each gear of a variant; the index is the number of the
            variant from 0. Columns are as in a file: varied numbers, `status`, columns of `out`.
            `attrs["units"]` contains their units: ``load.speed`` is in rad/s, ``load.speed [rpm]``
            in rpm. [-]

        Raises
        ------
        CaseError
            If pandas is missing, or the table does not fit into memory.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, sweep
        >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
        >>> swept = sweep(case, {"D1.ratio": [-2, -3]}, out="ratio[1]", where="ratio[1] > 3")
        >>> swept.to_dataframe()["ratio[1]"].to_dict()
        {1: 4.0}
        """
        require("pandas", "to_dataframe")
        frame = self._rows("a table").to_dataframe()
        frame.attrs["units"] = units_of(self.plan)
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Return all variants as a dataset of xarray.

        Returns
        -------
        Dataset
            The dimensions of a grid are the varied numbers, with their values as coordinates. Other
            variants have the dimension `variant`, with the varied numbers as coordinates. If each
            gear has a row, there is also the dimension `gear`. Each column is a variable named by
            its heading; the variable `status` holds words. Cells of a grid removed by a condition
            are NaN with the status `left out`; other removed variants are absent. The attribute
            `units` is missing if a variable is relative to the input [-], or is not part of a
            single table.

        Raises
        ------
        CaseError
            If xarray is missing, or the dataset does not fit into memory.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, sweep
        >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
        >>> grid = {"D1.ratio": [-2, -3], "D1.efficiency": [0.9, 1]}
        >>> data = sweep(case, grid, out="ratio[1],efficiency[1]").to_xarray()
        >>> dict(data.sizes), data["ratio[1]"].sel({"D1.ratio": -3}).values
        ({'D1.ratio': 2, 'D1.efficiency': 2}, array([4., 4.]))
        """
        require("xarray", "to_xarray")
        import xarray as xr

        plan, gears = self.plan, [GEAR] * self.plan.by_gear
        units = units_of(plan)
        attributes = {
            name: {"units": units[name]} if name in units else {}
            for name in (*plan.names, *plan.headings)
        }
        per_variant = len(plan.gears) or 1
        if isinstance(plan.variants, VariantGrid):
            self._expect_room("a grid")
            along, shape = [*plan.names], self._shape
            varied: dict[str, Any] = {
                name: (name, values[np.arange(len(values))], attributes[name])
                for name, values in zip(along, plan.variants.values, strict=True)
            }
            parts: Iterable[tuple[Integers, Chunk]] = (
                (chunk.places, chunk) for chunk in self._chunks()
            )
        else:
            rows = self._rows("a dataset")
            numbers, first, of = np.unique(rows.variants, return_index=True, return_inverse=True)
            along, shape = ["variant"], [len(numbers)]
            varied = {"variant": numbers} | {
                name: ("variant", rows.values[first, column], attributes[name])  # noqa: PD011 - of a chunk
                for column, name in enumerate(plan.names)
            }
            parts = [(of * per_variant + (rows.of_gear if gears else 0), rows)]
        columns, status = self._placed(parts, math.prod(shape) * per_variant)
        whole = *shape, *map(len, [plan.gears] * plan.by_gear)
        dimensions = [*along, *gears]
        variables = {"status": (dimensions, status.reshape(whole))} | {
            heading: (dimensions, column.reshape(whole), attributes[heading])
            for heading, column in zip(plan.headings, columns, strict=True)
        }
        return xr.Dataset(variables, varied | {name: list(plan.gears) for name in gears})

    def plot(self, kind: str = "curves", **how: Any) -> AnyPicture:
        """Draw a picture of all variants, which a notebook shows: curves, a map or histograms.

        Numbers are rounded as in the output, so that rounding noise is not drawn.

        Parameters
        ----------
        kind : {"curves", "map", "histogram"}
            Curves versus a varied number, contours versus two, or how often values occur.
        **how
            Arguments of `plot_sweep`, such as the columns `x`, `y`, `z` and `by`.

        Raises
        ------
        CaseError
            If matplotlib or a column is missing, or the variants do not fit into memory.
        ValueError
            If the kind does not exist, or a column does not suit the kind.

        Examples
        --------
        >>> from vstatics import Gear, Mechanism, Transmission, sweep
        >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
        >>> sweep(case, {"D1.ratio": "-4:-2:5"}, out="ratio[1]").plot("curves")
        <SweepPicture curves of 5 rows>
        """
        rows = self._rows("a picture")
        columns = [*zip(self.plan.names, rows.values.T, strict=True)]  # noqa: PD011 - of a chunk
        columns += zip(self.plan.headings, rounded(rows.columns).T, strict=True)
        written = WrittenSweep(
            rows.variants.tolist(),
            [STATUS[code] for code in rows.status],
            {name: column.tolist() for name, column in columns},
            self.plan.names,
            [self.plan.gears[index] for index in rows.of_gear],
        )
        picture: AnyPicture = higher("plot_sweep")(written, kind, **how)
        return picture

    def _placed(
        self, parts: Iterable[tuple[Integers, Chunk]], size: int
    ) -> tuple[Floats, np.ndarray[Any, np.dtype[np.object_]]]:
        """Return columns, and statuses as words, of all variants; NaN without a row."""
        # References take 8 bytes each, whatever the length of the words.
        words = np.array(STATUS, object)
        columns = np.full((len(self.plan.headings), size), np.nan)
        status = np.full(size, LEFT_OUT, object)
        for places, chunk in parts:
            columns[:, places] = chunk.columns.T
            status[places] = words[chunk.status]
        return columns, status

    def _rows(self, what: str) -> Chunk:
        """Return all rows as a single chunk; check the memory if the number of rows is known."""
        if self.plan.where is None and not self.plan.objectives:
            self._expect_room(what)
        return joined(list(self._chunks()) or [_no_rows(self.plan)])

    def _expect_room(self, what: str) -> None:
        """Refuse a table larger than the memory, before anything is calculated.

        Raises
        ------
        CaseError
        """
        size = 8 * self.plan.count * len(self.plan.output_headings)
        if size > (room := _memory()):
            message = (
                f"{what} of {self.plan.count} rows would need about {size / GIB:.3g} GiB, but this "
                f"machine has {room / GIB:.3g}: expected fewer variants or columns; process the "
                "chunks, or use `vstatics sweep -o`"
            )
            raise CaseError("E911", message)


def _no_rows(plan: SweepPlan) -> Chunk:
    values, columns = (np.empty((0, len(names))) for names in (plan.names, plan.headings))
    none, status = np.empty(0, np.int64), np.empty(0, np.uint8)
    named = plan.names, plan.headings, (), plan.gears
    return Chunk(0, none, values, status, columns, np.empty((0, 0)), {}, *named)


def _memory() -> float:
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):  # the system does not provide the size
        return math.inf
