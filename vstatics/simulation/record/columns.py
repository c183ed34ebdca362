"""The course of a simulation as columns of numbers, named as in expressions of a sweep."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from vstatics.core.extras import require
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables import csv
from vstatics.core.tables.names import written
from vstatics.simulation.record.motion import Motion

if TYPE_CHECKING:
    import pandas as pd


def columns(motion: Motion) -> dict[str, Floats]:
    """`time`, then each of speeds, slips and torques by its heading, such as ``speeds[in]``.

    [s], [rad/s], [N*m]; then what was asked for; of a run that had to stop also `stopped`, 1 at its
    last instant.
    """
    made = {"time": motion.time}
    for table, names, values in (
        ("speeds", motion.links, motion.speeds),
        ("slips", motion.elements, motion.slips),
        ("torques", motion.devices, motion.torques),
    ):
        for index in range(len(names)):
            made[f"{table}[{written(index, names)}]"] = values[:, index]
    for table, rows in motion.asked.items():
        names = tuple(rows)
        for n, name in enumerate(names):
            made[f"{table}[{written(n, names)}]" if name else table] = rows[name]
    if motion.stopped is not None:
        made["stopped"] = np.zeros(len(motion.time))
        made["stopped"][-1] = 1.0
    return made


def motion_dataframe(motion: Motion) -> pd.DataFrame:
    """A row for each instant by its time, a column for each heading; see `Motion.to_dataframe`."""
    require("pandas", "to_dataframe")
    import pandas as pd

    named = columns(motion)
    return pd.DataFrame(named, index=pd.Index(named.pop("time"), name="time"))


def as_csv(motion: Motion, *, raw: bool = False) -> str:
    """A line of headings, then one for each instant, with all digits; NaN is an empty cell."""
    named = columns(motion)
    table = np.column_stack([*named.values()])
    return "".join([csv.lines([named], raw=raw), *_lines(table)])


def _lines(table: Floats) -> Iterator[str]:
    for row in table.tolist():
        yield ",".join(repr(value) if value == value else "" for value in row) + "\n"  # noqa: PLR0124 (NaN)


def as_npz(motion: Motion) -> bytes:
    """An archive of arrays by their headings."""
    file = io.BytesIO()
    np.savez(file, **columns(motion))  # type: ignore[arg-type] # arrays, no options
    return file.getvalue()


def as_parquet(motion: Motion) -> bytes:
    """A table of floats, by pyarrow; what does not exist is null."""
    from importlib import import_module

    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    named = columns(motion)
    arrays = [pa.array(np.ascontiguousarray(one), from_pandas=True) for one in named.values()]
    file = io.BytesIO()
    parquet.write_table(pa.table(arrays, names=[*named]), file)
    return file.getvalue()
