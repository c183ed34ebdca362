"""The design table: ratios, steps from gear to gear, spread, efficiencies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.statics.results import Results
from vstatics.summary.order import ranges


class GearLine(NamedTuple):
    """A gear in the design table."""

    gear: str
    ratio: float
    next: str
    """The gear of the same direction with the next smaller ratio, if there is one."""
    step: float
    """Ratio of the gear by that of the next. [-]"""
    efficiency: float
    state: str
    """Why something does not exist; empty for a gear of which all is known."""


class Design(NamedTuple):
    """The design table of a transmission."""

    gears: Sequence[GearLine]
    """In the order of the case."""
    forward: Sequence[str]
    """From the largest ratio to the smallest."""
    spread: float
    """Largest by smallest forward ratio [-]; NaN without gears."""


def design(results: Results) -> Design:
    """Ratios, steps and efficiencies of all gears.

    Parameters
    ----------
    results : Results
        Of one case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> made = design(solve(case))
    >>> made.spread, [line.step for line in made.gears]
    (3.5, [3.5, nan])
    """
    names = [gear.name for gear in results.case.gears]
    ratios = results.ratio.tolist()
    found = ranges(results)
    following = {one: other for indices in found for one, other in pairwise(indices)}
    lines = []
    for index, name in enumerate(names):
        after = following.get(index)
        lines.append(
            GearLine(
                name,
                ratios[index],
                "" if after is None else names[after],
                math.nan if after is None else ratios[index] / ratios[after],
                float(results.efficiency[index]),
                state(results, index),
            )
        )
    forward = found[0] if found else []
    spread = ratios[forward[0]] / ratios[forward[-1]] if forward else math.nan
    return Design(lines, [names[index] for index in forward], spread)


def state(results: Results, index: int) -> str:
    """What is to be said of a gear, in a word or two."""
    case = results.case
    output_speed = results.speeds[index, case.gear_output(case.gears[index]) - 1]
    said = {
        "tied up": results.tied_up[index],
        "conflict": results.conflict[index],
        "output stands": output_speed == 0,
        "open": math.isnan(results.ratio[index]),
        "no torques": not results.balanced[index],
        "locked": results.locked[index],
        "undecided": results.undecided[index],
    }
    return next((word for word, is_so in said.items() if is_so), "")
