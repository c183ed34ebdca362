"""Synthesis of gearboxes from planetary gear sets: schemes, gears, ratios and teeth.

`structures` lists the schemes (ways to connect the links) of a number of planetary gear sets. For a
case with such a scheme, `gears` tries the combinations of shift elements, `ratios` fits the ratios
of the gear sets to wanted ratios of the gears, and `teeth` finds integer tooth numbers. `compiled`
compiles loops with Numba, through `machine_code` and `code_cache`; with these loops, `boxes` finds
whole gearboxes at once. `pictures` draws found gearboxes, `report` writes a page about them, and
`cli` contains the commands `vstatics synth ...`.

>>> from vstatics.synthesis import SetScheme, StructureSearch, combinations, find_teeth
>>> from vstatics.synthesis import fit, scheme_case, schemes
>>> [scheme.code for scheme in schemes(StructureSearch(sets=2, classes="order"))]
['0-1-2-0-1-3', '0-1-2-0-3-4']
>>> case = scheme_case(SetScheme.of_code("0-1-2-0-1-3"), 0, 3, ratios=[-2, -2.5])
>>> for combination in combinations(case):
...     print(combination.engaged, combination.kind, round(combination.ratio, 9))
['T-L1'] gear -2.5
['T-L2'] gear 15.0
['F-L0-L3'] direct 1.0
>>> round(fit(case, {"R": -3.0}).ratios["P2"], 9)
-3.0
>>> dict(find_teeth(case, {"P1": -2.0}).solutions[0].teeth["P1"])
{'sun': 34, 'ring': 68, 'planet': 17}
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.core.extras import later
from vstatics.synthesis.annex import ANNEX

if TYPE_CHECKING:
    from vstatics.synthesis.boxes.box import BoxSearch
    from vstatics.synthesis.boxes.choice import BoxFilter, BoxList, RankedBox, find_boxes
    from vstatics.synthesis.boxes.figures.planar import box_is_planar
    from vstatics.synthesis.gears.case_of_scheme import scheme_case
    from vstatics.synthesis.gears.kinds import EngagedSet
    from vstatics.synthesis.gears.search import combinations
    from vstatics.synthesis.ratios.fitting import Fit, fit
    from vstatics.synthesis.structures.counts import count
    from vstatics.synthesis.structures.growth import FoundScheme, StructureSearch, schemes
    from vstatics.synthesis.structures.scheme import SetScheme
    from vstatics.synthesis.teeth.finding import FoundTeeth, find_teeth
    from vstatics.synthesis.teeth.limits import TeethLimits

__all__ = [
    "BoxFilter",
    "BoxList",
    "BoxSearch",
    "EngagedSet",
    "Fit",
    "FoundScheme",
    "FoundTeeth",
    "RankedBox",
    "SetScheme",
    "StructureSearch",
    "TeethLimits",
    "box_is_planar",
    "combinations",
    "count",
    "find_boxes",
    "find_teeth",
    "fit",
    "scheme_case",
    "schemes",
]

__getattr__ = later(__name__, ANNEX.own_names)


def __dir__() -> list[str]:
    return __all__
