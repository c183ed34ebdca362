"""The gearbox to be found: which schemes there are, which gears they give, with which ratios.

A number of planetary sets goes in, or a case; schemes come out, combinations of shift
elements, internal ratios. Each of them is a case again.
"""

from __future__ import annotations

from vstatics.synthesis.combinations import combinations
from vstatics.synthesis.found_schemes import FoundScheme, schemes
from vstatics.synthesis.scheme import SetScheme
from vstatics.synthesis.scheme_case import scheme_case
from vstatics.synthesis.structure_counts import count
from vstatics.synthesis.structures import StructureSearch

__all__ = [
    "FoundScheme",
    "SetScheme",
    "StructureSearch",
    "combinations",
    "count",
    "scheme_case",
    "schemes",
]
