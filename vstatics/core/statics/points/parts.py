"""Numbers of parts that vary at operating points: each set of them is a case of its own.

`elements.part_numbers` lists the numbers of parts and creates the cases; `Transmission` has both as
methods.
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
    """A case with numbers of its parts that some points have."""

    chosen: Integers
    """Their places."""
    case: Transmission

    def columns(self, columns: Columns) -> Columns:
        """Of columns of all points those of these."""
        return {number: column[self.chosen] for number, column in columns.items()}


def cases_of_points(case: Transmission, columns: Mapping[str, Floats]) -> Iterator[CaseOfPoints]:
    """The cases that columns of numbers of parts make, in SI, by their paths.

    Raises
    ------
    CaseError
        For the first point whose numbers can't be.
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
                one._replace(message=said + one.message) for one in error.problems
            ) from None


def alike_rows(values: Floats) -> Iterator[tuple[Integers, list[float]]]:
    """Rows that are the same: their places, and their numbers.

    >>> [(places.tolist(), row) for places, row in alike_rows(np.array([[2.0], [1.0], [2.0]]))]
    [([1], [1.0]), ([0, 2], [2.0])]
    """
    rows, kinds = np.unique(values, axis=0, return_inverse=True)
    for kind, row in enumerate(rows.tolist()):
        yield np.flatnonzero(kinds.reshape(-1) == kind), row


def joined(case: Transmission, places: Sequence[Integers], parts: Sequence[Results]) -> Results:
    """One answer of several cases, its points in their own order."""
    order = np.argsort(np.concatenate(places))

    def whole(arrays: Sequence[Any]) -> Any:
        return np.concatenate(arrays)[order]

    told: list[Any] = [part.points for part in parts]
    first: OperatingPoints = told[0]
    gears: list[Any] = [
        gear._replace(
            torques={
                link: whole([one.gears[n].torques[link] for one in told]) for link in gear.torques
            }
        )
        for n, gear in enumerate(first.gears)
    ]
    points = first._replace(
        scales={unit: whole([one.scales[unit] for one in told]) for unit in first.scales},
        loaded=whole([one.loaded for one in told]),
        gears=gears,
        outside={
            name: whole([one.outside.get(name, np.zeros_like(one.loaded)) for one in told])
            for name in dict.fromkeys(name for one in told for name in one.outside)
        },
        open=None if first.open is None else whole([one.open for one in told]),
    )
    arrays = {name: whole([part.in_own_unit(name) for part in parts]) for name in ARRAYS}
    return Results(case=case, **arrays, points=points)
