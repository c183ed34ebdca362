"""In which order the wheels of an element get teeth."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.synthesis.teeth_layout import TeethLayout
from vstatics.synthesis.teeth_limits import AxisEquation


def growth_order(
    layout: TeethLayout, equations: Sequence[AxisEquation], widths: Sequence[int]
) -> list[int]:
    """Columns of wheels, and of the number of planets behind the first planet.

    Those of a ratio stand together, what an equation leaves hardly a choice stands behind it.

    Parameters
    ----------
    layout : TeethLayout
    equations : sequence of AxisEquation
    widths : sequence of int
        How many teeth each wheel may have.

    Examples
    --------
    Sun, ring, planet and number of planets:

    >>> from vstatics.explain.bodies import on_own_links
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> from vstatics.synthesis.teeth_layout import teeth_layouts
    >>> from vstatics.synthesis.teeth_limits import TeethLimits, axis_equations
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()])
    >>> (layout,) = teeth_layouts(on_own_links(case))
    >>> growth_order(layout, [*axis_equations(layout, TeethLimits())], [43, 104, 43])
    [0, 1, 2, 3]
    """
    order: list[int] = []
    count = len(layout.wheels)
    axes = [{rim, *axis} for rims in layout.planets for rim in rims if (axis := layout.axis(rim))]

    def add(column: int) -> None:
        if column in order:
            return
        order.append(column)
        if count not in order and any(axis <= {*order} for axis in axes):
            order.append(count)
        for equation in equations:
            left = [one for one in equation.terms if one not in order]
            if len(left) == 1:
                add(left[0])

    of_ratios = sorted((ratio.powers for ratio in layout.ratios), key=len)
    for wheels in (*of_ratios, range(count)):
        for wheel in sorted(wheels, key=lambda one: widths[one]):
            add(wheel)
    add(count)
    return order
