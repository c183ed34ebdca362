"""Groups of points with equal tooth numbers and other numbers of components.

Each group needs its own case, which a method of `Transmission` creates.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.statics.points.paths import Columns
from vstatics.core.statics.result_arrays import ARRAYS, OperatingPoints
from vstatics.core.statics.results import Results


class CaseOfPoints(NamedTuple):
    """Case for all points at which the numbers of all components are equal."""

    chosen: Integers
    """Indices of the points."""
    case: Transmission

    def columns(self, columns: Columns) -> Columns:
        """Return the columns restricted to the points of the case."""
        return {number: column[self.chosen] for number, column in columns.items()}


def cases_of_points(case: Transmission, columns: Mapping[str, Floats]) -> Iterator[CaseOfPoints]:
    """Yield a case for each group of points at which the numbers of all components are equal.

    Parameters
    ----------
    case : Transmission
    columns : mapping of str to ndarray
        Values of each number at all points, in SI units, by the path in `part_numbers`.

    Raises
    ------
    CaseError
        If the numbers of a point are not valid.
    """
    known = case.part_numbers()
    for path, column in columns.items():
        wrong = np.flatnonzero(known[path].impossible(column))
        if wrong.size:
            message = f"read {column[wrong[0]]:g} in variant {wrong[0]}, expected "
            raise CaseError([Problem("E415", message + known[path].expected, ("vary", path))])
    numbers = [known[path] for path in columns]
    for chosen, row in alike_rows(np.column_stack([*columns.values()])):
        try:
            yield CaseOfPoints(chosen, case.with_part_numbers(numbers, row))
        except CaseError as error:
            said = f"in variant {chosen[0]}: "
            raise CaseError(
                problem._replace(message=said + problem.message) for problem in error.problems
            ) from None


def alike_rows(values: Floats) -> Iterator[tuple[Integers, list[float]]]:
    """Group equal rows; yield the indices of the rows and the common values.

    >>> [(places.tolist(), row) for places, row in alike_rows(np.array([[2.0], [1.0], [2.0]]))]
    [([1], [1.0]), ([0, 2], [2.0])]
    """
    rows, kinds = np.unique(values, axis=0, return_inverse=True)
    for kind, row in enumerate(rows.tolist()):
        yield np.flatnonzero(kinds.reshape(-1) == kind), row


def joined(case: Transmission, places: Sequence[Integers], parts: Sequence[Results]) -> Results:
    """Join the results of several cases, with the points in the original order."""
    order = np.argsort(np.concatenate(places))

    def whole(arrays: Sequence[Any]) -> Any:
        return np.concatenate(arrays)[order]

    points_of: list[Any] = [part.points for part in parts]
    first: OperatingPoints = points_of[0]
    gears: list[Any] = [
        gear._replace(
            torques={
                link: whole([part.gears[n].torques[link] for part in points_of])
                for link in gear.torques
            }
        )
        for n, gear in enumerate(first.gears)
    ]
    points = first._replace(
        scales={unit: whole([part.scales[unit] for part in points_of]) for unit in first.scales},
        loaded=whole([part.loaded for part in points_of]),
        gears=gears,
        outside={
            name: whole([part.outside.get(name, np.zeros_like(part.loaded)) for part in points_of])
            for name in dict.fromkeys(name for part in points_of for name in part.outside)
        },
        open=None if first.open is None else whole([part.open for part in points_of]),
    )
    arrays = {name: whole([part.in_own_unit(name) for part in parts]) for name in ARRAYS}
    return Results(case=case, **arrays, points=points)
