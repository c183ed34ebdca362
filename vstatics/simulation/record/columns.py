"""Columns of a run over time, with the names that sweep expressions use, and their file formats."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

import numpy as np

from vstatics.core.extras import require
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables import csv
from vstatics.core.tables.names import written
from vstatics.simulation.record.motion import Motion

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def main_tables(motion: Motion) -> dict[str, tuple[tuple[str, ...], Floats]]:
    """Return names and columns, shape (rows, instants), of speeds, slips and torques, by table."""
    return {
        "speeds": (motion.links, motion.speeds.T),
        "slips": (motion.elements, motion.slips.T),
        "torques": (motion.devices, motion.torques.T),
    }


def columns(motion: Motion) -> dict[str, Floats]:
    """Return the columns of a motion by heading, such as ``speeds[in]``.

    The first column is `time` [s], followed by speeds and slips [rad/s], torques [N*m] and
    additional columns. A run that stopped early also has `stopped`, which is 1 at the last instant.
    """
    named = {"time": motion.time}
    tables = main_tables(motion)
    for table, rows in motion.asked.items():
        tables[table] = tuple(rows), np.array([*rows.values()])
    for table, (names, values) in tables.items():
        for index, (name, column) in enumerate(zip(names, values, strict=True)):
            named[f"{table}[{written(index, names)}]" if name else table] = column
    if motion.stopped is not None:
        named["stopped"] = np.zeros(len(motion.time))
        named["stopped"][-1] = 1.0
    return named


def motion_dataframe(motion: Motion) -> pd.DataFrame:
    """Return a pandas data frame with a row for each instant; see `Motion.to_dataframe`."""
    require("pandas", "to_dataframe")
    import pandas as pd

    named = columns(motion)
    return pd.DataFrame(named, index=named["time"])


def motion_dataset(motion: Motion) -> xr.Dataset:
    """Return an xarray dataset with names along the axes; see `Motion.to_xarray`."""
    require("xarray", "to_xarray")
    import xarray as xr

    axes = {"link": motion.links, "element": motion.elements, "device": motion.devices}
    variables = {
        "speeds": (("time", "link"), motion.speeds, {"units": "rad/s"}),
        "slips": (("time", "element"), motion.slips, {"units": "rad/s"}),
        "torques": (("time", "device"), motion.torques, {"units": "N*m"}),
    }
    coordinates = {"time": motion.time, **{axis: [*names] for axis, names in axes.items()}}
    name = motion.case.name if motion.case else ""
    return xr.Dataset(variables, coordinates, {"case": name})


def as_csv(motion: Motion, *, raw: bool = False) -> str:
    """Return comma-separated values: a line of headings, then a line for each instant.

    A cell is empty for NaN.
    """
    named = columns(motion)
    lines = (
        ",".join("" if math.isnan(value) else repr(value) for value in row) + "\n"
        for row in np.column_stack([*named.values()]).tolist()
    )
    return "".join([csv.lines([named], raw=raw), *lines])


def as_npz(motion: Motion) -> bytes:
    """Return the bytes of a NumPy archive with an array for each heading."""
    file = io.BytesIO()
    np.savez(file, **columns(motion))  # type: ignore[arg-type] # arrays, no options
    return file.getvalue()


def as_parquet(motion: Motion) -> bytes:
    """Return the bytes of a Parquet file of floats; NaN is written as null."""
    from importlib import import_module

    pa, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    named = columns(motion)
    arrays = [pa.array(np.ascontiguousarray(column), from_pandas=True) for column in named.values()]
    file = io.BytesIO()
    parquet.write_table(pa.table(arrays, names=[*named]), file)
    return file.getvalue()
