"""Operating points: any number of a case varied, in SI, with all that follows from a load.

`paths` tells which numbers a path names, `relative` what they are relative to the load, and
which points go alike.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from vstatics.model.transmission import Transmission
from vstatics.statics.points.paths import columns_of
from vstatics.statics.points.relative import solve_points
from vstatics.statics.results import Results

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def solve_varied(case: Transmission, vary: Mapping[str, ArrayLike]) -> Results:
    """Every gear of a case at many points; see `vstatics.solve`."""
    columns, variants = columns_of(case, vary)
    return solve_points(case, columns, variants)
