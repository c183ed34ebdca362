"""Summary of a gearbox: ratios, step ratios, shifts, largest values, torque margins.

`summarize` calculates a `Summary` from results, and `tables` converts it to tables.

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
    """Summary of a case, as printed by `vstatics summary`."""

    results: Results
    design: Design
    transitions: Sequence[Transition]
    largest: Mapping[str, Sequence[Largest]]
    """Largest values in any gear, by name of the result table."""
    sensitivities: Floats
    """Sensitivities ``(u/i) di/du`` of gear ratios i to basic ratios u, shape (gears, mechanisms).

    [-]
    """
    efficiency_sensitivities: Floats
    """Sensitivities ``(n/ETA) dETA/dn`` of gear efficiencies ETA to mechanism efficiencies n. [-]

    The shape is (gears, mechanisms).
    """
    margins: Sequence[Margin]
    """Margins of the shift elements whose torque capacity is known."""
    combinations: Sequence[Combination] | None = None
    """Unused combinations of shift elements; None if not requested."""
    cycle: CycleSection | None = None
    """Results over a duty cycle; None without a duty cycle."""
    inertias: Sequence[GearInertia] = ()
    """Inertias of the gears, reduced to the input; empty if the case has no inertia."""
    vehicle: Section | None = None
    """Performance of the vehicle; None if the case has no vehicle with an engine."""
    needed: Sequence[Needed] = ()
    """Required torque capacities of shift elements; empty without a `reserve`."""

    def __repr__(self) -> str:
        """Return the name of the case, the number of gears and the spread."""
        counts = f"{len(self.design.gears)} gears, spread {self.design.spread:.4g}"
        return f"<Summary of {self.results.case.name!r}: {counts}>"

    def _repr_html_(self) -> str:
        """Return all tables in HTML, for a notebook."""
        return shown(higher("summary_grids")(self))


@refusing()
def summarize(
    results: Results,
    *,
    at_most: int | None = None,
    output_torque: float = 0.0,
    reserve: float | None = None,
) -> Summary:
    """Summarize the results of a case.

    Parameters
    ----------
    results : Results
        Results of a single case, not of arrays of variants.
    at_most : int, optional
        Largest number of unused combinations of shift elements to calculate. By default, none is
        calculated.
    output_torque : float
        External torque on the output, for accelerations. The torque of a load is below 0. [N*m]
    reserve : float, optional
        Ratio of required torque capacity to largest torque. [-]

    Returns
    -------
    Summary
        Ratios, steps and spread [-], transitions, largest values, margins, vehicle performance.

    Raises
    ------
    CaseError
        If there are more than `at_most` unused combinations.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear([2])])
    >>> summary = summarize(solve(case))
    >>> summary.design.spread, [line.ratio for line in summary.design.gears]
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
