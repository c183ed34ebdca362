"""Conversion of results to an xarray dataset with named axes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from vstatics.core.statics.result_arrays import ARRAYS, Rows
from vstatics.core.statics.results import Results
from vstatics.core.tables.names import table_rows
from vstatics.core.tables.quantities import BY_NAME, UNITS
from vstatics.core.tables.values import with_units
from vstatics.core.tables.written_results import GEAR

if TYPE_CHECKING:
    import xarray as xr

DIMENSIONS: Mapping[Rows, str] = {
    "links": "link",
    "planets": "planet",
    "elements": "shift_element",
    "torques": "device",
    "devices": "mechanism",
    "mechanisms": "three_link_mechanism",
    "meshes": "mesh",
    "converters": "converter",
}
"""Name of the dimension for each kind of rows of a table, as in `docs/expressions.md`."""


def to_xarray(results: Results) -> xr.Dataset:
    """Convert results to a dataset of xarray with names along all axes.

    Parameters
    ----------
    results : Results
        Results of one case, or of arrays of variants with any axes.

    Returns
    -------
    Dataset
        Variable for each table, such as ``speeds`` and, with an operating point, ``speeds_rpm``.
        Its dimensions are the axes of variants, `gear`, and the kind of its rows: `link`, `planet`,
        `shift_element`, `device` (shift elements, mechanisms or members of gear sets, springs,
        ``Mx``), `mechanism` (or gear set, as named in the case), `three_link_mechanism` (into which
        the solver divides gear sets) or `mesh`. A single axis of variants is `variant`; several are
        `variant_1`, `variant_2`, ... Values that do not exist are NaN. Flags are 0 and 1. The
        attributes of a variable are `long_name` and `units`. A variable without `units` is relative
        to the input. [-]

    Raises
    ------
    CaseError
        If xarray is missing.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> data = to_xarray(solve(case, ratios=[[-2.0], [-3.0]]))
    >>> data.speeds.dims, data.speeds.shape, data.lossy_torques.dims[-1]
    (('variant', 'gear', 'link'), (2, 2, 3), 'device')
    >>> data.ratio.sel(variant=1, gear="2").item(), data.torques.sel(gear="2", device="Mx").values
    (4.0, array([3., 4.]))
    """
    from vstatics.core.extras import require

    require("xarray", "to_xarray")
    import numpy as np
    import xarray as xr

    case, axes = results.case, results.ratio.shape[:-1]
    names = ["variant"] if len(axes) == 1 else [f"variant_{n}" for n in range(1, len(axes) + 1)]
    coordinates: dict[str, Any] = dict(zip(names, map(range, axes), strict=True))
    coordinates[GEAR] = [gear.name for gear in case.gears]
    variables = {}
    for quantity in (*(BY_NAME[name] for name in ARRAYS), *with_units(results)):
        along = [*names, GEAR]
        if quantity.rows != "one":
            along.append(DIMENSIONS[quantity.rows])
            coordinates[along[-1]] = np.array(table_rows(quantity.name, case), str)
        attributes = {"long_name": quantity.title}
        if quantity.unit:
            unit = UNITS[quantity.unit].text
            attributes = {"long_name": quantity.title.removesuffix(f", {unit}"), "units": unit}
        variables[quantity.name] = along, results.existing(quantity.name), attributes
    return xr.Dataset(variables, coordinates, {"case": case.name})
