"""Conversion of results to a pandas DataFrame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from vstatics.core.statics.result_arrays import ARRAYS
from vstatics.core.statics.results import Results
from vstatics.core.tables.names import table_rows
from vstatics.core.tables.quantities import BY_NAME
from vstatics.core.tables.values import with_units

if TYPE_CHECKING:
    import pandas as pd


def to_dataframe(results: Results) -> pd.DataFrame:
    """Convert results to a DataFrame with a row per variant and gear.

    Parameters
    ----------
    results : Results
        Results of one case, or of arrays of variants with any axes.

    Returns
    -------
    DataFrame
        Values, indexed by the number of the variant (from 0) and the name of the gear, or for a
        single case by the gear alone. The name of a column consists of a table and its row:
        ``("speeds", "C1")``, with an operating point also ``("speeds_rpm", "C1")``. A table with
        one value per gear has the row ``""``, so that ``"ratio"`` selects the column.

    Raises
    ------
    CaseError
        If pandas is missing.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> table = to_dataframe(solve(case, ratios=[[-2.0], [-3.0]]))
    >>> table.shape, table.loc[(1, "2"), "ratio"].item()
    ((4, 44), 4.0)
    >>> table["speeds", "3"].round(3).tolist(), list(table["slip_speeds"])
    ([1.0, 0.333, 1.0, 0.25], ['F1', 'T2'])
    """
    from vstatics.core.extras import require

    require("pandas", "to_dataframe")
    import pandas as pd

    axes = results.ratio.shape[:-1]

    names, columns = [], []
    for name in (*ARRAYS, *(quantity.name for quantity in with_units(results))):
        table = results.existing(name)
        if BY_NAME[name].rows == "one":
            names.append((name, ""))
            columns.append(table.ravel())
        for index, row in enumerate(table_rows(name, results.case)):
            names.append((name, row))
            columns.append(table[..., index].ravel())
    variants = range(math.prod(axes))
    gears = results.gears
    return pd.DataFrame(
        dict(enumerate(columns)),
        index=pd.MultiIndex.from_product([variants, gears], names=["variant", "gear"])
        if axes
        else pd.Index(gears, name="gear"),
    ).set_axis(pd.MultiIndex.from_tuples(names, names=["table", "row"]), axis=1)
