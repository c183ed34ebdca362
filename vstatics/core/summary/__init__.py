"""What a designer asks of a gearbox first: design table, shifts, largest values.

`summarize` calculates a `Summary` of results; `tables` shows it in tables, which
`vstatics.core.tables` writes.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> from vstatics.core.summary.tables import summary_grids
>>> from vstatics.core.tables import text
>>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
>>> print(text.write([], list(summary_grids(summarize(solve(case))))[:2]), end="")
Gears
gear  ratio  next   step  efficiency
1     3.500  2     3.500       1.000
2     1.000            -       1.000
<BLANKLINE>
Spread
from  to  spread
1     2    3.500
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.arguments import refusing
from vstatics.core.extras import higher
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.summary.design_table import Design, design
from vstatics.core.summary.extremes import (
    Largest,
    Margin,
    Needed,
    largest,
    margins,
    needed_capacities,
)
from vstatics.core.summary.inertia import GearInertia, reduced_inertias
from vstatics.core.summary.sensitivity import efficiency_sensitivities, sensitivities
from vstatics.core.summary.shifts import Transition, transitions
from vstatics.core.summary.unused_sets import Combination, combinations
from vstatics.core.tables.html import shown

if TYPE_CHECKING:
    from vstatics.core.summary.sections import CycleSection, Section

__all__ = ["Summary", "summarize"]


class Summary(NamedTuple):
    """Everything that `vstatics summary` tells of one case."""

    results: Results
    design: Design
    transitions: Sequence[Transition]
    largest: Mapping[str, Sequence[Largest]]
    """By the name of the table that they are the largest values of."""
    sensitivities: Floats
    """(gears, mechanisms), ``(u/i) di/du``. [-]"""
    efficiency_sensitivities: Floats
    """(gears, mechanisms), ``(n/ETA) dETA/dn``. [-]"""
    margins: Sequence[Margin]
    """Of the shift elements that have a capacity."""
    combinations: Sequence[Combination] | None = None
    """If they were asked for."""
    cycle: CycleSection | None = None
    """If there is a duty cycle."""
    inertias: Sequence[GearInertia] = ()
    """If anything has an inertia."""
    vehicle: Section | None = None
    """If the case has a vehicle with an engine."""
    needed: Sequence[Needed] = ()
    """What shift elements must carry, if a reserve is asked for."""

    def __repr__(self) -> str:
        """Of which case, how many gears, their spread; not all numbers."""
        counts = f"{len(self.design.gears)} gears, spread {self.design.spread:.4g}"
        return f"<Summary of {self.results.case.name!r}: {counts}>"

    def _repr_html_(self) -> str:
        """All its tables, for a notebook."""
        return shown(higher("summary_grids")(self))


@refusing()
def summarize(
    results: Results,
    *,
    at_most: int | None = None,
    output_torque: float = 0.0,
    reserve: float | None = None,
) -> Summary:
    """The summary of a case.

    Parameters
    ----------
    results : Results
        Of one case, not of arrays of variants.
    at_most : int, optional
        So many further combinations of shift elements may be tried; none when not given.
    output_torque : float
        Outside torque on the output, for accelerations; below 0 it resists. [N*m]
    reserve : float, optional
        By so much capacities shall be above the largest torques. [-]

    Returns
    -------
    Summary
        Ratios, steps and spread [-], transitions, largest values, margins, what a vehicle does.

    Raises
    ------
    CaseError
        If there are more.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> made = summarize(solve(case))
    >>> made.design.spread, [line.ratio for line in made.design.gears]
    (3.5, [1.0, 3.5])
    """
    expect_one_case(results, "summarize")
    case = results.case
    return Summary(
        results,
        design(results),
        transitions(results),
        largest(results),
        sensitivities(results),
        efficiency_sensitivities(results),
        margins(results),
        None if at_most is None else combinations(results, at_most),
        inertias=reduced_inertias(results, output_torque),
        vehicle=higher("vehicle_section")(case) if case.vehicle else None,
        needed=() if reserve is None else needed_capacities(results, reserve),
    )
